/* SPDX-License-Identifier: MIT */
/* test_cli_evidence.c - octreel diff -o, --junit and --markdown write the files that they promise, and report write
 * errors. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "fixture.h"
#include "galleries.h"
#include "tick_lines.h"
#include "xml_check.h"

/* Two folders with one different frame, and the paths of reports. */
typedef struct twins {
    place a, b, out, xml, markdown;
} twins;

static twins make_twins_of(void **state)
{
    const twins made = {gallery_make(*state, "a", "1.png 2.png"), gallery_make(*state, "b", "1.png 2.png"),
                        place_in(*state, "out"), place_in(*state, "out.xml"), place_in(*state, "out.md")};
    gallery_write(place_below(made.b.path, "2.png").path, 1, 4);
    return made;
}

static void assert_file_says(const char *path, const char *part)
{
    char *text = file_read(path, NULL);
    assert_contains(text, part);
    free(text);
}

static void diff_writes_evidence_and_reports(void **state)
{
    const twins t = make_twins_of(state);
    char part[2048];
    command_result result = run_octreel(NULL, "diff %s %s -o %s --junit %s --markdown %s", t.a.path, t.b.path,
                                        t.out.path, t.xml.path, t.markdown.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    snprintf(part, sizeof part, "\ncompared exactly\nevidence: %s/report.html\n", t.out.path);
    assert_contains(result.out, part);
    command_release(&result);
    assert_true(file_exists(place_below(t.out.path, "2.difference.png").path));
    assert_file_says(place_below(t.out.path, "report.html").path, "\"frame\": \"2.png\", \"finding\": \"pixels\"");
    snprintf(part, sizeof part, "difference: %s/2.difference.png\n", t.out.path);
    assert_file_says(t.xml.path, part);
    snprintf(part, sizeof part, "\nEvidence: <code>%s/report.html</code>, at a glance <code>contact.png</code>\n",
             t.out.path);
    assert_file_says(t.markdown.path, part);
    assert_int_equal(temp_folder_count(*state), 5);
}

static void reports_are_written_if_nothing_differs(void **state)
{
    const twins t = make_twins_of(state);
    command_result result = run_octreel(NULL, "diff %s %s -o %s --junit %s --markdown %s", t.a.path, t.a.path,
                                        t.out.path, t.xml.path, t.markdown.path);
    assert_done(&result);
    command_release(&result);
    char *xml = file_read(t.xml.path, NULL);
    assert_xml_count(xml, "testcase", 2);
    assert_xml_count(xml, "failure", 0);
    free(xml);
    assert_file_says(t.markdown.path, "### octreel diff: same: 2 frames");
    assert_file_says(place_below(t.out.path, "report.html").path, "\"verdict\": \"same\"");
}

/* An unreadable frame is one finding among others: the evidence of the others is written, and the status is 2. */
static void reports_are_written_if_a_frame_is_unreadable(void **state)
{
    const twins t = make_twins_of(state);
    assert_int_equal(truncate(place_below(t.b.path, "1.png").path, 99), 0);
    command_result result =
        run_octreel(NULL, "diff %s %s -o %s --junit %s", t.a.path, t.b.path, t.out.path, t.xml.path);
    assert_int_equal(result.status, 2);
    assert_contains(result.err, "1.png: the file is truncated");
    command_release(&result);
    char *xml = file_read(t.xml.path, NULL);
    assert_xml_count(xml, "error", 1);
    assert_xml_count(xml, "failure", 1);
    free(xml);
    assert_true(file_exists(place_below(t.out.path, "2.difference.png").path));
    assert_true(file_exists(place_below(t.out.path, "1.expected.png").path));
}

static void json_names_the_pictures_of_the_evidence(void **state)
{
    static const char *const words[] = {"expected", "actual", "difference"};
    const twins t = make_twins_of(state);
    command_result result = run_octreel(NULL, "diff %s %s -o %s --json", t.a.path, t.b.path, t.out.path);
    assert_int_equal(result.status, 1);
    json_t *object = json_read(result.out);
    const json_t *whole = json_member(object, "evidence");
    assert_members(whole, "folder page contact_sheet");
    assert_string_equal(json_string_value(json_member(whole, "folder")), t.out.path);
    assert_true(file_exists(json_string_value(json_member(whole, "page"))));
    const json_t *finding = json_array_get(json_member(object, "findings"), 0);
    const json_t *pictures = json_member(finding, "evidence");
    assert_members(pictures, "expected actual difference");
    for (size_t i = 0; i < 3; i++)
        assert_true(file_exists(json_string_value(json_member(pictures, words[i]))));
    json_decref(object);
    command_release(&result);
}

/* Names of the greatest length, which differ only in their last letter. */
static void frames_with_overlong_names_have_evidence(void **state)
{
    const place a = gallery_make(*state, "a", "0.png 1.png"), b = gallery_make(*state, "b", "0.png 1.png");
    const place out = place_in(*state, "out");
    for (int i = 0; i < 2; i++) {
        char name[256], *digit = name + 250;
        memset(name, 'x', 250);
        memcpy(digit, i ? "1.png" : "0.png", sizeof "0.png");
        gallery_write(place_below(b.path, digit).path, 1, 4);
        assert_int_equal(rename(place_below(a.path, digit).path, place_below(a.path, name).path), 0);
        assert_int_equal(rename(place_below(b.path, digit).path, place_below(b.path, name).path), 0);
    }
    for (int again = 0; again < 2; again++) { /* the second run removes what the first one left */
        command_result result = run_octreel(NULL, "diff %s %s -o %s --json", a.path, b.path, out.path);
        assert_int_equal(result.status, 1);
        assert_string_equal(result.err, "");
        json_t *object = json_read(result.out);
        const json_t *findings = json_member(object, "findings");
        assert_int_equal(json_array_size(findings), 2);
        for (size_t i = 0; i < 2; i++) {
            const json_t *pictures = json_member(json_array_get(findings, i), "evidence");
            assert_members(pictures, "expected actual difference");
            assert_true(file_exists(json_string_value(json_member(pictures, "difference"))));
        }
        json_decref(object);
        command_release(&result);
        listing left = folder_list(out.path);
        assert_int_equal(left.count, 9); /* six pictures, the page, the sheet and the marker */
        listing_release(&left);
    }
}

/* One report replaces the text on standard output. */
static void dash_writes_a_report_to_standard_output(void **state)
{
    const twins t = make_twins_of(state);
    command_result result = run_octreel(NULL, "diff %s %s --markdown -", t.a.path, t.b.path);
    assert_int_equal(result.status, 1);
    assert_true(strncmp(result.out, "### octreel diff: different: 1 of 2 frames", 42) == 0);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --junit - --markdown %s", t.a.path, t.b.path, t.markdown.path);
    assert_int_equal(result.status, 1);
    assert_xml_count(result.out, "failure", 1);
    command_release(&result);
    assert_file_says(t.markdown.path, "### octreel diff");
    static const char *const clashes[] = {"--markdown - --json", "--junit - --json", "--junit - --markdown -"};
    for (size_t i = 0; i < sizeof clashes / sizeof clashes[0]; i++) {
        result = run_octreel(NULL, "diff %s %s %s", t.a.path, t.b.path, clashes[i]);
        assert_trouble(&result, "only one output can go to standard output");
    }
}

static void unwritable_output_paths_are_errors(void **state)
{
    const twins t = make_twins_of(state);
    static const char *const options[][2] = {
        {"-o", "a file has this name"}, {"--junit", "Not a directory"}, {"--markdown", "Not a directory"}};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) { /* a path below a file */
        command_result result =
            run_octreel(NULL, "diff %s %s %s %s/1.png/x", t.a.path, t.b.path, options[i][0], t.a.path);
        assert_non_null(strstr(result.err, "/1.png"));
        assert_trouble(&result, options[i][1]);
    }
    command_result result = run_octreel(NULL, "diff %s %s -o %s", t.a.path, t.b.path, t.b.path);
    assert_trouble(&result, "it is compared, and writing evidence would remove it");
    file_write_text(place_below(t.a.path, "notes").path, "mine");
    result = run_octreel(NULL, "diff %s %s -o %s", t.b.path, t.b.path, t.a.path);
    assert_trouble(&result, " but no evidence of octreel diff; choose a new or empty folder");
}

