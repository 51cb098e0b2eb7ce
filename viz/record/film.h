/* SPDX-License-Identifier: MIT */
/* film.h - a session becomes a recording: every tick played, drawn and written. */
#ifndef RECORD_FILM_H
#define RECORD_FILM_H

#include "film_options.h"
#include "session_stream.h"
#include "tick_scene.h"

/* Film a session, or a chunk of it, into a folder. On failure what is there is whole: frames are written by rename, and
 * the lines of ticks.jsonl (of a chunk, ticks_A_B.jsonl) end with the last tick that was finished; index.html comes
 * last. A recording that broke off or was stopped can be resumed, and is then the same bytes as one that was not.
 * Nothing is made where the session, the size or the chunk is refused. */
bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error);

/* How a stream was filmed. */
typedef enum film_stream_end {
    FILM_STREAM_WHOLE,   /* to its end */
    FILM_STREAM_STOPPED, /* until keep_going() said so, of the stream or of the options */
    FILM_STREAM_BROKEN,  /* up to what the error says */
} film_stream_end;

/* Film a session while it is written: each tick as soon as its object has come, and those before it that have none. The
 * recording is that of film_session() with the same text. Where the stream is broken or stopped, it is that of a
 * session that ends with the last tick that came: summary->ticks, of which there are none where nothing was begun. Of
 * the options, a chunk, jobs and resume are not read. `keys` are played in place of the stream's; null: they are not.
 */
film_stream_end film_stream(session_stream *from, const char *keys, const film_options *options, film_summary *summary,
                            octreel_error *error);

/* What tick 0 of a session refused. */
film_start film_count_start(const octree_session *session, const octree_tick *tick);

/* As many processes as this machine has cores, but no more than have a few frames to film each. */
unsigned film_default_jobs(const octree_session *session, const film_options *options);

/* Draw one tree, with the view and the renderer of the options, and write it as a PNG: the one frame of *summary. */
bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error);

#endif
