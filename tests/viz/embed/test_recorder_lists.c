/* SPDX-License-Identifier: MIT */
/* test_recorder_lists.c - a program without an octree passes its points as lists or as changes. */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

enum { TICKS = 30 };

/* Record the same program, with these sources in turn. */
static void record_by(const char *folder, const moving_tree_source sources[2], size_t ring)
{
    moving_tree m;
    moving_edits edits = {.count = 0};
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder);
    def.ring = ring;
    octreel_recorder *recorder = open_recorder(&def);
    for (int tick = 0; tick < TICKS; tick++) {
        moving_edits_make(&edits, &m);
        if (record_tick_from(recorder, &m, sources[tick % 2], &edits) != OCTREEL_OK)
            fail_msg("tick %d: %s", tick, octreel_recorder_error(recorder));
        moving_tree_step(&m);
    }
    if (ring)
        assert_int_equal(octreel_recorder_write(recorder, folder, NULL), OCTREEL_OK);
    close_recorder(recorder);
    moving_tree_release(&m);
}

static void check_sources(void **state, size_t ring)
{
    static const moving_tree_source sources[][2] = {{MOVING_TREE, MOVING_TREE},
                                                    {MOVING_LIST, MOVING_LIST},
                                                    {MOVING_CHANGES, MOVING_CHANGES},
                                                    {MOVING_LIST, MOVING_CHANGES}};
    place folders[4];
    for (size_t i = 0; i < 4; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%zu", i);
        folders[i] = place_in(*state, name);
        record_by(folders[i].path, sources[i], ring);
        assert_same_folders(folders[0].path, folders[i].path, NULL);
    }
}

static void lists_and_changes_give_the_recording_of_the_tree(void **state)
{
    check_sources(state, 0);
}

static void lists_and_changes_give_the_same_recording_from_a_ring(void **state)
{
    check_sources(state, 4);
}

/* ---- Small ticks by hand ------------------------------------------------------------------------------------ */

typedef struct film {
    place folder;
    octreel_recorder *recorder;
} film;

/* The default definition, which refuses points in full leaves; its leaves hold one point. */
static film open_film(void **state, size_t ring)
{
    film f = {.folder = place_in(*state, "film")};
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = f.folder.path;
    def.tree.world = cube(-8, 8);
    def.tree.leaf_capacity = 1;
    def.tree.max_depth = 3;
    def.tree.full_leaf = OCTREE_REFUSE;
    def.every = 0;
    def.ring = ring;
    f.recorder = open_recorder(&def);
    return f;
}

static octreel_status list_tick(film *f, const octree_point *points, size_t count)
{
    return octreel_recorder_tick(f->recorder, NULL, &(octreel_tick_info){.points = points, .point_count = count});
}

static octreel_status change_tick(film *f, octree_edit_kind kind, uint64_t id, double x)
{
    const octree_edit edit = {.kind = kind, .body = {.id = id, .position = {x, 1, 1}}};
    return octreel_recorder_tick(f->recorder, NULL, &(octreel_tick_info){.changes = &edit, .change_count = 1});
}

/* Append the ids of the stored points of a tick and a blank; '-' for a gap, and 'R' for a tick with a refusal. */
static void note_points(const char *line, size_t number, void *context)
{
    char *told = context, *end = told + strlen(told);
    const char *points = strstr(line, "\"tree\": {\"points\": ");
    snprintf(end, 16, "%s%s%.1s", number ? " " : "", strstr(line, "\"refused\"") ? "R" : "",
             points ? points + strlen("\"tree\": {\"points\": ") : "-");
}

static void assert_told(film *f, octreel_status closes, const char *expected)
{
    char told[400] = "";
    const octreel_status status = octreel_recorder_close(f->recorder);
    if (status != closes)
        fail_msg("%s", octreel_recorder_error(f->recorder));
    octreel_recorder_destroy(f->recorder);
    for_each_line(f->folder.path, note_points, told);
    assert_string_equal(told, expected);
    command_result result = run_octreel(NULL, "verify %s", f->folder.path);
    assert_done(&result);
    command_release(&result);
}

