/* report_junit.c - a comparison as JUnit's XML: see report.h.
 *
 * A time is wanted by readers of it and not known: it is 0. The line with ATTACHMENT shows a picture in GitLab and in
 * Jenkins, where the path is one that they find.
 */
#include "report.h"
#include "escaped.h"

#include <stdlib.h>

static void write_attribute(FILE *out, const char *name, const char *value)
{
    fprintf(out, " %s=\"", name);
    write_escaped(out, value, escape_xml);
    putc('"', out);
}

/* What a function prints, escaped: null when there is no memory. */
static char *difference_of(const diff_pair *pair)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    diff_print_difference(out, pair);
    if (pair->cause)
        fprintf(out, ". Cause: %s", pair->cause);
    fclose(out);
    return text;
}

static void write_fault(FILE *out, const diff_pair *pair)
{
    const diff_verdict verdict = diff_finding_verdict(pair->finding);
    const char *element = verdict == DIFF_TROUBLE ? "error" : "failure";
    char *difference = difference_of(pair);
    const char *words = difference ? difference : "there is no memory";
    fprintf(out, "      <%s type=\"%s\" message=\"%s: ", element, diff_finding_name(pair->finding),
            diff_verdict_name(verdict));
    write_escaped(out, words, escape_xml);
    fputs("\">", out);
    write_escaped(out, words, escape_xml); /* some readers show the one, some the other */
    fprintf(out, "</%s>\n", element);
    free(difference);
}

static void write_paths(FILE *out, const diff_report *report, size_t i)
{
    fputs("      <system-out>", out);
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *path = evidence_path(report->evidence, report->result, i, (evidence_picture)picture);
        if (path) {
            fprintf(out, "%s: ", evidence_word((evidence_picture)picture));
            write_escaped(out, path, escape_xml);
            fputs(picture == EVIDENCE_SIDE ? "\n[[ATTACHMENT|" : "\n", out);
            if (picture == EVIDENCE_SIDE) {
                write_escaped(out, path, escape_xml);
                fputs("]]\n", out);
            }
        }
        free(path);
    }
    fputs("      </system-out>\n", out);
}

static void write_case(FILE *out, const diff_report *report, size_t i)
{
    const diff_pair *pair = &report->result->pairs[i];
    const bool fails = diff_finding_verdict(pair->finding) != DIFF_SAME;
    fputs("    <testcase", out);
    write_attribute(out, "classname", report->b->path);
    write_attribute(out, "name", diff_pair_name(pair));
    fputs(" time=\"0\"", out);
    fputs(fails ? ">\n" : "/>\n", out);
    if (!fails)
        return;
    write_fault(out, pair);
    if (report->evidence && report->evidence->pictures[i])
        write_paths(out, report, i);
    fputs("    </testcase>\n", out);
}

static void write_counts(FILE *out, const diff_result *result)
{
    fprintf(out, " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"0\" time=\"0\">\n", result->count,
            diff_count_different(result), result->found[FOUND_UNREADABLE]);
}

/* What holds for all of them: the verdict, why, and how they were compared. */
static void write_summary(FILE *out, const diff_report *report)
{
    char *text = NULL;
    size_t size;
    FILE *words = open_memstream(&text, &size);
    if (!words)
        return;
    diff_print_verdict(words, report->result);
    fprintf(words, "%s%s\n", report->result->headline ? "\n" : "",
            report->result->headline ? report->result->headline : "");
    diff_print_tolerance(words, report);
    fclose(words);
    fputs("    <system-out>", out);
    write_escaped(out, text ? text : "", escape_xml);
    fputs("\n    </system-out>\n", out);
    free(text);
}

void diff_report_junit(FILE *out, const diff_report *report)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"octreel diff\"", out);
    write_counts(out, report->result);
    fputs("  <testsuite", out);
    write_attribute(out, "name", report->a->path);
    write_counts(out, report->result);
    for (size_t i = 0; i < report->result->count; i++)
        write_case(out, report, i);
    write_summary(out, report);
    fputs("  </testsuite>\n</testsuites>\n", out);
}
