/* SPDX-License-Identifier: MIT */
/* velocity_layer.h - the scale of the arrows. */
#ifndef LAYERS_VELOCITY_LAYER_H
#define LAYERS_VELOCITY_LAYER_H

#include "octree/game.h"

/* An arrow shows a body's movement over this many ticks: the largest of 1, 2, 5, 10 ... 1000 at which the fastest
 * body's arrow is at most a tenth of the world's longest side, at least 1. The same at every tick. */
unsigned velocity_ticks(const octree_game *game);

#endif