/* The limits stop the first picture, ... and at last the page, the largest file. The error names the file, no part of a
 * file is left, and with room the same command succeeds. */
static void full_disk_is_an_error_and_leaves_only_whole_files(void **state)
{
    static const size_t limits[] = {1, 100, 300, 1000, 1300, 2500, 4000, 20000};
    const twins t = make_twins_of(state);
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        const command_setting full = {.file_limit = limits[i]};
        command_result result =
            run_octreel(&full, "diff %s %s -o %s --junit %s", t.a.path, t.b.path, t.out.path, t.xml.path);
        assert_contains(result.err, place_in(*state, "out").path);
        assert_trouble(&result, "File too large");
        listing there = folder_list(t.out.path);
        for (size_t n = 0; n < there.count; n++)
            assert_null(strstr(there.names[n], ".part"));
        listing_release(&there);
        assert_false(file_exists(place_below(t.out.path, "report.html").path));
    }
    command_result result =
        run_octreel(NULL, "diff %s %s -o %s --junit %s", t.a.path, t.b.path, t.out.path, t.xml.path);
    assert_int_equal(result.status, 1);
    command_release(&result);
}

static void full_standard_output_is_an_error(void **state)
{
    static const command_setting full = {.output = "/dev/full"};
    const twins t = make_twins_of(state);
    command_result result = run_octreel(&full, "diff %s %s --markdown -", t.a.path, t.b.path);
    assert_trouble(&result, "cannot write to standard output");
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(diff_writes_evidence_and_reports),
        WITH_FOLDER(reports_are_written_if_nothing_differs),
        WITH_FOLDER(reports_are_written_if_a_frame_is_unreadable),
        WITH_FOLDER(json_names_the_pictures_of_the_evidence),
        WITH_FOLDER(frames_with_overlong_names_have_evidence),
        WITH_FOLDER(dash_writes_a_report_to_standard_output),
        WITH_FOLDER(unwritable_output_paths_are_errors),
        WITH_FOLDER(full_disk_is_an_error_and_leaves_only_whole_files),
        WITH_FOLDER(full_standard_output_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
