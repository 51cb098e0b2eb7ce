/* SPDX-License-Identifier: MIT */
/* point_world.c - finds the smallest cube around points, which becomes the world of a tree. */
#include "point_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Returns the distance from |value| to the next larger double. */
static double find_spacing_above(double value)
{
    value = fabs(value);
    return value < DBL_MAX ? nextafter(value, INFINITY) - value : 0x1p971;
}

static octree_box find_bounds(const void *positions, size_t stride, size_t count)
{
    octree_box box;
    memcpy(box.min, positions, sizeof box.min);
    memcpy(box.max, positions, sizeof box.max);
    for (size_t n = 1; n < count; n++) {
        const double *position = (const void *)((const char *)positions + n * stride);
        for (int i = 0; i < 3; i++) {
            const double x = position[i];
            box.min[i] = x < box.min[i] ? x : box.min[i];
            box.max[i] = x > box.max[i] ? x : box.max[i];
        }
    }
    return box;
}

/* Returns half of the extent of a box along an axis. The result is right even if the whole extent overflows. */
static double find_half_extent(const octree_box *bounds, int axis)
{
    const double extent = bounds->max[axis] - bounds->min[axis];
    return isfinite(extent) ? extent / 2 : bounds->max[axis] / 2 - bounds->min[axis] / 2;
}

static double find_half_side(const octree_box *bounds)
{
    double half = 0, largest = 0;
    bool flat = true;
    for (int i = 0; i < 3; i++) {
        flat = flat && bounds->min[i] == bounds->max[i];
        half = fmax(half, find_half_extent(bounds, i));
        largest = fmax(largest, fmax(fabs(bounds->min[i]), fabs(bounds->max[i])));
    }
    return fmax(flat ? 0.5 : half, 2 * find_spacing_above(largest));
}

octree_box find_point_world(const void *positions, size_t stride, size_t count)
{
    octree_box box = find_bounds(positions, stride, count);
    const double half = find_half_side(&box);
    for (int i = 0; i < 3; i++) {
        /* The slack is never negative, and rounding is monotone. Therefore rounding never moves a face of the cube
         * inward past a point. */
        const double slack = fmax(half - find_half_extent(&box, i), 0);
        box.min[i] = fmax(box.min[i] - slack, -DBL_MAX);
        box.max[i] = fmin(box.max[i] + slack, DBL_MAX);
    }
    return box;
}
