/* SPDX-License-Identifier: MIT */
/* stored_png.h - random pictures, stored by libpng in every way that PNG knows. */
#ifndef STORED_PNG_H
#define STORED_PNG_H

#include <stdbool.h>
#include <stdint.h>

/* A way of storing pixels. */
typedef struct png_storage {
    int color_type, depth; /* as in libpng */
    bool interlaced;
    bool keyed;  /* true: with a tRNS chunk */
    bool narrow; /* true: samples of 16 bits, whose values 8 bits could hold */
} png_storage;

/* All ways of storing pixels. */
enum { PNG_STORAGES = 64 };
png_storage png_storage_at(int i);

/* A picture of patches in a few colours, the same for the same seed. After saving, `spoiled` bytes of the file are
 * replaced by random ones, from `spoiling_seed`. */
typedef struct stored_png {
    int width, height;
    png_storage storage;
    uint64_t seed, spoiling_seed;
    int spoiled;
} stored_png;
void stored_png_save(const stored_png *picture, const char *path);

#endif
