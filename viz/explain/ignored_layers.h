/* ignored_layers.h - where a layer is in the frames of a recording, so that it can be left out of a comparison. */
#ifndef EXPLAIN_IGNORED_LAYERS_H
#define EXPLAIN_IGNORED_LAYERS_H

#include "diff.h"

/* Add to each pair's ignored rectangles those that text covers in either frame. The sessions are played for it, nothing
 * is drawn. False, with a sentence, when neither side is a recording, or one cannot be played. */
diff_ignore ignore_text_layer;

#endif
