/* SPDX-License-Identifier: MIT */
/* test_diff.c - comparing two sides: how frames are paired, and the finding of each pair. */
#include "galleries.h"
#include "ignored_layers.h"
#include "view.h"
#include "fixture.h"
#include "images.h"
#include "recordings.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Sides -------------------------------------------------------------------------------------------------- */

static void folder_contains_its_pictures_in_order(void **state)
{
    const place folder = gallery_make(*state, "a", "b.png a.png B.PNG c.PNG frame.png");
    file_write_text(place_below(folder.path, "notes.txt").path, "no picture");
    file_write_text(place_below(folder.path, ".hidden.png").path, "no picture");
    file_write_text(place_below(folder.path, "a.png.part").path, "no picture");
    static const char *const expected[] = {"B.PNG", "a.png", "b.png", "c.PNG", "frame.png"};
    diff_side side = assert_side(folder.path);
    assert_int_equal(side.kind, DIFF_FOLDER);
    assert_int_equal(side.count, 5);
    for (size_t i = 0; i < side.count; i++)
        assert_string_equal(side.frames[i].name, expected[i]);
    diff_side_release(&side);
}

static void recording_contains_only_its_frames(void **state)
{
    const place folder = gallery_make(*state, "a", "frame_000000.png frame_000001.png film_sheet.png");
    file_write_text(place_below(folder.path, "recording.json").path, "{}");
    diff_side side = assert_side(folder.path);
    assert_int_equal(side.kind, DIFF_RECORDING);
    assert_int_equal(side.count, 2);
    diff_side_release(&side);
}

static void assert_frames(const char *path, const diff_search *search, const char *names)
{
    diff_side side;
    octreel_error error = {""};
    char all[1024] = "";
    if (!diff_side_open(&side, path, search, &error))
        fail_msg("%s", error.text);
    for (size_t i = 0; i < side.count; i++)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? " " : "", side.frames[i].name);
    assert_string_equal(all, names);
    diff_side_release(&side);
}

static void subfolders_are_searched_in_byte_order(void **state)
{
    const place folder = gallery_make(*state, "a", "a/x.png a.png a-b.png a/b/y.png B/z.png a0.png b.png/1.png");
    assert_frames(folder.path, NULL, "B/z.png a-b.png a.png a/b/y.png a/x.png a0.png b.png/1.png");
    assert_frames(folder.path, &(diff_search){.flat = true}, "a-b.png a.png a0.png b.png");
}

static void hidden_linked_and_left_out_folders_are_not_searched(void **state)
{
    const place folder =
        gallery_make(*state, "a", "1.png .git/2.png other/3.png out/4.actual.png out/deep/5.actual.png linked/6.png");
    const place elsewhere = gallery_make(*state, "b", "7.png"), other = place_in(*state, "a/other");
    file_write_text(place_in(*state, "a/out/evidence.txt").path, "octreel evidence 1\n");
    assert_int_equal(symlink(elsewhere.path, place_in(*state, "a/linked/folder").path), 0);
    assert_int_equal(symlink("..", place_in(*state, "a/linked/loop").path), 0);
    assert_int_equal(mkfifo(place_in(*state, "a/linked/evidence.txt").path, 0600), 0);
    assert_frames(folder.path, NULL, "1.png linked/6.png other/3.png");
    assert_frames(folder.path, &(diff_search){.left_out = {NULL, other.path}}, "1.png linked/6.png");
    assert_frames(other.path, &(diff_search){.left_out = {folder.path, other.path}}, "3.png");
}

/* A recording that lies in a folder is a folder of pictures; subfolders of a recording are no part of it. */
static void recording_is_searched_only_below_a_folder(void **state)
{
    const place folder = gallery_make(*state, "a", "film/frame_000000.png film/sheet.png film/old/frame_000000.png");
    file_write_text(place_in(*state, "a/film/recording.json").path, "{}");
    assert_frames(place_in(*state, "a/film").path, NULL, "frame_000000.png");
    assert_frames(folder.path, NULL, "film/frame_000000.png film/old/frame_000000.png film/sheet.png");
}

