/* SPDX-License-Identifier: MIT */
/* tree_summary.h - digest, statistics and inner nodes of a game's tree after each tick. Private.
 *
 * A tick changes points at few positions. Only the nodes on the paths from the root to these positions change. So the
 * tree is divided into subtrees of a few hundred points, and the nodes above these subtrees. The summary of a subtree
 * is kept until a point in its cell changes. The alternative, a walk over the whole tree, would cost more than the tick
 * itself in a large tree.
 */
#ifndef OCTREE_TREE_SUMMARY_H
#define OCTREE_TREE_SUMMARY_H

#include "../tree/pool.h"
#include "../tree/tree.h"

typedef struct tree_summary {
    bool known; /* true: the lists are valid, for the tree with this version and capacity */
    uint64_t version;
    size_t capacity;
    /* the Morton codes (uint64_t) of the positions at which points were inserted or removed since the last update */
    list touched;
    /* the subtrees as they were after and before the last update, in pre-order; the item type is in tree_summary.c */
    list subtrees, subtrees_before;
    /* the addresses of the inner nodes after and before the last update, in pre-order */
    list inner, inner_before;
    octree_stats stats;
    uint64_t digest;
} tree_summary;

/* Record that a point was inserted at or removed from a position. If memory runs out, the next update walks the whole
 * tree. */
void tree_summary_record_change(tree_summary *s, arena *memory, const octree *tree, const double position[3]);

/* Update the summary. Returns false if memory runs out; the next update then walks the whole tree. Cost: O(subtrees +
 * nodes and points of the subtrees that changed). */
bool tree_summary_update(tree_summary *s, arena *memory, const octree *tree);

/* Compare the inner nodes before and after the last update. Append the addresses of new inner nodes to `splits`, and
 * the addresses of nodes that ceased to be inner nodes to `merges`. Returns false if memory runs out. */
bool tree_summary_list_splits_and_merges(const tree_summary *s, arena *memory, list *splits, list *merges);

void tree_summary_release(tree_summary *s, arena *memory);

#endif
