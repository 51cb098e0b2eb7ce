/* SPDX-License-Identifier: MIT */
/* image_compare.h - counts the pixels that differ between two images, judges them by a tolerance, and draws them. */
#ifndef IMAGE_IMAGE_COMPARE_H
#define IMAGE_IMAGE_COMPARE_H

#include "image.h"

/* The perceived distance of two colours, from 0 (equal colours only) to 1. Source: Kotsarenko and Ramos, "Measuring
 * perceived color difference using YIQ NTSC transmission color space in mobile applications", 2010. pixelmatch and
 * odiff use the same scale for their thresholds. */
#define IMAGE_DELTA_UNIT "YIQ"

typedef struct image_rectangle {
    int x, y, width, height; /* may reach beyond the image */
} image_rectangle;

/* The differences that are forgiven. All zero: none are. */
typedef struct image_tolerance {
    uint64_t max_pixels;            /* forgive up to this many differing pixels that no other rule forgives */
    double max_delta;               /* forgive pixels whose colours differ by at most this, in IMAGE_DELTA_UNIT */
    bool antialias;                 /* forgive pixels on anti-aliased edges */
    const image_rectangle *ignored; /* rectangles that are not compared */
    size_t ignored_count;
    const uint8_t *ignored_mask; /* one byte per pixel; pixels with a non-zero byte are not compared. May be null */
} image_tolerance;

/* True if the pixel (x, y) of an image of this width is excluded from the comparison. */
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
    uint64_t pixels;      /* number of pixels */
    double worst_delta;   /* the largest colour difference, in IMAGE_DELTA_UNIT */
    int worst_x, worst_y; /* the first pixel in reading order with that difference */
    int largest_channel;  /* the largest difference of a single channel */
    int min_x, min_y;     /* the bounding box of the pixels, both corners inclusive */
    int max_x, max_y;
} image_tally;

typedef struct image_difference {
    bool same_size;     /* false: the sizes differ, and nothing was counted */
    int channel_range;  /* the largest possible value of largest_channel: 255, or 65535 if an image has 16 bits a sample
                         */
    image_tally unlike; /* pixels of different colour, without ignored ones */
    image_tally counted;  /* the part of `unlike` that is not forgiven */
    uint64_t close;       /* the number forgiven because they are within max_delta */
    uint64_t antialiased; /* the number beyond max_delta forgiven because they lie on an anti-aliased edge */
    uint64_t
        ignored; /* the number of differing pixels that are ignored by rectangles or the mask; they are in no tally */
} image_difference;

/* Compare the colours of two images, indexed or RGB. image_compare() forgives no difference. */
image_difference image_compare(const image *a, const image *b);
image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance);

/* A comparison of two images that are read band by band. */
typedef struct image_comparison {
    const image_tolerance *tolerance;
    image_difference difference; /* worst_delta holds squares until image_end_comparison() */
    bool same_storage;           /* equal bytes mean equal colours */
    int y;                       /* the first row of the next band */
    uint16_t last[2][3];         /* the pair of colours measured last: neighbouring pixels often have the same pair */
    double last_square;          /* its squared difference */
    int last_channel;            /* its largest difference of a channel */
} image_comparison;

/* Begin a comparison of two images; only their descriptions are read. If their sizes differ, no bands may be added. The
 * tolerance must outlive the comparison. */
image_comparison image_begin_comparison(const image *a, const image *b, const image_tolerance *tolerance);
/* Add the next band of both images, with the same number of rows. With tolerance->antialias the band must be the whole
 * image, because the test reads the rows above and below. */
void image_compare_band(image_comparison *comparison, const image *a, const image *b);
image_difference image_end_comparison(const image_comparison *comparison);

/* True if the sizes are equal and no pixel differs, not even an ignored one. */
bool image_has_no_difference(const image_difference *difference);

/* True if the sizes are equal and at most max_pixels pixels are counted. */
bool image_is_within_tolerance(const image_difference *difference, const image_tolerance *tolerance);

/* Draw row y of a picture of the difference, as indices of image_make_difference_palette(). Counted pixels range from
 * orange (one level) to white (the largest difference) over a dim grey copy of `a`; forgiven pixels are blue. If the
 * sizes differ, pixels that only one image has are violet, and nothing is forgiven. `row` has room for the wider image;
 * y is a row of the taller image. */
image_palette image_make_difference_palette(void);
void image_draw_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row);

#endif
