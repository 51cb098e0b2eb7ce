/* SPDX-License-Identifier: MIT */
/* baseline_text.h - baselines from texts, and texts from baselines, for tests. */
#ifndef BASELINE_TEXT_H
#define BASELINE_TEXT_H

#include "baseline.h"

/* The first two lines of a baseline. */
#define BASELINE_HEAD "octreel-digests 2\nbackground ffffff\n"

/* Parse a baseline of the path "file". Returns false with an error. Release the side in both cases. */
bool parse_baseline(const char *text, diff_side *side, octreel_error *error);

/* Parse a baseline; the test fails if that fails. */
diff_side assert_baseline_parsed(const char *text);

/* Write a baseline as text, which the caller frees. */
char *write_baseline_text(const diff_side *side);

#endif
