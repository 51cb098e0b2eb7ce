/* SPDX-License-Identifier: MIT */
/* compare.h - compares a picture with a reference picture or with a baseline, under a tolerance, in tests of C and C++
 * programs. The picture is an array of pixels or a PNG file.
 *
 *     octreel_comparison found;
 *     const octreel_pixels picture = octreel_make_pixels(rgba, 640, 480, OCTREEL_RGBA8);
 *     if (octreel_compare_pixels_to_file(&picture, "golden/menu.png", NULL, &found) != OCTREEL_VERDICT_SAME)
 *         fail_msg("%s", found.sentence);
 *
 * The library octreel-compare needs libpng and libm only. It starts no process and no thread, draws nothing and changes
 * no file. Build with `pkg-config --cflags --libs octreel-compare`, or with find_package(octreel-compare) and
 * octreel-compare::octreel-compare.
 *
 * Rules for all functions:
 *   - They are thread-safe: any number of threads may compare at the same time, also with the same reference. Nothing
 * is kept between calls.
 *   - They read their arguments only during the call, and change none except *result.
 *   - The colours of pixels decide, not the format in which they are stored. Transparent pixels are blended with the
 *     background. Samples of 16 bits are compared without loss. Gamma and colour profiles of files are not applied.
 *   - A file may be any PNG with sides of up to 16384 pixels. A damaged, truncated or missing file, and a folder or
 * pipe in place of a file, give OCTREEL_VERDICT_TROUBLE and a sentence that says why.
 *   - A reference file is a PNG or a baseline, which `octreel accept` writes. A baseline holds one or more accepted
 *     digests for each frame, and no pixels. So it allows no tolerance without a store, the folder in which `octreel
 *     accept --store` saved the pictures, and only the verdict and the sentence say something about the difference.
 * With a store, a frame whose digest differs is compared with its stored pictures, under the definition and then under
 *     the rule that the baseline has for the frame; the sentence names the rule. `octreel help baseline` describes
 * rules. Rules that ignore layers work only in `octreel diff`. A baseline is read at each call, in time proportional to
 * its size.
 *   - Cost of a comparison with a PNG of equal pixels: that of decoding the PNG, and at most a fifth more. Two files
 * with equal bytes are not decoded.
 */
#ifndef OCTREEL_COMPARE_H
#define OCTREEL_COMPARE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The result of a comparison, with the values of the exit status of `octreel diff`. */
typedef enum octreel_verdict {
    OCTREEL_VERDICT_SAME,      /* the colours are equal, or differ within the tolerance */
    OCTREEL_VERDICT_DIFFERENT, /* a side has another length, or colours differ beyond the tolerance */
    OCTREEL_VERDICT_TROUBLE    /* nothing was compared: the sentence has the reason */
} octreel_verdict;

/* The samples of a pixel, in the order in which they are in memory. A sample has 8 bits, or 16 bits in the machine's
 * byte order. Alpha is not premultiplied: 0 is transparent, the largest value opaque. */
typedef enum octreel_pixel_format {
    OCTREEL_GREY8,  /* 1 byte a pixel */
    OCTREEL_RGB8,   /* 3 bytes */
    OCTREEL_RGBA8,  /* 4 bytes, as glReadPixels(GL_RGBA, GL_UNSIGNED_BYTE) gives them */
    OCTREEL_BGRA8,  /* 4 bytes */
    OCTREEL_RGB16,  /* 6 bytes */
    OCTREEL_RGBA16, /* 8 bytes */
    OCTREEL_PIXEL_FORMATS
} octreel_pixel_format;

/* A picture in memory. The caller owns the pixels. */
typedef struct octreel_pixels {
    const void *data; /* the first byte of the row that is first in memory; it needs no alignment */
    int width, height;
    octreel_pixel_format format;
    size_t stride;  /* bytes from a row to the next one in memory; 0: rows follow each other without gaps */
    bool bottom_up; /* true: the first row in memory is the lowest of the picture, as OpenGL delivers it */
} octreel_pixels;

/* Returns a picture whose rows run from the top down without gaps. */
octreel_pixels octreel_make_pixels(const void *data, int width, int height, octreel_pixel_format format);

/* A rectangle of pixels. (x, y) is its left upper pixel; x and y are at least 0, width and height at least 1. It may
 * extend beyond the picture. */
typedef struct octreel_rectangle {
    int x, y, width, height;
} octreel_rectangle;

/* What counts as the same. Start from octreel_compare_def_default(), and change what you need. The members
 * mean the same as options of `octreel diff`. */
