/* SPDX-License-Identifier: MIT */
/* shape.h - the tests of a body against a region. Private. */
#ifndef OCTREE_SHAPE_H
#define OCTREE_SHAPE_H

#include "../query/region.h"
#include "bounds.h"

typedef struct shape {
    const octree_region *region;
    cast cast; /* for RAY and SWEPT */
    cast_bounds cast_bounds;
} shape;

/* Make the shape of a valid region, which must outlive the shape. */
shape shape_make(const octree_region *region);

/* Returns whether a body has a common point with the region, and whether the body is in the region. The latter is false
 * for rays and moving boxes. */
bool shape_meets(const shape *s, const octree_body *body);
bool shape_contains(const shape *s, const octree_body *body);

/* Returns the masks of the octants of a cell. `meets`: the box around the octant's bodies may meet the region; an
 * octant that is not in `octants` may be left out. `inside`: the octant's bodies certainly match - those whose position
 * is in the octant, or if `contained` is true only if their whole boxes are in the region. */
octant_masks shape_relate(const shape *s, const cell_halves *h, unsigned octants, bool contained);

/* Returns `near`, a bit mask of points of a level, without the points whose bodies certainly have no common point with
 * the region. Bit i is for points[i]. */
uint64_t shape_filter(const shape *s, const level *l, const octree_point *points, uint64_t near);

/* shape_filter() for one kind of region. */
uint64_t filter_by_box(const shape *s, const level *l, const octree_point *points, uint64_t near);
uint64_t filter_by_ball(const shape *s, const level *l, const octree_point *points, uint64_t near);
uint64_t filter_by_half_spaces(const shape *s, const level *l, const octree_point *points, uint64_t near);
uint64_t filter_by_cast(const shape *s, const level *l, const octree_point *points, uint64_t near);

/* Returns a box that contains the region. Its corners may be infinite. */
octree_box shape_bounds(const shape *s);

#endif
