/* SPDX-License-Identifier: MIT */
/* batch.h - makes many changes of a tree at once.
 *
 * The points that leave their positions, and the points that arrive at new positions, are sorted by Morton code.
 * restructure_tree() walks the tree once and makes a plan: a leaf with enough room is edited later in place; for any
 * other changed node, a successor is built, which replaces the node later; unchanged nodes are shared. Planning
 * allocates memory and may fail. Carrying out the plan cannot fail, so a batch happens completely or not at all.
 */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

/* A list of items sorted by Morton code; the items of one leaf may be in any order. An item (morton_item) is the Morton
 * code and the index of a point. */
typedef struct span {
    morton_item *items;
    size_t count;
} span;

typedef struct batch {
    octree *tree;
    store *store;               /* allocates nodes and points: the tree's store, or the store of a task */
    struct division *division;  /* the division of the batch into tasks; null: the batch is not divided */
    const octree_point *points; /* the caller's points */
    const double (*to)[3];      /* the destinations if the batch moves points, else null */
    size_t count;
    octree_status *statuses; /* the caller's array of statuses, one for each point; may be null */
    size_t done;             /* the number of points that were inserted, removed or moved */

    span valid;    /* the items of the batch's points with valid positions */
    bool repeated; /* true: some valid points may have equal Morton codes */
    /* the items of stored points that leave their position; item.index is the point's index in its leaf */
    span leaving;
    span arriving; /* the items of the caller's points that arrive at a new position */
    /* the memory of the list `valid`; for moves also of the lists `leaving`, `arriving` and `spare` */
    morton_item *lists;
    morton_item *spare; /* scratch memory for sorting */
    list repetitions;

    /* true: the batch only inserts points, so that an empty tree may be built with a grid */
    bool inserts;
    /* true: so many points move that the tree is rebuilt; prepare_batch() then leaves `valid` empty */
    bool rebuilds;
    bool settled;               /* true: the statuses of the moves are final, and no move meets a full leaf */
    bool may_be_stored;         /* true: an arriving point may already be stored, so each point must be checked */
    bool duplicate;             /* true: an arriving point is already stored */
    bool overflow;              /* true: leaves refuse points (OCTREE_REFUSE), and a moved point may meet a full leaf */
    const octree_point *stored; /* the array of stored points to which items of stored points refer */
    /* the number of stored points whose grid cells are in `cells`, after the cells of the batch's points */
    size_t stored_count;
    uint32_t *cells;     /* the grid cell of each point, if a grid is used instead of items (grid_fill.h) */
    unsigned grid;       /* the depth of the grid; 0: there is no grid */
    list patches, edits; /* the plan: patches replace nodes, edits change leaves (division.h) */
} batch;

static inline void set_item_status(const batch *b, const morton_item *item, octree_status status)
{
    if (b->statuses)
        b->statuses[item->place] = status;
}

/* Returns the caller's point to which an item refers, at its destination if the batch moves points. */
static inline octree_point arriving_point(const batch *b, const morton_item *item)
{
    octree_point point = b->points[item->place];
    if (b->to)
        memcpy(point.position, b->to[item->place], sizeof point.position);
    return point;
}

/* Prefetch the caller's point to which an item refers. The points are in the caller's order, so the processor cannot
 * predict the address. */
static inline void prefetch_item(const batch *b, const morton_item *item)
{
    prefetch_memory(&b->points[item->place]);
    if (b->to)
        prefetch_memory(&b->to[item->place]);
}

/* Returns the point to which an item refers: an arriving point of the caller, or a stored point. */
static inline octree_point point_of_item(const batch *b, const morton_item *item)
{
    return item->index == MORTON_NEW ? arriving_point(b, item) : b->stored[item->index];
}

/* The items lie in one cell of this depth and are sorted. Returns the number of items that lie in the same octant of
 * the cell as the first item. */
size_t count_in_first_octant(const morton_item *items, size_t count, unsigned depth);

/* Returns the maximum number of items in a cell whose items need no order, because the cell becomes a leaf. */
static inline size_t unsorted_limit(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_UNSORTED ? tree->def.leaf_capacity : MORTON_UNSORTED;
}

/* Returns whether rebuilding the tree is cheaper than moving this many points. */
bool is_rebuild_cheaper(const octree *tree, size_t count);

/* prepare_batch() checks all positions, sets the statuses, and sorts the valid points into `valid`. If the batch
 * rebuilds the tree (`rebuilds`), prepare_batch() does not fill `valid`; collect_batch_points() fills it if the points
 * are needed. */
