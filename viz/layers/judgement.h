/* SPDX-License-Identifier: MIT */
/* judgement.h - short texts about wrong foreign answers, and which of several wrong answers is the worst. */
#ifndef LAYERS_JUDGEMENT_H
#define LAYERS_JUDGEMENT_H

#include "octree/game.h"

#include <stddef.h>

#define JUDGEMENT_TEXT 64

/* Write the error of an answer to `text`, such as "2.26 times as far", "1 missing, 2 extra" or "no point has id 17".
 * Write "right" if the answer has no error. Return `text`. */
const char *judgement_text(const octree_judgement *judgement, char text[JUDGEMENT_TEXT]);

/* The same for the pairs of a foreign index, such as "1 missing, 2 extra" or "1 and 2 twice". The pairs must
 * be wrong. */
const char *pair_judgement_text(const octree_pair_judgement *judgement, char text[JUDGEMENT_TEXT]);

/* Return whether one answer is worse than another. The ratio of distances is compared first, then the number of missing
 * and extra points. */
bool judgement_is_worse(const octree_judgement *judgement, const octree_judgement *than);

/* Return the number of wrong answers. Set *worst to the index of the worst answer, or of the first of several equally
 * bad answers. If no answer is wrong, *worst is unchanged. */
size_t judgement_count_wrong(const octree_answer *answers, size_t count, size_t *worst);

#endif
