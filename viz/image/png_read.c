/* SPDX-License-Identifier: MIT */
/* png_read.c - reads PNG files through libpng. A damaged file always gives an error, never a picture. */
#include "png_read.h"
#include "array.h"
#include "file.h"
#include "image_blend.h"
#include "octree/digest.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Limits against hostile files. LARGEST_CHUNK: the maximum size in bytes of a chunk that does not hold pixels.
 * MOST_TEXTS: the maximum number of such chunks. */
#define LARGEST_CHUNK 8000000
#define MOST_TEXTS 1000

/* The highest compression ratio of deflate: a repeat of 258 bytes takes at least two bits. */
#define MOST_BYTES_A_BYTE 1032

/* Compressed bytes are passed to zlib in pieces of this size. */
#define COMPRESSED_BUFFER_SIZE ((size_t)1 << 14)

struct image_source {
    const char *path;
    octreel_error *error;
    png_structp png;
    png_infop info;
    FILE *file;
    uint64_t file_size;
    image_color background;
    /* true: all rows are read together, because the caller requests it or the format requires it */
    bool whole;
    png_byte color_type, depth; /* the colour type and the bits per sample in the file */
    size_t samples;             /* samples per pixel as libpng delivers them: 1 (index or grey), 3, or 4 with alpha */
    int passes;       /* number of passes in which libpng delivers the rows: 7 if the file is interlaced, else 1 */
    image about;      /* the image's description; it has pixels only if `whole` is set */
    image *wanted;    /* the image into which the next call of decode_band() reads rows */
    uint8_t *band;    /* the pixels of the band that was read last */
    size_t band_room; /* capacity of `band` in bytes */
    int next_y;       /* number of the next band's first row */
    bool beyond;      /* true: an index beyond the palette was found; the error is reported after the last row */
    bool failed;
};

static bool fail_reading(image_source *s, const char *reason)
{
    s->failed = true;
    return error_set(s->error, "%s: %s", file_display_name(s->path), reason);
}

/* ---- libpng -------------------------------------------------------------------------------------------------- */

/* A step of reading a file. An error of libpng aborts the step. */
typedef void step(image_source *s);

static void read_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *file = (FILE *)png_get_io_ptr(png);
    if (fread(bytes, 1, size, file) != size)
        png_error(png, ferror(file) ? strerror(errno) : "the file is truncated");
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* libpng's error handler: store the reason and jump back to run_png_step(). */
static _Noreturn void raise_error(png_structp png, png_const_charp message)
{
    fail_reading(png_get_error_ptr(png), message);
    png_longjmp(png, 1);
}

/* Run a step. Returns false if libpng reports an error. No local variable changes between setjmp and longjmp. */
static bool run_png_step(image_source *s, step *task)
{
    if (setjmp(png_jmpbuf(s->png)) != 0)
        return false;
    task(s);
    return true;
}

/* The names of the chunks that define the meaning of colours. libpng keeps the bytes of these chunks but does not apply
 * them. */
static const uint8_t color_chunks[] = "gAMA\0cHRM\0sRGB\0iCCP\0cICP";

/* A damaged file must not be compared as a picture, so wrong CRCs and broken zlib streams are errors. The CRCs cover
 * the same bytes as the stream's Adler-32 checksum, which takes a fifth of the reading time. So the Adler-32 checksum
 * is not verified if libpng can skip it (the libpng of Debian 12 can, the libpng of Debian 13 cannot). Chunks that
 * affect no pixel are skipped, except color_chunks. */
static void set_reading_rules(png_structp png, FILE *file)
{
    png_set_read_fn(png, file, read_bytes);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
#ifdef PNG_IGNORE_ADLER32
    png_set_option(png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
#endif
    png_set_benign_errors(png, 0);
    png_set_chunk_malloc_max(png, LARGEST_CHUNK);
    png_set_chunk_cache_max(png, MOST_TEXTS);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, color_chunks, (sizeof color_chunks) / 5);
    /* Remove libpng's limits of the sides: check_size() tests the sides and names the reason. libpng's message would
     * only be "Invalid IHDR data". */
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
}

/* ---- Before the pixels --------------------------------------------------------------------------------------- */

/* Returns a digest of the file's chunks that color_chunks names. The digest does not depend on the order of the
 * chunks. */
