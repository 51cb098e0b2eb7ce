/* SPDX-License-Identifier: MIT */
/* evidence.h - the folder that diff --output writes. It holds expected, actual and difference pictures, and
 * report.html. */
#ifndef REPORT_EVIDENCE_H
#define REPORT_EVIDENCE_H

#include "diff.h"
#include "groups.h"

#define EVIDENCE_PAGE "report.html"

/* Each picture, and the word in its file name. The pictures of frame_000041.png are frame_000041.expected.png and so
 * on. */
#define EVIDENCE_PICTURE_MAP(X)                                                                                        \
    X(EXPECTED, "expected")     /* a copy of the reference's file */                                                   \
    X(ACTUAL, "actual")         /* a copy of the frame's file */                                                       \
    X(DIFFERENCE, "difference") /* drawn by image_draw_difference_row() */

typedef enum evidence_picture {
#define EVIDENCE_PICTURE_ENUM(name, word) EVIDENCE_##name,
    EVIDENCE_PICTURE_MAP(EVIDENCE_PICTURE_ENUM)
#undef EVIDENCE_PICTURE_ENUM
        EVIDENCE_PICTURES
} evidence_picture;

const char *evidence_word(evidence_picture picture);

/* Return the file name of a frame's picture of evidence, or null if memory runs out. The caller frees the name. */
char *evidence_name(const char *frame, evidence_picture picture);

/* Return whether a file name is the name of an evidence picture, of report.html or of contact.png, finished or not. */
bool evidence_is_name(const char *name);

/* Write the existing pictures of a pair into a folder, and their difference if both pictures can be read. For each
 * written picture the bit (1 << evidence_picture) is set in *written. Both images are in memory; the difference is
 * written row by row. */
bool evidence_draw(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                   octreel_error *error);

typedef struct evidence {
    const char *folder; /* not owned */
    unsigned *pictures; /* for each pair, the bits (1 << evidence_picture) of the pictures that were written; owned */
} evidence;

/* Create the folder or, if it exists, remove the evidence of an earlier comparison from it. Return false with an
 * error if the folder holds other files, is a compared side, or contains one. */
bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error);

/* Write the pictures of the first pair of each differing group. */
bool evidence_collect(evidence *e, const char *folder, const diff_result *result, const frame_groups *groups,
                      octreel_error *error);
void evidence_release(evidence *e);

/* Return the path of one picture of the i-th pair. The caller frees the path. Return null if the picture was not
 * written or memory runs out. */
char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture);

#endif
