/* nearest.c - Algorithms 6 and 7: the nearest points, decided by the real numbers.
 *
 * A depth-first search that enters the nearest octant first and leaves out a node when its box is surely farther than
 * the worst of the k best points so far. Squared distances in doubles decide whenever their proven error allows
 * (metric.h); exact arithmetic decides the rest, so that rounding never picks a neighbour.
 */
#include "leaf.h"
#include "search.h"

#include <math.h>
#include <stdlib.h>

/* A node to visit, and the square of its box's distance. */
typedef struct candidate {
    const node *node;
    cell cell;
    double square;
} candidate;

/* The best points so far are a heap in the caller's array, the worst of them on top; `distance` holds their scaled
 * squares until the end. */
typedef struct search {
    const octree *tree;
    octree_search how;
    metric metric;
    double
        shrink; /* 1 / (1 + epsilon)^2, rounded up: a node is left out when it is farther than this part of the worst */
    bool bounded; /* by a radius */
    double radius, radius_square;
    octree_neighbor *best;
    size_t count, k;
    octree_cost *cost;
    size_t size;
    candidate stack[STACK_ROOM];
} search;

static bool is_skipped(const search *s, const octree_point *point)
{
    switch (s->how.skip) {
    case OCTREE_SKIP_ID:
        return point->id == s->how.skip_id;
    case OCTREE_SKIP_COINCIDENT:
        return same_position(point->position, s->metric.target);
    default:
        return false;
    }
}

/* The order of results: by distance, then by id, then by position. */
static int compare(const search *s, const octree_neighbor *a, const octree_neighbor *b)
{
    if (surely_less(s->how.mode, a->distance, b->distance))
        return -1;
    if (surely_less(s->how.mode, b->distance, a->distance))
        return 1;
    const int order = is_trusted(s->how.mode, a->distance)
                          ? 0
                          : metric_compare(s->metric.target, a->point.position, b->point.position);
    return order ? order : octree_compare_points(&a->point, &b->point);
}

static void swap(octree_neighbor *a, octree_neighbor *b)
{
    const octree_neighbor kept = *a;
    *a = *b;
    *b = kept;
}

/* Let the item at the top of the first `count` sink to its place. */
static void sink(const search *s, octree_neighbor *heap, size_t count)
{
    for (size_t at = 0, child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare(s, &heap[child], &heap[child + 1]) < 0)
            child++;
        if (compare(s, &heap[at], &heap[child]) >= 0)
            return;
        swap(&heap[at], &heap[child]);
    }
}

static void rise(const search *s, octree_neighbor *heap, size_t at)
{
    for (; at > 0 && compare(s, &heap[(at - 1) / 2], &heap[at]) < 0; at = (at - 1) / 2)
        swap(&heap[(at - 1) / 2], &heap[at]);
}

/* The square beyond which nothing counts any more; infinite while there are fewer than k. */
static double limit(const search *s)
{
    return s->count == s->k ? s->best[0].distance : s->bounded ? s->radius_square : INFINITY;
}

static bool is_within_radius(const search *s, const octree_neighbor *n)
{
    if (!s->bounded || surely_less(s->how.mode, n->distance, fmin(s->radius_square, METRIC_FINITE)))
        return true;
    if (is_trusted(s->how.mode, n->distance))
        return n->distance <= s->radius_square;
    return !metric_surely_less(s->radius_square, n->distance) &&
           metric_compare_radius(s->metric.target, n->point.position, s->radius) <= 0;
}

static void consider(search *s, const octree_neighbor *found)
{
    if (s->count < s->k) {
        s->best[s->count] = *found;
        rise(s, s->best, s->count++);
    } else if (compare(s, found, &s->best[0]) < 0) {
        s->best[0] = *found;
        sink(s, s->best, s->count);
    }
}

