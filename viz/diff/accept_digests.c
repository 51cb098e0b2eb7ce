/* SPDX-License-Identifier: MIT */
/* accept_digests.c - digests of new frames become those of a file. */
#include "accepting.h"
#include "digest_file.h"
#include "file.h"
#include "picture_store.h"

#include <stdlib.h>

/* Digests of version 1 say neither when nor why. */
static const char version_1[] = "taken over from version 1 of this file";

static bool upgrade(accepting *a, octreel_error *error)
{
    const acceptance_words words = {a->options->words.date, version_1};
    diff_side *side = &a->reference;
    side->baseline = true;
    for (size_t i = 0; i < side->count; i++)
        if (!baseline_accept(side, &words, &side->frames[i].digest, error))
            return false;
    return baseline_collect(side, error);
}

bool accept_check_words(accepting *a, octreel_error *error)
{
    const accept_options *o = a->options;
    if (a->reference.kind != DIFF_DIGESTS)
        return (!o->words.reason && !o->store && !o->variant) ||
               error_set(error, "%s: --reason, --store and --variant are for a file of digests, and this is none",
                         o->reference);
    if (!o->words.reason)
        return !(a->reference.baseline || o->store || o->variant) ||
               error_set(error, "%s: a baseline says why: give --reason TEXT", o->reference);
    return a->reference.baseline || upgrade(a, error);
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

/* Of all frames that are accepted now, so that a store that was lost fills again. */
static bool store_pictures(const accepting *a, octreel_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && a->options->store && i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (pair->b && (a->actions[i] != KEPT || pair->finding == FOUND_SAME_PIXELS))
            ok = picture_store_put(a->options->store, pair->b->path, &pair->about[1], a->reference.background, error);
    }
    return ok;
}

/* ---- Digests ------------------------------------------------------------------------------------------------- */

static bool keep_digests(diff_side *now, const diff_frame *frame, octreel_error *error)
{
    const frame_digest *digests;
    const size_t count = diff_frame_digests(frame, &digests);
    return now->baseline ? baseline_add(now, frame->name, digests, count, error)
                         : diff_side_add(now, frame->name, frame->digest, error);
}

/* The new digest, and those of before where they stay accepted. */
static bool take_over(const accepting *a, diff_side *now, const diff_pair *pair, octreel_error *error)
{
    frame_digest digest = pair->about[1];
    if (!now->baseline)
        return diff_side_add(now, pair->b->name, digest, error);
    if (!baseline_accept(now, &a->options->words, &digest, error))
        return false;
    const frame_digest *before = NULL;
    const size_t count = pair->a && a->options->variant ? diff_frame_digests(pair->a, &before) : 0;
    frame_digest *all = malloc((count + 1) * sizeof *all);
    if (!all)
        return error_no_memory(error);
    for (size_t i = 0; i < count; i++)
        all[i] = before[i];
    all[count] = digest;
    const bool ok = baseline_add(now, pair->b->name, all, count + 1, error);
    free(all);
    return ok;
}

static bool write_file(const diff_side *now, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open_replacing(&file, now->path, error))
        return false;
    file.lasting = true;
    const bool written =
        now->baseline ? baseline_write(file.stream, now, error) : digest_file_write(file.stream, now, error);
    return written ? file_writer_close(&file, error) : file_writer_abandon(&file);
}

/* All references as they are now; those that stay keep their digests. */
bool accept_digests(accepting *a, octreel_error *error)
{
    diff_side now = {.path = a->reference.path,
                     .kind = DIFF_DIGESTS,
                     .background = a->reference.background,
                     .baseline = a->reference.baseline,
                     .acceptances = a->reference.acceptances,
                     .acceptance_count = a->reference.acceptance_count,
                     .acceptance_room = a->reference.acceptance_room};
    a->reference.acceptances = NULL; /* they are the other's now */
    a->reference.acceptance_count = 0;
    bool ok = store_pictures(a, error);
    for (size_t i = 0; ok && i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (a->actions[i] == CHANGED || a->actions[i] == ADDED)
            ok = take_over(a, &now, pair, error);
        else if (a->actions[i] == KEPT && pair->a)
            ok = keep_digests(&now, pair->a, error);
    }
    ok = ok && write_file(&now, error);
    diff_side_release(&now);
    return ok;
}
