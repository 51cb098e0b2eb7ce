/* SPDX-License-Identifier: MIT */
/* diff_words.h - prints the result of a comparison for people, in lines without their newlines. */
#ifndef DIFF_WORDS_H
#define DIFF_WORDS_H

#include "diff.h"

#include <stdio.h>

/* "same", "different" or "trouble". */
const char *diff_verdict_name(diff_verdict verdict);

/* Print the verdict and the counts. The verdict may be worse than that of the result, because explaining may fail. */
void diff_print_verdict(FILE *out, const diff_result *result, diff_verdict verdict);

/* Print the tolerance, or that there is none; the background of transparent pixels; and ignored colour spaces. */
void diff_print_tolerance(FILE *out, const diff_result *result);

/* Print how one pair differs: with its name, and without. */
void diff_print_pair(FILE *out, const diff_pair *pair);
void diff_print_difference(FILE *out, const diff_pair *pair);

/* A color difference rounded up to four decimals, so that the printed number works as --max-delta. */
double diff_shown_delta(double delta);

/* Whether reports list pairs with this finding: all except pairs that are equal without any tolerance. */
bool diff_is_listed(diff_finding finding);

/* The number of pairs that differ, without unreadable ones. */
size_t diff_count_different(const diff_result *result);

/* The number of pairs that differ in gamma or color profile, which is ignored. */
size_t diff_count_color_spaces(const diff_result *result);

#endif
