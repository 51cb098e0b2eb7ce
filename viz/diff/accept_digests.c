/* SPDX-License-Identifier: MIT */
/* accept_digests.c - accepts frames into a baseline: writes their digests and, with --store, stores their pictures. */
#include "accepting.h"
#include "file.h"
#include "history.h"
#include "picture_store.h"

#include <stdlib.h>

/* Store the pictures of all frames in the new baseline. The pictures of unchanged frames are stored, too, so that
 * the store becomes complete even if it was empty. */
static bool store_pictures(const accepting *a, octreel_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && a->options->store && i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (pair->b && (a->actions[i] != KEPT || pair->finding == FOUND_SAME_PIXELS))
            ok = picture_store_add(a->options->store, pair->b->path, &pair->about[1], a->reference.background, error);
    }
    return ok;
}

/* Add a changed or new frame to the new baseline `now`: its digest and, with --variant, its previously accepted
 * digests. */
static bool add_accepted_frame(const accepting *a, diff_side *now, const diff_pair *pair, octreel_error *error)
{
    frame_digest digest = pair->about[1];
    if (!baseline_add_acceptance(now, &a->options->note, &digest, error))
        return false;
    const bool keeps = pair->a && a->options->variant;
    return baseline_add_frame(now, pair->b->name, keeps ? pair->a->variants : &digest,
                              keeps ? pair->a->variant_count : 1, error) &&
           (baseline_add_variant(&now->frames[now->count - 1], &digest) || error_no_memory(error));
}

static bool write_baseline_file(const diff_side *now, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open_replacing(&file, now->path, error))
        return false;
    file.lasting = true;
    return baseline_write(file.stream, now, error) ? file_writer_close(&file, error) : file_writer_discard(&file);
}

/* Move the digests that are not accepted any more to the history. */
static bool update_history(const accepting *a, const diff_side *now, octreel_error *error)
{
    history h;
    bool ok = history_read(&h, now->path, error);
    const size_t before = h.count;
    for (size_t i = 0; ok && i < a->result.count; i++)
        if (a->actions[i] == CHANGED && a->result.pairs[i].a)
            ok = history_add_frame(&h, now, a->result.pairs[i].a, error);
    ok = ok && (h.count == before || history_write(&h, now, error));
    history_release(&h);
    return ok;
}

bool accept_digests(accepting *a, octreel_error *error)
{
    diff_side now = a->reference;
    now.frames = NULL;
    now.count = now.room = 0;
    a->reference.acceptances = NULL; /* `now` owns the acceptances and the rules from here on */
    a->reference.rules = NULL;
    a->reference.notes = NULL;
    a->reference.acceptance_count = a->reference.rule_count = a->reference.notes_size = 0;
    bool ok = store_pictures(a, error);
    for (size_t i = 0; ok && i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (a->actions[i] == CHANGED || a->actions[i] == ADDED)
            ok = add_accepted_frame(a, &now, pair, error);
        else if (a->actions[i] == KEPT && pair->a)
            ok = baseline_add_frame(&now, pair->a->name, pair->a->variants, pair->a->variant_count, error);
    }
    ok = ok && update_history(a, &now, error) && write_baseline_file(&now, error);
    diff_side_release(&now);
    return ok;
}
