/* tree.c - making and freeing a tree, and the way from its root to a leaf. */
#include "tree.h"
#include "leaf.h"
#include "float_mode.h"
#include "metric.h"
#include "tune.h"

#include <math.h>
#include <stdlib.h>

static void *default_allocate(size_t size, void *context)
{
    (void)context;
    return malloc(size);
}

static void default_release(void *memory, size_t size, void *context)
{
    (void)size;
    (void)context;
    free(memory);
}

octree_def octree_def_default(void)
{
    return (octree_def){
        .world = {{-1000, -1000, -1000}, {1000, 1000, 1000}},
        .leaf_capacity = 64,
        .max_depth = OCTREE_MAX_DEPTH,
        .full_leaf = OCTREE_REFUSE,
    };
}

static octree_status check_def(const octree_def *def)
{
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    for (int i = 0; i < 3; i++)
        if (!isfinite(def->world.min[i]) || !isfinite(def->world.max[i]) || !(def->world.min[i] < def->world.max[i]))
            return OCTREE_BAD_WORLD;
    if (def->leaf_capacity == 0)
        return OCTREE_BAD_CAPACITY;
    if (def->leaf_capacity == OCTREE_AUTO && def->full_leaf != OCTREE_GROW)
        return OCTREE_BAD_CAPACITY;
    const bool half_an_allocator = !def->allocator.allocate != !def->allocator.release;
    if ((def->full_leaf != OCTREE_REFUSE && def->full_leaf != OCTREE_GROW) || half_an_allocator)
        return OCTREE_BAD_OPTION;
    return OCTREE_OK;
}

static octree_def clamp_def(octree_def def)
{
    if (def.leaf_capacity == OCTREE_AUTO)
        def.leaf_capacity = octree_def_default().leaf_capacity; /* until there are points to choose by */
    if (def.leaf_capacity > UINT32_MAX)
        def.leaf_capacity = UINT32_MAX;
    if (def.max_depth > OCTREE_MAX_DEPTH)
        def.max_depth = OCTREE_MAX_DEPTH;
    if (!def.allocator.allocate) {
        def.allocator.allocate = default_allocate;
        def.allocator.release = default_release;
    }
    return def;
}

octree_status octree_create(const octree_def *def, octree **tree)
{
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    *tree = NULL;
    if (!def)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = check_def(def);
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = clamp_def(*def).allocator};
    octree *made = arena_take(&memory, sizeof *made);
    if (!made)
        return OCTREE_NO_MEMORY;
    *made = (octree){.def = clamp_def(*def), .memory = memory, .scale = metric_scale(&def->world)};
    made->tuning = (tuning){def->leaf_capacity == OCTREE_AUTO, octree_mix_default(), TUNE_LEAST};
    for (int i = 0; i < 3; i++)
        made->axes[i] = axis_make(def->world.min[i], def->world.max[i]);
    pool_init(&made->nodes, &made->memory, sizeof(node));
    pool_init(&made->points, &made->memory, sizeof(octree_point));
    *tree = made;
    return OCTREE_OK;
}

void octree_destroy(octree *tree)
{
    if (!tree)
        return;
    octree_clear(tree);
    arena memory = tree->memory;
    arena_give(&memory, tree, sizeof *tree);
}

octree_status octree_clear(octree *tree)
{
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    node_release(tree, &tree->root); /* the crowds have blocks of their own */
    pool_release(&tree->nodes);
    pool_release(&tree->points);
    tree->root = (node){0};
    tree->tuning.due = TUNE_LEAST;
    tree->version++;
    return OCTREE_OK;
}

octree_def octree_definition(const octree *tree)
{
    return tree ? tree->def : octree_def_default();
}

size_t octree_count(const octree *tree)
{
    return tree ? tree->root.count : 0;
}

uint64_t octree_version(const octree *tree)
{
    return tree ? tree->version : 0;
}

octree_status check_position(const octree *tree, const double position[3])
{
    if (!tree || !position)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        if (!isfinite(position[i]))
            return OCTREE_NOT_FINITE;
        inside &= tree->axes[i].min <= position[i] && position[i] <= tree->axes[i].max;
    }
    return inside ? OCTREE_OK : OCTREE_OUTSIDE;
}

path path_to(const octree *tree, uint64_t code)
{
    /* The one place where const is cast away: those who change the tree hold it as theirs to change. */
    path way;
    way.nodes[0] = (node *)(uintptr_t)&tree->root;
    for (way.depth = 0; path_end(&way)->octants; way.depth++) {
        node *child = child_at(path_end(&way), morton_octant(code, way.depth));
        if (!child)
            break;
        way.nodes[way.depth + 1] = child;
    }
    return way;
}

cell path_cell(uint64_t code, unsigned depth)
{
    cell c = root_cell();
    while (c.depth < depth)
        c = cell_child(c, morton_octant(code, c.depth));
    return c;
}

/* The child's cell, whose planes are its parent's and those in the middle of it. */
static void push_child(node_stack *stack, const stacked *parent, const node *child, unsigned octant,
                       const double middle[3])
{
    stacked *top = &stack->items[stack->size++];
    *top = (stacked){child, parent->address << 3 | octant, cell_child(parent->cell, octant), parent->box};
    for (int i = 0; i < 3; i++)
        *(octant & (4u >> i) ? &top->box.min[i] : &top->box.max[i]) = middle[i];
}

/* A large tree does not fit the caches: what is below each child is on its way before the child's turn comes. Who asks
 * for cells asks for points. */
void stack_push_children(node_stack *stack)
{
    const stacked parent = stack->items[stack->size];
    const uint32_t half = cell_size(parent.cell.depth + 1);
    const node *child = children_of(parent.node) + bits_count8(parent.node->octants);
    double middle[3];
    for (int i = 0; i < 3; i++)
        middle[i] = plane_at(&stack->tree->axes[i], parent.cell.low[i] + half);
    for (unsigned octant = 8; octant-- > 0;)
        if (parent.node->octants >> octant & 1) {
            push_child(stack, &parent, --child, octant, middle);
            if (child->octants)
                prefetch(child->below);
            else
                leaf_prefetch(child);
        }
}

inner inner_stack_next(inner_stack *stack)
{
    const inner next = stack->items[--stack->size];
    const node *child = children_of(next.node) + bits_count8(next.node->octants);
    for (unsigned octant = 8; octant-- > 0;)
        if (next.node->octants >> octant & 1 && (--child)->octants) {
            stack->items[stack->size++] = (inner){child, next.address << 3 | octant};
            prefetch(child->below);
        }
    return next;
}

void node_release(octree *tree, node *n)
{
    node pending[STACK_ROOM]; /* copies, so that a group can be given back before its nodes are looked at */
    size_t size = 0;
    pending[size++] = *n;
    while (size > 0) {
        node next = pending[--size];
        if (next.octants == 0) {
            leaf_release(tree, &next);
            continue;
        }
        const unsigned children = bits_count8(next.octants);
        for (unsigned i = 0; i < children; i++)
            pending[size++] = children_of(&next)[i];
        pool_give(&tree->nodes, next.below, children);
    }
}
