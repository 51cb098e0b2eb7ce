/* SPDX-License-Identifier: MIT */
/* glyphs.h - the glyphs of each face (bitmap font), as lists of rectangles. When Octreel is built, viz/faces generates
 * glyphs.c. */
#ifndef DRAW_GLYPHS_H
#define DRAW_GLYPHS_H

#include <stdint.h>

/* The characters with glyphs: printable ASCII. */
#define GLYPH_FIRST ' '
#define GLYPH_COUNT 95

/* A rectangle in pixels of the face, relative to the top left corner of the glyph's cell. */
typedef struct glyph_part {
    uint8_t x, y, width, height;
} glyph_part;

/* The glyphs of one face. The glyph of the character GLYPH_FIRST + i consists of the rectangles first[i] to first[i +
 * 1] - 1, which do not overlap. */
typedef struct glyph_set {
    uint8_t width, height; /* the size of a glyph's cell, in pixels of the face */
    const glyph_part *parts;
    uint16_t first[GLYPH_COUNT + 1];
} glyph_set;

extern const glyph_set glyph_sets[]; /* one set of glyphs for each face; the index is a text_face */

#endif
