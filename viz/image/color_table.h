/* SPDX-License-Identifier: MIT */
/* color_table.h - collects the colours of several pictures in one palette, and turns RGB pixels into indices of this
 * palette. */
#ifndef IMAGE_COLOR_TABLE_H
#define IMAGE_COLOR_TABLE_H

#include "image.h"

enum { COLOR_SLOTS = 1024 };

/* A hash table of at most 256 colours. A zeroed table is empty. */
typedef struct color_table {
    image_palette palette; /* the colours, in the order in which they were added */
    bool is_full;          /* true: a colour could not be added, because the palette has 256 others */
    /* for each slot: its colour as 0x1RRGGBB, or 0 for a free slot; and the index of the colour in the palette */
    uint32_t keys[COLOR_SLOTS];
    uint8_t indices[COLOR_SLOTS];
} color_table;

/* Add the colours of `count` RGB pixels. Equal pixels in equal order give equal palettes. Stops at the first colour
 * that does not fit. Cost: O(count). */
void color_table_add(color_table *table, const uint8_t *rgb, size_t count);

/* Store the palette index of each of `count` RGB pixels. All colours must have been added. */
void color_table_find(const color_table *table, const uint8_t *rgb, size_t count, uint8_t *indices);

#endif