static const octree_point three[] = {{{1, 1, 1}, 7}, {{1, 1, 1}, 3}, {{1, 1, 1}, 5}};

/* An empty C++ vector has null data. */
static void omitted_list_is_empty_and_omitted_changes_are_none(void **state)
{
    film f = open_film(state, 0);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(list_tick(&f, three, 1), OCTREEL_OTHER_TREE); /* the header says that full leaves refuse */
    octreel_recorder_destroy(f.recorder);
    f = (film){.folder = place_in(*state, "other")};
    film g = open_film(state, 2); /* a ring's header is not written yet */
    assert_int_equal(octreel_recorder_tick(g.recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(list_tick(&g, three, 3), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(g.recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(g.recorder, f.folder.path, NULL), OCTREEL_OK);
    g.folder = f.folder;
    assert_told(&g, OCTREEL_OK, "3 0");
}

static void thousands_of_points_are_inserted_moved_and_removed_at_once(void **state)
{
    enum { MANY = 3000 };
    static octree_point points[MANY];
    film f = open_film(state, 0);
    for (int i = 0; i < MANY; i++)
        points[i] = (octree_point){{i % 15 - 7, i / 15 % 15 - 7, i / 225 - 7}, (uint64_t)i};
    assert_int_equal(list_tick(&f, points, 1), OCTREEL_OK);
    assert_int_equal(list_tick(&f, points, MANY), OCTREEL_OK);
    for (int i = 0; i < MANY; i++)
        points[i].position[0] += 0.5;
    assert_int_equal(list_tick(&f, points, MANY), OCTREEL_OK);
    assert_int_equal(list_tick(&f, points, MANY / 2), OCTREEL_OK);
    assert_told(&f, OCTREEL_OK, "1 3 3 1");
}

static void leaves_of_lists_grow_and_changes_continue_from_lists(void **state)
{
    film f = open_film(state, 0);
    assert_int_equal(list_tick(&f, three, 3), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_INSERT, 9, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, NULL), OCTREEL_OK); /* nothing changed */
    assert_int_equal(change_tick(&f, OCTREE_EDIT_REMOVE, 3, NAN), OCTREEL_OK);
    assert_int_equal(list_tick(&f, three, 0), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_INSERT, 3, 1), OCTREEL_OK);
    assert_told(&f, OCTREEL_OK, "3 4 4 3 0 1");
}

static void point_outside_the_world_is_refused_until_it_returns(void **state)
{
    film f = open_film(state, 0);
    const octree_point out[] = {{{1, 1, 1}, 7}, {{9, 1, 1}, 3}};
    assert_int_equal(list_tick(&f, out, 2), OCTREEL_OK);
    assert_int_equal(list_tick(&f, out, 2), OCTREEL_OK);
    assert_int_equal(list_tick(&f, three, 2), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_MOVE, 7, -8.5), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_MOVE, 7, 8.5), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_MOVE, 7, 8), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_MOVE, 3, 1e300), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_REMOVE, 3, 0), OCTREEL_OK);
    assert_told(&f, OCTREEL_OK, "R1 1 2 R1 R1 2 R1 1");
}

/* Tick 0 of a ring has the points that are outside by then. */
static void ring_remembers_points_outside_the_world(void **state)
{
    film f = open_film(state, 3);
    const octree_point out[] = {{{1, 1, 1}, 7}, {{9, 1, 1}, 3}};
    assert_int_equal(list_tick(&f, out, 2), OCTREEL_OK);
    for (int i = 0; i < 4; i++)
        assert_int_equal(list_tick(&f, out, 2), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_MOVE, 3, 2), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(f.recorder, f.folder.path, NULL), OCTREEL_OK);
    assert_told(&f, OCTREEL_OK, "R1 1 2");
}

/* ---- Refused ticks ------------------------------------------------------------------------------------------ */

