/* SPDX-License-Identifier: MIT */
/* order.h - many bodies in the order of the cells of a grid. Private. */
#ifndef OCTREE_BODY_ORDER_H
#define OCTREE_BODY_ORDER_H

#include "set.h"

/* The order in which rows are added: that of the cells of a grid, so that the bodies of a leaf are close together in
 * memory. Null indices: the order of the caller, for few bodies or if memory is short. */
typedef struct row_order {
    uint32_t *indices; /* owns the memory; followed by the cells of the bodies, and by the ends of the cells */
    uint32_t *ends;    /* ends[cell]: the number of bodies in the cells up to this one */
    size_t size;       /* in bytes */
    unsigned depth;    /* of the grid */
} row_order;

row_order make_order(octree_bodies *set, const octree_body *added, size_t count);
void free_order(octree_bodies *set, const row_order *order);

/* Choose the floor of an empty set that will have these bodies, unless most of them have no certain cell. */
void choose_floor(octree_bodies *set, const row_order *order, size_t count);

#endif
