/* SPDX-License-Identifier: MIT */
/* film.h - records a session: plays every tick, draws it and writes its files. */
#ifndef RECORD_FILM_H
#define RECORD_FILM_H

#include "film_options.h"
#include "session_stream.h"
#include "tick_scene.h"

/* Record a session, or a chunk of it, into a folder. If this fails, every file in the folder is still whole: frames are
 * written by rename, ticks.jsonl (ticks_A_B.jsonl for a chunk) ends with the last finished tick, and index.html is
 * written last. A recording that failed or was stopped can be resumed, and then has the same bytes as an uninterrupted
 * recording. An invalid session, size or chunk is reported before any file is created. */
bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error);

/* The reason why film_stream() returned. */
typedef enum film_stream_end {
    FILM_STREAM_WHOLE,   /* the stream ended, and all its ticks are recorded */
    FILM_STREAM_STOPPED, /* keep_going() of the stream or of options->watch returned false */
    FILM_STREAM_BROKEN,  /* the stream was invalid or unreadable, or the recording could not be written; see *error */
} film_stream_end;

/* Record a session from a stream to which another process may still write. A tick is recorded as soon as its JSON
 * object arrives, after all earlier ticks that have no object. The files are the same as those of film_session() for
 * the same text. If the stream breaks or is stopped, the recording ends with the last tick that arrived. summary->ticks
 * is then the number of recorded ticks, 0 if there is no recording. The options first, last, jobs and resume are
 * ignored. `keys`: the player's key presses, one character per tick, which replace the key presses in the stream; null:
 * the key presses in the stream are used. */
film_stream_end film_stream(session_stream *from, const char *keys, const film_options *options, film_summary *summary,
                            octreel_error *error);

/* Count the session's points, and the points that tick 0 refused. */
film_start film_count_start_points(const octree_session *session, const octree_tick *tick);

/* Returns the default number of jobs: at most one per core, and so few that each job films at least 16 frames. */
unsigned film_default_jobs(const octree_session *session, const film_options *options);

/* Draw one tree with the view and the renderer in `options`, and write the picture as a PNG file. */
bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error);

#endif
