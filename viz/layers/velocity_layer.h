/* velocity_layer.h - the scale of the arrows. */
#ifndef LAYERS_VELOCITY_LAYER_H
#define LAYERS_VELOCITY_LAYER_H

#include "octree/game.h"

/* The ticks whose way an arrow shows: so many of 1, 2, 5, 10 ... 1000 that the arrow of the fastest of the session's
 * bodies is no longer than a tenth of the world's longest side, or 1. The same at every tick. */
unsigned velocity_ticks(const octree_game *game);

#endif
