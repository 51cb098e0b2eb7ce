/* range.c - Algorithm 4: the points in a closed box. */
#include "exact.h"
#include "float_mode.h"
#include "leaf.h"
#include "search.h"

#include <math.h>

static octree_status check_box(const octree_box *box)
{
    if (!box)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    for (int i = 0; i < 3; i++) {
        if (isnan(box->min[i]) || isnan(box->max[i]))
            return OCTREE_NOT_FINITE;
        if (box->min[i] > box->max[i])
            return OCTREE_BAD_RANGE;
    }
    return OCTREE_OK;
}

/* A box in keys: what it is compared with are integers from then on. Keys are monotone, so a point whose key lies
 * strictly between the ends' keys lies in the box, and one whose key lies outside them does not. Where the box reaches
 * the world's face, the end is one key beyond all. */
typedef struct key_box {
    int32_t min[3], max[3];
} key_box;

static key_box box_keys(const octree *tree, const octree_box *box)
{
    key_box keys;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys.min[i] = box->min[i] > a->min ? (int32_t)plane_key(a, fmin(box->min[i], a->max)) : -1;
        keys.max[i] = box->max[i] < a->max ? (int32_t)plane_key(a, fmax(box->max[i], a->min)) : (int32_t)PLANE_GRID;
    }
    return keys;
}

static bool misses_world(const octree *tree, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < tree->axes[i].min || box->min[i] > tree->axes[i].max)
            return true;
    return false;
}

static bool is_apart(const key_box *keys, cell c)
{
    const int32_t last = (int32_t)cell_size(c.depth) - 1;
    for (int i = 0; i < 3; i++)
        if ((int32_t)c.low[i] + last < keys->min[i] || (int32_t)c.low[i] > keys->max[i])
            return true;
    return false;
}

static bool is_inside(const key_box *keys, cell c)
{
    const int32_t last = (int32_t)cell_size(c.depth) - 1;
    for (int i = 0; i < 3; i++)
        if ((int32_t)c.low[i] <= keys->min[i] || (int32_t)c.low[i] + last >= keys->max[i])
            return false;
    return true;
}

/* What a box query does with what it meets. */
typedef struct box_query {
    const octree_box *box;
    key_box near_keys;          /* of the box: what does not meet it is left out */
    key_box whole_keys;         /* of the box moved out by epsilon: what is inside is taken whole */
    octree_point_visitor visit; /* null: points are counted */
    void *context;
    size_t count;
    octree_cost *cost;
} box_query;

static bool take_whole(box_query *q, const node *n)
{
    if (q->visit)
        return visit_all_below(n, q->cost, q->visit, q->context);
    q->cost->nodes++;
    q->count += n->count;
    return true;
}

static bool scan_leaf(box_query *q, const node *leaf)
{
    q->cost->leaves++;
    q->cost->points += leaf->count;
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        if (!box_contains(q->box, point->position))
            continue;
        q->count++;
        if (q->visit && !q->visit(point, q->context))
            return false;
    }
    return true;
}

static void descend(const octree *tree, box_query *q)
{
    node_stack stack = {.size = 0};
    stack_push(&stack, &tree->root, root_cell());
    bool go_on = true;
    while (go_on && stack.size > 0) {
        const stacked next = stack_pop(&stack);
        if (is_apart(&q->near_keys, next.cell)) {
            q->cost->pruned++;
        } else if (is_inside(&q->whole_keys, next.cell)) {
            go_on = take_whole(q, next.node);
        } else {
            q->cost->nodes++;
            if (next.node->octants)
                stack_push_children(&stack, next);
            else
                go_on = scan_leaf(q, next.node);
        }
    }
}

/* The box moved out by epsilon, rounded so that nothing beyond it counts as inside. */
static octree_box widen(const octree_box *box, double epsilon)
{
    octree_box wide;
    for (int i = 0; i < 3; i++) {
        wide.min[i] = isfinite(box->min[i]) ? exact_add_up(box->min[i], -epsilon) : box->min[i];
        wide.max[i] = isfinite(box->max[i]) ? exact_add_down(box->max[i], epsilon) : box->max[i];
    }
    return wide;
}

static void run_query(const octree *tree, const octree_search *how, box_query *q)
{
    octree_cost unused;
    q->cost = cost_or(how, &unused);
    if (misses_world(tree, q->box))
        return;
    const octree_box wide = widen(q->box, how->epsilon);
    q->near_keys = box_keys(tree, q->box);
    q->whole_keys = box_keys(tree, &wide);
    descend(tree, q);
}

octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_box(box);
    if (status == OCTREE_OK)
        status = check_search(&search);
    if (status == OCTREE_OK)
        run_query(tree, &search, &(box_query){.box = box, .visit = visit, .context = context});
    return status;
}

octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context)
{
    return octree_range_search(tree, box, NULL, visit, context);
}

octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count)
{
    if (!tree || !count)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = check_box(box);
    box_query q = {.box = box};
    if (status == OCTREE_OK)
        run_query(tree, &(octree_search){0}, &q);
    *count = q.count;
    return status;
}
