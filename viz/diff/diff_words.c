/* SPDX-License-Identifier: MIT */
/* diff_words.c - prints findings and verdicts for people. */
#include "diff_words.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

const char *diff_verdict_name(diff_verdict verdict)
{
    static const char *const names[] = {
        [DIFF_SAME] = "same", [DIFF_DIFFERENT] = "different", [DIFF_TROUBLE] = "trouble"};
    return names[verdict];
}

double diff_round_delta(double delta)
{
    return ceil(delta * 1e4) / 1e4;
}

/* ---- One pair ------------------------------------------------------------------------------------------------ */

static void print_forgiven(FILE *out, const image_difference *d)
{
    if (d->close)
        fprintf(out, ", %" PRIu64 " of them close", d->close);
    if (d->antialiased)
        fprintf(out, ", %" PRIu64 " anti-aliased", d->antialiased);
    if (d->ignored)
        fprintf(out, ", %" PRIu64 " more in ignored areas", d->ignored);
}

/* Print the largest difference of a pixel, and its position. If some pixels differ beyond the tolerance, only these
 * pixels are considered. */
static void print_worst(FILE *out, const image_difference *d)
{
    const image_tally *tally = d->counted.pixels ? &d->counted : &d->unlike;
    if (tally->pixels == 0)
        return;
    fprintf(out, "; worst %.4f " IMAGE_DELTA_UNIT " at (%d,%d), channels by up to %d of %d; within (%d,%d)-(%d,%d)",
            diff_round_delta(tally->worst_delta), tally->worst_x, tally->worst_y, tally->largest_channel,
            d->channel_range, tally->min_x, tally->min_y, tally->max_x, tally->max_y);
}

static void print_flip(FILE *out, const image_difference *d)
{
    if (d->has_flip)
        fprintf(out, "; mean FLIP %.4f, worst %.4f at (%d,%d)", diff_round_delta(d->flip.mean),
                diff_round_delta(d->flip.worst), d->flip.worst_x, d->flip.worst_y);
}

static void print_pixels(FILE *out, const diff_pair *pair)
{
    const image_difference *d = &pair->difference;
    const uint64_t all = (uint64_t)pair->about[0].width * (uint64_t)pair->about[0].height;
    if (d->counted.pixels != d->unlike.pixels)
        fprintf(out, "%" PRIu64 " pixel%s count%s; ", d->counted.pixels, plural_ending(d->counted.pixels),
                verb_ending(d->counted.pixels));
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixel%s differ%s", d->unlike.pixels, all, plural_ending(all),
            verb_ending(d->unlike.pixels));
    print_forgiven(out, d);
    print_worst(out, d);
    print_flip(out, d);
}

/* What a rule did: a name, and the words before and after the place of the rule. */
static const struct {
    const char *name, *before, *after;
} effects[] = {
    [RULE_UNUSED] = {"unused", "", ""},
    [RULE_FORGAVE] = {"forgave", "forgiven by the rule", ""},
    [RULE_EXCEEDED] = {"exceeded", "more than the rule", " forgives"},
    [RULE_EXPIRED] = {"expired", "the rule", " expired on "},
    [RULE_LACKS_STORE] = {"lacks_store", "the rule",
                          " was not applied: it needs the stored picture, so name the store "
                          "(diff --store DIR)"},
    [RULE_LACKS_PICTURE] = {"lacks_picture", "the rule", " was not applied: it needs this picture"},
    [RULE_LACKS_RECORDING] = {"lacks_recording", "the rule",
                              " was not applied: it ignores layers, and the frame is not of a recording"},
};

const char *diff_rule_effect_name(rule_effect effect)
{
    return effects[effect].name;
}