typedef struct octreel_compare_def {
    /* Forgive pixels whose two colours are at most this far apart, from 0, equal, to 1. The distance is YIQ (Kotsarenko
     * and Ramos 2010), the one of pixelmatch's threshold. */
    double max_delta;
    /* Forgive pixels whose samples differ by at most this much in each channel, of 255, or of 65535 if a picture has
     * samples of 16 bits. */
    int max_channel;
    /* true: call the pictures the same if their mean FLIP (Andersson et al. 2020), a measure of how visible their
     * difference is, is at most max_flip, from 0, invisible, to 1 */
    bool flip;
    double max_flip;
    double pixels_per_degree; /* for FLIP: the pixels of the display in a degree of the visual field, 1 to 200 */
    bool antialias;           /* true: forgive pixels on anti-aliased edges, as pixelmatch finds them */
    uint64_t max_pixels;      /* forgive up to this many differing pixels that no other member forgives */
    double max_share;         /* forgive up to this share of the picture's pixels, from 0 to 1, as with max_pixels */
    const octreel_rectangle *ignored; /* rectangles whose pixels are not compared; may be null if the count is 0 */
    size_t ignored_count;
    uint32_t background; /* 0xRRGGBB: the colour behind transparent pixels; a baseline has its own instead */
    /* The name of the picture in a baseline, with or without ".png", such as "menu/start". Null: the name of the
     * compared file without its folders; for pixels, the only frame of the baseline. Not used for other references. */
    const char *frame;
    const char *store; /* for a baseline: the folder with the pictures of accepted digests; null: no pictures */
    /* For a baseline with rules: the date on which they expire or not, such as "2026-11-22". Null: the date of the
     * environment variable SOURCE_DATE_EPOCH, if it is set, else the local date. */
    const char *today;
} octreel_compare_def;

/* Returns a definition that forgives nothing, with a white background, and a display of 67 pixels per degree. */
octreel_compare_def octreel_compare_def_default(void);

/* What a comparison found. Counts are numbers of pixels. Coordinates are in pixels from the left upper corner, and -1
 * if no pixel differs. Without a comparison of pixels (trouble, a baseline without a stored picture, sides of other
 * lengths) counts are 0.
 *
 * The members from worst_delta to max_y describe the counted pixels or, if no pixel counts, all pixels that differ. */
typedef struct octreel_comparison {
    octreel_verdict verdict;
    int width, height;                     /* of the compared picture; 0: unknown */
    int reference_width, reference_height; /* of the reference; 0: unknown */
    uint64_t different;                    /* pixels whose colours differ, without the ignored ones */
    uint64_t counted;             /* different pixels that none of max_delta, max_channel and antialias forgives */
    uint64_t close;               /* different pixels that max_delta or max_channel forgives */
    uint64_t antialiased;         /* different pixels that antialias alone forgives */
    uint64_t ignored;             /* pixels in ignored rectangles whose colours differ */
    double worst_delta;           /* the largest distance of the two colours of a pixel, as max_delta */
    int worst_x, worst_y;         /* the first pixel in reading order that has it */
    double mean_flip, worst_flip; /* if the definition asks for FLIP: the mean and the largest value, else 0 */
    int largest_channel;          /* the largest difference of two samples of a channel */
    int channel_range;            /* the largest possible one: 255, or 65535 with samples of 16 bits; 0: not compared */
    int min_x, min_y, max_x, max_y; /* the smallest rectangle around the pixels, both corners inclusive */
    /* One line for people: what differs and where, or the reason of OCTREEL_VERDICT_TROUBLE and what to do about it. */
    char sentence[512];
} octreel_comparison;

/* Compare the picture `actual` with a reference. `def` may be null, which stands for the default; `result` may be null.
 * All three return the verdict. TROUBLE stands for an unreadable or missing file, lack of memory, a null pointer, a
 * side outside of 1 to 16384, a stride that is shorter than a row, an invalid definition, or a baseline that lacks the
 * frame.
 *
 * Memory: for pixels, at most 6 bytes a pixel, and none for RGB8 and GREY8 without gaps and from the top down. For
 * files, some rows; with antialias or flip, and for files that are interlaced or have samples of 16 bits, 8 bytes a
 * pixel. */
octreel_verdict octreel_compare_pixels(const octreel_pixels *actual, const octreel_pixels *reference,
                                       const octreel_compare_def *def, octreel_comparison *result);
octreel_verdict octreel_compare_pixels_to_file(const octreel_pixels *actual, const char *reference,
                                               const octreel_compare_def *def, octreel_comparison *result);
octreel_verdict octreel_compare_files(const char *actual, const char *reference, const octreel_compare_def *def,
                                      octreel_comparison *result);

#ifdef __cplusplus
}
#endif

#endif
