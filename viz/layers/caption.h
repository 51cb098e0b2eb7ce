/* SPDX-License-Identifier: MIT */
/* caption.h - one line of plain words about a tick: "w: player to (0, 50, 0); leaf 5/3 splits, 3 points for capacity
 * 2". Frames show the caption below the scene, and pages show it above the picture. */
#ifndef LAYERS_CAPTION_H
#define LAYERS_CAPTION_H

#include "layer_type.h"

#define CAPTION_TEXT 320 /* the size of a caption in bytes, including the final zero */

/* Write the caption of a tick, or of a tree without a game. A text that does not fit is cut. */
void caption_write(const layer_source *in, char text[CAPTION_TEXT]);

#endif
