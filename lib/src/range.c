/* range.c - Algorithm 4: the points in a closed box. */
#include "range.h"
#include "leaf.h"

#include <math.h>

static octree_status check_box(const octree_box *box)
{
    if (!box)
        return OCTREE_NULL_ARGUMENT;
    for (int i = 0; i < 3; i++) {
        if (isnan(box->min[i]) || isnan(box->max[i]))
            return OCTREE_NOT_FINITE;
        if (box->min[i] > box->max[i])
            return OCTREE_BAD_RANGE;
    }
    return OCTREE_OK;
}

/* A box in keys: what it is compared with are integers from then on. Keys are monotone, so a point whose key lies
 * strictly between the ends' keys lies in the box, and one whose key lies outside them does not. */
typedef struct key_box {
    uint32_t min[3], max[3];
} key_box;

/* False when the box misses the world. */
static bool box_keys(const octree *tree, const octree_box *box, key_box *keys)
{
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        if (box->max[i] < a->min || box->min[i] > a->max)
            return false;
        keys->min[i] = box->min[i] > a->min ? plane_key(a, box->min[i]) : 0;
        keys->max[i] = box->max[i] < a->max ? plane_key(a, box->max[i]) : PLANE_GRID - 1;
    }
    return true;
}

typedef enum meeting { APART, MEETS, INSIDE } meeting;

static meeting meet(const octree *tree, const octree_box *box, const key_box *keys, cell c)
{
    meeting result = INSIDE;
    for (int i = 0; i < 3; i++) {
        const uint32_t low = c.low[i], high = low + cell_size(c.depth) - 1;
        if (high < keys->min[i] || low > keys->max[i])
            return APART;
        const bool below = low > keys->min[i] || box->min[i] <= tree->axes[i].min;
        const bool above = high < keys->max[i] || box->max[i] >= tree->axes[i].max;
        if (!below || !above)
            result = MEETS;
    }
    return result;
}

octree_status range_descend(const octree *tree, const octree_box *box, range_node visit, void *context)
{
    const octree_status status = tree && visit ? check_box(box) : OCTREE_NULL_ARGUMENT;
    key_box keys;
    if (status != OCTREE_OK || !box_keys(tree, box, &keys))
        return status;
    node_stack stack = {.size = 0};
    stack_push(&stack, &tree->root, root_cell());
    while (stack.size > 0) {
        const stacked next = stack_pop(&stack);
        const meeting met = meet(tree, box, &keys, next.cell);
        if (met == APART)
            continue;
        const bool go_on = visit(next.node, met == INSIDE, context);
        if (!go_on && next.node->octants == 0)
            return OCTREE_OK;
        if (go_on && next.node->octants)
            stack_push_children(&stack, next);
    }
    return OCTREE_OK;
}

typedef struct point_visit {
    const octree_box *box;
    octree_point_visitor visit;
    void *context;
} point_visit;

static bool visit_leaf_points(const node *n, bool inside, void *context)
{
    const point_visit *v = context;
    const uint32_t count = n->octants ? 0 : n->count;
    for (uint32_t i = 0; i < count; i++) {
        const octree_point *point = &leaf_points(n)[i];
        if ((inside || box_contains(v->box, point->position)) && !v->visit(point, v->context))
            return false;
    }
    return true;
}

octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context)
{
    if (!visit)
        return OCTREE_NULL_ARGUMENT;
    return range_descend(tree, box, visit_leaf_points, &(point_visit){box, visit, context});
}

typedef struct counting {
    const octree_box *box;
    size_t count;
} counting;

static bool count_node(const node *n, bool inside, void *context)
{
    counting *c = context;
    if (inside) {
        c->count += n->count;
        return n->octants == 0; /* a leaf goes on; an inner node need not be entered */
    }
    const uint32_t count = n->octants ? 0 : n->count;
    for (uint32_t i = 0; i < count; i++)
        c->count += box_contains(c->box, leaf_points(n)[i].position);
    return true;
}

octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count)
{
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    counting c = {box, 0};
    const octree_status status = range_descend(tree, box, count_node, &c);
    *count = c.count;
    return status;
}
