/* SPDX-License-Identifier: MIT */
/* replay.h - opens a recording and plays it to any tick: its game, and the scene of its frame.
 *
 *   replay r;
 *   if (replay_open(&r, "frames", &error) && replay_to(&r, 41, &error) && playback_scene(&r.playback, &error))
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
    uint64_t session_digest; /* of the bytes of session.json */
    uint64_t ticks;          /* of the session, tick 0 included */
    film_options film;       /* the folder, and the view and `every` of recording.json */
    playback playback;       /* after replay_open(): the game, the scene, and the renderer once it is opened */
} replay;

/* Read session.json and recording.json of a folder, and play nothing yet. Close `r` in any case. */
bool replay_read(replay *r, const char *folder, octreel_error *error);

/* The same, and play tick 0. `r` must stay where it is until it is closed. */
bool replay_open(replay *r, const char *folder, octreel_error *error);
void replay_close(replay *r);

/* Play to a tick; from the start again where it lies before the last one. False, with a sentence, also where the
 * session has no such tick. */
bool replay_to(replay *r, uint64_t tick, octreel_error *error);

/* The renderer of such scenes, opened at the first call and closed by replay_close(). Null with an error. */
renderer *replay_renderer(replay *r, const renderer_choice *choice, octreel_error *error);

#endif
