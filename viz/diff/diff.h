/* SPDX-License-Identifier: MIT */
/* diff.h - two sides are compared frame by frame, and each pair gets its finding. */
#ifndef DIFF_DIFF_H
#define DIFF_DIFF_H

#include "mask.h"
#include "side.h"
#include "image_compare.h"

/* Each finding, its name in reports, and what it means for the whole. */
#define DIFF_FINDING_MAP(X)                                                                                            \
    X(SAME_BYTES, "same_bytes", DIFF_SAME)          /* found without decoding */                                       \
    X(SAME_PIXELS, "same_pixels", DIFF_SAME)        /* encoded differently */                                          \
    X(WITHIN, "within_tolerance", DIFF_SAME)        /* different, all within the tolerance */                          \
    X(PIXELS, "pixels", DIFF_DIFFERENT)             /* different beyond the tolerance */                               \
    X(SIZE, "size", DIFF_DIFFERENT)                 /* of different width or height */                                 \
    X(DIGEST, "digest", DIFF_DIFFERENT)             /* of the same size, with different digests */                     \
    X(NO_FRAME, "no_frame", DIFF_DIFFERENT)         /* a reference without a frame */                                  \
    X(NO_REFERENCE, "no_reference", DIFF_DIFFERENT) /* a frame without a reference */                                  \
    X(UNREADABLE, "unreadable", DIFF_TROUBLE)

typedef enum diff_finding {
#define DIFF_FINDING_ENUM(name, text, verdict) FOUND_##name,
    DIFF_FINDING_MAP(DIFF_FINDING_ENUM)
#undef DIFF_FINDING_ENUM
        DIFF_FINDINGS
} diff_finding;

/* Least severe first: the verdict of a whole is that of its worst pair. */
typedef enum diff_verdict { DIFF_SAME, DIFF_DIFFERENT, DIFF_TROUBLE } diff_verdict;

const char *diff_finding_name(diff_finding finding);
diff_verdict diff_finding_verdict(diff_finding finding);

struct diff_pair;

/* Adds to the mask of each pair where some layers are seen in its frames: it is given by the caller since it plays
 * recordings. False with an error where it fails. */
typedef bool diff_mask(void *context, const diff_side *a, const diff_side *b, struct diff_pair **pairs, size_t count,
                       octreel_error *error);

typedef struct diff_options {
    image_tolerance tolerance;
    image_color background; /* transparent pixels are laid over it */
    diff_mask *mask;        /* null: no layer is left out */
    void *mask_context;
    const char *layers; /* names of the layers that are left out, separated by commas */
} diff_options;

/* Exact, over white. */
diff_options diff_options_default(void);

/* A frame of the reference (a), a frame that is compared with it (b), and the result of comparing them. */
typedef struct diff_pair {
    const diff_frame *a, *b; /* null: there is none */
    diff_finding finding;
    frame_digest about[2];       /* the sizes, and the digests where one side has no pixels; zero: not looked at */
    bool transparent;            /* the background shows in one of them */
    bool other_color_space;      /* they differ in gamma or profile, which changes no pixel */
    image_difference difference; /* where both were decoded */
    pixel_mask mask;             /* what the layers that are left out cover */
    char *trouble;               /* the error of what is unreadable; owned */
    char *no_picture;            /* why the store has none of the reference; owned */
    bool unserved;               /* by the system: it may be readable */
} diff_pair;

typedef struct diff_result {
    diff_options options; /* those that it was compared with */
    diff_pair *pairs;     /* in the order of names */
    size_t count;
    size_t found[DIFF_FINDINGS]; /* pairs of each finding */
    diff_verdict verdict;
    bool by_ticks; /* neither recording has frames, so ticks.jsonl was compared, byte by byte */
} diff_result;

/* False with an error when the sides cannot be compared at all: a picture with a folder, a tolerance for digests,
 * two empty folders, frames with a recording that has none by its recording.json. No picture is read. */
bool diff_check(const diff_side *a, const diff_side *b, const diff_options *options, octreel_error *error);

/* Compare b with the reference a, on all cores. Identical files are found by their bytes; the others are decoded. Of a
 * pair a few rows are in memory; both pictures are with a tolerance for anti-aliasing, and a picture that is interlaced
 * or has 16 bits a sample is in any case. Both sides and the options' lists must outlive the result. False with an
 * error when diff_check() fails, or there is no memory. */
bool diff_run(const diff_side *a, const diff_side *b, const diff_options *options, diff_result *result,
              octreel_error *error);
void diff_release(diff_result *result);

/* Count the findings anew, and set the verdict by them. */
void diff_count(diff_result *result);

/* Find by the pixels, or by the digests, of a pair that has both frames. The finding is set in any case. */
void compare_pixels(diff_pair *pair, const diff_options *options);

/* What is forgiven in one pair: as the options have it, and what its mask leaves out. False when there is no memory; to
 * be released in any case. */
bool pair_tolerance(const diff_pair *pair, const diff_options *options, image_tolerance *tolerance);
void pair_tolerance_release(image_tolerance *tolerance);

/* The name of a pair: that of its new frame, or of the reference that has none. */
const char *diff_pair_name(const diff_pair *pair);

/* The pair of a name, or null. */
const diff_pair *diff_find(const diff_result *result, const char *name);

#endif
