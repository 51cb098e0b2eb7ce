/* SPDX-License-Identifier: MIT */
/* fill.h - the integer rasterizer: fills quads with exactly the pixels that llvmpipe gives them. Private to this
 * folder.
 */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "quads.h"
#include "renderer.h"

/* Fill quads in this order; `bytes` is that part of the picture. Corners may be up to 2^22 pixels away from it. */
void fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);

#endif
