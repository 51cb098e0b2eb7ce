/* collide_swept.c - what a box touches on its way from one place to another. */
#include "sweep.h"
#include "tree.h"

#include <math.h>

typedef struct sweeping {
    sweep box;
    const octree_point *self;
    octree_point_visitor visit;
    void *context;
} sweeping;

static bool visit_touched(const octree_point *point, void *context)
{
    const sweeping *s = context;
    return is_self(s->self, point) || !sweep_touches(&s->box, point->position, point->position) ||
           s->visit(point, s->context);
}

octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                   void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box start, end;
    octree_status status = octree_collision_box(from, box_size, &start);
    if (status == OCTREE_OK)
        status = octree_collision_box(to, box_size, &end);
    if (status != OCTREE_OK)
        return status;
    for (int i = 0; i < 3; i++) { /* around the whole step */
        start.min[i] = fmin(start.min[i], end.min[i]);
        start.max[i] = fmax(start.max[i], end.max[i]);
    }
    return octree_range_search(tree, &start, how, visit_touched,
                               &(sweeping){{from, to, box_size}, self, visit, context});
}
