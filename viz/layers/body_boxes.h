/* SPDX-License-Identifier: MIT */
/* body_boxes.h - the boxes of bodies with extent, for the layers that draw them. */
#ifndef LAYERS_BODY_BOXES_H
#define LAYERS_BODY_BOXES_H

#include "octree/types.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

static inline bool has_extent(const double half[3])
{
    return half[0] > 0 || half[1] > 0 || half[2] > 0;
}

/* Returns the box of a body, rounded, and cut at the largest double. */
static inline octree_box box_of_body(const octree_body *body)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = fmax(body->position[i] - body->half[i], -DBL_MAX);
        box.max[i] = fmin(body->position[i] + body->half[i], DBL_MAX);
    }
    return box;
}

#endif
