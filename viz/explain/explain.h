/* SPDX-License-Identifier: MIT */
/* explain.h - why two sides differ: a sentence for each pair, and a headline.
 *
 * Two recordings are explained by their sessions, which are played side by side; other frames by their text chunks.
 *
 * The function that prints each line:
 *   different: 5 of 5 frames                                        report.c
 *   another leaf capacity (4, was 2): every tick from 0 differs     the headline: print_headline() in explain.c
 *     frame_000001.png: 312 of 14400 pixels differ; ...             report.c
 *       tick 1: node 0/3/7 split, point 12 moved from ...           a pair: print_cause() in pair_look.c
 *       ...; 312 pixels: 180 of node 0/3/7, 132 of point 12         its pixels: trace_print()
 * The facts in the second and the fourth line are found by cause.h and printed by cause_words.h and, as JSON,
 * cause_json.h.
 */
#ifndef EXPLAIN_EXPLAIN_H
#define EXPLAIN_EXPLAIN_H

#include "cause.h"
#include "diff.h"
#include "trace.h"

/* Why the frames of one pair differ. */
typedef struct pair_cause {
    char *text;      /* one sentence; null where none is known; owned */
    char *key;       /* the same in all pairs that differ for one cause; null where nothing tells; owned */
    bool only_drawn; /* both frames show the same scene, as they were drawn */
} pair_cause;

/* A zeroed one explains nothing. */
typedef struct explanation {
    char *headline;    /* one line: why the sides differ; null where none is known; owned */
    char *trouble;     /* why it could not be explained; owned */
    pair_cause *pairs; /* one a pair of the result; null where nothing is explained; owned */
    size_t count;
    bool recordings; /* both sides are recordings; the rest is about them */
    recorded sides[2];
    cause cause;
    tracer tracer;
} explanation;

#define EXPLAIN_DEFAULT 10

/* Say why, of the first `most` pairs and ticks that differ; 0 says nothing. What goes wrong is e->trouble; false when
 * there is no memory even for that. Two recordings whose frames are the same are explained where their sessions, views
 * or ticks are not. Both sides must outlive the explanation. */
bool explain(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most, explanation *e,
             octreel_error *error);
void explanation_release(explanation *e);

/* The sentence of the i-th pair, or null; and its key. */
const char *explanation_cause(const explanation *e, size_t i);
const char *explanation_key(const explanation *e, size_t i);

/* The verdict of the result, or trouble where explaining failed. */
diff_verdict explanation_verdict(const explanation *e, const diff_result *result);

/* Whether a pair has something to explain. */
bool explain_is_unlike(const diff_pair *pair);

#endif
