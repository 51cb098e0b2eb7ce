/* SPDX-License-Identifier: MIT */
/* glyphs.h - the letters of each face as rectangles. glyphs.c is made by viz/faces during the build. */
#ifndef DRAW_GLYPHS_H
#define DRAW_GLYPHS_H

#include <stdint.h>

/* The printable ASCII characters. */
#define GLYPH_FIRST ' '
#define GLYPH_COUNT 95

/* A rectangle in pixels of the face, relative to the top left corner of the letter's cell. */
typedef struct glyph_part {
    uint8_t x, y, width, height;
} glyph_part;

/* Letter i consists of parts first[i] to first[i + 1] - 1, which do not overlap. */
typedef struct glyph_set {
    uint8_t width, height; /* of a cell */
    const glyph_part *parts;
    uint16_t first[GLYPH_COUNT + 1];
} glyph_set;

extern const glyph_set glyph_sets[]; /* indexed by text_face */

#endif
