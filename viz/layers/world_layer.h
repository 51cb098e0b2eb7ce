/* world_layer.h - where a scene begins, and its world. Private. */
#ifndef SCENE_WORLD_LAYER_H
#define SCENE_WORLD_LAYER_H

#include "scene.h"

/* The world's box and its axes; and, dashed, the slice and the region that the view shows. */
void add_world(scene *s, const octree_box *world);

/* Empty the scene and set its view, unit and camera. Where the diagram takes the place of the space view, words are the
 * one layer that is left. */
void begin_scene(scene *s, const view *v, const octree_box *world, const double player[3], uint64_t tick);

#endif
