/* report.c - a comparison for people. See report.h. */
#include "report.h"
#include "escaped.h"
#include "explain.h"
#include "plural.h"

#include <inttypes.h>
#include <math.h>

const char *diff_verdict_name(diff_verdict verdict)
{
    static const char *const names[] = {
        [DIFF_SAME] = "same", [DIFF_DIFFERENT] = "different", [DIFF_TROUBLE] = "trouble"};
    return names[verdict];
}

double diff_shown_delta(double delta)
{
    return ceil(delta * 1e4) / 1e4;
}

/* Names and what is quoted may hold anything; a line stays one. */
static void print_line(FILE *out, const char *beginning, const char *text)
{
    fputs(beginning, out);
    write_escaped(out, text, escape_nothing);
    fputc('\n', out);
}

/* ---- One pair ------------------------------------------------------------------------------------------------ */

static void print_forgiven(FILE *out, const image_difference *d)
{
    if (d->close)
        fprintf(out, ", %" PRIu64 " of them close", d->close);
    if (d->antialiased)
        fprintf(out, ", %" PRIu64 " anti-aliased", d->antialiased);
    if (d->ignored)
        fprintf(out, ", %" PRIu64 " more in what is ignored", d->ignored);
}

/* Where and how bad: of what counts, or, where all of it is forgiven, of that. */
static void print_worst(FILE *out, const image_difference *d)
{
    const image_tally *tally = d->counted.pixels ? &d->counted : &d->unlike;
    if (tally->pixels == 0)
        return;
    fprintf(out, "; worst %.4f " IMAGE_DELTA_UNIT " at (%d,%d), channels by up to %d of %d; within (%d,%d)-(%d,%d)",
            diff_shown_delta(tally->worst_delta), tally->worst_x, tally->worst_y, tally->largest_channel,
            d->channel_range, tally->min_x, tally->min_y, tally->max_x, tally->max_y);
}

static void print_pixels(FILE *out, const diff_pair *pair)
{
    const image_difference *d = &pair->difference;
    const uint64_t all = (uint64_t)pair->about[0].width * (uint64_t)pair->about[0].height;
    if (d->counted.pixels != d->unlike.pixels)
        fprintf(out, "%" PRIu64 " pixels count; ", d->counted.pixels);
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixels differ", d->unlike.pixels, all);
    print_forgiven(out, d);
    print_worst(out, d);
}

void diff_print_difference(FILE *out, const diff_pair *pair)
{
    const frame_digest *about = pair->about;
    switch (pair->finding) {
    case FOUND_PIXELS:
        print_pixels(out, pair);
        break;
    case FOUND_WITHIN:
        fputs("forgiven: ", out);
        print_pixels(out, pair);
        break;
    case FOUND_SIZE:
        fprintf(out, "the reference is %dx%d, the frame is %dx%d", about[0].width, about[0].height, about[1].width,
                about[1].height);
        break;
    case FOUND_DIGEST:
        fprintf(out, "pixels differ: digest %016" PRIx64 ", now %016" PRIx64, about[0].pixels, about[1].pixels);
        break;
    case FOUND_NO_FRAME:
        fputs("a reference without a frame", out);
        break;
    case FOUND_NO_REFERENCE:
        fputs("a frame without a reference", out);
        break;
    case FOUND_UNREADABLE:
        fprintf(out, "cannot be read: %s", pair->trouble ? pair->trouble : "there is no memory");
        break;
    default:
        fputs("the same", out);
        break;
    }
}

void diff_print_pair(FILE *out, const diff_pair *pair)
{
    write_escaped(out, diff_pair_name(pair), escape_nothing);
    fputs(": ", out);
    diff_print_difference(out, pair);
}

/* ---- All of them --------------------------------------------------------------------------------------------- */

bool diff_is_listed(diff_finding finding)
{
    return finding != FOUND_SAME_BYTES && finding != FOUND_SAME_PIXELS;
}

