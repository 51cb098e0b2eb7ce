/* SPDX-License-Identifier: MIT */
/* replace.c - fills a set of bodies anew: octree_bodies_replace_all(), octree_bodies_compact(), and a set that has
 * grown.
 *
 * The new contents are made in another set, which then changes places with the old one. So a failure changes nothing.
 */
#include "../exact/float_mode.h"
#include "change_many.h"

/* Exchange the contents of two sets. Each list of rows keeps the pointer to the arena of its set. */
static void swap_sets(octree_bodies *a, octree_bodies *b)
{
    const octree_bodies kept = *a;
    *a = *b;
    *b = kept;
    a->rows.memory = &a->memory;
    b->rows.memory = &b->memory;
}

/* Replace the contents of a set by bodies, unless memory runs out. */
static octree_status rebuild_set(octree_bodies *set, const octree_body *bodies, size_t count, octree_status *statuses,
                                 size_t *changed)
{
    octree_bodies *other;
    octree_status status = octree_bodies_create(&set->def, &other);
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    const unsigned begun = begin_set_callbacks(set); /* an executor of the new set must not change this set */
    status = octree_bodies_insert_many(other, bodies, count, statuses, changed);
    end_callbacks(begun);
    if (status == OCTREE_OK)
        swap_sets(set, other);
    octree_bodies_destroy(other);
    return status;
}

octree_status octree_bodies_replace_all(octree_bodies *bodies, const octree_body *added, size_t count,
                                        octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_replace_all, bodies, added, count, statuses, changed);
    const octree_status status = check_bulk(bodies, added, count, changed);
    return status == OCTREE_OK ? rebuild_set(bodies, added, count, statuses, changed)
                               : refuse_all(status, statuses, count);
}

octree_status rebuild_from_rows(octree_bodies *set, const rows *r)
{
    arena memory = {.allocator = set->memory.allocator};
    const size_t size = ((size_t)r->count + 1) * sizeof(octree_body);
    octree_body *bodies = arena_allocate(&memory, size);
    if (!bodies)
        return OCTREE_NO_MEMORY;
    const octree_status status = rebuild_set(set, bodies, rows_list(r, bodies), NULL, NULL);
    arena_free(&memory, bodies, size);
    return status;
}

octree_status octree_bodies_compact(octree_bodies *bodies)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_compact, bodies);
    const octree_status status = check_set_change(bodies);
    return status == OCTREE_OK ? rebuild_from_rows(bodies, &bodies->rows) : status;
}

/* If memory is short, the set stays valid; it is only slower. */
void rebuild_if_due(octree_bodies *set)
{
    if (set->rows.count >= set->due && rebuild_from_rows(set, &set->rows) != OCTREE_OK)
        set->due = GROWTH_BEFORE_REBUILD * (size_t)set->rows.count;
}
