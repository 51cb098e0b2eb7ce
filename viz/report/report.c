/* SPDX-License-Identifier: MIT */
/* report.c - reports a comparison as text for people. */
#include "report.h"
#include "diff_words.h"
#include "text.h"

#include <inttypes.h>
#include <string.h>

/* Escape control characters: a file name may contain a newline, but the output must stay on one line. */
static void print_line(FILE *out, const char *beginning, const char *text)
{
    fputs(beginning, out);
    write_escaped(out, text, escape_nothing);
    fputc('\n', out);
}

void diff_print_summary(FILE *out, const diff_report *report)
{
    diff_print_verdict(out, report->result, explanation_verdict(report->why, report->result));
}

/* Print a group: its first frame, the cause, and the names of the other frames. */
static void print_group(FILE *out, const diff_report *report, size_t group)
{
    const frame_group *g = &report->groups->groups[group];
    fputs("  ", out);
    diff_print_pair(out, &report->result->pairs[g->first]);
    fputc('\n', out);
    if (explanation_cause(report->why, g->first))
        print_line(out, "    ", explanation_cause(report->why, g->first));
    if (g->count > 1) {
        fprintf(out, "    and %zu more alike: ", g->count - 1);
        frame_group_print(out, report->groups, report->result, group, true);
        fputc('\n', out);
    }
}

static void print_groups(FILE *out, const diff_report *report)
{
    for (size_t i = 0; i < report->groups->count && i < report->lines; i++)
        print_group(out, report, i);
    print_remaining_count(out, report->groups->count, report->lines, "--causes all lists all, and so does --json");
}

/* Print how many differing ticks were not explained or traced. */
static void print_unexplained(FILE *out, const diff_report *report)
{
    const explanation *why = report->why;
    size_t more = 0;
    for (size_t i = 0; why->recordings && i < report->groups->count; i++) {
        const size_t first = report->groups->groups[i].first;
        more += explain_is_unlike(&report->result->pairs[first]) && !explanation_cause(why, first);
    }
    if (more)
        fprintf(out, "  %zu of these %s left unexplained; --causes all explains all\n", more, more == 1 ? "is" : "are");
    if (*why->tracer.untraced)
        print_line(out, "  not traced to the elements that are drawn there: ", why->tracer.untraced);
}

static bool any_transparent(const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (result->pairs[i].transparent)
            return true;
    return false;
}

/* Print "forgiven: " before the first item and ", " before the others. */
static void separate(FILE *out, bool *first)
{
    fputs(*first ? "forgiven: " : ", ", out);
    *first = false;
}

/* Whether a rectangle lies outside of all frames, which is probably a mistake of the user. */
static bool is_outside(const image_rectangle *r, const diff_result *result)
{
    bool compared = false;
    for (size_t i = 0; i < result->count; i++)
        for (int side = 0; side < 2; side++) {
            const frame_digest *about = &result->pairs[i].about[side];
            compared = compared || about->width > 0;
            if (r->x < about->width && r->y < about->height)
                return false;
        }
    return compared;
}

void diff_print_tolerance(FILE *out, const diff_report *report)
{
    const image_tolerance *t = &report->result->options.tolerance;
    const image_color ground = report->result->options.background;
    const size_t other_spaces = diff_count_color_spaces(report->result);
    bool first = true;
    if (t->max_pixels) {
        separate(out, &first);
        fprintf(out, "up to %" PRIu64 " pixel%s a frame", t->max_pixels, plural(t->max_pixels));
    }
    if (t->max_delta > 0) {
        separate(out, &first);
        fprintf(out, "colours within %g " IMAGE_DELTA_UNIT, t->max_delta);
    }
    if (t->antialias) {
        separate(out, &first);
        fputs("anti-aliasing", out);
    }
    for (size_t i = 0; i < t->ignored_count; i++) {
        const image_rectangle *r = &t->ignored[i];
        separate(out, &first);
        fprintf(out, "the %dx%d pixels at (%d,%d)%s", r->width, r->height, r->x, r->y,
                is_outside(r, report->result) ? ", outside every frame that was compared" : "");
    }
    if (report->result->options.mask) {
        separate(out, &first);
        fprintf(out, "the layer%s %s", strchr(report->result->options.layers, ',') ? "s" : "",
                report->result->options.layers);
    }
    if (first)
        fputs("compared exactly", out);
    if (any_transparent(report->result))
        fprintf(out, "; transparent pixels lie over #%02x%02x%02x", ground.r, ground.g, ground.b);
    if (other_spaces)
        fprintf(out, "; gamma and colour profiles, which differ in %zu frame%s, are ignored", other_spaces,
                plural(other_spaces));
}

void diff_report_text(FILE *out, const diff_report *report)
{
    diff_print_summary(out, report);
    fputc('\n', out);
    if (report->why->headline)
        print_line(out, "", report->why->headline);
    print_groups(out, report);
    print_unexplained(out, report);
    diff_print_tolerance(out, report);
    fputc('\n', out);
    if (report->evidence) {
        fputs("evidence: ", out);
        write_escaped(out, report->evidence->folder, escape_nothing);
        fputs("/" EVIDENCE_PAGE "\n", out);
    }
}
