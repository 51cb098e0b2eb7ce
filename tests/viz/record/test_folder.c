/* SPDX-License-Identifier: MIT */
/* test_folder.c - the folder of a recording is made with its parents, refused unchanged, or filled with whole files. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files.h"
#include "fixture.h"
#include "folder.h"

/* A user without any permissions, for tests that run as root, to whom no permission applies. */
enum { NOBODY = 65534 };

static void assert_prepared(const char *folder)
{
    octreel_error error = {""};
    if (!folder_create_for_recording(folder, &error))
        fail_msg("%s", error.text);
}

/* The test fails unless the folder is refused with a sentence that names it and contains the reason. */
static void assert_unprepared(const char *folder, const char *reason)
{
    octreel_error error = {""};
    assert_false(folder_create_for_recording(folder, &error));
    if (strstr(error.text, folder) == NULL || strstr(error.text, reason) == NULL)
        fail_msg("\"%s\" does not contain both %s and \"%s\"", error.text, folder, reason);
}

static void new_folders_are_made_with_their_parents(void **state)
{
    static const char *const names[] = {"a", "b/c/d/e", "f/", "g//h///i", "b/c/x", "./j/../k"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        struct stat status;
        const place folder = place_in(*state, names[i]);
        if (strcmp(names[i], "./j/../k") == 0)
            assert_int_equal(mkdir(place_in(*state, "j").path, 0777), 0);
        assert_prepared(folder.path);
        assert_int_equal(stat(folder.path, &status), 0);
        assert_true(S_ISDIR(status.st_mode));
    }
}

static void absolute_folders_are_made(void **state)
{
    char current[512], absolute[1024];
    const temp_folder *folder = *state;
    assert_non_null(getcwd(current, sizeof current));
    snprintf(absolute, sizeof absolute, "%s/%s/x/y", current, folder->name);
    assert_prepared(absolute);
    assert_true(file_exists(place_in(folder, "x/y").path));
}

static void empty_and_unrelated_folders_are_accepted(void **state)
{
    const place folder = place_in(*state, "film");
    assert_int_equal(mkdir(folder.path, 0777), 0);
    assert_prepared(folder.path);
    file_write_text(place_below(folder.path, "notes.txt").path, "mine");
    file_write_text(place_below(folder.path, ".hidden").path, "mine");
    assert_prepared(folder.path);
}

static void link_to_a_folder_is_a_folder(void **state)
{
    assert_int_equal(mkdir(place_in(*state, "film").path, 0777), 0);
    assert_int_equal(symlink("film", place_in(*state, "link").path), 0);
    assert_prepared(place_in(*state, "link").path);
    assert_int_equal(symlink("nowhere", place_in(*state, "dangling").path), 0);
    assert_unprepared(place_in(*state, "dangling").path, "cannot create the folder");
}

/* A file that a recording would overwrite may be the only copy of a user's work. */
static void folder_with_any_file_of_a_recording_is_refused_and_unchanged(void **state)
{
    static const char *const names[] = {"frame_000000.png", "frame_000252.png", "frame_1000000.png", "ticks.jsonl",
                                        "recording.json",   "session.json",     "renderer.json",     "index.html"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char name[32];
        snprintf(name, sizeof name, "film%zu", i);
        const place folder = place_in(*state, name), file = place_below(folder.path, names[i]);
        assert_int_equal(mkdir(folder.path, 0777), 0);
        file_write_text(file.path, "mine");
        assert_unprepared(folder.path, strcmp(names[i], "recording.json") == 0 ? "--replace" : names[i]);
        listing left = folder_list(folder.path);
        assert_int_equal(left.count, 1);
        listing_release(&left);
        char *text = file_read(file.path, NULL);
        assert_string_equal(text, "mine");
        free(text);
    }
}

static void file_with_the_name_of_the_folder_is_refused(void **state)
{
    const place file = place_in(*state, "file");
    file_write_text(file.path, "mine");
    assert_unprepared(file.path, "cannot create the folder");
    octreel_error error = {""};
    assert_false(folder_create_for_recording(place_below(file.path, "x/y").path, &error));
    assert_non_null(strstr(error.text, file.path));
    char *text = file_read(file.path, NULL);
    assert_string_equal(text, "mine");
    free(text);
}

static void empty_name_and_folder_that_cannot_be_made_are_refused(void **state)
{
    octreel_error error = {""};
    (void)state;
    assert_false(folder_create_for_recording("", &error));
    assert_non_null(strstr(error.text, "empty"));
    assert_unprepared("/proc/no_such_folder", "cannot create the folder");
}

static void folder_without_permission_is_refused_with_the_reason(void **state)
{
    const temp_folder *own = *state;
    const place sealed = place_in(own, "sealed"), film = place_in(own, "sealed/film");
    assert_int_equal(mkdir(sealed.path, 0777), 0);
    assert_int_equal(chmod(sealed.path, 0555), 0);
    assert_int_equal(chmod(own->name, 0755), 0);
    const bool root = geteuid() == 0;
    if (root && seteuid(NOBODY) != 0)
        skip(); /* root can write everything, and this container has no other user */
    octreel_error error = {""};
    const bool prepared = folder_create_for_recording(film.path, &error);
    if (root)
        assert_int_equal(seteuid(0), 0);
    assert_false(prepared);
    assert_non_null(strstr(error.text, film.path));
    if (strstr(error.text, "Permission denied") == NULL)
        fail_msg("\"%s\" hides the reason", error.text);
    assert_int_equal(chmod(sealed.path, 0755), 0);
}

