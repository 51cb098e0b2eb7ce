/* png_read.c - a PNG file, whoever wrote it, to RGB pixels or to one of its texts. */
#include "fault.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Bounds on what a hostile file may claim beside its pixels. */
#define LARGEST_CHUNK 8000000
#define MOST_TEXTS 1000

/* What to do with an opened file, between setjmp and the clean-up: png_error() ends it. */
typedef void png_task(png_structp png, png_infop info, void *context);

typedef struct text_request {
    const char *keyword;
    char *text;
    size_t size;
    bool found;
} text_request;

static void read_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *file = (FILE *)png_get_io_ptr(png);
    if (fread(bytes, 1, size, file) != size)
        png_error(png, ferror(file) ? strerror(errno) : "the file is cut short");
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* Strict, because a damaged file that looks like a picture would be compared as one: wrong checksums and broken streams
 * are errors. Chunks that change no pixel here (gamma, profiles, texts) are skipped, with all they might unpack to. */
static void set_rules(png_structp png)
{
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_benign_errors(png, 0);
    png_set_chunk_malloc_max(png, LARGEST_CHUNK);
    png_set_chunk_cache_max(png, MOST_TEXTS);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    /* decode() tests the sides: libpng's own test says only "Invalid IHDR data". */
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
}

/* The function that libpng's errors jump back to; nothing in it changes between setjmp and jump. */
static bool run(png_structp png, png_infop info, FILE *file, png_task *task, void *context)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_read_fn(png, file, read_bytes);
    set_rules(png);
    task(png, info, context);
    return true;
}

static bool read_file(const char *path, png_task *task, void *context, image_error *error)
{
    image_fault fault = {path, error};
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return image_fault_report(&fault, "", strerror(errno));
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, image_fault_raise, ignore_warning);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool done = info == NULL ? image_fault_report(&fault, "libpng does not start: ", strerror(ENOMEM))
                             : run(png, info, file, task, context);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file); /* only read from: nothing is left to fail */
    return done;
}

/* Have libpng deliver one byte a sample, and return the samples of a pixel: 1 (an index), 3 or 4 (with alpha). Laying
 * over white is not left to libpng: 1.6.39 turns the white of 16-bit files into 254. */
static size_t set_conversion(png_structp png, png_infop info)
{
    int color_type = png_get_color_type(png, info);
    if (color_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_packing(png);
        return 1;
    }
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    bool transparent = (color_type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    return transparent ? 4 : 3;
}

static uint8_t over_white(unsigned value, unsigned alpha)
{
    return (uint8_t)((value * alpha + 255 * (255 - alpha) + 127) / 255);
}

/* From four bytes a pixel to three, in place. */
static void lay_over_white(uint8_t *pixels, size_t count)
{
    for (size_t n = 0; n < count; n++) {
        for (size_t i = 0; i < 3; i++)
            pixels[3 * n + i] = over_white(pixels[4 * n + i], pixels[4 * n + 3]);
    }
}

/* From one byte a pixel to three, in place and so from the end. libpng lets indices beyond the palette pass. */
static void look_up_colors(png_structp png, png_infop info, uint8_t *pixels, size_t count)
{
    png_colorp palette = NULL;
    png_bytep alphas = NULL;
    int color_count = 0, alpha_count = 0;
    png_get_PLTE(png, info, &palette, &color_count);
    png_get_tRNS(png, info, &alphas, &alpha_count, NULL);
    image_color colors[256] = {{0, 0, 0}};
    for (int i = 0; i < color_count; i++) {
        unsigned alpha = i < alpha_count ? alphas[i] : 255;
        colors[i].r = over_white(palette[i].red, alpha);
        colors[i].g = over_white(palette[i].green, alpha);
        colors[i].b = over_white(palette[i].blue, alpha);
    }
    for (size_t n = count; n-- > 0;) {
        if (pixels[n] >= color_count)
            png_error(png, "a pixel's index lies beyond the palette");
        memcpy(pixels + 3 * n, &colors[pixels[n]], 3);
    }
}

/* The image at its size, with room for `samples` bytes a pixel. */
static bool create_roomy(image *image, png_uint_32 width, png_uint_32 height, size_t samples)
{
    if (!image_create(image, (int)width, (int)height, 3))
        return false;
    if (samples <= 3)
        return true;
    uint8_t *roomy = realloc(image->pixels, (size_t)width * height * samples);
    if (roomy == NULL)
        return false;
    image->pixels = roomy;
    return true;
}

static void read_rows(png_structp png, const image *image, size_t row_size, int passes)
{
    for (int pass = 0; pass < passes; pass++) {
        for (int y = 0; y < image->height; y++)
            png_read_row(png, image->pixels + (size_t)y * row_size, NULL);
    }
}

static void decode(png_structp png, png_infop info, void *context)
{
    image *out = (image *)context;
    png_read_info(png, info);
    png_uint_32 width = png_get_image_width(png, info);
    png_uint_32 height = png_get_image_height(png, info);
    if (width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        png_error(png, "a side is longer than this program's largest picture");
    size_t samples = set_conversion(png, info);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != width * samples)
        png_error(png, "libpng cannot turn it into 8-bit samples");
    if (!create_roomy(out, width, height, samples))
        png_error(png, strerror(ENOMEM));
    read_rows(png, out, width * samples, passes);
    png_read_end(png, NULL);
    if (samples == 1)
        look_up_colors(png, info, out->pixels, (size_t)width * height);
    if (samples == 4)
        lay_over_white(out->pixels, (size_t)width * height);
}

bool image_read_png(const char *path, image *image, image_error *error)
{
    memset(image, 0, sizeof *image);
    if (read_file(path, decode, image, error))
        return true;
    image_release(image);
    return false;
}

static void find_text(png_structp png, png_infop info, void *context)
{
    text_request *request = (text_request *)context;
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, (png_const_bytep) "tEXt", 1);
    png_read_info(png, info);
    png_textp texts = NULL;
    int count = 0;
    png_get_text(png, info, &texts, &count);
    for (int i = 0; i < count && !request->found; i++) {
        if (strcmp(texts[i].key, request->keyword) != 0)
            continue;
        snprintf(request->text, request->size, "%s", texts[i].text);
        request->found = true;
    }
}

bool image_read_text(const char *path, const char *keyword, char *text, size_t size)
{
    text_request request = {.keyword = keyword, .text = text, .size = size};
    image_error unread;
    return read_file(path, find_text, &request, &unread) && request.found;
}
