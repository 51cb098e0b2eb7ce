/* node_set.h - the inner nodes of a tree as a set, and how two such sets differ. Private. */
#ifndef OCTREE_NODE_SET_H
#define OCTREE_NODE_SET_H

#include "list.h"

/* For qsort: addresses in pre-order. */
int node_set_compare(const void *a, const void *b);

/* Fill a list of octree_address with the inner nodes in pre-order. False when there is no memory. */
bool node_set_fill(arena *memory, list *set, const octree *tree);

/* Append the addresses of `a` that are not in `b` to `out`. False when there is no memory. */
bool node_set_subtract(arena *memory, const list *a, const list *b, list *out);

#endif
