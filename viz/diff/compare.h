/* compare_pair.h - two frames are decoded and compared. */
#ifndef DIFF_COMPARE_PAIR_H
#define DIFF_COMPARE_PAIR_H

#include "diff.h"

/* Whether both are the same file by their bytes, and a whole PNG: then the pair has its finding. */
bool compare_bytes(diff_pair *pair);

/* Find by the pixels, or by the digests. The finding is set in any case. */
void compare_pixels(diff_pair *pair, const diff_options *options);

#endif
