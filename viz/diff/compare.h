/* compare.h - the two frames of a pair are compared: by their bytes, their pixels or their digests. */
#ifndef DIFF_COMPARE_H
#define DIFF_COMPARE_H

#include "diff.h"

/* Whether both are the same file by their bytes, and a whole PNG: then the pair has its finding. */
bool compare_bytes(diff_pair *pair);

/* Find by the pixels, or by the digests. The finding is set in any case. */
void compare_pixels(diff_pair *pair, const diff_options *options);

#endif
