/* report.h - what a comparison found, for people and for programs. */
#ifndef DIFF_REPORT_H
#define DIFF_REPORT_H

#include "diff.h"

#include <stdio.h>

/* What is reported: both sides, how they were compared, and what came of it. */
typedef struct diff_report {
    const diff_side *a, *b;
    const diff_options *options;
    const diff_result *result;
} diff_report;

/* "same", "different" or "trouble". */
const char *diff_verdict_name(diff_verdict verdict);

/* The verdict, the headline, a line for each frame that is not the same (at most DIFF_REPORT_LINES) and one for its
 * cause, and what was forgiven. */
#define DIFF_REPORT_LINES 40
void diff_report_text(FILE *out, const diff_report *report);

/* One JSON object on one line, with all frames that are not the same. */
void diff_report_json(FILE *out, const diff_report *report);

/* How one pair differs, in one line without its end. */
void diff_print_pair(FILE *out, const diff_pair *pair);

#endif
