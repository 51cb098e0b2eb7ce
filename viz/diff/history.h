/* SPDX-License-Identifier: MIT */
/* history.h - the digests that a baseline accepted earlier. octreel accept keeps them in BASELINE.history, a text file
 * beside the baseline. octreel diff recognizes by it a frame whose digest flips among known ones: such a frame is
 * flaky, and another acceptance would not help.
 *
 *     octreel-history 1
 *     2026-11-02 runs 0123456789abcdef menu/1.png
 *
 * A line holds the date on which a digest was accepted, the kind of digest, the digest and the frame. Lines are sorted
 * by frame, then by date, so that git can merge them (merge=union). The digests that are accepted now are in the
 * baseline, not here. */
#ifndef DIFF_HISTORY_H
#define DIFF_HISTORY_H

#include "diff.h"

#define HISTORY_ENDING ".history"
/* The number of digests of a frame that are kept; older ones are dropped. */
#define HISTORY_DIGESTS 8

typedef struct history_line {
    char date[11];
    image_digest_kind kind;
    uint64_t pixels;
    char *name;   /* the name of the frame; owned */
    size_t index; /* the order in which lines were added; it decides between equal dates */
} history_line;

typedef struct history {
    history_line *lines; /* owned */
    size_t count, room;
} history;

/* Read the history of a baseline. A file that does not exist is an empty history. Return false with an error if the
 * file cannot be read or has an invalid line. */
bool history_read(history *h, const char *baseline, octreel_error *error);
void history_release(history *h);

/* Append the accepted digests of a frame of a baseline that the baseline `now` does not accept any more. */
bool history_add_frame(history *h, const diff_side *now, const diff_frame *before, octreel_error *error);

/* Write the history of the frames of a baseline, if it is not empty. */
bool history_write(history *h, const diff_side *now, octreel_error *error);

/* For each pair of a baseline whose digest was accepted earlier, set pair->flaky. The verdict does not change. */
bool history_find_flaky(const diff_side *reference, diff_result *result, octreel_error *error);

#endif
