/* SPDX-License-Identifier: MIT */
/* batch.h - many changes of a tree at once.
 *
 * What leaves and what arrives is sorted by Morton code. restructure() then goes once down the tree and up again and
 * plans: a leaf with room for what arrives is edited later, in place; another node that changes is made anew from its
 * old self; what does not change is shared. Last of all the plan is carried out, which cannot fail: so a batch either
 * happens or does not.
 */
#ifndef OCTREE_BATCH_H
#define OCTREE_BATCH_H

#include "morton_sort.h"
#include "tree.h"

/* Sorted items: by code and, within one leaf, in any order. */
typedef struct span {
    morton_item *items;
    size_t count;
} span;

typedef struct batch {
    octree *tree;
    store *store;               /* where nodes and points come from: the tree's, or a task's */
    struct division *division;  /* into tasks; null: into none */
    const octree_point *points; /* the caller's */
    const double (*to)[3];      /* where they move to; null where they do not move */
    size_t count;
    octree_status *statuses; /* the caller's, one for each point; may be null */
    size_t done;             /* how many points were changed */

    span valid;         /* the points with valid positions, by code; in cells that are leaves in any order */
    bool repeated;      /* some of them may have the same code */
    span leaving;       /* stored points that leave, with their index */
    span arriving;      /* points of the caller's that arrive */
    morton_item *lists; /* the memory of `valid`, and of a move of all three and of a spare list, for sorting */
    morton_item *spare;
    list repetitions;

    bool inserts;               /* an empty tree may be built by a grid */
    bool remakes;               /* many points move: `valid` is empty at first */
    bool settled;               /* the moves have their statuses: none meets a full leaf */
    bool may_be_stored;         /* look whether an arriving pair is stored already */
    bool duplicate;             /* one is */
    bool overflow;              /* a moved point may meet a full leaf */
    const octree_point *stored; /* those among the items that nodes are built of */
    size_t stored_count;        /* with cells, after those of the batch's points */
    uint32_t *cells;            /* of a grid of this depth, in place of items (grid_fill.h) */
    unsigned grid;
    list patches, edits; /* the plan */
} batch;

static inline void set_status(const batch *b, const morton_item *item, octree_status status)
{
    if (b->statuses)
        b->statuses[item->place] = status;
}

/* The point that an item of the caller's becomes. */
static inline octree_point arriving_point(const batch *b, const morton_item *item)
{
    octree_point point = b->points[item->place];
    if (b->to)
        memcpy(point.position, b->to[item->place], sizeof point.position);
    return point;
}

/* Start loading what an item of the caller's reads: those are scattered, in the caller's order. */
static inline void prefetch_item(const batch *b, const morton_item *item)
{
    prefetch(&b->points[item->place]);
    if (b->to)
        prefetch(&b->to[item->place]);
}

/* A point of the caller's that arrives, or one that is stored. */
static inline octree_point batch_point(const batch *b, const morton_item *item)
{
    return item->index == MORTON_NEW ? arriving_point(b, item) : b->stored[item->index];
}

/* How many of the sorted items lie in the same octant of a cell of this depth as the first of them. */
size_t octant_share(const morton_item *items, size_t count, unsigned depth);

/* How many items of a cell need not be sorted where they become a leaf. */
static inline size_t unsorted_count(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_UNSORTED ? tree->def.leaf_capacity : MORTON_UNSORTED;
}

/* Check all positions, and sort those that are valid into `valid`. Sets each point's status: OK, or why it is not
 * among them. A batch that `remakes` the tree leaves that to batch_collect(). */
octree_status batch_begin(batch *b);
octree_status batch_collect(batch *b);

/* OK, OUTSIDE or NOT_FINITE. */
static inline octree_status check_inside(const octree *tree, const double position[3])
{
    return box_contains(&tree->def.world, position) ? OCTREE_OK : check_position(tree, position);
}

void batch_end(batch *b);

/* Whether no two points of the batch have one id: then no change depends on another, but where a leaf is full. False
 * when there is no memory. */
bool ids_differ(const batch *b, bool *differ);

/* Told the leaf of some items, and its depth; or null where there is none. */
typedef void leaf_visitor(batch *b, node *leaf, unsigned depth, span items);

/* Visit the leaves that the valid items lie in, maybe by tasks: of the parts of the batch leaving, arriving and done
 * are put together. */
void batch_visit_leaves(batch *b, leaf_visitor *visit);

/* Drop the items that repeat the pair of an earlier one, and list them. False when there is no memory. */
bool drop_repetitions(batch *b);

/* Give them their status, unless the earlier one was refused by a full leaf, as they would then be too. */
void release_repetitions(batch *b);
void set_repeated_statuses(const batch *b, octree_status status);

/* The items of each octant of a cell of this depth. Returns the octants that have any. */
unsigned share_out(span all, unsigned depth, span shares[8]);

/* The sorted codes of more points than the capacity: whether they all lie in one cell that cannot be divided. */
bool inseparable(const octree *tree, cell c, const morton_item *items, size_t count);

/* Take what leaves out of the tree, and put in what arrives. Points that meet a full leaf under OCTREE_REFUSE are
 * given their status, if they are inserted; those that move set `overflow`. NO_MEMORY, or OK: the tree is then changed
 * unless `duplicate` or `overflow` is set for a move. */
octree_status restructure(batch *b);

/* Where a leaf may come to hold more points than its capacity while points move one after the other, in whatever order:
 * whether there may be more than that in one cell that cannot be divided. True also when there is no memory to find
 * out. */
bool may_overflow(const batch *b, const node *old, cell c, span arriving);

/* The same where the tree is built anew, of the points where they go to, for all moves at once: quicker, and sometimes
 * true where it need not be. Cost: O(n) for n points where leaves of both trees hold more than the capacity together.
 */
bool may_overflow_anew(const octree *tree, const node *made);

/* Put the points that have cells, or where there is no grid all that arrives, in place of what is stored. Errors:
 * NO_MEMORY; the tree is unchanged then, and when `overflow` is set. */
octree_status build_anew(batch *b);

/* Move the points while the tree is built anew. *settled is false where moves depend on one another; the tree is then
 * unchanged, and the statuses are not known. Errors: NO_MEMORY. */
octree_status remake_tree(batch *b, bool *settled);

/* Give the moves their statuses one after the other in the order given, and list what leaves and arrives in the end.
 * The tree is not changed. False when there is no memory. */
bool resolve_moves_in_order(batch *b);

#endif