/* The other changes are recorded with the next tick. */
static void changes_of_a_refused_tick_are_not_lost(void **state)
{
    film f = open_film(state, 0);
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    const octree_edit good[] = {{.kind = OCTREE_EDIT_INSERT, .body = {.id = 4, .position = {4, 4, 4}}}};
    const octree_edit mixed[] = {{.kind = OCTREE_EDIT_INSERT, .body = {.id = 5, .position = {5, 5, 5}}},
                                 {.kind = OCTREE_EDIT_MOVE, .body = {.id = 4, .position = {0, NAN, 0}}},
                                 {.kind = OCTREE_EDIT_REMOVE, .body = {.id = 77}},
                                 {.kind = OCTREE_EDIT_INSERT, .body = {.id = 6, .position = {6, 6, 6}}}};
    octreel_tick_info about = {.changes = good, .change_count = 1, .queries = &bad, .query_count = 1};
    assert_int_equal(list_tick(&f, three, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, NULL), OCTREEL_OK);
    about = (octreel_tick_info){.changes = mixed, .change_count = 4};
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &about), OCTREEL_BAD_POINT);
    assert_string_equal(octreel_recorder_error(f.recorder), "changes[1]: a coordinate is NaN or infinite");
    assert_int_equal(change_tick(&f, OCTREE_EDIT_REMOVE, 6, 0), OCTREEL_OK);
    assert_told(&f, OCTREEL_GAPS, "1 - 2 - 3");
}

/* The changes of a refused tick before it stay. */
static void list_of_a_refused_tick_is_forgotten(void **state)
{
    film f = open_film(state, 0);
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    const octree_edit insertion = {.kind = OCTREE_EDIT_INSERT, .body = {.id = 4, .position = {4, 4, 4}}};
    octreel_tick_info about = {.changes = &insertion, .change_count = 1, .queries = &bad, .query_count = 1};
    assert_int_equal(list_tick(&f, three, 1), OCTREEL_OK);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_INSERT, 9, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &about), OCTREEL_BAD_QUERY);
    about = (octreel_tick_info){.points = three, .point_count = 3, .queries = &bad, .query_count = 1};
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_INSERT, 5, 1), OCTREEL_OK); /* the list has it already */
    assert_told(&f, OCTREEL_GAPS, "1 2 - - 4");
}

static void assert_refused(film *f, const octreel_tick_info *about, octreel_status why, const char *sentence)
{
    assert_int_equal(octreel_recorder_tick(f->recorder, NULL, about), why);
    assert_string_equal(octreel_recorder_error(f->recorder), sentence);
}

static void invalid_lists_and_changes_are_refused_with_the_reason(void **state)
{
    film f = open_film(state, 0);
    const octree_point twice[] = {{{1, 1, 1}, 7}, {{2, 1, 1}, 3}, {{3, 1, 1}, 7}}, infinite = {{0, 0, INFINITY}, 1},
                       large = {{0}, UINT64_C(1) << 53};
    octree_edit edit = {.kind = OCTREE_EDIT_INSERT, .body = {.id = 7}};
    octreel_tick_info about = {.points = twice, .point_count = 3};
    assert_refused(&f, &about, OCTREEL_DUPLICATE_ID, "points: two points have the id 7");
    about.points = NULL;
    assert_refused(&f, &about, OCTREEL_NULL_ARGUMENT, "a required pointer is null");
    about = (octreel_tick_info){.points = &infinite, .point_count = 1};
    assert_refused(&f, &about, OCTREEL_BAD_POINT, "points[0]: a coordinate is NaN or infinite");
    about.points = &large;
    assert_refused(&f, &about, OCTREEL_BAD_ID,
                   "points: an id is 2^53 or larger, which session files cannot store: 9007199254740992");
    assert_int_equal(list_tick(&f, three, 3), OCTREEL_OK);
    about = (octreel_tick_info){.changes = &edit, .change_count = 1};
    assert_refused(&f, &about, OCTREEL_DUPLICATE_ID, "changes[0]: point 7 exists already");
    edit.body.id = UINT64_MAX;
    assert_refused(&f, &about, OCTREEL_BAD_ID,
                   "changes[0]: an id is 2^53 or larger, which session files cannot store: 18446744073709551615");
    edit = (octree_edit){.kind = OCTREE_EDIT_MOVE, .body = {.id = 8}};
    assert_refused(&f, &about, OCTREEL_NO_POINT, "changes[0]: point 8 does not exist");
    edit.kind = (octree_edit_kind)3;
    assert_refused(&f, &about, OCTREEL_BAD_POINT, "changes[0]: unknown kind of edit");
    about.changes = NULL;
    assert_refused(&f, &about, OCTREEL_NULL_ARGUMENT, "a required pointer is null");
    assert_told(&f, OCTREEL_GAPS, "- - - - 3 - - - - -");
}

