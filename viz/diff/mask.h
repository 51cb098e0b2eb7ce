/* SPDX-License-Identifier: MIT */
/* mask.h - the pixels of a frame that a comparison ignores, as run lengths, since many frames may wait in memory. */
#ifndef DIFF_MASK_H
#define DIFF_MASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Zeroed: no pixel is ignored. */
typedef struct pixel_mask {
    int width, height;
    uint32_t *runs; /* lengths of runs in reading order: compared, ignored, compared ...; owned */
    size_t count;
} pixel_mask;

/* Also ignore the pixels whose byte is not 0. Bytes of another size than the mask are ignored: such frames differ in
 * any case. Return false if memory runs out. */
bool mask_add(pixel_mask *mask, const uint8_t *bytes, int width, int height);
void mask_release(pixel_mask *mask);

/* One byte for each pixel, not 0 if it is ignored; the caller frees it. Null if no pixel is ignored or memory runs out.
 */
uint8_t *mask_unpack(const pixel_mask *mask);

#endif
