/* SPDX-License-Identifier: MIT */
/* point_scale.h - what the points of tick 0 are like, so that colours and sizes of painted points stay the same through
 * a recording. */
#ifndef SCENE_POINT_SCALE_H
#define SCENE_POINT_SCALE_H

#include "octree/octree.h"
#include "view.h"

/* Where the view paints points and has no scale yet, give it that of the points that it shows of the tree of tick 0. A
 * few outliers on either side are left out, so that they do not take the colours from all others. The spacing is the
 * median of the leaves', by the extent of the points in each. False when there is no memory. Cost: O(n). */
bool point_scale_fit(view *v, const octree *tree);

#endif
