/* inspect.c - a point cloud becomes a tree. */
#include "inspect.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The distance from |value| to the next double above it. */
static double ulp_of(double value)
{
    uint64_t bits;
    double next;
    value = fabs(value);
    memcpy(&bits, &value, sizeof bits);
    bits++;
    memcpy(&next, &bits, sizeof next);
    return isfinite(next) ? next - value : value - DBL_MAX / 2 > 0 ? 0x1p971 : 0;
}

static octree_box bounds_of(const cloud *c)
{
    octree_box box;
    memcpy(box.min, c->positions[0], sizeof box.min);
    memcpy(box.max, c->positions[0], sizeof box.max);
    for (size_t n = 1; n < c->count; n++) {
        for (int i = 0; i < 3; i++) {
            const double x = c->positions[n][i];
            box.min[i] = x < box.min[i] ? x : box.min[i];
            box.max[i] = x > box.max[i] ? x : box.max[i];
        }
    }
    return box;
}

/* Half the side of the cube. Halves of extents, since extents can overflow; whole ones where halves would be rounded.
 */
static double half_extent(const octree_box *bounds, int axis)
{
    const double extent = bounds->max[axis] - bounds->min[axis];
    return isfinite(extent) ? extent / 2 : bounds->max[axis] / 2 - bounds->min[axis] / 2;
}

static double half_side(const octree_box *bounds)
{
    double half = 0, largest = 0;
    bool flat = true;
    for (int i = 0; i < 3; i++) {
        flat = flat && bounds->min[i] == bounds->max[i];
        half = fmax(half, half_extent(bounds, i));
        largest = fmax(largest, fmax(fabs(bounds->min[i]), fabs(bounds->max[i])));
    }
    return fmax(flat ? 0.5 : half, 2 * ulp_of(largest));
}

octree_box inspect_world(const cloud *c)
{
    octree_box box = bounds_of(c);
    const double half = half_side(&box);
    for (int i = 0; i < 3; i++) {
        /* Rounding is monotone: what is subtracted is not negative, so no face passes a point. */
        const double slack = fmax(half - half_extent(&box, i), 0);
        box.min[i] = fmax(box.min[i] - slack, -DBL_MAX);
        box.max[i] = fmin(box.max[i] + slack, DBL_MAX);
    }
    return box;
}

/* All points in one go; refusals are counted by their statuses. */
static octree_status insert_all(const cloud *c, inspection *result)
{
    octree_point *points = malloc(c->count * sizeof *points);
    octree_status *statuses = malloc(c->count * sizeof *statuses);
    octree_status status = OCTREE_NO_MEMORY;
    for (size_t i = 0; points && i < c->count; i++) {
        memcpy(points[i].position, c->positions[i], sizeof points[i].position);
        points[i].id = i;
    }
    if (points && statuses)
        status = octree_insert_many(result->tree, points, c->count, statuses, NULL);
    for (size_t i = 0; status == OCTREE_OK && i < c->count; i++) {
        result->refused += statuses[i] == OCTREE_FULL;
        result->outside += statuses[i] == OCTREE_OUTSIDE;
    }
    free(points);
    free(statuses);
    return status;
}

bool inspect_build(const cloud *c, const octree_def *def, inspection *result, octreel_error *error)
{
    *result = (inspection){.points = c->count, .skipped = c->skipped};
    octree_status status = octree_create(def, &result->tree);
    if (status == OCTREE_OK)
        status = insert_all(c, result);
    if (status == OCTREE_OK)
        return true;
    inspect_release(result);
    return error_set(error, "the tree cannot be made: %s", octree_status_text(status));
}

void inspect_release(inspection *i)
{
    octree_destroy(i->tree);
    i->tree = NULL;
}
