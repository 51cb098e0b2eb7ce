/* SPDX-License-Identifier: MIT */
/* batch.h - many changes of a tree at once.
 *
 * The points that leave their position and the points that arrive at one are sorted by Morton code. restructure_tree()
 * walks the tree once and makes a plan: a leaf with enough room is edited later in place; any other changed node gets a
 * successor; unchanged nodes are shared. Planning allocates and may fail. Carrying out the plan cannot fail, so a batch
 * happens completely or not.
 */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

/* Items sorted by code. Items of one leaf may be in any order. */
typedef struct span {
    morton_item *items;
    size_t count;
} span;

typedef struct batch {
    octree *tree;
    store *store;               /* allocates nodes and points: the store of the tree, or of a task */
    struct division *division;  /* the division of the batch into tasks; null: the batch is not divided */
    const octree_point *points; /* the caller's points */
    const double (*to)[3];      /* the destinations if the batch moves points, else null */
    size_t count;
    octree_status *statuses; /* the caller's array of statuses, one for each point; may be null */
    size_t done;             /* the number of points inserted, removed or moved */

    span valid;         /* the items of the points with valid positions */
    bool repeated;      /* some valid points may have equal codes */
    span leaving;       /* the items of stored points that leave, each with the point's index in its leaf */
    span arriving;      /* the items of the caller's points that arrive */
    morton_item *lists; /* the memory of `valid`; for moves also of `leaving`, `arriving` and `spare` */
    morton_item *spare; /* scratch memory for sorting */
    list repetitions;

    bool inserts;               /* the batch only inserts points, so a grid may be used to build an empty tree */
    bool remakes;               /* so many points move that the tree is rebuilt; `valid` is then empty at first */
    bool settled;               /* the statuses of the moves are final, and no move meets a full leaf */
    bool may_be_stored;         /* an arriving point may already be stored, so this must be checked */
    bool duplicate;             /* an arriving point is already stored */
    bool overflow;              /* a moved point may meet a full leaf under OCTREE_REFUSE */
    const octree_point *stored; /* the array of stored points into which the items' indices point */
    /* the number of stored points in `cells`, where their cells follow those of the batch's points */
    size_t stored_count;
    uint32_t *cells;     /* the grid cells of the points, used in place of items (grid_fill.h) */
    unsigned grid;       /* the depth of the grid; 0: there is no grid */
    list patches, edits; /* the plan: nodes to replace, leaves to edit (division.h) */
} batch;

static inline void set_item_status(const batch *b, const morton_item *item, octree_status status)
{
    if (b->statuses)
        b->statuses[item->place] = status;
}

/* The caller's point that an item refers to, at its destination if the batch moves points. */
static inline octree_point arriving_point(const batch *b, const morton_item *item)
{
    octree_point point = b->points[item->place];
    if (b->to)
        memcpy(point.position, b->to[item->place], sizeof point.position);
    return point;
}

/* Prefetch the caller's point of an item. The points are in the caller's order, so the processor cannot predict the
 * address. */
static inline void prefetch_item(const batch *b, const morton_item *item)
{
    prefetch_memory(&b->points[item->place]);
    if (b->to)
        prefetch_memory(&b->to[item->place]);
}

/* Return the point that an item refers to: an arriving point of the caller, or a stored point. */
static inline octree_point point_of_item(const batch *b, const morton_item *item)
{
    return item->index == MORTON_NEW ? arriving_point(b, item) : b->stored[item->index];
}

/* The number of sorted items in the octant, of a cell of this depth, that contains the first item. */
size_t count_in_first_octant(const morton_item *items, size_t count, unsigned depth);

/* A cell with at most this many items becomes a leaf. The items of a leaf need no order. */
static inline size_t unsorted_limit(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_UNSORTED ? tree->def.leaf_capacity : MORTON_UNSORTED;
}

/* prepare_batch() checks all positions, sets the statuses, and sorts the valid points into `valid`. If the batch
 * `remakes` the tree, it does not fill `valid`; collect_batch_points() does so if the points are needed. */
