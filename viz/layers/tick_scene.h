/* tick_scene.h - what a tree, or a tick of a game, looks like. */
#ifndef SCENE_TICK_SCENE_H
#define SCENE_TICK_SCENE_H

#include "heat.h"
#include "octree/game.h"
#include "scene.h"

/* Fill a scene with one tick of a game, as seen by a view. `h` is what all ticks up to this one have added up to; null
 * leaves the layers of heat empty. False when there is no memory. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, const heat *h);

/* What is said of a tree. */
typedef struct tree_look {
    const char *title;
    octree_address node; /* it is marked, and the diagram shows the way to it; 0: none */
    const octree_answer *answers;
    size_t answer_count;
} tree_look;

/* Fill a scene with a tree alone: its nodes, its points, a line that names it, and what else is said of it. False when
 * there is no memory. */
bool look_scene_build(scene *s, const view *v, const octree *tree, const tree_look *about);

#endif
