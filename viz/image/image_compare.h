/* SPDX-License-Identifier: MIT */
/* image_compare.h - counts the pixels that differ between two images, decides by a tolerance if the images match, and
 * draws the differing pixels. */
#ifndef IMAGE_IMAGE_COMPARE_H
#define IMAGE_IMAGE_COMPARE_H

#include "image.h"
#include "octreel/compare.h"

/* The unit of the perceived distance of two colours, which is 0 for equal colours and at most 1. Source: Kotsarenko and
 * Ramos, "Measuring perceived color difference using YIQ NTSC transmission color space in mobile applications", 2010.
 * pixelmatch and odiff use the same scale for their thresholds. */
#define IMAGE_DELTA_UNIT "YIQ"

typedef octreel_rectangle image_rectangle; /* a rectangle of pixels; it may extend beyond the image */

/* The rules by which differing pixels are forgiven or ignored. A zeroed struct forgives and ignores none. */
typedef struct image_tolerance {
    uint64_t max_pixels; /* forgive up to this many differing pixels that no other rule forgives */
    double max_share;    /* forgive up to this share of the image's pixels, from 0 to 1, as with max_pixels */
    double max_delta;    /* forgive pixels whose two colours have at most this distance, in IMAGE_DELTA_UNIT */
    int max_channel;     /* forgive pixels whose samples differ by at most this much in each channel */
    bool antialias;      /* true: forgive pixels on anti-aliased edges */
    /* true: forgive all differences of an image if its mean FLIP at pixels_per_degree is at most max_flip */
    bool flip;
    double max_flip, pixels_per_degree;
    const image_rectangle *ignored; /* rectangles whose pixels are not compared */
    size_t ignored_count;
    const uint8_t *ignored_mask; /* one byte per pixel, or null; a pixel whose byte is not 0 is not compared */
} image_tolerance;

/* Returns whether the tolerance excludes the pixel (x, y) from the comparison. `width` is the image's width. */
static inline bool image_is_pixel_ignored(const image_tolerance *tolerance, int width, int x, int y)
{
    if (tolerance->ignored_mask && tolerance->ignored_mask[(size_t)y * (size_t)width + (size_t)x])
        return true;
    for (size_t i = 0; i < tolerance->ignored_count; i++) {
        const image_rectangle *r = &tolerance->ignored[i];
        if (x >= r->x && y >= r->y && x - r->x < r->width && y - r->y < r->height)
            return true;
    }
    return false;
}

/* Statistics of a set of differing pixels. Coordinates are -1 if the set is empty. */
typedef struct image_tally {
    uint64_t pixels;      /* number of differing pixels */
    double worst_delta;   /* the largest distance between the two colours of a pixel, in IMAGE_DELTA_UNIT */
    int worst_x, worst_y; /* the first pixel, in reading order, whose colours have the distance worst_delta */
    int largest_channel;  /* the largest difference between two samples of the same channel and pixel */
    int min_x, min_y;     /* the bounding box of the differing pixels, both corners inclusive */
    int max_x, max_y;
} image_tally;

/* How visible a difference is, from 0, invisible, to 1: the result of image_measure_flip(). */
typedef struct image_flip {
    double mean;          /* of all pixels that are not ignored */
    double worst;         /* the largest value of a pixel */
    int worst_x, worst_y; /* the first pixel, in reading order, with the value `worst`; -1 if all values are 0 */
} image_flip;

typedef struct image_difference {
    bool same_size;      /* false: the images differ in size, and nothing was counted */
    uint64_t area;       /* the number of pixels of an image */
    int channel_range;   /* the largest possible value of largest_channel: 255, or 65535 for 16-bit samples */
    image_tally unlike;  /* all differing pixels, except those that are ignored */
    image_tally counted; /* differing pixels that are neither ignored nor forgiven as close or by `antialias` */
    uint64_t close; /* number of pixels that are forgiven because their distance is within max_delta or max_channel */
    uint64_t antialiased; /* number of pixels that are forgiven by `antialias`, and not because they are close */
    /* number of differing pixels that the ignored rectangles or the mask exclude; no tally counts these pixels */
    uint64_t ignored;
    bool has_flip;   /* true: FLIP was measured, by the caller of the functions below */
    image_flip flip; /* valid only if has_flip */
} image_difference;

/* Compare the colours of two images, each indexed or RGB. image_compare() forgives no difference;
 * image_compare_within() forgives differences within a tolerance. */
image_difference image_compare(const image *a, const image *b);
image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance);

/* A comparison of two images that are read in bands of rows. */
typedef struct image_comparison {
    const image_tolerance *tolerance;
    /* the result so far; its worst_delta values are squared until image_end_comparison() */
    image_difference difference;
    bool same_storage; /* true: equal bytes of the two images mean equal colours */
    int y;             /* number of the next band's first row */
    /* the two colours that were measured last; neighbouring pixels often have the same two colours */
    uint16_t last[2][3];
    double last_square; /* the squared distance of the two colours in `last` */
    int last_channel;   /* the largest difference of a channel between the two colours in `last` */
} image_comparison;

/* Begin a comparison of two images. Only the images' sizes, formats and palettes are read, not their pixels. If the
 * sizes differ, no bands may be added. The tolerance must outlive the comparison. */
image_comparison image_begin_comparison(const image *a, const image *b, const image_tolerance *tolerance);
/* Add the next band of both images. Both bands must have the same number of rows. With tolerance->antialias the band
 * must be the whole image, because the test for anti-aliasing reads the rows above and below a pixel. */
void image_compare_band(image_comparison *comparison, const image *a, const image *b);
image_difference image_end_comparison(const image_comparison *comparison);

/* Returns whether the sizes are equal and no pixel differs, not even an ignored pixel. */
bool image_has_no_difference(const image_difference *difference);

/* Returns whether the sizes are equal, and at most max_pixels differing pixels, or the share max_share, are neither
 * ignored nor forgiven by another rule or the mean FLIP is within max_flip. */
bool image_is_within_tolerance(const image_difference *difference, const image_tolerance *tolerance);

/* Draw row y of a picture that shows the difference of two images, as indices of the palette
 * image_make_difference_palette(). A dim grey copy of `a` is the background. Counted pixels range from orange (one
 * level) to white (the largest difference); forgiven pixels are blue.
 *
 * If the sizes differ, pixels that only one image has are violet, and nothing is forgiven. `row` must have room for a
 * row of the wider image; y may be a row of the taller image. */
image_palette image_make_difference_palette(void);
void image_draw_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row);

#endif
