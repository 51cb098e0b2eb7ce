/* SPDX-License-Identifier: MIT */
/* image_compare.h - where two images differ, and by how much: counted, judged and drawn. */
#ifndef IMAGE_IMAGE_COMPARE_H
#define IMAGE_IMAGE_COMPARE_H

#include "image.h"

/* The perceived distance of two colours: the measure of Kotsarenko and Ramos ("Measuring perceived color
 * difference using YIQ NTSC transmission color space in mobile applications", 2010), as a fraction of its largest
 * value: the scale of pixelmatch's and odiff's threshold. 0 only for equal colours. */
#define IMAGE_DELTA_UNIT "YIQ"

typedef struct image_rectangle {
    int x, y, width, height; /* may reach beyond the image */
} image_rectangle;

/* Which differences are forgiven; all zero forgives none. */
typedef struct image_tolerance {
    uint64_t max_pixels; /* so many unlike pixels that nothing else forgives */
    double max_delta;    /* unlike pixels that differ by at most this, in IMAGE_DELTA_UNIT */
    bool antialias;      /* pixels on anti-aliased edges */
    const image_rectangle *ignored;
    size_t ignored_count;
    const uint8_t *ignored_mask; /* a byte per pixel of the images, not 0: ignored too. May be null */
} image_tolerance;

/* Whether a pixel of images that are `width` pixels wide is ignored. */
static inline bool image_is_ignored(const image_tolerance *tolerance, int width, int x, int y)
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

/* The number, size and place of some unlike pixels. Places are -1 when there are none. */
typedef struct image_tally {
    uint64_t pixels;
    double worst_delta;   /* of the farthest pair of colours, in IMAGE_DELTA_UNIT */
    int worst_x, worst_y; /* the first pixel in reading order that has it */
    int largest_channel;  /* the largest difference of a channel, of any pixel */
    int min_x, min_y;     /* the box around all of them, both corners in it */
    int max_x, max_y;
} image_tally;

typedef struct image_difference {
    bool same_size;       /* otherwise nothing is counted */
    int channel_range;    /* the most that largest_channel can be: 255, or 65535 when an image has 16 bits a sample */
    image_tally unlike;   /* pixels with any unlike channel, except those ignored */
    image_tally counted;  /* those of them that are not forgiven */
    uint64_t close;       /* forgiven: within max_delta */
    uint64_t antialiased; /* forgiven: by anti-aliasing, of those beyond max_delta */
    uint64_t ignored;     /* unlike, in ignored rectangles or the mask: part of no tally */
} image_difference;

/* Colours are compared, so an indexed image equals an RGB image of the same colours. */
image_difference image_compare(const image *a, const image *b);
image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance);

/* The same, given rows as they come. */
typedef struct image_comparison {
    const image_tolerance *tolerance;
    image_difference difference; /* its worst_delta are squares until image_comparison_end() */
    bool stored_alike;           /* equal bytes mean equal colours */
    int y;                       /* of the next rows */
    uint16_t last[2][3];         /* the last unlike colours that were measured: neighbours often have the same */
    double last_square;
    int last_channel;
} image_comparison;

/* Begin with two images, whose pixels are not read. If their sizes differ, no rows may be added. The
 * tolerance must outlive it. */
image_comparison image_comparison_begin(const image *a, const image *b, const image_tolerance *tolerance);
/* Add the next rows of both: as many of each, and all at once under a tolerance with antialias, which looks at the rows
 * above and below. */
void image_comparison_add(image_comparison *comparison, const image *a, const image *b);
image_difference image_comparison_end(const image_comparison *comparison);

/* The judgements: the same size and no unlike pixel at all; the same size and no more counted ones than forgiven. */
bool image_same(const image_difference *difference);
bool image_forgiven(const image_difference *difference, const image_tolerance *tolerance);

/* A picture of the difference, row by row: counted pixels range from orange for one level to white for the largest
 * difference, over a dim grey copy of `a`; forgiven ones are blue. If the sizes differ, pixels that only one image has
 * are violet, and nothing is forgiven. `row` receives an index of the palette for each pixel of the longer row; y is a
 * row of the taller image. */
image_palette image_difference_palette(void);
void image_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row);

#endif
