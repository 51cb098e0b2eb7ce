/* SPDX-License-Identifier: MIT */
/* test_verify_lines.c - octreel verify finds edited lines of ticks.jsonl and names the fact that differs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edits.h"
#include "verified.h"

static void every_changed_fact_is_named(void **state)
{
    static const struct {
        size_t line;
        const char *from, *to, *fact, *part;
    } rows[] = {
        {2, "\"key\": \"d\"", "\"key\": \"a\"", "key", "\"a\" in ticks.jsonl, but \"d\" when"},
        {2, "\"player\": [50", "\"player\": [51", "player", "player[0] is 51 in ticks.jsonl, but 50"},
        {2, "[\"moved\"", "[\"moved\", \"full\"", "events", "events[1] is \"full\" in ticks.jsonl"},
        {2, "[\"moved\"]", "[]", "events", "events[0] is missing in ticks.jsonl, but \"moved\""},
        {2, "[\"moved\"]", "{\"a\": 1}", "events", "events is {\"a\":1} in ticks.jsonl, but [\"moved\"]"},
        {2, "\"visits\": {", "\"visits\": [], \"v\": {", "visits", "visits is [] in ticks.jsonl, but {"},
        {1, "\"distance\": ", "\"distance\": 1", "answers", ".distance is 1"},
        {0, "\"nodes\": ", "\"nodes\": 9", "hit_cost", "hit_cost.nodes is 9"},
        {2, "\"visited\": ", "\"visited\": 9", "visits", "visits.visited is 9"},
        {0, "\"tree\": {\"points\": ", "\"tree\": {\"points\": 9", "tree", "tree.points is 9"},
        {0, "\"digest\": \"", "\"digest\": \"0", "tree", "tree.digest"},
        {3, "frame_000003", "frame_000004", "frame", "frame_000004"},
        {4, "\"merges\": []", "\"merges\": [], \"more\": [1, 2]", "more", "more is [1,2] in ticks.jsonl, but missing"},
        {4, "\"merges\": [], ", "", "merges", "merges is missing in ticks.jsonl, but []"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const place folder = film_short(*state);
        edit_line(folder.path, rows[i].line, rows[i].from, rows[i].to);
        const verify_report report = assert_found(&folder, VERIFY_FACTS, rows[i].line, rows[i].part);
        assert_string_equal(report.findings[0].fact, rows[i].fact);
        empty_test_folder(state);
    }
}

static void changed_scene_digest_is_distinguished_from_facts(void **state)
{
    const place folder = film_short(*state);
    edit_line(folder.path, 6, "\"scene\": \"", "\"scene\": \"0");
    assert_found(&folder, VERIFY_SCENE, 6, "the digest of its scene is \"0");
}

static void first_of_several_changes_is_reported(void **state)
{
    const place folder = film_short(*state);
    edit_line(folder.path, 9, "\"player\"", "\"prayer\"");
    edit_line(folder.path, 4, "\"attempt\"", "\"tempt\"");
    edit_line(folder.path, 4, "\"merges\"", "\"urges\"");
    assert_found(&folder, VERIFY_FACTS, 4, "attempt is missing");
}

static void malformed_lines_are_found(void **state)
{
    static const struct {
        const char *text, *part;
    } rows[] = {
        {"hello\n", "not JSON"},
        {"\n", "not JSON"},
        {"7\n", "not JSON"},
        {"[]\n", "not a JSON object"},
        {"{}\n", "tick is missing"},
        {"{\"tick\": 5\n", "not JSON"},
        {"{\"tick\": 5, \"tick\": 5}\n", "not JSON"},
        {"{\"tick\": 1e400}\n", "not JSON"},
        {"{\"tick\": \"\\u001b[2J\"}\n", "tick is \"\\u001B[2J\" in"},
        {"", "has the line of tick 6 where the line of tick 5 belongs"},
        {"{\"tick\": -7}\n", "tick is -7 in ticks.jsonl, but 5"},
        {"{\"tick\": 7}\n", "has the line of tick 7 where the line of tick 5 belongs"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const place folder = film_short(*state);
        replace_line(folder.path, 5, rows[i].text);
        assert_found(&folder, strstr(rows[i].part, "tick is") ? VERIFY_FACTS : VERIFY_LINES, 5, rows[i].part);
        empty_test_folder(state);
    }
}

static void line_with_other_formatting_is_found(void **state)
{
    const place folder = film_short(*state);
    edit_line(folder.path, 5, "{", "{ ");
    assert_found(&folder, VERIFY_LINES, 5, "has the same values");
}

static void overlong_line_is_found_without_reading_all_of_it(void **state)
{
    const place folder = film_short(*state);
    char *endless = malloc(2000001);
    assert_non_null(endless);
    memset(endless, 'x', 2000000);
    endless[2000000] = '\0';
    replace_line(folder.path, 5, endless);
    free(endless);
    assert_found(&folder, VERIFY_LINES, 5, "is longer than it should be");
}

static void missing_torn_and_surplus_lines_are_found(void **state)
{
    const place folder = film_short(*state), lines = place_below(folder.path, "ticks.jsonl");
    char *last = copy_line(folder.path, SHORT_TICKS - 1);
    replace_line(folder.path, SHORT_TICKS - 1, "");
    assert_found(&folder, VERIFY_LINES, SHORT_TICKS - 1, "1 of its 14 lines are missing; octreel record --resume");
    for (size_t cut = 1; cut < strlen(last); cut += 40) {
        size_t size;
        char *text = file_read(lines.path, &size);
        FILE *file = fopen(lines.path, "ab");
        assert_non_null(file);
        fwrite(last, 1, strlen(last) - cut, file);
        assert_int_equal(fclose(file), 0);
        assert_found(&folder, VERIFY_LINES, SHORT_TICKS - 1, "is incomplete");
        file_write(lines.path, text, size);
        free(text);
    }
    char twice[8192];
    char *before = copy_line(folder.path, SHORT_TICKS - 2);
    snprintf(twice, sizeof twice, "%s%s%s", before, last, last);
    replace_line(folder.path, SHORT_TICKS - 2, twice);
    assert_found(&folder, VERIFY_LINES, SHORT_TICKS, "beyond the session, which has 14 ticks");
    free(before);
    free(last);
    set_file_size(folder.path, "ticks.jsonl", 0);
    assert_found(&folder, VERIFY_LINES, 0, "14 of its 14 lines are missing");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_changed_fact_is_named),
        IN_FOLDER(changed_scene_digest_is_distinguished_from_facts),
        IN_FOLDER(first_of_several_changes_is_reported),
        IN_FOLDER(malformed_lines_are_found),
        IN_FOLDER(line_with_other_formatting_is_found),
        IN_FOLDER(overlong_line_is_found_without_reading_all_of_it),
        IN_FOLDER(missing_torn_and_surplus_lines_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
