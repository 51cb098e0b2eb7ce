/* SPDX-License-Identifier: MIT */
/* velocity_layer.h - the scale of the velocity arrows. */
#ifndef LAYERS_VELOCITY_LAYER_H
#define LAYERS_VELOCITY_LAYER_H

#include "octree/game.h"

/* Return the number of ticks whose movement an arrow shows. The result is the largest of 1, 2, 5, 10 ... 1000 for which
 * the arrow of the session's fastest body is at most a tenth of the world's longest side. If even 1 is too large, the
 * result is 1. The number is the same at every tick. */
unsigned count_velocity_ticks(const octree_game *game);

#endif
