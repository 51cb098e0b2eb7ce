/* SPDX-License-Identifier: MIT */
/* tree_summary.h - digest, statistics and inner nodes of a game's tree after each tick. Private.
 *
 * A tick changes points at few positions. Only the nodes on the paths from the root to these positions change. So the
 * tree is divided into subtrees of a few hundred points and the nodes above them. The summary of a subtree is kept
 * until a point in its cell changes. The alternative, a walk over the whole tree, would cost more than the tick itself
 * in a large tree.
 */
#ifndef OCTREE_TREE_SUMMARY_H
#define OCTREE_TREE_SUMMARY_H

#include "../tree/pool.h"
#include "../tree/tree.h"

typedef struct tree_summary {
    bool known; /* true: the lists are valid, for the tree with this version and capacity */
    uint64_t version;
    size_t capacity;
    list touched; /* the positions that changed since the last update: Morton codes (uint64_t) */
    /* the subtrees after and before the last update, in pre-order; the item type is in tree_summary.c */
    list subtrees, subtrees_before;
    /* the addresses of the inner nodes after and before the last update, in pre-order */
    list inner, inner_before;
    octree_stats stats;
    uint64_t digest;
} tree_summary;

/* Record that a point was inserted at or removed from a position. If there is no memory, the next update walks the
 * whole tree. */
void tree_summary_record_change(tree_summary *s, arena *memory, const octree *tree, const double position[3]);

/* Update the summary. Returns false when there is no memory; the next update then walks the whole tree. Cost:
 * O(subtrees + nodes and points of the subtrees that changed). */
bool tree_summary_update(tree_summary *s, arena *memory, const octree *tree);

/* Append the nodes that became inner nodes in the last update to `splits`. Append the nodes that ceased to be inner
 * nodes to `merges`. False when there is no memory. */
bool tree_summary_list_splits_and_merges(const tree_summary *s, arena *memory, list *splits, list *merges);

void tree_summary_release(tree_summary *s, arena *memory);

#endif
