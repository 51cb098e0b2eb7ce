/* node_set.c - see node_set.h. */
#include "node_set.h"
#include "tree.h"

static bool append(arena *memory, list *set, octree_address address)
{
    octree_address *item = list_append(memory, set, sizeof *item);
    if (item)
        *item = address;
    return item != NULL;
}

bool node_set_fill(arena *memory, list *set, const octree *tree)
{
    set->count = 0;
    node_stack stack = {.size = 0};
    stack_push(&stack, &tree->root, root_cell());
    while (stack.size > 0) {
        const stacked next = stack_pop(&stack);
        if (next.node->octants == 0)
            continue;
        if (!append(memory, set, cell_address(next.cell)))
            return false;
        stack_push_children(&stack, next);
    }
    return true;
}

/* Pre-order: by the place of the cell's lowest corner, the larger cell first. */
static bool comes_before(octree_address a, octree_address b)
{
    const unsigned a_depth = octree_address_depth(a), b_depth = octree_address_depth(b);
    const uint64_t a_code = a << 3 * (OCTREE_MAX_DEPTH - a_depth), b_code = b << 3 * (OCTREE_MAX_DEPTH - b_depth);
    return a_code != b_code ? a_code < b_code : a_depth < b_depth;
}

bool node_set_subtract(arena *memory, const list *a, const list *b, list *out)
{
    const octree_address *in_a = a->items, *in_b = b->items;
    size_t j = 0;
    for (size_t i = 0; i < a->count; i++) {
        while (j < b->count && comes_before(in_b[j], in_a[i]))
            j++;
        if ((j == b->count || in_b[j] != in_a[i]) && !append(memory, out, in_a[i]))
            return false;
    }
    return true;
}
