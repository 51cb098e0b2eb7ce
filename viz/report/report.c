/* SPDX-License-Identifier: MIT */
/* report.c - reports a comparison as text for people. */
#include "report.h"
#include "text.h"

/* Print a line that consists of `beginning` and a text. Control characters of the text are escaped, because a file
 * name may contain a newline. */
static void print_line(FILE *out, const char *beginning, const char *text)
{
    fputs(beginning, out);
    write_escaped(out, text, escape_nothing);
    fputc('\n', out);
}

void diff_report_print_group(FILE *out, const frame_group *group)
{
    fprintf(out, "  %s\n", group->line);
    if (group->cause)
        print_line(out, "    ", group->cause);
    if (group->count > 1)
        fprintf(out, "    and %zu more frame%s with this finding: %s\n", group->count - 1,
                plural_ending(group->count - 1), group->others);
}

static void print_groups(FILE *out, const diff_report *report)
{
    for (size_t i = 0; i < report->groups->count && i < report->lines; i++)
        diff_report_print_group(out, &report->groups->groups[i]);
    print_remaining_count(out, report->groups->count, report->lines, "--causes all lists all, and so does --json");
}

/* Print how many of the differing ticks were not explained, and how many were not traced. */
static void print_unexplained(FILE *out, const diff_report *report)
{
    const explanation *why = report->why;
    size_t more = 0;
    for (size_t i = 0; why->recordings && i < report->groups->count; i++) {
        const frame_group *group = &report->groups->groups[i];
        more += explain_has_difference(&report->result->pairs[group->first]) && !group->cause;
    }
    if (more)
        fprintf(out, "  %zu of these %s left unexplained; --causes all explains all\n", more, more == 1 ? "is" : "are");
    if (*why->tracer.untraced)
        print_line(out, "  the elements at the different pixels are unknown: ", why->tracer.untraced);
}

void diff_report_text(FILE *out, const diff_report *report)
{
    fprintf(out, "%s\n", report->groups->verdict);
    if (report->why->headline)
        print_line(out, "", report->why->headline);
    print_groups(out, report);
    print_unexplained(out, report);
    fprintf(out, "%s\n", report->groups->tolerance);
    if (report->evidence) {
        fputs("evidence: ", out);
        write_escaped(out, report->evidence->folder, escape_nothing);
        fputs("/" EVIDENCE_PAGE "\n", out);
    }
}
