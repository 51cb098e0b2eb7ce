/* read_pair.h - both pictures of a pair are decoded. */
#ifndef DIFF_READ_PAIR_H
#define DIFF_READ_PAIR_H

#include "diff.h"

/* Decode both at the same time, over a background. The caller releases them; when false, with a sentence, both are
 * released. */
bool read_pair(const diff_pair *pair, image_color background, image images[2], octreel_error *error);

#endif
