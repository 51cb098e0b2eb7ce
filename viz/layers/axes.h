/* axes.h - the numbers along the edges of what the camera frames. Private to scene. */
#ifndef SCENE_AXES_H
#define SCENE_AXES_H

#include "scene.h"

/* Three axes from the lowest corner of the box that the camera frames: the world's, or that of a view that fits. Each
 * has its letter, and ticks with round numbers where its layer and text are shown. The numbers of ticks depend on the
 * camera's kind and on the box, not on where an orbit has come to. */
void add_axes(scene *s, const octree_box *world);

#endif
