/* SPDX-License-Identifier: MIT */
/* test_evidence.c - the folder of evidence: which pictures are written for each finding, what they show, and which
 * folders are refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "evidence.h"
#include "fixture.h"
#include "flip.h"
#include "galleries.h"
#include "images.h"

/* calloc() of some systems returns null if no bytes are requested. */
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

void *__wrap_calloc(size_t count, size_t size)
{
    return count > 0 && size > 0 ? __real_calloc(count, size) : NULL;
}

/* Compare, and leave evidence. */
static comparison_of leave_evidence(const char *a, const char *b, const diff_options *options, const char *folder)
{
    comparison_of made = assert_compared(a, b, options);
    octreel_error error = {""};
    evidence e;
    if (!evidence_prepare(folder, &made.a, &made.b, &error) ||
        !evidence_write_groups(&e, folder, &made.result, group_frames(&made, true), &error))
        fail_msg("%s", error.text);
    evidence_release(&e);
    return made;
}

static void leave_and_forget(const char *a, const char *b, const char *folder)
{
    comparison_of made = leave_evidence(a, b, NULL, folder);
    comparison_release(&made);
}

/* The names in a folder, with blanks between them. */
static void assert_folder_has(const char *folder, const char *names)
{
    char all[2048] = "";
    listing there = folder_list(folder);
    for (size_t i = 0; i < there.count; i++)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? " " : "", there.names[i]);
    listing_release(&there);
    assert_string_equal(all, names);
}

static void assert_refused(const char *a, const char *b, const char *folder, const char *part)
{
    diff_side sides[2] = {assert_side(a), assert_side(b)};
    octreel_error error = {""};
    assert_false(evidence_prepare(folder, &sides[0], &sides[1], &error));
    if (!strstr(error.text, part) || !strstr(error.text, folder))
        fail_msg("\"%s\" does not contain \"%s\"", error.text, part);
    diff_side_release(&sides[0]);
    diff_side_release(&sides[1]);
}

static void each_finding_leaves_the_pictures_that_exist(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png 4.png 5.png"),
                b = gallery_make(*state, "b", "1.png 2.png 3.png 4.png 6.png"), folder = place_in(*state, "out");
    gallery_write(place_below(b.path, "2.png").path, 1, 3);
    image small;
    octreel_error error = {""};
    assert_true(image_create(&small, 3, 40, 3) &&
                image_write_png(&small, place_below(b.path, "3.png").path, NULL, 0, &error));
    image_release(&small);
    assert_int_equal(truncate(place_below(b.path, "4.png").path, 99), 0);
    leave_and_forget(a.path, b.path, folder.path);
    assert_folder_has(folder.path, "2.actual.png 2.difference.png 2.expected.png "
                                   "3.actual.png 3.difference.png 3.expected.png "
                                   "4.actual.png 4.expected.png 5.expected.png 6.actual.png evidence.txt");
    assert_same_files(place_below(folder.path, "2.expected.png").path, place_below(a.path, "2.png").path);
    assert_same_files(place_below(folder.path, "2.actual.png").path, place_below(b.path, "2.png").path);
    assert_same_files(place_below(folder.path, "4.actual.png").path, place_below(b.path, "4.png").path);
}

static void comparison_with_a_baseline_leaves_only_the_actual_frame(void **state)
{
    const place b = gallery_make(*state, "b", "1.png"), folder = place_in(*state, "out"),
                digests = place_in(*state, "digests");
    file_write_text(digests.path, "octreel-digests 2\nbackground ffffff\naccepted 7f 2026-11-22 24x16 runs x\n"
                                  "7f 0123456789abcdef 1\n");
    leave_and_forget(digests.path, b.path, folder.path);
    assert_folder_has(folder.path, "1.actual.png evidence.txt");
}