static void points_from_two_sources_are_refused(void **state)
{
    film f = open_film(state, 0);
    octree *tree = make_tree(cube(-8, 8), 1, 3, OCTREE_REFUSE);
    const octree_edit edit = {.kind = OCTREE_EDIT_INSERT, .body = {.id = 7}};
    const octreel_tick_info list = {.points = three, .point_count = 1}, changes = {.changes = &edit, .change_count = 1},
                            both = {.points = three, .point_count = 1, .changes = &edit, .change_count = 1};
    assert_refused(&f, &both, OCTREEL_TWO_SOURCES, octreel_status_text(OCTREEL_TWO_SOURCES));
    assert_int_equal(octreel_recorder_tick(f.recorder, tree, &list), OCTREEL_TWO_SOURCES);
    assert_int_equal(octreel_recorder_tick(f.recorder, tree, &changes), OCTREEL_TWO_SOURCES);
    assert_int_equal(octreel_recorder_tick(f.recorder, tree, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &list), OCTREEL_TWO_SOURCES);
    assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &changes), OCTREEL_TWO_SOURCES);
    assert_told(&f, OCTREEL_GAPS, "- - - 0 - -");
    f.folder = place_in(*state, "other");
    film g = open_film(state, 1);
    assert_int_equal(octreel_recorder_tick(g.recorder, NULL, &changes), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(g.recorder, tree, NULL), OCTREEL_TWO_SOURCES);
    octreel_recorder_destroy(g.recorder);
    octree_destroy(tree);
}

/* While the queue is full, point 3 moves to and fro: the result is one change. */
static void waiting_changes_are_combined(void **state)
{
    film f = open_film(state, 0);
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    octree_edit edits[700];
    const octreel_tick_info about = {.changes = edits, .change_count = 700, .queries = &bad, .query_count = 1};
    assert_int_equal(list_tick(&f, three, 3), OCTREEL_OK);
    for (int i = 0; i < 700; i++)
        edits[i] = (octree_edit){.kind = OCTREE_EDIT_MOVE, .body = {.id = 3, .position = {i % 5, 0, 0}}};
    for (int i = 0; i < 10; i++)
        assert_int_equal(octreel_recorder_tick(f.recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(change_tick(&f, OCTREE_EDIT_REMOVE, 5, 0), OCTREEL_OK);
    assert_told(&f, OCTREEL_GAPS, "3 - - - - - - - - - - 2");
    command_result result = run_script("grep -c '^{\"tick\": 11, \"edits\": \\[{\"remove\": 5}, {\"move\": {\"id\": 3, "
                                       "\"position\": \\[4, 0, 0\\]}}\\]}' %s",
                                       place_below(f.folder.path, "session.json").path);
    assert_string_equal(result.out, "1\n");
    command_release(&result);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(lists_and_changes_give_the_recording_of_the_tree),
        TEST(lists_and_changes_give_the_same_recording_from_a_ring),
        TEST(omitted_list_is_empty_and_omitted_changes_are_none),
        TEST(thousands_of_points_are_inserted_moved_and_removed_at_once),
        TEST(leaves_of_lists_grow_and_changes_continue_from_lists),
        TEST(point_outside_the_world_is_refused_until_it_returns),
        TEST(ring_remembers_points_outside_the_world),
        TEST(changes_of_a_refused_tick_are_not_lost),
        TEST(list_of_a_refused_tick_is_forgotten),
        TEST(invalid_lists_and_changes_are_refused_with_the_reason),
        TEST(points_from_two_sources_are_refused),
        TEST(waiting_changes_are_combined),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
