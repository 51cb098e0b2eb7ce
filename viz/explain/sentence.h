/* explain_pair.h - why the two frames of one pair differ. */
#ifndef DIFF_EXPLAIN_PAIR_H
#define DIFF_EXPLAIN_PAIR_H

#include "explain.h"

#include <stdio.h>

/* Give a pair that is unlike its cause, and say whether only the drawing differs. `e` is null where frames are all that
 * there is; the cause is then null where they say nothing of themselves. */
bool explain_pair(const explanation *e, diff_pair *pair, octreel_error *error);

/* What is said where the drawing alone differs: by whom, where that is known. */
void explain_print_rendering(FILE *out, const explanation *e);

#endif
