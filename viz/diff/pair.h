/* SPDX-License-Identifier: MIT */
/* pair.h - compares two frames and gives them a finding. A frame is a PNG file, a picture in memory, or a frame of a
 * baseline. Different threads may compare different pairs. */
#ifndef DIFF_PAIR_H
#define DIFF_PAIR_H

#include "rule.h"

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

/* A callback that adds the pixels of the layers pair->layers to the mask of each pair. The caller of diff_run()
 * provides it, because this folder cannot play recordings. The callback returns false with an error on failure. */
typedef bool diff_mask(const diff_side *a, const diff_side *b, struct diff_pair **pairs, size_t count,
                       octreel_error *error);

typedef struct diff_options {
    image_tolerance tolerance;
    image_color background;  /* the color that is drawn behind transparent pixels */
    diff_mask *mask;         /* the callback that masks ignored layers; null: no layers can be ignored */
    unsigned ignored_layers; /* the layers that are not compared, as bits 1 << view_layer */
    const char *layers;      /* their names, separated by commas */
    const char *store;       /* the picture store of the reference, which must be a baseline; null: no picture store */
    char today[11];          /* YYYY-MM-DD: rules that expire before this day forgive nothing; "": see rule_today() */
} diff_options;

/* What the rule for a frame did. */
typedef enum rule_effect {
    RULE_UNUSED,         /* no rule, or nothing to forgive */
    RULE_FORGAVE,        /* the difference is within the rule, and was not within the tolerance of the options */
    RULE_EXCEEDED,       /* the difference is larger than the rule forgives */
    RULE_EXPIRED,        /* the rule was not applied: its last day is over */
    RULE_LACKS_STORE,    /* the rule was not applied: no store was given */
    RULE_LACKS_PICTURE,  /* the rule was not applied: the store has no picture; see pair->no_picture */
    RULE_LACKS_RECORDING /* the rule was not applied: it ignores layers, and the frame is not of a recording */
} rule_effect;

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
    unsigned layers;             /* the layers that diff_mask adds to the mask, as bits 1 << view_layer */
    pixel_mask mask;             /* the pixels of ignored layers and of the masks of a rule */
    const baseline_rule *rule;   /* in a comparison with a baseline, the rule for the frame; null: none */
    rule_effect effect;
    char *trouble; /* the error, if a frame could not be read; else null; owned */
    /* the sentence that the digest of the frame was accepted earlier, by history.h; else null; owned */
    char *flaky;
    /* why the store has no picture of the reference, so that the tolerance cannot be applied; else null; owned */
    char *no_picture;
    /* true: the system lacked memory or file handles, so the frame itself may be readable */
    bool lacks_resources;
} diff_pair;

/* If both frames are PNG files with the same bytes, set the finding of the pair. Return whether the finding was set. No
 * file is decoded. */
bool compare_bytes(diff_pair *pair);

/* Compare the two frames of a pair and set the finding. If one side is a baseline, compare digests; else compare
 * pixels. */
void compare_pixels(diff_pair *pair, const diff_options *options);

/* Return whether the pixels of a frame are known, not only their digests. */
bool has_picture(const diff_frame *frame);

/* Set the finding of a pair that cannot be compared, and copy the error. The function sets pair->lacks_resources by
 * errno. The caller must set errno to 0 before it reads the pictures. */
void set_unreadable(diff_pair *pair, const octreel_error *error);

/* Set *tolerance to the tolerance of the options, widened by the rule if one is applied, with the mask of this pair.
 * Return false if memory runs out. The caller releases the tolerance in any case. */
bool pair_tolerance(const diff_pair *pair, const diff_options *options, image_tolerance *tolerance);
void pair_tolerance_release(image_tolerance *tolerance);

/* diff_is_exact() returns whether the options accept no difference, pair_is_exact() whether, in addition, the pair has
 * no rule. */
bool diff_is_exact(const diff_options *options);
bool pair_is_exact(const diff_pair *pair, const diff_options *options);

/* Return the name of a pair: the name of its frame or, if the frame is missing, of its reference. */
const char *diff_pair_name(const diff_pair *pair);

#endif
