/* SPDX-License-Identifier: MIT */
/* test_recorder_bodies.c - bodies are recorded with their half extents, from changes, lists and sets. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "body_sets.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

static const octree_body boxes[] = {{{4, 0, 0}, {1, 2, 0.5}, 7}, {{-4, 1, 0}, {0, 0, 0}, 9}, {{0, 0, 3}, {2, 0, 0}, 5}};

static octreel_status list_tick(octreel_recorder *recorder, const octree_body *bodies, size_t count)
{
    return octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.bodies = bodies, .body_count = count});
}

static octreel_status set_tick(octreel_recorder *recorder, const octree_body *bodies, size_t count)
{
    octree_bodies *set = make_body_set(cube(-8, 8), 4);
    assert_int_equal(octree_bodies_insert_many(set, bodies, count, NULL, NULL), OCTREE_OK);
    const octreel_status status = octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.body_set = set});
    octree_bodies_destroy(set);
    return status;
}

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

enum { CHANGES, LIST, SET, SOURCES };

/* Tick 1 moves a box, tick 2 resizes a box, a point and a moving box, tick 3 makes a box a point, and removes one. */
static void record_boxes(octreel_recorder *recorder, int source)
{
    octree_body now[3];
    memcpy(now, boxes, sizeof now);
    octreel_status (*const record)(octreel_recorder *, const octree_body *, size_t) = source == LIST  ? list_tick
                                                                                      : source == SET ? set_tick
                                                                                                      : NULL;
    assert_int_equal(record ? record(recorder, now, 3) : insert_tick(recorder, now, 3, false), OCTREEL_OK);
    now[0].position[1] = 5;
    assert_int_equal(record ? record(recorder, now, 3) : change_tick(recorder, OCTREE_EDIT_MOVE, &now[0]), OCTREEL_OK);
    now[0].half[2] = 0.25;
    now[1].half[1] = 1.5;
    now[2].half[0] = 3;
    now[2].position[2] = -3;
    assert_int_equal(record ? record(recorder, now, 3) : insert_tick(recorder, now, 3, true), OCTREEL_OK);
    now[1].half[1] = 0;
    const octree_edit last[] = {make_edit(OCTREE_EDIT_REMOVE, &now[1]), make_edit(OCTREE_EDIT_INSERT, &now[1]),
                                make_edit(OCTREE_EDIT_REMOVE, &now[2])};
    const octreel_tick_info edited = {.changes = last, .change_count = 3};
    assert_int_equal(record ? record(recorder, now, 2) : octreel_recorder_tick(recorder, NULL, &edited), OCTREEL_OK);
}

static void every_source_records_boxes_that_move_and_change(void **state)
{
    place folders[SOURCES];
    const place again = place_in(*state, "again");
    for (int source = 0; source < SOURCES; source++) {
        char name[16];
        snprintf(name, sizeof name, "film%d", source);
        folders[source] = place_in(*state, name);
        octreel_recorder_def def = octreel_recorder_def_default();
        def.folder = folders[source].path;
        def.tree = define(cube(-8, 8), 1, 4, OCTREE_REFUSE); /* leaves of lists, sets and changes grow */
        def.width = SMALL_WIDTH;
        def.height = SMALL_HEIGHT;
        octreel_recorder *recorder = open_recorder(&def);
        record_boxes(recorder, source);
        close_recorder(recorder);
        assert_same_folders(folders[0].path, folders[source].path, NULL);
    }
    assert_session_contains(&folders[0], "{\"id\": 5, \"position\": [0, 0, 3], \"half\": [2, 0, 0]},\n"
                                         "{\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]},\n"
                                         "[-4, 1, 0, 9]\n");
    assert_session_contains(&folders[0],
                            "{\"tick\": 1, \"edits\": [{\"move\": {\"id\": 7, \"position\": [4, 5, 0]}}]}");
    assert_session_contains(
        &folders[0], "{\"tick\": 2, \"edits\": ["
                     "{\"remove\": 5}, {\"insert\": {\"id\": 5, \"position\": [0, 0, 3], \"half\": [3, 0, 0]}}, "
                     "{\"remove\": 7}, {\"insert\": {\"id\": 7, \"position\": [4, 5, 0], \"half\": [1, 2, 0.25]}}, "
                     "{\"remove\": 9}, {\"insert\": {\"id\": 9, \"position\": [-4, 1, 0], \"half\": [0, 1.5, 0]}}, "
                     "{\"move\": {\"id\": 5, \"position\": [0, 0, -3]}}]}");
    assert_session_contains(&folders[0], "{\"tick\": 3, \"edits\": [{\"remove\": 9}, "
                                         "{\"insert\": {\"id\": 9, \"position\": [-4, 1, 0]}}, {\"remove\": 5}]}");
    assert_films_again(&folders[0], &again, 4);
}

