/* explain_pair.h - why the two frames of one pair differ. */
#ifndef DIFF_EXPLAIN_PAIR_H
#define DIFF_EXPLAIN_PAIR_H

#include "explain.h"

/* Give a pair that is unlike its cause, and say whether only the drawing differs. `e` is null where frames are all that
 * there is; the cause is then null where they say nothing of themselves. */
bool explain_pair(const explanation *e, diff_pair *pair, record_error *error);

#endif
