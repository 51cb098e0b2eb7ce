/* SPDX-License-Identifier: MIT */
/* inner_nodes.h - the inner nodes of a tree before and after a tick, against which its splits and merges are held. */
#ifndef INNER_NODES_H
#define INNER_NODES_H

#include "octree/game.h"

enum { INNER_NODES_AT_MOST = 40000 };

/* In pre-order. */
typedef struct inner_nodes {
    octree_address addresses[INNER_NODES_AT_MOST];
    size_t count;
} inner_nodes;

void look_at_inner(const octree *tree, inner_nodes *inner);

/* The test fails unless the tick's splits are the inner nodes that its tree has and had not before, in pre-order, its
 * merges those that it had and has not, and its events say so. What it has takes the place of what it had. */
void assert_splits_and_merges(const octree_tick *tick, const octree *tree, inner_nodes *before);

#endif
