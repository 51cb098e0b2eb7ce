/* SPDX-License-Identifier: MIT */
/* test_replace.c - octreel record --replace replaces a recording whole or not at all, and keeps all other files of the
 * folder. */
#include "fixture.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "recordings.h"

#define SMALL "--size 64x48 --jobs 1"
#define ASIDE "octreel-replaced"

static void film(const char *folder, const char *options)
{
    command_result result = run_octreel(NULL, "record " SMALL " %s -o %s", options, folder);
    assert_done(&result);
    command_release(&result);
}

/* A recording of five ticks, a copy of it, and a recording of three ticks that replaces it. */
typedef struct films {
    place old, copy, new;
} films;

static films filmed; /* recorded once for all tests */

static int film_once(void **state)
{
    const int status = temp_folder_make(state);
    filmed.old = place_in(*state, "old");
    filmed.new = place_in(*state, "new");
    film(filmed.old.path, "--keys wwdd");
    film(filmed.new.path, "--keys en");
    return status;
}

static films film_all(void **state)
{
    const films f = {place_in(*state, "old"), place_in(*state, "copy"), place_in(*state, "new")};
    copy_folder(filmed.old.path, f.old.path);
    copy_folder(filmed.old.path, f.copy.path);
    copy_folder(filmed.new.path, f.new.path);
    return f;
}

static void assert_not_replaced(const films *f, const char *part)
{
    command_result result = run_octreel(NULL, "record " SMALL " --keys en --replace -o %s", f->old.path);
    assert_non_null(strstr(result.err, f->old.path));
    assert_trouble(&result, part);
    assert_same_folders(f->old.path, f->copy.path, NULL);
}

static void put(const films *f, const char *name, const char *text)
{
    file_write_text(place_below(f->old.path, name).path, text);
    file_write_text(place_below(f->copy.path, name).path, text);
}

static void replacement_equals_a_recording_into_a_new_folder(void **state)
{
    const films f = film_all(state);
    film(f.old.path, "--keys en --replace");
    assert_same_folders(f.old.path, f.new.path, NULL);
    film(f.old.path, "--keys wwdd --replace --jobs 3");
    assert_same_folders(f.old.path, f.copy.path, NULL);
}

static void other_files_in_the_folder_stay(void **state)
{
    const films f = film_all(state);
    put(&f, "film.mp4", "mine");
    file_write_text(place_below(f.new.path, "film.mp4").path, "mine");
    film(f.old.path, "--keys en --replace");
    assert_same_folders(f.old.path, f.new.path, NULL);
}

static void folder_without_a_recording_is_recorded_into(void **state)
{
    const films f = film_all(state);
    const place fresh = place_in(*state, "fresh/er");
    film(fresh.path, "--keys en --replace");
    assert_same_folders(fresh.path, f.new.path, NULL);
}

static void interrupted_and_outdated_recordings_are_replaced(void **state)
{
    const films f = film_all(state);
    assert_int_equal(remove(place_below(f.old.path, "index.html").path), 0);
    assert_int_equal(remove(place_below(f.old.path, "session.json").path), 0);
    file_write_text(place_below(f.old.path, "session.json.live").path, "{");
    file_write_text(place_below(f.old.path, "frame_000003.png.part").path, "");
    file_write_text(place_below(f.old.path, "recording.json").path,
                    "{\"octreel\": \"recording\", \"version\": 1, \"x\": 1}");
    film(f.old.path, "--keys en --replace");
    assert_same_folders(f.old.path, f.new.path, NULL);
}

static void frames_without_a_recording_stay(void **state)
{
    const films f = film_all(state);
    assert_int_equal(remove(place_below(f.old.path, "recording.json").path), 0);
    assert_int_equal(remove(place_below(f.copy.path, "recording.json").path), 0);
    assert_not_replaced(&f, "recording.json is missing");
    put(&f, "recording.json", "{\"artist\": \"somebody\"}");
    assert_not_replaced(&f, "belongs to another program");
}

