/* SPDX-License-Identifier: MIT */
/* test_compare_references.c - references that are files: PNGs of every kind, baselines, and hostile files. */
#include "accept.h"
#include "fixture.h"
#include "files.h"
#include "images.h"
#include "png_kinds.h"
#include "octreel/compare.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WIDTH = 8, HEIGHT = 6 };

/* A picture in memory, with r, g, b, alpha in each pixel. */
static unsigned char rgba[4 * WIDTH * HEIGHT];

static octreel_pixels make_picture(unsigned level)
{
    for (unsigned i = 0; i < sizeof rgba; i++)
        rgba[i] = (unsigned char)(i % 4 == 3 ? 255 : (i * 7 + level) % 256);
    return octreel_make_pixels(rgba, WIDTH, HEIGHT, OCTREEL_RGBA8);
}

/* Write the picture without alpha as a PNG. */
static void save_picture(const char *path)
{
    image rgb;
    assert_true(image_create(&rgb, WIDTH, HEIGHT, 3));
    for (int n = 0; n < WIDTH * HEIGHT; n++)
        memcpy(rgb.pixels + 3 * n, rgba + 4 * n, 3);
    assert_written(&rgb, path);
    image_release(&rgb);
}

static octreel_comparison to_file(const octreel_pixels *actual, const char *reference, const octreel_compare_def *def)
{
    octreel_comparison found;
    const octreel_verdict verdict = octreel_compare_pixels_to_file(actual, reference, def, &found);
    assert_int_equal(verdict, found.verdict);
    return found;
}

static octreel_comparison of_files(const char *actual, const char *reference, const octreel_compare_def *def)
{
    octreel_comparison found;
    const octreel_verdict verdict = octreel_compare_files(actual, reference, def, &found);
    assert_int_equal(verdict, found.verdict);
    return found;
}

/* ---- Hostile files -------------------------------------------------------------------------------------------- */

/* Neither pixels nor a good file can be compared with the reference, and the sentence says why. */
static void assert_bad_reference(const temp_folder *folder, const char *reference, const char *reason)
{
    const place good = place_in(folder, "good.png");
    const octreel_pixels picture = make_picture(0);
    save_picture(good.path);
    const octreel_comparison found[] = {to_file(&picture, reference, NULL), of_files(good.path, reference, NULL)};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(found[i].verdict, OCTREEL_VERDICT_TROUBLE);
        assert_ptr_equal(strstr(found[i].sentence, reference), found[i].sentence);
        assert_contains(found[i].sentence, reason);
        assert_int_equal(found[i].width, 0);
        assert_int_equal(found[i].counted, 0);
    }
}

static void missing_file_folder_and_pipe_are_refused(void **state)
{
    const temp_folder *folder = *state;
    const place pipe = place_in(folder, "pipe.png");
    assert_int_equal(mkfifo(pipe.path, 0600), 0);
    assert_bad_reference(
        folder, place_in(folder, "missing.png").path,
        "no reference: No such file or directory; look at the new picture and, if it is right, save it");
    assert_bad_reference(folder, folder->name, "the reference is a folder; name a PNG file or a baseline in it");
    assert_bad_reference(folder, pipe.path, "is not a regular file");
    const octreel_pixels picture = make_picture(0);
    assert_contains(to_file(&picture, NULL, NULL).sentence, "the reference: the path is null");
    assert_contains(of_files(NULL, pipe.path, NULL).sentence, "the picture: the path is null");
    assert_contains(of_files(folder->name, place_in(folder, "good.png").path, NULL).sentence, "is not a regular file");
}

static void truncated_and_other_files_are_refused(void **state)
{
    const temp_folder *folder = *state;
    const place good = place_in(folder, "whole.png"), bad = place_in(folder, "bad.png");
    size_t size;
    make_picture(0);
    save_picture(good.path);
    char *bytes = file_read(good.path, &size);
    for (size_t cut = 0; cut < size; cut += 5) {
        file_write(bad.path, bytes, cut);
        assert_bad_reference(folder, bad.path, "");
    }
    free(bytes);
    file_write_text(bad.path, "P6 2 2 255\nabcdefghijkl");
    assert_bad_reference(folder, bad.path, "PNG");
    file_write_text(bad.path, "octreel-digests 9\n");
    assert_bad_reference(folder, bad.path, ":1: expected \"octreel-digests 2\"");
}

