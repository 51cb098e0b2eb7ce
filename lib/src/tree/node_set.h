/* node_set.h - nodes as sets, which are lists of addresses in pre-order, and how two such sets differ. Private. */
#ifndef OCTREE_NODE_SET_H
#define OCTREE_NODE_SET_H

#include "list.h"

/* For qsort: addresses in pre-order. */
int node_set_compare(const void *a, const void *b);

/* Append the addresses of `a` that are not in `b` to `out`. False when there is no memory. */
bool node_set_subtract(arena *memory, const list *a, const list *b, list *out);

#endif
