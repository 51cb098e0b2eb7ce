/* SPDX-License-Identifier: MIT */
/* pairs.c - all pairs of overlapping bodies: octree_bodies_pairs().
 *
 * Problem: a search for each body descends from the root each time, and finds each pair twice.
 *
 * Idea: descend in one tree, and carry along which clusters of the other tree meet the cluster that is visited. They
 * are replaced by those of their children that meet it. The list of a child is chosen from its parent's. If both trees
 * are the same, a list has only later clusters, so that each pair is found once.
 *
 * The bodies of a leaf are compared with all bodies that may meet them, together: first with the others of the leaf,
 * then with those of the clusters in its list that meet its box, which are gathered. So there is one loop for each
 * body. A loop for each two neighbouring leaves would be too short: most processors mispredict its end. Boxes of floats
 * are a quick test before the exact test.
 *
 * The descent runs over copies of the levels (snapshot.c), in which the order of clusters and bodies is a function of
 * the bodies alone. So is the order of the pairs.
 */
#include "snapshot.h"
#include "../exact/body.h"
#include "visit.h"

/* The greatest number of bodies that are compared with a leaf together. */
enum { CANDIDATES = 256 };

/* Bodies that may meet those of a leaf, with a copy of their boxes. */
typedef struct candidates {
    const octree_body *bodies[CANDIDATES];
    float faces[6][CANDIDATES + BOX_PADDING];
    box_columns boxes;
    float_box around; /* around the boxes of all candidates but the leaf's own bodies */
    size_t count;
    size_t own; /* the number of the leaf's own bodies, which come first among the candidates; 0: there are none */
} candidates;

typedef struct pairing {
    bool within; /* both sides are the same set */
    octree_pair_visitor visit;
    void *context;
    bool stopped;
    const snapshot *x, *y; /* the two levels; perhaps the same one */
    uint32_t *list;        /* a stack of indices of clusters of y */
    candidates near;
} pairing;

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

static void visit_if_pair(pairing *p, const octree_body *a, const octree_body *b)
{
    if (p->stopped || !bodies_meet(a, b))
        return;
    const bool swapped = p->within && octree_compare_bodies(a, b) > 0;
    const bool paused = float_mode_pause();
    p->stopped = !p->visit(swapped ? b : a, swapped ? a : b, p->context);
    float_mode_resume(paused);
}

static size_t size_of_chunk(size_t first, size_t end)
{
    return end - first < BOXES_AT_ONCE ? end - first : BOXES_AT_ONCE;
}

/* Visit the pairs of a body with the bodies first .. end - 1 of an array, whose boxes are given. */
static void pair_with_others(pairing *p, const octree_body *body, const float_box *box, const octree_body **others,
                             const box_columns *boxes, size_t first, size_t end)
{
    for (; first < end && !p->stopped; first += BOXES_AT_ONCE)
        for (uint64_t left = find_meeting_boxes(boxes, first, size_of_chunk(first, end), box); left; left &= left - 1)
            visit_if_pair(p, body, others[first + bits_lowest(left)]);
}

static void pair_within_leaf(pairing *p, const cluster *leaf)
{
    const size_t end = leaf->first + leaf->count;
    for (size_t i = leaf->first; i < end && !p->stopped; i++) {
        const float_box box = box_in_columns(&p->x->boxes, i);
        pair_with_others(p, p->x->bodies[i], &box, p->x->bodies, &p->x->boxes, i + 1, end);
    }
}

/* Visit the pairs of the bodies of a leaf with the candidates, and empty the list of candidates. */
static void pair_with_candidates(pairing *p, const cluster *leaf)
{
    candidates *c = &p->near;
    for (int face = 0; face < 6; face++)
        memset(&c->faces[face][c->count], 0, BOX_PADDING * sizeof(float)); /* is read, but does not matter */
    for (size_t i = 0; i < leaf->count && !p->stopped; i++) {
        const float_box box = box_in_columns(&p->x->boxes, leaf->first + i);
        if (c->own > 0 || float_boxes_meet(&box, &c->around))
            pair_with_others(p, p->x->bodies[leaf->first + i], &box, c->bodies, &c->boxes, c->own > 0 ? i + 1 : 0,
                             c->count);
    }
    c->count = c->own = 0;
    c->around = make_empty_float_box();
}

