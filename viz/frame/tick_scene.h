/* SPDX-License-Identifier: MIT */
/* tick_scene.h - builds the scene of a tree, or of a tick of a game, with the layers that its view shows. */
#ifndef FRAME_TICK_SCENE_H
#define FRAME_TICK_SCENE_H

#include "heat.h"
#include "octree/game.h"
#include "point_values.h"
#include "scene.h"

/* Fill a scene with the last tick of a game, as seen by a view. h is the heat up to this tick; null leaves the heat
 * layers empty. The values of points may be null. False when there is no memory. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, const heat *h, const point_values *values);

/* What is shown of a tree in addition to its nodes and points. */
typedef struct tree_subject {
    const char *title;
    octree_address node; /* it is marked, and the diagram shows the path to it; 0: none */
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* of its points; may be null */
} tree_subject;

/* Fill a scene with a tree alone. False when there is no memory. */
bool tree_scene_build(scene *s, const view *v, const octree *tree, const tree_subject *about);

#endif
