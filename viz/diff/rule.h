/* SPDX-License-Identifier: MIT */
/* rule.h - rules in baselines. A rule forgives differences of the frames whose names match its pattern, for a reason
 * and, if it has an expiry date, for a time:
 *
 *     rule menu/start max-delta=0.02 reason=the gradient is dithered at random
 *     rule hud* ignore=1800,0,120,40 date=2026-11-27 expires=2027-01-31 reason=the clock shows the time
 *
 * A rule is one line, so that git can show and merge it. Its order among the rules matters only for rules that are
 * equally specific; see rule_find(). baseline.c keeps the lines as they are.
 *
 * A rule needs pixels, and a baseline has only digests. So a rule is applied to a frame whose digest differs, and only
 * if a picture store has the picture of an accepted digest.
 */
#ifndef DIFF_RULE_H
#define DIFF_RULE_H

#include "mask.h"
#include "side.h"
#include "tolerance.h"

/* Limits that keep reading and matching fast for any file. */
#define RULES_MOST 1000
#define RULE_PATTERN_LONGEST 255
#define RULE_RECTANGLES_MOST 64

typedef struct baseline_rule {
    const char *file; /* the name of the baseline in messages; not owned */
    size_t line;      /* the number of the rule's line */
    char *text;       /* the memory into which the following texts point; owned */
    /* Frames whose name matches: * stands for any characters, also for slashes, ? for one character, and \ before a
     * character for this character. */
    const char *pattern;
    const char *date;    /* the date of the rule, YYYY-MM-DD; null: not given */
    const char *expires; /* the last day on which the rule forgives; null: it never expires */
    const char *reason;  /* why the differences are forgiven */
    const char *layers;  /* names of layers of recordings that are not compared, separated by commas; null: none */
    const char *mask;    /* the path of a PNG: where it is neither black nor transparent, pixels are not compared */
    const char *base;    /* the path of the baseline, to whose folder `mask` is relative; not owned */
    image_tolerance tolerance;
    size_t matched; /* set by picture_store_fetch(): the number of frames of the baseline whose rule this is */
} baseline_rule;

/* Read a rule from its line in a baseline, and append it to side->rules. `line` begins after the word "rule ". Return
 * false with an error if the line is invalid. */
bool rule_read(diff_side *side, const char *line, size_t number, octreel_error *error);
void rules_release(diff_side *side);

/* Check the rules against the frames of the baseline: a rectangle must overlap a frame that its rule matches, and a
 * mask must be readable and have the size of each of these frames. Without `files`, masks are not read. */
bool rules_check(const diff_side *side, bool files, octreel_error *error);

/* Return the rule for a frame, or null. If several rules match, the most specific rule counts: a name before a pattern,
 * a pattern with more characters besides * and ? before one with fewer, then the later line. */
baseline_rule *rule_find(const diff_side *side, const char *frame);

/* Return whether a rule does not forgive any more on a day, YYYY-MM-DD. */
bool rule_has_expired(const baseline_rule *rule, const char *today);

/* Add the pixels of the rule's rectangles and of its mask picture to the mask of a frame of this size. Return false
 * with an error if the mask picture cannot be read or memory runs out. A mask of another size adds nothing. */
bool rule_add_mask(const baseline_rule *rule, int width, int height, pixel_mask *mask, octreel_error *error);

/* Set `today` to the current date, YYYY-MM-DD: the day of SOURCE_DATE_EPOCH in UTC, if the environment has it
 * (reproducible-builds.org), else the local day of the system's clock. Return false with an error if SOURCE_DATE_EPOCH
 * is no number of seconds. */
bool rule_today(char today[11], octreel_error *error);

#endif
