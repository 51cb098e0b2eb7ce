/* SPDX-License-Identifier: MIT */
/* pairs.c - all pairs of overlapping bodies: octree_bodies_pairs().
 *
 * Problem: a search for each body descends from the root each time, and finds each pair twice.
 *
 * Idea: one descent of both sides at once. Groups of bodies whose boxes do not meet have no pairs; of two groups that
 * meet, the one with more bodies is replaced by its children, until two leaves are compared body by body. Each pair is
 * found once: pairs of two children of a node are visited for i < j only.
 *
 * The nodes are first copied to an array of groups with tight boxes, and the bodies to an array of boxes in the order
 * of the leaves. The boxes are rounded outwards, so they are a quick test before the exact test. Copying is O(n), and
 * makes the rest run through memory in order, whatever the order of the rows is.
 *
 * Order: the groups are a function of the bodies. The order of the points in a leaf is not, so the pairs of two leaves
 * are sorted before they are visited.
 */
#include "../exact/body.h"
#include "visit.h"

#include <stdlib.h>

/* A body in the order of its leaf, with its box rounded outwards. */
typedef struct item {
    octree_box box;
    const octree_point *point;
} item;

/* A node: its tight box and the range of its bodies. */
typedef struct group {
    octree_box box;
    size_t first, count;  /* the range of its items */
    size_t child;         /* the index of its first child; children are adjacent */
    unsigned child_count; /* 0: a leaf */
} group;

/* A copy of the nodes and bodies of a level. */
typedef struct snapshot {
    const octree_bodies *set;
    arena *memory;
    list items, groups;
} snapshot;

typedef struct pair {
    octree_body a, b;
} pair;

typedef struct pairing {
    bool within; /* both sides are the same set */
    octree_pair_visitor visit;
    void *context;
    arena *memory;
    list found; /* the pairs of two leaves */
    octree_status status;
    bool stopped;
} pairing;

/* ---- The snapshot ------------------------------------------------------------------------------------------- */

static const item *items_of(const snapshot *s)
{
    return s->items.items;
}

static group *group_at(const snapshot *s, size_t index)
{
    return (group *)s->groups.items + index;
}

static bool copy_body(snapshot *s, const octree_point *point)
{
    item *made = list_append(s->memory, &s->items, sizeof *made);
    if (!made)
        return false;
    octree_body scratch;
    const octree_body *body = load_body(s->set, point, &scratch);
    for (int i = 0; i < 3; i++) {
        made->box.min[i] = exact_add_down(body->position[i], -body->half[i]);
        made->box.max[i] = exact_add_up(body->position[i], body->half[i]);
    }
    made->point = point;
    return true;
}

static void include_box(octree_box *around, const octree_box *box)
{
    for (int i = 0; i < 3; i++) {
        around->min[i] = box->min[i] < around->min[i] ? box->min[i] : around->min[i];
        around->max[i] = box->max[i] > around->max[i] ? box->max[i] : around->max[i];
    }
}

static bool copy_leaf(snapshot *s, const node *leaf, size_t at)
{
    for (uint32_t i = 0; !s->set->points && i < leaf->count && i < POOL_MAX_UNITS; i++)
        prefetch_memory(row_at(&s->set->rows, (size_t)leaf_points(leaf)[i].id));
    for (uint32_t i = 0; i < leaf->count; i++) {
        if (!copy_body(s, &leaf_points(leaf)[i]))
            return false;
        include_box(&group_at(s, at)->box, &items_of(s)[s->items.count - 1].box);
    }
    return true;
}

/* Copy a node to the group at an index, and its descendants to the end of the array. Returns false if memory runs out.
 */
static bool copy_node(snapshot *s, const node *n, size_t at)
{
    const unsigned children = bits_count8(n->octants);
    *group_at(s, at) = (group){{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}},
                               s->items.count,
                               n->count,
                               s->groups.count,
                               children};
    for (unsigned i = 0; i < children; i++)
        if (!list_append(s->memory, &s->groups, sizeof(group)))
            return false;
    for (unsigned i = 0; i < children; i++) {
        const size_t child = group_at(s, at)->child + i;
        if (!copy_node(s, &children_of(n)[i], child))
            return false;
        include_box(&group_at(s, at)->box, &group_at(s, child)->box);
    }
    return children > 0 || copy_leaf(s, n, at);
}

static bool make_snapshot(snapshot *s, const octree_bodies *set, const octree *tree, arena *memory)
{
    *s = (snapshot){.set = set, .memory = memory};
    return list_append(memory, &s->groups, sizeof(group)) && copy_node(s, &tree->root, 0);
}

static void release_snapshot(snapshot *s)
{
    list_release(s->memory, &s->items, sizeof(item));
    list_release(s->memory, &s->groups, sizeof(group));
}

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

/* Without branches, because they would be unpredictable. */
static inline bool boxes_meet(const octree_box *a, const octree_box *b)
{
    bool meet = true;
    for (int i = 0; i < 3; i++)
        meet &= (a->min[i] <= b->max[i]) & (b->min[i] <= a->max[i]);
    return meet;
}

static void find_pair(pairing *p, const snapshot *x, const item *a, const snapshot *y, const item *b)
{
    octree_body of_a, of_b;
    pair found = {*load_body(x->set, a->point, &of_a), *load_body(y->set, b->point, &of_b)};
    if (!bodies_meet(&found.a, &found.b))
        return;
    if (p->within && octree_compare_bodies(&found.a, &found.b) > 0)
        found = (pair){found.b, found.a};
    if (!list_push(p->memory, &p->found, &found, sizeof found))
        p->status = OCTREE_NO_MEMORY;
}

