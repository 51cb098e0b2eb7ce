/* SPDX-License-Identifier: MIT */
/* evidence.h - the folder of diff --output: expected, actual and difference pictures, and report.html. */
#ifndef REPORT_EVIDENCE_H
#define REPORT_EVIDENCE_H

#include "diff.h"
#include "groups.h"

#define EVIDENCE_PAGE "report.html"

/* Each picture, and the word in its file's name: frame_000041.png leaves frame_000041.expected.png and so on. */
#define EVIDENCE_PICTURE_MAP(X)                                                                                        \
    X(EXPECTED, "expected")     /* the reference's file, as it is */                                                   \
    X(ACTUAL, "actual")         /* the frame's file, as it is */                                                       \
    X(DIFFERENCE, "difference") /* image_draw_difference_row() */

typedef enum evidence_picture {
#define EVIDENCE_PICTURE_ENUM(name, word) EVIDENCE_##name,
    EVIDENCE_PICTURE_MAP(EVIDENCE_PICTURE_ENUM)
#undef EVIDENCE_PICTURE_ENUM
        EVIDENCE_PICTURES
} evidence_picture;

const char *evidence_word(evidence_picture picture);

/* The name of a frame's picture; the caller frees it. Null if memory runs out. */
char *evidence_name(const char *frame, evidence_picture picture);

/* Whether a file name is that of such a picture, the page or the contact sheet, complete or not. */
bool evidence_is_name(const char *name);

/* Write the pictures of a pair into a folder: those that exist, and the difference if both can be read. *written gets a
 * bit (1 << evidence_picture) for each. Both images are in memory; the difference is written row by row. */
bool evidence_draw(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                   octreel_error *error);

typedef struct evidence {
    const char *folder; /* not owned */
    unsigned *pictures; /* for each pair, a bit (1 << evidence_picture) for each picture that was written; owned */
} evidence;

/* Create the folder, or remove the evidence of an earlier comparison from it. Return false with an error if the folder
 * holds other files, or is or holds one of the compared sides. */
bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error);

/* Write the pictures of the first pair of each differing group. */
bool evidence_collect(evidence *e, const char *folder, const diff_result *result, const frame_groups *groups,
                      octreel_error *error);
void evidence_release(evidence *e);

/* The path of a picture of the i-th pair; the caller frees it. Null if it was not written or memory runs out. */
char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture);

#endif
