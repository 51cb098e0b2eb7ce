/* SPDX-License-Identifier: MIT */
/* rgba.h - the pixels of a frame as a canvas takes them. */
#ifndef PAGE_RGBA_H
#define PAGE_RGBA_H

#include "image.h"

/* Convert the pixels of a frame to 4 bytes each: R, G, B, A. */
void rgba_convert(const image *frame, uint32_t *rgba);

#endif
