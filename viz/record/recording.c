/* SPDX-License-Identifier: MIT */
/* recording.c - writes all files of a recording except the frames. */
#include "recording.h"

#include <stdlib.h>

/* ---- The start ---------------------------------------------------------------------------------------------- */

bool recording_open_picture(const recording *r, playback *p, octreel_error *error)
{
    const film_options *o = r->options;
    const playback_target target = {
        .frames = o->resume ? FRAMES_KEEP : FRAMES_WRITE,
        .folder = o->folder,
        .every = o->every,
        .renderer = o->renderer,
    };
    return playback_open_picture(p, &target, error);
}

/* The data that are known when a recording begins, before its first tick. */
typedef struct beginning {
    const view *view;
    renderer_info info; /* the renderer; set only if there are frames */
} beginning;

static bool write_first_files(const recording *r, const folder_place *place, const beginning *b, octreel_error *error)
{
    return write_recording_file(place, b->view, r->options->every, error) &&
           (!r->bytes.bytes || write_session_file(place, &r->bytes, error)) &&
           (r->options->every == 0 || write_renderer_file(place, &b->info, error));
}

static bool open_log(recording *r, octreel_error *error)
{
    char name[CHUNK_NAME] = "ticks.jsonl";
    if (recording_is_chunk(r))
        chunk_print_name(r->share.first, r->share.last, name);
    return tick_log_open(&r->log, r->options->folder, name, r->options->resume, error);
}

/* Begin a recording in a folder that has no recording, or replace the recording in the folder. ticks.jsonl is created
 * first, because its lock keeps other processes out of the folder. */
static bool begin_whole_recording(recording *r, const beginning *b, octreel_error *error)
{
    const char *folder = r->options->folder;
    octreel_error late;
    if (r->options->replace ? !replacement_begin(&r->replaced, folder, error)
                            : !folder_create_for_recording(folder, error))
        return false;
    if (!open_log(r, error)) {
        replacement_undo(&r->replaced);
        return false;
    }
    const folder_place place = {.folder = folder};
    if (write_first_files(r, &place, b, error))
        return true;
    tick_log_close(&r->log, false, &late);
    folder_remove_recording_files(folder);
    replacement_undo(&r->replaced);
    return false;
}

/* Check that the file of the chunk does not exist, for a chunk that is not resumed. Otherwise returns false with an
 * error. */
static bool check_new_chunk(const recording *r, octreel_error *error)
{
    char name[CHUNK_NAME];
    return !folder_contains(r->options->folder, chunk_print_name(r->share.first, r->share.last, name)) ||
           error_set(error, "%s: already holds this chunk (%s); use --resume to complete it", r->options->folder, name);
}

/* Begin a recording in a folder that may already contain a part of it. Other processes may be recording other chunks
 * into this folder. A dry run and all checks come first, so that a folder with a different recording stays
 * unchanged. */
static bool begin_chunk_of_recording(recording *r, const beginning *b, octreel_error *error)
{
    char writer[CHUNK_NAME];
    const film_options *o = r->options;
    const uint64_t ticks = octree_session_length(r->session) + 1;
    const folder_place dry_run = {.folder = o->folder, .dry_run = true},
                       place = {.folder = o->folder, .writer = chunk_print_name(r->share.first, r->share.last, writer)};
    return folder_create(o->folder, error) && (o->resume || check_new_chunk(r, error)) &&
           write_first_files(r, &dry_run, b, error) &&
           check_resumable(o->folder, r->bytes.digest, ticks, o->every, error) &&
           write_first_files(r, &place, b, error) && open_log(r, error);
}

bool recording_begin(recording *r, playback *p, octreel_error *error)
{
    beginning b = {.view = &p->view};
    if (r->options->every > 0)
        b.info = renderer_describe(p->picture.renderer);
    p->session_digest = r->bytes.digest;
    const bool begun =
        (recording_is_chunk(r) || r->options->resume ? begin_chunk_of_recording : begin_whole_recording)(r, &b, error);
    free(r->bytes.bytes);
    r->bytes.bytes = NULL;
    return begun;
}

/* ---- Tick by tick ------------------------------------------------------------------------------------------- */

static void add_to_summary(film_summary *summary, const film_step *step)
{
    summary->ticks++;
    summary->frames += step->filmed;
    summary->kept += step->kept;
    summary->gaps += step->gap;
    summary->left_out += step->left_out;
    summary->over_budget += step->over_budget != 0;
    summary->below_lod += step->below_lod != 0;
    summary->beyond |= step->over_budget;
    summary->small |= step->below_lod;
    summary->foreign_nodes += step->foreign_nodes;
    summary->refusals += step->refusals;
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        summary->events[i] += step->events >> i & 1;
}

bool recording_add_tick(void *context, const film_step *step, octreel_error *error)
{
    recording *r = context;
    if (!tick_log_add(&r->log, step->line, step->size, error))
        return false;
    if (r->page && !page_add_tick(r->page, r->log.path, step->line, step->size, error))
        return false;
    replacement_remove_old(&r->replaced);
    add_to_summary(r->summary, step);
    watcher_report(&r->options->watch, r->summary->ticks, r->summary->total);
    return true;
}

bool recording_end(recording *r, bool ok, octreel_error *error)
{
    octreel_error late;
    const char *folder = r->options->folder;
    const bool whole = ok && r->summary->ticks == r->summary->total;
    ok = tick_log_close(&r->log, whole, ok ? error : &late) && ok;
    if (replacement_undo(&r->replaced) || !ok || recording_is_chunk(r))
        return ok;
    if (whole && r->options->resume)
        replacement_remove_leftovers(folder);
    return page_write(r->page, folder, r->session, r->options->values, error) &&
           (!whole || !r->options->resume || folder_remove_leftovers(folder, error));
}
