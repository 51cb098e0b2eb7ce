/* diff.c - frames are paired by name, and the pairs compared on all cores. */
#include "diff.h"
#include "compare.h"
#include "cores.h"
#include "parallel.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>

typedef struct finding_entry {
    const char *name;
    diff_verdict verdict;
} finding_entry;

static const finding_entry findings[] = {
#define FINDING_ENTRY(name, text, verdict) {text, verdict},
    DIFF_FINDING_MAP(FINDING_ENTRY)
#undef FINDING_ENTRY
};

const char *diff_finding_name(diff_finding finding)
{
    return findings[finding].name;
}

diff_verdict diff_finding_verdict(diff_finding finding)
{
    return findings[finding].verdict;
}

diff_options diff_options_default(void)
{
    return (diff_options){.background = IMAGE_WHITE};
}

const char *diff_pair_name(const diff_pair *pair)
{
    return pair->b ? pair->b->name : pair->a->name;
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
    }
    free(result->pairs);
    *result = (diff_result){0};
}

bool pair_tolerance(const diff_pair *pair, const diff_options *options, image_tolerance *tolerance)
{
    *tolerance = options->tolerance;
    tolerance->ignored_mask = mask_bytes(&pair->mask);
    return tolerance->ignored_mask || !pair->mask.runs;
}

void pair_tolerance_release(image_tolerance *tolerance)
{
    free((void *)tolerance->ignored_mask);
}

/* ---- Which frame belongs to which --------------------------------------------------------------------------- */

static bool is_exact(const image_tolerance *tolerance)
{
    return tolerance->max_pixels == 0 && tolerance->max_delta == 0 && !tolerance->antialias &&
           tolerance->ignored_count == 0;
}

static bool same_color(image_color a, image_color b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* One picture, or the digest of one: its name does not matter. */
static bool is_one(const diff_side *side)
{
    return side->kind == DIFF_PICTURE || (side->kind == DIFF_DIGESTS && side->count == 1);
}

/* One picture is compared with one picture. */
static bool is_single(const diff_side *a, const diff_side *b)
{
    return (a->kind == DIFF_PICTURE || b->kind == DIFF_PICTURE) && is_one(a) && is_one(b);
}

bool diff_check(const diff_side *a, const diff_side *b, const diff_options *options, octreel_error *error)
{
    const diff_side *const sides[2] = {a, b};
    if ((a->kind == DIFF_PICTURE || b->kind == DIFF_PICTURE) && !is_single(a, b))
        return error_set(error, "a picture is compared with a picture, or the digest of one: %s is one, %s is not",
                         a->kind == DIFF_PICTURE ? a->path : b->path, a->kind == DIFF_PICTURE ? b->path : a->path);
    if (a->count + b->count == 0)
        return error_set(error, "there is nothing to compare: neither %s nor %s has a PNG in it", a->path, b->path);
    for (int i = 0; i < 2; i++) {
        if (sides[i]->kind != DIFF_DIGESTS)
            continue;
        if (!is_exact(&options->tolerance) || options->mask)
            return error_set(error, "%s: digests tell same from different and no more: nothing can be forgiven",
                             sides[i]->path);
        if (!same_color(sides[i]->background, options->background))
            return error_set(error, "%s: these digests are of another background: give --background %02x%02x%02x",
                             sides[i]->path, sides[i]->background.r, sides[i]->background.g, sides[i]->background.b);
    }
    return true;
}

/* Two single pictures are a pair whatever their names. */
static int order_of(const diff_side *a, size_t i, const diff_side *b, size_t j)
{
    if (i == a->count || j == b->count)
        return i == a->count ? 1 : -1;
    return is_single(a, b) ? 0 : strcmp(a->frames[i].name, b->frames[j].name);
}

static bool make_pairs(const diff_side *a, const diff_side *b, diff_result *result, octreel_error *error)
{
    result->pairs = calloc(a->count + b->count, sizeof *result->pairs);
    if (!result->pairs)
        return error_set(error, "there is no memory for %zu frames", a->count + b->count);
    for (size_t i = 0, j = 0; i < a->count || j < b->count;) {
        diff_pair *pair = &result->pairs[result->count++];
        const int order = order_of(a, i, b, j);
        pair->a = order <= 0 ? &a->frames[i++] : NULL;
        pair->b = order >= 0 ? &b->frames[j++] : NULL;
        pair->finding = !pair->b ? FOUND_NO_FRAME : !pair->a ? FOUND_NO_REFERENCE : FOUND_UNREADABLE;
    }
    return true;
}

/* ---- Comparing them ------------------------------------------------------------------------------------------ */

/* The pairs that have no finding yet. */
typedef struct pending {
    diff_pair **pairs;
    size_t count;
    const diff_options *options;
} pending;

static void try_bytes(size_t i, void *context)
{
    const pending *p = context;
    compare_bytes(p->pairs[i]);
}

static void find_pixels(size_t i, void *context)
{
    const pending *p = context;
    compare_pixels(p->pairs[i], p->options);
}

static void keep_undecided(pending *p)
{
    size_t kept = 0;
    for (size_t i = 0; i < p->count; i++)
        if (p->pairs[i]->finding != FOUND_SAME_BYTES)
            p->pairs[kept++] = p->pairs[i];
    p->count = kept;
}

static bool compare_all(const diff_side *a, const diff_side *b, pending *p, octreel_error *error)
{
    const unsigned cores = count_cores();
    parallel_for(p->count, cores, try_bytes, p);
    keep_undecided(p);
    if (p->options->mask && !p->options->mask(p->options->mask_context, a, b, p->pairs, p->count, error))
        return false;
    parallel_for(p->count, cores, find_pixels, p);
    return true;
}

static void sum_up(diff_result *result)
{
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
    pending p = {.pairs = malloc(result->count * sizeof *p.pairs), .options = options};
    bool ok = p.pairs || error_set(error, "there is no memory for %zu frames", result->count);
    for (size_t i = 0; ok && i < result->count; i++)
        if (result->pairs[i].a && result->pairs[i].b)
            p.pairs[p.count++] = &result->pairs[i];
    ok = ok && compare_all(a, b, &p, error);
    free(p.pairs);
    if (ok)
        sum_up(result);
    else
        diff_release(result);
    return ok;
}
