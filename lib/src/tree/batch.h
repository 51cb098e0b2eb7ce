/* SPDX-License-Identifier: MIT */
/* batch.h - many changes of a tree at once.
 *
 * The points that leave and those that arrive are sorted by Morton code. restructure_tree() walks the tree once and
 * makes a plan: a leaf with enough room is edited later in place; any other changed node gets a successor; unchanged
 * nodes are shared. Planning allocates and may fail. Carrying out the plan cannot fail, so a batch happens completely
 * or not.
 */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

/* Items sorted by code; within one leaf in any order. */
typedef struct span {
    morton_item *items;
    size_t count;
} span;

typedef struct batch {
    octree *tree;
    store *store;               /* the allocator of nodes and points: the tree's, or a task's */
    struct division *division;  /* the division into tasks; null: none */
    const octree_point *points; /* the caller's array */
    const double (*to)[3];      /* destinations of a move, else null */
    size_t count;
    octree_status *statuses; /* the caller's array, one for each point; may be null */
    size_t done;             /* count of points changed */

    span valid;         /* the points with valid positions */
    bool repeated;      /* some valid points may have equal codes */
    span leaving;       /* stored points that leave, with their index in the leaf */
    span arriving;      /* the caller's points that arrive */
    morton_item *lists; /* one allocation for `valid`; for a move also for leaving, arriving and spare */
    morton_item *spare; /* scratch memory for sorting */
    list repetitions;

    bool inserts;               /* the batch only inserts: an empty tree may be built by a grid */
    bool remakes;               /* many points move, so the tree is rebuilt; `valid` is empty at first */
    bool settled;               /* the moves have their final statuses, and none meets a full leaf */
    bool may_be_stored;         /* an arriving pair may already be stored: check it */
    bool duplicate;             /* an arriving pair is already stored */
    bool overflow;              /* a moved point may meet a full leaf under OCTREE_REFUSE */
    const octree_point *stored; /* the stored points that items refer to by index */
    size_t stored_count; /* the number of stored points whose cells follow those of the batch's points in `cells` */
    uint32_t *cells;     /* grid cells of the points, in place of items (grid_fill.h) */
    unsigned grid;       /* depth of the grid; 0: no grid */
    list patches, edits; /* the plan: nodes to replace, leaves to edit (division.h) */
} batch;

static inline void set_item_status(const batch *b, const morton_item *item, octree_status status)
{
    if (b->statuses)
        b->statuses[item->place] = status;
}

/* The caller's point of an item, at its destination if it moves. */
static inline octree_point arriving_point(const batch *b, const morton_item *item)
{
    octree_point point = b->points[item->place];
    if (b->to)
        memcpy(point.position, b->to[item->place], sizeof point.position);
    return point;
}

/* Prefetch the caller's point of an item: points are in the caller's order, not in that of the items. */
static inline void prefetch_item(const batch *b, const morton_item *item)
{
    prefetch_memory(&b->points[item->place]);
    if (b->to)
        prefetch_memory(&b->to[item->place]);
}

/* The point of an item: an arriving point of the caller, or a stored point. */
static inline octree_point point_of_item(const batch *b, const morton_item *item)
{
    return item->index == MORTON_NEW ? arriving_point(b, item) : b->stored[item->index];
}

/* The number of sorted items in the same octant of a cell of this depth as the first one. */
size_t count_in_first_octant(const morton_item *items, size_t count, unsigned depth);

/* Cells with at most this many items become leaves, whose items need no order. */
static inline size_t unsorted_limit(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_UNSORTED ? tree->def.leaf_capacity : MORTON_UNSORTED;
}

/* Check all positions, set the statuses, and sort the valid points into `valid`. For a batch that `remakes` the tree,
 * the second step is left to collect_batch_points(). */
octree_status prepare_batch(batch *b);
octree_status collect_batch_points(batch *b);

/* Check whether a position is in the world. Returns OK, OUTSIDE or NOT_FINITE. */
static inline octree_status check_in_world(const octree *tree, const double position[3])
{
    return box_contains(&tree->def.world, position) ? OCTREE_OK : check_position(tree, position);
}

/* Complete a code that is MORTON_UNSURE. Returns OK if the position is in the world. */
static inline octree_status complete_code(const octree *tree, const double position[3], uint64_t *code)
{
    const octree_status status = *code == MORTON_UNSURE ? check_position(tree, position) : OCTREE_OK;
    if (*code == MORTON_UNSURE && status == OCTREE_OK)
        *code = morton_code(tree->axes, position);
    return status;
}

void release_batch(batch *b);

/* Whether the ids of the batch are strictly ascending, as when a program counts them: then no pair is repeated. */
bool ids_ascend(const batch *b);

/* Store in *differ whether all ids of the batch differ: then no change depends on another, except where a leaf is full.
 * False when there is no memory. */
bool check_ids_differ(const batch *b, bool *differ);

/* Called with items, the leaf of their cell (null if the octant has no node), and the depth of the cell. */
typedef void leaf_visitor(batch *b, node *leaf, unsigned depth, span items);

/* Visit the leaves of the valid items, by tasks if there are many. The lists `leaving` and `arriving` of the tasks are
 * concatenated, and `done` is summed. */
void visit_batch_leaves(batch *b, leaf_visitor *visit);

/* Move the items that repeat an earlier pair to the list of repetitions. False when there is no memory. */
bool drop_repeated_pairs(batch *b);

/* Set the status of all repetitions, or FULL if a full leaf refused the first of the pair. */
void release_repetitions(batch *b);
void set_repeated_statuses(const batch *b, octree_status status);

/* Divide the items of a cell of this depth by octant. Returns a mask of the octants that have items. */
unsigned divide_items_by_octant(span all, unsigned depth, span shares[8]);

/* Whether items sorted by code all lie in one cell that cannot be divided. */
bool is_inseparable(const octree *tree, cell c, const morton_item *items, size_t count);

/* Remove the leaving points from the tree and insert the arriving ones. An insertion that meets a full leaf under
 * OCTREE_REFUSE gets the status FULL; a move sets `overflow`. Returns OK or NO_MEMORY. The tree is unchanged on
 * NO_MEMORY, and for a move if `duplicate` or `overflow` is set. */
octree_status restructure_tree(batch *b);

/* Whether moves made one after the other, in any order, might meet a full leaf in the cell: whether one indivisible
 * cell might at some time hold more points than the capacity. Also true when there is no memory to decide. */
bool can_overflow(const batch *b, const node *old, cell c, span arriving);

/* The same for all moves at once, from the old tree and the rebuilt one: faster, and sometimes true without need.
 * Cost: O(n) for the n points in leaves that hold more than the capacity together with their counterpart. */
bool can_overflow_when_rebuilt(const octree *tree, const node *made);

/* Replace all stored points by the points that have grid cells or, without a grid, by the arriving ones. Errors:
 * NO_MEMORY; the tree is then unchanged, also if `overflow` is set. */
octree_status rebuild_from_batch(batch *b);

/* Move the points by rebuilding the tree. *settled becomes false if moves depend on one another; the tree is then
 * unchanged and the statuses are undefined. Errors: NO_MEMORY. */
octree_status remake_tree(batch *b, bool *settled);

/* Simulate the moves one by one in the given order: set their statuses and list the points that leave and arrive in the
 * end. The tree is not changed. False when there is no memory. */
bool simulate_moves_in_order(batch *b);

#endif
