/* crossed_box.h - a box that is crossed out: told from others without its colour. Private. */
#ifndef SCENE_CROSSED_BOX_H
#define SCENE_CROSSED_BOX_H

#include "scene.h"

/* The diagonals of a box's six faces, with ids from 0 to CROSS_LINES - 1: see element_ids.h. */
void add_crossed_faces(scene *s, const octree_box *box, scene_style style);

#endif
