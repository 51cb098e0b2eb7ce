/* SPDX-License-Identifier: MIT */
/* test_frame_checks.c - GL also draws the first, every 100th and the last frame, and a wrong pixel stops the recording.
 *
 * The linker redirects fill_quads() and dlopen() to this file (see tests/CMakeLists.txt). */
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "fill.h"
#include "film.h"
#include "fixture.h"
#include "image_compare.h"
#include "live.h"
#include "png_read.h"
#include "recordings.h"

static uint64_t wrong_after = UINT64_MAX; /* ticks after which the integer rasterizer is wrong by one sample */
static uint64_t filmed;                   /* ticks so far */
static unsigned loads;                    /* number of libraries loaded by dlopen() */

void __real_fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);
void __wrap_fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);
void *__real_dlopen(const char *name, int how);
void *__wrap_dlopen(const char *name, int how);

void __wrap_fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes)
{
    __real_fill_quads(quads, count, part, bytes);
    if (filmed >= wrong_after)
        bytes[0] = bytes[0] == THEME_COLORS - 1 ? 0 : THEME_COLORS - 1;
}

void *__wrap_dlopen(const char *name, int how)
{
    loads++;
    return __real_dlopen(name, how);
}

static void count_ticks(uint64_t done, uint64_t total, void *context)
{
    (void)total;
    (void)context;
    filmed = done;
}

static film_options checked_film(const char *folder, draw_fill fill)
{
    film_options options = small_film(folder);
    options.renderer.fill = fill;
    options.watch.progress = count_ticks;
    filmed = 0;
    wrong_after = UINT64_MAX;
    return options;
}

static void fill_integers_never_loads_gl(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = short_session("wdwd");
    const film_options options = checked_film(folder.path, DRAW_FILL_INTEGERS);
    loads = 0;
    const film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.checks.count, 0);
    assert_int_equal(loads, 0);
}

static void first_every_100th_and_last_frame_are_checked(void **state)
{
    const place checked = place_in(*state, "checked"), plain = place_in(*state, "plain");
    const octree_session session = octree_session_default(); /* 253 ticks */
    film_options options = checked_film(checked.path, DRAW_FILL_CHECKED);
    film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.checks.count, 4);
    assert_int_not_equal(summary.checks.by, DRAW_AUTO);
    assert_string_equal(summary.checks.reason.text, "");
    options = checked_film(plain.path, DRAW_FILL_INTEGERS);
    assert_filmed(&session, &options);
    assert_same_folders(checked.path, plain.path, "renderer.json");
}

static void chunks_and_resumed_recordings_check_their_first_and_last_frame(void **state)
{
    const place folder = place_in(*state, "film"), chunk = place_in(*state, "chunk");
    const octree_session session = octree_session_default();
    uint64_t left = 50;
    film_options options = stopped_after(checked_film(folder.path, DRAW_FILL_CHECKED), &left);
    assert_filmed(&session, &options);
    options = checked_film(folder.path, DRAW_FILL_CHECKED);
    options.resume = true;
    assert_int_equal(assert_filmed(&session, &options).checks.count, 4); /* 50, 100, 200, 252 */
    options = chunk_of(checked_film(chunk.path, DRAW_FILL_CHECKED), 30, 60);
    assert_int_equal(assert_filmed(&session, &options).checks.count, 2);
}

static void last_frame_of_a_session_without_a_known_end_is_checked(void **state)
{
    octreel_error error = {""};
    film_summary summary;
    const place folder = place_in(*state, "film");
    const octree_session session = short_session("wdwd");
    const film_options options = checked_film(folder.path, DRAW_FILL_CHECKED);
    live_recording *live = live_open(&session, &options, &error);
    assert_non_null(live);
    assert_true(live_begin(live, &error) && live_film_first_tick(live, &error));
    for (int i = 0; i < 3; i++)
        assert_true(live_film_tick(live, &(octree_input){0}, &error));
    assert_true(live_close(live, 3, &summary, &error));
    assert_int_equal(summary.checks.count, 2);
}

/* The test fails unless both pictures were kept, and differ only in the first pixel. */
static void assert_kept(const char *prefix)
{
    image pictures[2];
    static const char *const suffixes[] = {"integers.png", "gl.png"};
    for (int i = 0; i < 2; i++) {
        char path[512];
        octreel_error error;
        snprintf(path, sizeof path, "%s.%s", prefix, suffixes[i]);
        if (!image_read_png(path, &pictures[i], &error))
            fail_msg("%s", error.text);
    }
    const image_tally unlike = image_compare(&pictures[0], &pictures[1]).unlike;
    assert_int_equal(unlike.pixels, 1);
    assert_int_equal(unlike.max_x + unlike.max_y, 0);
    image_release(&pictures[0]);
    image_release(&pictures[1]);
}

static void wrong_pixel_stops_the_recording_and_keeps_both_pictures(void **state)
{
    static const struct {
        const char *folder;
        int aa;
    } rows[] = {{"plain", 1}, {"smooth", 2}};
    const octree_session session = octree_session_default();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        octreel_error error = {""};
        film_summary summary;
        const place folder = place_in(*state, rows[i].folder);
        film_options options = checked_film(folder.path, DRAW_FILL_CHECKED);
        options.view.aa = rows[i].aa;
        wrong_after = 100;
        assert_false(film_session(&session, &options, &summary, &error));
        assert_ptr_equal(strstr(error.text, "frame_000100.png: 1 sample"), error.text);
        assert_non_null(strstr(error.text, "different_frame_000100.integers.png"));
        assert_int_equal(summary.frames, 100);
        assert_false(file_exists(frame_place(folder.path, 100).path));
        assert_kept(place_below(folder.path, "different_frame_000100").path);
        options = checked_film(folder.path, DRAW_FILL_CHECKED);
        options.view.aa = rows[i].aa;
        options.resume = true;
        assert_int_equal(assert_filmed(&session, &options).kept, 100);
    }
}

static void wrong_picture_of_a_tree_is_not_written(void **state)
{
    octreel_error error = {""};
    film_summary summary;
    octree *tree = NULL;
    const octree_def def = octree_def_default();
    const place picture = place_in(*state, "tree.png");
    film_options options = checked_film(NULL, DRAW_FILL_CHECKED);
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    assert_true(film_tree(tree, &(tree_subject){.title = "t"}, &options, picture.path, &summary, &error));
    assert_int_equal(summary.checks.count, 1);
    remove(picture.path);
    wrong_after = 0;
    assert_false(film_tree(tree, &(tree_subject){.title = "t"}, &options, picture.path, &summary, &error));
    assert_non_null(strstr(error.text, "tree.integers.png"));
    assert_false(file_exists(picture.path));
    assert_kept(place_in(*state, "tree").path);
    octree_destroy(tree);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(fill_integers_never_loads_gl),
        IN_FOLDER(first_every_100th_and_last_frame_are_checked),
        IN_FOLDER(chunks_and_resumed_recordings_check_their_first_and_last_frame),
        IN_FOLDER(last_frame_of_a_session_without_a_known_end_is_checked),
        IN_FOLDER(wrong_pixel_stops_the_recording_and_keeps_both_pictures),
        IN_FOLDER(wrong_picture_of_a_tree_is_not_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
