/* SPDX-License-Identifier: MIT */
/* live.h - records a session whose ticks are not known in advance, such as that of a running program.
 *
 * Use a live recording from one thread only, from open to close.
 */
#ifndef RECORD_LIVE_H
#define RECORD_LIVE_H

#include "film_options.h"

typedef struct live_recording live_recording;

/* Play tick 0 and open a renderer. `start` has the points, the keys, and the queries and shapes of tick 0 and of every
 * tick, but no edits, and no gap except at tick 0. start->ticks is SESSION_ENDLESS where the number of ticks is
 * unknown. All arguments are copied. The options first, last, jobs and resume are not read. Null with an error. */
live_recording *live_open(const octree_session *start, const film_options *options, octreel_error *error);

/* Create the folder and its first files. After a failure no files are left, and only live_close() may be called. */
bool live_begin(live_recording *live, octreel_error *error);

/* Record tick 0. After a failure no files are left, and only live_close() may be called. */
bool live_film_first(live_recording *live, octreel_error *error);

/* Record the next tick. If input->key is 0, the key is that of the session. After a failure only live_close() may be
 * called. */
bool live_film_tick(live_recording *live, const octree_input *input, octreel_error *error);

/* Add a tick after the end of the session: it is written to session.json but not played. */
bool live_add_unplayed(live_recording *live, uint64_t tick, const octree_input *input, octreel_error *error);

/* Check the last frame, write session.json with all ticks and the page, and free all memory. `ticks` is the number of
 * ticks in the session's header; a session that would be longer than what was recorded ends with the last recorded
 * tick. *summary, which may be null, becomes the summary. After a tick that failed, the files are those of an
 * interrupted recording, which --resume completes. False with an error where the last frame is wrong or a file cannot
 * be written. */
bool live_close(live_recording *live, uint64_t ticks, film_summary *summary, octreel_error *error);

#endif
