/* sentence.h - why the two frames of one pair differ, in one sentence. */
#ifndef EXPLAIN_SENTENCE_H
#define EXPLAIN_SENTENCE_H

#include "explain.h"

#include <stdio.h>

/* Find the cause of a pair that differs. Its text is null where neither recordings nor text chunks in the frames tell
 * one. */
bool sentence_of(const explanation *e, const diff_pair *pair, pair_cause *cause, octreel_error *error);

/* The sentence for frames of the same scene: rendering differs, and who drew them, where that is known. */
void sentence_print_rendering(FILE *out, const explanation *e);

#endif
