/* range.c - Algorithm 4: the points in a closed box. */
#include "box_shape.h"
#include "exact.h"
#include "search.h"

#include <math.h>

/* The box moved out by epsilon, rounded so that nothing beyond it counts as inside. */
static octree_box widen(const octree_box *box, double epsilon)
{
    octree_box wide;
    for (int i = 0; i < 3; i++) {
        wide.min[i] = isfinite(box->min[i]) ? exact_add_up(box->min[i], -epsilon) : box->min[i];
        wide.max[i] = isfinite(box->max[i]) ? exact_add_down(box->max[i], epsilon) : box->max[i];
    }
    return wide;
}

/* Visit or count. The box has been checked. */
static size_t run_query(const octree *tree, const octree_box *box, const octree_search *how, octree_point_visitor visit,
                        void *context)
{
    const octree_box wide = widen(box, how->epsilon);
    box_shape shape = box_shape_make(tree, box, how->epsilon > 0 ? &wide : box);
    region r = {
        .tree = tree,
        .shape = &shape,
        .enter = box_shape_enter,
        .scan = box_shape_scan,
        .visit = visit,
        .context = context,
        .meter = {.how = how},
    };
    region_descend(&r, box_shape_root(&shape, tree));
    meter_report(&r.meter);
    return r.count;
}

octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_box(box);
    if (status == OCTREE_OK)
        status = check_search(&search);
    if (status == OCTREE_OK)
        run_query(tree, box, &search, visit, context);
    return status;
}

octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context)
{
    return octree_range_search(tree, box, NULL, visit, context);
}

octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count)
{
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    const octree_status status = tree ? check_box(box) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK)
        *count = run_query(tree, box, &(octree_search){0}, NULL, NULL);
    return status;
}
