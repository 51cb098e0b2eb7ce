/* SPDX-License-Identifier: MIT */
/* inner_nodes.h - the inner nodes of a tree before and after a tick, to check the splits and merges of the tick. */
#ifndef INNER_NODES_H
#define INNER_NODES_H

#include "octree/game.h"

enum { INNER_NODES_AT_MOST = 40000 };

/* The inner nodes of a tree, in pre-order. */
typedef struct inner_nodes {
    octree_address addresses[INNER_NODES_AT_MOST];
    size_t count;
} inner_nodes;

void list_inner_nodes(const octree *tree, inner_nodes *inner);

/* The test fails unless the tick's splits are exactly the new inner nodes, its merges exactly the former inner nodes,
 * both in pre-order, and its events agree. Then *before becomes the present inner nodes. */
void assert_splits_and_merges(const octree_tick *tick, const octree *tree, inner_nodes *before);

#endif
