/* SPDX-License-Identifier: MIT */
/* audit_junit.c - writes an audit as JUnit XML: see audit_print.h. */
#include "audit_print.h"
#include "junit.h"

#include <inttypes.h>

static void write_line(FILE *out, const audit_verdict *v, int kind)
{
    if (kind < AUDIT_KINDS)
        audit_print_kind(out, v, kind);
    else
        audit_print_nodes(out, &v->report->nodes);
}

/* Write a test case. If the case fails, the message of its failure element is one line, and the text of this element
 * has all details. */
static void write_case(FILE *out, const audit_verdict *v, int kind, bool passes)
{
    junit_begin_case(out, v->path, kind < AUDIT_KINDS ? audit_kind_about(kind)->name : "nodes");
    if (passes) {
        fputs("/>\n", out);
        return;
    }
    fputs(">\n      <failure type=\"wrong\" message=\"", out);
    write_line(out, v, kind);
    fputs("\">", out);
    write_line(out, v, kind);
    for (size_t i = 0; kind < AUDIT_KINDS && i < v->report->kinds[kind].worst_count; i++) {
        const audit_case *worst = &v->report->kinds[kind].worst[i];
        fprintf(out, "\ntick %" PRIu64 ", ", worst->tick);
        audit_print_wrong_answer(out, worst, audit_kind_about(kind));
        putc('\n', out);
        write_escaped(out, worst->answer, escape_xml_text);
    }
    fputs("</failure>\n    </testcase>\n", out);
}

void audit_print_junit(FILE *out, const audit_verdict *v)
{
    const audit_report *report = v->report;
    size_t tests = report->nodes.given, failures = report->nodes.wrong > 0;
    for (int i = 0; i < AUDIT_KINDS; i++) {
        tests += report->kinds[i].asked > 0;
        failures += !audit_kind_passes(&report->kinds[i], &report->limits);
    }
    junit_begin(out, "octreel audit", v->path, tests, failures, 0);
    for (int i = 0; i < AUDIT_KINDS; i++)
        if (report->kinds[i].asked)
            write_case(out, v, i, audit_kind_passes(&report->kinds[i], &report->limits));
    if (report->nodes.given)
        write_case(out, v, AUDIT_KINDS, report->nodes.wrong == 0);
    fputs("    <system-out>", out);
    audit_print_summary(out, v);
    audit_print_limits(out, "; allowed: ", &report->limits, "");
    fputs("</system-out>\n", out);
    junit_end(out);
}
