/* velocity_layer.h - the layer of velocities: for each point that moves an arrow, the way that it has before it. */
#ifndef SCENE_VELOCITY_LAYER_H
#define SCENE_VELOCITY_LAYER_H

#include "octree/game.h"
#include "scene.h"

/* The ticks whose way an arrow shows: so many of 1, 2, 5, 10 ... 1000 that the arrow of the fastest of the session's
 * bodies is no longer than a tenth of the world's longest side, or 1. The same at every tick. */
unsigned velocity_ticks(const octree_game *game);

/* A segment for each point that moves and that the view shows, with its id: from where it is along its velocity, up to
 * the world's bounds, where it bounces. What is beyond the view's budget is left out and counted, which is a
 * thousandth of that of points, since more could not be told apart; and so is what is shorter than the view's lod. */
void add_velocities(scene *s, const octree_game *game);

#endif
