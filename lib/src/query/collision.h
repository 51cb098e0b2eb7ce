/* collision.h - a visitor that leaves out the one pair that collides with the others. Private. */
#ifndef OCTREE_COLLISION_H
#define OCTREE_COLLISION_H

#include "point.h"

typedef struct collision {
    const octree_point *self; /* may be null */
    octree_point_visitor visit;
    void *context;
} collision;

static inline bool collision_visit(const octree_point *point, void *context)
{
    const collision *c = context;
    return is_self(c->self, point) || c->visit(point, c->context);
}

#endif