/* Begin with the bodies of the leaf itself if both sides are the same. Those of a crowded leaf are compared with each
 * other at once, and are not copied. */
static void begin_candidates(pairing *p, const cluster *leaf)
{
    candidates *c = &p->near;
    c->count = c->own = 0;
    c->around = make_empty_float_box();
    if (p->x != p->y)
        return;
    if (leaf->count > BOXES_AT_ONCE) {
        pair_within_leaf(p, leaf);
        return;
    }
    c->count = c->own = leaf->count;
    for (size_t i = 0; i < leaf->count; i++)
        prefetch_body(p->x->bodies[leaf->first + i]);
    memcpy(c->bodies, p->x->bodies + leaf->first, leaf->count * sizeof *c->bodies);
    for (int k = 0; k < 3; k++) {
        memcpy(c->boxes.min[k], p->x->boxes.min[k] + leaf->first, leaf->count * sizeof(float));
        memcpy(c->boxes.max[k], p->x->boxes.max[k] + leaf->first, leaf->count * sizeof(float));
    }
}

static void add_candidate(pairing *p, const cluster *leaf, size_t index)
{
    candidates *c = &p->near;
    const float_box box = box_in_columns(&p->y->boxes, index);
    if (c->count == CANDIDATES)
        pair_with_candidates(p, leaf);
    store_in_columns(&c->boxes, c->count, &box);
    include_float_box(&c->around, &box);
    prefetch_body(p->y->bodies[index]);
    c->bodies[c->count++] = p->y->bodies[index];
}

/* Gather the bodies of a cluster that meet the box of a leaf. */
static void gather_candidates(pairing *p, const cluster *leaf, const cluster *other)
{
    const size_t end = other->first + other->count;
    if (p->stopped || !float_boxes_meet(&leaf->box, &other->box))
        return;
    for (unsigned i = 0; i < other->child_count; i++)
        gather_candidates(p, leaf, cluster_at(p->y, other->child + i));
    for (size_t i = other->first; other->child_count == 0 && i < end && !p->stopped; i += BOXES_AT_ONCE)
        for (uint64_t left = find_meeting_boxes(&p->y->boxes, i, size_of_chunk(i, end), &leaf->box); left;
             left &= left - 1)
            add_candidate(p, leaf, i + bits_lowest(left));
}

