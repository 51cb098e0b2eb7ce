/* SPDX-License-Identifier: MIT */
/* replace.c - fills a set of bodies anew: octree_bodies_replace_all(), octree_bodies_compact(), and a set that has
 * grown.
 *
 * The new contents are made in another set, which then changes places with the old one. So a failure changes nothing.
 */
#include "../exact/float_mode.h"
#include "bulk.h"

/* Exchange the contents of two sets. Each list of rows keeps the pointer to the arena of its set. */
static void swap_sets(octree_bodies *a, octree_bodies *b)
{
    const octree_bodies kept = *a;
    *a = *b;
    *b = kept;
    a->rows.memory = &a->memory;
    b->rows.memory = &b->memory;
}

octree_status rebuild_set(octree_bodies *set, const octree_body *bodies, size_t count, octree_status *statuses,
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
    for (size_t i = 0; status != OCTREE_OK && statuses && i < count; i++)
        statuses[i] = statuses[i] == OCTREE_OK ? status : statuses[i];
    if (status != OCTREE_OK && changed)
        *changed = 0;
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

/* The bodies of a set in the order of the leaves. */
typedef struct gathering {
    const octree_bodies *set;
    octree_body *bodies;
    size_t count;
} gathering;

static octree_walk_order gather_leaf(const octree_node *node, void *context)
{
    gathering *g = context;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        g->bodies[g->count++] = *row_at(&g->set->rows, row_of_point(&node->points[i]));
    return OCTREE_WALK_ON;
}

/* Insert all bodies of a set into an empty set, in the order of the leaves. */
static octree_status rebuild_in_order(octree_bodies *set)
{
    arena memory = {.allocator = set->memory.allocator};
    const size_t size = ((size_t)set->rows.count + 1) * sizeof(octree_body);
    gathering g = {set, arena_allocate(&memory, size), 0};
    if (!g.bodies)
        return OCTREE_NO_MEMORY;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        if (set->levels[i].tree)
            octree_walk(set->levels[i].tree, gather_leaf, &g);
    const octree_status status = rebuild_set(set, g.bodies, g.count, NULL, NULL);
    arena_free(&memory, g.bodies, size);
    return status;
}

octree_status octree_bodies_compact(octree_bodies *bodies)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_compact, bodies);
    const octree_status status = check_set_change(bodies);
    return status == OCTREE_OK ? rebuild_in_order(bodies) : status;
}

/* If memory is short, the set stays valid; it is only slower. */
void rebuild_if_due(octree_bodies *set)
{
    if (set->rows.count >= set->due && rebuild_in_order(set) != OCTREE_OK)
        set->due = GROWTH_BEFORE_REBUILD * (size_t)set->rows.count;
}
