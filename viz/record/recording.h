/* recording.h - a recording while it is made, by one process or by several: its folder, the files that are written
 * once, its lines and what they add up to. Private to this folder. */
#ifndef RECORD_RECORDING_H
#define RECORD_RECORDING_H

#include "take.h"
#include "tick_log.h"

typedef struct recording {
    const film_options *options;
    film_summary *summary;
    film_share share; /* the ticks that there are to record */
    tick_log log;
} recording;

/* Make the folder and write what is known before the first tick. `v` is the view that is filmed, fitted to tick 0.
 * *digest becomes that of session.json. A null session is not known yet, and is not written; *digest is then 0. Where
 * it fails nothing is left but what was there. */
bool recording_begin(recording *r, const octree_session *session, const view *v, const renderer_info *info,
                     uint64_t *digest, record_error *error);

/* Add the next tick: a film_sink, whose context is the recording. */
bool recording_add(void *context, const film_step *step, record_error *error);

/* Write what comes last, also of a recording that broke off (`ok` is false, and stays the result) or was stopped. */
bool recording_end(recording *r, bool ok, record_error *error);

/* Add a tick to a summary. */
void summary_add(film_summary *summary, const film_step *step);

#endif
