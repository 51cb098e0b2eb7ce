/* nearest.c - Algorithms 6 and 7: the nearest point, decided by the real numbers.
 *
 * A depth-first search that enters the nearest octant first and leaves out a node when its box is surely farther than
 * the best point. Squared distances in doubles decide whenever their proven error allows (metric.h); exact arithmetic
 * decides the rest, so that rounding never picks the neighbour.
 */
#include "leaf.h"
#include "metric.h"

#include <math.h>

/* A node to visit, its box, and the square of its distance. */
typedef struct candidate {
    const node *node;
    cell cell;
    double square;
} candidate;

typedef struct search {
    const octree *tree;
    metric metric;
    octree_skip skip;
    uint64_t skip_id;
    const octree_point *best;
    double best_square; /* infinity while there is none */
    size_t size;
    candidate stack[STACK_ROOM];
} search;

static bool is_skipped(const search *s, const octree_point *point)
{
    switch (s->skip) {
    case OCTREE_SKIP_ID:
        return point->id == s->skip_id;
    case OCTREE_SKIP_COINCIDENT:
        return same_position(point->position, s->metric.target);
    default:
        return false;
    }
}

/* True when the point beats the best so far: nearer, or as near with a lower id. */
static bool beats(const search *s, const octree_point *point, double square)
{
    if (!s->best || metric_surely_less(square, s->best_square))
        return true;
    if (metric_surely_less(s->best_square, square))
        return false;
    const int order = metric_compare(s->metric.target, point->position, s->best->position);
    return order < 0 || (order == 0 && point->id < s->best->id);
}

static void scan_leaf(search *s, const node *leaf)
{
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        const double square = metric_point(&s->metric, point->position);
        if (s->best && metric_surely_less(s->best_square, square))
            continue;
        if (!is_skipped(s, point) && beats(s, point, square)) {
            s->best = point;
            s->best_square = square;
        }
    }
}

/* The squares of the distances to both halves of a cell on each axis: [axis][0 below the plane, 1 above]. */
static void half_squares(const search *s, cell c, double squares[3][2])
{
    const uint32_t half = cell_size(c.depth + 1);
    for (int i = 0; i < 3; i++) {
        const axis *a = &s->tree->axes[i];
        const double middle = plane_at(a, c.low[i] + half);
        const double below = metric_gap(&s->metric, i, plane_at(a, c.low[i]), middle);
        const double above = metric_gap(&s->metric, i, middle, plane_at(a, c.low[i] + 2 * half));
        squares[i][0] = below * below;
        squares[i][1] = above * above;
    }
}

/* Push the children that may hold something better, the nearest last so that it is popped first. */
static void push_children(search *s, const candidate *parent)
{
    double squares[3][2];
    half_squares(s, parent->cell, squares);
    const size_t bottom = s->size;
    const node *child = children_of(parent->node);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (!(parent->node->octants >> octant & 1))
            continue;
        const double square = (squares[0][octant >> 2] + squares[1][octant >> 1 & 1]) + squares[2][octant & 1];
        const candidate next = {child++, cell_child(parent->cell, octant), square};
        if (s->best && metric_surely_less(s->best_square, square))
            continue;
        size_t at = s->size++;
        for (; at > bottom && s->stack[at - 1].square < square; at--)
            s->stack[at] = s->stack[at - 1];
        s->stack[at] = next;
    }
}

static void run_search(search *s)
{
    s->stack[s->size++] = (candidate){&s->tree->root, root_cell(), 0};
    while (s->size > 0) {
        const candidate next = s->stack[--s->size];
        if (s->best && metric_surely_less(s->best_square, next.square))
            continue;
        if (next.node->octants)
            push_children(s, &next);
        else
            scan_leaf(s, next.node);
    }
}

octree_status octree_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id,
                             octree_neighbor *nearest)
{
    if (!tree || !target || !nearest)
        return OCTREE_NULL_ARGUMENT;
    if (!isfinite(target[0]) || !isfinite(target[1]) || !isfinite(target[2]))
        return OCTREE_NOT_FINITE;
    if ((unsigned)skip > OCTREE_SKIP_COINCIDENT)
        return OCTREE_BAD_OPTION;
    search s;
    s.tree = tree;
    s.metric = metric_make(tree->scale, target);
    s.skip = skip;
    s.skip_id = skip_id;
    s.best = NULL;
    s.best_square = INFINITY;
    s.size = 0;
    run_search(&s);
    if (!s.best)
        return OCTREE_NOT_FOUND;
    *nearest = (octree_neighbor){*s.best, metric_distance(target, s.best->position)};
    return OCTREE_OK;
}
