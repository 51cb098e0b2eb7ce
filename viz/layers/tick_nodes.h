/* tick_nodes.h - the nodes that a tick names by their addresses, as far as the view shows them. Private. */
#ifndef SCENE_TICK_NODES_H
#define SCENE_TICK_NODES_H

#include "octree/octree.h"
#include "scene.h"

/* The node at an address, or its empty cell where the tree has no node there any more. False when the view's filter
 * leaves it out; or where it is smaller than the view's lod and lies in one that is shown, which is counted. */
bool tick_node_shown(scene *s, const octree *tree, octree_address address, octree_node *node);

/* A node's box, with its address as id. */
void add_node_box(scene *s, const octree_node *node, scene_style style);

#endif
