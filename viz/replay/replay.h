/* SPDX-License-Identifier: MIT */
/* replay.h - opens a recording and replays it to any tick, with the game and the scene of that tick.
 *
 *   replay r;
 *   if (replay_open(&r, "frames", 0, &error) && replay_play_up_to(&r, 41, &error) &&
 *       playback_compose_scene(&r.playback, &error))
 *       ... octree_game_tick(r.playback.game), r.playback.scene ...
 *   replay_close(&r);
 */
#ifndef REPLAY_REPLAY_H
#define REPLAY_REPLAY_H

#include "session_file.h"
#include "film_options.h"
#include "playback.h"

typedef struct replay {
    session_file session;
    uint64_t session_digest; /* digest of the bytes of session.json */
    uint64_t ticks;          /* number of ticks of the session, including tick 0 */
    film_options film;       /* the folder and, from recording.json, the members `view` and `every` */
    /* The playback; it has a game and a scene after replay_open(), and a renderer after replay_renderer(). */
    playback playback;
} replay;

/* Read session.json and recording.json of a folder without playing the session. A session with more than `max_ticks`
 * ticks is refused; 0: SESSION_MOST_PLAYED. Call replay_close() after a failure too. */
bool replay_read(replay *r, const char *folder, uint64_t max_ticks, octreel_error *error);

/* Call replay_read() and play tick 0. `r` must not move in memory until it is closed. */
bool replay_open(replay *r, const char *folder, uint64_t max_ticks, octreel_error *error);
void replay_close(replay *r);

/* Play to a tick. If the tick is before the current tick, the session is played again from the start. Returns false
 * with an error on failure, and also if the session has no such tick. */
bool replay_play_up_to(replay *r, uint64_t tick, octreel_error *error);

/* Returns a renderer for the scenes of the recording. The first call opens the renderer; replay_close() closes the
 * renderer. Returns null with an error on failure. */
renderer *replay_renderer(replay *r, const renderer_choice *choice, octreel_error *error);

#endif
