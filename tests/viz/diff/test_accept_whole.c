/* SPDX-License-Identifier: MIT */
/* test_accept_whole.c - octreel accept replaces everything or nothing: on a full disk, and for an incomplete recording.
 */
#include "commands.h"
#include "fixture.h"
#include "files.h"
#include "galleries.h"
#include "recordings.h"
#include "png_write.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* CI runs these tests too. */
static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

static place film_into(void **state, const char *name, const char *keys)
{
    const place folder = place_in(*state, name);
    const octree_session session = short_session(keys);
    const film_options options = small_film(folder.path);
    assert_filmed(&session, &options);
    return folder;
}

static place copy_of(void **state, const char *folder, const char *name)
{
    const place copy = place_in(*state, name);
    copy_folder(folder, copy.path);
    return copy;
}

/* ---- A disk that is full -------------------------------------------------------------------------------------- */

enum { ROOM = 3000 }; /* for a small picture */

/* Of three changed pictures the second does not fit. */
static place changed_pictures(void **state)
{
    char comment[2 * ROOM];
    octreel_error error;
    const place made = gallery_make(*state, "new", "1.png 2.png 3.png");
    memset(comment, 'x', sizeof comment - 1);
    comment[sizeof comment - 1] = 0;
    gallery_write(place_below(made.path, "1.png").path, 11, 0);
    gallery_write(place_below(made.path, "3.png").path, 13, 0);
    image picture = gallery_picture(12);
    const image_text text = {"Comment", comment};
    assert_true(image_write_png(&picture, place_below(made.path, "2.png").path, &text, 1, &error));
    image_release(&picture);
    return made;
}

static void assert_no_room(const char *reference, const char *frames, size_t room, const char *sentence)
{
    const command_setting full = {.file_limit = room};
    command_result result = run_octreel(&full, "accept %s %s", reference, frames);
    assert_trouble(&result, sentence);
}

