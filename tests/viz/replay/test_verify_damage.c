/* SPDX-License-Identifier: MIT */
/* test_verify_damage.c - octreel verify finds every changed byte of a recording, and no damage makes it crash. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "recordings.h"
#include "verified.h"

#define FLIPS 24 /* changed bytes in each file */

static place film_tiny(const temp_folder *own)
{
    const place folder = place_in(own, "film");
    octree_session session = octree_session_default();
    session.keys = "nd";
    session.ticks = 0;
    film_options options = small_film(folder.path);
    options.view.width = 64;
    options.view.height = 36;
    assert_filmed(&session, &options);
    return folder;
}

/* Whether verify reports a difference or an error. */
static bool is_noticed(const place *folder)
{
    const verify_options options = {.jobs = 1};
    verify_report report;
    octreel_error error = {""};
    const bool verified = verify_recording(folder->path, &options, &report, &error);
    if (!verified)
        assert_true(strlen(error.text) > 0);
    for (size_t i = 0; verified && i < report.count; i++)
        assert_true(strlen(report.findings[i].text) > 0);
    return !verified || report.count > 0;
}

/* Change single bytes, all over a file and at its ends, each time in another way. */
static void assert_changes(const place *folder, const char *name, bool all_noticed)
{
    static const unsigned char flips[] = {0x01, 0x20, 0x80, 0xff};
    const place file = place_below(folder->path, name);
    size_t size;
    char *bytes = file_read(file.path, &size);
    for (size_t i = 0; i < FLIPS; i++) {
        const size_t at = i * (size - 1) / (FLIPS - 1);
        bytes[at] = (char)((unsigned char)bytes[at] ^ flips[i % 4]);
        file_write(file.path, bytes, size);
        if (!is_noticed(folder) && all_noticed)
            fail_msg("%s: byte %zu was changed, but no difference is reported", name, at);
        bytes[at] = (char)((unsigned char)bytes[at] ^ flips[i % 4]);
    }
    file_write(file.path, bytes, size);
    free(bytes);
    assert_false(is_noticed(folder));
}

static void every_changed_byte_of_a_line_is_found(void **state)
{
    const place folder = film_tiny(*state);
    assert_changes(&folder, "ticks.jsonl", true);
}

static void every_changed_byte_of_the_session_is_found(void **state)
{
    const place folder = film_tiny(*state);
    assert_changes(&folder, "session.json", true);
}

static void every_changed_byte_of_a_frame_is_found(void **state)
{
    const place folder = film_tiny(*state);
    assert_changes(&folder, "frame_000000.png", true);
    assert_changes(&folder, "frame_000002.png", true);
}

/* An additional blank or an empty layer changes no frame, and the renderer is not compared. */
static void no_change_of_the_view_or_renderer_file_does_harm(void **state)
{
    const place folder = film_tiny(*state);
    assert_changes(&folder, "recording.json", false);
    assert_changes(&folder, "renderer.json", false);
}

/* Opening a pipe would wait for ever. */
static void renderer_json_is_read_only_if_it_is_small(void **state)
{
    const place folder = film_tiny(*state), about = place_below(folder.path, "renderer.json");
    enum { LARGE = 1 << 22 };
    char *large = malloc(LARGE);
    assert_non_null(large);
    memset(large, '[', LARGE);
    file_write(about.path, large, LARGE);
    free(large);
    assert_false(is_noticed(&folder));
    assert_int_equal(remove(about.path), 0);
    assert_int_equal(mkfifo(about.path, 0600), 0);
    assert_false(is_noticed(&folder));
}

/* A recording from a stranger must not make octreel read other files, or generate points without end. */
static void session_json_that_names_a_file_of_points_is_refused(void **state)
{
    static const char *const points[] = {"{\"file\": \"../points.xyz\"}",
                                         "{\"sample\": \"uniform\", \"count\": 100000000}"};
    const place folder = film_tiny(*state);
    file_write_text(place_in(*state, "points.xyz").path, "1 2 3\n");
    for (int world = 0; world < 2; world++)
        for (size_t i = 0; i < 2; i++) {
            char text[300];
            snprintf(text, sizeof text, "{\"octreel\": \"session\", \"version\": 2, %s\"points\": %s}\n",
                     world ? "\"world\": {\"min\": [0, 0, 0], \"max\": [9, 9, 9]}, " : "", points[i]);
            file_write_text(place_below(folder.path, "session.json").path, text);
            assert_not_verified(&folder, "the session of a recording must list its points");
        }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_changed_byte_of_a_line_is_found),
        IN_FOLDER(every_changed_byte_of_the_session_is_found),
        IN_FOLDER(every_changed_byte_of_a_frame_is_found),
        IN_FOLDER(no_change_of_the_view_or_renderer_file_does_harm),
        IN_FOLDER(renderer_json_is_read_only_if_it_is_small),
        IN_FOLDER(session_json_that_names_a_file_of_points_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
