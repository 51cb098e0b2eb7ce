/* SPDX-License-Identifier: MIT */
/* letters.h - text as quads; and the boxes around a scene's text. */
#ifndef DRAW_LETTERS_H
#define DRAW_LETTERS_H

#include "quads.h"

/* A rectangle of the picture, in its pixels; it may reach beyond the border. */
typedef struct draw_box {
    int x, y, width, height;
} draw_box;

/* Visit the boxes of a scene's letters and panels: no text is drawn outside them. Needs no renderer. */
void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context);

/* For this folder: add the letters of a label, at its pixel or beside the pixel of its position. The scene is in
 * samples. */
void letters_add(quad_list *list, const scene *s, const scene_label *label);

#endif