static void assert_no_side(const char *path, const char *part)
{
    diff_side side;
    octreel_error error = {""};
    assert_false(diff_side_open(&side, path, NULL, &error));
    assert_non_null(strstr(error.text, part));
    assert_null(side.frames);
}

/* A frame that cannot be reached must not look like a frame that does not exist. */
static void unreachable_entry_is_an_error(void **state)
{
    const place folder = gallery_make(*state, "a", "a_rather_long_name.png");
    char path[4096];
    snprintf(path, sizeof path, "%s", folder.path);
    while (strlen(path) + sizeof "/." + 8 < sizeof path)
        strcat(path, "/.");
    assert_no_side(path, "a_rather_long_name.png: File name too long");
}

static void different_frames_in_subfolders_differ(void **state)
{
    const place a = gallery_make(*state, "a", "1.png a/b/2.png a/b/3.png a/4.png"),
                b = gallery_make(*state, "b", "1.png a/b/2.png a/b/3.png c/4.png");
    gallery_write(place_in(*state, "b/a/b/3.png").path, 2, 4);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    assert_int_equal(find_finding(&made, "a/b/2.png"), FOUND_SAME_BYTES);
    assert_int_equal(find_finding(&made, "a/b/3.png"), FOUND_PIXELS);
    assert_int_equal(find_finding(&made, "a/4.png"), FOUND_NO_FRAME);
    assert_int_equal(find_finding(&made, "c/4.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
}

static void invalid_sides_are_refused(void **state)
{
    const place text = place_in(*state, "text.png"), fifo = place_in(*state, "pipe");
    file_write_text(text.path, "no picture, whatever its name");
    assert_int_equal(mkfifo(fifo.path, 0600), 0);
    assert_no_side(text.path, "not a PNG file, a folder, or a baseline");
    assert_no_side(fifo.path, "neither a file nor a folder");
    assert_no_side(place_in(*state, "missing").path, "missing: No such file");
}

/* ---- Pairs -------------------------------------------------------------------------------------------------- */

static void frames_are_paired_by_name(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 4.png 5.png"),
                b = gallery_make(*state, "b", "1.png 2.png 3.png 5.png 6.png");
    gallery_write(place_below(b.path, "5.png").path, 3, 7); /* a's 5.png, spoilt */
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(made.result.count, 6);
    assert_int_equal(find_finding(&made, "1.png"), FOUND_SAME_BYTES);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_SAME_BYTES);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_NO_REFERENCE);
    assert_int_equal(find_finding(&made, "4.png"), FOUND_NO_FRAME);
    assert_int_equal(find_finding(&made, "5.png"), FOUND_PIXELS);
    assert_int_equal(find_finding(&made, "6.png"), FOUND_NO_REFERENCE);
    assert_int_equal(made.result.found[FOUND_NO_REFERENCE], 2);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    const image_difference *difference = &diff_find(&made.result, "5.png")->difference;
    assert_int_equal(difference->unlike.pixels, 7);
    assert_true(difference->unlike.min_y == 3 && difference->unlike.max_y == 3 && difference->unlike.max_x == 6);
    comparison_release(&made);
}

static void recordings_of_different_length_differ(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    octree_session session = octree_session_default();
    film_options options = small_film(a.path);
    session.keys = "ww";
    assert_filmed(&session, &options);
    options.folder = b.path;
    options.every = 2;
    assert_filmed(&session, &options);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(made.result.count, 3);
    assert_int_equal(made.result.found[FOUND_SAME_BYTES], 2);
    assert_int_equal(find_finding(&made, "frame_000001.png"), FOUND_NO_FRAME);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    comparison_release(&made);
}