/* The set shows the points of a tree as boxes. */
static void set_of_points_is_recorded_with_its_extents(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree *tree = make_tree(cube(-8, 8), 1, 4, OCTREE_GROW);
    octree_bodies *set;
    assert_int_equal(octree_insert(tree, boxes[0].position, 3), OCTREE_OK);
    assert_int_equal(octree_bodies_of_points(tree, boxes[0].half, &set), OCTREE_OK);
    const octreel_tick_info about = {.body_set = set};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_OK);
    close_recorder(recorder);
    octree_bodies_destroy(set);
    octree_destroy(tree);
    assert_session_contains(&folder, "{\"id\": 3, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]}");
}

/* The corners of the box are beyond DBL_MAX. */
static void largest_and_smallest_extents_are_recorded(void **state)
{
    for (int source = 0; source < SOURCES; source++) {
        const octree_body extremes[] = {{{-8, 8, 8}, {DBL_MAX, 1e-300, 0}, 1}, {{8, 8, 8}, {-0.0, -0.0, -0.0}, 2}};
        char name[16];
        snprintf(name, sizeof name, "film%d", source);
        const place folder = place_in(*state, name);
        octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
        if (source == CHANGES)
            assert_int_equal(insert_tick(recorder, extremes, 2, false), OCTREEL_OK);
        else
            assert_int_equal((source == LIST ? list_tick : set_tick)(recorder, extremes, 2), OCTREEL_OK);
        close_recorder(recorder);
        assert_session_contains(&folder, "{\"id\": 1, \"position\": [-8, 8, 8], "
                                         "\"half\": [1.7976931348623157e+308, 1e-300, 0]},\n[8, 8, 8, 2]\n");
    }
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

/* A body keeps its extents while it is outside the world, and may change them there. */
static void body_returns_into_the_world_with_its_extents(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_body outside = boxes[0], inside = boxes[0];
    outside.position[0] = 9;
    assert_int_equal(list_tick(recorder, boxes, 1), OCTREEL_OK);
    assert_int_equal(list_tick(recorder, &outside, 1), OCTREEL_OK);
    assert_int_equal(list_tick(recorder, &inside, 1), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &outside), OCTREEL_OK);
    outside.half[0] = inside.half[0] = 3;
    assert_int_equal(insert_tick(recorder, &outside, 1, true), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &inside), OCTREEL_OK);
    close_recorder(recorder);
    assert_session_contains(
        &folder,
        "{\"tick\": 1, \"edits\": [{\"remove\": 7}, "
        "{\"insert\": {\"id\": 7, \"position\": [9, 0, 0], \"half\": [1, 2, 0.5]}}]}\n"
        "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]}}]}\n"
        "{\"tick\": 3, \"edits\": [{\"remove\": 7}, "
        "{\"insert\": {\"id\": 7, \"position\": [9, 0, 0], \"half\": [1, 2, 0.5]}}]}\n"
        "{\"tick\": 5, \"edits\": [{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], \"half\": [3, 2, 0.5]}}]}\n");
    assert_films_again(&folder, &again, 6);
}

/* Extents of a list of bodies disappear with a list of points, and changes continue from either. */
static void program_switches_between_points_and_bodies(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    const octree_point point = {{4, 0, 0}, 7};
    const octreel_tick_info points = {.points = &point, .point_count = 1};
    octree_body moved = boxes[0];
    moved.position[0] = 1;
    assert_int_equal(list_tick(recorder, boxes, 1), OCTREEL_OK);
    assert_int_equal(list_tick(recorder, boxes, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &points), OCTREEL_OK);
    assert_int_equal(set_tick(recorder, boxes, 1), OCTREEL_OK);
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &moved), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, NULL), OCTREEL_OK); /* nothing changes */
    assert_int_equal(list_tick(recorder, &moved, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, NULL), OCTREEL_OK); /* the list is empty */
    close_recorder(recorder);
    assert_session_contains(
        &folder, "{\"tick\": 2, \"edits\": [{\"remove\": 7}, {\"insert\": {\"id\": 7, \"position\": [4, 0, 0]}}]}\n"
                 "{\"tick\": 3, \"edits\": [{\"remove\": 7}, "
                 "{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]}}]}\n"
                 "{\"tick\": 4, \"edits\": [{\"move\": {\"id\": 7, \"position\": [1, 0, 0]}}]}\n"
                 "{\"tick\": 7, \"edits\": [{\"remove\": 7}]}\n");
    assert_films_again(&folder, &again, 8);
}

