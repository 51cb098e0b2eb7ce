/* SPDX-License-Identifier: MIT */
/* session.h - checks a session and loads its bodies. Private. */
#ifndef OCTREE_SESSION_H
#define OCTREE_SESSION_H

#include "octree/game.h"

/* The session's input for a tick, or for OCTREE_EVERY_TICK: its edits, queries, shapes, gap and foreign nodes, but not
 * its key. Cost: O(log n) for n of them. */
octree_input session_input(const octree_session *session, uint64_t tick);

/* Whether a key can be the key of a tick. All keys in game.h can, except q. */
bool is_game_key(char key);

/* Check a session whose tree could be created. Errors: those of octree_game_create. */
octree_status game_check_session(const octree_session *session, const octree *tree);

/* Insert the bodies of the game's session and record refusals. Returns OK, DUPLICATE or NO_MEMORY. */
octree_status game_load_bodies(octree_game *game);

#endif
