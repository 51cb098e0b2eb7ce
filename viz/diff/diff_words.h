/* SPDX-License-Identifier: MIT */
/* diff_words.h - what a comparison found, in lines for people. Each is printed without its end. */
#ifndef DIFF_WORDS_H
#define DIFF_WORDS_H

#include "diff.h"

#include <stdio.h>

/* "same", "different" or "trouble". */
const char *diff_verdict_name(diff_verdict verdict);

/* The verdict and the counts. The verdict may be worse than that of the result: explaining may fail. */
void diff_print_verdict(FILE *out, const diff_result *result, diff_verdict verdict);

/* How one pair differs, with its name and without. */
void diff_print_pair(FILE *out, const diff_pair *pair);
void diff_print_difference(FILE *out, const diff_pair *pair);

/* A delta as it is printed, rounded up, so that what is printed is enough to forgive it. */
double diff_shown_delta(double delta);

/* Whether pairs of this finding are listed one by one: all but those that are the same without forgiveness. */
bool diff_is_listed(diff_finding finding);

/* Pairs that differ; unreadable ones do not count. */
size_t diff_count_different(const diff_result *result);

/* Pairs whose pictures differ in gamma or colour profile, which is ignored. */
size_t diff_count_color_spaces(const diff_result *result);

#endif
