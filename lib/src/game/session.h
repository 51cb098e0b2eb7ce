/* SPDX-License-Identifier: MIT */
/* session.h - checking a session and loading its bodies. Private. */
#ifndef OCTREE_SESSION_H
#define OCTREE_SESSION_H

#include "octree/game.h"

/* The session's edits, queries, shapes, gap and foreign nodes of a tick, or of OCTREE_EVERY_TICK, without the key.
 * Cost: O(log n) for n of them. */
octree_input session_input(const octree_session *session, uint64_t tick);

/* Whether a key plays a tick: any key of game.h except q. */
bool game_is_key(char key);

/* Check a session whose tree could be created. Errors: those of octree_game_create. */
octree_status game_check_session(const octree_session *session, const octree *tree);

/* Insert the bodies of the game's session and record refusals. Returns OK, DUPLICATE or NO_MEMORY. */
octree_status game_load_bodies(octree_game *game);

#endif