static uint64_t digest_color_chunks(png_structp png, png_infop info)
{
    png_unknown_chunkp chunks = NULL;
    const int count = png_get_unknown_chunks(png, info, &chunks);
    uint64_t sum = 0;
    for (int i = 0; i < count; i++) {
        uint64_t digest = OCTREE_DIGEST_START;
        for (size_t j = 0; j < 4; j++)
            digest = octree_digest_word(digest, chunks[i].name[j]);
        for (size_t j = 0; j < chunks[i].size; j++)
            digest = octree_digest_word(digest, chunks[i].data[j]);
        sum += digest;
    }
    return sum;
}

static bool is_indexed(const image_source *s)
{
    return s->color_type == PNG_COLOR_TYPE_PALETTE || (s->color_type == PNG_COLOR_TYPE_GRAY && s->depth <= 8);
}

/* Make libpng deliver samples of 8 or 16 bits without loss. blend_pixels() blends transparent pixels with the
 * background, because libpng 1.6.39 turns the white of 16-bit files into 254. */
static void set_conversion(image_source *s)
{
    s->color_type = png_get_color_type(s->png, s->info);
    s->depth = png_get_bit_depth(s->png, s->info);
    const bool keyed = png_get_valid(s->png, s->info, PNG_INFO_tRNS) != 0;
    s->about.wide = s->depth == 16;
    s->about.transparent = keyed || (s->color_type & PNG_COLOR_MASK_ALPHA) != 0;
    s->samples = s->about.transparent ? 4 : 3;
    if (is_indexed(s)) {
        s->samples = 1;
        png_set_packing(s->png);
        return;
    }
    png_set_expand(s->png);
    png_set_gray_to_rgb(s->png);
    const uint16_t one = 1;
    if (s->depth == 16 && *(const uint8_t *)&one == 1)
        png_set_swap(s->png);
}

