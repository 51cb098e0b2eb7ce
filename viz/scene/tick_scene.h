/* tick_scene.h - what a tree, or a tick of a game, looks like. */
#ifndef SCENE_TICK_SCENE_H
#define SCENE_TICK_SCENE_H

#include "heat.h"
#include "octree/game.h"
#include "scene.h"

/* Fill a scene with one tick of a game, as seen by a view. `h` is what all ticks up to this one have added up to; null
 * leaves the layers of heat empty. False when there is no memory. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, const heat *h);

/* Fill a scene with a tree alone: its nodes, its points, and a line that names it. False when there is no memory. */
bool tree_scene_build(scene *s, const view *v, const octree *tree, const char *title);

/* What is said of a tree. */
typedef struct tree_look {
    const char *title;
    octree_address node; /* it is marked, and the diagram shows the way to it; 0: none */
    const octree_answer *answers;
    size_t answer_count;
} tree_look;

bool look_scene_build(scene *s, const view *v, const octree *tree, const tree_look *about);

#endif
