/* SPDX-License-Identifier: MIT */
/* test_full_disk.c - a write that fails at any byte is an error that names the file, and leaves only whole files. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"

#define FILM "record --size 160x90 --every 9"

/* The limits stop the first file, ... then the last lines of ticks.jsonl, and then index.html, which is the largest
 * file; frames have some 2400 bytes. With room again, the same command and --resume complete the recording. */
static void full_disk_leaves_only_whole_files_and_resume_completes_them(void **state)
{
    static const size_t limits[] = {1,    100,  190,  400,  1500,  2000,  2300, 2420,
                                    3000, 4095, 4096, 4097, 30000, 74000, 90000};
    const place whole = place_in(*state, "whole");
    command_result result = run_octreel(NULL, FILM " -o %s", whole.path);
    assert_done(&result);
    command_release(&result);
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        char name[32];
        snprintf(name, sizeof name, "film%zu", limits[i]);
        const place folder = place_in(*state, name);
        const command_setting full = {.file_limit = limits[i]};
        result = run_octreel(&full, FILM " --jobs %d -o %s", (int)(i % 2) + 1, folder.path);
        assert_non_null(strstr(result.err, folder.path));
        assert_trouble(&result, "cannot be written: File too large");
        assert_nothing_half_written(folder.path);
        result = run_octreel(NULL, FILM " --resume -o %s", folder.path);
        assert_done(&result);
        command_release(&result);
        assert_same_folders(whole.path, folder.path, NULL);
    }
}

/* Remove the folder after a few ticks. */
static void take_away(uint64_t done, uint64_t total, void *context)
{
    const char *folder = context;
    (void)total;
    if (done == 5) {
        command_result result = run_script("mv %s %s.gone", folder, folder);
        assert_done(&result);
        command_release(&result);
    }
}

static void error_names_a_folder_that_vanishes(void **state)
{
    const place folder = place_in(*state, "film"), gone = place_in(*state, "film.gone");
    const octree_session session = short_session("wwddeennwwdd");
    film_options options = small_film(folder.path);
    film_summary summary;
    octreel_error error = {""};
    char path[sizeof folder.path];
    snprintf(path, sizeof path, "%s", folder.path);
    options.watch.progress = take_away;
    options.watch.context = path;
    assert_false(film_session(&session, &options, &summary, &error));
    assert_non_null(strstr(error.text, frame_place(folder.path, 5).path));
    assert_non_null(strstr(error.text, "No such file or directory"));
    assert_false(file_exists(folder.path));
    assert_nothing_half_written(gone.path);
    assert_int_equal(for_each_line(gone.path, NULL, NULL), 5);
}

static void recording_that_fits_the_disk_succeeds(void **state)
{
    const place folder = place_in(*state, "film");
    const command_setting roomy = {.file_limit = 1000000};
    command_result result = run_octreel(&roomy, FILM " -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
    assert_nothing_half_written(folder.path);
}

/* A folder has the name of each file of the recording in turn. */
static void error_names_each_unwritable_file(void **state)
{
    static const char *const names[] = {"recording.json", "session.json", "renderer.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char part[64];
        const place folder = place_in(*state, names[i]);
        snprintf(part, sizeof part, "%s/%s.part", names[i], names[i]);
        assert_int_equal(mkdir(folder.path, 0777), 0);
        assert_int_equal(mkdir(place_in(*state, part).path, 0777), 0);
        command_result result = run_octreel(NULL, "record --size 160x90 -o %s", folder.path);
        assert_non_null(strstr(result.err, place_below(folder.path, names[i]).path));
        assert_trouble(&result, "Is a directory");
        assert_false(file_exists(place_below(folder.path, "frame_000000.png").path));
    }
}

static void unwritable_picture_is_named_and_leaves_no_file(void **state)
{
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    const command_setting full = {.file_limit = 600};
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    command_result result = run_octreel(&full, "inspect %s --size 160x90 -o %s", points.path, picture.path);
    assert_non_null(strstr(result.err, picture.path));
    assert_trouble(&result, "File too large");
    assert_int_equal(temp_folder_count(*state), 1);
}

static void unwritable_list_of_nodes_is_named(void **state)
{
    const place points = place_in(*state, "points.txt"), full = place_in(*state, "nodes.csv");
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    assert_int_equal(symlink("/dev/full", full.path),
                     0); /* a link, so that root cannot replace the device by a rename */
    command_result result = run_octreel(NULL, "inspect %s --nodes %s", points.path, full.path);
    assert_non_null(strstr(result.err, full.path));
    assert_trouble(&result, "No space left on device");
}

static void full_standard_output_is_an_error(void **state)
{
    static const command_setting full = {.output = "/dev/full"};
    static const char *const arguments[] = {"", "--json", "--node root", "--node root --json"};
    const place points = place_in(*state, "points.txt"), folder = place_in(*state, "film");
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_octreel(&full, "inspect %s %s", points.path, arguments[i]);
        assert_trouble(&result, "cannot write to standard output");
    }
    command_result result = run_octreel(&full, "record --keys=w --size 16x16 -o %s", folder.path);
    assert_trouble(&result, "cannot write to standard output");
}

static void unwritable_help_and_version_are_errors(void **state)
{
    static const command_setting full = {.output = "/dev/full"};
    static const char *const arguments[] = {"--help", "--version", "record --help", "inspect --help"};
    (void)state;
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_octreel(&full, "%s", arguments[i]);
        assert_trouble(&result, "cannot write to standard output");
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(full_disk_leaves_only_whole_files_and_resume_completes_them),
        IN_FOLDER(error_names_a_folder_that_vanishes),
        IN_FOLDER(recording_that_fits_the_disk_succeeds),
        IN_FOLDER(error_names_each_unwritable_file),
        IN_FOLDER(unwritable_picture_is_named_and_leaves_no_file),
        IN_FOLDER(unwritable_list_of_nodes_is_named),
        IN_FOLDER(full_standard_output_is_an_error),
        cmocka_unit_test(unwritable_help_and_version_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