void diff_print_rule(FILE *out, const diff_pair *pair)
{
    const baseline_rule *rule = pair->rule;
    fprintf(out, "%s ", effects[pair->effect].before);
    write_escaped(out, rule->file, escape_nothing);
    fprintf(out, ":%zu%s", rule->line, effects[pair->effect].after);
    if (pair->effect == RULE_EXPIRED)
        fputs(rule->expires, out);
    else if (pair->effect == RULE_FORGAVE && rule->expires)
        fprintf(out, " until %s", rule->expires);
    fputs(": ", out);
    write_escaped(out, rule->reason, escape_nothing);
}

static void print_difference(FILE *out, const diff_pair *pair)
{
    static const char *const beginnings[] = {
        [FOUND_SAME_BYTES] = "the same",
        [FOUND_SAME_PIXELS] = "the same",
        [FOUND_WITHIN] = "forgiven: ",
        [FOUND_PIXELS] = "",
        [FOUND_SIZE] = "the reference is ",
        [FOUND_DIGEST] = "pixels differ: digest ",
        [FOUND_NO_FRAME] = "a reference without a frame",
        [FOUND_NO_REFERENCE] = "a frame without a reference",
        [FOUND_UNREADABLE] = "cannot be read: ",
    };
    const frame_digest *a = &pair->about[0], *b = &pair->about[1];
    fputs(beginnings[pair->finding], out);
    if (pair->finding == FOUND_PIXELS || pair->finding == FOUND_WITHIN)
        print_pixels(out, pair);
    else if (pair->finding == FOUND_SIZE)
        fprintf(out, "%dx%d, the frame is %dx%d", a->width, a->height, b->width, b->height);
    else if (pair->finding == FOUND_DIGEST)
        fprintf(out, "%016" PRIx64 ", now %016" PRIx64, a->pixels, b->pixels);
    else if (pair->finding == FOUND_UNREADABLE)
        fputs(pair->trouble ? pair->trouble : "out of memory", out);
}

void diff_print_difference(FILE *out, const diff_pair *pair)
{
    print_difference(out, pair);
    if (pair->a && pair->b && pair->a->variant_count > 1 && diff_finding_verdict(pair->finding) == DIFF_DIFFERENT)
        fprintf(out, "; matches none of the %zu accepted variants", pair->a->variant_count);
    if (pair->no_picture)
        fprintf(out, "; no picture of the reference: %s", pair->no_picture);
    if (pair->effect != RULE_UNUSED) {
        fputs("; ", out);
        diff_print_rule(out, pair);
    }
}

void diff_print_pair(FILE *out, const diff_pair *pair)
{
    write_escaped(out, diff_pair_name(pair), escape_nothing);
    fputs(": ", out);
    diff_print_difference(out, pair);
}

/* ---- All pairs ----------------------------------------------------------------------------------------------- */

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

size_t diff_count_color_spaces(const diff_result *result)
{
    size_t count = 0;
    for (size_t i = 0; i < result->count; i++)
        count += result->pairs[i].other_color_space;
    return count;
}

void diff_print_verdict(FILE *out, const diff_result *result, diff_verdict verdict)
{
    const size_t *found = result->found, different = diff_count_different(result);
    fprintf(out, "%s: ", diff_verdict_name(verdict));
    if (result->by_ticks) {
        fputs("compared by ticks, because neither recording has frames", out);
        return;
    }
    if (different)
        fprintf(out, "%zu of ", different);
    fprintf(out, "%zu frame%s", result->count, plural_ending(result->count));
    if (found[FOUND_UNREADABLE])
        fprintf(out, ", %zu cannot be read", found[FOUND_UNREADABLE]);
    if (found[FOUND_SAME_BYTES])
        fprintf(out, ", %zu with the same bytes", found[FOUND_SAME_BYTES]);
    if (found[FOUND_SAME_PIXELS])
        fprintf(out, ", %zu with the same pixels", found[FOUND_SAME_PIXELS]);
    if (found[FOUND_WITHIN])
        fprintf(out, ", %zu forgiven", found[FOUND_WITHIN]);
}

