/* letters.h - text as quads, by stb_easy_font. Private. */
#ifndef DRAW_LETTERS_H
#define DRAW_LETTERS_H

#include "renderer.h"
#include "quads.h"

/* A label at its pixel, or beside the place where its position is drawn. */
void letters_add(quad_list *list, const scene *s, const scene_label *label);

/* The pixels, not samples, that a label's letters may light; false when it is out of sight. `s` is in samples. */
bool letters_box(const scene *s, const scene_label *label, draw_box *box);

#endif
