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
int panel_width(const view *v);

/* Where the world is drawn. */
camera_window layout_space(const scene *s);

/* Letters of a number of an axis along a box, and of its tick: 6, or what the digits of large coordinates need. */
int layout_number_letters(const octree_box *box);

/* The part of it that the camera frames the world in: with room for numbers at both sides. */
camera_window layout_camera(const scene *s, const octree_box *world);

/* The area of a close-up, in whole pixels, beside the world or, where that is higher than wide, below it; empty in a
 * picture that is too small for one. */
camera_window layout_closeup(const view *v);

/* The area of the diagram; empty when the view shows none. Beside the space view it has half of what the column leaves:
 * the right half, or the lower one when that is higher than wide. */
camera_window layout_diagram(const view *v);

/* ---- Words among the lines ---------------------------------------------------------------------------------- */

#define TEXT_SPACE_MOST 400 /* more labels than that are unreadable */

/* Rectangles in use, in pixels: left, top, right, bottom. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Room beside the texts that stand at pixels already. */
text_space text_space_of(const scene *s);

/* Reserve room for a text centred on a pixel, and write its top left corner. False when it would leave the space view
 * or cover another text. */
bool text_space_take(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* Keep clear of a mark at a place of the world, so many half units wide to each side. */
void text_space_keep_mark(text_space *t, const scene *s, const double at[3], unsigned half);

/* Add a label on its ground beside such a mark, on the side where there is room. False where there is none; true also
 * where the mark is not in the space view. */
bool text_add_beside(text_space *t, scene *s, scene_label label, const double at[3], unsigned half);

/* Add a label on a filled rectangle, so that lines and points do not make it hard to read. The rectangle has the
 * label's id and layer. */
void text_add_on_ground(scene *s, const scene_label *label, theme_role ground);

#endif
