/* evidence_pictures.h - what is left of a pair that differs: pictures to look at. */
#ifndef DIFF_EVIDENCE_PICTURES_H
#define DIFF_EVIDENCE_PICTURES_H

#include "diff.h"

/* Each picture, and the word in its file's name: frame_000041.png leaves frame_000041.expected.png and so on. */
#define EVIDENCE_PICTURE_MAP(X)                                                                                        \
    X(EXPECTED, "expected")     /* the reference's file, as it is */                                                   \
    X(ACTUAL, "actual")         /* the frame's file, as it is */                                                       \
    X(DIFFERENCE, "difference") /* image_difference_row() */                                                           \
    X(SIDE, "side")             /* these three, side by side */

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

/* Write into a folder what can be had: the files that there are, and the difference where both can be read. *written
 * receives a bit (1 << evidence_picture) for each. Both images are in memory, and of what is drawn a row at a time. */
bool evidence_draw(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                   octreel_error *error);

#endif
