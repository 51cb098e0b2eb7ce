/* SPDX-License-Identifier: MIT */
/* report_markdown.c - writes a comparison as GitHub Markdown for the summary of a CI job: see report.h. */
#include "contact_sheet.h"
#include "diff_words.h"
#include "text.h"

#include <inttypes.h>

static void write_text(FILE *out, const char *text)
{
    write_escaped(out, text, escape_markdown);
}

/* Write a name as HTML, because nothing can be escaped between backticks. */
static void write_name(FILE *out, const char *name)
{
    fputs("<code>", out);
    write_text(out, name);
    fputs("</code>", out);
}

static bool has_causes(const explanation *why)
{
    for (size_t i = 0; i < why->count; i++)
        if (why->pairs[i].text)
            return true;
    return false;
}

static void write_pixels(FILE *out, const diff_pair *pair)
{
    const image_difference *d = &pair->difference;
    const uint64_t all = (uint64_t)pair->about[0].width * (uint64_t)pair->about[0].height;
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixel%s", d->counted.pixels, all, plural(all));
    if (d->unlike.pixels > d->counted.pixels)
        fprintf(out, ", %" PRIu64 " more forgiven", d->unlike.pixels - d->counted.pixels);
    fprintf(out, " | %.4f " IMAGE_DELTA_UNIT " at (%d,%d)", diff_shown_delta(d->counted.worst_delta),
            d->counted.worst_x, d->counted.worst_y);
}

static bool write_others(FILE *out, const diff_report *report, size_t group)
{
    text_stream s;
    if (report->groups->groups[group].count == 1)
        return true;
    fprintf(out, " and %zu more: ", report->groups->groups[group].count - 1);
    if (!text_stream_begin(&s))
        return false;
    frame_group_print(s.stream, report->groups, report->result, group, true);
    return write_escaped_stream(out, &s, escape_markdown);
}

static bool write_row(FILE *out, const diff_report *report, size_t group, bool causes)
{
    const size_t i = report->groups->groups[group].first;
    const diff_pair *pair = &report->result->pairs[i];
    const char *cause = explanation_cause(report->why, i);
    fputs("| ", out);
    write_name(out, diff_pair_name(pair));
    bool ok = write_others(out, report, group);
    fputs(" | ", out);
    if (pair->finding == FOUND_PIXELS) {
        write_pixels(out, pair);
    } else {
        text_stream s;
        ok = text_stream_begin(&s) && ok;
        if (s.stream)
            diff_print_difference(s.stream, pair);
        ok = write_escaped_stream(out, &s, escape_markdown) && ok;
        fputs(" |", out);
    }
    fputs(" |", out);
    if (causes) {
        putc(' ', out);
        write_text(out, cause ? cause : "");
        fputs(" |", out);
    }
    putc('\n', out);
    return ok;
}

static bool write_table(FILE *out, const diff_report *report)
{
    const bool causes = has_causes(report->why);
    size_t rows = 0;
    bool ok = true;
    fprintf(out, "\n| frame | difference | worst |%s\n|---|---|---|%s\n", causes ? " cause |" : "",
            causes ? "---|" : "");
    for (size_t i = 0; ok && i < report->groups->count; i++) {
        const diff_pair *first = &report->result->pairs[report->groups->groups[i].first];
        if (diff_finding_verdict(first->finding) != DIFF_SAME && rows++ < DIFF_REPORT_ROWS)
            ok = write_row(out, report, i, causes);
    }
    if (rows > DIFF_REPORT_ROWS)
        fprintf(out, "\nand %zu more\n", rows - DIFF_REPORT_ROWS);
    return ok;
}

static void write_why(FILE *out, const explanation *why)
{
    if (why->headline) {
        fputs("**", out);
        write_text(out, why->headline);
        fputs("**\n\n", out);
    }
    if (why->trouble) {
        fputs("The cause could not be found: ", out);
        write_text(out, why->trouble);
        fputs("\n\n", out);
    }
}

static bool write_verdict(FILE *out, const diff_report *report)
{
    text_stream s;
    if (!text_stream_begin(&s))
        return false;
    diff_print_summary(s.stream, report);
    fputs("### octreel diff: ", out);
    bool ok = write_escaped_stream(out, &s, escape_markdown);
    fputs("\n\n", out);
    write_why(out, report->why);
    write_name(out, report->b->path);
    fputs(" against ", out);
    write_name(out, report->a->path);
    fputs(", ", out);
    if (!ok || !text_stream_begin(&s))
        return false;
    diff_print_tolerance(s.stream, report);
    ok = write_escaped_stream(out, &s, escape_markdown);
    fputs(".\n", out);
    return ok;
}

static bool any_differs(const diff_result *result)
{
    return diff_count_different(result) + result->found[FOUND_UNREADABLE] > 0;
}

bool diff_report_markdown(FILE *out, const diff_report *report)
{
    if (!write_verdict(out, report) || (any_differs(report->result) && !write_table(out, report)))
        return false;
    if (report->evidence) {
        fputs("\nEvidence: <code>", out);
        write_text(out, report->evidence->folder);
        fputs("/" EVIDENCE_PAGE "</code>", out);
        if (any_differs(report->result))
            fputs(", at a glance <code>" CONTACT_SHEET "</code>", out);
        fputs("\n", out);
    }
    return true;
}
