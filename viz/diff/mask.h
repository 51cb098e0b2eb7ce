/* SPDX-License-Identifier: MIT */
/* mask.h - stores which pixels of a frame a comparison ignores. A mask is run-length encoded, because the masks of
 * many frames may be in memory at once. */
#ifndef DIFF_MASK_H
#define DIFF_MASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The ignored pixels of a frame. In a zeroed mask, no pixel is ignored. */
typedef struct pixel_mask {
    int width, height;
    /* run lengths in reading order, alternately of compared and of ignored pixels, beginning with compared pixels;
     * owned */
    uint32_t *runs;
    size_t count;
} pixel_mask;

/* Add pixels to the mask: each pixel whose byte in `bytes` is not 0 becomes ignored. If `bytes` has another size
 * than the mask, nothing is added, because frames of different sizes differ in any case. Return false if memory runs
 * out. */
bool mask_add(pixel_mask *mask, const uint8_t *bytes, int width, int height);
void mask_release(pixel_mask *mask);

/* Return an array with one byte for each pixel; the byte is not 0 if the pixel is ignored. The caller frees the
 * array. Return null if no pixel is ignored or memory runs out. */
uint8_t *mask_unpack(const pixel_mask *mask);

#endif