static void other_size_is_a_difference(void **state)
{
    const place reference = place_in(*state, "a.png");
    const octreel_pixels picture = make_picture(0), small = octreel_make_pixels(rgba, WIDTH, HEIGHT - 1, OCTREEL_RGBA8);
    save_picture(reference.path);
    assert_int_equal(to_file(&picture, reference.path, NULL).verdict, OCTREEL_VERDICT_SAME);
    const octreel_comparison found = to_file(&small, reference.path, NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_contains(found.sentence, "the reference is 8x6, the frame is 8x5");
}

/* Every way of storing a picture in a PNG: equal to the pixels that the reader delivers, and one level off is found. */
static void compare_with_kind(const char *path, png_kind kind)
{
    image read = assert_read(path);
    const size_t count = (size_t)read.width * (size_t)read.height;
    unsigned char *pixels = malloc(count * 6);
    assert_non_null(pixels);
    for (size_t n = 0; n < count; n++) {
        const image_color color = image_color_at(&read, (int)n % read.width, (int)n / read.width);
        memcpy(pixels + 3 * n, &color, 3);
    }
    if (read.wide)
        memcpy(pixels, read.pixels, count * 6);
    octreel_pixels picture =
        octreel_make_pixels(pixels, read.width, read.height, read.wide ? OCTREEL_RGB16 : OCTREEL_RGB8);
    const octreel_comparison same = to_file(&picture, path, NULL);
    if (same.verdict != OCTREEL_VERDICT_SAME)
        fail_msg("colour type %d, depth %d: %s", kind.color_type, kind.depth, same.sentence);
    pixels[17] ^= 1;
    const octreel_comparison other = to_file(&picture, path, NULL);
    assert_int_equal(other.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_int_equal(other.different, 1);
    assert_int_equal(other.worst_x, read.wide ? 2 : 5);
    free(pixels);
    image_release(&read);
}

static void every_kind_of_png_is_compared(void **state)
{
    png_for_every_kind(compare_with_kind, temp_file(*state, "kind.png"));
}

/* "-" is a file of this name, not standard input. */
static void minus_is_a_file_name(void **state)
{
    const temp_folder *folder = *state;
    char before[4096];
    const octreel_pixels picture = make_picture(3);
    save_picture(place_in(folder, "-").path);
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(folder->name), 0);
    const octreel_verdict verdict = to_file(&picture, "-", NULL).verdict;
    assert_int_equal(chdir(before), 0);
    assert_int_equal(verdict, OCTREEL_VERDICT_SAME);
}

/* ---- Baselines ------------------------------------------------------------------------------------------------ */

/* Accept the picture of a file into a baseline, beside the digests that were accepted before. */
static void accept_into(const char *baseline, const char *frames)
{
    frame_list all = {NULL, 0, 0, NULL};
    octreel_error error = {""};
    const accept_options options = {.reference = baseline,
                                    .frames = frames,
                                    .names = &all,
                                    .note = {.date = "2026-11-27", .reason = "a test"},
                                    .variant = true};
    if (!accept_frames(&options, NULL, &error))
        fail_msg("%s", error.text);
}

static void any_accepted_digest_passes(void **state)
{
    const temp_folder *folder = *state;
    const place frames = place_in(folder, "frames"), picture = place_in(folder, "frames/menu.png");
    const place baseline = place_in(folder, "baseline.txt");
    assert_int_equal(mkdir(frames.path, 0700), 0);
    for (unsigned level = 0; level < 2; level++) {
        make_picture(level);
        save_picture(picture.path);
        accept_into(baseline.path, frames.path);
    }
    for (unsigned level = 0; level < 3; level++) {
        const octreel_pixels pixels = make_picture(level);
        save_picture(picture.path);
        const octreel_comparison found[] = {to_file(&pixels, baseline.path, NULL),
                                            of_files(picture.path, baseline.path, NULL)};
        for (int i = 0; i < 2; i++) {
            assert_int_equal(found[i].verdict, level < 2 ? OCTREEL_VERDICT_SAME : OCTREEL_VERDICT_DIFFERENT);
            assert_int_equal(found[i].width, WIDTH);
            assert_int_equal(found[i].reference_height, HEIGHT);
            assert_int_equal(found[i].different, 0);
            if (level == 2)
                assert_contains(found[i].sentence, "matches none of the 2 accepted variants");
        }
    }
}

static void frame_is_chosen_by_name(void **state)
{
    const temp_folder *folder = *state;
    const place frames = place_in(folder, "frames"), baseline = place_in(folder, "baseline.txt");
    static const char *const names[] = {"frames/a.png", "frames/b.png"};
    octreel_compare_def def = octreel_compare_def_default();
    assert_int_equal(mkdir(frames.path, 0700), 0);
    for (unsigned i = 0; i < 2; i++) {
        make_picture(i);
        save_picture(place_in(folder, names[i]).path);
    }
    accept_into(baseline.path, frames.path);
    const octreel_pixels picture = make_picture(1);
    assert_contains(to_file(&picture, baseline.path, &def).sentence, "has 2 frames; set `frame`");
    def.frame = "a";
    assert_int_equal(to_file(&picture, baseline.path, &def).verdict, OCTREEL_VERDICT_DIFFERENT);
    def.frame = "b.png";
    assert_int_equal(to_file(&picture, baseline.path, &def).verdict, OCTREEL_VERDICT_SAME);
    def.frame = "b.p";
    assert_contains(to_file(&picture, baseline.path, &def).sentence, "no frame \"b.p\"; look at the new picture");
    assert_int_equal(of_files(place_in(folder, names[1]).path, baseline.path, NULL).verdict, OCTREEL_VERDICT_SAME);
}

static void baseline_allows_no_tolerance(void **state)
{
    const temp_folder *folder = *state;
    const place baseline = place_in(folder, "baseline.txt"), file = place_in(folder, "a.png");
    const octreel_pixels picture = make_picture(0);
    octreel_compare_def def = octreel_compare_def_default();
    save_picture(file.path);
    accept_into(baseline.path, file.path);
    assert_int_equal(to_file(&picture, baseline.path, &def).verdict, OCTREEL_VERDICT_SAME);
    def.max_pixels = 1;
    const octreel_comparison found = to_file(&picture, baseline.path, &def);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_TROUBLE);
    assert_contains(found.sentence, "a baseline holds digests, which allow no tolerance");
}

