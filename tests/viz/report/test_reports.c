/* SPDX-License-Identifier: MIT */
/* test_reports.c - the JUnit and Markdown reports: their contents, and that no file name can break their syntax. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "text.h"
#include "fixture.h"
#include "galleries.h"
#include "png_by_hand.h"
#include "report.h"
#include "xml_check.h"

/* The longest name that breaks what it can: markup, controls, bytes that are no UTF-8, characters that XML lacks. */
#define NASTY "a<b>&\"'`|*]]>\x01\x1b\x7f\n\t\xff\xc3(\xef\xbf\xbe\xc2\x85_\xc3\xa9.png"

/* Both sides, compared; each pair's cause is set by hand, and there is no evidence. */
static comparison_of compare(const char *a, const char *b, const char *cause)
{
    comparison_of made = assert_compared(a, b, NULL);
    for (size_t i = 0; cause && i < made.result.count; i++)
        set_cause(&made, i, cause);
    return made;
}

typedef void reporter(FILE *out, const diff_report *report);

static char *report_text(comparison_of *made, const evidence *e, reporter *write)
{
    const diff_report report = {&made->a, &made->b, &made->result, &made->why, e, LIST_LINES, group_frames(made, true)};
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    write(out, &report);
    assert_int_equal(fclose(out), 0);
    return text;
}

/* Three frames that are the same, differ and cannot be read. */
static comparison_of compare_three(void **state, const char *cause)
{
    static place a, b; /* the sides refer to these paths */
    a = gallery_make(*state, "a", "1.png 2.png 3.png");
    b = gallery_make(*state, "b", "1.png 2.png 3.png");
    gallery_write(place_below(b.path, "2.png").path, 1, 4);
    assert_int_equal(truncate(place_below(b.path, "3.png").path, 99), 0);
    return compare(a.path, b.path, cause);
}

static void junit_has_a_case_for_each_frame(void **state)
{
    comparison_of made = compare_three(state, "node 0/3 split");
    char *xml = report_text(&made, NULL, diff_report_junit);
    assert_xml_count(xml, "testsuites", 1);
    assert_xml_count(xml, "testcase", 3);
    assert_xml_count(xml, "failure", 1);
    assert_xml_count(xml, "error", 1);
    for (int i = 0; i < 2; i++) {
        assert_xml_attribute(xml, i ? "testsuite" : "testsuites", 0, "tests", "3");
        assert_xml_attribute(xml, i ? "testsuite" : "testsuites", 0, "failures", "1");
        assert_xml_attribute(xml, i ? "testsuite" : "testsuites", 0, "errors", "1");
    }
    assert_xml_attribute(xml, "testcase", 1, "name", "2.png");
    assert_xml_attribute(xml, "failure", 0, "type", "pixels");
    assert_xml_attribute(
        xml, "failure", 0, "message",
        "different: 4 of 384 pixels differ; worst 0.0027 YIQ at (0,3), channels by up to 1 of 255; within "
        "(0,3)-(3,3). Cause: node 0/3 split");
    assert_xml_attribute(xml, "error", 0, "type", "unreadable");
    assert_contains(xml,
                    "<system-out>trouble: 1 of 3 frames, 1 cannot be read, 1 with the same bytes\ncompared exactly\n"
                    "    </system-out>\n");
    free(xml);
    comparison_release(&made);
}

static void junit_of_no_difference_has_passed_cases(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png");
    comparison_of made = compare(a.path, a.path, NULL);
    char *xml = report_text(&made, NULL, diff_report_junit);
    assert_xml_count(xml, "testcase", 2);
    assert_xml_count(xml, "failure", 0);
    assert_xml_count(xml, "error", 0);
    assert_xml_attribute(xml, "testsuite", 0, "failures", "0");
    free(xml);
    comparison_release(&made);
}

