/* layout.h - the areas of a picture, in whole pixels: the column of text at the left, what the space view and the
 * diagram have of the rest, and room for words there so that none covers another. */
#ifndef LAYERS_LAYOUT_H
#define LAYERS_LAYOUT_H

#include "scene.h"

#define LAYOUT_COLUMN 160 /* the width of the column of text, in units (view_unit) */

/* The width of the column in pixels; 0 when the view has no text or the picture is too small for it. */
int panel_width(const view *v);

/* Where the world is drawn. */
camera_window layout_space(const view *v);

/* Where the tree is drawn as a tree; without extent where the view shows no diagram. Beside the space view it has half
 * of the rest, at the right or, where the rest is higher than wide, below. */
camera_window layout_diagram(const view *v);

/* ---- Words among the lines ---------------------------------------------------------------------------------- */

#define TEXT_SPACE_MOST 400 /* more words than that are no help */
#define TEXT_LETTER 6       /* units that a letter takes, about */
#define TEXT_HEIGHT 9       /* units from the top of a letter to below its foot */

/* Rectangles that are taken, in pixels: left, top, right, bottom. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Take the room of a text around a place, in pixels, and write where its label begins. False where it would leave the
 * area that the world is drawn in, or cover another. */
bool text_space_take(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* Add a label that has its room, on a ground of a role: lines and points would make it hard to read. The ground has the
 * label's id and layer. */
void text_add_on_ground(scene *s, const scene_label *label, theme_role ground);

#endif
