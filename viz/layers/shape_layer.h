/* shape_layer.h - the layer of what a session shows beside its points. Private. */
#ifndef SCENE_SHAPE_LAYER_H
#define SCENE_SHAPE_LAYER_H

#include "octree/game.h"
#include "scene.h"

/* The shapes of a tick. Their ids are their places among them. */
void add_shapes(scene *s, const octree_tick *tick);

#endif
