/* SPDX-License-Identifier: MIT */
/* report_github.c - writes a comparison as GitHub workflow commands: see report.h.
 *
 * Each command is one line. A character that would end the command or one of its properties is escaped as GitHub
 * requires: % as %25, carriage return as %0D, newline as %0A. In properties, : becomes %3A and , becomes %2C.
 */
#include "report.h"
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

static void write_group(FILE *out, const diff_report *report, const frame_group *group)
{
    const diff_pair *first = &report->result->pairs[group->first];
    const diff_frame *shown = first->b ? first->b : first->a;
    fputs("::error ", out);
    if (shown->path) {
        fputs("file=", out);
        write_escaped(out, shown->path, escape_property);
        fputs(",", out);
    }
    fputs("title=octreel diff%3A ", out);
    write_escaped(out, group->frames, escape_property);
    fputs("::", out);
    if (report->why->headline && group == report->groups->groups) {
        write_escaped(out, report->why->headline, escape_message);
        fputs(". ", out);
    }
    write_escaped(out, group->line, escape_message);
    if (group->cause) {
        fputs(". ", out);
        write_escaped(out, group->cause, escape_message);
    }
    fputs("\n", out);
}

void diff_report_github(FILE *out, const diff_report *report)
{
    size_t written = 0;
    for (size_t i = 0; i < report->groups->count && written < DIFF_REPORT_ANNOTATIONS; i++)
        if (frame_group_fails(&report->groups->groups[i], report->result)) {
            write_group(out, report, &report->groups->groups[i]);
            written++;
        }
    if (report->result->by_ticks && report->result->verdict != DIFF_SAME) {
        fputs("::error title=octreel diff%3A the ticks differ::", out);
        write_escaped(out, report->why->headline ? report->why->headline : "ticks.jsonl differs", escape_message);
        fputs("\n", out);
    }
}
