/* SPDX-License-Identifier: MIT */
/* diff_words.h - prints the result of a comparison for people. Each function prints one line without a newline at
 * its end. */
#ifndef DIFF_WORDS_H
#define DIFF_WORDS_H

#include "diff.h"

#include <stdio.h>

/* Return "same", "different" or "trouble". */
const char *diff_verdict_name(diff_verdict verdict);

/* Print the verdict and the counts. `verdict` is worse than the verdict of the result if explaining the differences
 * failed. */
void diff_print_verdict(FILE *out, const diff_result *result, diff_verdict verdict);

/* Print the tolerance, or that no tolerance is set. Also print the background of transparent pixels and whether
 * color spaces were ignored. */
void diff_print_tolerance(FILE *out, const diff_result *result);

/* Print how the frames of a pair differ. diff_print_pair() first prints the name of the pair;
 * diff_print_difference() prints no name. */
void diff_print_pair(FILE *out, const diff_pair *pair);
void diff_print_difference(FILE *out, const diff_pair *pair);

/* Print what the rule of a pair did, as in "forgiven by the rule baseline.txt:12 until 2027-01-31: the clock shows the
 * time". The rule must have been used. */
void diff_print_rule(FILE *out, const diff_pair *pair);

/* Return the name of an effect in JSON, such as "forgave". */
const char *diff_rule_effect_name(rule_effect effect);

/* Round a color difference or a mean FLIP up to four decimals. The rounded number is not smaller than the difference,
 * so a user can give it to --max-delta or --flip. */
double diff_round_delta(double delta);

/* Return whether reports list pairs with this finding. Reports list all pairs except pairs whose frames are equal
 * without a tolerance. */
bool diff_is_listed(diff_finding finding);

/* Return the number of pairs that differ. Unreadable pairs are not counted. */
size_t diff_count_different(const diff_result *result);

/* Return the number of pairs whose frames differ in gamma or color profile. The comparison ignores these
 * differences. */
size_t diff_count_color_spaces(const diff_result *result);

#endif
