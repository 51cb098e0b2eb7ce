/* tree_nodes.h - a tree's nodes and points in a scene. Private. */
#ifndef SCENE_TREE_NODES_H
#define SCENE_TREE_NODES_H

#include "scene.h"

/* The box of every node that the view shows, once, in pre-order, with its address as id; every point that it shows,
 * once, by id within its leaf. Points are drawn smaller where there are many: `expected` is their number, for a game
 * the session's, so that it does not change from tick to tick. Where the view asks for labels, nodes have their paths
 * on them: see node_labels.h. */
void add_tree(scene *s, const octree *tree, size_t expected);

/* The colour of a node of this depth and with so many points. */
theme_role node_role(const view *v, unsigned depth, size_t points);

#endif
