/* SPDX-License-Identifier: MIT */
/* test_explain_frames.c - frames that differ although their scenes are equal, and frames that were copied from
 * elsewhere, changed or saved by another program. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "edits.h"
#include "explained.h"
#include "fixture.h"
#include "layer.h"

#define KEYS "wdn."

/* ---- What only the drawing makes ------------------------------------------------------------------------------ */

static void different_pixels_of_an_equal_scene_are_a_difference_of_rendering(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    change_pixel_of_frame(b.path, 1, 77, true);
    change_pixel_of_frame(b.path, 3, 77, true);
    edit_file(b.path, "renderer.json", "\"renderer\": null", "\"renderer\": \"other \"");
    comparison_of made = assert_explained(&a, &b, 10);
    const char *cause = find_cause_text(&made, "frame_000003.png");
    assert_contains(made.why.headline, "rendering differs: the scene digests are equal; reference drawn by ");
    assert_memory_equal(made.why.headline, cause, strlen(made.why.headline));
    assert_contains(cause, ", frame by ");
    assert_contains(cause, "other ");
    assert_true(made.why.pairs[3].only_drawn);
    comparison_release(&made);
    assert_int_equal(unlink(place_below(b.path, "renderer.json").path), 0);
    made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "frame by an unknown renderer");
    comparison_release(&made);
}

static void different_renderer_with_equal_pixels_is_no_difference(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    edit_file(b.path, "renderer.json", "\"renderer\": null", "\"renderer\": \"other \"");
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    assert_null(made.why.headline);
    comparison_release(&made);
}

static void frame_edited_after_recording_is_reported(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    change_pixel_of_frame(b.path, 1, 77, false);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000001.png"), "b/frame_000001.png was changed after it was drawn");
    comparison_release(&made);
}

static void frame_with_the_name_of_another_is_reported_with_its_tick(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    const place second = frame_place(b.path, 2), third = frame_place(b.path, 3), aside = place_below(b.path, "aside");
    assert_int_equal(rename(second.path, aside.path), 0);
    assert_int_equal(rename(third.path, second.path), 0);
    assert_int_equal(rename(aside.path, third.path), 0);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(made.why.headline, "frame_000002.png: ");
    assert_contains(made.why.headline, "b/frame_000002.png is the frame of tick 3");
    assert_contains(find_cause_text(&made, "frame_000003.png"), "b/frame_000003.png is the frame of tick 2");
    comparison_release(&made);
}

static void frame_of_another_session_is_reported(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    const octree_session session = short_session("aaaa");
    const place c = film_into(*state, "c", &session, NULL);
    assert_int_equal(rename(frame_place(c.path, 2).path, frame_place(b.path, 2).path), 0);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000002.png"), "b/frame_000002.png is a frame of another session");
    comparison_release(&made);
}

static void edited_frames_on_both_sides_are_reported(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    change_pixel_of_frame(a.path, 1, 77, false);
    assert_int_equal(remove(frame_place(b.path, 1).path), 0);
    file_copy(b.path, "frame_000003.png", "frame_000001.png");
    remove_texts_of_frame(a.path, 2, false);
    remove_texts_of_frame(b.path, 2, true);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000001.png"), "a/frame_000001.png was changed after it was drawn");
    assert_contains(find_cause_text(&made, "frame_000001.png"), "; ");
    assert_contains(find_cause_text(&made, "frame_000001.png"), "b/frame_000001.png is the frame of tick 3");
    assert_contains(find_cause_text(&made, "frame_000002.png"), "a/frame_000002.png has no text chunks of octreel");
    assert_contains(find_cause_text(&made, "frame_000002.png"), "; ");
    assert_contains(find_cause_text(&made, "frame_000002.png"), "b/frame_000002.png has no text chunks of octreel");
    comparison_release(&made);
}

