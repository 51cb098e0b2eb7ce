/* SPDX-License-Identifier: MIT */
/* game_fixture.h - a small session and functions to play it, for tests of the game. */
#ifndef GAME_FIXTURE_H
#define GAME_FIXTURE_H

#include "octree/game.h"

/* The player, id 100, rests in the middle of [-10, 10]^3: step 1, box size 0.5. Capacity 2, depth 5. */
octree_session small_session(const octree_game_body *bodies, size_t body_count);

/* Create the game of a session; the test fails if that fails. */
octree_game *start_game(const octree_session *session);

/* Play one key; the test fails if the game fails or its tree violates an invariant. */
const octree_tick *play_key(octree_game *game, char key);

#endif
