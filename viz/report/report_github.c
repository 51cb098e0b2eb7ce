/* SPDX-License-Identifier: MIT */
/* report_github.c - writes a comparison as GitHub workflow commands: see report.h.
 *
 * A command is one line. Characters that would end it or one of its properties are escaped as GitHub requires: % as
 * %25, carriage return and newline as %0D and %0A, and in properties : as %3A and , as %2C.
 */
#include "report.h"
#include "diff_words.h"
#include "text.h"

static const char *escape_message(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    (void)text;
    (void)room;
    return *at == '%' ? "%25" : *at == '\n' ? "%0A" : *at == '\r' ? "%0D" : NULL;
}

static const char *escape_property(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    return *at == ':' ? "%3A" : *at == ',' ? "%2C" : escape_message(text, at, room);
}

static void print_title(FILE *out, const diff_report *report, size_t group)
{
    fputs("octreel diff: ", out);
    frame_group_print(out, report->groups, report->result, group, false);
}

static void print_message(FILE *out, const diff_report *report, size_t group)
{
    const size_t first = report->groups->groups[group].first;
    if (report->why->headline && group == 0)
        fprintf(out, "%s. ", report->why->headline);
    diff_print_pair(out, &report->result->pairs[first]);
    if (explanation_cause(report->why, first))
        fprintf(out, ". %s", explanation_cause(report->why, first));
}

typedef void group_printer(FILE *out, const diff_report *report, size_t group);

static bool write_part(FILE *out, group_printer *print, const diff_report *report, size_t group, escape *how)
{
    text_stream s;
    if (!text_stream_begin(&s))
        return false;
    print(s.stream, report, group);
    return write_escaped_stream(out, &s, how);
}

static bool write_group(FILE *out, const diff_report *report, size_t group)
{
    const diff_pair *first = &report->result->pairs[report->groups->groups[group].first];
    const diff_frame *shown = first->b ? first->b : first->a;
    fputs("::error ", out);
    if (shown->path) {
        fputs("file=", out);
        write_escaped(out, shown->path, escape_property);
        fputs(",", out);
    }
    fputs("title=", out);
    bool ok = write_part(out, print_title, report, group, escape_property);
    fputs("::", out);
    ok = write_part(out, print_message, report, group, escape_message) && ok;
    fputs("\n", out);
    return ok;
}

bool diff_report_github(FILE *out, const diff_report *report)
{
    size_t told = 0;
    bool ok = true;
    for (size_t i = 0; ok && i < report->groups->count && told < DIFF_REPORT_ANNOTATIONS; i++)
        if (diff_finding_verdict(report->result->pairs[report->groups->groups[i].first].finding) != DIFF_SAME) {
            ok = write_group(out, report, i);
            told++;
        }
    if (report->result->by_ticks && report->result->verdict != DIFF_SAME) {
        fputs("::error title=octreel diff%3A the ticks differ::", out);
        write_escaped(out, report->why->headline ? report->why->headline : "ticks.jsonl differs", escape_message);
        fputs("\n", out);
    }
    return ok;
}