static void files_with_similar_names_stay(void **state)
{
    static const char *const names[] = {"frame_notes.txt", "frame_3.png", "frame_notes.part",
                                        "frame_of_a_name_that_no_tick_has_however_late_it_is.png"};
    const films f = film_all(state);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        put(&f, names[i], "mine");
        assert_not_replaced(&f, names[i]);
        assert_int_equal(remove(place_below(f.old.path, names[i]).path), 0);
        assert_int_equal(remove(place_below(f.copy.path, names[i]).path), 0);
    }
}

static void links_and_folders_among_the_files_stay(void **state)
{
    const films f = film_all(state);
    const place mine = place_in(*state, "mine"), link = place_below(f.old.path, "frame_000009.png");
    file_write_text(mine.path, "mine");
    assert_int_equal(symlink(mine.path, link.path), 0);
    command_result result = run_octreel(NULL, "record " SMALL " --keys en --replace -o %s", f.old.path);
    assert_trouble(&result, "frame_000009.png: not a regular file");
    assert_int_equal(remove(link.path), 0);
    assert_int_equal(mkdir(link.path, 0777), 0);
    result = run_octreel(NULL, "record " SMALL " --keys en --replace -o %s", f.old.path);
    assert_trouble(&result, "frame_000009.png: not a regular file");
    assert_int_equal(rmdir(link.path), 0);
    assert_same_folders(f.old.path, f.copy.path, NULL);
}

static void link_to_a_recording_stays_a_link(void **state)
{
    const films f = film_all(state);
    const place latest = place_in(*state, "latest");
    struct stat status;
    assert_int_equal(symlink("old", latest.path), 0);
    film(latest.path, "--keys en --replace");
    assert_true(lstat(latest.path, &status) == 0 && S_ISLNK(status.st_mode));
    assert_same_folders(f.old.path, f.new.path, NULL);
    assert_int_equal(remove(latest.path), 0);
}

static void recording_in_progress_is_not_replaced(void **state)
{
    static const char *const logs[] = {"ticks.jsonl", "ticks_0_5.jsonl"};
    const films f = film_all(state);
    put(&f, logs[1], "");
    for (size_t i = 0; i < 2; i++) {
        const int file = open(place_below(f.old.path, logs[i]).path, O_RDWR);
        assert_true(file >= 0);
        if (flock(file, LOCK_EX | LOCK_NB) != 0)
            skip(); /* a file system without locks */
        assert_not_replaced(&f, "another process is recording into this folder");
        close(file);
    }
}

static void recording_that_another_process_replaces_is_refused(void **state)
{
    const films f = film_all(state);
    const place aside = place_below(f.old.path, ASIDE);
    assert_int_equal(mkdir(aside.path, 0777), 0);
    const int folder = open(aside.path, O_RDONLY | O_DIRECTORY);
    assert_true(folder >= 0);
    if (flock(folder, LOCK_EX | LOCK_NB) != 0)
        skip(); /* a file system without locks */
    command_result result = run_octreel(NULL, "record " SMALL " --keys en --replace -o %s", f.old.path);
    assert_trouble(&result, "another process is replacing the recording");
    close(folder);
    assert_int_equal(rmdir(aside.path), 0);
    assert_same_folders(f.old.path, f.copy.path, NULL);
}

static void refused_replacement_keeps_the_recording(void **state)
{
    const films f = film_all(state);
    const place session = place_in(*state, "bad.json");
    file_write_text(session.path, "{\"octreel\": \"session\", \"version\": 7}");
    command_result result = run_octreel(NULL, "record %s --replace -o %s", session.path, f.old.path);
    assert_trouble(&result, "newer");
    result = run_octreel(NULL, "record --replace --size 99999x1 -o %s", f.old.path);
    assert_trouble(&result, "99999 x 1");
    result = run_octreel(NULL, "record --replace --resume -o %s", f.old.path);
    assert_trouble(&result, "--replace starts a new recording and does not work with --resume");
    result = run_octreel(NULL, "record --replace --ticks 0:2 -o %s", f.old.path);
    assert_trouble(&result, "--replace starts a new recording and does not work with --ticks");
    assert_same_folders(f.old.path, f.copy.path, NULL);
}