static void pair_leaf(pairing *p, const cluster *leaf, size_t begin, size_t end)
{
    begin_candidates(p, leaf);
    for (size_t i = begin; i < end && !p->stopped; i++)
        gather_candidates(p, leaf, cluster_at(p->y, p->list[i]));
    pair_with_candidates(p, leaf);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Append a cluster of y to the list if it meets a box. Returns the new end. */
static size_t list_if_met(pairing *p, const float_box *box, size_t cluster, size_t end)
{
    p->list[end] = (uint32_t)cluster;
    return end + float_boxes_meet(box, &cluster_at(p->y, cluster)->box);
}

/* Append the leaves of a part of the list, and those children of its inner clusters that meet a box. Returns the new
 * end. */
static size_t list_children(pairing *p, const float_box *box, size_t begin, size_t end)
{
    size_t next = end;
    for (size_t i = begin; i < end; i++) {
        const cluster *other = cluster_at(p->y, p->list[i]);
        if (other->child_count == 0)
            p->list[next++] = p->list[i];
        for (unsigned k = 0; k < other->child_count; k++)
            next = list_if_met(p, box, other->child + k, next);
    }
    return next;
}

/* Visit the pairs of the bodies of a cluster with those of the clusters begin .. end - 1 of the list, and, if both
 * sides are the same, with each other. */
static void pair_cluster(pairing *p, const cluster *a, size_t begin, size_t end)
{
    if (a->child_count == 0) {
        pair_leaf(p, a, begin, end);
        return;
    }
    const size_t next = list_children(p, &a->box, begin, end);
    for (unsigned i = 0; i < a->child_count && !p->stopped; i++) {
        const cluster *child = cluster_at(p->x, a->child + i);
        size_t last = next;
        for (unsigned k = i + 1; p->x == p->y && k < a->child_count; k++)
            last = list_if_met(p, &child->box, a->child + k, last);
        for (size_t k = end; k < next; k++)
            last = list_if_met(p, &child->box, p->list[k], last);
        pair_cluster(p, child, next, last);
    }
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

/* The snapshots of the levels of a set that have bodies. */
typedef struct snapshots {
    snapshot levels[OCTREE_BODY_LEVELS];
    unsigned count;
    unsigned depth;    /* the greatest depth of a level */
    size_t leaf_count; /* the greatest number of leaves of a level */
} snapshots;

static bool make_snapshots(snapshots *s, const octree_bodies *set, const float_frame *frame, arena *memory)
{
    bool made = true;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && made; i++) {
        if (count_in_level(&set->levels[i]) == 0)
            continue;
        snapshot *level = &s->levels[s->count++];
        made = snapshot_make(level, set, &set->levels[i], frame, memory) && level->clusters.count <= UINT32_MAX;
        s->depth = level->depth > s->depth ? level->depth : s->depth;
        s->leaf_count = level->leaf_count > s->leaf_count ? level->leaf_count : s->leaf_count;
    }
    return made;
}

static void release_snapshots(snapshots *s)
{
    for (unsigned i = 0; i < s->count; i++)
        snapshot_release(&s->levels[i]);
}

/* The greatest length of the list. Each cluster on the way down has two parts of the list: the clusters that meet it,
 * and their children. No part has two clusters of which one contains the other, so it has at most as many as there are
 * leaves. One more is written before it is known to meet. */
static size_t length_of_list(const snapshots *a, const snapshots *b)
{
    return (2 * (size_t)a->depth + 2) * (b->leaf_count + 1);
}

/* Visit the pairs of two levels, or of one. */
static void pair_levels(pairing *p, const snapshot *x, const snapshot *y)
{
    p->x = x;
    p->y = y;
    p->list[0] = 0; /* the root */
    pair_cluster(p, cluster_at(x, 0), 0, x == y ? 0 : 1);
}

/* Visit the pairs of all levels of two sets, which may be the same. */
static void pair_sets(pairing *p, const snapshots *a, const snapshots *b)
{
    for (int k = 0; k < 3; k++) {
        p->near.boxes.min[k] = p->near.faces[k];
        p->near.boxes.max[k] = p->near.faces[k + 3];
    }
    for (unsigned i = 0; i < a->count; i++)
        for (unsigned j = p->within ? i : 0; j < b->count && !p->stopped; j++)
            pair_levels(p, &a->levels[i], &b->levels[j]);
}

octree_status octree_bodies_pairs(const octree_bodies *bodies, const octree_bodies *other, octree_pair_visitor visit,
                                  void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_pairs, bodies, other, visit, context);
    if (!bodies || !visit)
        return OCTREE_NULL_ARGUMENT;
    arena memory = {.allocator = bodies->memory.allocator};
    pairing p = {.within = !other, .visit = visit, .context = context};
    snapshots a = {.count = 0}, b = {.count = 0};
    const float_frame frame =
        make_float_frame(&anchor_of(bodies)->def.world, &anchor_of(other ? other : bodies)->def.world);
    const bool made =
        make_snapshots(&a, bodies, &frame, &memory) && (!other || make_snapshots(&b, other, &frame, &memory));
    const snapshots *second = other ? &b : &a;
    const size_t bytes = length_of_list(&a, second) * sizeof *p.list;
    p.list = made ? arena_allocate(&memory, bytes) : NULL;
    const unsigned begun = begin_set_callbacks(bodies), begun_other = begin_set_callbacks(other ? other : bodies);
    if (p.list)
        pair_sets(&p, &a, second);
    end_callbacks(begun_other);
    end_callbacks(begun);
    arena_free(&memory, p.list, bytes);
    release_snapshots(&a);
    release_snapshots(&b);
    return p.list ? OCTREE_OK : OCTREE_NO_MEMORY;
}
