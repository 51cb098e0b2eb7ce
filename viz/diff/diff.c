/* SPDX-License-Identifier: MIT */
/* diff.c - pairs the frames of two sides by name and compares the pairs on all cores. */
#include "diff.h"
#include "file.h"
#include "frame_file.h"
#include "hint.h"
#include "parallel.h"
#include "layer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

uint64_t diff_pair_tick(const diff_pair *pair)
{
    uint64_t tick;
    return frame_parse_name(diff_pair_name(pair), &tick) ? tick : DIFF_NO_TICK;
}

const diff_pair *diff_find(const diff_result *result, const char *name)
{
    for (size_t i = 0; i < result->count; i++)
        if (strcmp(diff_pair_name(&result->pairs[i]), name) == 0)
            return &result->pairs[i];
    return NULL;
}

void diff_release(diff_result *result)
{
    for (size_t i = 0; i < result->count; i++) {
        mask_release(&result->pairs[i].mask);
        free(result->pairs[i].trouble);
        free(result->pairs[i].flaky);
        free(result->pairs[i].no_picture);
    }
    free(result->pairs);
    *result = (diff_result){0};
}

/* ---- Pairing ------------------------------------------------------------------------------------------------ */

static bool is_same_color(image_color a, image_color b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* Return whether a side has at most one frame: a picture, or a baseline with at most one frame. A baseline that does
 * not exist yet has no frame. */
static bool has_one_frame(const diff_side *side)
{
    return side->kind == DIFF_PICTURE || (side->kind == DIFF_BASELINE && side->count <= 1);
}

/* Return whether a picture is compared with another picture or with a baseline of at most one frame. */
static bool is_single_pair(const diff_side *a, const diff_side *b)
{
    return (a->kind == DIFF_PICTURE || b->kind == DIFF_PICTURE) && has_one_frame(a) && has_one_frame(b);
}

static bool check_baseline(const diff_side *side, bool is_reference, const diff_options *options, octreel_error *error)
{
    if (!diff_is_exact(options) && !(is_reference && options->store))
        return error_set(error,
                         "%s: a baseline holds digests, which allow no tolerance; %s, or remove --max-pixels, "
                         "--max-delta, --max-channel, --flip, --antialias, --ignore and --ignore-layer",
                         side->path,
                         is_reference
                             ? "add --store DIR, the folder in which octreel accept --store DIR saved the pictures"
                             : "compare the pictures themselves");
    return is_same_color(side->background, options->background) ||
           error_set(error, "%s: was made over another background colour; add --background %02x%02x%02x", side->path,
                     side->background.r, side->background.g, side->background.b);
}

/* Check the names of the layers in rules. baseline.c does not know these names, because the library octreel-compare
 * contains it. */
static bool check_layers(const diff_side *side, octreel_error *error)
{
    unsigned ignored;
    const char *bad;
    for (size_t i = 0; i < side->rule_count; i++) {
        const baseline_rule *rule = &side->rules[i];
        if (rule->layers && !view_layers_parse(rule->layers, &ignored, &bad))
            return error_set(error, "%s:%zu: unknown layer \"%.*s\"; %s record --help lists them", rule->file,
                             rule->line, (int)strcspn(bad, ","), bad, hint_program_name());
    }
    return true;
}

bool diff_check(const diff_side *a, const diff_side *b, const diff_options *options, octreel_error *error)
{
    const diff_side *const sides[2] = {a, b};
    if (a->no_frames != b->no_frames)
        return error_set(error,
                         "%s is a recording without frames, but %s is not; give two recordings without frames, or two "
                         "sides with frames",
                         a->no_frames ? a->path : b->path, a->no_frames ? b->path : a->path);
    if ((a->kind == DIFF_PICTURE || b->kind == DIFF_PICTURE) && !is_single_pair(a, b))
        return error_set(error, "cannot compare one picture with a %s of several pictures: %s and %s",
                         diff_kind_name(a->kind == DIFF_PICTURE ? b->kind : a->kind), a->path, b->path);
    if (a->count + b->count == 0 && !a->no_frames)
        return error_set(error, "nothing to compare: no PNG files in %s or %s", a->path, b->path);
    if (options->store && a->kind != DIFF_BASELINE)
        return error_set(error, "--store works with a baseline only, as the reference; %s is a %s", a->path,
                         diff_kind_name(a->kind));
    for (int i = 0; i < 2; i++)
        if (sides[i]->kind == DIFF_BASELINE && !check_baseline(sides[i], i == 0, options, error))
            return false;
    return check_layers(a, error) && check_layers(b, error);
}

/* Compare the name of frame i of `a` with the name of frame j of `b`; the result has the sign of strcmp(). Two
 * single pictures are a pair even if their names differ, so the result is 0 for them. */
static int compare_next_names(const diff_side *a, size_t i, const diff_side *b, size_t j)
{
    if (i == a->count || j == b->count)
        return i == a->count ? 1 : -1;
    return is_single_pair(a, b) ? 0 : strcmp(a->frames[i].name, b->frames[j].name);
}

static bool make_pairs(const diff_side *a, const diff_side *b, diff_result *result, octreel_error *error)
{
    result->pairs = calloc(a->count + b->count + 1, sizeof *result->pairs);
    if (!result->pairs)
        return error_no_memory(error);
    for (size_t i = 0, j = 0; i < a->count || j < b->count;) {
        diff_pair *pair = &result->pairs[result->count++];
        const int order = compare_next_names(a, i, b, j);
        pair->a = order <= 0 ? &a->frames[i++] : NULL;
        pair->b = order >= 0 ? &b->frames[j++] : NULL;
        pair->finding = !pair->b ? FOUND_NO_FRAME : !pair->a ? FOUND_NO_REFERENCE : FOUND_UNREADABLE;
    }
    return true;
}

/* ---- All pairs ----------------------------------------------------------------------------------------------- */

/* The pairs that have no finding yet. */
typedef struct pending {
    diff_pair **pairs;
    size_t count;
    const diff_options *options;
} pending;

static void compare_bytes_of_pair(size_t i, void *context)
{
    const pending *p = context;
    compare_bytes(p->pairs[i]);
}

static void compare_pixels_of_pair(size_t i, void *context)
{
    const pending *p = context;
    errno = 0;
    compare_pixels(p->pairs[i], p->options);
}

static void remove_pairs_with_same_bytes(pending *p)
{
    size_t kept = 0;
    for (size_t i = 0; i < p->count; i++)
        if (p->pairs[i]->finding != FOUND_SAME_BYTES)
            p->pairs[kept++] = p->pairs[i];
    p->count = kept;
}

static bool compare_all_pairs(const diff_side *a, const diff_side *b, pending *p, octreel_error *error)
{
    parallel_for(p->count, compare_bytes_of_pair, p);
    remove_pairs_with_same_bytes(p);
    for (size_t i = 0; i < p->count; i++)
        p->pairs[i]->layers = p->options->ignored_layers;
    if (p->options->ignored_layers && !p->options->mask(a, b, p->pairs, p->count, error))
        return false;
    parallel_for(p->count, compare_pixels_of_pair, p);
    return true;
}

static bool compare_ticks(const diff_side *a, const diff_side *b, diff_result *result, octreel_error *error)
{
    errno = 0;
    result->by_ticks = true;
    result->verdict = have_same_file(a->path, b->path, "ticks.jsonl") ? DIFF_SAME : DIFF_DIFFERENT;
    return result->verdict == DIFF_SAME || check_system_resources(error);
}

void diff_count_findings(diff_result *result)
{
    memset(result->found, 0, sizeof result->found);
    for (size_t i = 0; i < result->count; i++) {
        const diff_finding finding = result->pairs[i].finding;
        result->found[finding]++;
        if (diff_finding_verdict(finding) > result->verdict)
            result->verdict = diff_finding_verdict(finding);
    }
}

bool diff_run(const diff_side *a, const diff_side *b, const diff_options *options, diff_result *result,
              octreel_error *error)
{
    *result = (diff_result){.options = *options};
    if (!diff_check(a, b, options, error) || !make_pairs(a, b, result, error))
        return false;
    pending p = {.pairs = malloc((result->count + 1) * sizeof *p.pairs), .options = options};
    bool ok = p.pairs || error_no_memory(error);
    for (size_t i = 0; ok && i < result->count; i++)
        if (result->pairs[i].a && result->pairs[i].b)
            p.pairs[p.count++] = &result->pairs[i];
    ok = ok && compare_all_pairs(a, b, &p, error);
    free(p.pairs);
    if (ok && a->no_frames)
        ok = compare_ticks(a, b, result, error);
    if (ok)
        diff_count_findings(result);
    else
        diff_release(result);
    return ok;
}
