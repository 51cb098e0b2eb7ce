/* SPDX-License-Identifier: MIT */
/* moving_tree.c - see moving_tree.h. */
#include "moving_tree.h"

#include <stdio.h>
#include <string.h>

#include "fixture.h"

enum { REACH = 8 };

static void random_place(moving_tree *m, double position[3])
{
    for (int i = 0; i < 3; i++)
        position[i] = (double)random_below(&m->random, 2 * REACH + 1) - REACH;
}

static void come(moving_tree *m)
{
    octree_point *point = &m->points[m->count];
    if (m->count == MOVING_TREE_MOST)
        return;
    point->id = random_below(&m->random, 1000) * 1000003; /* of more than one byte */
    for (size_t i = 0; i < m->count; i++)
        if (m->points[i].id == point->id)
            return;
    random_place(m, point->position);
    m->count += octree_insert(m->tree, point->position, point->id) == OCTREE_OK;
}

static void leave(moving_tree *m)
{
    if (m->count == 0)
        return;
    octree_point *point = &m->points[random_below(&m->random, m->count)];
    assert_int_equal(octree_remove(m->tree, point->position, point->id), OCTREE_OK);
    *point = m->points[--m->count];
}

static void move(moving_tree *m)
{
    double to[3];
    if (m->count == 0)
        return;
    octree_point *point = &m->points[random_below(&m->random, m->count)];
    random_place(m, to);
    if (octree_move(m->tree, point->position, point->id, to) == OCTREE_OK)
        memcpy(point->position, to, sizeof to);
}

/* Two points, both of which may be in full leaves. */
static void change_places(moving_tree *m)
{
    if (m->count < 2)
        return;
    octree_point *a = &m->points[random_below(&m->random, m->count)], *b = &m->points[m->count - 1];
    double there[3];
    assert_int_equal(octree_remove(m->tree, a->position, a->id), OCTREE_OK);
    if (a != b)
        assert_int_equal(octree_remove(m->tree, b->position, b->id), OCTREE_OK);
    memcpy(there, a->position, sizeof there);
    memcpy(a->position, b->position, sizeof there);
    memcpy(b->position, there, sizeof there);
    assert_int_equal(octree_insert(m->tree, a->position, a->id), OCTREE_OK);
    if (a != b)
        assert_int_equal(octree_insert(m->tree, b->position, b->id), OCTREE_OK);
}

/* The ticks that queries and shapes name are none of the recorder's business: here they are nonsense. */
static void ask(moving_tree *m)
{
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        octree_query *query = &m->queries[kind];
        *query = (octree_query){.tick = 77,
                                .kind = (octree_query_kind)kind,
                                .k = 3,
                                .radius = 4,
                                .direction = {1, -1, 0.5},
                                .thickness = 2,
                                .frustum = {{{{1, 2, -1}, 5}}, 1},
                                .to = {3, -2, 4},
                                .half = {1, 0, 2},
                                .skip = kind % 2 ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE,
                                .skip_id = 3,
                                .epsilon = 0.25 * kind};
        if (kind < OCTREE_QUERY_RAY)
            random_place(m, query->target);
        for (int i = 0; i < 3; i++)
            query->box.max[i] = (query->box.min[i] = query->target[i]) + 3;
    }
    /* the kind "ray" is new and takes no random numbers: the trees of all seeds stay the same */
    const size_t count = random_below(&m->random, OCTREE_QUERY_RAY + 1);
    m->about.query_count = count == OCTREE_QUERY_RAY ? OCTREE_QUERY_KINDS : count;
}

static void show(moving_tree *m)
{
    for (int kind = 0; kind < OCTREE_SHAPE_KINDS; kind++) {
        octree_shape *shape = &m->shapes[kind];
        *shape = (octree_shape){.tick = 5, .kind = (octree_shape_kind)kind};
        random_place(m, shape->at);
        for (int i = 0; i < 3; i++)
            shape->to[i] = shape->at[i] + 2;
        snprintf(shape->text, sizeof shape->text, "label %d", (int)random_below(&m->random, 100));
    }
    m->about.shape_count = random_below(&m->random, OCTREE_SHAPE_KINDS + 1);
}

/* A plane through the middle, and points on either side; in some ticks the program says nothing of its nodes. */
static void grow_nodes(moving_tree *m)
{
    size_t left = 0, right = MOVING_TREE_MOST;
    for (size_t i = 0; i < m->count; i++)
        m->listed[m->points[i].position[0] < 0 ? left++ : --right] = m->points[i].id;
    for (uint64_t id = 0; id < 3; id++) {
        m->met[id] = id;
        m->nodes[id] = (octree_foreign_node){.id = id, .has_parent = id > 0, .box = cube(-REACH, REACH)};
        if (id > 0)
            m->nodes[id].has_points = true;
    }
    m->nodes[1].box.max[0] = m->nodes[2].box.min[0] = 0;
    m->nodes[1].points = (octree_ids){m->listed, left};
    m->nodes[2].points = (octree_ids){m->listed + right, MOVING_TREE_MOST - right};
    m->foreign = (octree_foreign_tree){.tick = 33, .nodes = m->nodes, .node_count = 3};
    m->about.foreign = random_below(&m->random, 3) ? &m->foreign : NULL;
    m->queries[0].visits[OCTREE_NODE_VISITED] = (octree_ids){m->met, 3};
}

