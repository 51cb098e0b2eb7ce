/* SPDX-License-Identifier: MIT */
/* cause_words.h - prints why two recordings differ as sentences. */
#ifndef EXPLAIN_CAUSE_WORDS_H
#define EXPLAIN_CAUSE_WORDS_H

#include "cause.h"

#include <stdio.h>

/* Print a list of facts, separated by commas, and the minor facts after a semicolon: "node 0/3/7 only in the frames,
 * point 12 moved from (0, 0, 0) to (1, 2, 3)". Brief texts leave out positions, minor facts and all groups after the
 * first CAUSE_BRIEF. */
#define CAUSE_BRIEF 4
void cause_print_facts(FILE *out, const cause_facts *facts, bool brief);

/* Print one line: the differences between the sessions and views, and their consequence. Print nothing if both are
 * equal. */
void cause_print_headline(FILE *out, const cause *c);

#endif
