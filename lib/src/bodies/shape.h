/* SPDX-License-Identifier: MIT */
/* shape.h - the tests of a body against a region. Private. */
#ifndef OCTREE_SHAPE_H
#define OCTREE_SHAPE_H

#include "../query/region.h"
#include "bounds.h"

typedef struct shape {
    const octree_region *region;
    cast cast;           /* for RAY and SWEPT */
    const level *level;  /* that is searched now */
    query_bounds bounds; /* for the bodies of this level, unless the region consists of half-spaces */
} shape;

/* Make the shape of a valid region, which must outlive the shape. */
shape shape_make(const octree_region *region);

/* Prepare the search of a level. */
void shape_enter_level(shape *s, const level *l);

/* Returns whether a body has a common point with the region, and whether the body is in the region. The latter is false
 * for rays and moving boxes. */
bool shape_meets(const shape *s, const octree_body *body);
bool shape_contains(const shape *s, const octree_body *body);

/* Returns the masks of the octants of a cell. `meets`: the box around the octant's bodies may meet the region; an
 * octant that is not in `octants` may be left out. `inside`: the octant's bodies certainly match - those whose position
 * is in the octant, or if `contained` is true only if their whole boxes are in the region. */
octant_masks shape_relate(const shape *s, const cell_halves *h, unsigned octants, bool contained);

/* The same for the children of a node with boxes, which are in a child's octant. A child is `inside` if its box is in
 * the region. */
octant_masks shape_relate_children(const shape *s, const node *n);

/* Returns a bit mask of at most SCAN_POINTS points of the level, without the points whose bodies certainly have no
 * common point with the region. Bit i is for points[i]. */
uint64_t shape_filter(const shape *s, const octree_point *points, unsigned count);

/* Returns a bound of the error of any sum of products of a half-space with positions, half extents and boxes of a
 * level. */
double bound_half_space_error(const octree_half_space *space, const level *l);

/* shape_filter() for half-spaces. */
uint64_t filter_by_half_spaces(const shape *s, const octree_point *points, unsigned count);

/* Returns a box that contains the region. Its corners may be infinite. */
octree_box shape_bounds(const shape *s);

#endif
