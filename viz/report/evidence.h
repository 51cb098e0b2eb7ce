/* SPDX-License-Identifier: MIT */
/* evidence.h - a folder that shows what a comparison found: pictures of each pair that differs, and report.html. */
#ifndef REPORT_EVIDENCE_H
#define REPORT_EVIDENCE_H

#include "diff.h"
#include "groups.h"

#define EVIDENCE_PAGE "report.html"

/* Each picture, and the word in its file's name: frame_000041.png leaves frame_000041.expected.png and so on. */
#define EVIDENCE_PICTURE_MAP(X)                                                                                        \
    X(EXPECTED, "expected")     /* the reference's file, as it is */                                                   \
    X(ACTUAL, "actual")         /* the frame's file, as it is */                                                       \
    X(DIFFERENCE, "difference") /* image_difference_row() */

typedef enum evidence_picture {
#define EVIDENCE_PICTURE_ENUM(name, word) EVIDENCE_##name,
    EVIDENCE_PICTURE_MAP(EVIDENCE_PICTURE_ENUM)
#undef EVIDENCE_PICTURE_ENUM
        EVIDENCE_PICTURES
} evidence_picture;

const char *evidence_word(evidence_picture picture);

/* The name of a frame's picture; the caller frees it, null when there is no memory. */
char *evidence_name(const char *frame, evidence_picture picture);

/* Whether a file's name is that of such a picture, or of one half written. */
bool evidence_is_name(const char *name);

/* Write into a folder the files that exist, and the difference where both can be read. *written
 * receives a bit (1 << evidence_picture) for each. Both images are in memory, and of what is drawn a row at a time. */
bool evidence_draw(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                   octreel_error *error);

typedef struct evidence {
    const char *folder; /* not owned */
    unsigned *pictures; /* of each pair, a bit (1 << evidence_picture) for each that is there; owned */
} evidence;

/* Make the folder, or empty it of an earlier comparison's evidence, so that what is in it is of this one alone. Refused
 * is a folder that holds anything else, or that is or holds what is compared. */
bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error);

/* Draw the first pair of each group that differs, one after the other. */
bool evidence_collect(evidence *e, const char *folder, const diff_result *result, const frame_groups *groups,
                      octreel_error *error);
void evidence_release(evidence *e);

/* The path of a picture of the i-th pair: null when it is not there, or there is no memory; the caller frees it. */
char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture);

#endif
