/* SPDX-License-Identifier: MIT */
/* report_junit.c - writes a comparison as JUnit XML: see report.h. The output of a failed test case contains a line
 * [[ATTACHMENT|PATH]]. GitLab and Jenkins show the picture at PATH if they find the file. */
#include "diff_words.h"
#include "junit.h"
#include "report.h"
#include "text.h"

#include <stdlib.h>

/* Write `before` unchanged, then `text` with XML escapes. */
static void write_escaped_xml(FILE *out, const char *before, const char *text)
{
    fputs(before, out);
    write_escaped(out, text, escape_xml_character);
}

/* Write why a pair fails. For the first pair of a group, write all details. For the other pairs, write only the name
 * of the first pair. */
static void write_message(FILE *out, const diff_report *report, size_t i)
{
    const diff_pair *pairs = report->result->pairs;
    const frame_group *group = &report->groups->groups[report->groups->of[i]];
    fputs(diff_verdict_name(diff_finding_verdict(pairs[i].finding)), out);
    if (group->first != i) {
        write_escaped_xml(out, ": like ", diff_pair_name(&pairs[group->first]));
        return;
    }
    write_escaped_xml(out, ": ", group->difference);
    if (group->cause)
        write_escaped_xml(out, ". Cause: ", group->cause);
    if (group->count > 1)
        write_escaped_xml(out, ". Alike: ", group->others);
}

/* Write a failure element. The message is written twice, as attribute and as text, because some readers of JUnit XML
 * show only the attribute and others only the text. */
static void write_failure(FILE *out, const diff_report *report, size_t i)
{
    const diff_finding finding = report->result->pairs[i].finding;
    const char *element = diff_finding_verdict(finding) == DIFF_TROUBLE ? "error" : "failure";
    fprintf(out, "      <%s type=\"%s\" message=\"", element, diff_finding_name(finding));
    write_message(out, report, i);
    fputs("\">", out);
    write_message(out, report, i);
    fprintf(out, "</%s>\n", element);
}

static void write_picture_paths(FILE *out, const diff_report *report, size_t i)
{
    fputs("      <system-out>", out);
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *path = evidence_path(report->evidence, report->result, i, (evidence_picture)picture);
        if (path) {
            fprintf(out, "%s: ", evidence_picture_name((evidence_picture)picture));
            write_escaped_xml(out, "", path);
            putc('\n', out);
        }
        if (path && picture == EVIDENCE_DIFFERENCE) {
            write_escaped_xml(out, "[[ATTACHMENT|", path);
            fputs("]]\n", out);
        }
        free(path);
    }
    fputs("      </system-out>\n", out);
}

/* Write the rest of the element of a test case that passes because of a rule. */
static void write_forgiven(FILE *out, const diff_pair *pair)
{
    text_stream s;
    char *text = NULL;
    if (text_stream_begin(&s))
        diff_print_rule(s.stream, pair);
    text_stream_end(&s, &text);
    write_escaped_xml(out, ">\n      <system-out>", text ? text : "out of memory");
    fputs("</system-out>\n    </testcase>\n", out);
    free(text);
}

static void write_case(FILE *out, const diff_report *report, size_t i)
{
    const diff_pair *pair = &report->result->pairs[i];
    junit_begin_case(out, report->b->path, diff_pair_name(pair));
    if (pair->effect == RULE_FORGAVE) {
        write_forgiven(out, pair);
        return;
    }
    if (diff_finding_verdict(pair->finding) == DIFF_SAME) {
        fputs("/>\n", out);
        return;
    }
    fputs(">\n", out);
    write_failure(out, report, i);
    if (report->evidence && report->evidence->pictures[i])
        write_picture_paths(out, report, i);
    fputs("    </testcase>\n", out);
}

/* Write the test case for recordings that have no frames, the only test case of the report: whether the ticks of the
 * recordings are equal. */
static void write_ticks_test_case(FILE *out, const diff_report *report)
{
    const char *headline = report->why->headline ? report->why->headline : "";
    junit_begin_case(out, report->b->path, "ticks.jsonl");
    if (report->result->verdict == DIFF_SAME) {
        fputs("/>\n", out);
        return;
    }
    write_escaped_xml(out, ">\n      <failure type=\"ticks\" message=\"different: ", headline);
    write_escaped_xml(out, "\">different: ", headline);
    fputs("</failure>\n    </testcase>\n", out);
}

/* Write the system-out element, which concerns all test cases: the verdict, the headline and the tolerance. */
static void write_summary(FILE *out, const diff_report *report)
{
    write_escaped_xml(out, "    <system-out>", report->groups->verdict);
    if (report->why->headline) {
        putc('\n', out);
        write_escaped(out, report->why->headline, escape_xml_text);
    }
    write_escaped_xml(out, "\n", report->groups->tolerance);
    fputs("\n    </system-out>\n", out);
    if (report->why->trouble) {
        write_escaped_xml(out, "    <system-err>", report->why->trouble);
        fputs("</system-err>\n", out);
    }
}

void diff_report_junit(FILE *out, const diff_report *report)
{
    const diff_result *result = report->result;
    const bool ticks_differ = result->by_ticks && result->verdict != DIFF_SAME;
    junit_begin(out, "octreel diff", report->a->path, result->count + result->by_ticks,
                diff_count_different(result) + ticks_differ, result->found[FOUND_UNREADABLE]);
    if (result->by_ticks)
        write_ticks_test_case(out, report);
    for (size_t i = 0; i < result->count; i++)
        write_case(out, report, i);
    write_summary(out, report);
    junit_end(out);
}
