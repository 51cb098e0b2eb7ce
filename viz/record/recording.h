/* SPDX-License-Identifier: MIT */
/* recording.h - a recording while it is made, by one process or several: its folder, the files that are written once,
 * its lines, and what they add up to. Private to this folder. */
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
    film_share share;              /* the ticks that there are to record */
    const octree_session *session; /* null where it is not known yet, */
    session_bytes bytes;           /* without bytes then */
    tick_log log;
    replacement replaced; /* until a tick is filmed */
} recording;

/* Open what draws a playback of the session into the folder. */
bool recording_film(const recording *r, playback *p, octreel_error *error);

/* Make the folder, with what is known before the first tick of that playback; a session that is not known yet is not
 * written, and of one that is the bytes are released. Sets p->session_digest. Where it fails nothing is left but what
 * was there. */
bool recording_begin(recording *r, playback *p, octreel_error *error);

/* Add the next tick: a film_sink, whose context is the recording. */
bool recording_add(void *context, const film_step *step, octreel_error *error);

/* Write what comes last, also of a recording that broke off (`ok` is false, and stays the result) or was stopped. */
bool recording_end(recording *r, bool ok, octreel_error *error);

#endif
