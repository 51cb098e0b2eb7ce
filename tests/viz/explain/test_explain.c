/* SPDX-License-Identifier: MIT */
/* test_explain.c - why two recordings differ, frame by frame: what their files say, and where they are not believed. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "edits.h"
#include "explain.h"
#include "fixture.h"
#include "galleries.h"
#include "layer.h"
#include "recordings.h"
#include "theme.h"
#include "png_chunks.h"
#include "image_digest.h"
#include "png_read.h"
#include "png_write.h"

#define KEYS "wdn."
#define TICKS 5

static place film_in(const temp_folder *own, const char *name, const octree_session *session, const film_options *how)
{
    const place folder = place_in(own, name);
    film_options options = how ? *how : small_film("");
    options.folder = folder.path;
    assert_filmed(session, &options);
    return folder;
}

static comparison_of assert_explained(const place *a, const place *b, uint64_t most)
{
    comparison_of made = assert_compared(a->path, b->path, NULL);
    octreel_error error = {""};
    if (!explain(&made.a, &made.b, &made.result, most, &made.why, &error))
        fail_msg("%s", error.text);
    return made;
}

static void assert_holds(const char *text, const char *part)
{
    if (!text || !strstr(text, part))
        fail_msg("\"%s\" does not hold \"%s\"", text ? text : "nothing", part);
}

static size_t count_causes(const comparison_of *made)
{
    size_t count = 0;
    for (size_t i = 0; i < made->why.count; i++)
        count += made->why.pairs[i].text != NULL;
    return count;
}

/* ---- What differs in sessions and views ---------------------------------------------------------------------- */

static void the_same_recording_has_nothing_to_explain(void **state)
{
    const octree_session session = short_session(KEYS);
    const place a = film_in(*state, "a", &session, NULL), b = film_in(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    assert_null(made.why.headline);
    assert_false(made.why.recordings);
    comparison_release(&made);
}

static void another_capacity_is_the_headline_and_its_nodes_the_causes(void **state)
{
    octree_session session = short_session(KEYS);
    const place a = film_in(*state, "a", &session, NULL);
    session.tree.leaf_capacity = 3;
    const place b = film_in(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline, "another leaf capacity (3, was 2): every tick from 0 differs");
    assert_int_equal(count_causes(&made), TICKS);
    assert_holds(cause_of(&made, "frame_000002.png"), "tick 2: node");
    assert_holds(cause_of(&made, "frame_000002.png"), " merged");
    assert_int_equal(made.why.cause.differing, TICKS);
    comparison_release(&made);
}

static void no_more_frames_are_explained_than_are_asked_for(void **state)
{
    octree_session session = short_session(KEYS);
    const place a = film_in(*state, "a", &session, NULL);
    session.tree.leaf_capacity = 3;
    const place b = film_in(*state, "b", &session, NULL);
    for (uint64_t most = 0; most <= TICKS; most++) {
        comparison_of made = assert_explained(&a, &b, most);
        assert_int_equal(count_causes(&made), most);
        assert_true((made.why.headline != NULL) == (most > 0));
        comparison_release(&made);
    }
}

static void an_edit_is_the_headline_and_its_point_the_cause(void **state)
{
    octree_session session = short_session(KEYS);
    const octree_edit edit = {2, OCTREE_EDIT_MOVE, {.id = 3, .position = {300, 300, 300}}};
    const place a = film_in(*state, "a", &session, NULL);
    session.edits = &edit;
    session.edit_count = 1;
    const place b = film_in(*state, "b", &session, NULL);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "one more edit at tick 2 (move id 3, position (300, 300, 300)); tick 2: node");
    assert_null(cause_of(&made, "frame_000001.png"));
    assert_holds(cause_of(&made, "frame_000002.png"), "point 3 moved from (900, 900, 900) to (300, 300, 300)");
    comparison_release(&made);
}

static void another_view_is_no_difference_of_ticks(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_in(*state, "a", &session, &options);
    options.view.camera = CAMERA_ORBIT;
    options.view.layers &= ~(1u << LAYER_TEXT);
    const place b = film_in(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline, "another camera (orbit, was iso), one layer fewer (text): the same ticks, "
                                           "looked at in another way");
    assert_holds(cause_of(&made, "frame_000001.png"),
                 "tick 1: another camera (orbit, was iso), one layer fewer (text); ");
    assert_int_equal(made.why.cause.differing, 0);
    comparison_release(&made);
}

