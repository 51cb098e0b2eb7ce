/* SPDX-License-Identifier: MIT */
/* extent.h - the bodies of a game as boxes: the game's tree shown as a set of bodies, and the overlapping pairs.
 * Private.
 */
#ifndef OCTREE_EXTENT_H
#define OCTREE_EXTENT_H

#include "game_state.h"

/* Show the points of the game's tree as bodies. */
void game_show_bodies(octree_game *game);

/* Update the reach of the shown bodies after bodies were added or removed. Call this function before a query of
 * game->shown. Cost: O(1), or O(bodies) if a body with extent was removed. */
void game_update_reach(octree_game *game);

/* List the pairs of bodies whose boxes have a common point, if the session wants them, and judge the pairs that a
 * foreign index found, if `given` is not null. Returns false if memory runs out. */
bool game_list_pairs(octree_game *game, const octree_foreign_pairs *given);

#endif
