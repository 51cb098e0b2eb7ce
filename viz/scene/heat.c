/* heat.c - see heat.h. */
#include "heat.h"

#include <stdlib.h>

void heat_release(heat *h)
{
    free(h->cells);
    *h = (heat){0};
}

/* The cell of an address, or the free one where it would be. The room is a power of two and never full. */
static heat_cell *probe(const heat *h, octree_address node)
{
    size_t i = (size_t)(node * UINT64_C(0x9e3779b97f4a7c15) >> 32) & (h->room - 1);
    while (h->cells[i].node && h->cells[i].node != node)
        i = (i + 1) & (h->room - 1);
    return &h->cells[i];
}

static bool grow(heat *h)
{
    heat larger = {.count = h->count, .room = h->room ? 2 * h->room : 256};
    larger.cells = larger.room <= SIZE_MAX / sizeof *h->cells ? calloc(larger.room, sizeof *h->cells) : NULL;
    if (!larger.cells)
        return false;
    for (size_t i = 0; i < h->room; i++)
        if (h->cells[i].node)
            *probe(&larger, h->cells[i].node) = h->cells[i];
    free(h->cells);
    *h = larger;
    return true;
}

/* The cell of an address, made where there is none; null when there is no memory. */
static heat_cell *take(heat *h, octree_address node)
{
    if (2 * h->count >= h->room && !grow(h))
        return NULL;
    heat_cell *cell = probe(h, node);
    h->count += cell->node == 0;
    cell->node = node;
    return cell;
}

heat_cell heat_at(const heat *h, octree_address node)
{
    return h && h->room ? *probe(h, node) : (heat_cell){0};
}

typedef struct heat_walk {
    heat *heat;
    bool failed;
} heat_walk;

static octree_walk_order add_points(const octree_node *node, void *context)
{
    heat_walk *w = context;
    heat_cell *cell = take(w->heat, node->address);
    w->failed = !cell;
    if (cell)
        cell->points += node->count;
    return cell ? OCTREE_WALK_ON : OCTREE_WALK_STOP;
}

/* Whether an address is a node's or lies below it. */
static bool is_within(octree_address address, octree_address node)
{
    while (address > node)
        address >>= 3;
    return address == node;
}

/* A node of the tree has its cell by now. Nodes that are gone since they were asked are left out. */
static void add_visit(heat *h, const octree *tree, octree_address address, bool below)
{
    octree_node node;
    if (octree_node_at(tree, address, &node) != OCTREE_OK)
        return;
    probe(h, address)->visits++;
    for (unsigned octant = 0; below && octant < 8; octant++)
        if (node.octants >> octant & 1)
            add_visit(h, tree, address << 3 | octant, true);
}

bool heat_add_tick(heat *h, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    heat_walk w = {.heat = h};
    octree_walk(tree, add_points, &w);
    octree_address taken = 0; /* the last that was taken whole: visits are in pre-order, so those below it come next */
    for (size_t i = 0; !w.failed && i < tick->visit_count; i++) {
        const octree_visit *visit = &tick->visits[i];
        if (visit->touch == OCTREE_TOUCH_PRUNED || (taken && is_within(visit->node, taken)))
            continue;
        taken = visit->taken ? visit->node : taken;
        add_visit(h, tree, visit->node, visit->taken);
    }
    return !w.failed;
}