/* The glowing pixels of the difference are those that count. */
static void pictures_show_expected_actual_and_difference(void **state)
{
    const image_rectangle ignored = {0, 0, 3, 16};
    diff_options options = diff_options_default();
    const place a = place_in(*state, "a.png"), b = place_in(*state, "b.png"), folder = place_in(*state, "out");
    options.tolerance = (image_tolerance){.ignored = &ignored, .ignored_count = 1};
    gallery_write(a.path, 3, 0);
    gallery_write(b.path, 3, 10);
    comparison_of made = leave_evidence(a.path, b.path, &options, folder.path);
    assert_int_equal(made.result.pairs[0].difference.counted.pixels, 7);
    image difference = assert_read_rgb(place_below(folder.path, "b.difference.png").path);
    assert_int_equal(difference.width, GALLERY_WIDTH);
    assert_int_equal(difference.height, GALLERY_HEIGHT);
    for (int n = 0; n < GALLERY_WIDTH * GALLERY_HEIGHT; n++) {
        const int x = n % GALLERY_WIDTH, y = n / GALLERY_WIDTH;
        const image_color drawn = image_color_at(&difference, x, y);
        const bool unlike = y == 3 && x < 10;
        assert_int_equal(unlike && x >= 3, drawn.r > drawn.b);
        assert_int_equal(unlike && x<3, drawn.b> drawn.r);
    }
    image_release(&difference);
    comparison_release(&made);
}

static void with_flip_the_evidence_has_a_map(void **state)
{
    diff_options options = diff_options_default();
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 2.png"),
                folder = place_in(*state, "out");
    const image_palette magma = image_make_magma_palette();
    image small;
    octreel_error error = {""};
    uint8_t map[GALLERY_WIDTH * GALLERY_HEIGHT];
    image_flip flip;
    options.tolerance.flip = true;
    gallery_write(place_below(b.path, "1.png").path, 1, 0);
    assert_true(image_create(&small, 3, 40, 3) &&
                image_write_png(&small, place_below(b.path, "2.png").path, NULL, 0, &error));
    comparison_of made = leave_evidence(a.path, b.path, &options, folder.path);
    assert_folder_has(folder.path, "1.actual.png 1.difference.png 1.expected.png 1.flip.png "
                                   "2.actual.png 2.difference.png 2.expected.png evidence.txt");
    image expected = gallery_picture(0), actual = gallery_picture(1);
    image drawn = assert_read(place_below(folder.path, "1.flip.png").path);
    assert_true(image_measure_flip(&expected, &actual, &options.tolerance, map, &flip));
    assert_true(made.result.pairs[0].difference.flip.mean == flip.mean && flip.mean > 0.1);
    assert_int_equal(drawn.channels, 1);
    assert_memory_equal(drawn.pixels, map, sizeof map);
    assert_memory_equal(drawn.palette.colors, magma.colors, sizeof magma.colors);
    image_release(&small);
    image_release(&expected);
    image_release(&actual);
    image_release(&drawn);
    comparison_release(&made);
}

static void equal_frames_leave_no_pictures(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), folder = place_in(*state, "deep/er/out");
    leave_and_forget(a.path, a.path, folder.path);
    assert_folder_has(folder.path, "evidence.txt");
}

/* Two recordings without frames have no pairs. */
static void comparison_without_frames_leaves_no_pictures(void **state)
{
    const place folder = place_in(*state, "out");
    const diff_result result = {.count = 0};
    const frame_groups groups = {.count = 0};
    octreel_error error = {""};
    evidence e;
    if (!evidence_write_groups(&e, folder.path, &result, &groups, &error))
        fail_msg("%s", error.text);
    evidence_release(&e);
}

