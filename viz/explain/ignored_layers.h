/* SPDX-License-Identifier: MIT */
/* ignored_layers.h - excludes the pixels of chosen layers from a comparison of recordings. */
#ifndef EXPLAIN_IGNORED_LAYERS_H
#define EXPLAIN_IGNORED_LAYERS_H

#include "diff.h"

/* A diff_mask callback. Add to each pair's mask the pixels where, in either frame, the topmost element belongs to
 * one of the layers pair->layers. LAYER_TEXT includes the labels
 * in the world. The sessions are played and drawn; if LAYER_TEXT is the only layer of a pair, it is played but not
 * drawn. Return false with an error if neither side is a recording, or if a recording cannot be played or drawn. */
diff_mask ignore_layers;

#endif
