/* SPDX-License-Identifier: MIT */
/* baseline.h - reads and writes baselines. A baseline is a text file with the accepted digests of each frame, and the
 * date and reason of every acceptance.
 *
 *     octreel-digests 2
 *     background ffffff
 *     accepted 7f 2026-11-22 1280x720 runs the letters are larger
 *     accepted k3 2026-11-25 1280x720 runs Mesa 26 rounds differently
 *     7f 0123456789abcdef frame_000000
 *     k3 fedcba9876543210 frame_000000
 *     ...
 *
 * The format is made for git. Each line holds one fact, so that git can show and merge it. No line holds a count. The
 * writer sorts the lines. The reader accepts the lines in any order in which each acceptance comes before its digests.
 * The result of a union merge (merge=union in .gitattributes) is therefore a valid baseline.
 *
 * The two-character id of an acceptance is a hash of its date, size, kind and reason. Two branches therefore rarely
 * choose the same id for different acceptances; if they do, the reader reports an error. Date, size and reason are
 * stored once for all frames of an acceptance, and ".png" is left out: 1,000 frames with 3 variants each take 99 KB.
 *
 * A baseline may also have rules, which rule.h describes, and comments, which are lines that begin with #. The writer
 * puts both before the acceptances, in the order in which they were read, and changes no byte of them.
 *
 * The accepted digests of a frame are its variants. A frame matches a baseline when its digest equals any variant.
 */
#ifndef DIFF_BASELINE_H
#define DIFF_BASELINE_H

#include "side.h"

#include <stdio.h>

/* The date on which frames are accepted, and the reason for accepting them. */
typedef struct acceptance_note {
    const char *date;   /* YYYY-MM-DD */
    const char *reason; /* a text of one line */
} acceptance_note;

/* Return whether a text is a calendar date, YYYY-MM-DD. */
bool baseline_is_date(const char *text);

/* Return whether a text can be a reason: it is not empty, is one line, and neither begins nor ends with a blank. */
bool baseline_is_reason(const char *text);

/* Return whether a name is the path of a file in a folder or its subfolders: no part of the path is empty, "." or
 * "..". */
bool baseline_is_path(const char *name);

/* Read the baseline at side->source into `side`. On failure return false with an error that names the file, the line
 * and the reason. Cost: O(n log n) time for a file of n bytes; at most 16 bytes of memory for each byte of the file. */
bool baseline_read(diff_side *side, octreel_error *error);

/* Parse a baseline from a text in memory, as baseline_read() does from a file. The text must end with a zero byte.
 * The function modifies the text. */
bool baseline_parse(diff_side *side, char *text, size_t size, octreel_error *error);

/* Sort the frames by name. Merge frames of the same name into one frame that has the variants of all of them. */
bool baseline_merge_frames(diff_side *side, octreel_error *error);

/* Set digest->acceptance to the acceptance with the date and reason of `note` and the size and kind of the digest.
 * If the side has no such acceptance, append one. */
bool baseline_add_acceptance(diff_side *side, const acceptance_note *note, frame_digest *digest, octreel_error *error);

/* Append a frame with a list of variants. The acceptances of the variants must already be in the side. */
bool baseline_add_frame(diff_side *side, const char *name, const frame_digest *variants, size_t count,
                        octreel_error *error);

/* Append a variant to a frame. If the frame already has this variant, nothing is added. Return false if memory runs
 * out. */
bool baseline_add_variant(diff_frame *frame, const frame_digest *digest);

/* Write the baseline, without acceptances that no digest uses. Return false if a frame's name contains a control
 * character or memory runs out. The caller checks the stream for write errors. */
bool baseline_write(FILE *out, const diff_side *side, octreel_error *error);

#endif
