/* SPDX-License-Identifier: MIT */
/* baseline.h - a file of digests that says of each when it was accepted and why; a frame may have several.
 *
 *   octreel-digests 2
 *   background ffffff
 *   accepted 7f 2026-11-22 1280x720 runs the letters are larger
 *   accepted k3 2026-11-25 1280x720 runs Mesa 26 rounds otherwise
 *   7f 0123456789abcdef frame_000000
 *   k3 fedcba9876543210 frame_000000
 *   ...
 *
 * A fact a line, so that git shows and merges it: nothing counts, and no line depends on its place beyond that what was
 * accepted comes before its digests. Lines are written in order, and read in any: a merge by union (merge=union in
 * .gitattributes) is a baseline too. A name of two letters or digits follows from what it stands for, so that two
 * branches hardly choose the same; where they do, that is an error. What many frames share stands once, and ".png" is
 * left out: 1,000 frames in 3 variants take 99 KB.
 */
#ifndef DIFF_BASELINE_H
#define DIFF_BASELINE_H

#include "side.h"

#include <stdio.h>

/* When and why something is accepted. */
typedef struct acceptance_words {
    const char *date, *reason; /* YYYY-MM-DD; one line */
} acceptance_words;

/* Whether a date is one of the calendar; whether a reason fits a line and is not empty. */
bool baseline_is_date(const char *text);
bool baseline_is_reason(const char *text);

/* Read a line after the first two; digests are appended as frames until they are collected. */
bool baseline_take_line(diff_side *side, char *line, size_t number, octreel_error *error);

/* Give each name one frame with all its variants. */
bool baseline_collect(diff_side *side, octreel_error *error);

/* State by which acceptance a digest is taken over: one that the side has, or a new one. */
bool baseline_accept(diff_side *side, const acceptance_words *words, frame_digest *digest, octreel_error *error);

/* Append a frame with these digests, whose acceptances the side has. The first may stand for all until the next
 * baseline_collect(). */
bool baseline_add(diff_side *side, const char *name, const frame_digest *digests, size_t count, octreel_error *error);

/* Write the file. Acceptances of no digest are left out. False when a name has a character that no line can hold;
 * whether the stream took it all is left to the caller. */
bool baseline_write(FILE *out, const diff_side *side, octreel_error *error);

#endif
