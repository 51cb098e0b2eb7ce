/* collide_swept.c - what a box touches on its way from one place to another: the box around the whole step by keys, its
 * hull by doubles where they can tell, and the points that are left exactly.
 */
#include "box_shape.h"
#include "collision.h"
#include "hull.h"
#include "search.h"

typedef struct swept_shape {
    box_shape around; /* first: of the whole step */
    hull hull;
    sweep box;
} swept_shape;

static octant_masks enter(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    swept_shape *s = shape;
    const octant_masks around = box_shape_enter(&s->around, tree, depth, octant);
    if ((around.meets & (around.meets - 1)) == 0) /* one octant: its own will tell more */
        return (octant_masks){around.meets, 0};
    const octant_masks between = hull_octants(&s->hull, s->around.low[depth], depth);
    return (octant_masks){around.meets & between.meets, around.inside & between.inside};
}

/* Of a point in the box around the step. */
static bool is_touched(const swept_shape *s, const double p[3])
{
    bool sure = true;
    for (unsigned k = 0; k < s->hull.face_count; k++) {
        const double side = fabs(hull_side(&s->hull, &s->hull.faces[k], p));
        if (side > s->hull.faces[k].reach)
            return false;
        sure = sure && side < s->hull.faces[k].whole;
    }
    return sure || sweep_touches(&s->box, p, p);
}

static unsigned scan(const void *shape, const octree_point *points, unsigned count, uint8_t hits[])
{
    const swept_shape *s = shape;
    const unsigned around = box_shape_scan(&s->around, points, count, hits);
    unsigned found = 0;
    for (unsigned i = 0; i < around; i++) {
        hits[found] = hits[i];
        found += is_touched(s, points[hits[i]].position);
    }
    return found;
}

static void run_query(const octree *tree, const sweep *box, const octree_box *around, const octree_search *how,
                      collision *visitor)
{
    swept_shape shape;
    shape.around = box_shape_make(tree, around, around);
    shape.box = *box;
    const bool slanting = hull_make(&shape.hull, tree, box);
    region r = {
        .tree = tree,
        .shape = &shape,
        .enter = slanting ? enter : box_shape_enter, /* along an axis the box around the step is all */
        .scan = slanting ? scan : box_shape_scan,
        .visit = collision_visit,
        .context = visitor,
        .meter = {.how = how},
    };
    octant_masks root = box_shape_root(&shape.around, tree);
    if (slanting)
        root.inside = 0;
    region_descend(&r, root);
    meter_report(&r.meter);
}

octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                   void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box start, end;
    const octree_search search = search_or_default(how);
    octree_status status = octree_collision_box(from, box_size, &start);
    if (status == OCTREE_OK)
        status = octree_collision_box(to, box_size, &end);
    if (status == OCTREE_OK)
        status = check_search(&search);
    if (status != OCTREE_OK)
        return status;
    for (int i = 0; i < 3; i++) { /* around the whole step */
        start.min[i] = fmin(start.min[i], end.min[i]);
        start.max[i] = fmax(start.max[i], end.max[i]);
    }
    run_query(tree, &(sweep){from, to, box_size}, &start, &search, &(collision){self, visit, context});
    return OCTREE_OK;
}
