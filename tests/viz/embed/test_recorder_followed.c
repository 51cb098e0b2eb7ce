/* SPDX-License-Identifier: MIT */
/* test_recorder_followed.c - a tree that reports its changes to the recorder gives the same recording as one that the
 * recorder compares, whatever changes. */
#include "fixture.h"

#include <stdio.h>
#include <string.h>

#include "brute.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

enum { TICKS = 60, MOST = 3000 };

/* A program and the pending changes to its tree. */
typedef struct program {
    octree *tree;
    uint64_t random, next_id;
    octree_full_leaf full_leaf;
    octree_point points[MOST];
    double to[MOST][3];
} program;

static const octree_box world = {{-32, -32, -32}, {32, 32, 32}};

static void random_place(program *p, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(&p->random, 257) / 4 - 32;
    if (random_below(&p->random, 5) == 0)
        at[0] = -0.0;
}

/* Choose some points, and where each is to move. */
static size_t choose(program *p, size_t most)
{
    brute all = {0};
    assert_int_equal(octree_range(p->tree, &world, brute_collect, &all), OCTREE_OK);
    const size_t count = all.count ? random_below(&p->random, most) : 0;
    for (size_t i = 0; i < count; i++) {
        p->points[i] = all.points[random_below(&p->random, all.count)];
        random_place(p, p->to[i]);
    }
    brute_free(&all);
    return count;
}

static void move_singly(program *p)
{
    const size_t count = choose(p, 30);
    for (size_t i = 0; i < count; i++)
        octree_move(p->tree, p->points[i].position, p->points[i].id, p->to[i]);
}

static void move_at_once(program *p)
{
    const size_t count = choose(p, random_below(&p->random, 4) ? 60 : MOST);
    assert_int_equal(octree_move_many(p->tree, p->points, (const double(*)[3])p->to, count, NULL, NULL), OCTREE_OK);
}

static void remove_at_once(program *p)
{
    const size_t count = choose(p, 30);
    assert_int_equal(octree_remove_many(p->tree, p->points, count, NULL, NULL), OCTREE_OK);
}

static void insert_at_once(program *p)
{
    const size_t count = random_below(&p->random, octree_count(p->tree) < 500 ? 1500 : 40);
    for (size_t i = 0; i < count; i++) {
        random_place(p, p->points[i].position);
        p->points[i].id = p->next_id++;
    }
    assert_int_equal(octree_insert_many(p->tree, p->points, count, NULL, NULL), OCTREE_OK);
}

/* Insert a point at its new position, and then remove it from the old one. */
static void insert_then_remove(program *p)
{
    const size_t count = choose(p, 20);
    for (size_t i = 0; i < count; i++)
        if (octree_insert(p->tree, p->to[i], p->points[i].id) == OCTREE_OK &&
            octree_remove(p->tree, p->points[i].position, p->points[i].id) != OCTREE_OK)
            octree_remove(p->tree, p->to[i], p->points[i].id); /* the point was moved already: undo the insertion */
}

static void there_and_back(program *p)
{
    const size_t count = choose(p, 20);
    for (size_t i = 0; i < count; i++)
        if (octree_move(p->tree, p->points[i].position, p->points[i].id, p->to[i]) == OCTREE_OK)
            octree_move(p->tree, p->to[i], p->points[i].id, p->points[i].position);
}

/* Add a second point with an existing id, or remove it again. */
static void twin(program *p)
{
    static const double corner[3] = {31, 31, 31};
    uint64_t id;
    if (octree_find(p->tree, corner, &id) == OCTREE_OK)
        octree_remove(p->tree, corner, id);
    else if (choose(p, 2))
        octree_insert(p->tree, corner, p->points[0].id);
}

/* Add a point with an id that no file can hold, or remove it again. */
static void large_id(program *p)
{
    static const double corner[3] = {-31, 31, 31};
    const uint64_t large = UINT64_C(1) << 53;
    if (octree_remove(p->tree, corner, large) == OCTREE_NOT_FOUND)
        octree_insert(p->tree, corner, large);
}

static void rebuild(program *p)
{
    octree_compact(p->tree);
}

static void clear(program *p)
{
    octree_clear(p->tree);
    insert_at_once(p);
}

static void do_nothing(program *p)
{
    (void)p;
}

static void change(program *p)
{
    static void (*const often[])(program *) = {move_singly,    move_at_once,       remove_at_once,
                                               insert_at_once, insert_then_remove, there_and_back};
    static void (*const seldom[])(program *) = {twin, large_id, rebuild, clear, do_nothing};
    for (uint64_t left = random_below(&p->random, 4); left > 0; left--)
        often[random_below(&p->random, sizeof often / sizeof *often)](p);
    if (random_below(&p->random, 4) == 0)
        seldom[random_below(&p->random, sizeof seldom / sizeof *seldom)](p);
}

/* A tree with the same contents, but without a log of changes. */
static octree *copy_tree(const octree *tree)
{
    const octree_def def = octree_definition(tree);
    brute all = {0};
    octree *made;
    assert_int_equal(octree_create(&def, &made), OCTREE_OK);
    assert_int_equal(octree_range(tree, &world, brute_collect, &all), OCTREE_OK);
    assert_int_equal(octree_insert_many(made, all.points, all.count, NULL, NULL), OCTREE_OK);
    brute_free(&all);
    return made;
}

static octreel_recorder *record_into(const program *p, const char *folder, size_t ring)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder;
    def.tree = octree_definition(p->tree);
    def.every = 0;
    def.ring = ring;
    return open_recorder(&def);
}

