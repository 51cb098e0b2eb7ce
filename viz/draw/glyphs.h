/* SPDX-License-Identifier: MIT */
/* glyphs.h - the letters of each face as rectangles. viz/faces makes glyphs.c of them when
 * the program is built. */
#ifndef DRAW_GLYPHS_H
#define DRAW_GLYPHS_H

#include <stdint.h>

/* The letters that there are: ASCII's, from the blank on. */
#define GLYPH_FIRST ' '
#define GLYPH_COUNT 95

/* In the pixels of the face, from the letter's top left corner. */
typedef struct glyph_part {
    uint8_t x, y, width, height;
} glyph_part;

/* Letter i has the parts from first[i] on, before first[i + 1]. They do not overlap. */
typedef struct glyph_set {
    uint8_t width, height; /* of a cell */
    const glyph_part *parts;
    uint16_t first[GLYPH_COUNT + 1];
} glyph_set;

extern const glyph_set glyph_sets[]; /* by text_face */

#endif