static void different_frame_names_have_different_file_names(void **state)
{
    (void)state;
    static const char *const names[][2] = {
        {"frame_000041.png", "frame_000041.actual.png"},
        {"a.PNG", "a.actual.PNG"},
        {"a.ref.png", "a.ref.actual.png"},
        {"photo", "photo.actual.png"},
        {"png", "png.actual.png"},
        {".png", ".png.actual.png"},
        {"menu/1.png", "menu/1.actual.png"},
        {"menu.png/1", "menu.png/1.actual.png"},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char *name = evidence_file_name(names[i][0], EVIDENCE_ACTUAL);
        assert_string_equal(name, names[i][1]);
        assert_true(evidence_is_file_name(name));
        assert_false(evidence_is_file_name(names[i][0]));
        free(name);
    }
    assert_true(evidence_is_file_name("a.difference.png.part"));
    assert_false(evidence_is_file_name(".difference.png"));
    assert_false(evidence_is_file_name("difference.png"));
}

static void pictures_of_subfolders_lie_in_subfolders(void **state)
{
    const place a = gallery_make(*state, "a", "menu/1.png menu/old/2.png"), b = gallery_make(*state, "b", "menu/1.png"),
                folder = place_in(*state, "out"), menu = place_in(*state, "out/menu");
    gallery_write(place_below(b.path, "menu/1.png").path, 0, 3);
    leave_and_forget(a.path, b.path, folder.path);
    assert_folder_has(menu.path, "1.actual.png 1.difference.png 1.expected.png old");
    assert_same_files(place_below(menu.path, "old/2.expected.png").path, place_below(a.path, "menu/old/2.png").path);
    file_write_text(place_below(menu.path, "report.html").path, "mine");
    leave_and_forget(a.path, a.path, folder.path);
    assert_folder_has(menu.path, "report.html");
}

/* Removing old evidence and writing new evidence never leave the folder, and spare other evidence in it. */
static void links_and_other_evidence_in_the_folder_stay(void **state)
{
    const place a = gallery_make(*state, "a", "menu/1.png"), b = gallery_make(*state, "b", "menu/1.png"),
                folder = place_in(*state, "out"), elsewhere = gallery_make(*state, "c", "9.actual.png");
    leave_and_forget(a.path, a.path, folder.path);
    gallery_write(place_below(b.path, "menu/1.png").path, 0, 3);
    leave_and_forget(a.path, b.path, place_below(folder.path, "sub").path);
    assert_int_equal(symlink(elsewhere.path, place_below(folder.path, "menu").path), 0);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    octreel_error error = {""};
    evidence e;
    assert_true(evidence_prepare(folder.path, &made.a, &made.b, &error));
    assert_false(evidence_write_groups(&e, folder.path, &made.result, group_frames(&made, true), &error));
    assert_contains(error.text, "out/menu: cannot create the folder: a link has this name");
    comparison_release(&made);
    assert_folder_has(elsewhere.path, "9.actual.png");
    assert_true(file_exists(place_below(folder.path, "sub/menu/1.actual.png").path));
}

/* ---- The folder ---------------------------------------------------------------------------------------------- */

static void new_evidence_replaces_old_evidence(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png");
    const place folder = place_in(*state, "out");
    leave_and_forget(a.path, b.path, folder.path);
    assert_folder_has(folder.path, "2.expected.png evidence.txt");
    file_write_text(place_below(folder.path, "report.html.part").path, "torn");
    file_write_text(place_below(folder.path, "2.actual.png.part").path, "torn");
    file_write_text(place_below(folder.path, "notes.txt").path, "mine");
    leave_and_forget(b.path, a.path, folder.path);
    assert_folder_has(folder.path, "2.actual.png evidence.txt notes.txt");
    leave_and_forget(a.path, a.path, folder.path);
    assert_folder_has(folder.path, "evidence.txt notes.txt");
}

static void unrelated_folder_is_refused_and_unchanged(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), other = gallery_make(*state, "b", "1.actual.png");
    assert_refused(a.path, a.path, other.path, "contains 1.actual.png but no evidence of octreel diff");
    assert_folder_has(other.path, "1.actual.png");
    file_write_text(place_below(other.path, "evidence.txt").path, "octreel evid");
    assert_refused(a.path, a.path, other.path, "no evidence of octreel diff");
    assert_folder_has(other.path, "1.actual.png evidence.txt");
}