static void heat_of_earlier_ticks_is_a_cause(void **state)
{
    octree_session session = short_session("wwww");
    film_options options = small_film("");
    options.view.layers = 1u << LAYER_VISIT_HEAT;
    const octree_query query = {.tick = 2, .kind = OCTREE_QUERY_RANGE, .box = {{-900, -900, -900}, {900, 900, 900}}};
    const place a = film_in(*state, "a", &session, &options);
    session.queries = &query;
    session.query_count = 1;
    const place b = film_in(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "one more query at tick 2 (range (-900, -900, -900) to (900, 900, 900))");
    assert_holds(cause_of(&made, "frame_000004.png"), "tick 4: another heat of the ticks before; ");
    assert_holds(cause_of(&made, "frame_000004.png"), " of heat");
    comparison_release(&made);
}

static void recordings_of_unlike_length_say_where_each_ends(void **state)
{
    octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_in(*state, "a", &session, &options);
    session = short_session("wd");
    options.every = 2;
    const place b = film_in(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline,
                 "another last tick (2, was 4); the same happens in all ticks that both have; another "
                 "interval of frames (2, was 1)");
    assert_holds(cause_of(&made, "frame_000001.png"), "b has a frame every 2 ticks");
    assert_holds(cause_of(&made, "frame_000004.png"), "b ends at tick 2");
    assert_int_equal(unlink(frame_place(b.path, 2).path), 0);
    comparison_release(&made);
    made = assert_explained(&a, &b, 10);
    assert_holds(cause_of(&made, "frame_000002.png"), "b lacks it: that recording is damaged, or not done");
    comparison_release(&made);
}

/* ---- What files do not agree on ------------------------------------------------------------------------------- */

static place film_twins(const temp_folder *own, place *b)
{
    const octree_session session = short_session(KEYS);
    *b = film_in(own, "b", &session, NULL);
    return film_in(own, "a", &session, NULL);
}

static void a_line_edited_by_hand_is_not_believed(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    edit_line(b.path, 2, "\"hits\": []", "\"hits\": [7]");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "b/ticks.jsonl at tick 2 is not what its session gives: hits[0] is 7 in "
                                    "ticks.jsonl, and missing when it is played again");
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
    made = assert_explained(&b, &a, 10); /* whichever side it is on */
    assert_holds(made.why.headline, "b/ticks.jsonl at tick 2");
    comparison_release(&made);
}

static void a_scene_digest_edited_by_hand_is_not_believed(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    edit_line(b.path, 3, "\"scene\": \"", "\"scene\": \"0");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "b/ticks.jsonl at tick 3 is not what its session gives");
    comparison_release(&made);
}

static void a_session_edited_after_filming_is_not_believed(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    edit_file(b.path, "session.json", "\"capacity\": 2", "\"capacity\": 4");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "b/session.json is not the session that was filmed; ");
    comparison_release(&made);
}

static void lines_that_are_missing_or_torn_are_told(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    replace_line(b.path, TICKS - 1, "");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "b/ticks.jsonl ends before tick 4");
    comparison_release(&made);
    replace_line(b.path, TICKS - 2, "{\"tick\": 3");
    made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "b/ticks.jsonl is torn within tick 3");
    comparison_release(&made);
}

static void assert_trouble_of(const place *a, const place *b, const char *part)
{
    comparison_of made = assert_explained(a, b, 10);
    assert_int_equal(explanation_verdict(&made.why, &made.result), DIFF_TROUBLE);
    assert_holds(made.why.trouble, part);
    assert_false(made.why.recordings);
    comparison_release(&made);
    made = assert_explained(a, b, 0); /* nobody asks */
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void a_damaged_recording_is_trouble(void **state)
{
    static const char *const names[] = {"session.json", "recording.json", "ticks.jsonl"};
    place b;
    const place a = film_twins(*state, &b);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const place file = place_below(b.path, names[i]);
        size_t size;
        char *whole = file_read(file.path, &size);
        if (i < 2) {
            cut_file(b.path, names[i], size / 2);
            assert_trouble_of(&a, &b, file.path);
        }
        assert_int_equal(unlink(file.path), 0);
        if (i != 1) /* a folder without its recording.json is a folder of pictures */
            assert_trouble_of(&b, &a, file.path);
        file_write(file.path, whole, size);
        free(whole);
    }
}

/* ---- What only the drawing makes ------------------------------------------------------------------------------ */

