/* SPDX-License-Identifier: MIT */
/* cause_words.h - prints sentences that say why two recordings differ. */
#ifndef EXPLAIN_CAUSE_WORDS_H
#define EXPLAIN_CAUSE_WORDS_H

#include "cause.h"

#include <stdio.h>

/* Print facts separated by commas, then minor facts after a semicolon: "node 0/3/7 only in the frames, point 12
 * moved from (0, 0, 0) to (1, 2, 3)". With `brief`, leave out positions, minor facts and all groups after the first
 * CAUSE_BRIEF groups. */
#define CAUSE_BRIEF 4
void cause_print_facts(FILE *out, const cause_facts *facts, bool brief);

/* Print one line: the differences between sessions and views, and their consequence. Print nothing if both sessions
 * and both views are equal. */
void cause_print_headline(FILE *out, const cause *c);

#endif
