/* SPDX-License-Identifier: MIT */
/* test_group_causes.c - frames of two recordings are in one group if they differ for the same cause. */
#include "edits.h"
#include "explained.h"
#include "fixture.h"
#include "session_texts.h"

#include <stdlib.h>
#include <string.h>

static const char played[] =
    "{\"octreel\": \"session\", \"version\": 2, \"world\": {\"min\": [-100, -100, -100], \"max\": [100, 100, 100]}, "
    "\"tree\": {\"capacity\": 4, \"depth\": 6}, \"points\": {\"sample\": \"uniform\", \"count\": 60, \"seed\": 5}, "
    "\"keys\": \"wwddeenaasf.wd\", \"ticks\": 20, \"queries\": [{\"knearest\": 3, \"at\": [0, 0, 0]}], "
    "\"shapes\": [{\"box\": {\"min\": [-40, -40, -40], \"max\": [40, 40, 40]}}]}\n"
    "{\"tick\": 3, \"queries\": [{\"radius\": 25, \"at\": [10, 10, 10]}]}\n"
    "{\"tick\": 6, \"queries\": [{\"nearest\": [20, 20, 20]}]}\n"
    "{\"tick\": 8, \"edits\": [{\"remove\": 5}]}\n";

/* What is changed in it, one after the other, up to a null. */
typedef struct change {
    const char *from, *to;
} change;

static const change other_radius = {"\"radius\": 25", "\"radius\": 60"};
static const change other_nearest = {"[20, 20, 20]", "[-70, -20, 20]"};
static const change other_key = {".wd\"", ".ww\""};
static const change other_edit = {"\"remove\": 5", "\"remove\": 7"};
static const change other_shape = {"40, 40]}}]", "50, 50]}}]"};
static const change other_capacity = {"\"capacity\": 4", "\"capacity\": 2"};

static place film_changed(void **state, const char *name, const film_options *how, const change *changes)
{
    char text[2048];
    snprintf(text, sizeof text, "%s", played);
    for (; changes && changes->from; changes++) {
        char *at = strstr(text, changes->from);
        assert_non_null(at);
        const size_t tail = strlen(at + strlen(changes->from)) + 1;
        memmove(at + strlen(changes->to), at + strlen(changes->from), tail);
        memcpy(at, changes->to, strlen(changes->to));
    }
    session_file file = session_of_text(text);
    const place folder = film_into(*state, name, &file.session, how);
    session_release(&file);
    return folder;
}

/* Compare the session with a changed one. */
static void assert_grouped(void **state, const film_options *how, const change *changes, const char *expected)
{
    const place a = film_changed(state, "a", how, NULL), b = film_changed(state, "b", how, changes);
    comparison_of made = assert_explained(&a, &b, 1);
    assert_groups(&made, false, expected);
    comparison_release(&made);
}

/* ---- Causes in the sessions ---------------------------------------------------------------------------------- */

static void queries_of_different_ticks_are_separate_causes(void **state)
{
    assert_grouped(state, NULL, (const change[]){other_radius, other_nearest, {0}}, "tick 3\ntick 6\n");
}

/* The panel, where there is room for it, shows keys six ticks ahead. */
static film_options wide_film(void)
{
    film_options options = small_film("");
    options.view.width = 480;
    options.view.height = 270;
    return options;
}

static void key_is_the_cause_of_all_ticks_that_show_its_effect(void **state)
{
    const film_options options = wide_film();
    assert_grouped(state, &options, (const change[]){other_key, {0}}, "ticks 8 to 20\n");
}

static void query_before_a_key_is_a_separate_cause(void **state)
{
    const film_options options = wide_film();
    assert_grouped(state, &options, (const change[]){other_radius, other_key, {0}}, "tick 3\nticks 8 to 20\n");
}

static void second_lasting_cause_begins_another_group(void **state)
{
    assert_grouped(state, NULL, (const change[]){other_edit, other_key, {0}}, "ticks 8 to 13\nticks 14 to 20\n");
}

static void difference_in_all_ticks_is_one_cause(void **state)
{
    film_options options = small_film("");
    assert_grouped(state, NULL, (const change[]){other_capacity, {0}}, "ticks 0 to 20\n");
    options.view.camera = CAMERA_TOP;
    const place c = film_changed(state, "c", NULL, NULL), d = film_changed(state, "d", &options, NULL);
    comparison_of made = assert_explained(&c, &d, 1);
    assert_groups(&made, false, "ticks 0 to 20\n");
    comparison_release(&made);
}

/* A tick that has a cause more than the others is told apart. */
static void one_tick_may_have_an_additional_cause(void **state)
{
    assert_grouped(state, NULL, (const change[]){other_radius, other_capacity, {0}}, "ticks 0 to 2, 4 to 20\ntick 3\n");
}

/* Where heat is shown, a query changes all later frames. */
static void heat_makes_a_query_the_cause_of_later_ticks(void **state)
{
    film_options options = small_film("");
    options.view.layers = 1u << LAYER_VISIT_HEAT;
    assert_grouped(state, &options, (const change[]){other_radius, {0}}, "ticks 3 to 20\n");
}

