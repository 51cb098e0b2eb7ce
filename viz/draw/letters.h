/* SPDX-License-Identifier: MIT */
/* letters.h - turns text into quads, and lists the boxes around a scene's text. */
#ifndef DRAW_LETTERS_H
#define DRAW_LETTERS_H

#include "quads.h"

/* A rectangle in pixels; it may extend beyond the picture. */
typedef struct draw_box {
    int x, y, width, height;
} draw_box;

/* Visit the boxes of all text in a scene: the box around each label, and each panel. This function needs no
 * renderer. */
void visit_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context);

/* Add the quads of a label's characters, at the label's pixel or beside the projection of its world position. `s` is
 * from project_scene_to_samples(). Private to this folder. */
void add_label_letters(quad_list *list, const scene *s, const scene_label *label);

#endif
