/* SPDX-License-Identifier: MIT */
/* diagram_slots.c - arranges the nodes of a tree across the diagram (diagram_slots.h explains the layout).
 *
 * The tree's statistics contain the number of nodes at each depth. These numbers determine the deepest level that can
 * fit. One walk copies the nodes down to this level, in pre-order. A pass from the last node to the first adds up the
 * shares, because children come after their parent. Shares are rounded up, so their sum may be larger than the room.
 * The deepest level is then dropped and the shares are added up again. A pass from the first node to the last assigns
 * the slots. This pass keeps one record for each depth: the part of the current ancestor's slot that is already
 * assigned.
 *
 * The passes first reserve room for empty octants. If the whole tree does not fit with this room, the passes are
 * repeated without it. Each pass is O(nodes copied), and there is at most one pair of passes for each of the 21
 * levels. */
#include "diagram_slots.h"
#include "octree/octree.h"

#include <stdlib.h>
#include <string.h>

#define OCTANTS 8

/* ---- Choosing levels ----------------------------------------------------------------------------------------- */

/* Return the deepest level that can fit if shares are not rounded up. The shares are counted as if the tree ended at
 * this level: one for each leaf and, if `empty` is 1, one for each empty octant. */
static unsigned find_deepest_possible_level(const octree_stats *stats, unsigned empty, size_t room)
{
    size_t leaves = 0, inner = 0; /* number of leaves and of inner nodes at the levels from the root down to `depth` */
    unsigned depth = 0;
    for (; depth < stats->depth; depth++) {
        leaves += stats->leaves_at_depth[depth];
        inner += stats->nodes_at_depth[depth] - stats->leaves_at_depth[depth];
        if ((empty ? 1 + (OCTANTS - 1) * inner : leaves + stats->nodes_at_depth[depth + 1]) > room)
            break;
    }
    return depth;
}

static size_t count_nodes_down_to(const octree_stats *stats, unsigned depth)
{
    size_t count = 0;
    for (unsigned i = 0; i <= depth; i++)
        count += stats->nodes_at_depth[i];
    return count;
}

static octree_walk_order append_node(const octree_node *node, void *context)
{
    diagram_slots *slots = context;
    slots->nodes[slots->count++] = (diagram_node){.address = node->address,
                                                  .box = node->box,
                                                  .points = node->count,
                                                  .depth = (uint8_t)node->depth,
                                                  .octants = node->octants,
                                                  .leaf = node->leaf};
    return node->depth < slots->deepest ? OCTREE_WALK_ON : OCTREE_WALK_SKIP;
}

static void drop_deepest_level(diagram_slots *slots)
{
    size_t kept = 0;
    for (size_t i = 0; i < slots->count; i++)
        if (slots->nodes[i].depth < slots->deepest)
            slots->nodes[kept++] = slots->nodes[i];
    slots->count = kept;
    slots->deepest--;
}

/* ---- Shares ------------------------------------------------------------------------------------------------- */

/* Round up to the next number of the series 1, 2, 3, 4, 6, 8, 12, 16, 24 ... */
static uint64_t round_up_shares(uint64_t shares)
{
    uint64_t step = 1;
    while (step * 2 < shares)
        step *= 2;
    return shares <= step ? step : shares <= step + step / 2 ? step + step / 2 : step * 2;
}

static bool is_expanded(const diagram_slots *slots, const diagram_node *node)
{
    return !node->leaf && node->depth < slots->deepest;
}

static uint64_t find_node_share(const diagram_slots *slots, const diagram_node *node)
{
    return is_expanded(slots, node) ? round_up_shares(node->child_shares) : 1;
}

static unsigned count_empty_octants(const diagram_node *node)
{
    unsigned empty = OCTANTS;
    for (unsigned octants = node->octants; octants; octants &= octants - 1)
        empty--;
    return empty;
}

/* Add up the shares, from the last node to the first. Return the sum of the shares of the root's octants. */
static uint64_t sum_shares(diagram_slots *slots)
{
    /* below[d]: sum of the shares of the nodes at depth d that the pass has met since the last node at depth d - 1. */
    uint64_t below[OCTREE_MAX_DEPTH + 2] = {0};
    for (size_t i = slots->count; i-- > 0;) {
        diagram_node *node = &slots->nodes[i];
        const unsigned depth = node->depth;
        node->child_shares = is_expanded(slots, node) ? below[depth + 1] + slots->empty * count_empty_octants(node) : 1;
        below[depth + 1] = 0;
        below[depth] += find_node_share(slots, node);
    }
    return slots->nodes[0].child_shares;
}

