/* fit.h - the box that a fitting camera frames. */
#ifndef SCENE_FIT_H
#define SCENE_FIT_H

#include "view.h"

/* Under FIT_POINTS, make the view frame the points that it shows of a tree, which is that of tick 0: a camera that fits
 * stays where it is from tick to tick. Where they are all equal it is the cell of their leaf, and where there are none
 * the world. Other views stay as they are. */
void fit_view(view *v, const octree *tree);

#endif