static void full_disk_replaces_no_picture(void **state)
{
    const place frames = changed_pictures(state), golden = gallery_make(*state, "golden", "1.png 2.png 3.png 4.png"),
                before = copy_of(state, golden.path, "before");
    assert_no_room(golden.path, frames.path, ROOM, "golden/2.png: cannot be written: File too large");
    assert_same_folders(before.path, golden.path, NULL);
    command_result result = run_octreel(NULL, "accept %s %s", golden.path, frames.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(frames.path, golden.path, NULL);
}

static void full_disk_makes_no_folder(void **state)
{
    const place frames = changed_pictures(state), golden = place_in(*state, "golden");
    assert_no_room(golden.path, frames.path, ROOM, "golden/2.png: cannot be written: File too large");
    assert_false(file_exists(golden.path));
}

/* Its frames would fit. */
static void full_disk_replaces_no_recording(void **state)
{
    const place golden = film_into(state, "golden", "wwd"), frames = film_into(state, "new", "dss"),
                before = copy_of(state, golden.path, "before");
    assert_no_room(golden.path, frames.path, 40000, "golden/index.html: cannot be written: File too large");
    assert_same_folders(before.path, golden.path, NULL);
}

/* A frame in whose place there is a folder. */
static void temporary_files_are_removed_after_a_failure(void **state)
{
    const place frames = changed_pictures(state), golden = gallery_make(*state, "golden", "1.png 3.png");
    command_result result = run_script("mkdir %s", place_below(golden.path, "2.png").path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s", golden.path, frames.path);
    assert_trouble(&result, "golden/2.png: cannot be written: Is a directory");
    listing left = folder_list(golden.path);
    assert_int_equal(left.count, 3);
    listing_release(&left);
    assert_same_files(place_below(golden.path, "1.png").path, place_below(frames.path, "1.png").path);
}

static void concurrent_accepts_write_whole_files(void **state)
{
    const place frames = changed_pictures(state), golden = place_in(*state, "golden");
    command_result result = run_script("for i in 1 2 3 4 5 6 7 8; do %s accept -q %s %s & done; wait",
                                       octreel_program(), golden.path, frames.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(frames.path, golden.path, NULL);
}

/* ---- A recording that is not whole ---------------------------------------------------------------------------- */

static const char KEYS[] = "wwddeennwwd";

static void assert_not_accepted(void **state, const char *frames, const char *lack)
{
    char sentence[256];
    const place golden = film_into(state, "golden", KEYS), before = copy_of(state, golden.path, "before"),
                baseline = place_in(*state, "baseline.txt");
    snprintf(sentence, sizeof sentence, "%s; refusing to accept a damaged or incomplete recording: ", lack);
    command_result result = run_octreel(NULL, "accept %s %s", golden.path, frames);
    assert_trouble(&result, sentence);
    assert_same_folders(before.path, golden.path, NULL);
    result = run_octreel(NULL, "accept %s %s --reason first", baseline.path, frames);
    assert_trouble(&result, sentence);
    assert_false(file_exists(baseline.path));
}

static void recording_with_a_missing_file_is_refused(void **state)
{
    static const char *const names[] = {"frame_000003.png", "frame_000011.png", "session.json", "ticks.jsonl"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char lack[64];
        const place film = film_into(state, "film", KEYS);
        remove(place_below(film.path, names[i]).path);
        snprintf(lack, sizeof lack, "film: %s is missing", names[i]);
        assert_not_accepted(state, film.path, lack);
        command_result result =
            run_script("rm -r %s %s %s", film.path, place_in(*state, "golden").path, place_in(*state, "before").path);
        assert_done(&result);
        command_release(&result);
    }
}

static void stopped_recording_is_accepted_after_resume(void **state)
{
    const place film = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    uint64_t ticks = 5;
    film_options options = small_film(film.path);
    const film_options stopped = stopped_after(options, &ticks);
    assert_filmed(&session, &stopped);
    assert_not_accepted(state, film.path, "film: frame_000005.png is missing");
    options.resume = true;
    assert_filmed(&session, &options);
    command_result result = run_octreel(NULL, "accept %s %s", place_in(*state, "golden").path, film.path);
    assert_done(&result);
    command_release(&result);
}

/* Of one without frames its lines alone tell. */
static void recording_with_missing_or_surplus_lines_is_refused(void **state)
{
    static const char *const edits[] = {"$d", "$p"}, *const lacks[] = {"has 11 lines for 12", "has 13 lines for 12"};
    for (size_t i = 0; i < 2; i++) {
        const place film = place_in(*state, i == 0 ? "short" : "long"), golden = place_in(*state, "golden");
        const octree_session session = short_session(KEYS);
        film_options options = small_film(film.path);
        options.every = 0;
        assert_filmed(&session, &options);
        command_result result = run_script("sed -i '%s' %s/ticks.jsonl", edits[i], film.path);
        assert_done(&result);
        command_release(&result);
        result = run_octreel(NULL, "accept %s %s", golden.path, film.path);
        assert_trouble(&result, lacks[i]);
        assert_false(file_exists(golden.path));
    }
}

static void recording_of_some_ticks_or_with_gaps_is_accepted(void **state)
{
    const place film = place_in(*state, "film"), session = place_in(*state, "session.json");
    command_result result = run_octreel(NULL, "record --keys wwddeennwwd --every 4 --size 64x48 -o %s", film.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s", place_in(*state, "golden").path, film.path);
    assert_done(&result);
    command_release(&result);
    file_write_text(session.path, "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 4}\n"
                                  "{\"tick\": 2, \"gap\": \"lost\"}\n");
    const place gaps = place_in(*state, "gaps");
    result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, gaps.path);
    assert_done(&result);
    command_release(&result);
    assert_false(file_exists(frame_place(gaps.path, 2).path));
    result = run_octreel(NULL, "accept %s %s", place_in(*state, "other").path, gaps.path);
    assert_done(&result);
    command_release(&result);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(full_disk_replaces_no_picture),
        WITH_FOLDER(full_disk_makes_no_folder),
        WITH_FOLDER(full_disk_replaces_no_recording),
        WITH_FOLDER(temporary_files_are_removed_after_a_failure),
        WITH_FOLDER(concurrent_accepts_write_whole_files),
        WITH_FOLDER(recording_with_a_missing_file_is_refused),
        WITH_FOLDER(stopped_recording_is_accepted_after_resume),
        WITH_FOLDER(recording_with_missing_or_surplus_lines_is_refused),
        WITH_FOLDER(recording_of_some_ticks_or_with_gaps_is_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
