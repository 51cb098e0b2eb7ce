/* SPDX-License-Identifier: MIT */
/* baseline.h - reads and writes baselines: text files that hold the accepted digests of each frame, with the date and
 * the reason of every acceptance.
 *
 *   octreel-digests 2
 *   background ffffff
 *   accepted 7f 2026-11-22 1280x720 runs the letters are larger
 *   accepted k3 2026-11-25 1280x720 runs Mesa 26 rounds differently
 *   7f 0123456789abcdef frame_000000
 *   k3 fedcba9876543210 frame_000000
 *   ...
 *
 * The format is made for git: each line holds one fact, so that git shows and merges it. No line holds a count, and the
 * order of lines matters only in that an acceptance comes before its digests. The writer sorts the lines; the reader
 * takes any order, so the result of a union merge (merge=union in .gitattributes) is a valid baseline. The two-letter
 * id of an acceptance is a hash of its date, size, kind and reason, so two branches rarely choose the same id for
 * different acceptances; when they do, the reader reports an error. Date, size and reason are stored once for all
 * frames of an acceptance, and ".png" is left out: 1,000 frames with 3 variants each take 99 KB.
 *
 * A frame with several digests has variants. It matches a baseline when its digest equals that of any variant.
 */
#ifndef DIFF_BASELINE_H
#define DIFF_BASELINE_H

#include "side.h"

#include <stdio.h>

/* When and why frames are accepted. */
typedef struct acceptance_note {
    const char *date;   /* YYYY-MM-DD */
    const char *reason; /* one line */
} acceptance_note;

/* Whether a text is a calendar date, YYYY-MM-DD. */
bool baseline_is_date(const char *text);

/* Whether a text can be a reason: not empty, one line, no blank at either end. */
bool baseline_is_reason(const char *text);

/* Read the baseline at side->source into side. On failure return false; the error names the file, the line and the
 * reason. Cost: O(n log n) time in the size of the file; at most 16 bytes of memory for each byte of the file. */
bool baseline_read(diff_side *side, octreel_error *error);

/* The same for a text in memory, which ends with a zero byte and is modified. */
bool baseline_parse(diff_side *side, char *text, size_t size, octreel_error *error);

/* Sort the frames by name and merge frames of the same name into one frame with all their variants. */
bool baseline_merge_frames(diff_side *side, octreel_error *error);

/* Set digest->acceptance to an acceptance of the side with this note and the digest's size and kind; add it to the side
 * if there is none. */
bool baseline_add_acceptance(diff_side *side, const acceptance_note *note, frame_digest *digest, octreel_error *error);

/* Append a frame with these variants, whose acceptances must be in the side. */
bool baseline_add_frame(diff_side *side, const char *name, const frame_digest *variants, size_t count,
                        octreel_error *error);

/* Append a variant unless the frame has it already. Return false if memory runs out. */
bool baseline_add_variant(diff_frame *frame, const frame_digest *digest);

/* Write the file, without acceptances that no digest uses. Return false when a frame's name contains a control
 * character or memory runs out; the caller checks the stream for write errors. */
bool baseline_write(FILE *out, const diff_side *side, octreel_error *error);

#endif
