/* SPDX-License-Identifier: MIT */
/* layout.h - the areas of a picture, in whole pixels: the column of text at the left, the space view, the close-up and
 * the diagram. These functions also place labels so that no label covers another. */
#ifndef SCENE_LAYOUT_H
#define SCENE_LAYOUT_H

#include "scene.h"

/* LAYOUT_LETTERS: the number of characters in a line of the column of text. LAYOUT_MARGIN: the width of the column's
 * margin at each side, in characters. */
#define LAYOUT_LETTERS 28
#define LAYOUT_MARGIN 2

/* Returns the width of the column of text in pixels. Returns 0 if the view has no text, if the text is not part of the
 * picture (view.text_apart), or if the picture is too small for the column. */
int layout_panel_width(const view *v);

/* Returns the height, in pixels, of the strip for the caption below the space view and the diagram. Returns 0 if the
 * picture has no column of text or is not high enough. */
int layout_caption_height(const view *v);

/* Returns the area of the space view, in which the world is drawn. */
camera_window layout_space_area(const scene *s);

/* Returns the number of characters to reserve for the numbers along an axis of a box, tick mark included. The result is
 * 6, or more for large coordinates. */
int layout_count_number_letters(const octree_box *box);

/* Returns the part of layout_space_area() in which the camera frames the world. The room at the left and right of this
 * part is for numbers. */
camera_window layout_camera_area(const scene *s, const octree_box *world);

/* Returns the area of a close-up: beside the world, or below the world if the space view is higher than wide. Returns
 * an empty area if the picture is too small for a close-up. */
camera_window layout_closeup_area(const view *v);

/* Returns the area of the diagram, which is empty if the view shows no diagram. With DIAGRAM_BESIDE the diagram takes
 * half of the area that the column of text and the caption leave free: the right half, or the lower half if this area
 * is higher than wide. */
camera_window layout_diagram_area(const view *v);

/* ---- Placement of labels ------------------------------------------------------------------------------------ */

#define TEXT_SPACE_MOST 400 /* the maximum number of labels in a picture; more labels are unreadable */

/* The rectangles of the picture that new labels must not cover: left, top, right and bottom in pixels. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Returns a text space with the rectangles of the labels that the scene already has. Labels at world positions are not
 * included, because they have no fixed pixel. */
text_space text_space_make(const scene *s);

/* Reserve room for a text centred on a pixel, and set `corner` to the text's top left corner. Reserves nothing and
 * returns false if the text would leave the space view or cover another text. */
bool text_space_reserve_text(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* Reserve the square of a marker centred on a world position. `half` is half the square's side, in half picture
 * units. */
void text_space_reserve_mark(text_space *t, const scene *s, const double at[3], unsigned half);

/* Add a label beside a marker, with its own background, on the first side of the marker that has room. `half` is half
 * the marker's side, in half picture units. Returns false if no side has room. If the marker is outside the space view,
 * returns true without adding a label. */
bool text_space_add_label_beside(text_space *t, scene *s, scene_label label, const double at[3], unsigned half);

/* Add a label on a filled rectangle, so that lines and points behind the label do not make the label hard to read. The
 * rectangle has the label's id and layer. */
void scene_add_label_on_ground(scene *s, const scene_label *label, theme_role ground);

#endif
