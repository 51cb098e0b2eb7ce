/* inspect.c - a point cloud becomes a tree. */
#include "inspect.h"

#include <float.h>
#include <math.h>
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

/* The side of the cube. Where the extent of the points overflows, the side is infinite. */
static double side_of(const octree_box *bounds)
{
    double side = 0, largest = 0;
    for (int i = 0; i < 3; i++) {
        side = fmax(side, bounds->max[i] - bounds->min[i]);
        largest = fmax(largest, fmax(fabs(bounds->min[i]), fabs(bounds->max[i])));
    }
    return fmax(side > 0 ? side : 1, 4 * ulp_of(largest));
}

octree_box inspect_world(const cloud *c)
{
    octree_box box = bounds_of(c);
    const double side = side_of(&box);
    for (int i = 0; i < 3; i++) {
        /* Rounding is monotone: what is subtracted is not negative, so no face passes a point. */
        const double slack = (side - (box.max[i] - box.min[i])) / 2;
        box.min[i] = fmax(box.min[i] - (slack > 0 ? slack : 0), -DBL_MAX);
        box.max[i] = fmin(box.max[i] + (slack > 0 ? slack : 0), DBL_MAX);
    }
    return box;
}

bool inspect_build(const cloud *c, const octree_def *def, inspection *result, record_error *error)
{
    *result = (inspection){.points = c->count, .skipped = c->skipped};
    octree_status status = octree_create(def, &result->tree);
    if (status != OCTREE_OK)
        return record_fail(error, "the tree cannot be made: %s", octree_status_text(status));
    for (size_t i = 0; i < c->count; i++) {
        status = octree_insert(result->tree, c->positions[i], i);
        result->refused += status == OCTREE_FULL;
        result->outside += status == OCTREE_OUTSIDE;
        if (status != OCTREE_OK && status != OCTREE_FULL && status != OCTREE_OUTSIDE) {
            inspect_release(result);
            return record_fail(error, "point %zu cannot be inserted: %s", i, octree_status_text(status));
        }
    }
    return true;
}

void inspect_release(inspection *i)
{
    octree_destroy(i->tree);
    i->tree = NULL;
}
