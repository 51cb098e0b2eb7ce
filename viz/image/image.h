/* image.h - pixels, PNG files, and the difference of two images. Knows neither GL nor trees.
 *
 * An image is either indexed (one byte a pixel into a palette) or RGB (three bytes a pixel), rows from the top down,
 * without padding.
 */
#ifndef OCTREEL_IMAGE_H
#define OCTREEL_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A side of a picture that this program draws or reads is at most this many pixels. */
#define IMAGE_MAX_SIDE 16384

typedef struct image_color {
    uint8_t r, g, b;
} image_color;

typedef struct image_palette {
    image_color colors[256]; /* those from count on are never drawn: leave them zero */
    int count;               /* 1 to 256 */
} image_palette;

typedef struct image {
    int width, height;
    int channels;          /* 1: indices into the palette; 3: r, g, b */
    image_palette palette; /* read when channels is 1 */
    uint8_t *pixels;       /* width * height * channels bytes, owned */
} image;

/* A failed operation writes one sentence here, "<path>: <reason>"; a done one leaves it alone. Never NULL. */
typedef struct image_error {
    char text[512];
} image_error;

/* Allocate the pixels, all zero; the palette is zeroed too. False, and the image zeroed, when there is no memory, a
 * side is outside 1..IMAGE_MAX_SIDE, or channels is neither 1 nor 3. */
bool image_create(image *image, int width, int height, int channels);
/* Free the pixels and zero the image; a zeroed image is allowed. */
void image_release(image *image);

/* The colour of a pixel inside the image. */
image_color image_color_at(const image *image, int x, int y);

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
                     image_error *error);

/* The libraries that write the files, and their versions at run time. Returns `text`. */
#define IMAGE_LIBRARY_TEXT 64
char *image_library(char text[IMAGE_LIBRARY_TEXT]);

/* Read any PNG as RGB, 16 bits rounded to 8; transparency is laid over white, gamma and colour profiles are ignored.
 * Refuses files whose sides exceed IMAGE_MAX_SIDE before memory is spent on them, and whatever is cut short or fails a
 * checksum. The image is created; when it fails, it is zeroed. */
bool image_read_png(const char *path, image *image, image_error *error);

/* Read the first tEXt chunk with this keyword, of those before the pixels, into text (cut at size - 1). False when
 * there is none or the file cannot be read that far. The pixels are not decoded. */
bool image_read_text(const char *path, const char *keyword, char *text, size_t size);

/* Fill an RGB image from an indexed one whose sides are `factor` times (1 to 16) as long: each pixel is the mean of
 * factor * factor, rounded to the nearest. False, and nothing done, when the two do not fit together so. */
bool image_shrink(const image *from, int factor, image *small);

/* How two images differ: counting only. Judging is image_same(). */
typedef struct image_difference {
    bool same_size;
    uint64_t pixels;      /* pixels with any unlike channel; 0 when the sizes are unlike */
    int largest_delta;    /* the largest difference of a channel, 0..255 */
    int first_x, first_y; /* the first unlike pixel in reading order, -1 when there is none */
    int min_x, min_y;     /* the box around all of them, both corners in it; -1 when there is none */
    int max_x, max_y;
} image_difference;

/* Colours are compared, so an indexed image and its RGB twin are alike. */
image_difference image_compare(const image *a, const image *b);

/* The one judgement: the same size and no unlike pixel. */
bool image_same(const image_difference *difference);

/* A picture of the difference: unlike pixels in red over a faint grey copy of `a`. Created in RGB at the common size:
 * where sizes are unlike, the part that both have, from the top left corner. False when there is no memory. */
bool image_draw_difference(const image *a, const image *b, image *out);

#endif
