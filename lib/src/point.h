/* point.h - comparing positions. Private. */
#ifndef OCTREE_POINT_H
#define OCTREE_POINT_H

#include "octree/octree.h"

static inline bool same_position(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Is this the one pair that a collision leaves out? */
static inline bool is_self(const octree_point *self, const octree_point *point)
{
    return self && self->id == point->id && same_position(self->position, point->position);
}

static inline bool box_contains(const octree_box *box, const double p[3])
{
    return box->min[0] <= p[0] && p[0] <= box->max[0] && box->min[1] <= p[1] && p[1] <= box->max[1] &&
           box->min[2] <= p[2] && p[2] <= box->max[2];
}

#endif
