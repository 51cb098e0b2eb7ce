/* SPDX-License-Identifier: MIT */
/* ignored_layers.h - excludes the pixels of some layers from a comparison of recordings. */
#ifndef EXPLAIN_IGNORED_LAYERS_H
#define EXPLAIN_IGNORED_LAYERS_H

#include "diff.h"

/* Add to each pair's mask the pixels where an element of the layers is on top in either frame. The context points to an
 * unsigned with the bits 1 << view_layer. LAYER_TEXT covers all letters, those of labels in the world, too. The
 * sessions are played and drawn; for text alone they are only played. Return false with an error if neither side is a
 * recording, or one cannot be played or drawn. */
diff_mask ignore_layers;

#endif
