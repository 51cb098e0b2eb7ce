/* player.h - the player: its step, and the collision test that decides it. Private. */
#ifndef OCTREE_PLAYER_H
#define OCTREE_PLAYER_H

#include "octree/game.h"

bool game_is_key(char key);

/* Note where the player is, and was before the tick: of a body, what edits and motion have made of it. */
void game_find_player(octree_game *game);

/* Collect what the player's box meets into `hits`, by id: about the end of its step or, swept, on the way there. */
octree_status game_collide(octree_game *game, const double to[3]);

/* Make the step of the tick's key, unless the collision test or the tree forbids it. */
octree_status game_step_player(octree_game *game);

#endif
