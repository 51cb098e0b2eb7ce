/* collide.c - Algorithm 5: what is within box_size of a centre on every axis. */
#include "collision.h"
#include "exact.h"
#include "float_rules.h"
#include "tree.h"

#include <math.h>

octree_status octree_collision_box(const double center[3], double box_size, octree_box *box)
{
    if (!center || !box)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (!isfinite(center[0]) || !isfinite(center[1]) || !isfinite(center[2]) || !isfinite(box_size))
        return OCTREE_NOT_FINITE;
    if (box_size < 0)
        return OCTREE_BAD_SIZE;
    for (int i = 0; i < 3; i++) {
        box->min[i] = exact_add_up(center[i], -box_size);
        box->max[i] = exact_add_down(center[i], box_size);
    }
    return OCTREE_OK;
}

octree_status octree_collide_search(const octree *tree, const double center[3], double box_size,
                                    const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                    void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box box;
    const octree_status status = octree_collision_box(center, box_size, &box);
    if (status != OCTREE_OK)
        return status;
    return octree_range_search(tree, &box, how, collision_visit, &(collision){self, visit, context});
}

octree_status octree_collide(const octree *tree, const double center[3], double box_size, const octree_point *self,
                             octree_point_visitor visit, void *context)
{
    return octree_collide_search(tree, center, box_size, self, NULL, visit, context);
}
