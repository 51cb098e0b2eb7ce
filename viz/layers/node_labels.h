/* node_labels.h - the paths of nodes, written on them. Private to scene. */
#ifndef SCENE_NODE_LABELS_H
#define SCENE_NODE_LABELS_H

#include "scene.h"

/* Where the view asks for it, write the path of each node whose box is in the scene into the middle of that box, with
 * the node's address as id: shallow nodes first, then by address. A label has to fit the picture of its box, to be
 * within the part of the picture that is the world's, and to cover no other; s->tally counts those that do not. */
void add_node_labels(scene *s);

#endif
