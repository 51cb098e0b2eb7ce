/* SPDX-License-Identifier: MIT */
/* pairs.c - all pairs of overlapping bodies: octree_bodies_pairs().
 *
 * Problem: a search for each body descends from the root each time, and finds each pair twice.
 *
 * Idea: one descent of both sides at once. Clusters of bodies whose boxes do not meet have no pairs; of two clusters
 * that meet, the one with more bodies is replaced by its children, until two leaves are compared body by body. Each
 * pair is found once: pairs of two children of a node are visited for i < j only.
 *
 * Two neighbouring leaves have few bodies that can meet: those that meet the common box of both leaves. These are
 * gathered from one leaf, and compared with those of the other. Boxes of floats are a quick test before the exact
 * test.
 *
 * The descent runs over copies of the levels (snapshot.c), in which the order of clusters and bodies is a function of
 * the bodies alone. So is the order of the pairs.
 */
#include "snapshot.h"
#include "../exact/body.h"
#include "visit.h"

/* Some of the bodies of one leaf, with a copy of their boxes. */
typedef struct candidates {
    const octree_body *bodies[BOXES_AT_ONCE];
    float faces[6][BOXES_AT_ONCE + BOX_PADDING];
    box_columns boxes;
    size_t count;
} candidates;

typedef struct pairing {
    bool within; /* both sides are the same set */
    octree_pair_visitor visit;
    void *context;
    bool stopped;
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

/* Visit the pairs of a body with the bodies first .. end - 1 of its snapshot. */
static void pair_with_rest(pairing *p, const snapshot *s, size_t body, size_t first, size_t end)
{
    const float_box box = box_in_columns(&s->boxes, body);
    for (; first < end && !p->stopped; first += BOXES_AT_ONCE) {
        uint64_t left = find_meeting_boxes(&s->boxes, first, size_of_chunk(first, end), &box);
        for (; left; left &= left - 1)
            visit_if_pair(p, s->bodies[body], s->bodies[first + bits_lowest(left)]);
    }
}

static void pair_within_leaf(pairing *p, const snapshot *s, const cluster *leaf)
{
    const size_t end = leaf->first + leaf->count;
    for (size_t i = leaf->first; i < end && !p->stopped; i++)
        pair_with_rest(p, s, i, i + 1, end);
}

static void add_candidate(candidates *c, const snapshot *s, size_t index)
{
    const float_box box = box_in_columns(&s->boxes, index);
    store_in_columns(&c->boxes, c->count, &box);
    prefetch_memory(s->bodies[index]);
    c->bodies[c->count++] = s->bodies[index];
}

/* Gather the bodies first .. first + count - 1 that meet a box. */
static void gather_candidates(candidates *c, const snapshot *s, size_t first, size_t count, const float_box *box)
{
    c->count = 0;
    for (uint64_t left = find_meeting_boxes(&s->boxes, first, count, box); left; left &= left - 1)
        add_candidate(c, s, first + bits_lowest(left));
    for (int face = 0; face < 6; face++)
        memset(&c->faces[face][c->count], 0, BOX_PADDING * sizeof(float)); /* is read, but does not matter */
}

static void pair_with_candidates(pairing *p, const octree_body *body, const float_box *box, const candidates *c)
{
    for (uint64_t left = find_meeting_boxes(&c->boxes, 0, c->count, box); left; left &= left - 1)
        visit_if_pair(p, body, c->bodies[bits_lowest(left)]);
}

static void pair_leaves(pairing *p, const snapshot *x, const cluster *a, const snapshot *y, const cluster *b)
{
    const float_box common = intersect_float_boxes(&a->box, &b->box);
    const size_t end_a = a->first + a->count, end_b = b->first + b->count;
    candidates of_b;
    for (int k = 0; k < 3; k++) {
        of_b.boxes.min[k] = of_b.faces[k];
        of_b.boxes.max[k] = of_b.faces[k + 3];
    }
    for (size_t j = b->first; j < end_b && !p->stopped; j += BOXES_AT_ONCE) {
        gather_candidates(&of_b, y, j, size_of_chunk(j, end_b), &common);
        for (size_t i = a->first; of_b.count > 0 && i < end_a && !p->stopped; i += BOXES_AT_ONCE) {
            uint64_t left = find_meeting_boxes(&x->boxes, i, size_of_chunk(i, end_a), &common);
            for (; left; left &= left - 1) {
                const size_t body = i + bits_lowest(left);
                const float_box box = box_in_columns(&x->boxes, body);
                pair_with_candidates(p, x->bodies[body], &box, &of_b);
            }
        }
    }
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Visit the pairs of one body in cluster `a` and one body in cluster `b`, which is another cluster. */
static void pair_clusters(pairing *p, const snapshot *x, const cluster *a, const snapshot *y, const cluster *b)
{
    if (p->stopped || !float_boxes_meet(&a->box, &b->box))
        return;
    if (a->child_count == 0 && b->child_count == 0) {
        pair_leaves(p, x, a, y, b);
        return;
    }
    const bool divides_a = b->child_count == 0 || (a->child_count > 0 && a->count >= b->count);
    for (unsigned i = 0; divides_a && i < a->child_count; i++)
        pair_clusters(p, x, cluster_at(x, a->child + i), y, b);
    for (unsigned i = 0; !divides_a && i < b->child_count; i++)
        pair_clusters(p, x, a, y, cluster_at(y, b->child + i));
}

/* Visit the pairs of two bodies in a cluster. */
static void pair_within_cluster(pairing *p, const snapshot *s, const cluster *c)
{
    if (c->child_count == 0)
        pair_within_leaf(p, s, c);
    for (unsigned i = 0; i < c->child_count && !p->stopped; i++) {
        pair_within_cluster(p, s, cluster_at(s, c->child + i));
        for (unsigned j = i + 1; j < c->child_count; j++)
            pair_clusters(p, s, cluster_at(s, c->child + i), s, cluster_at(s, c->child + j));
    }
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

/* The snapshots of the levels of a set that have bodies. */
typedef struct snapshots {
    snapshot levels[OCTREE_BODY_LEVELS];
    unsigned count;
} snapshots;

static bool make_snapshots(snapshots *s, const octree_bodies *set, const float_frame *frame, arena *memory)
{
    bool made = true;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && made; i++)
        if (octree_count(set->levels[i].tree) > 0)
            made = snapshot_make(&s->levels[s->count++], set, &set->levels[i], frame, memory);
    return made;
}

static void release_snapshots(snapshots *s)
{
    for (unsigned i = 0; i < s->count; i++)
        snapshot_release(&s->levels[i]);
}

static void pair_within_set(pairing *p, const snapshots *s)
{
    for (unsigned i = 0; i < s->count && !p->stopped; i++) {
        pair_within_cluster(p, &s->levels[i], cluster_at(&s->levels[i], 0));
        for (unsigned j = i + 1; j < s->count; j++)
            pair_clusters(p, &s->levels[i], cluster_at(&s->levels[i], 0), &s->levels[j], cluster_at(&s->levels[j], 0));
    }
}

static void pair_sets(pairing *p, const snapshots *a, const snapshots *b)
{
    for (unsigned i = 0; i < a->count; i++)
        for (unsigned j = 0; j < b->count; j++)
            pair_clusters(p, &a->levels[i], cluster_at(&a->levels[i], 0), &b->levels[j], cluster_at(&b->levels[j], 0));
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
    const unsigned begun = begin_set_callbacks(bodies), begun_other = begin_set_callbacks(other ? other : bodies);
    if (made && other)
        pair_sets(&p, &a, &b);
    else if (made)
        pair_within_set(&p, &a);
    end_callbacks(begun_other);
    end_callbacks(begun);
    release_snapshots(&a);
    release_snapshots(&b);
    return made ? OCTREE_OK : OCTREE_NO_MEMORY;
}
