/* SPDX-License-Identifier: MIT */
/* test_recorder_bodies.c - bodies are recorded with their half extents. */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film_again.h"
#include "moving_tree.h"

static const octree_body boxes[] = {{{4, 0, 0}, {1, 2, 0.5}, 7}, {{-4, 1, 0}, {0, 0, 0}, 9}, {{0, 0, 3}, {2, 0, 0}, 5}};

static octree_edit make_edit(octree_edit_kind kind, const octree_body *body)
{
    octree_edit edit = {.kind = kind, .body.id = body->id};
    memcpy(edit.body.position, body->position, sizeof edit.body.position);
    memcpy(edit.body.half, body->half, sizeof edit.body.half);
    return edit;
}

static octreel_status change_tick(octreel_recorder *recorder, octree_edit_kind kind, const octree_body *body)
{
    const octree_edit edit = make_edit(kind, body);
    return octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.changes = &edit, .change_count = 1});
}

/* Insert bodies, of which those with the same ids are removed first. */
static octreel_status insert_tick(octreel_recorder *recorder, const octree_body *bodies, size_t count, bool replaced)
{
    octree_edit edits[8];
    size_t edit_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (replaced)
            edits[edit_count++] = make_edit(OCTREE_EDIT_REMOVE, &bodies[i]);
        edits[edit_count++] = make_edit(OCTREE_EDIT_INSERT, &bodies[i]);
    }
    return octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.changes = edits, .change_count = edit_count});
}

static void assert_session_contains(const place *folder, const char *part)
{
    size_t size;
    char *text = file_read(place_below(folder->path, "session.json").path, &size);
    assert_contains(text, part);
    free(text);
}

/* ---- Sources ------------------------------------------------------------------------------------------------- */

static void body_that_moves_and_changes_is_recorded_with_its_extents(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_body now = boxes[0];
    assert_int_equal(insert_tick(recorder, boxes, 2, false), OCTREEL_OK);
    now.position[1] = 5;
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &now), OCTREEL_OK);
    now.half[2] = 0.25;
    now.position[1] = 6;
    assert_int_equal(insert_tick(recorder, &now, 1, true), OCTREEL_OK);
    close_recorder(recorder);
    assert_session_contains(
        &folder, "\"points\": [\n{\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]},\n[-4, 1, 0, 9]\n]}\n"
                 "{\"tick\": 1, \"edits\": [{\"move\": {\"id\": 7, \"position\": [4, 5, 0]}}]}\n"
                 "{\"tick\": 2, \"edits\": [{\"remove\": 7}, "
                 "{\"insert\": {\"id\": 7, \"position\": [4, 5, 0], \"half\": [1, 2, 0.25]}}, "
                 "{\"move\": {\"id\": 7, \"position\": [4, 6, 0]}}]}\n");
    assert_films_again(&folder, &again, 3);
}

static void moves_and_removals_do_not_read_extents(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_body moved = boxes[0];
    moved.half[0] = NAN;
    moved.position[0] = 2;
    assert_int_equal(insert_tick(recorder, boxes, 2, false), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &moved), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_REMOVE, &moved), OCTREEL_OK);
    close_recorder(recorder);
    assert_session_contains(&folder, "{\"tick\": 1, \"edits\": [{\"move\": {\"id\": 7, \"position\": [2, 0, 0]}}]}\n"
                                     "{\"tick\": 2, \"edits\": [{\"remove\": 7}]}\n");
}

/* A body keeps its extents while it is outside the world. */
static void body_returns_into_the_world_with_its_extents(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_body outside = boxes[0];
    outside.position[0] = 9;
    assert_int_equal(insert_tick(recorder, boxes, 1, false), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &outside), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, boxes), OCTREEL_OK);
    close_recorder(recorder);
    assert_session_contains(&folder, "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], "
                                     "\"half\": [1, 2, 0.5]}}]}\n");
}

/* ---- Rings and refused ticks --------------------------------------------------------------------------------- */

static void ring_begins_with_the_extents_of_its_first_tick(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(NULL, 1);
    assert_int_equal(insert_tick(recorder, boxes, 2, false), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
    close_recorder(recorder);
    assert_session_contains(&folder, "{\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]}");
}

static void assert_refused(octreel_recorder *recorder, const octreel_tick_info *about, octreel_status why,
                           const char *sentence)
{
    assert_int_equal(octreel_recorder_tick(recorder, NULL, about), why);
    assert_string_equal(octreel_recorder_error(recorder), sentence);
}

/* The valid changes of the refused tick are recorded with the next tick; the removal of 7 is one of them. */
static void invalid_extents_of_a_change_drop_only_this_change(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_body bad = boxes[0], large = boxes[1];
    bad.half[1] = -1;
    large.half[0] = 2;
    const octree_edit edits[] = {make_edit(OCTREE_EDIT_REMOVE, &large), make_edit(OCTREE_EDIT_INSERT, &large),
                                 make_edit(OCTREE_EDIT_REMOVE, &bad), make_edit(OCTREE_EDIT_INSERT, &bad)};
    assert_int_equal(insert_tick(recorder, boxes, 2, false), OCTREEL_OK);
    assert_refused(recorder, &(octreel_tick_info){.changes = edits, .change_count = 4}, OCTREEL_BAD_POINT,
                   "changes[3]: a half extent is negative, NaN or infinite");
    assert_int_equal(octreel_recorder_tick(recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_session_contains(&folder, "{\"tick\": 2, \"edits\": [{\"remove\": 9}, "
                                     "{\"insert\": {\"id\": 9, \"position\": [-4, 1, 0], \"half\": [2, 0, 0]}}, "
                                     "{\"remove\": 7}]}\n");
    assert_films_again(&folder, &again, 3);
}

/* While ticks are refused, a body changes its extents to and fro: the result is one change, or none. */
static void waiting_changes_of_extents_are_combined(void **state)
{
    enum { EDITS = 700 };
    static octree_edit edits[EDITS];
    const place folder = place_in(*state, "film");
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    const octreel_tick_info about = {.changes = edits, .change_count = EDITS, .queries = &bad, .query_count = 1};
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(insert_tick(recorder, boxes, 2, false), OCTREEL_OK);
    for (int i = 0; i < EDITS; i++) {
        edits[i] = make_edit(i % 2 ? OCTREE_EDIT_INSERT : OCTREE_EDIT_REMOVE, &boxes[i / 2 % 2]);
        edits[i].body.half[0] = i >= EDITS - 4 && i / 2 % 2 == 0 ? 1 : i;
    }
    edits[EDITS - 1].body.half[0] = 6;
    for (int i = 0; i < 10; i++)
        assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_session_contains(&folder, "{\"tick\": 11, \"edits\": [{\"remove\": 9}, "
                                     "{\"insert\": {\"id\": 9, \"position\": [-4, 1, 0], \"half\": [6, 0, 0]}}]}\n");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(body_that_moves_and_changes_is_recorded_with_its_extents),
        TEST(moves_and_removals_do_not_read_extents),
        TEST(body_returns_into_the_world_with_its_extents),
        TEST(ring_begins_with_the_extents_of_its_first_tick),
        TEST(invalid_extents_of_a_change_drop_only_this_change),
        TEST(waiting_changes_of_extents_are_combined),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
