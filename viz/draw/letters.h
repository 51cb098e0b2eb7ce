/* letters.h - text as quads, by stb_easy_font; and where the text of a scene is. */
#ifndef DRAW_LETTERS_H
#define DRAW_LETTERS_H

#include "quads.h"

/* A rectangle of the picture, in its pixels; it may reach beyond the border. */
typedef struct draw_box {
    int x, y, width, height;
} draw_box;

/* Where a scene's letters and panels are: no text lights a pixel outside these boxes. Needs no renderer. */
void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context);

/* For this folder: add a label of a scene in samples, at its pixel, or beside the place where its position is drawn. */
void letters_add(quad_list *list, const scene *s, const scene_label *label);

#endif
