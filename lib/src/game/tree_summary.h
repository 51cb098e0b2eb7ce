/* SPDX-License-Identifier: MIT */
/* tree_summary.h - digest, statistics and inner nodes of a game's tree after each tick. Private.
 *
 * A tick touches few places, and only nodes between them and the root change. So the tree is divided into subtrees of
 * a few hundred points and the nodes above those; the summary of a subtree is kept until a place in its cell is
 * touched.
 */
#ifndef OCTREE_TREE_SUMMARY_H
#define OCTREE_TREE_SUMMARY_H

#include "pool.h"
#include "tree.h"

typedef struct tree_summary {
    bool known; /* of the tree at this version, with this capacity */
    uint64_t version;
    size_t capacity;
    list touched;                   /* uint64_t: Morton codes of the places since then */
    list subtrees, subtrees_before; /* private to tree_summary.c; in pre-order */
    list inner, inner_before;       /* octree_address: the inner nodes, in pre-order */
    octree_stats stats;
    uint64_t digest;
} tree_summary;

/* Note that a point came to a place or left it. Where that fails, the next update looks at the whole tree. */
void tree_summary_touch(tree_summary *s, arena *memory, const octree *tree, const double place[3]);

/* Look at what has changed. NO_MEMORY, after which nothing is known, or OK.
 * Cost: O(subtrees + nodes and points of those that were touched). */
octree_status tree_summary_update(tree_summary *s, arena *memory, const octree *tree);

/* Splits and merges: append the nodes that are inner only since the last update, and those that no longer are. False
 * when there is no memory. */
bool tree_summary_compare(const tree_summary *s, arena *memory, list *splits, list *merges);

void tree_summary_release(tree_summary *s, arena *memory);

#endif
