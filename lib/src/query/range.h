/* range.h - a visitor that leaves out the one pair that collides with the others. Private. */
#ifndef OCTREE_RANGE_H
#define OCTREE_RANGE_H

#include "point.h"

typedef struct collision {
    const octree_point *self; /* may be null */
    octree_point_visitor visit;
    void *context;
} collision;

bool collision_visit(const octree_point *point, void *context);

#endif
