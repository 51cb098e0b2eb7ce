/* SPDX-License-Identifier: MIT */
/* diff.h - compares two sides frame by frame and gives each pair of frames a finding. */
#ifndef DIFF_DIFF_H
#define DIFF_DIFF_H

#include "mask.h"
#include "side.h"
#include "image_compare.h"

/* The findings. Each row has the finding, its name in reports, and the verdict for a pair with this finding. */
#define DIFF_FINDING_MAP(X)                                                                                            \
    X(SAME_BYTES, "same_bytes", DIFF_SAME)          /* the files have equal bytes and were not decoded */              \
    X(SAME_PIXELS, "same_pixels", DIFF_SAME)        /* the files differ, but their pixels are equal */                 \
    X(WITHIN, "within_tolerance", DIFF_SAME)        /* the pixels differ, but within the tolerance */                  \
    X(PIXELS, "pixels", DIFF_DIFFERENT)             /* the pixels differ beyond the tolerance */                       \
    X(SIZE, "size", DIFF_DIFFERENT)                 /* the widths or heights differ */                                 \
    X(DIGEST, "digest", DIFF_DIFFERENT)             /* the sizes are equal, but the digests differ */                  \
    X(NO_FRAME, "no_frame", DIFF_DIFFERENT)         /* the reference frame has no compared frame of the same name */   \
    X(NO_REFERENCE, "no_reference", DIFF_DIFFERENT) /* the compared frame has no reference frame of the same name */   \
    X(UNREADABLE, "unreadable", DIFF_TROUBLE)

typedef enum diff_finding {
#define DIFF_FINDING_ENUM(name, text, verdict) FOUND_##name,
    DIFF_FINDING_MAP(DIFF_FINDING_ENUM)
#undef DIFF_FINDING_ENUM
        DIFF_FINDINGS
} diff_finding;

/* The verdicts, in ascending order of severity. The verdict of a comparison is the worst verdict of any pair. */
typedef enum diff_verdict { DIFF_SAME, DIFF_DIFFERENT, DIFF_TROUBLE } diff_verdict;

const char *diff_finding_name(diff_finding finding);
diff_verdict diff_finding_verdict(diff_finding finding);

struct diff_pair;

/* A callback that adds the pixels of ignored layers to the mask of each pair. The caller of diff_run() provides it,
 * because this folder cannot play recordings. The callback returns false with an error on failure. */
typedef bool diff_mask(void *context, const diff_side *a, const diff_side *b, struct diff_pair **pairs, size_t count,
                       octreel_error *error);

typedef struct diff_options {
    image_tolerance tolerance;
    image_color background; /* the color that is drawn behind transparent pixels */
    diff_mask *mask;        /* the callback that masks ignored layers; null: no layer is ignored */
    void *mask_context;
    const char *layers; /* the names of the ignored layers, separated by commas */
    const char *store;  /* the picture store of the reference, which must be a baseline; null: no picture store */
} diff_options;

/* Return options without a tolerance and with a white background. */
diff_options diff_options_default(void);

/* A pair: the frame `a` of the reference, the compared frame `b`, and the result of their comparison. */
typedef struct diff_pair {
    const diff_frame *a, *b; /* null if the side has no frame of this name */
    diff_finding finding;
    /* the size of each frame; if a side is a baseline, also the digest of each frame; zero: unknown */
    frame_digest about[2];
    bool transparent;            /* true: a frame has transparent pixels, so the background color is visible */
    bool other_color_space;      /* true: the frames differ in gamma or color profile, which the comparison ignores */
    image_difference difference; /* valid only if both frames were decoded */
    pixel_mask mask;             /* the pixels of ignored layers */
    char *trouble;               /* the error, if a frame could not be read; else null; owned */
    /* why the store has no picture of the reference, so that the tolerance cannot be applied; else null; owned */
    char *no_picture;
    /* true: the system lacked memory or file handles, so the frame itself may be readable */
    bool lacks_resources;
} diff_pair;

typedef struct diff_result {
    diff_options options; /* the options with which the sides were compared */
    diff_pair *pairs;     /* the pairs, sorted by the names of their frames; owned */
    size_t count;
    size_t found[DIFF_FINDINGS]; /* found[f]: the number of pairs with finding f */
    diff_verdict verdict;
    bool by_ticks; /* true: neither recording has frames, so their ticks.jsonl files were compared byte by byte */
} diff_result;

/* Check that two sides can be compared. No picture is read. Return false with an error in these cases: a picture and
 * a folder; a baseline with a tolerance but without a store; a store but no baseline as the reference; two empty
 * folders; only one side is a recording without frames. */
bool diff_check(const diff_side *a, const diff_side *b, const diff_options *options, octreel_error *error);

/* Compare the frames of `b` with the reference `a`, on all cores. Files with equal bytes are not decoded. Other
 * pictures are read a few rows at a time. A whole picture is in memory only with --antialias, or if it is interlaced
 * or has 16 bits a sample. Both sides and the lists in the options must outlive the result. Return false with an
 * error if diff_check() fails or memory runs out. */
bool diff_run(const diff_side *a, const diff_side *b, const diff_options *options, diff_result *result,
              octreel_error *error);
void diff_release(diff_result *result);

/* Count the pairs with each finding, and update the verdict of the result. */
void diff_count_findings(diff_result *result);

/* Compare the two frames of a pair and set the finding. If one side is a baseline, compare digests; else compare
 * pixels. */
void compare_pixels(diff_pair *pair, const diff_options *options);

/* Set the finding of a pair that cannot be compared, and copy the error. The function sets pair->lacks_resources by
 * errno. The caller must set errno to 0 before it reads the pictures. */
void set_unreadable(diff_pair *pair, const octreel_error *error);

/* Set *tolerance to the tolerance of the options, with the mask of this pair added. Return false if memory runs out.
 * The caller releases the tolerance in any case. */
bool pair_tolerance(const diff_pair *pair, const diff_options *options, image_tolerance *tolerance);
void pair_tolerance_release(image_tolerance *tolerance);

/* Return whether the options accept no difference. */
bool diff_is_exact(const diff_options *options);

/* Return the name of a pair: the name of its frame or, if the frame is missing, of its reference. */
const char *diff_pair_name(const diff_pair *pair);

/* Return the tick in the name of a pair of frames. Return DIFF_NO_TICK if the name is not that of a frame of a
 * recording. */
#define DIFF_NO_TICK UINT64_MAX
uint64_t diff_pair_tick(const diff_pair *pair);

/* Return the pair with this name, or null. */
const diff_pair *diff_find(const diff_result *result, const char *name);

#endif
