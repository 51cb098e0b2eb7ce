/* SPDX-License-Identifier: MIT */
/* recording.h - writes the files of a recording other than frames: the files at its start, the lines of ticks.jsonl,
 * and the page at its end; sums up its ticks. Private to this folder. */
#ifndef RECORD_RECORDING_H
#define RECORD_RECORDING_H

#include "film_options.h"
#include "folder_files.h"
#include "playback.h"
#include "replacement.h"
#include "tick_log.h"

typedef struct recording {
    const film_options *options;
    film_summary *summary;
    film_share share;              /* the ticks to record */
    const octree_session *session; /* null: not known yet */
    session_bytes bytes;           /* of session.json; without bytes if it is not known yet */
    tick_log log;
    replacement replaced; /* the recording that is replaced, until a tick is filmed */
} recording;

/* Call playback_open_picture() with the options of the recording. */
bool recording_open_picture(const recording *r, playback *p, octreel_error *error);

/* Create the folder and write the files that come before the first tick; session.json only if the session is known.
 * Frees r->bytes and sets p->session_digest. A failure leaves the folder as it was. */
bool recording_begin(recording *r, playback *p, octreel_error *error);

/* Write the line of the next tick. A film_sink, with the recording as its context. */
bool recording_add_tick(void *context, const film_step *step, octreel_error *error);

/* Close ticks.jsonl and write the page, also after a failure (`ok` is false, and so is the result) or a stop. */
bool recording_end(recording *r, bool ok, octreel_error *error);

#endif
