/* SPDX-License-Identifier: MIT */
/* explain.h - explains why two sides differ: in one headline, and in one sentence for each pair of frames.
 *
 * If both sides are recordings, their sessions are compared and played side by side. For other frames, only the text
 * chunks of the PNG files are known.
 *
 * An example of a report, with the function that prints each line:
 *
 *     different: 5 of 5 frames                                        report.c
 *     another leaf capacity (4, was 2): every tick from 0 on differs     the headline: print_headline() in explain.c
 *       frame_000001.png: 312 of 14400 pixels differ; ...             report.c
 *         tick 1: node 0/3/7 split, point 12 moved from ...           a pair: print_cause() in pair_look.c
 *         ...; 312 pixels: 180 of node 0/3/7, 132 of point 12         its pixels: trace_print()
 *
 * cause.h finds the facts of the headline and of the pair's sentence. cause_words.h prints them as sentences, and
 * cause_json.h writes them as JSON.
 */
#ifndef EXPLAIN_EXPLAIN_H
#define EXPLAIN_EXPLAIN_H

#include "cause.h"
#include "diff.h"
#include "trace.h"

/* Why the frames of one pair differ. */
typedef struct pair_cause {
    char *text;      /* one sentence; null if no cause is known; owned */
    char *key;       /* a text that is equal for all pairs with the same cause; null if no cause is known; owned */
    bool only_drawn; /* true: both frames show the same scene, so only rendering differs */
} pair_cause;

/* The explanation of a comparison. A zeroed explanation explains nothing. */
typedef struct explanation {
    char *headline;    /* one line that says why the sides differ; null if no cause is known; owned */
    char *trouble;     /* the error that prevented an explanation; null if there was no error; owned */
    pair_cause *pairs; /* one cause for each pair of the result; null if nothing is explained; owned */
    size_t count;
    bool recordings; /* true: both sides are recordings; if false, the members below are not used */
    recorded sides[2];
    cause cause;
    tracer tracer;
} explanation;

#define EXPLAIN_DEFAULT 10

/* Explain the first `most` differing pairs and ticks. If `most` is 0, explain nothing. Two recordings with equal
 * frames are explained, too, if their sessions, views or ticks differ. An error is stored in e->trouble. Return
 * false only if memory runs out even for this error. Both sides must outlive the explanation. */
bool explain(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most, explanation *e,
             octreel_error *error);
void explanation_release(explanation *e);

/* Return the sentence that explains the i-th pair, or null. */
const char *explanation_cause(const explanation *e, size_t i);

/* Return the verdict of the comparison. If the explanation failed, return DIFF_TROUBLE. */
diff_verdict explanation_verdict(const explanation *e, const diff_result *result);

/* Return whether the frames of a pair differ and can be read. Only such pairs are explained. */
bool explain_has_difference(const diff_pair *pair);

#endif
