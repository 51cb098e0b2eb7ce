/* SPDX-License-Identifier: MIT */
/* test_cli_told_once.c - octreel diff of many frames with one cause: each report names the cause once, and JSON follows
 * its schema. */
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"
#include "tick_lines.h"
#include "xml_check.h"

#include <stdlib.h>
#include <string.h>

/* Two recordings that differ in the leaf capacity, in each of ten frames. */
typedef struct twins {
    place a, b, out;
} twins;

static twins film_twice(void **state)
{
    const twins made = {place_in(*state, "a"), place_in(*state, "b"), place_in(*state, "out")};
    static const char session[] =
        "{\"octreel\": \"session\", \"version\": 2, \"tree\": {\"capacity\": %d, \"depth\": 5}, "
        "\"points\": {\"sample\": \"uniform\", \"count\": 40, \"seed\": 1}, \"keys\": \"wwdds\", \"ticks\": 9}";
    for (int i = 0; i < 2; i++) {
        const place file = place_in(*state, i ? "b.json" : "a.json");
        char text[512];
        snprintf(text, sizeof text, session, i ? 4 : 2);
        file_write_text(file.path, text);
        command_result result =
            run_octreel(NULL, "record %s --size 160x90 -o %s", file.path, i ? made.b.path : made.a.path);
        assert_done(&result);
        command_release(&result);
    }
    return made;
}

static void frames_with_one_cause_are_one_finding_with_one_picture(void **state)
{
    const twins t = film_twice(state);
    command_result result = run_octreel(NULL, "diff %s %s -o %s --markdown %s", t.a.path, t.b.path, t.out.path,
                                        place_in(*state, "out.md").path);
    assert_int_equal(result.status, 1);
    assert_contains(result.out,
                    "different: 10 of 10 frames\nanother leaf capacity (4, was 2): every tick from 0 on differs\n"
                    "  frame_000000.png: ");
    assert_contains(result.out, "\n    and 9 more frames with this finding: ticks 1 to 9\ncompared exactly\n");
    command_release(&result);
    listing names = folder_list(t.out.path);
    assert_int_equal(names.count, 6); /* three pictures, the page, the contact sheet and the marker */
    listing_release(&names);
    char *text = file_read(place_in(*state, "out.md").path, NULL);
    assert_contains(text, "\n| <code>frame_000000.png</code> and 9 more: ticks 1 to 9 | ");
    assert_contains(text, "at a glance <code>contact.png</code>\n");
    free(text);
}

static void each_option_reports_every_frame(void **state)
{
    const twins t = film_twice(state);
    command_result result = run_octreel(NULL, "diff %s %s --each -o %s", t.a.path, t.b.path, t.out.path);
    assert_contains(result.out, "\n  frame_000009.png: ");
    assert_null(strstr(result.out, "with this finding"));
    command_release(&result);
    assert_true(file_exists(place_below(t.out.path, "frame_000009.difference.png").path));
}

/* A frame edited after recording has a finding of its own, even beyond the number of explained frames. */
static void frame_with_another_cause_is_a_finding_of_its_own(void **state)
{
    const twins t = film_twice(state);
    const place frame = place_below(t.b.path, "frame_000007.png");
    command_result result = run_script("cp %s %s", place_below(t.b.path, "frame_000003.png").path, frame.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --causes 1", t.a.path, t.b.path);
    assert_contains(result.out, "\n    and 8 more frames with this finding: ticks 1 to 6, 8, 9\n  frame_000007.png: ");
    command_release(&result);
}

static void junit_lists_each_frame_and_names_the_first_of_a_finding(void **state)
{
    const twins t = film_twice(state);
    command_result result = run_octreel(NULL, "diff %s %s --junit -", t.a.path, t.b.path);
    assert_xml_count(result.out, "testcase", 10);
    assert_xml_count(result.out, "failure", 10);
    assert_xml_attribute_contains(result.out, "failure", 0, "message", ". Alike: ticks 1 to 9");
    assert_xml_attribute(result.out, "failure", 9, "message", "different: like frame_000000.png");
    command_release(&result);
}

/* ---- GitHub -------------------------------------------------------------------------------------------------- */

static void github_gets_one_annotation_at_the_changed_file(void **state)
{
    const twins t = film_twice(state);
    const command_setting actions = {.environment = {"GITHUB_ACTIONS=true"}};
    char begin[2300];
    command_result result = run_octreel(&actions, "diff %s %s --json", t.a.path, t.b.path);
    snprintf(begin, sizeof begin,
             "::error file=%s/frame_000000.png,title=octreel diff%%3A ticks 0 to 9::another leaf capacity (4, was 2): "
             "every tick from 0 on differs. frame_000000.png: ",
             t.b.path);
    assert_true(strncmp(result.err, begin, strlen(begin)) == 0);
    assert_ptr_equal(strchr(result.err, '\n'), result.err + strlen(result.err) - 1);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s", t.a.path, t.b.path);
    assert_string_equal(result.err, "");
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --annotate", t.a.path, t.a.path);
    assert_done(&result);
    command_release(&result);
}

/* No name can end the workflow command or its property. */
static void github_annotations_escape_any_name(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), b = gallery_make(*state, "b", "1.png");
    gallery_write(place_below(b.path, "x,y:z%::\n::warning::\r\x1b[m.png").path, 1, 0);
    command_result result = run_octreel(NULL, "diff %s %s --annotate", a.path, b.path);
    assert_contains(result.err,
                    "/x%2Cy%3Az%25%3A%3A%0A%3A%3Awarning%3A%3A%0D\xef\xbf\xbd[m.png,title=octreel diff%3A ");
    assert_ptr_equal(strchr(result.err, '\n'), result.err + strlen(result.err) - 1);
    assert_null(strpbrk(result.err, "\r\x1b"));
    command_release(&result);
}

