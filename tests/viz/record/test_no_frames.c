/* SPDX-License-Identifier: MIT */
/* test_no_frames.c - recordings without frames consist of ticks and a page, by every way of recording; a page that
 * could not play its session is refused. */
#include <stdlib.h>
#include <string.h>

#include "edits.h"
#include "fixture.h"
#include "folder_files.h"
#include "join.h"
#include "page.h"
#include "played_page.h"
#include "recordings.h"
#include "verified.h"

enum { TICKS = 7 };
#define KEYS "wdnwea" /* TICKS ticks, with tick 0 */

static film_options no_frames(const char *folder)
{
    film_options options = small_film(folder);
    options.every = 0;
    return options;
}

static void no_frames_writes_ticks_and_a_page(void **state)
{
    static const char *const files[] = {"index.html", "recording.json", "session.json", "ticks.jsonl"};
    const place film = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    const film_options options = no_frames(film.path);
    const film_summary summary = assert_filmed(&session, &options);
    listing names = folder_list(film.path);
    assert_int_equal(summary.ticks, TICKS);
    assert_int_equal(summary.frames, 0);
    assert_int_equal(for_each_line(film.path, NULL, NULL), TICKS);
    assert_int_equal(names.count, 4);
    for (size_t i = 0; i < names.count; i++)
        assert_string_equal(names.names[i], files[i]);
    listing_release(&names);
}

static void verify_checks_only_the_ticks(void **state)
{
    const place film = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    const film_options options = no_frames(film.path);
    assert_filmed(&session, &options);
    verify_report report = verify(&film);
    assert_int_equal(report.count, 0);
    assert_int_equal(report.ticks, TICKS);
    assert_false(report.has_frames);
    assert_string_equal(report.drawn_now, "");
    edit_file(film.path, "ticks.jsonl", "\"key\": \"n\"", "\"key\": \".\"");
    file_write_text(place_below(film.path, "frame_000000.png").path, "");
    report = verify(&film);
    assert_int_equal(report.count, 2);
    assert_int_equal(report.findings[0].kind, VERIFY_FACTS);
    assert_int_equal(report.findings[0].tick, 3);
    assert_int_equal(report.findings[1].kind, VERIFY_FRAME);
}

/* The bytes are the same with several jobs, when resumed, and when joined from chunks. */
static void jobs_chunks_and_resume_give_the_same_files(void **state)
{
    const place film = place_in(*state, "film"), jobs = place_in(*state, "jobs"), resumed = place_in(*state, "resumed"),
                chunks = place_in(*state, "chunks");
    const octree_session session = short_session(KEYS);
    film_options options = no_frames(film.path);
    octreel_error error;
    film_summary summary;
    uint64_t left = 3;
    assert_filmed(&session, &options);
    options = no_frames(jobs.path);
    options.jobs = 4;
    assert_filmed(&session, &options);
    assert_same_folders(film.path, jobs.path, NULL);
    options = stopped_after(no_frames(resumed.path), &left);
    assert_int_equal(assert_filmed(&session, &options).ticks, 3);
    options = no_frames(resumed.path);
    options.resume = true;
    assert_filmed(&session, &options);
    assert_same_folders(film.path, resumed.path, NULL);
    for (uint64_t first = 0; first < TICKS; first += 4) {
        options = chunk_of(no_frames(chunks.path), first, first + 4);
        assert_filmed(&session, &options);
    }
    options = no_frames(chunks.path);
    if (!join_chunks(&options, &summary, &error))
        fail_msg("%s", error.text);
    assert_int_equal(summary.ticks, TICKS);
    assert_same_folders(film.path, chunks.path, NULL);
}

static void frames_cannot_be_added_later(void **state)
{
    const place film = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    film_options options = no_frames(film.path);
    film_summary summary;
    octreel_error error;
    assert_filmed(&session, &options);
    options.every = 1;
    options.resume = true;
    assert_false(film_session(&session, &options, &summary, &error));
    assert_non_null(strstr(error.text, "has another view"));
}

/* No file is written if a page could not play the session. */
static void session_too_large_for_a_page_is_refused(void **state)
{
    char *keys = malloc(PAGE_MOST_SESSION + 2), *text;
    size_t size;
    film_summary summary;
    octreel_error error;
    (void)state;
    assert_non_null(keys);
    memset(keys, '.', PAGE_MOST_SESSION + 1);
    keys[PAGE_MOST_SESSION + 1] = '\0';
    const octree_session session = short_session(keys);
    const film_options options = small_film("");
    FILE *page = open_memstream(&text, &size);
    assert_non_null(page);
    assert_false(write_played_page(&session, &options, page, &summary, &error));
    assert_int_equal(fclose(page), 0);
    assert_int_equal(size, 0);
    assert_non_null(strstr(error.text, page_can_play() ? "larger than 134 MB, the most that a page holds"
                                                       : "built without WebAssembly"));
    free(text);
    free(keys);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(no_frames_writes_ticks_and_a_page),
        IN_FOLDER(verify_checks_only_the_ticks),
        IN_FOLDER(jobs_chunks_and_resume_give_the_same_files),
        IN_FOLDER(frames_cannot_be_added_later),
        cmocka_unit_test(session_too_large_for_a_page_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