/* ---- Causes in the frames ------------------------------------------------------------------------------------ */

static void frames_edited_in_different_ways_are_in_different_groups(void **state)
{
    place b;
    const place a = film_twice(*state, "wdn.", &b);
    change_pixel_of_frame(b.path, 1, 77, false);
    change_pixel_of_frame(b.path, 2, 78, false);
    change_pixel_of_frame(b.path, 3, 77, false);
    comparison_of made = assert_explained(&a, &b, 1);
    assert_groups(&made, false, "ticks 1, 3\ntick 2\n");
    comparison_release(&made);
}

static void assert_cause(const comparison_of *made, const char *name, const char *part, const char *missing)
{
    const char *cause = find_cause_text(made, name);
    assert_contains(cause, part);
    if (strstr(cause, missing))
        fail_msg("\"%s\" holds \"%s\"", cause, missing);
}

/* What its own recording did not make is no effect of the other session. */
static void edited_frame_is_in_no_group_of_the_sessions(void **state)
{
    const place a = film_changed(state, "a", NULL, NULL),
                b = film_changed(state, "b", NULL, (const change[]){other_radius, {0}});
    remove_texts_of_frame(b.path, 16, true);
    change_pixel_of_frame(b.path, 17, 78, false);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_groups(&made, false, "tick 3\ntick 16\ntick 17\n");
    assert_cause(&made, "frame_000016.png", "b/frame_000016.png has no text chunks of octreel", "query");
    assert_cause(&made, "frame_000017.png", "b/frame_000017.png was changed after it was drawn", "query");
    comparison_release(&made);
}

static void frame_of_another_view_is_in_no_group_of_the_sessions(void **state)
{
    film_options options = small_film("");
    options.view.camera = CAMERA_TOP;
    const change changes[] = {other_capacity, {0}};
    const place a = film_changed(state, "a", NULL, NULL), b = film_changed(state, "b", NULL, changes),
                c = film_changed(state, "c", &options, changes);
    assert_int_equal(rename(frame_place(c.path, 16).path, frame_place(b.path, 16).path), 0);
    comparison_of made = assert_explained(&a, &b, 20);
    assert_groups(&made, false, "ticks 0 to 15, 17 to 20\ntick 16\n");
    assert_cause(&made, "frame_000016.png", "b/frame_000016.png shows a scene that differs from the one in ticks.jsonl",
                 "tick 16: ");
    comparison_release(&made);
}

/* ---- Sentences ----------------------------------------------------------------------------------------------- */

static void frame_after_the_last_tick_is_reported_with_both_causes(void **state)
{
    place b;
    const place a = film_twice(*state, "wdn.", &b);
    file_copy(b.path, "frame_000003.png", "frame_000005.png");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_cause(&made, "frame_000005.png", "b/frame_000005.png is the frame of tick 3; the session of ", "3the");
    comparison_release(&made);
}

/* The interval of frames changes none of them. */
static void session_and_view_are_both_reported_if_both_matter(void **state)
{
    static const char shape[] = "another shape shown at every tick (box (-40, -40, -40) to (40, 50, 50), was ";
    film_options options = small_film("");
    options.every = 5;
    const change changes[] = {other_shape, other_nearest, {0}};
    const place a = film_changed(state, "a", NULL, NULL), b = film_changed(state, "b", &options, changes);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_cause(&made, "frame_000005.png", "tick 5: nothing differs in the tick itself; ", "interval");
    assert_cause(&made, "frame_000005.png", shape, "nearest");
    comparison_release(&made);
    options.every = 1;
    options.view.camera = CAMERA_TOP;
    const place c = film_changed(state, "c", &options, changes);
    made = assert_explained(&a, &c, 10);
    assert_cause(&made, "frame_000005.png", "tick 5: another camera (top, was iso); another shape shown ", "nearest");
    assert_cause(&made, "frame_000006.png", "tick 6: another nearest point in the nearest query", "the same happened");
    assert_cause(&made, "frame_000006.png", "; another camera (top, was iso)", "the same happened");
    comparison_release(&made);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(queries_of_different_ticks_are_separate_causes),
        TEST(key_is_the_cause_of_all_ticks_that_show_its_effect),
        TEST(query_before_a_key_is_a_separate_cause),
        TEST(second_lasting_cause_begins_another_group),
        TEST(difference_in_all_ticks_is_one_cause),
        TEST(one_tick_may_have_an_additional_cause),
        TEST(heat_makes_a_query_the_cause_of_later_ticks),
        TEST(frames_edited_in_different_ways_are_in_different_groups),
        TEST(edited_frame_is_in_no_group_of_the_sessions),
        TEST(frame_of_another_view_is_in_no_group_of_the_sessions),
        TEST(frame_after_the_last_tick_is_reported_with_both_causes),
        TEST(session_and_view_are_both_reported_if_both_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
