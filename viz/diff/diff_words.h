/* SPDX-License-Identifier: MIT */
/* diff_words.h - prints the result of a comparison for people. Each function prints one line without its newline. */
#ifndef DIFF_WORDS_H
#define DIFF_WORDS_H

#include "diff.h"

#include <stdio.h>

/* Return "same", "different" or "trouble". */
const char *diff_verdict_name(diff_verdict verdict);

/* Print the verdict and the counts. The argument `verdict` may be worse than the verdict of the result, because
 * explaining the differences may fail. */
void diff_print_verdict(FILE *out, const diff_result *result, diff_verdict verdict);

/* Print the tolerance, or that no tolerance is set. Also print the background of transparent pixels and whether
 * color spaces were ignored. */
void diff_print_tolerance(FILE *out, const diff_result *result);

/* Print how the frames of a pair differ. diff_print_pair() prints the name of the pair first;
 * diff_print_difference() does not. */
void diff_print_pair(FILE *out, const diff_pair *pair);
void diff_print_difference(FILE *out, const diff_pair *pair);

/* Round a color difference up to four decimals, so that the printed number works as the value of --max-delta. */
double diff_shown_delta(double delta);

/* Return whether reports list pairs with this finding. They list all pairs except those that are equal without a
 * tolerance. */
bool diff_is_listed(diff_finding finding);

/* Return the number of pairs that differ. Unreadable pairs are not counted. */
size_t diff_count_different(const diff_result *result);

/* Return the number of pairs that differ in gamma or color profile. These differences are ignored. */
size_t diff_count_color_spaces(const diff_result *result);

#endif
