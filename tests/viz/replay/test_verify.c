/* SPDX-License-Identifier: MIT */
/* test_verify.c - octreel verify accepts a recording that its session reproduces, finds a changed session or view, and
 * reports what cannot be verified. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "edits.h"
#include "random_session.h"
#include "recordings.h"
#include "verified.h"

/* ---- Identical ---------------------------------------------------------------------------------------------- */

static void recording_is_identical_to_its_replay(void **state)
{
    const place folder = film_short(*state);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
}

static void recordings_with_every_camera_and_anti_aliasing_are_identical(void **state)
{
    const octree_session session = octree_session_default();
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        const place folder = place_in(*state, view_camera_name(kind));
        film_options options = small_film(folder.path);
        options.every = 50;
        options.view.camera = (view_camera)kind;
        options.view.aa = 1 << kind % 3;
        options.view.fit = kind % 2 ? FIT_POINTS : FIT_WORLD;
        options.view.labels = kind % 2;
        assert_filmed(&session, &options);
        assert_identical(&folder, 253, 6);
    }
}

static void session_with_edits_motion_and_queries_is_identical(void **state)
{
    static random_session made;
    const place folder = place_in(*state, "film");
    film_options options = small_film(folder.path);
    options.every = 7;
    random_session_full(&made, 11);
    const film_summary summary = assert_filmed(&made.session, &options);
    assert_identical(&folder, summary.ticks, summary.frames);
}

static void renderer_json_and_page_are_not_needed(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "renderer.json", "\"renderer\": null", "\"renderer\": \"abacus\"");
    remove(place_below(folder.path, "index.html").path);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
    remove(place_below(folder.path, "renderer.json").path);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
}

static void verify_writes_nothing(void **state)
{
    const place folder = film_short(*state), before = place_in(*state, "before");
    assert_int_equal(rename(folder.path, before.path), 0);
    film_short(*state);
    assert_identical(&folder, SHORT_TICKS, SHORT_FRAMES);
    assert_same_folders(before.path, folder.path, NULL);
}

/* ---- Session and view --------------------------------------------------------------------------------------- */

static void session_with_other_keys_is_found_with_the_first_tick_that_differs(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "session.json", "ndwwww", "ndwwdw");
    const verify_report report = verify(&folder);
    assert_int_equal(report.count, 2);
    assert_int_equal(report.findings[0].kind, VERIFY_SESSION);
    assert_false(report.findings[0].has_tick);
    assert_non_null(strstr(report.findings[0].text, "session.json"));
    assert_int_equal(report.findings[1].kind, VERIFY_FACTS);
    assert_string_equal(report.findings[1].fact, "key");
    assert_int_equal(report.findings[1].tick, 5);
    assert_non_null(strstr(report.findings[1].text, "\"w\" in ticks.jsonl, but \"d\""));
}

static void changed_session_with_equal_ticks_is_found(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "session.json", "}", "} ");
    const verify_report report = verify(&folder);
    assert_int_equal(report.count, 1);
    assert_int_equal(report.findings[0].kind, VERIFY_SESSION);
    assert_int_equal(report.ticks, SHORT_TICKS);
    assert_int_equal(report.frames, SHORT_FRAMES);
}

static void longer_or_shorter_session_is_found(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "session.json", "\"ndwwww", "\"ndwwwwwwww");
    verify_report report = verify(&folder);
    assert_int_equal(report.count, 2);
    assert_int_equal(report.findings[0].kind, VERIFY_SESSION);
    edit_file(folder.path, "session.json", "\"ndwwwwwwwwddddnss", "\"nd");
    report = verify(&folder);
    assert_int_equal(report.count, 3);
    assert_int_equal(report.findings[1].kind, VERIFY_LINES);
    assert_int_equal(report.findings[1].tick, 3);
    assert_non_null(strstr(report.findings[1].text, "3 ticks"));
    assert_int_equal(report.findings[2].kind, VERIFY_FRAME);
    assert_int_equal(report.findings[2].tick, 3);
    assert_non_null(strstr(report.findings[2].text, "frame_000003.png"));
}

