/* SPDX-License-Identifier: MIT */
/* test_file_names.c - paths that are joined from a folder and a name: an empty folder is the current folder, never the
 * root of the file system. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "file.h"

#include <stdlib.h>

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
    assert_true(folder_has("/", "dev"));
    assert_false(folder_has("", "dev"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(path_join_puts_one_slash_between_folder_and_name),
        cmocka_unit_test(an_empty_folder_does_not_name_the_root),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
