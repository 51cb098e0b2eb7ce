/* SPDX-License-Identifier: MIT */
/* test_hint.c - the name that was meant, and commands that can be copied. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "hint.h"

static const char *const names[] = {"record", "verify", "diff", "color-by", "size", "visited", "visit-heat", "replace"};

static const char *meant_by(const char *word)
{
    hint h = hint_create(word, strlen(word));
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        hint_add_candidate(&h, names[i]);
    return h.name;
}

static void a_slip_of_the_finger_is_understood(void **state)
{
    static const char *const rows[][2] = {
        {"recrod", "record"}, {"recor", "record"},     {"reccord", "record"},     {"rexord", "record"},
        {"RECORD", "record"}, {"dif", "diff"},         {"colour-by", "color-by"}, {"colorby", "color-by"},
        {"isze", "size"},     {"visited-", "visited"}, {"visit", "visited"},      {"visit-hea", "visit-heat"},
        {"compare", "diff"},  {"force", "replace"},    {"Overwrite", "replace"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *meant = meant_by(rows[i][0]);
        if (!meant || strcmp(meant, rows[i][1]) != 0)
            fail_msg("%s is taken for %s", rows[i][0], meant ? meant : "nothing");
    }
}

static void what_is_far_from_all_names_is_not_guessed(void **state)
{
    static const char *const words[] = {
        "",     "x",         "-",
        "r",    "banana",    "di",
        "dxxf", "recommend", "a word that is longer than all names that there are in any table"};
    (void)state;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (meant_by(words[i]))
            fail_msg("\"%s\" is taken for %s", words[i], meant_by(words[i]));
}

/* The caller frees it. */
static char *written(void (*write)(FILE *out, const char *text), const char *text)
{
    char *bytes;
    size_t size;
    FILE *out = open_memstream(&bytes, &size);
    assert_non_null(out);
    write(out, text);
    assert_int_equal(fclose(out), 0);
    return bytes;
}

static void assert_written(void (*write)(FILE *out, const char *text), const char *text, const char *expected)
{
    char *bytes = written(write, text);
    assert_string_equal(bytes, expected);
    free(bytes);
}

static void commands_name_the_program_as_it_was_called(void **state)
{
    static const char text[] = "octreel record, \"octreel-digests 1\", octreel - a tree; octreel diff as octreel join";
    (void)state;
    assert_written(hint_write_commands, text, text);
    hint_set_program("");
    hint_set_program(NULL);
    assert_string_equal(hint_program_name(), "octreel");
    hint_set_program("build/bin/octreel");
    assert_written(
        hint_write_commands, text,
        "build/bin/octreel record, \"octreel-digests 1\", octreel - a tree; build/bin/octreel diff as octreel join");
    assert_written(hint_write_commands, " octreel verify\noctreel diff;octreel join (octreel pick",
                   " build/bin/octreel verify\nbuild/bin/octreel diff;octreel join (octreel pick");
    hint_set_program("./my tree's/octreel");
    assert_written(hint_write_commands, "octreel record", "'./my tree'\\''s/octreel' record");
}

static void a_word_is_one_word_for_a_shell(void **state)
{
    static const char *const rows[][2] = {{"", "''"},
                                          {"a-b/c.png", "a-b/c.png"},
                                          {"-x", "'./-x'"},
                                          {"a b", "'a b'"},
                                          {"it's $HOME", "'it'\\''s $HOME'"},
                                          {"a\x1b[1m\n", "'a'$'\\033''[1m'$'\\012'''"},
                                          {"a\x7f", "'a'$'\\177'''"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_written(hint_write_shell_word, rows[i][0], rows[i][1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slip_of_the_finger_is_understood),
        cmocka_unit_test(what_is_far_from_all_names_is_not_guessed),
        cmocka_unit_test(commands_name_the_program_as_it_was_called),
        cmocka_unit_test(a_word_is_one_word_for_a_shell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