static void scan_leaf(search *s, const node *leaf)
{
    s->cost->leaves++;
    s->cost->points += leaf->count;
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        const double square = metric_point(&s->metric, point->position);
        if (surely_less(s->how.mode, limit(s), square) || is_skipped(s, point))
            continue;
        const octree_neighbor found = {*point, square};
        if (is_within_radius(s, &found))
            consider(s, &found);
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

static bool is_too_far(const search *s, double square)
{
    /* With an epsilon the slack of exact mode serves fast mode too: the bound rests on it. */
    const octree_mode mode = s->how.epsilon > 0 ? OCTREE_EXACT : s->how.mode;
    if (s->count == s->k)
        return surely_less(mode, s->best[0].distance * s->shrink, square);
    return s->bounded && surely_less(s->how.mode, s->radius_square, square);
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
        if (is_too_far(s, square)) {
            s->cost->pruned++;
            continue;
        }
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
        if (is_too_far(s, next.square)) {
            s->cost->pruned++;
            continue;
        }
        s->cost->nodes++;
        if (next.node->octants)
            push_children(s, &next);
        else
            scan_leaf(s, next.node);
    }
}

/* Heap to sorted array; squares to distances. */
static void finish(const search *s)
{
    for (size_t left = s->count; left > 1; left--) {
        swap(&s->best[0], &s->best[left - 1]);
        sink(s, s->best, left - 1);
    }
    for (size_t i = 0; i < s->count; i++) {
        const double distance = metric_distance(s->metric.target, s->best[i].point.position);
        /* The order is the real numbers'; rounding must not make it look otherwise. */
        s->best[i].distance = i > 0 ? fmax(distance, s->best[i - 1].distance) : distance;
    }
}

/* A search for k points; a negative radius is none. Returns how many were found. */
static size_t find_nearest(const octree *tree, const double target[3], size_t k, double radius,
                           const octree_search *how, octree_neighbor *neighbors)
{
    octree_cost unused;
    search s;
    s.tree = tree;
    s.how = *how;
    s.metric = metric_make(tree->scale, target);
    s.shrink = how->epsilon > 0 ? (1 + 0x1p-50) / ((1 + how->epsilon) * (1 + how->epsilon)) : 1;
    s.bounded = radius >= 0;
    s.radius = radius;
    s.radius_square = radius * tree->scale * (radius * tree->scale);
    s.best = neighbors;
    s.count = 0;
    s.k = k;
    s.cost = cost_or(how, &unused);
    s.size = 0;
    run_search(&s);
    finish(&s);
    return s.count;
}

static octree_status check_arguments(const octree *tree, const double target[3], const octree_search *how)
{
    if (!tree || !target)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = check_finite(target);
    return status == OCTREE_OK ? check_search(how) : status;
}

octree_status octree_nearest_k(const octree *tree, const double target[3], size_t k, const octree_search *how,
                               octree_neighbor *neighbors, size_t *count)
{
    const octree_search search = search_or_default(how);
    const octree_status status =
        count && (neighbors || k == 0) ? check_arguments(tree, target, &search) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    *count = k > 0 ? find_nearest(tree, target, k, -1, &search, neighbors) : 0;
    return OCTREE_OK;
}

octree_status octree_nearest_within(const octree *tree, const double target[3], double radius, const octree_search *how,
                                    octree_neighbor *nearest)
{
    const octree_search search = search_or_default(how);
    octree_status status = nearest ? check_arguments(tree, target, &search) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK && !isfinite(radius))
        status = OCTREE_NOT_FINITE;
    if (status == OCTREE_OK && radius < 0)
        status = OCTREE_BAD_SIZE;
    if (status != OCTREE_OK)
        return status;
    return find_nearest(tree, target, 1, radius, &search, nearest) ? OCTREE_OK : OCTREE_NOT_FOUND;
}

octree_status octree_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id,
                             octree_neighbor *nearest)
{
    const octree_search search = {.skip = skip, .skip_id = skip_id};
    const octree_status status = nearest ? check_arguments(tree, target, &search) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    return find_nearest(tree, target, 1, -1, &search, nearest) ? OCTREE_OK : OCTREE_NOT_FOUND;
}
