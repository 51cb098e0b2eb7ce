/* SPDX-License-Identifier: MIT */
/* layout.h - the areas of a picture, in whole pixels: the column of text at the left, the space view, the close-up and
 * the diagram. Also places labels so that none of them covers another. */
#ifndef SCENE_LAYOUT_H
#define SCENE_LAYOUT_H

#include "scene.h"

/* The number of letters in a line of the column of text, and of its margins at both sides, in letters. */
#define LAYOUT_LETTERS 28
#define LAYOUT_MARGIN 2

/* Returns the width in pixels of the column of text; 0 if the view has no text or the picture is too small for it. */
int layout_panel_width(const view *v);

/* Returns the area of the space view, in which the world is drawn. */
camera_window layout_space_area(const scene *s);

/* Returns the number of letters to reserve for the numbers along an axis of a box, tick mark included. It is 6, or more
 * for large coordinates. */
int layout_count_number_letters(const octree_box *box);

/* Returns the part of layout_space_area() in which the camera frames the world. Both sides keep room for numbers. */
camera_window layout_camera_area(const scene *s, const octree_box *world);

/* Returns the area of a close-up: beside the world, or below the world if the space is higher than wide. Empty if the
 * picture is too small for a close-up. */
camera_window layout_closeup_area(const view *v);

/* Returns the area of the diagram; empty if the view shows no diagram. With DIAGRAM_BESIDE it is half of the picture
 * without the column of text: the right half, or the lower half if this area is higher than wide. */
camera_window layout_diagram_area(const view *v);

/* ---- Placement of labels ------------------------------------------------------------------------------------ */

#define TEXT_SPACE_MOST 400 /* the most labels in a picture; more are unreadable */

/* The rectangles of the picture that labels must not cover, in pixels: left, top, right, bottom. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Returns a text space with the rectangles of the labels that the scene already has at pixels (not at world
 * positions). */
text_space text_space_make(const scene *s);

/* Reserve room for a text centred on a pixel, and write the text's top left corner to `corner`. Reserves nothing and
 * returns false if the text would leave the space view or cover another text. */
bool text_space_reserve_text(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* Reserve the square of a marker centred on a world position. `half` is half the square's side, in half units of the
 * frame. */
void text_space_reserve_mark(text_space *t, const scene *s, const double at[3], unsigned half);

/* Add a label beside a marker, with its own background, on the first side of the marker that has room. `half` is half
 * the marker's side, in half units of the frame. False if no side has room. True without a label if the marker is
 * outside the space view. */
bool text_space_add_label_beside(text_space *t, scene *s, scene_label label, const double at[3], unsigned half);

/* Add a label on a filled rectangle, so that lines and points behind it do not make it hard to read. The rectangle has
 * the label's id and layer. */
void scene_add_label_on_ground(scene *s, const scene_label *label, theme_role ground);

#endif
