/* SPDX-License-Identifier: MIT */
/* velocity_layer.h - the scale and the counts of the velocity arrows. */
#ifndef LAYERS_VELOCITY_LAYER_H
#define LAYERS_VELOCITY_LAYER_H

#include "octree/game.h"

/* Return the number of ticks whose movement an arrow shows. The result is the largest of 1, 2, 5, 10 ... 1000 for which
 * the arrow of the session's fastest body is at most a tenth of the world's longest side. If even 1 is too large, the
 * result is 1. The number is the same at every tick. */
unsigned count_velocity_ticks(const octree_game *game);

/* The number of sieves. Sieve i, from 0 to 64, has its i lowest bits set; more bits keep fewer arrows. */
#define ARROW_SIEVES 65

/* The arrows of a tick in a view without a filter, counted only once for all pictures of the tick. */
typedef struct arrow_counts {
    bool known;
    size_t passing[ARROW_SIEVES]; /* passing[i]: the number of arrows that sieve i keeps */
} arrow_counts;

#endif
