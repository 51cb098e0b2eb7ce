/* SPDX-License-Identifier: MIT */
/* snapshot.c - a copy of the nodes and bodies of one level, for algorithms that compare many bodies with many.
 *
 * The order of points in a leaf depends on the history of the tree, and rows lie anywhere in memory. In a snapshot the
 * bodies of a leaf are sorted, so that the results of an algorithm are a function of the bodies, and all bodies lie in
 * the order of the leaves, so that the algorithm runs through memory in order. Copying costs O(n log M).
 *
 * Boxes are stored as columns: two boxes are compared at once, and all without branches. Their faces are rounded, and
 * rounding is monotone: bodies that have a common point have boxes that have one.
 */
#include "snapshot.h"
#include "../tree/leaf.h"
#include "boxes.h"

#include <stdlib.h>

/* ---- Compare boxes ------------------------------------------------------------------------------------------ */

#ifdef OCTREE_SSE2
static uint64_t find_meeting_pairs(const double *const min[3], const double *const max[3], size_t count,
                                   const octree_box *box)
{
    uint64_t found = 0;
    __m128d low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = _mm_set1_pd(box->min[k]);
        high[k] = _mm_set1_pd(box->max[k]);
    }
    for (size_t i = 0; i < count; i += 2) {
        __m128d meets = _mm_cmple_pd(_mm_loadu_pd(&min[0][i]), high[0]);
        meets = _mm_and_pd(meets, _mm_cmple_pd(low[0], _mm_loadu_pd(&max[0][i])));
        for (int k = 1; k < 3; k++) {
            meets = _mm_and_pd(meets, _mm_cmple_pd(_mm_loadu_pd(&min[k][i]), high[k]));
            meets = _mm_and_pd(meets, _mm_cmple_pd(low[k], _mm_loadu_pd(&max[k][i])));
        }
        found |= (uint64_t)_mm_movemask_pd(meets) << i;
    }
    return found & UINT64_MAX >> (BOXES_AT_ONCE - count);
}
#else
static uint64_t find_meeting_pairs(const double *const min[3], const double *const max[3], size_t count,
                                   const octree_box *box)
{
    uint64_t found = 0;
    for (size_t i = 0; i < count; i++) {
        bool meets = true;
        for (int k = 0; k < 3; k++)
            meets &= (min[k][i] <= box->max[k]) & (box->min[k] <= max[k][i]);
        found |= (uint64_t)meets << i;
    }
    return found;
}
#endif

uint64_t find_meeting_boxes(const box_columns *boxes, size_t first, size_t count, const octree_box *box)
{
    const double *const min[3] = {boxes->min[0] + first, boxes->min[1] + first, boxes->min[2] + first};
    const double *const max[3] = {boxes->max[0] + first, boxes->max[1] + first, boxes->max[2] + first};
    return count ? find_meeting_pairs(min, max, count, box) : 0;
}

/* ---- Copy the leaves ---------------------------------------------------------------------------------------- */

/* Insertion sort: leaves are small, and most ids differ. */
static void sort_bodies(octree_body *bodies, size_t count)
{
    if (count > BOXES_AT_ONCE) {
        qsort(bodies, count, sizeof *bodies, octree_compare_bodies);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        const octree_body body = bodies[i];
        size_t at = i;
        while (at > 0 && (bodies[at - 1].id > body.id ||
                          (bodies[at - 1].id == body.id && octree_compare_bodies(&bodies[at - 1], &body) > 0)))
            at--;
        memmove(&bodies[at + 1], &bodies[at], (i - at) * sizeof *bodies);
        bodies[at] = body;
    }
}

static void store_box(snapshot *s, size_t index, octree_box *around)
{
    const octree_body *body = &s->bodies[index];
    octree_box box;
    for (int k = 0; k < 3; k++) {
        box.min[k] = s->boxes.min[k][index] = body->position[k] - body->half[k];
        box.max[k] = s->boxes.max[k][index] = body->position[k] + body->half[k];
    }
    include_box(around, &box);
}

static void copy_leaf(snapshot *s, const octree_bodies *set, const node *leaf, group *g)
{
    octree_body *bodies = s->bodies + g->first;
    for (uint32_t i = 0; !set->points && i < leaf->count && i < POOL_MAX_UNITS; i++)
        prefetch_memory(row_at(&set->rows, row_of_point(&leaf_points(leaf)[i])));
    for (uint32_t i = 0; i < leaf->count; i++) {
        octree_body scratch;
        bodies[i] = *load_body(set, &leaf_points(leaf)[i], &scratch);
    }
    sort_bodies(bodies, leaf->count);
    for (uint32_t i = 0; i < leaf->count; i++)
        store_box(s, g->first + i, &g->box);
}

/* ---- Copy the nodes ----------------------------------------------------------------------------------------- */

/* Copy a node to the group at an index, and its descendants to the end of the array. `first` is the number of bodies
 * that are copied already. Returns false if memory runs out. */
static bool copy_node(snapshot *s, const octree_bodies *set, const node *n, size_t first, size_t at)
{
    const unsigned children = bits_count8(n->octants);
    group made = {make_empty_box(), first, n->count, s->groups.count, children};
    for (unsigned i = 0; i < children; i++)
        if (!list_append(s->memory, &s->groups, sizeof(group)))
            return false;
    for (unsigned i = 0; i < children; i++) {
        if (!copy_node(s, set, &children_of(n)[i], first, made.child + i))
            return false;
        first += children_of(n)[i].count;
        include_box(&made.box, &group_at(s, made.child + i)->box);
    }
    if (children == 0)
        copy_leaf(s, set, n, &made);
    ((group *)s->groups.items)[at] = made;
    return true;
}

/* The columns are one allocation, which has room for one box more in each column. */
static bool allocate_bodies(snapshot *s, size_t count)
{
    if (count > SIZE_MAX / (6 * sizeof(double) + sizeof(octree_body)) - 1)
        return false;
    s->room = count + 1;
    s->bodies = arena_allocate(s->memory, s->room * sizeof *s->bodies);
    double *columns = s->bodies ? arena_allocate(s->memory, 6 * s->room * sizeof *columns) : NULL;
    for (size_t k = 0; columns && k < 3; k++) {
        s->boxes.min[k] = columns + k * s->room;
        s->boxes.max[k] = columns + (k + 3) * s->room;
        s->boxes.min[k][count] = s->boxes.max[k][count] = 0;
    }
    return columns != NULL;
}

bool snapshot_make(snapshot *s, const octree_bodies *set, const level *l, arena *memory)
{
    *s = (snapshot){.memory = memory};
    return allocate_bodies(s, octree_count(l->tree)) && list_append(memory, &s->groups, sizeof(group)) &&
           copy_node(s, set, &l->tree->root, 0, 0);
}

void snapshot_release(snapshot *s)
{
    arena_free(s->memory, s->bodies, s->room * sizeof *s->bodies);
    arena_free(s->memory, s->boxes.min[0], 6 * s->room * sizeof(double));
    list_release(s->memory, &s->groups, sizeof(group));
}
