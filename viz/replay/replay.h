/* replay.h - a recording is opened and played again: what happened at a tick, and the scene that its frame is of.
 *
 *   replay r;
 *   if (replay_open(&r, "frames", &error) && replay_to(&r, 41, &error) && replay_scene(&r, &error))
 *       ... octree_game_tick(r.take.game), r.take.scene ...
 *   replay_close(&r);
 */
#ifndef RECORD_REPLAY_H
#define RECORD_REPLAY_H

#include "session_file.h"
#include "take.h"

typedef struct replay {
    session_file session;
    uint64_t session_digest; /* of the bytes of session.json */
    uint64_t ticks;          /* tick 0 included */
    film_options film;       /* the folder, and what recording.json has: the view, and each how many ticks a frame is */
    take take;               /* once it is opened: the game, and the scene; the renderer, once there is one */
} replay;

/* Read session.json and recording.json of a folder, and play nothing yet. `r` is set in any case, to be closed. */
bool replay_read(replay *r, const char *folder, octreel_error *error);

/* The same, and play tick 0. `r` must stay where it is until it is closed. */
bool replay_open(replay *r, const char *folder, octreel_error *error);
void replay_close(replay *r);

/* Play up to a tick; from the start again where it lies behind. False with a sentence also where there is none. */
bool replay_to(replay *r, uint64_t tick, octreel_error *error);

/* Make the scene of the tick that was played last, as the recording's view shows it: r->take.scene. */
bool replay_scene(replay *r, octreel_error *error);

/* What draws such scenes, opened when it is asked for first; the replay closes it. Null with the sentence. */
renderer *replay_renderer(replay *r, const renderer_choice *choice, octreel_error *error);

#endif
