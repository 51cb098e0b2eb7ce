/* SPDX-License-Identifier: MIT */
/* test_recorder.c - a program records itself: the recording has the program's tree at every tick. */
#include "fixture.h"

#include <jansson.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"

enum { TICKS = 40 };

/* The test fails unless the recording has the trees that the program passed. */
static void record_and_compare(void **state, const octreel_recorder_def *def, moving_tree *m)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    uint64_t expected[TICKS], told[TICKS];
    octreel_recorder *recorder = open_recorder(def);
    for (int tick = 0; tick < TICKS; tick++) {
        assert_recorded(recorder, m);
        expected[tick] = octree_digest(m->tree);
        moving_tree_step(m);
    }
    close_recorder(recorder);
    assert_int_equal(tree_digests(folder.path, told, TICKS), TICKS);
    assert_memory_equal(told, expected, sizeof told);
    assert_films_again(&folder, &again, TICKS);
}

static void recording_has_the_tree_of_every_tick_and_replays_to_the_same_bytes(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    record_and_compare(state, &def, &m);
    moving_tree_release(&m);
}

/* Leaves hold one point and there are few levels: most moves meet a full leaf, and points exchange places. */
static void points_near_full_leaves_are_recorded_in_an_order_that_is_accepted(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_REFUSE, 2);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    record_and_compare(state, &def, &m);
    moving_tree_release(&m);
}

static void views_and_frame_intervals_of_the_definition_are_used(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 3);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.camera = "orbit";
    def.layers = "all";
    def.color_by = "occupancy";
    def.diagram = "beside";
    def.labels = true;
    def.lod = 0;
    def.aa = 2;
    def.every = 7;
    def.queue_ticks = 1;
    def.queue_bytes = 0;
    record_and_compare(state, &def, &m);
    moving_tree_release(&m);
}

static void recorder_without_frames_writes_ticks_and_draws_nothing(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 3);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.every = 0;
    record_and_compare(state, &def, &m);
    assert_false(file_exists(place_below(folder.path, "renderer.json").path));
    moving_tree_release(&m);
}

static size_t count_in_lines(const char *folder, const char *text)
{
    char *lines = file_read(place_below(folder, "ticks.jsonl").path, NULL);
    size_t count = 0;
    for (const char *at = lines; (at = strstr(at, text)); at++)
        count++;
    free(lines);
    return count;
}

/* The player is one of the points, whenever that exists; the others are the points that it may collide with. */
static void player_is_the_point_with_its_id_while_that_exists(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octree *tree = make_tree(cube(-8, 8), 1, 4, OCTREE_GROW);
    const double rest[3] = {4, 4, 4}, away[3] = {-4, -4, -4}, near[3] = {4, 4, 4.5};
    const octree_query about = {.kind = OCTREE_QUERY_NEAREST, .at_player = true};
    const octreel_tick_info asked = {.queries = &about, .query_count = 1};
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder.path;
    def.tree = octree_definition(tree);
    def.width = 160;
    def.height = 90;
    def.camera = "follow";
    def.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = 9, .box_size = 1};
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(octree_insert(tree, rest, 1), OCTREE_OK);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &asked), OCTREEL_OK); /* 0: does not exist */
    assert_int_equal(octree_insert(tree, away, 9), OCTREE_OK);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &asked), OCTREEL_OK); /* 1: far from the others */
    assert_int_equal(octree_move(tree, away, 9, near), OCTREE_OK);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &asked), OCTREEL_OK); /* 2: a hit */
    assert_int_equal(octree_remove(tree, near, 9), OCTREE_OK);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &asked), OCTREEL_OK); /* 3: removed */
    close_recorder(recorder);
    octree_destroy(tree);
    assert_int_equal(count_in_lines(folder.path, "\"player\": null"), 2);
    assert_int_equal(count_in_lines(folder.path, "\"collided\""), 1);
    assert_int_equal(count_in_lines(folder.path, "{\"nearest\": {\"target\""), 2);
    assert_films_again(&folder, &again, 4);
}