octree_status prepare_batch(batch *b);
octree_status collect_batch_points(batch *b);

/* Check whether a position is in the world. Returns OK, OUTSIDE or NOT_FINITE. */
static inline octree_status check_in_world(const octree *tree, const double position[3])
{
    return box_contains(&tree->def.world, position) ? OCTREE_OK : check_position(tree, position);
}

/* If *code is MORTON_UNSURE, compute the exact code of the position. Returns OK if the position is in the world, else
 * an error. */
static inline octree_status compute_code_if_unsure(const octree *tree, const double position[3], uint64_t *code)
{
    const octree_status status = *code == MORTON_UNSURE ? check_position(tree, position) : OCTREE_OK;
    if (*code == MORTON_UNSURE && status == OCTREE_OK)
        *code = morton_code(tree->axes, position);
    return status;
}

void release_batch(batch *b);

/* Returns whether the ids of the batch are strictly ascending, as sequence numbers are. If so, no point occurs
 * twice. */
bool are_ids_ascending(const batch *b);

/* Set *differ to whether all ids of the batch differ. If all differ, no change depends on another change, unless a leaf
 * is full. Returns false if memory runs out. */
bool check_ids_differ(const batch *b, bool *differ);

/* A function that is called for one leaf, with the depth of the leaf's cell and the items in it. The leaf is null if no
 * node exists for the items' octant. */
typedef void leaf_visitor(batch *b, node *leaf, unsigned depth, span items);

/* Visit the leaves of the valid items. If there are many items, tasks visit the leaves; afterwards their lists
 * `leaving` and `arriving` are joined, and their values of `done` are added. */
void visit_batch_leaves(batch *b, leaf_visitor *visit);

/* Remove from `valid` the items that repeat an earlier pair (position, id), and list these items as repetitions.
 * Returns false if memory runs out. */
bool drop_repeated_pairs(batch *b);

/* set_statuses_of_repetitions() gives every repetition the status `status`, or FULL if a full leaf refused the first
 * point of the same pair. release_repetitions() frees the list of repetitions. */
void release_repetitions(batch *b);
void set_statuses_of_repetitions(const batch *b, octree_status status);

/* Divide the items of a cell of this depth among the cell's octants. Returns a bit mask of the octants that have
 * items. */
unsigned divide_items_by_octant(span all, unsigned depth, span shares[8]);

/* Returns whether all of these items, which are sorted by code, lie in one cell that cannot be divided. */
bool is_inseparable(const octree *tree, cell c, const morton_item *items, size_t count);

/* Remove the leaving points from the tree and insert the arriving points. Under OCTREE_REFUSE, an insertion that meets
 * a full leaf gets the status FULL, and a move that may meet one sets `overflow`. Returns OK or NO_MEMORY. The tree is
 * unchanged on NO_MEMORY, and for a batch of moves also if `duplicate` or `overflow` is set. */
octree_status restructure_tree(batch *b);

/* Returns whether moves that are made one by one might, in some order, meet a full leaf in the cell. This is so if an
 * indivisible cell might at some time hold more points than the capacity. Also returns true if memory runs out. */
bool can_overflow(const batch *b, const node *old, cell c, span arriving);

/* Returns whether moves might meet a full leaf anywhere, by comparing the old tree with the rebuilt tree. This is
 * faster than calling can_overflow() for each cell, but the result may be true although no leaf is full. Two leaves at
 * the same place in the two trees are examined only if they hold more points together than the capacity. Cost: O(points
 * in these leaves). */
bool can_overflow_when_rebuilt(const octree *tree, const node *made);

/* Build a new tree and replace the old tree by it. With a grid, the new tree has the points that have grid cells;
 * without a grid, it has the arriving points. Errors: NO_MEMORY. The tree is unchanged on an error, and if `overflow`
 * is set. */
octree_status rebuild_from_batch(batch *b);

/* Move the points by rebuilding the tree. *settled becomes false if moves depend on one another; the tree is then
 * unchanged and the statuses are undefined. Errors: NO_MEMORY. */
octree_status move_points_by_rebuild(batch *b, bool *settled);

/* Simulate the moves one by one in the given order. Set their statuses. Store in `leaving` and `arriving` the points
 * that have left and arrived after all moves. The tree is not changed. Returns false if memory runs out. */
bool simulate_moves_in_order(batch *b);

#endif
