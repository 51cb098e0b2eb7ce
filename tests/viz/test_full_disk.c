/* test_full_disk.c - writing that fails at any byte: a sentence that names the file, and nothing half written. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"

/* From a limit that stops the first file to one that stops ticks.jsonl in its last lines, and then index.html, which
 * has more bytes; frames have some 2400. */
static void recording_that_outgrows_the_disk_leaves_only_whole_files(void **state)
{
    static const size_t limits[] = {1,    100,  190,  400,  1500,  2000,  2300, 2420,
                                    3000, 4095, 4096, 4097, 30000, 74000, 90000};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        char name[32];
        snprintf(name, sizeof name, "film%zu", limits[i]);
        const place folder = place_in(*state, name);
        const command_setting full = {.file_limit = limits[i]};
        command_result result = run_octreel(&full, "record --size 160x90 --every 3 -o %s", folder.path);
        assert_non_null(strstr(result.err, folder.path));
        assert_trouble(&result, "File too large");
        assert_nothing_half_written(folder.path);
    }
}

static void recording_that_fits_the_disk_is_done(void **state)
{
    const place folder = place_in(*state, "film");
    const command_setting roomy = {.file_limit = 1000000};
    command_result result = run_octreel(&roomy, "record --size 160x90 --every 3 -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
    assert_nothing_half_written(folder.path);
}

/* Each file of the folder in its turn meets a device that is always full. */
static void each_file_that_cannot_be_written_is_named(void **state)
{
    static const char *const names[] = {"recording.json", "session.json", "renderer.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char part[64];
        const place folder = place_in(*state, names[i]);
        snprintf(part, sizeof part, "%s/%s.part", names[i], names[i]);
        assert_int_equal(mkdir(folder.path, 0777), 0);
        assert_int_equal(symlink("/dev/full", place_in(*state, part).path), 0);
        command_result result = run_octreel(NULL, "record --size 160x90 -o %s", folder.path);
        assert_non_null(strstr(result.err, place_below(folder.path, names[i]).path));
        assert_trouble(&result, "No space left on device");
        assert_false(file_exists(place_in(*state, part).path));
        assert_false(file_exists(place_below(folder.path, "frame_000000.png").path));
    }
}

static void picture_that_cannot_be_written_is_named_and_leaves_nothing(void **state)
{
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    const command_setting full = {.file_limit = 600};
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    command_result result = run_octreel(&full, "inspect %s --size 160x90 -o %s", points.path, picture.path);
    assert_non_null(strstr(result.err, picture.path));
    assert_trouble(&result, "File too large");
    assert_int_equal(temp_folder_count(*state), 1);
}

static void list_of_nodes_that_cannot_be_written_is_named(void **state)
{
    const place points = place_in(*state, "points.txt"), full = place_in(*state, "nodes.csv");
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    assert_int_equal(symlink("/dev/full", full.path), 0); /* so that root cannot harm the device by a rename */
    command_result result = run_octreel(NULL, "inspect %s --nodes %s", points.path, full.path);
    assert_non_null(strstr(result.err, full.path));
    assert_trouble(&result, "No space left on device");
}

static void stdout_that_is_full_is_trouble(void **state)
{
    static const command_setting full = {.output = "/dev/full"};
    static const char *const arguments[] = {"", "--json", "--node root", "--node root --json"};
    const place points = place_in(*state, "points.txt"), folder = place_in(*state, "film");
    file_write_text(points.path, "1 2 3\n4 5 6\n");
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_octreel(&full, "inspect %s %s", points.path, arguments[i]);
        assert_trouble(&result, "cannot be written");
    }
    command_result result = run_octreel(&full, "record --keys=w --size 16x16 -o %s", folder.path);
    assert_trouble(&result, "cannot be written");
}

static void help_and_version_that_cannot_be_written_are_trouble(void **state)
{
    static const command_setting full = {.output = "/dev/full"};
    static const char *const arguments[] = {"--help", "--version", "record --help", "inspect --help"};
    (void)state;
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_octreel(&full, "%s", arguments[i]);
        assert_trouble(&result, "cannot be written");
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(recording_that_outgrows_the_disk_leaves_only_whole_files),
        IN_FOLDER(recording_that_fits_the_disk_is_done),
        IN_FOLDER(each_file_that_cannot_be_written_is_named),
        IN_FOLDER(picture_that_cannot_be_written_is_named_and_leaves_nothing),
        IN_FOLDER(list_of_nodes_that_cannot_be_written_is_named),
        IN_FOLDER(stdout_that_is_full_is_trouble),
        cmocka_unit_test(help_and_version_that_cannot_be_written_are_trouble),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
