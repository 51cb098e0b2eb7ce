/* SPDX-License-Identifier: MIT */
/* report_markdown.c - writes a comparison as GitHub Markdown for the summary of a CI job: see report.h. */
#include "contact_sheet.h"
#include "diff_words.h"
#include "markdown_text.h"

#include <inttypes.h>

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
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixel%s", d->counted.pixels, all, plural_ending(all));
    if (d->unlike.pixels > d->counted.pixels)
        fprintf(out, ", %" PRIu64 " more forgiven", d->unlike.pixels - d->counted.pixels);
    if (d->has_flip)
        fprintf(out, ", FLIP %.4f", diff_round_delta(d->flip.mean));
    fprintf(out, " | %.4f " IMAGE_DELTA_UNIT " at (%d,%d)", diff_round_delta(d->counted.worst_delta),
            d->counted.worst_x, d->counted.worst_y);
}

static void write_row(FILE *out, const diff_report *report, const frame_group *group, bool causes)
{
    const diff_pair *pair = &report->result->pairs[group->first];
    fputs("| ", out);
    write_markdown_frames(out, report, group);
    fputs(" | ", out);
    if (pair->finding == FOUND_PIXELS) {
        write_pixels(out, pair);
    } else {
        write_markdown_text(out, group->difference);
        fputs(" |", out);
    }
    fputs(causes ? " | " : " |", out);
    if (causes) {
        write_markdown_text(out, group->cause ? group->cause : "");
        fputs(" |", out);
    }
    putc('\n', out);
}

static void write_table(FILE *out, const diff_report *report)
{
    const bool causes = has_causes(report->why);
    size_t rows = 0;
    fprintf(out, "\n| frame | difference | worst |%s\n|---|---|---|%s\n", causes ? " cause |" : "",
            causes ? "---|" : "");
    for (size_t i = 0; i < report->groups->count; i++) {
        const frame_group *group = &report->groups->groups[i];
        if (frame_group_fails(group, report->result) && rows++ < DIFF_REPORT_ROWS)
            write_row(out, report, group, causes);
    }
    if (rows > DIFF_REPORT_ROWS)
        fprintf(out, "\nand %zu more\n", rows - DIFF_REPORT_ROWS);
}

void diff_report_markdown(FILE *out, const diff_report *report)
{
    const explanation *why = report->why;
    const bool fails = frame_groups_count_failing(report->groups, report->result) > 0;
    fputs("### octreel diff: ", out);
    write_markdown_text(out, report->groups->verdict);
    fputs("\n\n", out);
    if (why->headline) {
        fputs("**", out);
        write_markdown_text(out, why->headline);
        fputs("**\n\n", out);
    }
    if (why->trouble) {
        fputs("The cause could not be found: ", out);
        write_markdown_text(out, why->trouble);
        fputs("\n\n", out);
    }
    write_markdown_name(out, report->b->path);
    fputs(" against ", out);
    write_markdown_name(out, report->a->path);
    fputs(", ", out);
    write_markdown_text(out, report->groups->tolerance);
    fputs(".\n", out);
    if (fails)
        write_table(out, report);
    if (!report->evidence)
        return;
    fputs("\nEvidence: <code>", out);
    write_markdown_text(out, report->evidence->folder);
    fputs(fails ? "/" EVIDENCE_PAGE "</code>, at a glance <code>" CONTACT_SHEET "</code>\n"
                : "/" EVIDENCE_PAGE "</code>\n",
          out);
}
