/* image.h - pixels, PNG files, and the difference of two images. Knows neither GL nor trees.
 *
 * An image is either indexed (one byte a pixel into a palette) or RGB (three samples a pixel, of 8 bits or, when it was
 * read from such a file, of 16), rows from the top down, without padding.
 */
#ifndef OCTREEL_IMAGE_H
#define OCTREEL_IMAGE_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A side of a picture that this program draws or reads is at most this many pixels. */
#define IMAGE_MAX_SIDE 16384

typedef struct image_color {
    uint8_t r, g, b;
} image_color;

/* What shines through where a picture is transparent, unless another colour is asked for. */
#define IMAGE_WHITE ((image_color){255, 255, 255})

typedef struct image_palette {
    image_color colors[256]; /* those from count on are never drawn: leave them zero */
    int count;               /* 1 to 256 */
} image_palette;

typedef struct image {
    int width, height;
    int channels;          /* 1: indices into the palette; 3: r, g, b */
    bool wide;             /* a sample has 16 bits, in this machine's byte order, not 8; channels is then 3 */
    bool transparent;      /* read from a file that is transparent somewhere: it was laid over a background */
    image_palette palette; /* read when channels is 1 */
    uint8_t *pixels;       /* width * height * image_pixel_size() bytes, owned */
} image;

/* Bytes of a pixel: 1, 3 or 6. */
static inline size_t image_pixel_size(const image *image)
{
    return (size_t)image->channels * (image->wide ? 2 : 1);
}

/* Allocate the pixels, all zero; the palette is zeroed too. False, and the image zeroed, when there is no memory, a
 * side is outside 1..IMAGE_MAX_SIDE, or channels is neither 1 nor 3. */
bool image_create(image *image, int width, int height, int channels);
/* Free the pixels and zero the image; a zeroed image is allowed. */
void image_release(image *image);

/* The colour of a pixel inside the image; of 16 bits a sample to the nearest of 8. */
image_color image_color_at(const image *image, int x, int y);

/* Whether each pixel of an indexed image has a colour in its palette. */
bool image_has_colors(const image *image);

/* A digest of size and colours (not of how they are stored): equal for an indexed image and its RGB twin. */
uint64_t image_digest(const image *image);

/* A keyword and its text, written as tEXt chunks in the order given. Keywords and texts are Latin-1. */
typedef struct image_text {
    const char *keyword; /* 1 to 79 characters */
    const char *text;
} image_text;

/* Write a PNG by way of "<path>.part" and a rename: the file is there whole or not at all. Indexed images become
 * 8-bit palette PNGs of exactly palette.count colours (filter none, level 1, Z_RLE), RGB ones 8-bit RGB (filter none,
 * level 1). No dates: the same image and texts make the same bytes under the same zlib. An index beyond the palette or
 * a keyword that PNG does not allow is an error. When it fails, no .part file of this call is left, and a file that was
 * at `path` before is unharmed. */
bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error);

/* A picture that is made while it is written, so that it never is in memory whole. */
typedef struct image_rows {
    int width, height;            /* at least 1; PNG readers may refuse what is larger than IMAGE_MAX_SIDE */
    const image_palette *palette; /* of one byte a pixel, whose indices all have a colour; null: r, g, b */
    const uint8_t *(*row)(int y, void *context); /* asked for from the top down; stays valid until the next one */
    void *context;
} image_rows;

/* Write it as image_write_png() does. */
bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error);

/* The libraries that write the files, and their versions at run time. Returns `text`. */
#define IMAGE_LIBRARY_TEXT 64
char *image_library(char text[IMAGE_LIBRARY_TEXT]);

/* Read any PNG without loss: palettes, and greys of up to 8 bits, become indexed images, the others RGB ones, with 16
 * bits a sample only where 8 cannot hold them. What is transparent is laid over white; gamma and colour profiles are
 * ignored. Refused are files that are no regular files, whatever is cut short or fails a checksum, sides beyond
 * IMAGE_MAX_SIDE, and more pixels than so many compressed bytes can hold: memory stays within 8 bytes a pixel, and
 * within 8300 times the file's size. The image is created; when it fails, it is zeroed. */
bool image_read_png(const char *path, image *image, octreel_error *error);

/* The same over a background of one's own. */
bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error);

/* The same from a stream of `size` bytes; `name` stands for the path in sentences. */
bool image_read_png_stream(FILE *stream, uint64_t size, const char *name, image_color background, image *image,
                           octreel_error *error);

/* The rows of a PNG, decoded as they are asked for, so that it never is in memory whole. Where rows cannot come one
 * after the other - they are interlaced, or have 16 bits a sample and may not need them - all are read when it is
 * opened, as they are when `whole` asks for it. One thread at a time may use it. */
typedef struct image_source image_source;

/* Begin, under the rules of image_read_png(). Null, with a sentence, where that cannot be; path and error must outlive
 * the source. A stream stays the caller's. */
image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error);
image_source *image_source_open_stream(FILE *stream, uint64_t size, const char *name, image_color background,
                                       bool whole, octreel_error *error);
void image_source_close(image_source *source); /* null is allowed */

/* The image but for its pixels, which are null unless all of them are at hand. */
const image *image_source_about(const image_source *source);

/* The next rows, at most `rows`, as an image of their own that is not to be released: its pixels are in `room`, of
 * image_source_room() bytes, or in the source. False when there are no more, or, with a sentence, when it fails; that
 * the file is right to its end is known when its last rows were given. */
bool image_source_next(image_source *source, int rows, uint8_t *room, image *band);
size_t image_source_room(const image_source *source, int rows);
bool image_source_failed(const image_source *source);

