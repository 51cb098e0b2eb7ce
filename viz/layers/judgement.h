/* SPDX-License-Identifier: MIT */
/* judgement.h - what is wrong with a program's answer, in few words, and which of several is the worst. */
#ifndef LAYERS_JUDGEMENT_H
#define LAYERS_JUDGEMENT_H

#include "octree/game.h"

#include <stddef.h>

#define JUDGEMENT_TEXT 64

/* "2.26 times as far", "1 missed, 2 extra", "no point has id 17": what is wrong first. */
const char *judgement_text(const octree_judgement *judgement, char text[JUDGEMENT_TEXT]);

/* The first point that the program missed, or else the first that it named wrongly; null where there is none. */
const octree_point *judgement_first_point(const octree_judgement *judgement);

/* Whether one answer is worse than another: by its ratio of distances, then by the points missed and extra. */
bool judgement_is_worse(const octree_judgement *judgement, const octree_judgement *than);

/* How many of the answers are wrong, and which is the worst of them: the first of several. */
size_t judgement_count_wrong(const octree_answer *answers, size_t count, size_t *worst);

#endif
