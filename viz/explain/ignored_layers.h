/* SPDX-License-Identifier: MIT */
/* ignored_layers.h - where layers are seen in the frames of a recording, so that they can be left out of a comparison.
 */
#ifndef EXPLAIN_IGNORED_LAYERS_H
#define EXPLAIN_IGNORED_LAYERS_H

#include "diff.h"

/* Add to each pair's mask where an element of the layers (an unsigned of bits 1 << view_layer: the context) is on top
 * in either frame; LAYER_TEXT stands for all letters, those of labels in the world too. The sessions are played and
 * drawn for it, or, for text alone, played. False with an error when neither side is a recording, or one cannot be
 * played or drawn. */
diff_mask ignore_layers;

#endif
