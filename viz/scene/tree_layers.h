/* tree_layers.h - the layers that every scene of a tree has: its world, its nodes, its points. Private. */
#ifndef SCENE_TREE_LAYERS_H
#define SCENE_TREE_LAYERS_H

#include "scene.h"

/* The world's box and its axes; and, dashed, the slice and the region that the view shows. */
void add_world(scene *s, const octree_box *world);

/* The box of every node that the view shows, once, in pre-order, with its address as id; every point that it shows,
 * once, by id within its leaf. Points are drawn smaller where there are many: `expected` is their number, for a game
 * the session's, so that it does not change from tick to tick. Where the view asks for labels, nodes have their paths
 * on them: see node_labels.h. */
void add_tree(scene *s, const octree *tree, size_t expected);

/* Empty the scene and set its view, unit and camera. Where the diagram takes the place of the space view, words are the
 * one layer that is left. */
void begin_scene(scene *s, const view *v, const octree_box *world, const double player[3], uint64_t tick);

/* The colour of a node of this depth and with so many points. */
theme_role node_role(const view *v, unsigned depth, size_t points);

#endif
