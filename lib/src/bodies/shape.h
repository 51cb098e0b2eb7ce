/* SPDX-License-Identifier: MIT */
/* shape.h - how a search treats a region: one row of functions for each kind of region. Private. */
#ifndef OCTREE_SHAPE_H
#define OCTREE_SHAPE_H

#include "../query/region.h"
#include "bounds.h"

/* A half-space, prepared for the bodies of a level. On an axis, a body reaches farther into the half-space than its
 * position by at most steps * slope; `steps` is in the id of its point (few_bodies.h). The rest of its half extents is
 * in `limit`. */
typedef struct half_space_bounds {
    double error; /* of any sum of products of the half-space with positions, half extents and boxes of the level */
    double limit;
    double slope[3];
} half_space_bounds;

typedef struct shape {
    const struct shape_kind *kind;
    const octree_region *region;
    cast cast;          /* for RAY and SWEPT */
    const level *level; /* that is searched now */
    union {             /* for the bodies of this level */
        query_bounds bounds;
        half_space_bounds half_spaces[OCTREE_MAX_HALF_SPACES];
    };
} shape;

/* What a kind of region consists of. Each kind has a file of its own, shape_KIND.c. */
typedef struct shape_kind {
    /* Check a region. Returns OK, NULL_ARGUMENT, NOT_FINITE or BAD_SIZE. */
    octree_status (*check)(const octree_region *region);
    /* Complete the shape of a valid region. Null: it is complete. */
    void (*begin)(shape *s);
    /* Return, exactly, whether a body has a common point with the region, and whether the body is in the region.
     * `contains` is null for rays and moving boxes. */
    bool (*meets)(const shape *s, const octree_body *body);
    bool (*contains)(const shape *s, const octree_body *body);
    /* Prepare the search of s->level. */
    void (*prepare)(shape *s);
    /* Relate a region to the boxes of siblings, in doubles; bit i is for sibling i. `meets`: the box may meet the
     * region. `inside`: the box is certainly in the region, and so are all of its bodies. */
    octant_masks (*relate_siblings)(const shape *s, const sibling_boxes *boxes);
    /* Test at most SCAN_POINTS points of the level, in doubles. `near`: the body may have a common point with the
     * region. `sure`: it certainly has one. Bit i is for points[i]. */
    body_masks (*filter)(const shape *s, const octree_point *points, unsigned count);
} shape_kind;

extern const shape_kind shape_of_box, shape_of_ball, shape_of_half_spaces, shape_of_cast;

/* Make the shape of a valid region, which must outlive the shape. */
void shape_make(shape *s, const octree_region *region);

/* Make the cast of a ray or of a moving box. */
cast make_cast_of_region(const octree_region *region);

#endif