static void view_of_another_size_is_found_without_drawing(void **state)
{
    static const char *const sizes[][2] = {{"\"size\": [160, 90]", "\"size\": [16384, 90]"},
                                           {"\"size\": [160, 90]", "\"size\": [160, 1]"}};
    for (int i = 0; i < 2; i++) {
        const place folder = film_short(*state);
        edit_file(folder.path, "recording.json", sizes[i][0], sizes[i][1]);
        const verify_report report = assert_found(&folder, VERIFY_VIEW, 0, "but the first frame has 160 x 90");
        assert_string_equal(report.drawn_now, "");
        empty_test_folder(state);
    }
}

static void other_camera_is_reported_as_other_scene(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "recording.json", "\"iso\"", "\"top\"");
    const verify_report report = assert_found(&folder, VERIFY_SCENE, 0, "the digest of its scene");
    assert_string_equal(report.findings[0].fact, "scene");
}

static void change_of_the_frame_interval_is_found(void **state)
{
    const place folder = film_short(*state);
    edit_file(folder.path, "recording.json", "\"every\": 3", "\"every\": 6");
    const verify_report report = verify(&folder);
    assert_int_equal(report.count, 2);
    assert_int_equal(report.findings[0].kind, VERIFY_FACTS);
    assert_string_equal(report.findings[0].fact, "frame");
    assert_int_equal(report.findings[0].tick, 3);
    assert_int_equal(report.findings[1].kind, VERIFY_FRAME);
    assert_non_null(strstr(report.findings[1].text, "frame_000003.png"));
    assert_non_null(strstr(report.findings[1].text, "and neither are other files"));
}

/* ---- Trouble ------------------------------------------------------------------------------------------------ */

static void folder_without_a_recording_is_an_error(void **state)
{
    static const char *const needed[] = {"recording.json", "session.json", "ticks.jsonl"};
    const place nowhere = place_in(*state, "nowhere");
    assert_not_verified(&nowhere, "nowhere/recording.json: cannot be opened");
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
        const place folder = film_short(*state), file = place_below(folder.path, needed[i]);
        remove(file.path);
        assert_not_verified(&folder, needed[i]);
        assert_int_equal(mkfifo(file.path, 0600), 0);
        assert_not_verified(&folder, needed[i]);
        empty_test_folder(state);
    }
}

static void unreadable_or_invalid_session_is_an_error(void **state)
{
    static const struct {
        const char *file, *from, *to, *part;
    } rows[] = {
        {"recording.json", "\"iso\"", "\"isometric\"",
         "camera: expected one of iso, top, front, side, follow, orbit, found \"isometric\""},
        {"recording.json", "\"every\": 3", "\"every\": -1", "every: expected a whole number from 0"},
        {"recording.json", "\"size\": [160, 90]", "\"size\": [16385, 90]",
         "size[0]: expected a whole number from 1 to 16384"},
        {"recording.json", "\"size\": [160, 90]", "\"size\": [1e9, 90]", "size"},
        {"recording.json", "\"version\": 4", "\"version\": 5", "version"},
        {"recording.json", "\"version\": 4", "\"version\": 1", "recording version 1 is not supported"},
        {"recording.json", "\"recording\"", "\"session\"", "\"recording\""},
        {"session.json", "{", "", "session.json:"},
        {"session.json", "\"step\": 50", "\"step\": -50", "step"},
        {"session.json", "\"ndww", "\"nd?w", "keys"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const place folder = film_short(*state);
        edit_file(folder.path, rows[i].file, rows[i].from, rows[i].to);
        assert_not_verified(&folder, rows[i].part);
        empty_test_folder(state);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(recording_is_identical_to_its_replay),
        IN_FOLDER(recordings_with_every_camera_and_anti_aliasing_are_identical),
        IN_FOLDER(session_with_edits_motion_and_queries_is_identical),
        IN_FOLDER(renderer_json_and_page_are_not_needed),
        IN_FOLDER(verify_writes_nothing),
        IN_FOLDER(session_with_other_keys_is_found_with_the_first_tick_that_differs),
        IN_FOLDER(changed_session_with_equal_ticks_is_found),
        IN_FOLDER(longer_or_shorter_session_is_found),
        IN_FOLDER(view_of_another_size_is_found_without_drawing),
        IN_FOLDER(other_camera_is_reported_as_other_scene),
        IN_FOLDER(change_of_the_frame_interval_is_found),
        IN_FOLDER(folder_without_a_recording_is_an_error),
        IN_FOLDER(unreadable_or_invalid_session_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