/* Reject impossible sizes of a picture before memory is allocated. */
static void check_size(const image_source *s)
{
    const png_uint_32 width = png_get_image_width(s->png, s->info), height = png_get_image_height(s->png, s->info);
    if (width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        png_error(s->png, "a side is longer than 16384 pixels, the largest that Octreel reads");
    const uint64_t stored = (uint64_t)png_get_rowbytes(s->png, s->info) * height;
    if (stored > MOST_BYTES_A_BYTE * s->file_size)
        png_error(s->png, "the file is truncated, or claims more pixels than it can hold");
}

/* Fill the image's palette with the colours of the file's palette or grey levels, blended with the background. */
static void set_palette(image_source *s)
{
    image_palette *palette = &s->about.palette;
    png_colorp colors = NULL;
    png_bytep alphas = NULL;
    png_color_16p key = NULL;
    int alpha_count = 0;
    png_get_tRNS(s->png, s->info, &alphas, &alpha_count, &key);
    const bool grey = s->color_type == PNG_COLOR_TYPE_GRAY;
    if (grey)
        palette->count = 1 << s->depth;
    else
        png_get_PLTE(s->png, s->info, &colors, &palette->count);
    for (int i = 0; i < palette->count; i++) {
        const uint8_t level = (uint8_t)(grey ? i * 255 / (palette->count - 1) : 0);
        const image_color color =
            grey ? (image_color){level, level, level} : (image_color){colors[i].red, colors[i].green, colors[i].blue};
        unsigned alpha = 255;
        if (grey)
            alpha = s->about.transparent && key->gray == i ? 0 : 255;
        else if (i < alpha_count)
            alpha = alphas[i];
        palette->colors[i] = image_blend_color(color, s->background, alpha);
    }
}

/* Returns the number of bytes of a row as libpng delivers the row. A converted row is never longer. */
static size_t find_row_size(const image_source *s)
{
    return (size_t)s->about.width * s->samples * (s->depth == 16 ? 2 : 1);
}

static void read_description(image_source *s)
{
    const png_structp png = s->png;
    const png_infop info = s->info;
    set_reading_rules(png, s->file);
    png_set_compression_buffer_size(png, COMPRESSED_BUFFER_SIZE);
    png_read_info(png, info);
    check_size(s);
    set_conversion(s);
    s->about.color_space = digest_color_chunks(png, info);
    s->passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    s->about.width = (int)png_get_image_width(png, info);
    s->about.height = (int)png_get_image_height(png, info);
    s->about.channels = s->samples == 1 ? 1 : 3;
    if (png_get_rowbytes(png, info) != find_row_size(s))
        png_error(png, "libpng did not expand the pixels to 8 or 16 bits per sample");
    if (s->samples == 1)
        set_palette(s);
    /* An interlaced file delivers its rows in several passes. For 16-bit samples, only all rows together show whether
     * 16 bits are needed. */
    s->whole = s->whole || s->passes > 1 || s->about.wide;
}

/* ---- Pixels -------------------------------------------------------------------------------------------------- */

/* Convert a band in place: from the samples that libpng delivers, to the format of the image. */
static void convert_band(image_source *s, image *band)
{
    const size_t count = (size_t)band->width * (size_t)band->height;
    if (s->samples == 1)
        /* libpng does not reject indices beyond the palette, so they are looked for here */
        s->beyond = s->beyond || !image_has_valid_indices(band);
    if (s->samples == 4)
        (band->wide ? image_blend_wide_pixels : image_blend_pixels)(band->pixels, count, s->background);
    image_narrow_if_exact(band);
}

/* Read the rows of s->wanted. After the picture's last row, read on to the end of the file, so that libpng checks the
 * rest. */
static void decode_band(image_source *s)
{
    image *band = s->wanted;
    const size_t size = find_row_size(s);
    for (int pass = 0; pass < s->passes; pass++)
        for (int y = 0; y < band->height; y++)
            png_read_row(s->png, band->pixels + (size_t)y * size, NULL);
    convert_band(s, band);
    s->next_y += band->height;
    if (s->next_y < s->about.height)
        return;
    png_read_end(s->png, NULL);
    if (s->beyond)
        png_error(s->png, "a pixel's index is beyond the palette");
}

static bool read_whole_image(image_source *s)
{
    s->about.pixels = malloc(find_row_size(s) * (size_t)s->about.height);
    if (!s->about.pixels)
        return fail_reading(s, strerror(ENOMEM));
    s->wanted = &s->about;
    if (!run_png_step(s, decode_band))
        return false;
    s->next_y = 0;
    return true;
}

bool image_source_read_band(image_source *s, int rows, image *band)
{
    const int left = s->about.height - s->next_y;
    if (s->failed || left == 0)
        return false;
    *band = s->about;
    band->height = left < rows ? left : rows;
    if (!s->whole) {
        if (!array_grow(&s->band, find_row_size(s) * (size_t)band->height, &s->band_room, 1))
            return fail_reading(s, strerror(ENOMEM));
        band->pixels = s->band;
        s->wanted = band;
        return run_png_step(s, decode_band);
    }
    band->pixels += (size_t)s->next_y * (size_t)s->about.width * image_pixel_size(&s->about);
    s->next_y += band->height;
    return true;
}

/* ---- Opening and closing ------------------------------------------------------------------------------------- */

const image *image_source_description(const image_source *s)
{
    return &s->about;
}

bool image_source_has_failed(const image_source *s)
{
    return s->failed;
}

static bool open_source_file(image_source *s)
{
    char reason[FILE_REASON];
    s->file = file_open(s->path, &s->file_size, reason);
    return s->file || fail_reading(s, reason);
}

static bool open_png(image_source *s)
{
    s->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, s, raise_error, ignore_warning);
    s->info = s->png ? png_create_info_struct(s->png) : NULL;
    return s->info ? run_png_step(s, read_description) : fail_reading(s, strerror(ENOMEM));
}

image_source *image_source_open(const char *path, image_color background, bool whole, octreel_error *error)
{
    image_source *s = calloc(1, sizeof *s);
    if (!s) {
        error_no_memory(error);
        return NULL;
    }
    s->path = path;
    s->error = error;
    s->background = background;
    s->whole = whole;
    if (open_source_file(s) && open_png(s) && (!s->whole || read_whole_image(s)))
        return s;
    image_source_close(s);
    return NULL;
}

void image_source_close(image_source *s)
{
    if (!s)
        return;
    png_destroy_read_struct(&s->png, &s->info, NULL);
    image_release(&s->about);
    free(s->band);
    if (s->file)
        fclose(s->file); /* an error of fclose() is ignored, because the file was only read */
    free(s);
}

bool image_read_png_over(const char *path, image_color background, image *whole, octreel_error *error)
{
    image_source *s = image_source_open(path, background, true, error);
    *whole = s ? s->about : (image){0};
    if (s)
        s->about.pixels = NULL;
    image_source_close(s);
    return s != NULL;
}

bool image_read_png(const char *path, image *image, octreel_error *error)
{
    return image_read_png_over(path, IMAGE_WHITE, image, error);
}
