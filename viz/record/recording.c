/* recording.c - see recording.h. */
#include "recording.h"
#include "folder_files.h"
#include "viewer.h"

static bool write_files(const recording *r, const octree_session *session, const view *v, const renderer_info *info,
                        uint64_t *digest, record_error *error)
{
    const char *folder = r->options->folder;
    return write_recording_file(folder, v, r->options->every, error) &&
           write_session_file(folder, session, digest, error) && write_renderer_file(folder, info, error);
}

bool recording_begin(recording *r, const octree_session *session, const view *v, const renderer_info *info,
                     uint64_t *digest, record_error *error)
{
    const char *folder = r->options->folder;
    if (!folder_prepare(folder, error) || !tick_log_open(&r->log, folder, "ticks.jsonl", error))
        return false;
    if (write_files(r, session, v, info, digest, error))
        return true;
    record_error ignored;
    tick_log_close(&r->log, &ignored);
    folder_abandon(folder);
    return false;
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

bool recording_add(void *context, const film_step *step, record_error *error)
{
    recording *r = context;
    if (!tick_log_add(&r->log, step->line, step->size, error))
        return false;
    summary_add(r->summary, step);
    if (r->options->progress)
        r->options->progress(r->summary->ticks, r->ticks, r->options->context);
    return true;
}

bool recording_end(recording *r, bool ok, record_error *error)
{
    record_error late;
    if (!tick_log_close(&r->log, ok ? error : &late))
        ok = false;
    return ok && viewer_write(r->options->folder, error);
}
