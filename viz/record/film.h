/* SPDX-License-Identifier: MIT */
/* film.h - records a session: plays every tick, draws it and writes its files. */
#ifndef RECORD_FILM_H
#define RECORD_FILM_H

#include "film_options.h"
#include "session_stream.h"
#include "tick_scene.h"

/* Record a session, or a chunk of it, into a folder. After a failure each file is whole: frames are written by rename,
 * and ticks.jsonl (ticks_A_B.jsonl for a chunk) ends with the last finished tick; index.html is written last. A
 * recording that failed or was stopped can be resumed; the result has the same bytes as an uninterrupted one. No file
 * is created when the session, the size or the chunk is refused. */
bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error);

/* How recording a stream ended. */
typedef enum film_stream_end {
    FILM_STREAM_WHOLE,   /* at the end of the stream */
    FILM_STREAM_STOPPED, /* keep_going() of the stream or of options->watch returned false */
    FILM_STREAM_BROKEN,  /* with an error */
} film_stream_end;

/* Record a session from a stream that may still be written: each tick as soon as its object arrives, together with
 * ticks before it that have no object. The recording is the same as that of film_session() for the same text. If the
 * stream breaks or is stopped, the recording is that of a session that ends with the last tick that arrived.
 * summary->ticks is then their number, 0 if there is no recording. The options first, last, jobs and resume are not
 * read. `keys`, unless null, replace the keys of the stream. */
film_stream_end film_stream(session_stream *from, const char *keys, const film_options *options, film_summary *summary,
                            octreel_error *error);

/* Count the points that tick 0 of a session refused. */
film_start film_count_start(const octree_session *session, const octree_tick *tick);

/* The default number of jobs: one per core, but few enough that each has several frames to film. */
unsigned film_default_jobs(const octree_session *session, const film_options *options);

/* Draw one tree with the view and the renderer of the options, and write it as a PNG. */
bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error);

#endif
