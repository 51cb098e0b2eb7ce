/* SPDX-License-Identifier: MIT */
/* picture_store.c - stores pictures under their digests, and compares the frames of a baseline with them. */
#include "picture_store.h"
#include "file.h"
#include "folder.h"
#include "parallel.h"
#include "stored_picture.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool picture_store_add(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error)
{
    octreel_error ignored;
    char *path = stored_picture_path(store, digest);
    if (!path)
        return error_no_memory(error);
    bool ok = access(path, F_OK) == 0 && stored_picture_check(path, digest, background, &ignored);
    if (!ok) {
        char *slash = strrchr(path, '/');
        *slash = 0;
        ok = folder_create(path, error);
        *slash = '/';
        ok = ok && file_copy_unique(picture, path, error);
    }
    free(path);
    return ok;
}

/* ---- For a comparison ---------------------------------------------------------------------------------------- */

typedef struct fetching {
    diff_side *reference;
    diff_result *result;
} fetching;

static diff_frame *reference_of(const fetching *f, const diff_pair *pair)
{
    return &f->reference->frames[pair->a - f->reference->frames];
}

static void compare_pair(size_t i, void *context)
{
    const fetching *f = context;
    diff_pair *pair = &f->result->pairs[i];
    if (pair->a)
        stored_picture_compare(pair, reference_of(f, pair), &f->result->options);
}

static void apply_rule(size_t i, void *context)
{
    const fetching *f = context;
    diff_pair *pair = &f->result->pairs[i];
    if (pair->rule)
        stored_picture_apply_rule(pair, reference_of(f, pair), &f->result->options);
}

/* Find the rule for each frame of the reference. */
static void match_rules(const fetching *f)
{
    f->result->rules = f->reference->rules;
    f->result->rule_count = f->reference->rule_count;
    for (size_t i = 0; f->result->rule_count > 0 && i < f->result->count; i++) {
        diff_pair *pair = &f->result->pairs[i];
        baseline_rule *rule = pair->a ? rule_find(f->reference, pair->a->name) : NULL;
        pair->rule = rule;
        if (rule)
            rule->matched++;
    }
}

/* Choose the rules that are applied, and mask the layers that these rules ignore. */
static bool choose_rules(const fetching *f, const diff_side *compared, octreel_error *error)
{
    const diff_options *options = &f->result->options;
    const bool is_recording = compared->kind == DIFF_RECORDING && options->mask;
    diff_pair **masked = malloc((f->result->count + 1) * sizeof *masked);
    size_t count = 0;
    const char *bad;
    bool ok = masked || error_no_memory(error);
    for (size_t i = 0; ok && i < f->result->count; i++) {
        diff_pair *pair = &f->result->pairs[i];
        stored_picture_choose_rule(pair, options, is_recording);
        if (pair->effect == RULE_EXCEEDED && pair->rule->layers &&
            view_layers_parse(pair->rule->layers, &pair->layers, &bad))
            masked[count++] = pair;
    }
    ok = ok && (count == 0 || options->mask(f->reference, compared, masked, count, error));
    free(masked);
    return ok;
}

bool picture_store_fetch(diff_side *reference, const diff_side *compared, diff_result *result, octreel_error *error)
{
    fetching f = {reference, result};
    if (reference->kind != DIFF_BASELINE)
        return true;
    match_rules(&f);
    if (result->options.store)
        parallel_for(result->count, compare_pair, &f);
    if (result->rule_count > 0) {
        char *today = result->options.today;
        if (!(today[0] || rule_today(today, error)) || !choose_rules(&f, compared, error))
            return false;
        parallel_for(result->count, apply_rule, &f);
    }
    result->verdict = DIFF_SAME;
    diff_count_findings(result);
    return true;
}
