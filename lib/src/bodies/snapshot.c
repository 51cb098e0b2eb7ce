/* SPDX-License-Identifier: MIT */
/* snapshot.c - the nodes and bodies of one level in arrays, for algorithms that compare many bodies with many.
 *
 * The order of points in a leaf depends on the history of the tree. In a snapshot the bodies of a leaf are sorted, so
 * that the results of an algorithm are a function of the bodies. Their boxes lie in the order of the leaves, so that
 * the algorithm runs through memory in order. It costs O(n M).
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

/* A node is a cluster without children if it has at most the bodies of eight full leaves, and at most CLUSTER_AT_MOST.
 * With 128 at most, the pairs of 1e5 bodies in streets take 1.14 times the instructions; with 32 at most, those of 1e5
 * uniform bodies take 1.02 times (callgrind). */
enum { LEAVES_IN_CLUSTER = 8, CLUSTER_AT_MOST = 64 };

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
    const double below = x < FLT_MAX ? x : FLT_MAX;
    return (float)(below > -FLT_MAX ? below : -FLT_MAX);
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

/* ---- Leaves --------------------------------------------------------------------------------------------------  */

static inline bool comes_before(const octree_body *a, const octree_body *b)
{
    return a->id < b->id || (a->id == b->id && octree_compare_bodies(a, b) < 0);
}

static int compare_bodies_at(const void *a, const void *b)
{
    return octree_compare_bodies(*(const octree_body *const *)a, *(const octree_body *const *)b);
}

/* Insertion sort: leaves are small, and most ids differ. */
static void sort_bodies(const octree_body **bodies, size_t count)
{
    if (count > BOXES_AT_ONCE) {
        qsort(bodies, count, sizeof *bodies, compare_bodies_at);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        const octree_body *body = bodies[i];
        size_t at = i;
        for (; at > 0 && comes_before(body, bodies[at - 1]); at--)
            bodies[at] = bodies[at - 1];
        bodies[at] = body;
    }
}

/* List the bodies of a leaf, of which `first` is the index of the first one, and include their boxes in one box. */
static void list_leaf(snapshot *s, const octree_bodies *set, const node *leaf, size_t first, float_box *around)
{
    const octree_body **bodies = s->bodies + first;
    for (uint32_t i = 0; i < leaf->count; i++) {
        bodies[i] = load_body(set, &leaf_points(leaf)[i], s->made ? &s->made[first + i] : NULL);
        prefetch_memory(bodies[i]);
    }
    sort_bodies(bodies, leaf->count);
    for (uint32_t i = 0; i < leaf->count; i++) {
        const float_box box = make_float_box(&s->frame, bodies[i]);
        store_in_columns(&s->boxes, first + i, &box);
        include_float_box(around, &box);
    }
}

/* ---- Nodes --------------------------------------------------------------------------------------------------- */

/* List the bodies of a node, as list_leaf() does. */
static void list_bodies(snapshot *s, const octree_bodies *set, const node *n, size_t first, float_box *around)
{
    if (!n->octants)
        list_leaf(s, set, n, first, around);
    for (unsigned i = 0; i < bits_count8(n->octants); i++) {
        list_bodies(s, set, &children_of(n)[i], first, around);
        first += children_of(n)[i].count;
    }
}

/* Copy a node of this depth to the cluster at an index, and its descendants to the end of the array. `first` is the
 * number of bodies that are copied already. Returns false if memory runs out. */
static bool copy_node(snapshot *s, const octree_bodies *set, const node *n, unsigned depth, size_t first, size_t at)
{
    const unsigned children = n->count > s->capacity ? bits_count8(n->octants) : 0;
    cluster made = {make_empty_float_box(), children, first, n->count, s->clusters.count};
    for (unsigned i = 0; i < children; i++)
        if (!list_append(s->memory, &s->clusters, sizeof(cluster)))
            return false;
    for (unsigned i = 0; i < children; i++) {
        if (!copy_node(s, set, &children_of(n)[i], depth + 1, first, made.child + i))
            return false;
        first += children_of(n)[i].count;
        include_float_box(&made.box, &cluster_at(s, made.child + i)->box);
    }
    if (children == 0)
        list_bodies(s, set, n, first, &made.box);
    s->leaf_count += children == 0;
    s->depth = depth > s->depth ? depth : s->depth;
    ((cluster *)s->clusters.items)[at] = made;
    return true;
}

enum { COLUMN_BYTES = 6 * sizeof(float) };

/* The columns are one allocation. */
static bool allocate_bodies(snapshot *s, size_t count, bool makes_bodies)
{
    if (count > SIZE_MAX / (COLUMN_BYTES + sizeof(octree_body)) - BOX_PADDING)
        return false;
    s->room = count + BOX_PADDING;
    s->bodies = arena_allocate(s->memory, s->room * sizeof *s->bodies);
    s->made = makes_bodies ? arena_allocate(s->memory, s->room * sizeof *s->made) : NULL;
    float *columns = arena_allocate(s->memory, s->room * COLUMN_BYTES);
    for (size_t k = 0; columns && k < 3; k++) {
        s->boxes.min[k] = columns + k * s->room;
        s->boxes.max[k] = columns + (k + 3) * s->room;
        memset(&s->boxes.min[k][count], 0, BOX_PADDING * sizeof(float));
        memset(&s->boxes.max[k][count], 0, BOX_PADDING * sizeof(float));
    }
    return s->bodies && (s->made || !makes_bodies) && columns;
}

bool snapshot_make(snapshot *s, const octree_bodies *set, const level *l, const float_frame *frame, arena *memory)
{
    const size_t leaf_capacity = l->tree->def.leaf_capacity;
    *s = (snapshot){.memory = memory, .frame = *frame};
    s->capacity =
        leaf_capacity < CLUSTER_AT_MOST / LEAVES_IN_CLUSTER ? leaf_capacity * LEAVES_IN_CLUSTER : CLUSTER_AT_MOST;
    return allocate_bodies(s, octree_count(l->tree), set->points) &&
           list_append(memory, &s->clusters, sizeof(cluster)) && copy_node(s, set, &l->tree->root, 0, 0, 0);
}

void snapshot_release(snapshot *s)
{
    arena_free(s->memory, s->bodies, s->room * sizeof *s->bodies);
    arena_free(s->memory, s->made, s->room * sizeof *s->made);
    arena_free(s->memory, s->boxes.min[0], s->room * COLUMN_BYTES);
    list_release(s->memory, &s->clusters, sizeof(cluster));
}
