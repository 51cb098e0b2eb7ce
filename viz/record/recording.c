/* recording.c - see recording.h. */
#include "recording.h"
#include "claim.h"
#include "folder_files.h"
#include "chunks.h"
#include "page.h"

#include <stdlib.h>

static bool is_part(const recording *r)
{
    return r->options->last != 0;
}

static bool write_files(const recording *r, const folder_place *place, const view *v, const renderer_info *info,
                        octreel_error *error)
{
    return write_recording_file(place, v, r->options->every, error) &&
           (!r->session || write_session_file(place, &r->written, error)) && write_renderer_file(place, info, error);
}

static bool open_log(recording *r, octreel_error *error)
{
    char name[CHUNK_NAME] = "ticks.jsonl";
    if (is_part(r))
        chunk_name(r->share.first, r->share.last, name);
    return tick_log_open(&r->log, r->options->folder, name, r->options->resume, error);
}

/* A folder of its own. The log comes first: who opened it has the folder. */
static bool begin_alone(recording *r, const view *v, const renderer_info *info, octreel_error *error)
{
    const char *folder = r->options->folder;
    octreel_error late;
    if (!folder_prepare(folder, error) || !open_log(r, error))
        return false;
    const folder_place place = {.folder = folder};
    if (write_files(r, &place, v, info, error))
        return true;
    tick_log_close(&r->log, false, &late);
    folder_abandon(folder);
    return false;
}

/* Without being told so, nothing is filmed twice. */
static bool check_new_part(const recording *r, octreel_error *error)
{
    char name[CHUNK_NAME];
    return !folder_has(r->options->folder, chunk_name(r->share.first, r->share.last, name)) ||
           error_set(error, "%s: already holds this part (%s); --resume completes what is there of it",
                     r->options->folder, name);
}

/* A folder that may be that of this recording already, and that others may be filming into. The log comes last: what is
 * there stays unless the recording is this one. */
static bool begin_shared(recording *r, const view *v, const renderer_info *info, octreel_error *error)
{
    char writer[CHUNK_NAME];
    const film_options *o = r->options;
    const folder_place look = {.folder = o->folder, .look = true},
                       place = {.folder = o->folder, .writer = chunk_name(r->share.first, r->share.last, writer)};
    return folder_make(o->folder, error) && (o->resume || check_new_part(r, error)) &&
           write_files(r, &look, v, info, error) && claim_folder(r->session, r->written.digest, o, error) &&
           write_files(r, &place, v, info, error) && open_log(r, error);
}

bool recording_prepare(recording *r, octreel_error *error)
{
    return make_session_bytes(r->session, &r->written, error);
}

bool recording_begin(recording *r, const view *v, const renderer_info *info, octreel_error *error)
{
    const bool begun = (is_part(r) || r->options->resume ? begin_shared : begin_alone)(r, v, info, error);
    free(r->written.bytes);
    r->written.bytes = NULL;
    return begun;
}

void summary_add(film_summary *summary, const film_step *step)
{
    summary->ticks++;
    summary->frames += step->filmed;
    summary->left_out += step->left_out;
    summary->over_budget += step->over_budget;
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        summary->events[i] += step->events >> i & 1;
}

bool recording_add(void *context, const film_step *step, octreel_error *error)
{
    recording *r = context;
    if (!tick_log_add(&r->log, step->line, step->size, error))
        return false;
    summary_add(r->summary, step);
    if (r->options->progress)
        r->options->progress(r->summary->ticks, r->summary->total, r->options->context);
    return true;
}

bool recording_end(recording *r, bool ok, octreel_error *error)
{
    octreel_error late;
    const char *folder = r->options->folder;
    const bool whole = ok && r->summary->ticks == r->summary->total;
    ok = tick_log_close(&r->log, whole, ok ? error : &late) && ok;
    if (!ok || is_part(r))
        return ok;
    return viewer_write(folder, error) && (!whole || !r->options->resume || folder_sweep(folder, error));
}
