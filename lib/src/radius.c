/* radius.c - the points in a closed ball. */
#include "leaf.h"
#include "search.h"

#include <math.h>

typedef struct ball {
    const octree *tree;
    octree_search how;
    metric metric;
    double radius;       /* as given */
    double square;       /* of the radius, scaled */
    double whole_square; /* of radius + epsilon, scaled */
    octree_cost *cost;
    octree_point_visitor visit;
    void *context;
} ball;

/* The squares of the distances to the nearest and the farthest place of a cell. */
static void cell_squares(const ball *b, cell c, double *nearest, double *farthest)
{
    double near[3], far[3];
    const octree_box box = cell_bounds(b->tree->axes, c);
    for (int i = 0; i < 3; i++) {
        near[i] = metric_gap(&b->metric, i, box.min[i], box.max[i]);
        far[i] = fmax(b->metric.scaled[i] - box.min[i] * b->metric.scale,
                      box.max[i] * b->metric.scale - b->metric.scaled[i]);
    }
    *nearest = (near[0] * near[0] + near[1] * near[1]) + near[2] * near[2];
    *farthest = (far[0] * far[0] + far[1] * far[1]) + far[2] * far[2];
}

static bool contains(const ball *b, const octree_point *point)
{
    const double square = metric_point(&b->metric, point->position);
    if (is_trusted(b->how.mode, square))
        return square <= b->square;
    if (metric_surely_less(square, fmin(b->square, METRIC_FINITE)))
        return true;
    return !metric_surely_less(b->square, square) &&
           metric_compare_radius(b->metric.target, point->position, b->radius) <= 0;
}

static bool scan_leaf(const ball *b, const node *leaf)
{
    b->cost->leaves++;
    b->cost->points += leaf->count;
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        if (contains(b, point) && !b->visit(point, b->context))
            return false;
    }
    return true;
}

static void descend(const ball *b)
{
    node_stack stack = {.size = 0};
    stack_push(&stack, &b->tree->root, root_cell());
    bool go_on = true;
    while (go_on && stack.size > 0) {
        const stacked next = stack_pop(&stack);
        double nearest, farthest;
        cell_squares(b, next.cell, &nearest, &farthest);
        if (surely_less(b->how.mode, b->square, nearest)) {
            b->cost->pruned++;
        } else if (surely_less(b->how.mode, farthest, b->whole_square)) {
            go_on = visit_all_below(next.node, b->cost, b->visit, b->context);
        } else {
            b->cost->nodes++;
            if (next.node->octants)
                stack_push_children(&stack, next);
            else
                go_on = scan_leaf(b, next.node);
        }
    }
}

static double scaled_square(double length, double scale)
{
    return length * scale * (length * scale);
}

octree_status octree_radius(const octree *tree, const double center[3], double radius, const octree_search *how,
                            octree_point_visitor visit, void *context)
{
    if (!tree || !center || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_search(&search);
    if (status == OCTREE_OK)
        status = isfinite(radius) ? check_finite(center) : OCTREE_NOT_FINITE;
    if (status == OCTREE_OK && radius < 0)
        status = OCTREE_BAD_SIZE;
    if (status != OCTREE_OK)
        return status;
    octree_cost unused;
    descend(&(ball){
        .tree = tree,
        .how = search,
        .metric = metric_make(tree->scale, center),
        .radius = radius,
        .square = scaled_square(radius, tree->scale),
        .whole_square = fmin(scaled_square(radius + search.epsilon, tree->scale), METRIC_FINITE),
        .cost = cost_or(&search, &unused),
        .visit = visit,
        .context = context,
    });
    return OCTREE_OK;
}
