/* SPDX-License-Identifier: MIT */
/* rgba.h - converts the pixels of a frame to the format of an HTML canvas. */
#ifndef PAGE_RGBA_H
#define PAGE_RGBA_H

#include "image.h"

/* Convert the pixels of a frame to 4 bytes each: R, G, B, A. */
void rgba_convert(const image *frame, uint32_t *rgba);

#endif
