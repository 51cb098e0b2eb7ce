/* explain.h - why two sides differ: a sentence for each pair, and a headline.
 *
 * Of two recordings it is told from their sessions, which are played side by side; of other frames from what they say
 * of themselves.
 */
#ifndef DIFF_EXPLAIN_H
#define DIFF_EXPLAIN_H

#include "cause.h"
#include "diff.h"
#include "trace.h"

/* What is known of two recordings. */
typedef struct explanation {
    recorded sides[2];
    cause cause;
    tracer tracer;
} explanation;

#define EXPLAIN_DEFAULT 10

/* Say why, of the first `most` pairs and ticks that differ; 0 says nothing. What goes wrong is result->trouble, and
 * makes the verdict one; false when there is no memory even for that. Two recordings whose frames are the same are
 * explained where their sessions, views or ticks are not. */
bool diff_explain(const diff_side *a, const diff_side *b, uint64_t most, diff_result *result, record_error *error);
void explanation_free(explanation *e);

/* Whether a pair has something to explain. */
bool explain_is_unlike(const diff_pair *pair);

#endif
