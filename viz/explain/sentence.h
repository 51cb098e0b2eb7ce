/* sentence.h - why the two frames of one pair differ, in one sentence. */
#ifndef EXPLAIN_SENTENCE_H
#define EXPLAIN_SENTENCE_H

#include "explain.h"

#include <stdio.h>

/* Of a pair that is unlike. Its text is null where frames are all that there is and say nothing of themselves. */
bool sentence_of(const explanation *e, const diff_pair *pair, pair_cause *cause, octreel_error *error);

/* What is said where the drawing alone differs: by whom, where that is known. */
void sentence_print_rendering(FILE *out, const explanation *e);

#endif
