/* recording.h - a recording while it is made, by one process or by several: its folder, the files that are written
 * once, its lines and what they add up to. Private to this folder. */
#ifndef RECORD_RECORDING_H
#define RECORD_RECORDING_H

#include "folder_files.h"
#include "playback.h"
#include "tick_log.h"

typedef struct recording {
    const film_options *options;
    film_summary *summary;
    film_share share;              /* the ticks that there are to record */
    const octree_session *session; /* what is played; null where that is not known yet */
    session_bytes written;         /* session.json, from when it is prepared until it is there; its digest stays */
    tick_log log;
} recording;

/* Put the session into words, which is most of what is to be done before the first tick: no file is touched. The caller
 * frees written.bytes, where they are still there. */
bool recording_prepare(recording *r, octreel_error *error);

/* Make the folder and write what is known before the first tick. `v` is the view that is filmed, fitted to tick 0. A
 * session that is not known yet is not written. Where it fails nothing is left but what was there. */
bool recording_begin(recording *r, const view *v, const renderer_info *info, octreel_error *error);

/* Add the next tick: a film_sink, whose context is the recording. */
bool recording_add(void *context, const film_step *step, octreel_error *error);

/* Write what comes last, also of a recording that broke off (`ok` is false, and stays the result) or was stopped. */
bool recording_end(recording *r, bool ok, octreel_error *error);

/* Add a tick to a summary. */
void summary_add(film_summary *summary, const film_step *step);

#endif
