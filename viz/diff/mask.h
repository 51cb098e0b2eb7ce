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
    uint32_t *runs; /* run lengths in reading order, alternating: compared, ignored, compared ...; owned */
    size_t count;
} pixel_mask;

/* Also ignore each pixel whose byte in `bytes` is not 0. If `bytes` has another size than the mask, do nothing:
 * frames of different sizes differ in any case. Return false if memory runs out. */
bool mask_add(pixel_mask *mask, const uint8_t *bytes, int width, int height);
void mask_release(pixel_mask *mask);

/* Return one byte for each pixel: not 0 if the pixel is ignored. The caller frees the bytes. Return null if no pixel
 * is ignored or memory runs out. */
uint8_t *mask_unpack(const pixel_mask *mask);

#endif
