/* text_layer.h - where text is in the frames of a recording, so that it can be left out of a comparison. */
#ifndef DIFF_TEXT_LAYER_H
#define DIFF_TEXT_LAYER_H

#include "diff.h"

/* Add to each pair's ignored rectangles those that text covers in either frame. The sessions are played for it, nothing
 * is drawn. False, with a sentence, when neither side is a recording, or one cannot be played. */
bool text_layer_ignore(const diff_side *a, const diff_side *b, diff_pair **pairs, size_t count, octreel_error *error);

#endif