octree_status prepare_batch(batch *b);
octree_status collect_batch_points(batch *b);

/* Check whether a position is in the world. Returns OK, OUTSIDE or NOT_FINITE. */
static inline octree_status check_in_world(const octree *tree, const double position[3])
{
    return box_contains(&tree->def.world, position) ? OCTREE_OK : check_position(tree, position);
}

/* If a code is MORTON_UNSURE, compute it exactly. Returns OK if the position is in the world, else an error. */
static inline octree_status complete_code(const octree *tree, const double position[3], uint64_t *code)
{
    const octree_status status = *code == MORTON_UNSURE ? check_position(tree, position) : OCTREE_OK;
    if (*code == MORTON_UNSURE && status == OCTREE_OK)
        *code = morton_code(tree->axes, position);
    return status;
}

void release_batch(batch *b);

/* Whether the ids of the batch are strictly ascending, as sequence numbers are. If so, no point is repeated. */
bool ids_ascend(const batch *b);

/* Store in *differ whether all ids of the batch differ. If they do, no change depends on another, unless a leaf is
 * full. False when there is no memory. */
bool check_ids_differ(const batch *b, bool *differ);

/* Called with the items of one leaf, this leaf, and the depth of its cell. The leaf is null if no node exists for the
 * items' octant. */
typedef void leaf_visitor(batch *b, node *leaf, unsigned depth, span items);

/* Visit the leaves of the valid items, by tasks if there are many items. The lists `leaving` and `arriving` of the
 * tasks are then joined, and their values of `done` are added. */
void visit_batch_leaves(batch *b, leaf_visitor *visit);

/* Remove the items that repeat an earlier pair (position, id) from `valid` and list them as repetitions. False when
 * there is no memory. */
bool drop_repeated_pairs(batch *b);

/* set_repeated_statuses() gives every repetition this status, or FULL if a full leaf refused the first point of the
 * pair. release_repetitions() frees the list of repetitions. */
void release_repetitions(batch *b);
void set_repeated_statuses(const batch *b, octree_status status);

/* Divide the items of a cell of this depth among its octants. Returns a bit mask of the octants that have items. */
unsigned divide_items_by_octant(span all, unsigned depth, span shares[8]);

/* Whether all of these items, sorted by code, lie in one cell that cannot be divided. */
bool is_inseparable(const octree *tree, cell c, const morton_item *items, size_t count);

/* Remove the leaving points from the tree and insert the arriving ones. An insertion that meets a full leaf under
 * OCTREE_REFUSE gets the status FULL; a move sets `overflow`. Returns OK or NO_MEMORY. The tree is unchanged on
 * NO_MEMORY, and for a move if `duplicate` or `overflow` is set. */
octree_status restructure_tree(batch *b);

/* Whether moves made one after the other, in any order, might meet a full leaf in the cell. This is so if one
 * indivisible cell might at some time hold more points than the capacity. Also true when there is no memory to
 * decide. */
bool can_overflow(const batch *b, const node *old, cell c, span arriving);

/* Whether moves might meet a full leaf anywhere, found by comparing the old tree with the rebuilt one. Faster than
 * can_overflow() for each cell, but sometimes true without need. Cost: O(n) for the n points in leaves that, together
 * with the leaf of the other tree, hold more than the capacity. */
bool can_overflow_when_rebuilt(const octree *tree, const node *made);

/* Build a new tree and replace the old one. Its points are those that have grid cells; without a grid, the arriving
 * points. Errors: NO_MEMORY. The tree is unchanged on an error, and if `overflow` is set. */
octree_status rebuild_from_batch(batch *b);

/* Move the points by rebuilding the tree. *settled becomes false if moves depend on one another; the tree is then
 * unchanged and the statuses are undefined. Errors: NO_MEMORY. */
octree_status remake_tree(batch *b, bool *settled);

/* Simulate the moves one by one in the given order: set their statuses and list the points that leave and arrive in the
 * end. The tree is not changed. False when there is no memory. */
bool simulate_moves_in_order(batch *b);

#endif
