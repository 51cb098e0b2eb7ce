/* SPDX-License-Identifier: MIT */
/* cause_words.h - why two recordings differ, in sentences. */
#ifndef EXPLAIN_CAUSE_WORDS_H
#define EXPLAIN_CAUSE_WORDS_H

#include "cause.h"

#include <stdio.h>

/* The facts of one list, with commas between, those that matter least after a semicolon: "node 0/3/7 split, point 12
 * moved from (0, 0, 0) to (1, 2, 3)". Brief is without places, and no more than CAUSE_BRIEF groups of facts, those that
 * matter least left out. Prints nothing for an empty list. */
#define CAUSE_BRIEF 4
void cause_print_facts(FILE *out, const cause_facts *facts, bool brief);

/* All of it in one line: what differs in the sessions or else in the views, and what follows from that. Nothing where
 * both are the same. */
void cause_print_headline(FILE *out, const cause *c);

#endif