/* ---- The tolerance ------------------------------------------------------------------------------------------- */

/* Print one item of a list of tolerances. The list begins with "forgiven: "; its items are separated by commas. */
static void print_item(FILE *out, bool *first, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs(*first ? "forgiven: " : ", ", out);
    vfprintf(out, format, arguments);
    va_end(arguments);
    *first = false;
}

static bool has_transparent_pair(const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (result->pairs[i].transparent)
            return true;
    return false;
}

/* Return whether a rectangle of ignored pixels lies outside of all frames. Such a rectangle is probably a typing error
 * of the user. */
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

/* Print the number of frames to which the tolerance was not applied, because the store has no picture of their
 * reference. */
static void print_unapplied(FILE *out, const diff_result *result)
{
    size_t count = 0;
    for (size_t i = 0; i < result->count; i++)
        count += result->pairs[i].b && result->pairs[i].no_picture;
    if (count)
        fprintf(out, "; not applied to %zu frame%s without a stored picture", count, plural_ending(count));
}

/* Print the rules that forgave frames, and the rules that no frame has. */
static void print_rules(FILE *out, const diff_result *result)
{
    for (size_t n = 0; n < result->rule_count; n++) {
        const baseline_rule *rule = &result->rules[n];
        size_t forgiven = 0;
        const diff_pair *last = NULL;
        for (size_t i = 0; i < result->count; i++)
            if (result->pairs[i].rule == rule && result->pairs[i].effect == RULE_FORGAVE) {
                forgiven++;
                last = &result->pairs[i];
            }
        if (last) {
            fprintf(out, "; %zu frame%s ", forgiven, plural_ending(forgiven));
            diff_print_rule(out, last);
        } else if (rule->matched == 0) {
            fputs("; warning: the rule ", out);
            write_escaped(out, rule->file, escape_nothing);
            fprintf(out, ":%zu applies to no frame; correct its pattern or remove it: ", rule->line);
            write_escaped(out, rule->pattern, escape_nothing);
        }
    }
}

void diff_print_tolerance(FILE *out, const diff_result *result)
{
    const diff_options *options = &result->options;
    const image_tolerance *t = &options->tolerance;
    const size_t other_spaces = diff_count_color_spaces(result);
    bool first = true;
    if (t->max_pixels)
        print_item(out, &first, "up to %" PRIu64 " pixel%s a frame", t->max_pixels, plural_ending(t->max_pixels));
    if (t->max_share > 0)
        print_item(out, &first, "up to %g%% of the pixels", 100 * t->max_share);
    if (t->max_delta > 0)
        print_item(out, &first, "colours within %g " IMAGE_DELTA_UNIT, t->max_delta);
    if (t->max_channel > 0)
        print_item(out, &first, "channels within %d", t->max_channel);
    if (t->flip)
        print_item(out, &first, "a mean FLIP up to %g at %.4g pixels per degree", t->max_flip, t->pixels_per_degree);
    if (t->antialias)
        print_item(out, &first, "anti-aliasing");
    for (size_t i = 0; i < t->ignored_count; i++) {
        const image_rectangle *r = &t->ignored[i];
        print_item(out, &first, "the %dx%d pixels at (%d,%d)%s", r->width, r->height, r->x, r->y,
                   is_outside(r, result) ? ", outside every frame that was compared" : "");
    }
    if (options->ignored_layers)
        print_item(out, &first, "the layer%s %s", strchr(options->layers, ',') ? "s" : "", options->layers);
    if (first)
        fputs("compared exactly", out);
    else
        print_unapplied(out, result);
    print_rules(out, result);
    if (has_transparent_pair(result))
        fprintf(out, "; transparent pixels lie over #%02x%02x%02x", options->background.r, options->background.g,
                options->background.b);
    if (other_spaces)
        fprintf(out, "; gamma and colour profiles, which differ in %zu frame%s, are ignored", other_spaces,
                plural_ending(other_spaces));
}