/* ---- Rings and refused ticks --------------------------------------------------------------------------------- */

static void ring_begins_with_the_extents_of_its_first_tick(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(NULL, 2);
    octree_body body = boxes[0];
    assert_int_equal(list_tick(recorder, boxes, 3), OCTREEL_OK);
    body.half[0] = 3;
    assert_int_equal(list_tick(recorder, &body, 1), OCTREEL_OK);
    body.half[0] = 4;
    assert_int_equal(list_tick(recorder, &body, 1), OCTREEL_OK);
    for (int i = 0; i < 2; i++) {
        const place *written = i ? &again : &folder;
        assert_int_equal(octreel_recorder_write(recorder, written->path, NULL), OCTREEL_OK);
    }
    close_recorder(recorder);
    assert_same_folders(folder.path, again.path, NULL);
    assert_session_contains(&folder, "\"points\": [\n{\"id\": 7, \"position\": [4, 0, 0], \"half\": [3, 2, 0.5]}\n]}\n"
                                     "{\"tick\": 1, \"edits\": [{\"remove\": 7}, "
                                     "{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], \"half\": [4, 2, 0.5]}}]}\n");
}

static void assert_refused(octreel_recorder *recorder, const octreel_tick_info *about, octreel_status why,
                           const char *sentence)
{
    assert_int_equal(octreel_recorder_tick(recorder, NULL, about), why);
    assert_string_equal(octreel_recorder_error(recorder), sentence);
}