static void github_gets_annotations_for_the_first_ten(void **state)
{
    const place a = gallery_make(*state, "a", ""), b = gallery_make(*state, "b", "");
    size_t lines = 0;
    for (int i = 0; i < 13; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.png", i);
        gallery_write(place_below(a.path, name).path, 1, 0);
        gallery_write(place_below(b.path, name).path, 1, i + 1);
    }
    command_result result = run_octreel(NULL, "diff %s %s --annotate", a.path, b.path);
    for (const char *at = result.err; (at = strstr(at, "::error ")); at++)
        lines++;
    assert_int_equal(lines, 10);
    command_release(&result);
}

/* ---- JSON ---------------------------------------------------------------------------------------------------- */

static bool have_python_validator(void)
{
    command_result result = run_script("python3 -c 'import jsonschema' 2>&1");
    const bool there = result.status == 0;
    command_release(&result);
    return there;
}

static void assert_fits(const temp_folder *folder, const char *text)
{
    const place file = place_in(folder, "value.json");
    file_write_text(file.path, text);
    command_result result = run_script("python3 -c 'import json, sys, jsonschema\n"
                                       "schema = json.load(open(sys.argv[1]))\n"
                                       "jsonschema.Draft7Validator.check_schema(schema)\n"
                                       "jsonschema.Draft7Validator(schema).validate(json.load(open(sys.argv[2])))' "
                                       "%s %s 2>&1",
                                       shell_quote(OCTREEL_DIFF_SCHEMA).text, file.path);
    if (result.status != 0)
        fail_msg("%s", result.out);
    command_release(&result);
}

static void assert_json_fits(void **state, const char *a, const char *b, const char *more)
{
    command_result result = run_octreel(NULL, "diff %s %s --json %s", a, b, more);
    assert_true(result.out[0] == '{');
    assert_fits(*state, result.out);
    command_release(&result);
}

static void json_conforms_to_its_schema(void **state)
{
    if (!have_python_validator()) {
        puts("skipped: Python's jsonschema is missing (Debian: python3-jsonschema)");
        skip();
    }
    const twins t = film_twice(state);
    const place a = gallery_make(*state, "old", "1.png 2.png 3.png 4.png"),
                b = gallery_make(*state, "new", "1.png 2.png 3.png 5.png"), digests = place_in(*state, "old.digests");
    char more[2300];
    snprintf(more, sizeof more, "-o %s --causes all", t.out.path);
    assert_json_fits(state, t.a.path, t.b.path, more);
    snprintf(more, sizeof more, "-o %s --flip 0.001 --pixels-per-degree 50", t.out.path);
    assert_json_fits(state, t.a.path, t.b.path, more);
    assert_json_fits(state, t.a.path, t.a.path, "");
    gallery_write(place_below(b.path, "2.png").path, 1, 9);
    file_write_text(place_below(b.path, "3.png").path, "\x89PNG");
    snprintf(more, sizeof more, "-o %s --max-pixels 4 --ignore 1,2,3,4 --ignore-layer text", t.out.path);
    assert_json_fits(state, t.a.path, t.b.path, "--max-pixels 50 --ignore 1,2,3,4 --ignore-layer text --antialias");
    assert_json_fits(state, a.path, b.path, "--max-pixels 9");
    unsetenv("CI");
    command_result result = run_octreel(NULL, "accept %s %s --reason x", digests.path, a.path);
    assert_done(&result);
    command_release(&result);
    snprintf(more, sizeof more, "--store %s", place_in(*state, "store").path);
    assert_json_fits(state, digests.path, b.path, more);
    char *text = file_read(digests.path, NULL), *with_rules = malloc(strlen(text) + 200);
    assert_non_null(with_rules);
    sprintf(with_rules, "%srule * max-pixels=9 date=2026-11-22 expires=2026-12-31 reason=x\n", text);
    file_write_text(digests.path, with_rules);
    assert_json_fits(state, digests.path, b.path, "--today 2026-11-27");
    assert_json_fits(state, digests.path, b.path, "--today 2027-11-27");
    free(with_rules);
    free(text);
}

static void json_lists_each_frame_and_each_group(void **state)
{
    const twins t = film_twice(state);
    command_result result = run_octreel(NULL, "diff %s %s --json", t.a.path, t.b.path);
    json_t *all = json_read(result.out);
    assert_int_equal(json_array_size(json_member(all, "findings")), 10);
    const json_t *groups = json_member(all, "groups"), *group = json_array_get(groups, 0);
    assert_int_equal(json_array_size(groups), 1);
    assert_int_equal(json_array_size(json_member(group, "frames")), 10);
    assert_contains(json_string_value(json_member(group, "cause")), "tick 0: ");
    json_decref(all);
    command_release(&result);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(frames_with_one_cause_are_one_finding_with_one_picture),
        WITH_FOLDER(each_option_reports_every_frame),
        WITH_FOLDER(frame_with_another_cause_is_a_finding_of_its_own),
        WITH_FOLDER(junit_lists_each_frame_and_names_the_first_of_a_finding),
        WITH_FOLDER(github_gets_one_annotation_at_the_changed_file),
        WITH_FOLDER(github_annotations_escape_any_name),
        WITH_FOLDER(github_gets_annotations_for_the_first_ten),
        WITH_FOLDER(json_conforms_to_its_schema),
        WITH_FOLDER(json_lists_each_frame_and_each_group),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
