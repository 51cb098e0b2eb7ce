/* SPDX-License-Identifier: MIT */
/* test_explain.c - why two recordings differ, frame by frame, and the files that do not agree with their session. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "edits.h"
#include "explained.h"
#include "fixture.h"
#include "layer.h"
#include "session_file.h"

#define KEYS "wdn."
#define TICKS 5

static size_t count_causes(const comparison_of *made)
{
    size_t count = 0;
    for (size_t i = 0; i < made->why.count; i++)
        count += made->why.pairs[i].text != NULL;
    return count;
}

/* ---- What differs in sessions and views ---------------------------------------------------------------------- */

static void equal_recordings_have_no_explanation(void **state)
{
    const octree_session session = short_session(KEYS);
    const place a = film_into(*state, "a", &session, NULL), b = film_into(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    assert_null(made.why.headline);
    assert_false(made.why.recordings);
    comparison_release(&made);
}

static void different_capacity_is_the_headline_and_its_nodes_are_the_causes(void **state)
{
    octree_session session = short_session(KEYS);
    const place a = film_into(*state, "a", &session, NULL);
    session.tree.leaf_capacity = 3;
    const place b = film_into(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline, "another leaf capacity (3, was 2): every tick from 0 on differs");
    assert_int_equal(count_causes(&made), TICKS);
    assert_contains(find_cause_text(&made, "frame_000002.png"), "tick 2: node");
    assert_contains(find_cause_text(&made, "frame_000002.png"), " divided only in the reference");
    assert_int_equal(made.why.cause.differing.count, TICKS);
    comparison_release(&made);
}

static void only_the_requested_number_of_frames_is_explained(void **state)
{
    octree_session session = short_session(KEYS);
    const place a = film_into(*state, "a", &session, NULL);
    session.tree.leaf_capacity = 3;
    const place b = film_into(*state, "b", &session, NULL);
    for (uint64_t most = 0; most <= TICKS; most++) {
        comparison_of made = assert_explained(&a, &b, most);
        assert_int_equal(count_causes(&made), most);
        assert_true((made.why.headline != NULL) == (most > 0));
        comparison_release(&made);
    }
}

static void edit_is_the_headline_and_its_point_is_the_cause(void **state)
{
    octree_session session = short_session(KEYS);
    const octree_edit edit = {2, OCTREE_EDIT_MOVE, {.id = 3, .position = {300, 300, 300}}};
    const place a = film_into(*state, "a", &session, NULL);
    session.edits = &edit;
    session.edit_count = 1;
    const place b = film_into(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "one more edit at tick 2 (move id 3, position (300, 300, 300)); tick 2: node");
    assert_null(find_cause_text(&made, "frame_000001.png"));
    assert_contains(find_cause_text(&made, "frame_000002.png"),
                    "point 3 moved from (900, 900, 900) to (300, 300, 300)");
    comparison_release(&made);
}

static void different_view_is_no_difference_of_ticks(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_into(*state, "a", &session, &options);
    options.view.camera = CAMERA_ORBIT;
    options.view.layers &= ~(1u << LAYER_TEXT);
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(
        made.why.headline,
        "another camera (orbit, was iso), one layer fewer (text): the ticks are the same, only the view differs");
    assert_contains(find_cause_text(&made, "frame_000001.png"),
                    "tick 1: another camera (orbit, was iso), one layer fewer (text); ");
    assert_int_equal(made.why.cause.differing.count, 0);
    comparison_release(&made);
}

/* Its eleven numbers are in JSON alone. */
static void different_point_scale_is_named_without_numbers(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    options.view.point_color = POINTS_BY_Z;
    const place a = film_into(*state, "a", &session, &options);
    options.view.point_scale.given = true;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline, "another scale of points: the ticks are the same, only the view differs");
    comparison_release(&made);
}

static void disabled_option_is_reported_as_off(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_into(*state, "a", &session, &options);
    options.view.labels = true;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline,
                        "another rule for labels (on, was off): the ticks are the same, only the view differs");
    comparison_release(&made);
}

/* A larger collision box is drawn in every frame. */
static void frames_that_differ_before_the_ticks_are_reported(void **state)
{
    octree_session session = short_session(KEYS);
    const place a = film_into(*state, "a", &session, NULL);
    session.player.box_size += 15;
    const place b = film_into(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(
        made.why.headline,
        "another collision box (45, was 30): the ticks that both sides have are equal; frames differ from tick 0 on");
    comparison_release(&made);
}

static place film_sample(const temp_folder *own, const char *name, int seed, int speed_seed)
{
    const place folder = place_in(own, name);
    const film_options options = small_film(folder.path);
    char text[512];
    session_file made;
    octreel_error error;
    sprintf(
        text,
        "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 2, \"points\": {\"sample\": \"uniform\", \"count\": 40, "
        "\"seed\": %d}, \"velocities\": {\"speed\": 5, \"seed\": %d}}",
        seed, speed_seed);
    assert_true(session_parse(name, "", text, strlen(text), &made, &error));
    assert_filmed(&made.session, &options);
    session_release(&made);
    return folder;
}

static void assert_headline(const place *a, const place *b, const char *expected)
{
    comparison_of made = assert_explained(a, b, 10);
    assert_string_equal(made.why.headline, expected);
    comparison_release(&made);
}

/* A long list is counted, with one of its ids to look for. */
static void long_lists_are_counted_and_short_lists_are_named(void **state)
{
    const place a = film_sample(*state, "a", 1, 1), b = film_sample(*state, "b", 2, 1);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000000.png"), "40 points moved (such as 1)");
    comparison_release(&made);
}

static void different_seed_is_the_cause_instead_of_its_points(void **state)
{
    const place a = film_sample(*state, "a", 1, 1), b = film_sample(*state, "b", 2, 1);
    const place c = film_sample(*state, "c", 1, 7), d = place_in(*state, "d");
    assert_headline(&a, &b, "another seed of the points (2, was 1): every tick from 0 on differs");
    assert_headline(&a, &c,
                    "another seed of the velocities (7, was 1): every tick from 1 on differs; frames differ from "
                    "tick 0 on");
    octreel_error error;
    session_file again;
    film_options options = small_film(d.path);
    assert_true(session_read(place_below(a.path, "session.json").path, &again, &error));
    ((octree_game_body *)again.session.bodies)[7].position[0] = 500;
    assert_filmed(&again.session, &options);
    session_release(&again);
    comparison_of made = assert_explained(&a, &d, 10);
    assert_contains(made.why.headline, "another initial point (point 8: (500, ");
    comparison_release(&made);
}

static void heat_of_earlier_ticks_is_a_cause(void **state)
{
    octree_session session = short_session("wwww");
    film_options options = small_film("");
    options.view.layers = 1u << LAYER_VISIT_HEAT;
    const octree_query query = {.tick = 2, .kind = OCTREE_QUERY_RANGE, .box = {{-900, -900, -900}, {900, 900, 900}}};
    const place a = film_into(*state, "a", &session, &options);
    session.queries = &query;
    session.query_count = 1;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "one more query at tick 2 (range (-900, -900, -900) to (900, 900, 900))");
    assert_contains(find_cause_text(&made, "frame_000004.png"), "tick 4: another visit counts of earlier ticks; ");
    assert_contains(find_cause_text(&made, "frame_000004.png"), " of heat");
    comparison_release(&made);
}