/* The disk is full at one file after the other, including the first frame. */
static void failed_first_tick_restores_the_recording(void **state)
{
    const films f = film_all(state);
    for (int jobs = 1; jobs < 3; jobs++) {
        const command_setting full = {.file_limit = jobs == 1 ? 1 : 800};
        command_result result =
            run_octreel(&full, "record --size 64x48 --jobs %d --keys en --replace -o %s", jobs, f.old.path);
        assert_trouble(&result, "File too large");
        assert_same_folders(f.old.path, f.copy.path, NULL);
    }
}

/* Move files of the recording aside, like a process that is killed after this number of files. */
static void set_aside(const place *folder, size_t count)
{
    const place aside = place_below(folder->path, ASIDE);
    const listing names = folder_list(folder->path);
    assert_int_equal(mkdir(aside.path, 0777), 0);
    for (size_t i = 0; i <= names.count; i++) {
        const char *name = i == 0 ? "recording.json" : names.names[i - 1];
        if (i < count && file_exists(place_below(folder->path, name).path))
            assert_int_equal(rename(place_below(folder->path, name).path, place_below(aside.path, name).path), 0);
    }
    listing_release((listing *)&names);
}

/* After a killed replacement the old recording is restored, unless a new one is recorded. */
static void killed_replacement_is_repaired(void **state)
{
    const command_setting full = {.file_limit = 1};
    const films f = film_all(state);
    for (size_t count = 1; count < 20; count += 6) {
        set_aside(&f.old, count);
        if (count > 12)
            file_write_text(place_below(f.old.path, "recording.json.part").path, "{");
        if (count > 18) { /* all files: the new recording has begun */
            file_write_text(place_below(f.old.path, "recording.json").path, "{\"octreel\": \"recording\"}");
            file_write_text(place_below(f.old.path, "frame_000009.png").path, "");
        }
        command_result result = run_octreel(NULL, "record " SMALL " -o %s", f.old.path);
        assert_trouble(&result, "already holds a recording");
        result = run_octreel(&full, "record " SMALL " --keys en --replace -o %s", f.old.path);
        assert_trouble(&result, "File too large");
        assert_same_folders(f.old.path, f.copy.path, NULL);
    }
    set_aside(&f.old, 5);
    film(f.old.path, "--keys en --replace");
    assert_same_folders(f.old.path, f.new.path, NULL);
}

/* The process was killed while it removed the old files: the new recording stays. */
static void remains_of_a_removed_recording_are_removed(void **state)
{
    const command_setting full = {.file_limit = 1};
    const films f = film_all(state);
    const place aside = place_below(f.old.path, ASIDE), rest = place_below(aside.path, "frame_000002.png");
    assert_int_equal(mkdir(aside.path, 0777), 0);
    file_write_text(rest.path, "old");
    command_result result = run_octreel(NULL, "record --resume -o %s", f.old.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(f.old.path, f.copy.path, NULL);
    assert_int_equal(mkdir(aside.path, 0777), 0);
    file_write_text(rest.path, "old");
    result = run_octreel(&full, "record " SMALL " --replace -o %s", f.old.path);
    assert_trouble(&result, "File too large");
    assert_same_folders(f.old.path, f.copy.path, NULL);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(replacement_equals_a_recording_into_a_new_folder),
        TEST(other_files_in_the_folder_stay),
        TEST(folder_without_a_recording_is_recorded_into),
        TEST(interrupted_and_outdated_recordings_are_replaced),
        TEST(frames_without_a_recording_stay),
        TEST(files_with_similar_names_stay),
        TEST(links_and_folders_among_the_files_stay),
        TEST(link_to_a_recording_stays_a_link),
        TEST(recording_in_progress_is_not_replaced),
        TEST(recording_that_another_process_replaces_is_refused),
        TEST(refused_replacement_keeps_the_recording),
        TEST(failed_first_tick_restores_the_recording),
        TEST(killed_replacement_is_repaired),
        TEST(remains_of_a_removed_recording_are_removed),
    };
    return cmocka_run_group_tests(tests, film_once, nested_folder_remove);
}
