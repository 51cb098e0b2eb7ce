/* SPDX-License-Identifier: MIT */
/* evidence.h - the folder of evidence, which diff --output writes. The folder holds expected, actual and difference
 * pictures, and report.html. */
#ifndef REPORT_EVIDENCE_H
#define REPORT_EVIDENCE_H

#include "diff.h"
#include "groups.h"

#define EVIDENCE_PAGE "report.html"

/* The kinds of pictures, each with the word that its file names contain. For frame_000041.png the files are
 * frame_000041.expected.png, frame_000041.actual.png, frame_000041.difference.png and frame_000041.flip.png. */
#define EVIDENCE_PICTURE_MAP(X)                                                                                        \
    X(EXPECTED, "expected")     /* a copy of the reference frame's file */                                             \
    X(ACTUAL, "actual")         /* a copy of the compared frame's file */                                              \
    X(DIFFERENCE, "difference") /* drawn by image_draw_difference_row() */                                             \
    X(FLIP, "flip")             /* with --flip, the map of image_measure_flip() */

typedef enum evidence_picture {
#define EVIDENCE_PICTURE_ENUM(name, word) EVIDENCE_##name,
    EVIDENCE_PICTURE_MAP(EVIDENCE_PICTURE_ENUM)
#undef EVIDENCE_PICTURE_ENUM
        EVIDENCE_PICTURES
} evidence_picture;

const char *evidence_picture_name(evidence_picture picture);

/* Return the file name of a frame's picture of evidence, or null if memory runs out. The caller frees the name. */
char *evidence_file_name(const char *frame, evidence_picture picture);

/* Return whether a file name is that of an evidence picture, of report.html or of contact.png. The name of an
 * unfinished file, which ends in ".part", counts too. */
bool evidence_is_file_name(const char *name);

/* Write the expected and the actual picture of a pair into a folder, as far as they exist. If both can be read, also
 * write their difference, and their FLIP map if FLIP was measured. For each written picture the bit (1 <<
 * evidence_picture) is set in *written. Both images are held in memory; the difference is written row by row. */
bool evidence_write_pair(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                         octreel_error *error);

/* Return whether a difference can be drawn: both pictures of the pair exist, and they differ. */
bool evidence_has_difference(const diff_pair *pair);

/* Draw the difference of a pair into a PNG file. */
bool evidence_write_difference(const diff_pair *pair, const diff_options *options, const char *path,
                               octreel_error *error);

typedef struct evidence {
    const char *folder; /* not owned */
    unsigned *pictures; /* for each pair, the bits (1 << evidence_picture) of the pictures that were written; owned */
} evidence;

/* Create the folder for evidence. If the folder exists, remove the evidence of an earlier comparison from it. Return
 * false with an error if the folder holds other files, is one of the compared sides, or contains a compared side. */
bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error);

/* Write the pictures of the first pair of each differing group. */
bool evidence_write_groups(evidence *e, const char *folder, const diff_result *result, const frame_groups *groups,
                           octreel_error *error);
void evidence_release(evidence *e);

/* Return the path of one picture of the i-th pair. The caller frees the path. Return null if the picture was not
 * written or memory runs out. */
char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture);

#endif
