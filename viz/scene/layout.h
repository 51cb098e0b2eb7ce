/* layout.h - the parts of a picture, in whole pixels: the column of text at the left, and what the space view and the
 * diagram have of the rest. Private to scene. */
#ifndef SCENE_LAYOUT_H
#define SCENE_LAYOUT_H

#include "camera.h"

#define LAYOUT_COLUMN 160 /* the width of the column of text, in units (view_unit) */

/* The width of the column in pixels; 0 when the view has no text or the picture is too small for it. */
int panel_width(const view *v);

/* Where the world is drawn. */
camera_window layout_space(const view *v);

/* Where the tree is drawn as a tree; without extent where the view shows no diagram. Beside the space view it has half
 * of the rest, at the right or, where the rest is higher than wide, below. */
camera_window layout_diagram(const view *v);

#endif
