/* SPDX-License-Identifier: MIT */
/* live.h - a session in the making becomes a recording: each tick is drawn and written when it comes, and the session
 * is written last. The recording is that of film_session() with the session that came out.
 *
 * While it goes on, what is known of the session is in session.json.live, a session file too: when the process dies,
 * nothing but the tick in hand is lost, and octreel record --resume makes a recording of the others. One thread films,
 * from open to close.
 */
#ifndef RECORD_LIVE_H
#define RECORD_LIVE_H

#include "film_options.h"

typedef struct live_recording live_recording;

/* Play tick 0 and open what draws it: the session has its start, its keys, and the queries and shapes of tick 0 or of
 * every tick, but no edits, and no gap but that of tick 0; its ticks are SESSION_ENDLESS where nobody knows how many
 * come. All arguments are copied. Of the options, chunk, jobs and resume are not read. Null with an error on failure.
 */
live_recording *live_open(const octree_session *start, const film_options *options, octreel_error *error);

/* Make the folder and begin its files. Where it fails no files are left, and only live_close() is. */
bool live_begin(live_recording *live, octreel_error *error);

/* Film tick 0. Where it fails the same holds. */
bool live_first(live_recording *live, octreel_error *error);

/* Film the next tick; with key 0 its key is the session's. After a failure only live_close() is left. */
bool live_tick(live_recording *live, const octree_input *input, octreel_error *error);

/* A tick after the session's end, which is not played, and is in session.json alone. */
bool live_note(live_recording *live, uint64_t tick, const octree_input *input, octreel_error *error);

/* Write what comes last, and free all memory: session.json with all ticks that were taken, and the page. `ticks` are
 * those of the session's header; *summary, which may be null, becomes the summary of all ticks that were filmed; a
 * session that would then be longer than what was taken ends with that. Where a tick failed, the files are those of a
 * recording that broke off, which --resume completes. False with an error when that cannot be written. */
bool live_close(live_recording *live, uint64_t ticks, film_summary *summary, octreel_error *error);

#endif
