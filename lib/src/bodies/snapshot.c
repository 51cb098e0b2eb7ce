/* SPDX-License-Identifier: MIT */
/* snapshot.c - a copy of the nodes and bodies of one level, for algorithms that compare many bodies with many.
 *
 * The order of points in a leaf depends on the history of the tree, and rows lie anywhere in memory. In a snapshot the
 * bodies of a leaf are sorted, so that the results of an algorithm are a function of the bodies, and all bodies lie in
 * the order of the leaves, so that the algorithm runs through memory in order. Copying costs O(n M).
 *
 * Boxes are floats in columns, so that four are compared at once and without branches. Each step from the face of a
 * body to a float is monotone: the sum, the difference, the product and the conversion. So bodies that have a common
 * point have boxes that have one. Others may have one too: the caller decides by the bodies.
 *
 * Comparing two clusters has a fixed cost, and leaves may have few bodies: if each cell of a depth has a little more
 * than the capacity, all are divided, and a leaf has an eighth of that. So small nodes become one cluster.
 */
#include "snapshot.h"
#include "../query/search.h"
#include "../tree/leaf.h"

#include <stdlib.h>

/* A node with at most so many bodies is a cluster without children: those of eight full leaves, but not too many. With
 * 64 at most, the pairs of 4e5 equal bodies take 1.25 times as long (octree-bodies-bench --n 4e5). */
enum { LEAVES_IN_CLUSTER = 8, CLUSTER_AT_MOST = 128 };

/* ---- Boxes of floats ---------------------------------------------------------------------------------------- */

/* In a subnormal world, 1 / half would be infinite. If the worlds have nothing in common, any frame is right. */
float_frame make_float_frame(const octree_box *world, const octree_box *other)
{
    float_frame frame;
    for (int k = 0; k < 3; k++) {
        const double min = larger(world->min[k], other->min[k]), max = -larger(-world->max[k], -other->max[k]);
        const double half = max > min ? max / 2 - min / 2 : 1;
        frame.origin[k] = min / 2 + max / 2;
        frame.scale[k] = 1 / half < DBL_MAX ? 1 / half : DBL_MAX;
    }
    return frame;
}

/* Conversions of values beyond the range of floats would be undefined. */
static float to_float(double x)
{
    return x > FLT_MAX ? FLT_MAX : x < -FLT_MAX ? -FLT_MAX : (float)x;
}

static float_box make_float_box(const float_frame *frame, const octree_body *body)
{
    float_box box;
    for (int k = 0; k < 3; k++) {
        box.min[k] = to_float((body->position[k] - body->half[k] - frame->origin[k]) * frame->scale[k]);
        box.max[k] = to_float((body->position[k] + body->half[k] - frame->origin[k]) * frame->scale[k]);
    }
    return box;
}

static float_box make_empty_float_box(void)
{
    return (float_box){{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
}

static void include_float_box(float_box *around, const float_box *box)
{
    for (int k = 0; k < 3; k++) {
        around->min[k] = box->min[k] < around->min[k] ? box->min[k] : around->min[k];
        around->max[k] = box->max[k] > around->max[k] ? box->max[k] : around->max[k];
    }
}

#ifdef OCTREE_SSE2
static uint64_t find_meeting(const float *const min[3], const float *const max[3], size_t count, const float_box *box)
{
    uint64_t found = 0;
    __m128 low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = _mm_set1_ps(box->min[k]);
        high[k] = _mm_set1_ps(box->max[k]);
    }
    for (size_t i = 0; i < count; i += 4) {
        __m128 meets = _mm_cmple_ps(_mm_loadu_ps(&min[0][i]), high[0]);
        meets = _mm_and_ps(meets, _mm_cmple_ps(low[0], _mm_loadu_ps(&max[0][i])));
        for (int k = 1; k < 3; k++) {
            meets = _mm_and_ps(meets, _mm_cmple_ps(_mm_loadu_ps(&min[k][i]), high[k]));
            meets = _mm_and_ps(meets, _mm_cmple_ps(low[k], _mm_loadu_ps(&max[k][i])));
        }
        found |= (uint64_t)_mm_movemask_ps(meets) << i;
    }
    return found & UINT64_MAX >> (BOXES_AT_ONCE - count);
}
#else
static uint64_t find_meeting(const float *const min[3], const float *const max[3], size_t count, const float_box *box)
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

uint64_t find_meeting_boxes(const box_columns *boxes, size_t first, size_t count, const float_box *box)
{
    const float *const min[3] = {boxes->min[0] + first, boxes->min[1] + first, boxes->min[2] + first};
    const float *const max[3] = {boxes->max[0] + first, boxes->max[1] + first, boxes->max[2] + first};
    return count ? find_meeting(min, max, count, box) : 0;
}

/* ---- Copy the leaves ---------------------------------------------------------------------------------------- */

static inline bool comes_before(const octree_body *a, const octree_body *b)
{
    return a->id < b->id || (a->id == b->id && octree_compare_bodies(a, b) < 0);
}

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
        for (; at > 0 && comes_before(&body, &bodies[at - 1]); at--)
            bodies[at] = bodies[at - 1];
        bodies[at] = body;
    }
}

