/* SPDX-License-Identifier: MIT */
/* recording.h - writes all files of a recording except the frames: the files at its start, the lines of ticks.jsonl,
 * and the page at its end. Also counts events, frames and gaps for the summary. Private to viz/record. */
#ifndef RECORD_RECORDING_H
#define RECORD_RECORDING_H

#include "film_options.h"
#include "folder_files.h"
#include "page.h"
#include "playback.h"
#include "replacement.h"
#include "tick_log.h"

typedef struct recording {
    const film_options *options;
    film_summary *summary;
    film_share share;              /* the ticks to record */
    const octree_session *session; /* the session; null while it is not yet complete, as in a live recording */
    /* The bytes and the digest of session.json; no bytes while the session is not yet complete. */
    session_bytes bytes;
    tick_log log;
    /* The old recording that is being replaced; kept until tick 0 of the new recording is filmed. */
    replacement replaced;
    /* A page that gets each tick as it is recorded; not null only where that takes no time of the process that films.
     * Otherwise the page is made at the end, from the files. */
    page_writer *page;
} recording;

/* Returns whether only a part of the ticks is recorded, into a file of its own. */
static inline bool recording_is_chunk(const recording *r)
{
    return r->options->last != 0;
}

/* Call playback_open_picture() with the options of the recording. */
bool recording_open_picture(const recording *r, playback *p, octreel_error *error);

/* Create the folder and write the files that come before the first tick. session.json is written only if the session is
 * complete. Frees r->bytes and sets p->session_digest. If this fails, the folder stays as it was. */
bool recording_begin(recording *r, playback *p, octreel_error *error);

/* Write the line of the next tick to ticks.jsonl. This function is a film_sink, whose context is the recording. */
bool recording_add_tick(void *context, const film_step *step, octreel_error *error);

/* Close ticks.jsonl and write the page; also called after a stop or a failure. The page is not written for a chunk,
 * after a failure, or if the old recording of a replacement is moved back. `ok` is false after a failure, and the
 * result is then false too. */
bool recording_end(recording *r, bool ok, octreel_error *error);

#endif