size_t diff_count_different(const diff_result *result)
{
    size_t count = 0;
    for (int i = 0; i < DIFF_FINDINGS; i++)
        if (diff_finding_verdict((diff_finding)i) == DIFF_DIFFERENT)
            count += result->found[i];
    return count;
}

void diff_print_verdict(FILE *out, const diff_result *result)
{
    const size_t *found = result->found, different = diff_count_different(result);
    fprintf(out, "%s: ", diff_verdict_name(result->verdict));
    if (different)
        fprintf(out, "%zu of ", different);
    fprintf(out, "%zu frame%s", result->count, plural(result->count));
    if (found[FOUND_UNREADABLE])
        fprintf(out, ", %zu cannot be read", found[FOUND_UNREADABLE]);
    if (found[FOUND_SAME_BYTES])
        fprintf(out, ", %zu the same by %s bytes", found[FOUND_SAME_BYTES],
                found[FOUND_SAME_BYTES] == 1 ? "its" : "their");
    if (found[FOUND_SAME_PIXELS])
        fprintf(out, ", %zu the same by %s pixels", found[FOUND_SAME_PIXELS],
                found[FOUND_SAME_PIXELS] == 1 ? "its" : "their");
    if (found[FOUND_WITHIN])
        fprintf(out, ", %zu forgiven", found[FOUND_WITHIN]);
}

static void print_pairs(FILE *out, const diff_result *result)
{
    size_t listed = 0;
    for (size_t i = 0; i < result->count; i++) {
        if (!diff_is_listed(result->pairs[i].finding))
            continue;
        if (listed++ >= DIFF_REPORT_LINES)
            continue;
        fputs("  ", out);
        diff_print_pair(out, &result->pairs[i]);
        fputc('\n', out);
        if (result->pairs[i].cause)
            print_line(out, "    ", result->pairs[i].cause);
    }
    if (listed > DIFF_REPORT_LINES)
        fprintf(out, "  ... and %zu more; --json lists all\n", listed - DIFF_REPORT_LINES);
}

/* Recordings are explained up to a number of frames. */
static void print_unexplained(FILE *out, const diff_result *result)
{
    size_t more = 0;
    for (size_t i = 0; result->explanation && i < result->count; i++)
        more += explain_is_unlike(&result->pairs[i]) && !result->pairs[i].cause;
    if (more)
        fprintf(out, "  %zu of these %s left unexplained; --causes all tells more\n", more, more == 1 ? "is" : "are");
    if (result->explanation && *result->explanation->tracer.untraced)
        print_line(out, "  nothing is traced to what is drawn: ", result->explanation->tracer.untraced);
}

static bool any_transparent(const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (result->pairs[i].transparent)
            return true;
    return false;
}

/* ", " before all but the first. */
static void separate(FILE *out, bool *first)
{
    fputs(*first ? "forgiven: " : ", ", out);
    *first = false;
}

/* A rectangle that forgives nothing is a slip of the pen, most likely. */
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
    const image_tolerance *t = &report->options->tolerance;
    const image_color ground = report->options->background;
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
    if (report->options->ignore_text) {
        separate(out, &first);
        fputs("the text layer", out);
    }
    if (first)
        fputs("compared exactly", out);
    if (any_transparent(report->result))
        fprintf(out, "; transparent pixels lie over #%02x%02x%02x", ground.r, ground.g, ground.b);
}

void diff_report_text(FILE *out, const diff_report *report)
{
    diff_print_verdict(out, report->result);
    fputc('\n', out);
    if (report->result->headline)
        print_line(out, "", report->result->headline);
    print_pairs(out, report->result);
    print_unexplained(out, report->result);
    diff_print_tolerance(out, report);
    fputc('\n', out);
    if (report->evidence) {
        fputs("evidence: ", out);
        write_escaped(out, report->evidence->folder, escape_nothing);
        fputs("/" EVIDENCE_PAGE "\n", out);
    }
}
