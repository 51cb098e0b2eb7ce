/* SPDX-License-Identifier: MIT */
/* markdown_text.h - texts and names in GitHub Markdown, for the reports that are written in it. */
#ifndef REPORT_MARKDOWN_TEXT_H
#define REPORT_MARKDOWN_TEXT_H

#include "report.h"
#include "text.h"

static inline void write_markdown_text(FILE *out, const char *text)
{
    write_escaped(out, text, escape_markdown_character);
}

/* Write a name as an HTML code element, because between Markdown's backticks no character can be escaped. */
static inline void write_markdown_name(FILE *out, const char *name)
{
    fputs("<code>", out);
    write_markdown_text(out, name);
    fputs("</code>", out);
}

/* Write the name of the first frame of a group, and the number and the ticks of the others. */
static inline void write_markdown_frames(FILE *out, const diff_report *report, const frame_group *group)
{
    write_markdown_name(out, diff_pair_name(&report->result->pairs[group->first]));
    if (group->count == 1)
        return;
    fprintf(out, " and %zu more: ", group->count - 1);
    write_markdown_text(out, group->others);
}

#endif
