/* search.c - see search.h. */
#include "search.h"
#include "float_rules.h"
#include "leaf.h"

#include <math.h>

octree_search search_or_default(const octree_search *how)
{
    return how ? *how : (octree_search){0};
}

octree_status check_search(const octree_search *how)
{
    if ((unsigned)how->skip > OCTREE_SKIP_COINCIDENT || (unsigned)how->mode > OCTREE_FAST)
        return OCTREE_BAD_OPTION;
    if (!isfinite(how->epsilon))
        return OCTREE_NOT_FINITE;
    return how->epsilon < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
}

octree_status check_finite(const double position[3])
{
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    const bool finite = isfinite(position[0]) && isfinite(position[1]) && isfinite(position[2]);
    return finite ? OCTREE_OK : OCTREE_NOT_FINITE;
}

octree_status check_box(const octree_box *box)
{
    if (!box)
        return OCTREE_NULL_ARGUMENT;
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    for (int i = 0; i < 3; i++) {
        if (isnan(box->min[i]) || isnan(box->max[i]))
            return OCTREE_NOT_FINITE;
        if (box->min[i] > box->max[i])
            return OCTREE_BAD_RANGE;
    }
    return OCTREE_OK;
}

bool visit_all_below(const node *n, meter *m, octree_point_visitor visit, void *context)
{
    const node *pending[STACK_ROOM];
    size_t size = 0;
    pending[size++] = n;
    while (size > 0) {
        const node *next = pending[--size];
        m->count.nodes++;
        for (unsigned i = bits_count8(next->octants); i-- > 0;) {
            pending[size++] = &children_of(next)[i];
            prefetch(children_of(next)[i].below);
        }
        if (next->octants)
            continue;
        m->count.leaves++;
        for (uint32_t i = 0; i < next->count; i++)
            if (!visit(&leaf_points(next)[i], context))
                return false;
    }
    return true;
}