static void two_pictures_are_a_pair_with_any_names(void **state)
{
    const place a = place_in(*state, "old.png"), b = place_in(*state, "a_new.png");
    gallery_write(a.path, 5, 0);
    gallery_write(b.path, 5, 2);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(made.result.count, 1);
    assert_int_equal(find_finding(&made, "a_new.png"), FOUND_PIXELS);
    comparison_release(&made);
}

static void incomparable_sides_are_refused(void **state)
{
    const place folder = gallery_make(*state, "a", "1.png"), empty = gallery_make(*state, "b", "");
    const place picture = place_below(folder.path, "1.png");
    diff_options options = diff_options_default();
    assert_not_compared(folder.path, picture.path, NULL, "cannot compare one picture with a folder");
    assert_not_compared(empty.path, empty.path, NULL, "nothing to compare");
    options.mask = ignore_layers;
    options.ignored_layers = 1u << LAYER_TEXT;
    assert_not_compared(folder.path, folder.path, &options, "--ignore-layer needs a recording");
    comparison_of made = assert_compared(empty.path, folder.path, NULL);
    assert_int_equal(find_finding(&made, "1.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
}

/* ---- Findings ----------------------------------------------------------------------------------------------- */

/* The same pixels, in a file of other bytes. */
static void write_otherwise(const char *path, uint64_t seed)
{
    static const image_text texts[] = {{"Comment", "the same"}};
    image picture = gallery_picture(seed);
    octreel_error error;
    assert_true(image_write_png(&picture, path, texts, 1, &error));
    image_release(&picture);
}

static void equal_pixels_in_different_bytes_are_equal(void **state)
{
    const place a = place_in(*state, "a.png"), b = place_in(*state, "b.png");
    gallery_write(a.path, 9, 0);
    write_otherwise(b.path, 9);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(find_finding(&made, "b.png"), FOUND_SAME_PIXELS);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void different_sizes_are_a_finding_of_their_own(void **state)
{
    const place a = place_in(*state, "a.png"), b = place_in(*state, "b.png");
    image wide, tall;
    octreel_error error;
    diff_options all = {.tolerance = {.max_pixels = UINT64_MAX, .max_delta = 1, .antialias = true}};
    assert_true(image_create(&wide, 6, 4, 3) && image_create(&tall, 4, 6, 3));
    assert_true(image_write_png(&wide, a.path, NULL, 0, &error) && image_write_png(&tall, b.path, NULL, 0, &error));
    comparison_of made = assert_compared(a.path, b.path, &all);
    const diff_pair *pair = &made.result.pairs[0];
    assert_int_equal(pair->finding, FOUND_SIZE);
    assert_true(pair->about[0].width == 6 && pair->about[0].height == 4 && pair->about[1].width == 4);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    comparison_release(&made);
    image_release(&wide);
    image_release(&tall);
}

static void cut_short(const char *path, size_t size)
{
    assert_int_equal(truncate(path, (off_t)size), 0);
}

/* Though two halves of a picture are equal byte by byte. */
static void unreadable_frame_is_an_error(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png"), b = gallery_make(*state, "b", "1.png 2.png 3.png");
    cut_short(place_below(a.path, "1.png").path, 300);
    cut_short(place_below(b.path, "1.png").path, 300);
    cut_short(place_below(b.path, "2.png").path, 0);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_int_equal(find_finding(&made, "1.png"), FOUND_UNREADABLE);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_UNREADABLE);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_SAME_BYTES);
    assert_non_null(strstr(diff_find(&made.result, "1.png")->trouble, "1.png: the file is truncated"));
    assert_int_equal(made.result.verdict, DIFF_TROUBLE);
    comparison_release(&made);
}

static void bytes_after_the_end_of_equal_files_are_ignored(void **state)
{
    const place a = place_in(*state, "a.png");
    size_t size;
    gallery_write(a.path, 1, 0);
    char *bytes = file_read(a.path, &size); /* with a zero behind them */
    file_write(a.path, bytes, size + 1);
    free(bytes);
    comparison_of made = assert_compared(a.path, a.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void tolerance_forgives_only_what_it_allows(void **state)
{
    const place a = place_in(*state, "a.png"), b = place_in(*state, "b.png");
    gallery_write(a.path, 2, 0);
    gallery_write(b.path, 2, 6);
    const image_rectangle row = {0, 3, 4, 1};
    const struct {
        image_tolerance tolerance;
        diff_finding finding;
    } cases[] = {
        {{.max_pixels = 5}, FOUND_PIXELS},
        {{.max_pixels = 6}, FOUND_WITHIN},
        {{.max_delta = 0.001}, FOUND_PIXELS},
        {{.max_delta = 0.01}, FOUND_WITHIN},
        {{.max_channel = 1}, FOUND_WITHIN},
        {{.max_share = 5. / (GALLERY_WIDTH * GALLERY_HEIGHT)}, FOUND_PIXELS},
        {{.max_share = 6. / (GALLERY_WIDTH * GALLERY_HEIGHT)}, FOUND_WITHIN},
        {{.ignored = &row, .ignored_count = 1}, FOUND_PIXELS},
        {{.ignored = &row, .ignored_count = 1, .max_pixels = 1}, FOUND_PIXELS},
        {{.ignored = &row, .ignored_count = 1, .max_pixels = 2}, FOUND_WITHIN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const diff_options options = {.tolerance = cases[i].tolerance};
        comparison_of made = assert_compared(a.path, b.path, &options);
        assert_int_equal(find_finding(&made, "b.png"), cases[i].finding);
        assert_int_equal(made.result.pairs[0].difference.unlike.pixels, cases[i].tolerance.ignored_count ? 2 : 6);
        comparison_release(&made);
    }
}

/* More pairs than cores and threads, most of them different: each gets its own finding. */
static void pairs_compared_in_parallel_are_independent(void **state)
{
    enum { PAIRS = 150 };
    const place a = gallery_make(*state, "a", ""), b = gallery_make(*state, "b", "");
    char name[32];
    for (int i = 0; i < PAIRS; i++) {
        snprintf(name, sizeof name, "frame_%06d.png", i);
        gallery_write(place_below(a.path, name).path, (uint64_t)i, 0);
        gallery_write(place_below(b.path, name).path, (uint64_t)i, i % 17);
    }
    comparison_of made = assert_compared(a.path, b.path, NULL);
    for (int i = 0; i < PAIRS; i++) {
        snprintf(name, sizeof name, "frame_%06d.png", i);
        assert_int_equal(find_finding(&made, name), i % 17 ? FOUND_PIXELS : FOUND_SAME_BYTES);
        assert_int_equal(diff_find(&made.result, name)->difference.unlike.pixels, i % 17);
    }
    comparison_release(&made);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(folder_contains_its_pictures_in_order),
        WITH_FOLDER(recording_contains_only_its_frames),
        WITH_FOLDER(subfolders_are_searched_in_byte_order),
        WITH_FOLDER(hidden_linked_and_left_out_folders_are_not_searched),
        WITH_FOLDER(recording_is_searched_only_below_a_folder),
        WITH_FOLDER(different_frames_in_subfolders_differ),
        WITH_FOLDER(unreachable_entry_is_an_error),
        WITH_FOLDER(invalid_sides_are_refused),
        WITH_FOLDER(frames_are_paired_by_name),
        WITH_FOLDER(recordings_of_different_length_differ),
        WITH_FOLDER(two_pictures_are_a_pair_with_any_names),
        WITH_FOLDER(incomparable_sides_are_refused),
        WITH_FOLDER(equal_pixels_in_different_bytes_are_equal),
        WITH_FOLDER(different_sizes_are_a_finding_of_their_own),
        WITH_FOLDER(unreadable_frame_is_an_error),
        WITH_FOLDER(bytes_after_the_end_of_equal_files_are_ignored),
        WITH_FOLDER(tolerance_forgives_only_what_it_allows),
        WITH_FOLDER(pairs_compared_in_parallel_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