/* Where two recordings cannot be explained, that is said beside what differs. */
static void reports_say_if_the_cause_is_unknown(void **state)
{
    comparison_of made = compare_three(state, NULL);
    made.why.trouble = strdup("a/session.json: it ends <too> early");
    char *xml = report_text(&made, NULL, diff_report_junit), *text = report_text(&made, NULL, diff_report_markdown);
    assert_xml_count(xml, "system-err", 1);
    assert_contains(xml, "it ends &#60;too&#62; early</system-err>");
    assert_contains(text, "\nThe cause could not be found: a/session.json: it ends &#60;too&#62; early\n");
    free(xml);
    free(text);
    comparison_release(&made);
}

/* A reader of XML gets back what can be said in it, and U+FFFD for what cannot. */
static void junit_escapes_any_name_and_cause(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), b = gallery_make(*state, "b & <c>", "1.png"),
                file = place_in(*state, "report.xml");
    gallery_write(place_below(b.path, NASTY).path, 1, 0);
    comparison_of made = compare(a.path, b.path, "]]></failure> \x02 \"quoted\" & <tag>");
    char *xml = report_text(&made, NULL, diff_report_junit);
    assert_xml_count(xml, "failure", 1);
    assert_xml_attribute(xml, "testcase", 1, "name",
                         "a<b>&\"'`|*]]>\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\n\t\xef\xbf\xbd\xef\xbf\xbd(\xef\xbf\xbd"
                         "\xef\xbf\xbd_\xc3\xa9.png");
    assert_xml_attribute(
        xml, "failure", 0, "message",
        "different: a frame without a reference. Cause: ]]></failure> \xef\xbf\xbd \"quoted\" & <tag>");
    file_write_text(file.path, xml);
    free(xml);
    comparison_release(&made);
}

static void junit_names_the_pictures_of_the_evidence(void **state)
{
    comparison_of made = compare_three(state, NULL);
    const place folder = place_in(*state, "out");
    char part[4096];
    octreel_error error = {""};
    evidence e;
    assert_true(evidence_prepare(folder.path, &made.a, &made.b, &error) &&
                evidence_write_groups(&e, folder.path, &made.result, group_frames(&made, true), &error));
    char *xml = report_text(&made, &e, diff_report_junit);
    assert_xml_count(xml, "system-out", 3);
    snprintf(part, sizeof part, "difference: %s/2.difference.png\n[[ATTACHMENT|%s/2.difference.png]]\n", folder.path,
             folder.path);
    assert_contains(xml, part);
    evidence_release(&e);
    free(xml);
    comparison_release(&made);
}

/* ---- Markdown ------------------------------------------------------------------------------------------------ */

static void markdown_has_the_verdict_and_a_row_for_each_difference(void **state)
{
    comparison_of made = compare_three(state, "node 0/3 split | twice");
    made.why.headline = strdup("From tick 2 on: *another* capacity");
    char *text = report_text(&made, NULL, diff_report_markdown);
    assert_true(strncmp(text, "### octreel diff: trouble: 1 of 3 frames, 1 cannot be read, 1 with the same bytes\n\n",
                        82) == 0);
    assert_contains(text, "\n**From tick 2 on: &#42;another&#42; capacity**\n\n");
    assert_contains(text, ", compared exactly.\n\n| frame | difference | worst | cause |\n|---|---|---|---|\n");
    assert_contains(text,
                    "\n| <code>2.png</code> | 4 of 384 pixels | 0.0027 YIQ at (0,3) | node 0/3 split &#124; twice |\n");
    assert_contains(text, "\n| <code>3.png</code> | cannot be read: ");
    assert_null(strstr(text, "1.png"));
    assert_null(strstr(text, " more"));
    free(text);
    comparison_release(&made);
}

static void markdown_without_causes_has_no_column_for_them(void **state)
{
    comparison_of made = compare_three(state, NULL);
    char *text = report_text(&made, NULL, diff_report_markdown);
    assert_contains(text, "\n| frame | difference | worst |\n|---|---|---|\n");
    assert_contains(text, "\n| <code>2.png</code> | 4 of 384 pixels | 0.0027 YIQ at (0,3) |\n");
    free(text);
    comparison_release(&made);
}