/* One recorder gets the tree, another one a copy, and a third one the tree in some ticks. All must record the same. */
static void play(program *p, octreel_recorder *recorders[3])
{
    for (int tick = 0; tick < TICKS; tick++) {
        const octree_query bad = {.kind = OCTREE_QUERY_KINDS};
        const octreel_tick_info refused = {.queries = &bad, .query_count = 1},
                                *about = random_below(&p->random, 9) ? NULL : &refused;
        octree *copy = copy_tree(p->tree);
        const octreel_status status = octreel_recorder_tick(recorders[0], p->tree, about);
        assert_int_equal(octreel_recorder_tick(recorders[1], copy, about), status);
        assert_string_equal(octreel_recorder_error(recorders[0]), octreel_recorder_error(recorders[1]));
        octree_destroy(copy);
        octreel_recorder_tick(recorders[2], random_below(&p->random, 2) ? p->tree : NULL, NULL);
        change(p);
    }
}

static void check(void **state, octree_full_leaf full_leaf, size_t ring)
{
    for (uint64_t seed = 0; seed < 6; seed++) {
        static program p;
        p = (program){.random = seed, .full_leaf = full_leaf};
        const octree_def def = define(world, 4, 4, full_leaf);
        assert_int_equal(octree_create(&def, &p.tree), OCTREE_OK);
        insert_at_once(&p);
        octreel_recorder *recorders[3];
        place folders[3];
        for (int i = 0; i < 3; i++) {
            char name[32];
            snprintf(name, sizeof name, "film%d_%d", (int)seed, i);
            folders[i] = place_in(*state, name);
            recorders[i] = record_into(&p, folders[i].path, ring);
        }
        play(&p, recorders);
        for (int i = 0; i < 3; i++) {
            if (ring)
                octreel_recorder_write(recorders[i], folders[i].path, NULL);
            octreel_recorder_close(recorders[i]);
            octreel_recorder_destroy(recorders[i]);
        }
        assert_same_folders(folders[0].path, folders[1].path, NULL);
        octree_destroy(p.tree);
    }
}

static void followed_changes_give_the_recording_of_compared_trees(void **state)
{
    check(state, OCTREE_GROW, 0);
}

static void followed_changes_give_the_same_recording_if_leaves_refuse(void **state)
{
    check(state, OCTREE_REFUSE, 0);
}

static void followed_changes_give_the_same_recording_from_a_ring(void **state)
{
    check(state, OCTREE_GROW, 5);
}

/* ---- What it costs ------------------------------------------------------------------------------------------ */

static size_t memory_of(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.memory;
}

/* Two alternating trees have two logs, which do not contain each other's changes. */
static void alternating_trees_are_not_confused(void **state)
{
    const octree_def def = define(world, 4, 6, OCTREE_GROW);
    octree *trees[2];
    place folders[2];
    octreel_recorder *recorders[2];
    for (int i = 0; i < 2; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%d", i);
        folders[i] = place_in(*state, name);
        assert_int_equal(octree_create(&def, &trees[i]), OCTREE_OK);
        recorders[i] = record_into(&(program){.tree = trees[i]}, folders[i].path, 0);
    }
    for (uint64_t id = 0; id < 40; id++) {
        const double at[3] = {(double)(id % 7), (double)(id % 5), 1};
        octree *now = trees[id / 3 % 2], *copy;
        assert_int_equal(octree_insert(now, at, id), OCTREE_OK);
        copy = copy_tree(now);
        assert_int_equal(octreel_recorder_tick(recorders[0], now, NULL), OCTREEL_OK);
        assert_int_equal(octreel_recorder_tick(recorders[1], copy, NULL), OCTREEL_OK);
        octree_destroy(copy);
    }
    for (int i = 0; i < 2; i++) {
        close_recorder(recorders[i]);
        octree_destroy(trees[i]);
    }
    assert_same_folders(folders[0].path, folders[1].path, NULL);
}

/* A tree keeps its log while few points change, but not if all points move. One leaf holds all points, so that moves
 * take no other memory. */
static void tree_keeps_its_changes_while_they_are_few(void **state)
{
    enum { COUNT = 4000, FEW = 6, CALM = 14, ALL = 20 };
    const octree_def def = define(world, COUNT, 6, OCTREE_GROW);
    static program p;
    p = (program){.random = 3};
    assert_int_equal(octree_create(&def, &p.tree), OCTREE_OK);
    for (uint64_t id = 0; id < COUNT; id++)
        assert_int_equal(octree_insert(p.tree, (double[3]){0, 0, 0}, id), OCTREE_OK);
    const size_t alone = memory_of(p.tree);
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = record_into(&p, folder.path, 4);
    for (int tick = 0; tick < ALL; tick++) {
        const uint64_t moved = tick < FEW || tick >= CALM ? 3 : COUNT;
        assert_int_equal(octreel_recorder_tick(recorder, p.tree, NULL), OCTREEL_OK);
        for (uint64_t id = 0; id < moved; id++) {
            double from[3] = {0, 0, 0}, to[3] = {0, 0, (double)(tick + 1)};
            for (from[2] = tick; octree_move(p.tree, from, id, to) != OCTREE_OK; from[2]--)
                assert_true(from[2] > 0);
        }
        if (tick < FEW || tick > CALM + 1)
            assert_true(memory_of(p.tree) > alone);
        else if (tick <= CALM)
            assert_int_equal(memory_of(p.tree), alone);
    }
    close_recorder(recorder);
    octree_destroy(p.tree);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(followed_changes_give_the_recording_of_compared_trees),
        TEST(followed_changes_give_the_same_recording_if_leaves_refuse),
        TEST(followed_changes_give_the_same_recording_from_a_ring),
        TEST(alternating_trees_are_not_confused),
        TEST(tree_keeps_its_changes_while_they_are_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