static void invalid_extents_are_refused_and_change_nothing(void **state)
{
    static const double invalid[] = {NAN, INFINITY, -1, -INFINITY, -5e-324};
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(list_tick(recorder, boxes, 2), OCTREEL_OK);
    for (int i = 0; i < 15; i++) {
        octree_body bodies[] = {boxes[0], boxes[1]};
        bodies[0].half[0] = 4;
        bodies[1].half[i % 3] = invalid[i / 3];
        assert_refused(recorder, &(octreel_tick_info){.bodies = bodies, .body_count = 2}, OCTREEL_BAD_POINT,
                       "bodies[1]: a half extent is negative, NaN or infinite");
    }
    octree_body nowhere = boxes[0];
    nowhere.position[2] = NAN;
    assert_refused(recorder, &(octreel_tick_info){.bodies = &nowhere, .body_count = 1}, OCTREEL_BAD_POINT,
                   "bodies[0]: a coordinate is NaN or infinite");
    assert_int_equal(list_tick(recorder, boxes, 2), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_session_contains(&folder, "\"points\": [\n{\"id\": 7, \"position\": [4, 0, 0], \"half\": [1, 2, 0.5]},\n"
                                     "[-4, 1, 0, 9]\n]}\n{\"tick\": 1, \"gap\": ");
    size_t size;
    char *text = file_read(place_below(folder.path, "session.json").path, &size);
    assert_null(strstr(text, "edits"));
    free(text);
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

/* Extents change in a refused tick: those of changes stay, those of a list are forgotten. */
static void extents_of_a_refused_tick_are_kept_or_forgotten_with_it(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    octree_body body = boxes[0];
    body.half[0] = 3;
    const octree_edit edits[] = {make_edit(OCTREE_EDIT_REMOVE, &body), make_edit(OCTREE_EDIT_INSERT, &body)};
    octreel_tick_info about = {.changes = edits, .change_count = 2, .queries = &bad, .query_count = 1};
    assert_int_equal(list_tick(recorder, boxes, 1), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    body.half[0] = 5;
    about = (octreel_tick_info){.bodies = &body, .body_count = 1, .queries = &bad, .query_count = 1};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    body.position[0] = 1;
    assert_int_equal(change_tick(recorder, OCTREE_EDIT_MOVE, &body), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_session_contains(&folder, "{\"tick\": 3, \"edits\": [{\"remove\": 7}, "
                                     "{\"insert\": {\"id\": 7, \"position\": [4, 0, 0], \"half\": [3, 2, 0.5]}}, "
                                     "{\"move\": {\"id\": 7, \"position\": [1, 0, 0]}}]}\n");
    assert_films_again(&folder, &again, 4);
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

static void invalid_lists_and_sets_are_refused_with_the_reason(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    const octree_body twice[] = {boxes[0], boxes[1], {{1, 1, 1}, {1, 1, 1}, 7}},
                      large = {{0, 0, 0}, {1, 1, 1}, UINT64_C(1) << 53};
    octree_bodies *set = make_body_set(cube(-8, 8), 4);
    const octreel_tick_info of_set = {.body_set = set};
    assert_refused(recorder, &(octreel_tick_info){.bodies = twice, .body_count = 3}, OCTREEL_DUPLICATE_ID,
                   "bodies: two bodies have the id 7");
    assert_refused(recorder, &(octreel_tick_info){.bodies = &large, .body_count = 1}, OCTREEL_BAD_ID,
                   "bodies: an id is 2^53 or larger, which session files cannot store: 9007199254740992");
    assert_refused(recorder, &(octreel_tick_info){.body_count = 1}, OCTREEL_NULL_ARGUMENT,
                   octreel_status_text(OCTREEL_NULL_ARGUMENT));
    assert_int_equal(octree_bodies_insert_many(set, twice, 3, NULL, NULL), OCTREE_OK);
    assert_refused(recorder, &of_set, OCTREEL_DUPLICATE_ID, "two points have the same id: 7");
    assert_int_equal(octree_bodies_replace_all(set, &large, 1, NULL, NULL), OCTREE_OK);
    assert_refused(recorder, &of_set, OCTREEL_BAD_ID,
                   "an id is 2^53 or larger, which session files cannot store: 9007199254740992");
    assert_int_equal(octree_bodies_clear(set), OCTREE_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &of_set), OCTREEL_OK);
    assert_refused(recorder, NULL, OCTREEL_NULL_ARGUMENT, octreel_status_text(OCTREEL_NULL_ARGUMENT));
    assert_int_equal(list_tick(recorder, boxes, 2), OCTREEL_OK);
    octreel_recorder_destroy(recorder);
    octree_bodies_destroy(set);
}

static void bodies_from_two_sources_are_refused(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    octree_bodies *set = make_body_set(cube(-8, 8), 4);
    octree *tree = make_tree(cube(-8, 8), 64, 21, OCTREE_GROW);
    const octree_point point = {{1, 1, 1}, 7};
    const octree_edit edit = make_edit(OCTREE_EDIT_INSERT, &boxes[0]);
    const octreel_tick_info pairs[] = {{.bodies = boxes, .body_count = 1, .points = &point, .point_count = 1},
                                       {.bodies = boxes, .body_count = 1, .changes = &edit, .change_count = 1},
                                       {.bodies = boxes, .body_count = 1, .body_set = set},
                                       {.body_set = set, .points = &point, .point_count = 1},
                                       {.body_set = set, .changes = &edit, .change_count = 1}};
    const octreel_tick_info list = {.bodies = boxes, .body_count = 1}, of_set = {.body_set = set};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        assert_refused(recorder, &pairs[i], OCTREEL_TWO_SOURCES, octreel_status_text(OCTREEL_TWO_SOURCES));
    assert_int_equal(octreel_recorder_tick(recorder, tree, &list), OCTREEL_TWO_SOURCES);
    assert_int_equal(octreel_recorder_tick(recorder, tree, &of_set), OCTREEL_TWO_SOURCES);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &of_set), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, tree, NULL), OCTREEL_TWO_SOURCES);
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    octree_bodies_destroy(set);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(every_source_records_boxes_that_move_and_change),
        TEST(set_of_points_is_recorded_with_its_extents),
        TEST(largest_and_smallest_extents_are_recorded),
        TEST(moves_and_removals_do_not_read_extents),
        TEST(body_returns_into_the_world_with_its_extents),
        TEST(program_switches_between_points_and_bodies),
        TEST(ring_begins_with_the_extents_of_its_first_tick),
        TEST(invalid_extents_are_refused_and_change_nothing),
        TEST(invalid_extents_of_a_change_drop_only_this_change),
        TEST(extents_of_a_refused_tick_are_kept_or_forgotten_with_it),
        TEST(waiting_changes_of_extents_are_combined),
        TEST(invalid_lists_and_sets_are_refused_with_the_reason),
        TEST(bodies_from_two_sources_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