/* Pairs that are mostly wrong; in some ticks the program has none. */
static void find_pairs(moving_tree *m)
{
    for (size_t i = 0; i < 2 && m->count > 2; i++)
        m->found[i] = (octree_pair){m->points[i].id, m->points[i + 1].id};
    m->pairs = (octree_foreign_pairs){.tick = 44, .pairs = m->found, .pair_count = m->count % 3};
    m->about.foreign_pairs = m->count > 2 && m->count % 4 ? &m->pairs : NULL;
}

void moving_tree_make(moving_tree *m, octree_full_leaf full_leaf, uint64_t seed)
{
    *m = (moving_tree){.random = seed, .tree = make_tree(cube(-REACH, REACH), 1, 2, full_leaf)};
    m->about.queries = m->queries;
    m->about.shapes = m->shapes;
    for (int i = 0; i < 30; i++)
        come(m);
    ask(m);
    show(m);
    grow_nodes(m);
    find_pairs(m);
}

void moving_tree_release(moving_tree *m)
{
    octree_destroy(m->tree);
}

void moving_tree_step(moving_tree *m)
{
    static void (*const changes[])(moving_tree *) = {come, leave, move, move, change_places, change_places};
    for (uint64_t left = random_below(&m->random, 12); left > 0; left--)
        changes[random_below(&m->random, sizeof changes / sizeof changes[0])](m);
    ask(m);
    show(m);
    grow_nodes(m);
    find_pairs(m);
}

octreel_recorder_def small_recorder(const moving_tree *m, const char *folder)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder;
    def.tree = octree_definition(m->tree);
    def.width = 160;
    def.height = 90;
    return def;
}

void assert_recorded(octreel_recorder *recorder, const moving_tree *m)
{
    if (octreel_recorder_tick(recorder, m->tree, &m->about) != OCTREEL_OK)
        fail_msg("%s", octreel_recorder_error(recorder));
}

void record_steps(octreel_recorder *recorder, moving_tree *m, int ticks)
{
    for (int i = 0; i < ticks; i++) {
        moving_tree_step(m);
        assert_recorded(recorder, m);
    }
}

octreel_recorder *open_recorder(const octreel_recorder_def *def)
{
    octreel_recorder *recorder;
    octreel_error error = {""};
    if (octreel_recorder_open(def, &recorder, &error) != OCTREEL_OK)
        fail_msg("%s", error.text);
    return recorder;
}

octreel_recorder *open_recorder_without_frames(const char *folder, size_t ring)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder;
    def.tree.world = cube(-8, 8);
    def.every = 0;
    def.ring = ring;
    return open_recorder(&def);
}

void close_recorder(octreel_recorder *recorder)
{
    if (octreel_recorder_close(recorder) != OCTREEL_OK)
        fail_msg("%s", octreel_recorder_error(recorder));
    octreel_recorder_destroy(recorder);
}

octreel_status record_tick_from(octreel_recorder *recorder, const moving_tree *m, moving_tree_source source,
                                moving_edits *e)
{
    octreel_tick_info about = m->about;
    if (source == MOVING_TREE)
        return octreel_recorder_tick(recorder, m->tree, &about);
    if (source == MOVING_LIST) {
        about.points = m->points;
        about.point_count = m->count;
    } else {
        about.changes = e->edits;
        about.change_count = e->count;
    }
    return octreel_recorder_tick(recorder, NULL, &about);
}

static void add_edit(moving_edits *e, octree_edit_kind kind, const octree_point *point)
{
    octree_edit *edit = &e->edits[e->count++];
    *edit = (octree_edit){.tick = 99, .kind = kind, .body = {.id = point->id, .velocity = {1, 2, 3}}};
    memcpy(edit->body.position, point->position, sizeof edit->body.position);
}

static const octree_point *point_of(const octree_point *points, size_t count, uint64_t id)
{
    for (size_t i = 0; i < count; i++)
        if (points[i].id == id)
            return &points[i];
    return NULL;
}

void moving_edits_make(moving_edits *e, const moving_tree *m)
{
    static const octree_point passing = {{1, 2, 3}, 424242};
    e->count = 0;
    for (size_t i = 0; i < e->before_count; i++)
        if (!point_of(m->points, m->count, e->before[i].id))
            add_edit(e, OCTREE_EDIT_REMOVE, &e->before[i]);
    add_edit(e, OCTREE_EDIT_INSERT, &passing); /* nothing comes of this one */
    for (size_t i = m->count; i-- > 0;) {
        const octree_point *old = point_of(e->before, e->before_count, m->points[i].id);
        if (!old)
            add_edit(e, OCTREE_EDIT_INSERT, &m->points[i]);
        if (i % 3 == 0) /* on the way */
            add_edit(e, OCTREE_EDIT_MOVE, &passing), e->edits[e->count - 1].body.id = m->points[i].id;
        if (i % 3 == 0 || old)
            add_edit(e, OCTREE_EDIT_MOVE, &m->points[i]);
    }
    add_edit(e, OCTREE_EDIT_REMOVE, &passing);
    memcpy(e->before, m->points, sizeof e->before);
    e->before_count = m->count;
}
