/* SPDX-License-Identifier: MIT */
/* cause_words.h - prints sentences that say why two recordings differ. */
#ifndef EXPLAIN_CAUSE_WORDS_H
#define EXPLAIN_CAUSE_WORDS_H

#include "cause.h"

#include <stdio.h>

/* Print facts separated by commas. Minor facts follow after a semicolon: "node 0/3/7 only in the frames, point 12 moved
 * from (0, 0, 0) to (1, 2, 3)". With `brief`, leave out positions, print minor facts only if there are no other facts,
 * and print only the first CAUSE_BRIEF groups. */
#define CAUSE_BRIEF 4
void cause_print_facts(FILE *out, const cause_facts *facts, bool brief);

/* Print one line: the differences between the sessions and between the views, and how many ticks differ. Print
 * nothing if sessions and views are equal. */
void cause_print_headline(FILE *out, const cause *c);

#endif
