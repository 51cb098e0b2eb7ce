/* SPDX-License-Identifier: MIT */
/* heat.c - counts visits and points of nodes over the ticks; see heat.h. */
#include "heat.h"
#include "array.h"
#include "node_changes.h"
#include "octree/octree.h"

static const hash_map_item_type by_node = {sizeof(heat_cell), hash_map_hash_id, hash_map_ids_equal};

void heat_release(heat *h)
{
    free(h->cells);
    hash_map_release(&h->places);
    *h = (heat){0};
}

/* Returns the cell of the node at an address, or null if there is no cell. */
static heat_cell *find_cell(const heat *h, octree_address node)
{
    const uint32_t place = hash_map_find(&h->places, &by_node, h->cells, &node);
    return place == HASH_MAP_NONE ? NULL : &h->cells[place];
}

/* Find the cell of the node at an address, or add a cell. Returns null if memory runs out. */
static heat_cell *find_or_add_cell(heat *h, octree_address node)
{
    heat_cell *cell = find_cell(h, node);
    if (cell)
        return cell;
    const size_t count = h->places.count;
    if (!array_grow(&h->cells, count + 1, &h->room, sizeof *h->cells))
        return NULL;
    h->cells[count] = (heat_cell){.node = node};
    return hash_map_add(&h->places, &by_node, h->cells) ? &h->cells[count] : NULL;
}

heat_cell heat_get_cell(const heat *h, octree_address node)
{
    const heat_cell *cell = h ? find_cell(h, node) : NULL;
    return cell ? *cell : (heat_cell){0};
}

static octree_walk_order add_subtree_points(const octree_node *node, void *context)
{
    heat *h = context;
    heat_cell *cell = find_or_add_cell(h, node->address);
    h->incomplete |= !cell;
    if (cell)
        cell->points += node->count;
    return cell ? OCTREE_WALK_ON : OCTREE_WALK_STOP;
}

/* Count a visit of a node. If `below` is true, also count a visit of each of its descendants. Every node of the tree
 * already has a cell. A node that was removed after the visit is skipped. */
static void add_visit(heat *h, const octree *tree, octree_address address, bool below)
{
    octree_node node;
    if (octree_node_at(tree, address, &node) != OCTREE_OK)
        return;
    find_cell(h, address)->visits++;
    for (unsigned octant = 0; below && octant < 8; octant++)
        if (node.octants >> octant & 1)
            add_visit(h, tree, address << 3 | octant, true);
}

bool heat_add_tick(heat *h, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    octree_walk(tree, add_subtree_points, h);
    /* The last node that a query took whole. Visits are listed in pre-order, so visits of this node's descendants come
     * next. */
    octree_address taken = 0;
    for (size_t i = 0; !h->incomplete && i < tick->visit_count; i++) {
        const octree_visit *visit = &tick->visits[i];
        if (visit->touch == OCTREE_TRACE_PRUNED || (taken && is_descendant_or_self(visit->node, taken)))
            continue;
        taken = visit->taken ? visit->node : taken;
        add_visit(h, tree, visit->node, visit->taken);
    }
    return !h->incomplete;
}
