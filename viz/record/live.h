/* SPDX-License-Identifier: MIT */
/* live.h - records a session whose ticks are not known in advance, for example while a program runs.
 *
 * A live recording must be used by one thread only, from live_open() to live_close(). */
#ifndef RECORD_LIVE_H
#define RECORD_LIVE_H

#include "film_options.h"

typedef struct live_recording live_recording;

/* Play tick 0 and open a renderer. `start` contains the points, the player's key presses, the queries and shapes of
 * tick 0, and the queries and shapes that belong to every tick. It contains no edits, and no gap except at tick 0.
 * start->ticks is SESSION_ENDLESS if the number of ticks is unknown. All arguments are copied. The options first, last,
 * jobs and resume are ignored. Returns null with an error on failure. */
live_recording *live_open(const octree_session *start, const film_options *options, octreel_error *error);

/* Create the folder and the first files of the recording. If this fails, the created files are removed again, and only
 * live_close() may be called afterwards. */
bool live_begin(live_recording *live, octreel_error *error);

/* Record tick 0. If this fails, all files of the recording are removed, and only live_close() may be called
 * afterwards. */
bool live_film_first_tick(live_recording *live, octreel_error *error);

/* Returns the game of the recording, which has played the ticks that are recorded. */
const octree_game *live_game(const live_recording *live);

/* Record the next tick. If input->key is 0, the key press that the session has for this tick is used. If this fails,
 * only live_close() may be called afterwards. */
bool live_film_tick(live_recording *live, const octree_input *input, octreel_error *error);

/* Add a tick to session.json after the session's last tick. The tick is not played. */
bool live_add_unplayed(live_recording *live, uint64_t tick, const octree_input *input, octreel_error *error);

/* Check the last frame, write session.json with all ticks, write the page, and free all memory. `ticks` is the number
 * of ticks for the session's header; if fewer ticks were recorded, the session ends with the last recorded tick.
 * `summary` may be null. If a tick has failed, the files are left as those of an interrupted recording, which octreel
 * record --resume completes. Returns false with an error if the last frame is wrong or a file cannot be written. */
bool live_close(live_recording *live, uint64_t ticks, film_summary *summary, octreel_error *error);

#endif
