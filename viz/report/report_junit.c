/* SPDX-License-Identifier: MIT */
/* report_junit.c - writes a comparison as JUnit XML: see report.h.
 *
 * Readers require a time for each test case; it is unknown, so it is 0. GitLab and Jenkins show the picture of an
 * ATTACHMENT line if they find the file at its path.
 */
#include "report.h"
#include "diff_words.h"
#include "xml.h"

#include <stdlib.h>

/* Print all details of the first frame of a group. */
static void print_finding(FILE *out, const diff_report *report, size_t i)
{
    const size_t group = report->groups->of[i];
    diff_print_difference(out, &report->result->pairs[i]);
    if (explanation_cause(report->why, i))
        fprintf(out, ". Cause: %s", explanation_cause(report->why, i));
    if (report->groups->groups[group].count > 1) {
        fputs(". Alike: ", out);
        frame_group_print(out, report->groups, report->result, group, true);
    }
}

static const char *name_of_first(const diff_report *report, size_t i)
{
    return diff_pair_name(&report->result->pairs[report->groups->groups[report->groups->of[i]].first]);
}

static bool write_fault(FILE *out, const diff_report *report, size_t i)
{
    const diff_pair *pair = &report->result->pairs[i];
    const diff_verdict verdict = diff_finding_verdict(pair->finding);
    const char *element = verdict == DIFF_TROUBLE ? "error" : "failure";
    char *words;
    text_stream s;
    if (!text_stream_begin(&s))
        return false;
    fprintf(s.stream, "%s: ", diff_verdict_name(verdict));
    if (frame_groups_shows(report->groups, i))
        print_finding(s.stream, report, i);
    else
        fprintf(s.stream, "like %s", name_of_first(report, i));
    if (!text_stream_end(&s, &words))
        return false;
    fprintf(out, "      <%s type=\"%s\"", element, diff_finding_name(pair->finding));
    write_attribute(out, "message", words);
    putc('>', out);
    write_escaped(out, words, escape_xml); /* some readers show the attribute, some the text */
    fprintf(out, "</%s>\n", element);
    free(words);
    return true;
}

static void write_paths(FILE *out, const diff_report *report, size_t i)
{
    fputs("      <system-out>", out);
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *path = evidence_path(report->evidence, report->result, i, (evidence_picture)picture);
        if (path) {
            fprintf(out, "%s: ", evidence_word((evidence_picture)picture));
            write_escaped(out, path, escape_xml);
            fputs(picture == EVIDENCE_DIFFERENCE ? "\n[[ATTACHMENT|" : "\n", out);
            if (picture == EVIDENCE_DIFFERENCE) {
                write_escaped(out, path, escape_xml);
                fputs("]]\n", out);
            }
        }
        free(path);
    }
    fputs("      </system-out>\n", out);
}

static bool write_case(FILE *out, const diff_report *report, size_t i)
{
    const diff_pair *pair = &report->result->pairs[i];
    const bool fails = diff_finding_verdict(pair->finding) != DIFF_SAME;
    fputs("    <testcase", out);
    write_attribute(out, "classname", report->b->path);
    write_attribute(out, "name", diff_pair_name(pair));
    fputs(" time=\"0\"", out);
    fputs(fails ? ">\n" : "/>\n", out);
    if (!fails)
        return true;
    if (!write_fault(out, report, i))
        return false;
    if (report->evidence && report->evidence->pictures[i])
        write_paths(out, report, i);
    fputs("    </testcase>\n", out);
    return true;
}

/* Write the only test case for recordings without frames: their ticks. */
static void write_ticks_case(FILE *out, const diff_report *report)
{
    const char *headline = report->why->headline ? report->why->headline : "";
    fputs("    <testcase", out);
    write_attribute(out, "classname", report->b->path);
    fputs(" name=\"ticks.jsonl\" time=\"0\"", out);
    if (report->result->verdict == DIFF_SAME) {
        fputs("/>\n", out);
        return;
    }
    fputs(">\n      <failure type=\"ticks\" message=\"different: ", out);
    write_escaped(out, headline, escape_xml);
    fputs("\">different: ", out);
    write_escaped(out, headline, escape_xml);
    fputs("</failure>\n    </testcase>\n", out);
}

static void write_counts(FILE *out, const diff_result *result)
{
    const bool ticks_differ = result->by_ticks && result->verdict != DIFF_SAME;
    fprintf(out, " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"0\" time=\"0\">\n",
            result->count + result->by_ticks, diff_count_different(result) + ticks_differ,
            result->found[FOUND_UNREADABLE]);
}

/* Write what holds for all cases: the verdict, the headline and the tolerance. */
static bool write_summary(FILE *out, const diff_report *report)
{
    text_stream s;
    if (!text_stream_begin(&s))
        return false;
    diff_print_summary(s.stream, report);
    putc('\n', s.stream);
    if (report->why->headline)
        fprintf(s.stream, "%s\n", report->why->headline);
    diff_print_tolerance(s.stream, report);
    putc('\n', s.stream);
    fputs("    <system-out>", out);
    const bool ok = write_escaped_stream(out, &s, escape_xml_text);
    fputs("    </system-out>\n", out);
    if (report->why->trouble) {
        fputs("    <system-err>", out);
        write_escaped(out, report->why->trouble, escape_xml);
        fputs("</system-err>\n", out);
    }
    return ok;
}

bool diff_report_junit(FILE *out, const diff_report *report)
{
    bool ok = true;
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"octreel diff\"", out);
    write_counts(out, report->result);
    fputs("  <testsuite", out);
    write_attribute(out, "name", report->a->path);
    write_counts(out, report->result);
    if (report->result->by_ticks)
        write_ticks_case(out, report);
    for (size_t i = 0; ok && i < report->result->count; i++)
        ok = write_case(out, report, i);
    ok = ok && write_summary(out, report);
    fputs("  </testsuite>\n</testsuites>\n", out);
    return ok;
}
