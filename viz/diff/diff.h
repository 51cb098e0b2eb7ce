/* SPDX-License-Identifier: MIT */
/* diff.h - compares two sides frame by frame and gives each pair of frames a finding. */
#ifndef DIFF_DIFF_H
#define DIFF_DIFF_H

#include "pair.h"

typedef struct diff_result {
    diff_options options; /* the options with which the sides were compared */
    diff_pair *pairs;     /* the pairs, sorted by the names of their frames; owned */
    size_t count;
    size_t found[DIFF_FINDINGS]; /* found[f]: the number of pairs with finding f */
    diff_verdict verdict;
    /* the rules of the reference, set by picture_store_fetch(); not owned */
    const baseline_rule *rules;
    size_t rule_count;
    bool by_ticks; /* true: neither recording has frames, so their ticks.jsonl files were compared byte by byte */
} diff_result;

/* Check that two sides can be compared. No picture is read. Return false with an error in these cases: a picture and
 * a folder; a baseline with a tolerance but without a store; a store but no baseline as the reference; two empty
 * folders; only one side is a recording without frames. */
bool diff_check(const diff_side *a, const diff_side *b, const diff_options *options, octreel_error *error);

/* Compare the frames of `b` with the reference `a`, on all cores. Files with equal bytes are not decoded. Other
 * pictures are read a few rows at a time. A whole picture is in memory only with --antialias or --flip, or if it is
 * interlaced or has 16 bits a sample. Both sides and the lists in the options must outlive the result. Return false
 * with an error if diff_check() fails or memory runs out. */
bool diff_run(const diff_side *a, const diff_side *b, const diff_options *options, diff_result *result,
              octreel_error *error);
void diff_release(diff_result *result);

/* Count the pairs with each finding, and update the verdict of the result. */
void diff_count_findings(diff_result *result);

/* Return the tick in the name of a pair of frames. Return DIFF_NO_TICK if the name is not that of a frame of a
 * recording. */
#define DIFF_NO_TICK UINT64_MAX
uint64_t diff_pair_tick(const diff_pair *pair);

/* Return the pair with this name, or null. */
const diff_pair *diff_find(const diff_result *result, const char *name);

#endif