static void lengths_of_recordings_are_reported(void **state)
{
    octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_into(*state, "a", &session, &options);
    session = short_session("wd");
    options.every = 2;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline,
                    "another last tick (2, was 4); the ticks that both sides have are equal; another "
                    "interval of frames (2, was 1)");
    assert_contains(find_cause_text(&made, "frame_000001.png"), "b has a frame only every 2 ticks");
    assert_contains(find_cause_text(&made, "frame_000004.png"), "b ends at tick 2");
    assert_int_equal(unlink(frame_place(b.path, 2).path), 0);
    comparison_release(&made);
    made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000002.png"),
                    "b has no such frame: the recording is damaged or incomplete");
    comparison_release(&made);
}

/* ---- What files do not agree on ------------------------------------------------------------------------------- */

static void edited_line_is_detected(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    edit_line(b.path, 2, "\"hits\": []", "\"hits\": [7]");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "b/ticks.jsonl at tick 2 differs from what its session gives: hits[0] is 7 in "
                                       "ticks.jsonl, but missing when the tick is played again");
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
    made = assert_explained(&b, &a, 10); /* whichever side it is on */
    assert_contains(made.why.headline, "b/ticks.jsonl at tick 2");
    comparison_release(&made);
}

static void edited_scene_digest_is_detected(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    edit_line(b.path, 3, "\"scene\": \"", "\"scene\": \"0");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "b/ticks.jsonl at tick 3 differs from what its session gives");
    comparison_release(&made);
}

static void edited_session_is_detected(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    edit_file(b.path, "session.json", "\"capacity\": 2", "\"capacity\": 4");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "b/session.json is not the session that was recorded; ");
    comparison_release(&made);
}

static void missing_and_torn_lines_are_reported(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    replace_line(b.path, TICKS - 1, "");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "b/ticks.jsonl ends before tick 4");
    comparison_release(&made);
    replace_line(b.path, TICKS - 2, "{\"tick\": 3");
    made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "b/ticks.jsonl is incomplete: the file ends in the middle of tick 3");
    comparison_release(&made);
}

static void assert_trouble_of(const place *a, const place *b, const char *part)
{
    comparison_of made = assert_explained(a, b, 10);
    assert_int_equal(explanation_verdict(&made.why, &made.result), DIFF_TROUBLE);
    assert_contains(made.why.trouble, part);
    assert_false(made.why.recordings);
    comparison_release(&made);
    made = assert_explained(a, b, 0); /* nobody asks */
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void damaged_recording_is_an_error(void **state)
{
    static const char *const names[] = {"session.json", "recording.json", "ticks.jsonl"};
    place b;
    const place a = film_twice(*state, KEYS, &b);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const place file = place_below(b.path, names[i]);
        size_t size;
        char *whole = file_read(file.path, &size);
        if (i < 2) {
            set_file_size(b.path, names[i], size / 2);
            assert_trouble_of(&a, &b, file.path);
        }
        assert_int_equal(unlink(file.path), 0);
        if (i != 1) /* a folder without its recording.json is a folder of pictures */
            assert_trouble_of(&b, &a, file.path);
        file_write(file.path, whole, size);
        free(whole);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(equal_recordings_have_no_explanation),
        TEST(different_capacity_is_the_headline_and_its_nodes_are_the_causes),
        TEST(only_the_requested_number_of_frames_is_explained),
        TEST(edit_is_the_headline_and_its_point_is_the_cause),
        TEST(different_view_is_no_difference_of_ticks),
        TEST(different_point_scale_is_named_without_numbers),
        TEST(disabled_option_is_reported_as_off),
        TEST(frames_that_differ_before_the_ticks_are_reported),
        TEST(long_lists_are_counted_and_short_lists_are_named),
        TEST(different_seed_is_the_cause_instead_of_its_points),
        TEST(heat_of_earlier_ticks_is_a_cause),
        TEST(lengths_of_recordings_are_reported),
        TEST(edited_line_is_detected),
        TEST(edited_scene_digest_is_detected),
        TEST(edited_session_is_detected),
        TEST(missing_and_torn_lines_are_reported),
        TEST(damaged_recording_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