static void empty_folder_is_accepted(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), empty = gallery_make(*state, "b", "");
    leave_and_forget(a.path, a.path, empty.path);
    assert_folder_has(empty.path, "evidence.txt");
}

/* Evidence is emptied first: what is compared must not be in it. */
static void compared_pictures_are_not_removed(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), b = gallery_make(*state, "b", "2.png");
    const place folder = place_in(*state, "out");
    leave_and_forget(a.path, b.path, folder.path);
    assert_folder_has(folder.path, "1.expected.png 2.actual.png evidence.txt");
    const place expected = place_below(folder.path, "1.expected.png"),
                actual = place_below(folder.path, "2.actual.png");
    assert_refused(folder.path, a.path, folder.path, "it is compared, and writing evidence would remove it");
    assert_refused(a.path, folder.path, folder.path, "it is compared, and writing evidence would remove it");
    assert_refused(expected.path, actual.path, folder.path, "a picture in it is compared");
    assert_folder_has(folder.path, "1.expected.png 2.actual.png evidence.txt");
    const place inner = gallery_make(*state, "out/inner", "1.actual.png");
    assert_refused(a.path, inner.path, folder.path, "a folder in it is compared");
    assert_refused(place_below(inner.path, "1.actual.png").path, actual.path, folder.path,
                   "a picture in it is compared");
    assert_folder_has(inner.path, "1.actual.png");
}

static void error_names_a_folder_that_cannot_be_made(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), file = place_in(*state, "file");
    file_write_text(file.path, "here");
    assert_refused(a.path, a.path, file.path, "a file has this name");
}

static void error_names_a_picture_that_cannot_be_written(void **state)
{
    static const char *const names[] = {"2.expected.png", "2.actual.png", "2.difference.png", "2.actual.png"};
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 2.png");
    gallery_write(place_below(b.path, "2.png").path, 1, 3);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char name[16];
        snprintf(name, sizeof name, "out%zu", i);
        const place folder = place_in(*state, name);
        comparison_of made = assert_compared(a.path, b.path, NULL);
        octreel_error error = {""};
        evidence e;
        assert_true(evidence_prepare(folder.path, &made.a, &made.b, &error));
        const place taken = place_below(folder.path, names[i]); /* by a folder, which nothing is renamed over */
        assert_int_equal(mkdir(taken.path, 0777), 0);
        assert_false(evidence_write_groups(&e, folder.path, &made.result, group_frames(&made, true), &error));
        if (!strstr(error.text, taken.path))
            fail_msg("\"%s\" does not name %s", error.text, taken.path);
        comparison_release(&made);
    }
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(each_finding_leaves_the_pictures_that_exist),
        WITH_FOLDER(comparison_with_a_baseline_leaves_only_the_actual_frame),
        WITH_FOLDER(pictures_show_expected_actual_and_difference),
        WITH_FOLDER(with_flip_the_evidence_has_a_map),
        WITH_FOLDER(equal_frames_leave_no_pictures),
        WITH_FOLDER(comparison_without_frames_leaves_no_pictures),
        cmocka_unit_test(different_frame_names_have_different_file_names),
        WITH_FOLDER(pictures_of_subfolders_lie_in_subfolders),
        WITH_FOLDER(links_and_other_evidence_in_the_folder_stay),
        WITH_FOLDER(new_evidence_replaces_old_evidence),
        WITH_FOLDER(unrelated_folder_is_refused_and_unchanged),
        WITH_FOLDER(empty_folder_is_accepted),
        WITH_FOLDER(compared_pictures_are_not_removed),
        WITH_FOLDER(error_names_a_folder_that_cannot_be_made),
        WITH_FOLDER(error_names_a_picture_that_cannot_be_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
