/* SPDX-License-Identifier: MIT */
/* session.h - checks a session and loads its bodies. Private. */
#ifndef OCTREE_SESSION_H
#define OCTREE_SESSION_H

#include "octree/game.h"

/* Returns the session's input for a tick, or for OCTREE_EVERY_TICK: the edits, queries, shapes, gap, foreign nodes
 * and foreign pairs, but not the player's key. Cost: O(log n) for n items in the session. */
octree_input session_input(const octree_session *session, uint64_t tick);

/* Returns whether a key is one of the keys of game.h that play a tick: every key except q, which ends the session. */
bool is_game_key(char key);

/* Check a session. `tree` is the empty tree of the session. Returns the errors that octree_game_create() documents. */
octree_status game_check_session(const octree_session *session, const octree *tree);

/* Insert the bodies of the game's session and record refusals. Returns OK, DUPLICATE or NO_MEMORY. */
octree_status game_load_bodies(octree_game *game);

#endif