/* ---- Slots -------------------------------------------------------------------------------------------------- */

/* The part of a node's slot that is already assigned to the node's octants. */
typedef struct slot_progress {
    const diagram_node *node;
    unsigned octant; /* the next octant to which a slot is assigned */
    uint64_t assigned;
} slot_progress;

/* Assign the slot of the child at `octant`. All octants between the previously assigned child and this child are
 * empty. */
static void assign_slot(slot_progress *d, unsigned empty, unsigned octant, uint64_t share, diagram_node *child)
{
    const double left = d->node->left, width = d->node->right - left, all = (double)d->node->child_shares;
    const uint64_t from = d->assigned + empty * (octant - d->octant);
    child->left = left + width * ((double)from / all);
    child->right = left + width * ((double)(from + share) / all);
    d->assigned = from + share;
    d->octant = octant + 1;
}

static void assign_slots(diagram_slots *slots)
{
    slot_progress progress[OCTREE_MAX_DEPTH + 1];
    for (size_t i = 0; i < slots->count; i++) {
        diagram_node *node = &slots->nodes[i];
        const unsigned depth = node->depth;
        node->left = 0;
        node->right = 1;
        if (depth)
            assign_slot(&progress[depth - 1], slots->empty, octree_address_octant(node->address, depth - 1),
                        find_node_share(slots, node), node);
        progress[depth] = (slot_progress){.node = node};
    }
}

/* Copy the levels that can fit. Then drop the deepest level until the shares fit into the room. */
static bool arrange_levels(diagram_slots *slots, const octree *tree, unsigned empty, size_t room)
{
    slots->empty = empty;
    slots->deepest = find_deepest_possible_level(&slots->stats, empty, room);
    slots->count = 0;
    slots->nodes = malloc(count_nodes_down_to(&slots->stats, slots->deepest) * sizeof *slots->nodes);
    if (!slots->nodes)
        return false;
    octree_walk(tree, append_node, slots);
    while (sum_shares(slots) > room && slots->deepest > 0)
        drop_deepest_level(slots);
    return true;
}

bool diagram_arrange(diagram_slots *slots, const octree *tree, size_t room)
{
    *slots = (diagram_slots){0};
    octree_statistics(tree, &slots->stats);
    bool ok = arrange_levels(slots, tree, 1, room);
    if (ok && slots->deepest < slots->stats.depth) {
        free(slots->nodes);
        ok = arrange_levels(slots, tree, 0, room);
    }
    if (ok)
        assign_slots(slots);
    return ok;
}

void diagram_slots_release(diagram_slots *slots)
{
    free(slots->nodes);
    memset(slots, 0, sizeof *slots);
}

/* ---- Folded levels ------------------------------------------------------------------------------------------- */

typedef struct folding {
    const diagram_slots *slots;
    size_t next;               /* index of the next node in slots->nodes; the walk visits nodes in the same order */
    const diagram_node *above; /* the last visited node that is drawn one by one */
    size_t before;             /* number of points of `above` that the walk has already passed */
    diagram_visitor visit;
    void *context;
} folding;

static octree_walk_order visit_node(const octree_node *node, void *context)
{
    folding *f = context;
    if (node->depth <= f->slots->deepest) {
        f->above = &f->slots->nodes[f->next++];
        f->before = 0;
        return OCTREE_WALK_ON;
    }
    const double middle = ((double)f->before + (double)node->count / 2) / (double)f->above->points;
    f->visit(node, f->above->left + (f->above->right - f->above->left) * middle, f->context);
    f->before += node->leaf ? node->count : 0;
    return OCTREE_WALK_ON;
}

void diagram_visit_folded(const diagram_slots *slots, const octree *tree, diagram_visitor visit, void *context)
{
    folding f = {.slots = slots, .visit = visit, .context = context};
    if (slots->deepest < slots->stats.depth)
        octree_walk(tree, visit_node, &f);
}