/* Write the frame of a tick anew with a pixel changed. With `as_drawn` its texts say that it was drawn so. */
static void spoil_frame(const place *folder, uint64_t tick, bool as_drawn)
{
    static const char *const keywords[] = {"octreel-tick", "octreel-session", "octreel-scene", "octreel-pixels"};
    char values[4][32];
    image_text texts[4];
    octreel_error error;
    image frame;
    const place file = frame_place(folder->path, tick);
    assert_true(image_read_png(file.path, &frame, &error));
    for (int i = 0; i < 4; i++) {
        assert_true(image_read_text(file.path, keywords[i], values[i], sizeof values[i]));
        texts[i] = (image_text){keywords[i], values[i]};
    }
    frame.pixels[77] = theme_index(ROLE_TEXT, 0);
    if (as_drawn)
        snprintf(values[3], sizeof values[3], "%016llx", (unsigned long long)image_digest(&frame));
    assert_true(image_write_png(&frame, file.path, texts, 4, &error));
    image_release(&frame);
}

static void the_same_scene_drawn_otherwise_is_a_difference_of_rendering(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    spoil_frame(&b, 1, true);
    spoil_frame(&b, 3, true);
    edit_file(b.path, "renderer.json", "\"renderer\": \"", "\"renderer\": \"other ");
    comparison_of made = assert_explained(&a, &b, 10);
    const char *cause = cause_of(&made, "frame_000003.png");
    assert_holds(made.why.headline, "rendering differs: the scene digests are equal; reference drawn by ");
    assert_memory_equal(made.why.headline, cause, strlen(made.why.headline));
    assert_holds(cause, ", frame by ");
    assert_holds(cause, "other ");
    assert_true(made.why.pairs[3].only_drawn);
    comparison_release(&made);
    assert_int_equal(unlink(place_below(b.path, "renderer.json").path), 0);
    made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "frame by an unknown renderer");
    comparison_release(&made);
}

static void another_renderer_alone_is_no_difference(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    edit_file(b.path, "renderer.json", "\"renderer\": \"", "\"renderer\": \"other ");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    assert_null(made.why.headline);
    comparison_release(&made);
}

static void a_frame_changed_after_it_was_drawn_is_told(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    spoil_frame(&b, 1, false);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(cause_of(&made, "frame_000001.png"), "b/frame_000001.png was changed after it was drawn");
    comparison_release(&made);
}

static void a_frame_in_the_place_of_another_is_told_by_its_own_tick(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    const place second = frame_place(b.path, 2), third = frame_place(b.path, 3), aside = place_below(b.path, "aside");
    assert_int_equal(rename(second.path, aside.path), 0);
    assert_int_equal(rename(third.path, second.path), 0);
    assert_int_equal(rename(aside.path, third.path), 0);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(made.why.headline, "frame_000002.png: ");
    assert_holds(made.why.headline, "b/frame_000002.png is the frame of tick 3");
    assert_holds(cause_of(&made, "frame_000003.png"), "b/frame_000003.png is the frame of tick 2");
    comparison_release(&made);
}

static void a_frame_of_another_session_is_told(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    const octree_session session = short_session("aaaa");
    const place c = film_in(*state, "c", &session, NULL);
    assert_int_equal(rename(frame_place(c.path, 2).path, frame_place(b.path, 2).path), 0);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(cause_of(&made, "frame_000002.png"), "b/frame_000002.png is a frame of another session");
    comparison_release(&made);
}

/* As other programs save it: the picture alone. */
static void lose_texts(const place *folder, uint64_t tick, bool spoilt)
{
    octreel_error error;
    image frame;
    const place file = frame_place(folder->path, tick);
    assert_true(image_read_png(file.path, &frame, &error));
    if (spoilt)
        frame.pixels[77] = theme_index(ROLE_TEXT, 0);
    assert_true(image_write_png(&frame, file.path, NULL, 0, &error));
    image_release(&frame);
}

static void a_frame_without_its_texts_is_told(void **state)
{
    octree_session session = short_session(KEYS);
    place b;
    const place a = film_twins(*state, &b);
    lose_texts(&b, 1, false);
    lose_texts(&b, 2, true);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(finding_of(&made, "frame_000001.png"), FOUND_SAME_PIXELS);
    assert_holds(cause_of(&made, "frame_000002.png"),
                 "b/frame_000002.png has none of octreel's texts, as after another program has saved it");
    comparison_release(&made);
    session.tree.leaf_capacity = 3;
    const place c = film_in(*state, "c", &session, NULL);
    lose_texts(&c, 2, false);
    made = assert_explained(&a, &c, 10);
    assert_holds(cause_of(&made, "frame_000002.png"), "tick 2: node");
    comparison_release(&made);
}