static void frame_without_text_chunks_is_reported(void **state)
{
    octree_session session = short_session(KEYS);
    place b;
    const place a = film_twice(*state, KEYS, &b);
    remove_texts_of_frame(b.path, 1, false);
    remove_texts_of_frame(b.path, 2, true);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(find_finding(&made, "frame_000001.png"), FOUND_SAME_PIXELS);
    assert_contains(find_cause_text(&made, "frame_000002.png"),
                    "b/frame_000002.png has no text chunks of octreel; another program may have saved it");
    comparison_release(&made);
    session.tree.leaf_capacity = 3;
    const place c = film_into(*state, "c", &session, NULL);
    remove_texts_of_frame(c.path, 2, false);
    made = assert_explained(&a, &c, 10);
    assert_contains(find_cause_text(&made, "frame_000002.png"), "tick 2: node");
    comparison_release(&made);
}

static void different_anti_aliasing_is_not_a_different_renderer(void **state)
{
    const octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_into(*state, "a", &session, &options);
    options.view.aa = 2;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(made.why.headline,
                        "another anti-aliasing (2, was 1): the ticks are the same, only the view differs");
    assert_string_equal(find_cause_text(&made, "frame_000001.png"), "tick 1: another anti-aliasing (2, was 1)");
    assert_false(made.why.pairs[1].only_drawn);
    comparison_release(&made);
    edit_file(b.path, "renderer.json", "\"renderer\": null", "\"renderer\": \"other \"");
    made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000001.png"),
                    "tick 1: another anti-aliasing (2, was 1); reference drawn by ");
    comparison_release(&made);
}

/* ---- Frames that are in no recording -------------------------------------------------------------------------- */

static void make_folders(const place *a, const place *b)
{
    assert_int_equal(unlink(place_below(a->path, "recording.json").path), 0);
    assert_int_equal(unlink(place_below(b->path, "recording.json").path), 0);
}

static void equal_scenes_of_frames_in_a_folder_show_different_rendering(void **state)
{
    place b;
    const place a = film_twice(*state, KEYS, &b);
    make_folders(&a, &b);
    change_pixel_of_frame(b.path, 1, 77, true);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_string_equal(find_cause_text(&made, "frame_000001.png"), "rendering differs: the scene digests are equal");
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

static void frames_in_a_folder_show_different_sessions_and_scenes(void **state)
{
    octree_session session = short_session(KEYS);
    film_options options = small_film("");
    const place a = film_into(*state, "a", &session, &options);
    options.view.camera = CAMERA_TOP;
    const place b = film_into(*state, "b", &session, &options);
    session.tree.leaf_capacity = 3;
    const place c = film_into(*state, "c", &session, &options);
    make_folders(&a, &b);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_contains(find_cause_text(&made, "frame_000001.png"), "tick 1 of one session, drawn as two different scenes");
    comparison_release(&made);
    made = assert_explained(&b, &c, 10); /* one of them a recording */
    assert_string_equal(find_cause_text(&made, "frame_000001.png"), "tick 1 of two different sessions");
    assert_null(made.why.headline);
    comparison_release(&made);
}

static void pictures_without_text_chunks_have_no_cause(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 3.png");
    gallery_write(place_below(b.path, "1.png").path, 0, 5);
    comparison_of made = assert_explained(&a, &b, 10);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    for (size_t i = 0; i < made.result.count; i++)
        assert_null(explanation_cause(&made.why, i));
    assert_null(made.why.headline);
    comparison_release(&made);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(different_pixels_of_an_equal_scene_are_a_difference_of_rendering),
        TEST(different_renderer_with_equal_pixels_is_no_difference),
        TEST(frame_edited_after_recording_is_reported),
        TEST(frame_with_the_name_of_another_is_reported_with_its_tick),
        TEST(frame_of_another_session_is_reported),
        TEST(edited_frames_on_both_sides_are_reported),
        TEST(frame_without_text_chunks_is_reported),
        TEST(different_anti_aliasing_is_not_a_different_renderer),
        TEST(equal_scenes_of_frames_in_a_folder_show_different_rendering),
        TEST(frames_in_a_folder_show_different_sessions_and_scenes),
        TEST(pictures_without_text_chunks_have_no_cause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
