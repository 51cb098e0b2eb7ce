/* SPDX-License-Identifier: MIT */
/* test_verify_frames.c - octreel verify finds frames that are missing, torn, exchanged, edited, surplus or drawn by
 * another renderer, and distinguishes them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "edits.h"
#include "images.h"
#include "recordings.h"
#include "ticks_write.h"
#include "verified.h"
#include "png_chunks.h"
#include "image_digest.h"

/* Write a frame with the texts of its scene; `pixels`, unless it is null, replaces the digest of its pixels. */
static void write_with_texts(const char *path, const image *frame, const char *pixels)
{
    static const char *const keywords[] = {"octreel-tick", "octreel-session", "octreel-scene", "octreel-pixels"};
    char values[4][32];
    image_text texts[4];
    octreel_error error;
    for (int i = 0; i < 4; i++) {
        assert_true(image_read_text(path, keywords[i], values[i], sizeof values[i]));
        texts[i] = (image_text){keywords[i], i == 3 && pixels ? pixels : values[i]};
    }
    assert_true(image_write_png(frame, path, texts, 4, &error));
}

static void recompressed_frame_is_identical(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read_rgb(path.path); /* the recorded frame has a palette */
    write_with_texts(path.path, &frame, NULL);
    image_release(&frame);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
}

/* Before version 3 of recordings, Octreel wrote digests of this kind. */
static void frame_with_the_digest_of_an_older_version_is_identical(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read_rgb(path.path);
    char digest[IMAGE_DIGEST_TEXT];
    image_digest_print(IMAGE_DIGEST_RUNS, image_digest_with(IMAGE_DIGEST_RUNS, &frame), digest);
    assert_int_equal(strlen(digest), 16);
    write_with_texts(path.path, &frame, digest);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
    frame.pixels[3 * 77] ^= 128;
    write_with_texts(path.path, &frame, digest);
    assert_found(&folder, VERIFY_FRAME, 3, "its pixels do not match its PNG text octreel-pixels");
    image_digest_print(IMAGE_DIGEST_RUNS, image_digest_with(IMAGE_DIGEST_RUNS, &frame), digest);
    write_with_texts(path.path, &frame, digest);
    assert_found(&folder, VERIFY_PIXELS, 3, "1 pixel from (77, 0) to (77, 0)");
    image_release(&frame);
}

static void frame_with_the_digest_of_a_later_version_is_not_identical(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read(path.path);
    write_with_texts(path.path, &frame, "later-0123456789abcdef");
    image_release(&frame);
    assert_found(&folder, VERIFY_FRAME, 3, "its pixels are correct");
}

static void missing_frame_is_named(void **state)
{
    const place folder = film_short(*state);
    remove(place_below(folder.path, "frame_000009.png").path);
    assert_found(&folder, VERIFY_FRAME, 9, "frame_000009.png is missing");
    remove(place_below(folder.path, "frame_000000.png").path);
    assert_found(&folder, VERIFY_FRAME, 0, "frame_000000.png is missing");
}

static void frame_that_is_a_pipe_is_not_opened(void **state)
{
    static const char *const names[] = {"frame_000003.png", "frame_000000.png"};
    static const uint64_t ticks[] = {3, 0};
    const place folder = film_short(*state);
    for (int i = 0; i < 2; i++) {
        const place frame = place_below(folder.path, names[i]);
        remove(frame.path);
        assert_int_equal(mkfifo(frame.path, 0600), 0);
        assert_found(&folder, VERIFY_FRAME, ticks[i], "is not a regular file");
    }
}

static void frame_without_read_permission_is_an_error(void **state)
{
    const temp_folder *own = *state;
    const place folder = film_short(*state), frame = place_below(folder.path, "frame_000003.png");
    assert_int_equal(chmod(frame.path, 0), 0);
    assert_int_equal(chmod(folder.path, 0755), 0);
    assert_int_equal(chmod(own->name, 0755), 0);
    const bool root = geteuid() == 0;
    if (root && seteuid(65534) != 0)
        skip(); /* root can read everything, and this container has no other user */
    const verify_options options = {.jobs = 1};
    verify_report report;
    octreel_error error = {""};
    const bool verified = verify_recording(folder.path, &options, &report, &error);
    if (root)
        assert_int_equal(seteuid(0), 0);
    assert_false(verified);
    assert_non_null(strstr(error.text, frame.path));
    assert_non_null(strstr(error.text, ": cannot be opened: Permission denied"));
}

static void frame_truncated_to_any_length_is_found(void **state)
{
    const place folder = film_short(*state);
    size_t size;
    free(file_read(place_below(folder.path, "frame_000006.png").path, &size));
    for (size_t length = size - 1; length > 0; length = length * 2 / 3) {
        set_file_size(folder.path, "frame_000006.png", length);
        assert_found(&folder, VERIFY_FRAME, 6, "frame_000006.png: ");
    }
    set_file_size(folder.path, "frame_000006.png", 0);
    assert_found(&folder, VERIFY_FRAME, 6, "frame_000006.png: ");
}

static void frame_with_the_name_of_another_is_found(void **state)
{
    const place folder = film_short(*state);
    file_copy(folder.path, "frame_000003.png", "frame_000012.png");
    assert_found(&folder, VERIFY_FRAME, 12, "is the frame of tick 3");
}