static void another_anti_aliasing_is_no_other_renderer(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_in(*state, "a", &session, &options);
    options.view.aa = 2;
    const place b = film_in(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline,
                        "another anti-aliasing (2, was 1): the same ticks, looked at in another way");
    assert_string_equal(cause_of(&made, "frame_000001.png"), "tick 1: another anti-aliasing (2, was 1)");
    assert_false(made.why.pairs[1].only_drawn);
    comparison_release(&made);
    edit_file(b.path, "renderer.json", "\"renderer\": \"", "\"renderer\": \"other ");
    made = assert_explained(&a, &b, 10);
    assert_holds(cause_of(&made, "frame_000001.png"), "tick 1: another anti-aliasing (2, was 1); reference drawn by ");
    comparison_release(&made);
}

/* ---- Frames that are in no recording -------------------------------------------------------------------------- */

static void make_folders(const place *a, const place *b)
{
    assert_int_equal(unlink(place_below(a->path, "recording.json").path), 0);
    assert_int_equal(unlink(place_below(b->path, "recording.json").path), 0);
}

static void frames_in_a_folder_tell_rendering_by_their_scenes(void **state)
{
    place b;
    const place a = film_twins(*state, &b);
    make_folders(&a, &b);
    spoil_frame(&b, 1, true);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(cause_of(&made, "frame_000001.png"), "rendering differs: the scene digests are equal");
    assert_string_equal(made.why.headline, "rendering differs: the scene digests are equal");
    comparison_release(&made);
    const place x = frame_place(a.path, 1), y = frame_place(b.path, 1), z = frame_place(b.path, 2);
    made = assert_explained(&x, &y, 10);
    assert_string_equal(made.why.headline, "rendering differs: the scene digests are equal");
    comparison_release(&made);
    made = assert_explained(&x, &z, 10);
    assert_string_equal(made.why.pairs[0].text, "the reference shows tick 1, the frame tick 2");
    comparison_release(&made);
}

static void frames_in_a_folder_tell_unlike_sessions_and_scenes(void **state)
{
    octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_in(*state, "a", &session, &options);
    options.view.camera = CAMERA_TOP;
    const place b = film_in(*state, "b", &session, &options);
    session.tree.leaf_capacity = 3;
    const place c = film_in(*state, "c", &session, &options);
    make_folders(&a, &b);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_holds(cause_of(&made, "frame_000001.png"), "tick 1 of one session in unlike scenes");
    comparison_release(&made);
    made = assert_explained(&b, &c, 10); /* one of them a recording */
    assert_string_equal(cause_of(&made, "frame_000001.png"), "tick 1 of unlike sessions");
    assert_null(made.why.headline);
    comparison_release(&made);
}

static void pictures_that_say_nothing_have_no_cause(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 3.png");
    gallery_write(place_below(b.path, "1.png").path, 0, 5);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    assert_int_equal(count_causes(&made), 0);
    assert_null(made.why.headline);
    comparison_release(&made);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_same_recording_has_nothing_to_explain),
        TEST(another_capacity_is_the_headline_and_its_nodes_the_causes),
        TEST(no_more_frames_are_explained_than_are_asked_for),
        TEST(an_edit_is_the_headline_and_its_point_the_cause),
        TEST(another_view_is_no_difference_of_ticks),
        TEST(heat_of_earlier_ticks_is_a_cause),
        TEST(recordings_of_unlike_length_say_where_each_ends),
        TEST(a_line_edited_by_hand_is_not_believed),
        TEST(a_scene_digest_edited_by_hand_is_not_believed),
        TEST(a_session_edited_after_filming_is_not_believed),
        TEST(lines_that_are_missing_or_torn_are_told),
        TEST(a_damaged_recording_is_trouble),
        TEST(the_same_scene_drawn_otherwise_is_a_difference_of_rendering),
        TEST(another_renderer_alone_is_no_difference),
        TEST(a_frame_changed_after_it_was_drawn_is_told),
        TEST(a_frame_in_the_place_of_another_is_told_by_its_own_tick),
        TEST(a_frame_of_another_session_is_told),
        TEST(a_frame_without_its_texts_is_told),
        TEST(another_anti_aliasing_is_no_other_renderer),
        TEST(frames_in_a_folder_tell_rendering_by_their_scenes),
        TEST(frames_in_a_folder_tell_unlike_sessions_and_scenes),
        TEST(pictures_that_say_nothing_have_no_cause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
