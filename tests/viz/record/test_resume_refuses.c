/* SPDX-License-Identifier: MIT */
/* test_resume_refuses.c - octreel record --resume and --ticks do not change unrelated files, files of another session
 * or view, or folders that do not say what was recorded. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "images.h"
#include "recordings.h"

#define SMALL "--size 64x48 --keys wwddeenn"

static void record(const char *arguments, const char *folder)
{
    command_result result = run_octreel(NULL, "record %s -o %s", arguments, folder);
    assert_done(&result);
    command_release(&result);
}

static place recorded(void **state, const char *name)
{
    const place folder = place_in(*state, name);
    record(SMALL, folder.path);
    return folder;
}

static place copy_of(void **state, const char *folder, const char *name)
{
    const place copy = place_in(*state, name);
    copy_folder(folder, copy.path);
    return copy;
}

static void make_folder(const char *path)
{
    command_result result = run_script("mkdir %s", path);
    assert_done(&result);
    command_release(&result);
}

/* The test fails unless the command is refused with this sentence and the folder stays unchanged. */
static void assert_refused(void **state, const char *arguments, const char *folder, const char *sentence)
{
    static int count;
    char name[16];
    snprintf(name, sizeof name, "before%d", count++);
    const place before = copy_of(state, folder, name);
    command_result result = run_octreel(NULL, "record %s -o %s", arguments, folder);
    assert_trouble(&result, sentence);
    assert_same_folders(before.path, folder, NULL);
}

/* ---- Nobody has said what is filmed ------------------------------------------------------------------------- */

static void folder_without_session_or_view_is_not_resumed(void **state)
{
    const place whole = recorded(state, "whole"), empty = place_in(*state, "empty");
    const place blind = copy_of(state, whole.path, "blind"), mute = copy_of(state, whole.path, "mute");
    remove(place_below(blind.path, "recording.json").path);
    assert_refused(state, "--resume", blind.path, "holds no recording that can be resumed: recording.json is missing");
    remove(place_below(mute.path, "session.json").path);
    assert_refused(state, "--resume", mute.path, "holds no recording that can be resumed: session.json is missing");
    make_folder(empty.path);
    assert_refused(state, "--resume --jobs 2", empty.path, "recording.json is missing");
}

static void missing_folder_is_not_resumed(void **state)
{
    const place folder = place_in(*state, "fligth");
    command_result result = run_octreel(NULL, "record --resume -o %s", folder.path);
    assert_trouble(&result, "holds no recording that can be resumed: recording.json is missing");
    assert_false(file_exists(folder.path));
    result = run_script("%s record --resume -o ''", octreel_program());
    assert_trouble(&result, "-o: the name is empty");
}

static void resume_with_the_same_options_continues_a_recording_that_just_began(void **state)
{
    const place whole = recorded(state, "whole"), begun = place_in(*state, "begun");
    make_folder(begun.path);
    file_write_text(place_below(begun.path, "ticks.jsonl").path, "");
    assert_refused(state, "--resume", begun.path, "recording.json is missing");
    record("--resume " SMALL, begun.path);
    assert_same_folders(whole.path, begun.path, NULL);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* The folder does not say which session the frames belong to, whatever the command line says. */
static void frames_without_a_view_or_a_session_are_not_replaced(void **state)
{
    static const char *const names[] = {"recording.json", "session.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char sentence[64];
        const place film = recorded(state, i == 0 ? "viewless" : "sessionless");
        remove(place_below(film.path, names[i]).path);
        snprintf(sentence, sizeof sentence, "%s is missing; choose another folder", names[i]);
        assert_refused(state, "--resume " SMALL, film.path, sentence);
        assert_refused(state, "--ticks 0:2 " SMALL, film.path, sentence);
    }
}

/* The folder of a program that crashed while it recorded itself. */
static void session_in_progress_is_not_replaced_by_another(void **state)
{
    const place whole = recorded(state, "whole"), film = copy_of(state, whole.path, "film");
    const place live = place_below(film.path, "session.json.live");
    assert_int_equal(rename(place_below(film.path, "session.json").path, live.path), 0);
    assert_refused(state, "--resume --size 64x48 --keys wwddeenw", film.path, "session.json.live: is another session");
    record("--resume", film.path);
    assert_same_folders(whole.path, film.path, NULL);
}

static void other_session_is_refused_before_a_file_is_written(void **state)
{
    const place film = recorded(state, "film");
    remove(place_below(film.path, "recording.json").path);
    assert_refused(state, "--resume --size 64x48 --keys wwd", film.path, "session.json: is another session");
}

/* The file has the form that octreel writes: only the frames show the change. */
static void session_edited_after_recording_is_refused(void **state)
{
    const place film = recorded(state, "film"), other = place_in(*state, "other");
    record("--size 64x48 --keys wwddeend", other.path);
    command_result result = run_script("cp %s/session.json %s", other.path, film.path);
    assert_done(&result);
    command_release(&result);
    static const char sentence[] =
        "shows another session than session.json; restore the original session.json, or choose another folder";
    assert_refused(state, "--resume", film.path, sentence);
    assert_refused(state, "--resume --jobs 2", film.path, sentence);
    assert_refused(state, "--ticks 0:2 --size 64x48 --keys wwddeend", film.path, sentence);
}

static void surplus_frame_is_refused(void **state)
{
    static const char *const names[] = {"frame_000300.png", "frame_000009.png", "frame_cover.png"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%zu", i);
        const place film = recorded(state, name);
        file_write_text(place_below(film.path, names[i]).path, "mine");
        assert_refused(state, "--resume", film.path,
                       "not a frame of this recording; remove it, or choose another folder");
    }
}

/* ---- Somebody else's files ---------------------------------------------------------------------------------- */

static void unrelated_files_are_not_replaced(void **state)
{
    static const char *const names[] = {"frame_000000.png", "index.html", "ticks.jsonl", "renderer.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char name[16], sentence[64];
        snprintf(name, sizeof name, "site%zu", i);
        snprintf(sentence, sizeof sentence, "cannot resume: %s is there", names[i]);
        const place site = place_in(*state, name);
        make_folder(site.path);
        file_write_text(place_below(site.path, names[i]).path, "mine");
        assert_refused(state, "--resume " SMALL, site.path, sentence);
        assert_refused(state, "--ticks 0:2 " SMALL, site.path, sentence);
    }
}

static void files_with_similar_names_stay(void **state)
{
    const place film = recorded(state, "film"), mine = place_below(film.path, "index.html.bak");
    file_write_text(mine.path, "mine");
    record("--resume", film.path);
    assert_true(file_exists(mine.path));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(folder_without_session_or_view_is_not_resumed),
        IN_FOLDER(missing_folder_is_not_resumed),
        IN_FOLDER(resume_with_the_same_options_continues_a_recording_that_just_began),
        IN_FOLDER(frames_without_a_view_or_a_session_are_not_replaced),
        IN_FOLDER(session_in_progress_is_not_replaced_by_another),
        IN_FOLDER(other_session_is_refused_before_a_file_is_written),
        IN_FOLDER(session_edited_after_recording_is_refused),
        IN_FOLDER(surplus_frame_is_refused),
        IN_FOLDER(unrelated_files_are_not_replaced),
        IN_FOLDER(files_with_similar_names_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