/* The digests of a baseline are of pictures over its own background. */
static void baseline_decides_the_background(void **state)
{
    const temp_folder *folder = *state;
    const place baseline = place_in(folder, "baseline.txt"), file = place_in(folder, "a.png");
    make_picture(0);
    memset(rgba, 255, 3);
    save_picture(file.path); /* the first pixel is white */
    accept_into(baseline.path, file.path);
    rgba[0] = rgba[3] = 0; /* and is transparent here */
    const octreel_pixels picture = octreel_make_pixels(rgba, WIDTH, HEIGHT, OCTREEL_RGBA8);
    octreel_compare_def def = octreel_compare_def_default();
    def.background = 0x000000;
    assert_int_equal(to_file(&picture, baseline.path, &def).verdict, OCTREEL_VERDICT_SAME);
    assert_int_equal(to_file(&picture, file.path, &def).verdict, OCTREEL_VERDICT_DIFFERENT);
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(missing_file_folder_and_pipe_are_refused),
        IN_FOLDER(truncated_and_other_files_are_refused),
        IN_FOLDER(other_size_is_a_difference),
        IN_FOLDER(every_kind_of_png_is_compared),
        IN_FOLDER(minus_is_a_file_name),
        IN_FOLDER(any_accepted_digest_passes),
        IN_FOLDER(frame_is_chosen_by_name),
        IN_FOLDER(baseline_allows_no_tolerance),
        IN_FOLDER(baseline_decides_the_background),
    };
    unsetenv("CI"); /* accept refuses to work there */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