/* Without a player: a query at one of the program's points, which leaves that point out. */
static void query_at_a_point_leaves_out_that_point(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octree *tree = make_tree(cube(-8, 8), 1, 4, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{4, 4, 4}, {4, 4, 5}, {4, 4, 6}}, 3);
    const octree_query queries[] = {
        {.kind = OCTREE_QUERY_NEAREST, .target = {4, 4, 4}, .skip = OCTREE_SKIP_ID, .skip_id = 1},
        {.kind = OCTREE_QUERY_KNEAREST, .target = {4, 4, 4}, .k = 1, .skip = OCTREE_SKIP_COINCIDENT, .epsilon = 2},
        {.kind = OCTREE_QUERY_RANGE, .box = {{3, 3, 3}, {5, 5, 5}}, .skip = OCTREE_SKIP_ID, .skip_id = 1},
    };
    const octreel_tick_info asked = {.queries = queries, .query_count = 3};
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder.path;
    def.tree = octree_definition(tree);
    def.width = 160;
    def.height = 90;
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &asked), OCTREEL_OK);
    close_recorder(recorder);
    octree_destroy(tree);
    assert_int_equal(count_in_lines(folder.path, "\"skip\": 1, \"id\": 2,"), 1);
    assert_int_equal(count_in_lines(folder.path, "\"coincident\", \"epsilon\": 2, \"neighbors\": [{\"id\": 2,"), 1);
    assert_int_equal(count_in_lines(folder.path, "\"skip\": 1, \"ids\": [2]"), 1);
    assert_films_again(&folder, &again, 1);
}

/* A foreign tree, of which only boxes are recorded. */
static void shapes_are_recorded_without_a_tree(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const octree_shape shapes[] = {{0, OCTREE_SHAPE_BOX, {-8, -8, -8}, {0, 0, 0}, ""},
                                   {0, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, "theirs"}};
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder.path;
    def.width = 160;
    def.height = 90;
    octreel_recorder *recorder = open_recorder(&def);
    for (size_t tick = 0; tick < 3; tick++) {
        const octreel_tick_info about = {.shapes = shapes, .shape_count = tick};
        assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_OK);
    }
    close_recorder(recorder);
    assert_films_again(&folder, &again, 3);
}

static void disabled_recorder_does_nothing(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 4, OCTREE_GROW);
    assert_int_equal(octreel_recorder_tick(NULL, tree, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(NULL, NULL, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(NULL), OCTREEL_OK);
    assert_string_equal(octreel_recorder_error(NULL), "");
    octreel_recorder_destroy(NULL);
    octree_destroy(tree);
}

/* The program is faster than its frames are drawn: a refused tick is a gap, and nothing after it is lost. */
static void full_queue_is_reported_if_the_caller_never_waits(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    static uint64_t expected[2000], told[2000];
    size_t ticks = 0, busy = 0;
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 5);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.never_wait = true;
    def.queue_ticks = 1;
    octreel_recorder *recorder = open_recorder(&def);
    for (int i = 0; busy < 20 && i < 2000; i++) {
        moving_tree_step(&m);
        while (i == 1 &&
               !file_exists(frame_place(folder.path, 0).path)) /* until tick 0 is filmed, all ticks are refused */
            sched_yield();
        const octreel_status status = octreel_recorder_tick(recorder, m.tree, &m.about);
        if (status != OCTREEL_OK)
            assert_int_equal(status, OCTREEL_BUSY);
        expected[ticks++] = status == OCTREEL_OK ? octree_digest(m.tree) : 0;
        busy += status == OCTREEL_BUSY;
    }
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    assert_non_null(strstr(octreel_recorder_error(recorder), "20 of "));
    octreel_recorder_destroy(recorder);
    moving_tree_release(&m);
    assert_true(busy == 20 && ticks > 21);
    assert_int_equal(tree_digests(folder.path, told, 2000), ticks);
    assert_memory_equal(told, expected, ticks * sizeof *told);
    assert_films_again(&folder, &again, ticks);
}

static void recorder_does_not_change_signal_handling(void **state)
{
    const place folder = place_in(*state, "film");
    sigset_t before, after;
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 7);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    assert_int_equal(sigprocmask(SIG_SETMASK, NULL, &before), 0);
    octreel_recorder *recorder = open_recorder(&def);
    record_steps(recorder, &m, 3);
    assert_int_equal(sigprocmask(SIG_SETMASK, NULL, &after), 0);
    for (int signal = 1; signal < 32; signal++)
        assert_int_equal(sigismember(&before, signal), sigismember(&after, signal));
    octreel_recorder_destroy(recorder); /* also closes the recorder */
    moving_tree_release(&m);
    assert_nothing_half_written(folder.path);
    assert_true(file_exists(place_below(folder.path, "index.html").path));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(recording_has_the_tree_of_every_tick_and_replays_to_the_same_bytes),
        TEST(points_near_full_leaves_are_recorded_in_an_order_that_is_accepted),
        TEST(views_and_frame_intervals_of_the_definition_are_used),
        TEST(recorder_without_frames_writes_ticks_and_draws_nothing),
        TEST(player_is_the_point_with_its_id_while_that_exists),
        TEST(query_at_a_point_leaves_out_that_point),
        TEST(shapes_are_recorded_without_a_tree),
        cmocka_unit_test(disabled_recorder_does_nothing),
        TEST(full_queue_is_reported_if_the_caller_never_waits),
        TEST(recorder_does_not_change_signal_handling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