/* How many rows of a picture are best asked for at a time: so few that some such bands fit the second cache, and so
 * many that what is done for each band does not count. */
static inline int image_band_rows(const image *about)
{
    enum { BAND_PIXELS = 1 << 14 };
    return about->width < BAND_PIXELS ? BAND_PIXELS / about->width : 1;
}

/* Close a source that was opened whole; its image becomes the caller's. */
void image_source_take(image_source *source, image *whole);

/* image_digest() of a PNG as image_read_png_over() reads it, row by row. `about` is the image without pixels. */
bool image_digest_png(const char *path, image_color background, image *about, uint64_t *digest, octreel_error *error);

/* Read no more than a PNG's beginning and its end: the size, and whether it ends as a PNG does. False when it does not
 * begin as one. */
bool image_read_png_ends(const char *path, int *width, int *height, bool *ends, octreel_error *error);

/* Read the first tEXt chunk with this keyword, of those before the pixels, into text (cut at size - 1). False when
 * there is none or the file cannot be read that far. The pixels are not decoded. */
bool image_read_text(const char *path, const char *keyword, char *text, size_t size);

/* Put another text of the same length in place of that; nothing else of the file changes. The file is whole before and
 * after, whatever ends the process. False when the file cannot be read or written, or has no such text. */
bool image_replace_text(const char *path, const char *keyword, const char *text);

/* Fill an RGB image from an indexed one whose sides are `factor` times (1 to 16) as long: each pixel is the mean of
 * factor * factor, rounded to the nearest. False, and nothing done, when the two do not fit together so. */
bool image_shrink(const image *from, int factor, image *small);

/* ---- Differences: counting and judging are two functions ----------------------------------------------------- */

/* How far two colours are from each other for the eye: the measure of Kotsarenko and Ramos ("Measuring perceived color
 * difference using YIQ NTSC transmission color space in mobile applications", 2010), as a part of its largest value:
 * the scale of pixelmatch's and odiff's threshold. 0 is the same colour and nothing else is. */
#define IMAGE_DELTA_UNIT "YIQ"

typedef struct image_rectangle {
    int x, y, width, height; /* may reach beyond the image */
} image_rectangle;

/* Which differences are forgiven; all zero forgives none. */
typedef struct image_tolerance {
    uint64_t max_pixels; /* so many unlike pixels, after all else is forgiven */
    double max_delta;    /* unlike pixels no farther apart than this, in IMAGE_DELTA_UNIT */
    bool antialias;      /* pixels that anti-aliasing explains; see antialias.c */
    const image_rectangle *ignored;
    size_t ignored_count;
    const uint8_t *ignored_mask; /* a byte a pixel, not 0: ignored too; as large as the images. Null: none */
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

/* Some unlike pixels: how many, how bad, where. Places are -1 when there are none. */
typedef struct image_tally {
    uint64_t pixels;
    double worst_delta;   /* of the farthest pair of colours, in IMAGE_DELTA_UNIT */
    int worst_x, worst_y; /* the first pixel in reading order that has it */
    int largest_channel;  /* the largest difference of a channel, of any pixel */
    int min_x, min_y;     /* the box around all of them, both corners in it */
    int max_x, max_y;
} image_tally;

typedef struct image_difference {
    bool same_size;       /* else nothing is counted */
    int channel_range;    /* what largest_channel is out of: 255, or 65535 where an image has 16 bits a sample */
    image_tally unlike;   /* pixels with any unlike channel, but for those ignored */
    image_tally counted;  /* of these, what is not forgiven */
    uint64_t close;       /* forgiven: within max_delta */
    uint64_t antialiased; /* forgiven: by anti-aliasing, of those beyond max_delta */
    uint64_t ignored;     /* unlike, in ignored rectangles or the mask: part of no tally */
} image_difference;

/* Colours are compared, so an indexed image and its RGB twin are alike. */
image_difference image_compare(const image *a, const image *b);
image_difference image_compare_within(const image *a, const image *b, const image_tolerance *tolerance);

/* The same, given rows as they come. */
typedef struct image_comparison {
    const image_tolerance *tolerance;
    image_difference difference; /* its worst_delta are squares, until it ends */
    bool stored_alike;           /* equal bytes mean equal colours */
    int y;                       /* of the next rows */
    uint16_t last[2][3];         /* the unlike colours that were measured last: neighbours often differ alike */
    double last_square;
    int last_channel;
} image_comparison;

/* Begin with two images, whose pixels are not looked at. Where their sizes are unlike, no rows may be added. The
 * tolerance must outlive it. */
image_comparison image_comparison_begin(const image *a, const image *b, const image_tolerance *tolerance);
/* Add the next rows of both: as many of each, and all at once under a tolerance with antialias, which looks at the rows
 * above and below. */
void image_comparison_add(image_comparison *comparison, const image *a, const image *b);
image_difference image_comparison_end(const image_comparison *comparison);

/* The judgements: the same size and no unlike pixel at all; the same size and no more counted ones than are forgiven.
 */
bool image_same(const image_difference *difference);
bool image_forgiven(const image_difference *difference, const image_tolerance *tolerance);

/* A picture of the difference, row by row: what counts glows, from orange for one level to white for the largest, over
 * a dim grey copy of `a`; what is forgiven is blue; what only one of both images has, where their sizes are unlike, is
 * violet, and nothing is forgiven then. `row` receives an index of the palette for each pixel of the longer row; y is a
 * row of the taller image. */
image_palette image_difference_palette(void);
void image_difference_row(const image *a, const image *b, const image_tolerance *tolerance, int y, uint8_t *row);

#endif
