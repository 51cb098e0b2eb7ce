/* SPDX-License-Identifier: MIT */
/* audit_junit.c - writes an audit as JUnit XML: see audit_print.h. Times are unknown and written as 0. */
#include "audit_print.h"
#include "xml.h"

#include <inttypes.h>
#include <stdlib.h>

static void print_worst(FILE *out, const audit_kind *kind, bool neighbors)
{
    for (size_t i = 0; i < kind->worst_count; i++) {
        fprintf(out, "\ntick %" PRIu64 ", ", kind->worst[i].tick);
        audit_print_case(out, &kind->worst[i], neighbors);
        fprintf(out, "\n%s", kind->worst[i].answer);
    }
}

/* Write a failure with a message of one line and all details as its text. */
static bool write_failure(FILE *out, const audit_verdict *v, int kind)
{
    text_stream line, all;
    char *message = NULL;
    bool ok = text_stream_begin(&line);
    if (ok && kind < OCTREE_QUERY_KINDS)
        audit_print_kind(line.stream, v, kind);
    else if (ok)
        audit_print_nodes(line.stream, &v->report->nodes);
    ok = text_stream_end(&line, &message) && ok;
    if (ok) {
        fputs(">\n      <failure type=\"wrong\"", out);
        write_attribute(out, "message", message);
        putc('>', out);
    }
    ok = ok && text_stream_begin(&all);
    if (ok) {
        fputs(message, all.stream);
        if (kind < OCTREE_QUERY_KINDS)
            print_worst(all.stream, &v->report->kinds[kind], octree_query_about((octree_query_kind)kind)->neighbors);
        ok = write_escaped_stream(out, &all, escape_xml_text);
        fputs("</failure>\n    </testcase>\n", out);
    }
    free(message);
    return ok;
}

static bool write_case(FILE *out, const audit_verdict *v, int kind, bool passes)
{
    fputs("    <testcase", out);
    write_attribute(out, "classname", v->path);
    write_attribute(out, "name", kind < OCTREE_QUERY_KINDS ? octree_query_name((octree_query_kind)kind) : "nodes");
    fputs(" time=\"0\"", out);
    if (!passes)
        return write_failure(out, v, kind);
    fputs("/>\n", out);
    return true;
}

static void write_counts(FILE *out, const audit_verdict *v)
{
    unsigned tests = v->report->nodes.given, failures = v->report->nodes.faults > 0;
    for (int i = 0; i < OCTREE_QUERY_KINDS; i++) {
        tests += v->report->kinds[i].asked > 0;
        failures += !audit_kind_passes(&v->report->kinds[i], &v->report->limits);
    }
    fprintf(out, " tests=\"%u\" failures=\"%u\" errors=\"0\" skipped=\"0\" time=\"0\">\n", tests, failures);
}

bool audit_print_junit(FILE *out, const audit_verdict *v)
{
    text_stream s;
    bool ok = true;
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"octreel audit\"", out);
    write_counts(out, v);
    fputs("  <testsuite", out);
    write_attribute(out, "name", v->path);
    write_counts(out, v);
    for (int i = 0; ok && i < OCTREE_QUERY_KINDS; i++)
        if (v->report->kinds[i].asked)
            ok = write_case(out, v, i, audit_kind_passes(&v->report->kinds[i], &v->report->limits));
    if (v->report->nodes.given)
        ok = ok && write_case(out, v, OCTREE_QUERY_KINDS, v->report->nodes.faults == 0);
    ok = ok && text_stream_begin(&s);
    if (ok) {
        fputs("    <system-out>", out);
        audit_print_all(s.stream, v);
        if (v->report->limits.by_ratio || v->report->limits.by_recall)
            fputs("; allowed: ", s.stream);
        audit_print_limits(s.stream, &v->report->limits);
        ok = write_escaped_stream(out, &s, escape_xml_text);
        fputs("</system-out>\n", out);
    }
    fputs("  </testsuite>\n</testsuites>\n", out);
    return ok;
}