static int compare_pairs(const void *a, const void *b)
{
    const pair *x = a, *y = b;
    const int order = octree_compare_bodies(&x->a, &y->a);
    return order ? order : octree_compare_bodies(&x->b, &y->b);
}

static bool call_with_pair(const pairing *p, const pair *found)
{
    const bool paused = float_mode_pause();
    const bool result = p->visit(&found->a, &found->b, p->context);
    float_mode_resume(paused);
    return result;
}

static void visit_found_pairs(pairing *p)
{
    if (p->found.count > 1)
        list_sort(&p->found, sizeof(pair), compare_pairs);
    for (size_t i = 0; i < p->found.count && p->status == OCTREE_OK && !p->stopped; i++)
        p->stopped = !call_with_pair(p, (const pair *)p->found.items + i);
    p->found.count = 0;
}

static void pair_within_leaf(pairing *p, const snapshot *s, const group *leaf)
{
    const item *items = items_of(s) + leaf->first;
    for (size_t i = 0; i < leaf->count; i++)
        for (size_t j = i + 1; j < leaf->count; j++)
            if (boxes_meet(&items[i].box, &items[j].box))
                find_pair(p, s, &items[i], s, &items[j]);
    visit_found_pairs(p);
}

static void pair_leaves(pairing *p, const snapshot *x, const group *a, const snapshot *y, const group *b)
{
    const item *of_a = items_of(x) + a->first, *of_b = items_of(y) + b->first;
    for (size_t i = 0; i < a->count; i++) {
        if (!boxes_meet(&of_a[i].box, &b->box))
            continue;
        for (size_t j = 0; j < b->count; j++)
            if (boxes_meet(&of_a[i].box, &of_b[j].box))
                find_pair(p, x, &of_a[i], y, &of_b[j]);
    }
    visit_found_pairs(p);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

static bool is_done(const pairing *p)
{
    return p->stopped || p->status != OCTREE_OK;
}

/* Visit the pairs of one body in group `a` and one body in group `b`, which is another group. */
static void pair_groups(pairing *p, const snapshot *x, const group *a, const snapshot *y, const group *b)
{
    if (is_done(p) || !boxes_meet(&a->box, &b->box))
        return;
    if (a->child_count == 0 && b->child_count == 0) {
        pair_leaves(p, x, a, y, b);
        return;
    }
    const bool divides_a = b->child_count == 0 || (a->child_count > 0 && a->count >= b->count);
    for (unsigned i = 0; divides_a && i < a->child_count; i++)
        pair_groups(p, x, group_at(x, a->child + i), y, b);
    for (unsigned i = 0; !divides_a && i < b->child_count; i++)
        pair_groups(p, x, a, y, group_at(y, b->child + i));
}

/* Visit the pairs of two bodies in a group. */
static void pair_within_group(pairing *p, const snapshot *s, const group *g)
{
    if (g->child_count == 0)
        pair_within_leaf(p, s, g);
    for (unsigned i = 0; i < g->child_count && !is_done(p); i++) {
        pair_within_group(p, s, group_at(s, g->child + i));
        for (unsigned j = i + 1; j < g->child_count; j++)
            pair_groups(p, s, group_at(s, g->child + i), s, group_at(s, g->child + j));
    }
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

/* The snapshots of the levels of a set that have bodies. */
typedef struct snapshots {
    snapshot levels[OCTREE_BODY_LEVELS];
    unsigned count;
} snapshots;

static octree_status make_snapshots(snapshots *s, const octree_bodies *set, arena *memory)
{
    bool made = true;
    s->count = 0;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && made; i++)
        if (octree_count(set->levels[i].tree) > 0)
            made = make_snapshot(&s->levels[s->count++], set, set->levels[i].tree, memory);
    return made ? OCTREE_OK : OCTREE_NO_MEMORY;
}

static void release_snapshots(snapshots *s)
{
    for (unsigned i = 0; i < s->count; i++)
        release_snapshot(&s->levels[i]);
}

static void pair_within_set(pairing *p, const snapshots *s)
{
    for (unsigned i = 0; i < s->count && !is_done(p); i++) {
        pair_within_group(p, &s->levels[i], group_at(&s->levels[i], 0));
        for (unsigned j = i + 1; j < s->count; j++)
            pair_groups(p, &s->levels[i], group_at(&s->levels[i], 0), &s->levels[j], group_at(&s->levels[j], 0));
    }
}

static void pair_sets(pairing *p, const snapshots *a, const snapshots *b)
{
    for (unsigned i = 0; i < a->count; i++)
        for (unsigned j = 0; j < b->count; j++)
            pair_groups(p, &a->levels[i], group_at(&a->levels[i], 0), &b->levels[j], group_at(&b->levels[j], 0));
}

octree_status octree_bodies_pairs(const octree_bodies *bodies, const octree_bodies *other, octree_pair_visitor visit,
                                  void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_pairs, bodies, other, visit, context);
    if (!bodies || !visit)
        return OCTREE_NULL_ARGUMENT;
    arena memory = {.allocator = bodies->memory.allocator};
    pairing p = {.within = !other, .visit = visit, .context = context, .memory = &memory};
    snapshots a, b = {.count = 0};
    p.status = make_snapshots(&a, bodies, &memory);
    if (p.status == OCTREE_OK && other)
        p.status = make_snapshots(&b, other, &memory);
    const unsigned begun = begin_set_callbacks(bodies), begun_other = begin_set_callbacks(other ? other : bodies);
    if (p.status == OCTREE_OK && other)
        pair_sets(&p, &a, &b);
    else if (p.status == OCTREE_OK)
        pair_within_set(&p, &a);
    end_callbacks(begun_other);
    end_callbacks(begun);
    release_snapshots(&a);
    release_snapshots(&b);
    list_release(&memory, &p.found, sizeof(pair));
    return p.status;
}
