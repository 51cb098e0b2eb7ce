/* SPDX-License-Identifier: MIT */
/* order.h - many bodies in the order of the cells of a fine grid. Private. */
#ifndef OCTREE_BODY_ORDER_H
#define OCTREE_BODY_ORDER_H

#include "set.h"

/* The order in which rows are added: that of the cells of a fine grid, so that the bodies of a leaf are close together
 * in memory. Null keys: the order of the caller, because memory is short. */
typedef struct row_order {
    uint64_t *keys; /* sorted; the upper half is the number of a cell, the lower half the index of a body; owned */
    size_t count;
    unsigned depth; /* of the grid */
} row_order;

row_order make_order(octree_bodies *set, const octree_body *added, size_t count);
void free_order(octree_bodies *set, const row_order *order);

/* Returns the index of the body that is the i-th one in the order. */
static inline size_t body_in_order(const row_order *order, size_t i)
{
    return order->keys ? (uint32_t)order->keys[i] : i;
}

static inline uint32_t cell_in_order(const row_order *order, size_t i)
{
    return (uint32_t)(order->keys[i] >> 32);
}

/* Returns whether the order is that of cells, and each has so few bodies that comparing them all is fast. */
bool has_sparse_cells(const row_order *order);

/* Choose the floor of an empty set that will have these bodies. */
void choose_floor(octree_bodies *set, const row_order *order);

#endif