static void frame_of_another_recording_is_found(void **state)
{
    const place folder = film_short(*state), other = place_in(*state, "other");
    octree_session session = octree_session_default();
    film_options options = small_film(other.path);
    session.keys = "sssssssss";
    assert_filmed(&session, &options);
    const place from = place_below(other.path, "frame_000006.png"), to = place_below(folder.path, "frame_000006.png");
    assert_int_equal(rename(from.path, to.path), 0);
    assert_found(&folder, VERIFY_FRAME, 6, "of another session");
}

static void frame_without_text_chunks_is_found(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read_rgb(path.path);
    octreel_error error;
    assert_true(image_write_png(&frame, path.path, NULL, 0, &error));
    assert_found(
        &folder, VERIFY_FRAME, 3,
        "frame_000003.png: has no PNG text octreel-pixels; another program may have saved the file; its pixels are "
        "correct");
    frame.pixels[0] ^= 1;
    assert_true(image_write_png(&frame, path.path, NULL, 0, &error));
    image_release(&frame);
    verify_report report = assert_found(&folder, VERIFY_FRAME, 3, "has no PNG text octreel-pixels");
    assert_null(strstr(report.findings[0].text, "pixels are correct"));
}

/* The pixels are correct, and one text chunk is wrong. */
static void frame_with_a_changed_text_chunk_is_found(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read_rgb(path.path);
    write_with_texts(path.path, &frame, "0123456789abcdef");
    image_release(&frame);
    assert_found(
        &folder, VERIFY_FRAME, 3,
        "its pixels do not match its PNG text octreel-pixels: the file was changed after drawing; its pixels are "
        "correct");
}

static void frame_with_edited_pixels_is_found(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000003.png");
    image frame = assert_read_rgb(path.path);
    frame.pixels[0] ^= 1;
    write_with_texts(path.path, &frame, NULL);
    image_release(&frame);
    assert_found(&folder, VERIFY_FRAME, 3, "its pixels do not match its PNG text octreel-pixels");
}

/* A frame as another renderer would write it: its digest fits its own pixels. */
static void finding_in_pixels_names_both_renderers(void **state)
{
    const place folder = film_short(*state), path = place_below(folder.path, "frame_000006.png");
    image frame = assert_read_rgb(path.path);
    char digest[IMAGE_DIGEST_TEXT];
    frame.pixels[3 * (SMALL_WIDTH * 20 + 10)] ^= 128;
    frame.pixels[3 * (SMALL_WIDTH * 30 + 25) + 2] ^= 1;
    image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&frame), digest);
    write_with_texts(path.path, &frame, digest);
    image_release(&frame);
    verify_report report = assert_found(&folder, VERIFY_PIXELS, 6, "2 pixels from (10, 20) to (25, 30)");
    assert_int_equal(report.pixels, 2);
    assert_non_null(strstr(report.findings[0].text, "filmed by the integer rasterizer; now drawn by "));
    edit_file(folder.path, "renderer.json", "\"renderer\": null", "\"renderer\": \"abacus\"");
    edit_file(folder.path, "renderer.json", "vendor\": null", "vendor\": \"\\u001b[2J\"");
    report = assert_found(&folder, VERIFY_PIXELS, 6, "filmed by ");
    const char *filmed = strstr(report.findings[0].text, "abacus"), *now = strstr(report.findings[0].text, "llvmpipe");
    assert_true(filmed != NULL && now > filmed);
    edit_file(folder.path, "renderer.json", "{", "[");
    assert_found(&folder, VERIFY_PIXELS, 6, "filmed by an unknown renderer");
}

static void surplus_frames_are_found(void **state)
{
    static const struct {
        const char *name;
        bool has_tick;
        uint64_t tick;
    } rows[] = {
        {"frame_000004.png", true, 4}, {"frame_000015.png", true, 15},
        {"frame_3.png", false, 0},     {"frame_000003.png.part", false, 0},
        {"frame_\033[2J", false, 0},   {"frame_99999999999999999999.png", false, 0},
    };
    const place folder = film_short(*state);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        file_copy(folder.path, "frame_000003.png", rows[i].name);
        const verify_report report = verify(&folder);
        assert_int_equal(report.count, 1);
        assert_int_equal(report.findings[0].kind, VERIFY_FRAME);
        assert_int_equal(report.findings[0].has_tick, rows[i].has_tick);
        assert_int_equal(report.findings[0].tick, rows[i].tick);
        assert_null(strchr(report.findings[0].text, '\033'));
        assert_int_equal(report.ticks, SHORT_TICKS);
        remove(place_below(folder.path, rows[i].name).path);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(recompressed_frame_is_identical),
        IN_FOLDER(frame_with_the_digest_of_an_older_version_is_identical),
        IN_FOLDER(frame_with_the_digest_of_a_later_version_is_not_identical),
        IN_FOLDER(missing_frame_is_named),
        IN_FOLDER(frame_that_is_a_pipe_is_not_opened),
        IN_FOLDER(frame_without_read_permission_is_an_error),
        IN_FOLDER(frame_truncated_to_any_length_is_found),
        IN_FOLDER(frame_with_the_name_of_another_is_found),
        IN_FOLDER(frame_of_another_recording_is_found),
        IN_FOLDER(frame_without_text_chunks_is_found),
        IN_FOLDER(frame_of_another_recording_is_found),
        IN_FOLDER(frame_with_a_changed_text_chunk_is_found),
        IN_FOLDER(frame_with_edited_pixels_is_found),
        IN_FOLDER(finding_in_pixels_names_both_renderers),
        IN_FOLDER(surplus_frames_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
