/* SPDX-License-Identifier: MIT */
/* session.h - checking a session and loading its bodies. Private. */
#ifndef OCTREE_SESSION_H
#define OCTREE_SESSION_H

#include "octree/game.h"

/* The session's edits, queries, shapes, gap and foreign nodes for a tick, or for OCTREE_EVERY_TICK; no key. Cost: O(log
 * of their number).
 */
octree_input session_input(const octree_session *session, uint64_t tick);

bool game_is_key(char key);

/* What octree_game_create says of a session whose tree could be made. */
octree_status game_check_session(const octree_session *session, const octree *tree);

/* Insert the bodies of the game's session. DUPLICATE, NO_MEMORY or OK: refusals are noted. */
octree_status game_load_bodies(octree_game *game);

#endif
