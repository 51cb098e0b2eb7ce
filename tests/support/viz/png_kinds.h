/* SPDX-License-Identifier: MIT */
/* png_kinds.h - one picture, stored with every colour type and depth of PNG. */
#ifndef PNG_KINDS_H
#define PNG_KINDS_H

#include "image.h"
#include "png_by_hand.h"

/* A way of storing pixels in a PNG. */
typedef struct png_kind {
    int color_type, depth;
    bool interlaced;
    bool keyed; /* with a tRNS chunk */
} png_kind;

enum {
    PNG_KIND_GREY = 0,
    PNG_KIND_RGB = 2,
    PNG_KIND_PALETTE = 3,
    PNG_KIND_GREY_ALPHA = 4,
    PNG_KIND_RGB_ALPHA = 6,
    PNG_KIND_SIDE = 21,
    PNG_KIND_PALETTE_ALPHAS = 2
};

int png_samples_per_pixel(int color_type);
unsigned png_largest_sample(png_kind kind);

/* The stored value of one sample. The pattern contains the smallest, the largest and the keyed value. */
unsigned png_sample_at(png_kind kind, int x, int y, int sample);

/* The palette's colour for an index; 2^depth entries. */
image_color png_palette_color(unsigned index);
uint8_t png_palette_alpha(unsigned index);

void png_make_kind(png_bytes *out, png_kind kind);

/* Save the picture in every kind at a path, interlaced or not, with and without a transparent colour, and visit each.
 */
void png_for_every_kind(void (*visit)(const char *path, png_kind kind), const char *path);

#endif