static void reason_is_not_cut_after_a_long_path(void **state)
{
    char name[3 * 201 + 8] = "";
    octreel_error error = {""};
    for (size_t i = 0; i < 3; i++) {
        memset(name + i * 201, 'd', 200);
        name[i * 201 + 200] = '/';
    }
    strcpy(name + 3 * 201, "film");
    const place folder = place_in(*state, name);
    assert_prepared(folder.path);
    file_write_text(place_below(folder.path, "ticks.jsonl").path, "");
    assert_false(folder_create_for_recording(folder.path, &error));
    if (strstr(error.text, "already holds ticks.jsonl") == NULL)
        fail_msg("\"%s\" has no reason", error.text);
}

static void assert_written(const char *folder, const char *name, const char *text)
{
    octreel_error error = {""};
    if (!folder_write_file(folder, name, text, strlen(text), &error))
        fail_msg("%s", error.text);
    size_t size;
    char *back = file_read(place_below(folder, name).path, &size);
    assert_int_equal(size, strlen(text));
    assert_string_equal(back, text);
    free(back);
}

/* mkdir() notices that a path is too long only after its parents were created. */
static void folder_with_too_long_a_path_is_refused_before_any_is_made(void **state)
{
    enum { LONGEST = 4095 - 256 }; /* PATH_MAX without its zero, a slash and a file name */
    static char path[PATH_MAX + 300];
    octreel_error error = {""};
    const temp_folder *folder = *state;
    const int start = snprintf(path, sizeof path, "%s/", folder->name);
    for (int at = start; at < LONGEST; at++)
        path[at] = (at - start) % 100 == 99 ? '/' : 'x';
    strcpy(path + LONGEST, "y");
    assert_false(folder_create(path, &error));
    assert_contains(error.text, "cannot create the folder: its path has 3840 bytes, but at most 3839 are possible");
    assert_int_equal(temp_folder_count(folder), 0);
}

static void folder_with_too_long_a_name_is_refused_before_its_parents_are_made(void **state)
{
    char path[600];
    octreel_error error = {""};
    const temp_folder *folder = *state;
    const int start = snprintf(path, sizeof path, "%s/a/b/", folder->name);
    memset(path + start, 'x', NAME_MAX + 1);
    strcpy(path + start + NAME_MAX + 1, "/c");
    assert_false(folder_create(path, &error));
    assert_contains(error.text, ": cannot create the folder: a name in its path is longer than 255 bytes");
    assert_int_equal(temp_folder_count(folder), 0);
}

static void files_are_written_and_replaced_whole(void **state)
{
    const temp_folder *folder = *state;
    assert_written(folder->name, "x.json", "first, and longer than what follows");
    assert_written(folder->name, "x.json", "second");
    assert_written(folder->name, "empty", "");
    assert_int_equal(temp_folder_count(folder), 2);
}

/* Writing may fail as late as when the file is closed. */
static void unwritable_file_leaves_the_old_file_and_no_part(void **state)
{
    const temp_folder *folder = *state;
    octreel_error error = {""};
    assert_written(folder->name, "x.json", "mine");
    limit_file_size(3);
    assert_false(folder_write_file(folder->name, "x.json", "second", 6, &error));
    limit_file_size(SIZE_MAX);
    assert_non_null(strstr(error.text, "x.json"));
    assert_non_null(strstr(error.text, "File too large"));
    char *text = file_read(place_in(folder, "x.json").path, NULL);
    assert_string_equal(text, "mine");
    free(text);
    assert_int_equal(temp_folder_count(folder), 1);
}

static void file_without_its_folder_is_an_error(void **state)
{
    octreel_error error = {""};
    const place nowhere = place_in(*state, "nowhere");
    assert_false(folder_write_file(nowhere.path, "x.json", "a", 1, &error));
    assert_non_null(strstr(error.text, nowhere.path));
    assert_non_null(strstr(error.text, "No such file or directory"));
}

static void folder_with_the_name_of_a_file_is_an_error_and_leaves_no_part(void **state)
{
    const temp_folder *folder = *state;
    octreel_error error = {""};
    assert_int_equal(mkdir(place_in(folder, "x.json").path, 0777), 0);
    assert_false(folder_write_file(folder->name, "x.json", "a", 1, &error));
    assert_non_null(strstr(error.text, "x.json"));
    assert_int_equal(temp_folder_count(folder), 1);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(new_folders_are_made_with_their_parents),
        IN_FOLDER(absolute_folders_are_made),
        IN_FOLDER(empty_and_unrelated_folders_are_accepted),
        IN_FOLDER(link_to_a_folder_is_a_folder),
        IN_FOLDER(folder_with_any_file_of_a_recording_is_refused_and_unchanged),
        IN_FOLDER(file_with_the_name_of_the_folder_is_refused),
        IN_FOLDER(empty_name_and_folder_that_cannot_be_made_are_refused),
        IN_FOLDER(folder_without_permission_is_refused_with_the_reason),
        IN_FOLDER(reason_is_not_cut_after_a_long_path),
        IN_FOLDER(folder_with_too_long_a_path_is_refused_before_any_is_made),
        IN_FOLDER(folder_with_too_long_a_name_is_refused_before_its_parents_are_made),
        IN_FOLDER(files_are_written_and_replaced_whole),
        IN_FOLDER(unwritable_file_leaves_the_old_file_and_no_part),
        IN_FOLDER(file_without_its_folder_is_an_error),
        IN_FOLDER(folder_with_the_name_of_a_file_is_an_error_and_leaves_no_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
