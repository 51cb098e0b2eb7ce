/* SPDX-License-Identifier: MIT */
/* test_file_names.c - paths that are joined from a folder and a name: an empty folder is the current folder, never the
 * root of the file system. The names in a folder are listed in order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "file.h"
#include "files.h"
#include "temp_folder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static void assert_joined(const char *folder, const char *name, const char *expected)
{
    char *path = path_join(folder, name);
    assert_non_null(path);
    assert_string_equal(path, expected);
    free(path);
}

static void path_join_puts_one_slash_between_folder_and_name(void **state)
{
    (void)state;
    assert_joined("frames", "ticks.jsonl", "frames/ticks.jsonl");
    assert_joined("/", "ticks.jsonl", "//ticks.jsonl");
    assert_joined("", "ticks.jsonl", "ticks.jsonl");
}

static void an_empty_folder_does_not_name_the_root(void **state)
{
    (void)state;
    assert_true(folder_contains("/", "dev"));
    assert_false(folder_contains("", "dev"));
}

static void folder_list_has_all_names_in_order(void **state)
{
    static const char *const names[] = {".hidden", "10", "9", "a", "b"}, *const made[] = {"b", "9", ".hidden", "a",
                                                                                          "10"};
    octreel_error error = {""};
    for (size_t i = 0; i < 5; i++)
        file_write_text(place_in(*state, made[i]).path, "");
    char **found = folder_names(place_in(*state, "").path, &error);
    assert_non_null(found);
    for (size_t i = 0; i < 5; i++)
        assert_string_equal(found[i], names[i]);
    assert_null(found[5]);
    free(found);
    assert_null(folder_names(place_in(*state, "absent").path, &error));
    assert_int_equal(errno, ENOENT);
    assert_non_null(strstr(error.text, "absent: the folder cannot be read: "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(path_join_puts_one_slash_between_folder_and_name),
        cmocka_unit_test(an_empty_folder_does_not_name_the_root),
        cmocka_unit_test_setup_teardown(folder_list_has_all_names_in_order, temp_folder_make, temp_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