static void store_box(snapshot *s, size_t index, float_box *around)
{
    const float_box box = make_float_box(&s->frame, &s->bodies[index]);
    for (int k = 0; k < 3; k++) {
        s->boxes.min[k][index] = box.min[k];
        s->boxes.max[k][index] = box.max[k];
    }
    include_float_box(around, &box);
}

static void copy_leaf(snapshot *s, const octree_bodies *set, const node *leaf, size_t first, float_box *around)
{
    octree_body *bodies = s->bodies + first;
    for (uint32_t i = 0; !set->points && i < leaf->count && i < POOL_MAX_UNITS; i++)
        prefetch_memory(row_at(&set->rows, row_of_point(&leaf_points(leaf)[i])));
    for (uint32_t i = 0; i < leaf->count; i++) {
        octree_body scratch;
        bodies[i] = *load_body(set, &leaf_points(leaf)[i], &scratch);
    }
    sort_bodies(bodies, leaf->count);
    for (uint32_t i = 0; i < leaf->count; i++)
        store_box(s, first + i, around);
}

/* ---- Copy the nodes ----------------------------------------------------------------------------------------- */

/* Copy the bodies of a node, of which `first` is the index of the first one, and include their boxes in one box. */
static void copy_bodies(snapshot *s, const octree_bodies *set, const node *n, size_t first, float_box *around)
{
    if (!n->octants)
        copy_leaf(s, set, n, first, around);
    for (unsigned i = 0; i < bits_count8(n->octants); i++) {
        copy_bodies(s, set, &children_of(n)[i], first, around);
        first += children_of(n)[i].count;
    }
}

/* Copy a node to the cluster at an index, and its descendants to the end of the array. `first` is the number of bodies
 * that are copied already. Returns false if memory runs out. */
static bool copy_node(snapshot *s, const octree_bodies *set, const node *n, size_t first, size_t at)
{
    const unsigned children = n->count > s->capacity ? bits_count8(n->octants) : 0;
    cluster made = {make_empty_float_box(), children, first, n->count, s->clusters.count};
    for (unsigned i = 0; i < children; i++)
        if (!list_append(s->memory, &s->clusters, sizeof(cluster)))
            return false;
    for (unsigned i = 0; i < children; i++) {
        if (!copy_node(s, set, &children_of(n)[i], first, made.child + i))
            return false;
        first += children_of(n)[i].count;
        include_float_box(&made.box, &cluster_at(s, made.child + i)->box);
    }
    if (children == 0)
        copy_bodies(s, set, n, first, &made.box);
    ((cluster *)s->clusters.items)[at] = made;
    return true;
}

/* The columns are one allocation. */
static bool allocate_bodies(snapshot *s, size_t count)
{
    if (count > SIZE_MAX / (6 * sizeof(float) + sizeof(octree_body)) - BOX_PADDING)
        return false;
    s->room = count + BOX_PADDING;
    s->bodies = arena_allocate(s->memory, s->room * sizeof *s->bodies);
    float *columns = s->bodies ? arena_allocate(s->memory, 6 * s->room * sizeof *columns) : NULL;
    for (size_t k = 0; columns && k < 3; k++) {
        s->boxes.min[k] = columns + k * s->room;
        s->boxes.max[k] = columns + (k + 3) * s->room;
        memset(&s->boxes.min[k][count], 0, BOX_PADDING * sizeof(float));
        memset(&s->boxes.max[k][count], 0, BOX_PADDING * sizeof(float));
    }
    return columns != NULL;
}

bool snapshot_make(snapshot *s, const octree_bodies *set, const level *l, const float_frame *frame, arena *memory)
{
    const size_t leaf_capacity = l->tree->def.leaf_capacity;
    *s = (snapshot){.memory = memory, .frame = *frame};
    s->capacity =
        leaf_capacity < CLUSTER_AT_MOST / LEAVES_IN_CLUSTER ? leaf_capacity * LEAVES_IN_CLUSTER : CLUSTER_AT_MOST;
    return allocate_bodies(s, octree_count(l->tree)) && list_append(memory, &s->clusters, sizeof(cluster)) &&
           copy_node(s, set, &l->tree->root, 0, 0);
}

void snapshot_release(snapshot *s)
{
    arena_free(s->memory, s->bodies, s->room * sizeof *s->bodies);
    arena_free(s->memory, s->boxes.min[0], 6 * s->room * sizeof(float));
    list_release(s->memory, &s->clusters, sizeof(cluster));
}
