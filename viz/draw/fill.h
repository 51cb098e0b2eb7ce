/* SPDX-License-Identifier: MIT */
/* fill.h - quads filled by integers alone, with the pixels that GL gives them. For this folder.
 *
 * Corners are whole 1/256 pixels, so integers tell whether a pixel's centre is in a quad. By GL's rule, which llvmpipe
 * follows to the bit, a pixel is drawn if its centre is inside; a centre on an edge is inside if that is a left edge,
 * or a horizontal top edge. A quad is the triangles 0 1 2 and 0 2 3, whatever their winding.
 */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "quads.h"
#include "renderer.h"

/* Corners may be anywhere within 2^22 pixels of the picture. */
void fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);

#endif