static void markdown_of_no_difference_has_no_table(void **state)
{
    const place a = gallery_make(*state, "a", "1.png");
    comparison_of made = compare(a.path, a.path, NULL);
    char *text = report_text(&made, NULL, diff_report_markdown);
    assert_contains(text, "### octreel diff: same: 1 frame, 1 with the same bytes\n");
    assert_null(strstr(text, "|"));
    free(text);
    comparison_release(&made);
}

static void markdown_lists_the_first_and_counts_the_rest(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), b = gallery_make(*state, "b", "");
    for (int i = 0; i < DIFF_REPORT_ROWS + 3; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.png", i + 1);
        gallery_write(place_below(b.path, name).path, 0, 0);
    }
    comparison_of made = compare(a.path, b.path, NULL);
    char *text = report_text(&made, NULL, diff_report_markdown);
    size_t rows = 0;
    for (const char *at = text; (at = strstr(at, "\n| <code>")); at++)
        rows++;
    assert_int_equal(rows, DIFF_REPORT_ROWS);
    assert_contains(text, "\nand 2 more\n");
    free(text);
    comparison_release(&made);
}

/* One line, and nothing in it that Markdown, a table or HTML would take for its own. */
static void markdown_escapes_any_name(void **state)
{
    char *text;
    size_t size;
    (void)state;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    write_escaped(out, NASTY " _x_ a_b [l](u) ![i] ~~s~~ @you #1 \\| $m$", escape_markdown_character);
    assert_int_equal(fclose(out), 0);
    assert_null(strpbrk(text, "<>`|*[]~@\\$!\"'\n\t\x01\x1b\x7f"));
    assert_contains(text, " &#95;x&#95; a_b &#91;l&#93;(u) ");
    assert_contains(text, "_\xc3\xa9.png");
    free(text);
}

/* Give a picture a gamma. */
static void add_gamma(const char *path)
{
    png_bytes plain, made = {.size = 0};
    png_bytes_load(&plain, path);
    const size_t begin = png_chunk_at(&plain, 8).next;
    png_bytes_put(&made, plain.data, begin);
    png_put_chunk(&made, "gAMA", "\0\1\x86\xa0", 4);
    png_bytes_put(&made, plain.data + begin, plain.size - begin);
    png_bytes_save(&made, made.size, path);
}

static void ignored_gamma_is_reported(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 2.png");
    comparison_of made = compare(a.path, b.path, NULL);
    char *text = report_text(&made, NULL, diff_report_markdown);
    assert_null(strstr(text, "gamma"));
    free(text);
    comparison_release(&made);
    add_gamma(place_below(b.path, "2.png").path);
    made = compare(a.path, b.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    text = report_text(&made, NULL, diff_report_markdown);
    assert_contains(text, "gamma and colour profiles, which differ in 1 frame, are ignored");
    free(text);
    text = report_text(&made, NULL, diff_report_json);
    assert_contains(text, "\"color_spaces_ignored\": 1");
    free(text);
    comparison_release(&made);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(junit_has_a_case_for_each_frame),
        WITH_FOLDER(junit_of_no_difference_has_passed_cases),
        WITH_FOLDER(reports_say_if_the_cause_is_unknown),
        WITH_FOLDER(junit_escapes_any_name_and_cause),
        WITH_FOLDER(junit_names_the_pictures_of_the_evidence),
        WITH_FOLDER(markdown_has_the_verdict_and_a_row_for_each_difference),
        WITH_FOLDER(markdown_without_causes_has_no_column_for_them),
        WITH_FOLDER(markdown_of_no_difference_has_no_table),
        WITH_FOLDER(markdown_lists_the_first_and_counts_the_rest),
        cmocka_unit_test(markdown_escapes_any_name),
        WITH_FOLDER(ignored_gamma_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
