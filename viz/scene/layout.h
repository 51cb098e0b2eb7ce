/* SPDX-License-Identifier: MIT */
/* layout.h - the areas of a picture, in whole pixels: the column of text at the left, the space view, the close-up, the
 * diagram; and the placement of labels so that none covers another. */
#ifndef SCENE_LAYOUT_H
#define SCENE_LAYOUT_H

#include "scene.h"

/* Letters in a line of the column of text, and the margins at both of its sides. */
#define LAYOUT_LETTERS 28
#define LAYOUT_MARGIN 2

/* The width of the column in pixels; 0 when the view has no text or the picture is too small for it. */
int layout_panel_width(const view *v);

/* The area in which the world is drawn. */
camera_window layout_space_area(const scene *s);

/* The number of letters to reserve for the numbers along an axis of a box, tick mark included: 6, or more for large
 * coordinates. */
int layout_count_number_letters(const octree_box *box);

/* The part of layout_space_area() in which the camera frames the world, with room for numbers at both sides. */
camera_window layout_camera_area(const scene *s, const octree_box *world);

/* The area of a close-up, in whole pixels: beside the world, or below it if the space is higher than wide. Empty if the
 * picture is too small for a close-up. */
camera_window layout_closeup_area(const view *v);

/* The area of the diagram; empty if the view shows no diagram. With DIAGRAM_BESIDE it is half of the picture without
 * the text column: the right half, or the lower half if that area is higher than wide. */
camera_window layout_diagram_area(const view *v);

/* ---- Placement of labels ------------------------------------------------------------------------------------ */

#define TEXT_SPACE_MOST 400 /* more labels than that are unreadable */

/* Rectangles in use, in pixels: left, top, right, bottom. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Start with the rectangles of all labels at pixels that the scene already has. */
text_space text_space_make(const scene *s);

/* Reserve room for a text centred on a pixel, and write its top left corner. False when it would leave the space view
 * or cover another text. */
bool text_space_reserve_text(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* Reserve the area of a mark at a world position; `half` is half its width, in half units of the frame. */
void text_space_reserve_mark(text_space *t, const scene *s, const double at[3], unsigned half);

/* Add a label beside a mark of this half width, on the first side with room, on a background of its own. False if no
 * side has room. True also if the mark is outside of the space view, where it gets no label. */
bool text_space_add_label_beside(text_space *t, scene *s, scene_label label, const double at[3], unsigned half);

/* Add a label on a filled rectangle, so that lines and points do not make it hard to read. The rectangle has the
 * label's id and layer. */
void scene_add_label_on_ground(scene *s, const scene_label *label, theme_role ground);

#endif
