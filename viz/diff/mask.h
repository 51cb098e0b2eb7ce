/* SPDX-License-Identifier: MIT */
/* mask.h - which pixels of a frame are left out of a comparison, packed: many frames may wait to be compared. */
#ifndef DIFF_MASK_H
#define DIFF_MASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A zeroed one leaves nothing out. */
typedef struct pixel_mask {
    int width, height;
    uint32_t *runs; /* lengths of runs in reading order: compared, left out, compared ...; owned */
    size_t count;
} pixel_mask;

/* Leave out also the pixels whose byte is not 0. A mask of another size than before changes nothing: such frames
 * differ in any case. False when there is no memory. */
bool mask_add(pixel_mask *mask, const uint8_t *bytes, int width, int height);
void mask_release(pixel_mask *mask);

/* A byte a pixel, not 0 where it is left out; the caller frees it. Null where nothing is, or there is no memory. */
uint8_t *mask_bytes(const pixel_mask *mask);

#endif
