/* png_read.c - a PNG file, whoever wrote it, to pixels, to its size or to one of its texts. */
#include "fault.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Bounds on what a hostile file may claim beside its pixels. */
#define LARGEST_CHUNK 8000000
#define MOST_TEXTS 1000

/* Deflate spends at least two bits on 258 bytes. */
#define MOST_BYTES_A_BYTE 1032

/* Compressed bytes are handed to zlib in pieces of this size. */
#define COMPRESSED_BUFFER_SIZE ((size_t)1 << 14)

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

/* Strict, because a damaged file that looks like a picture would be compared as one: a wrong CRC of any chunk and
 * broken streams are errors. The Adler-32 within the stream, a fifth of the time, is left alone where libpng was built
 * so that it can be (Debian 12's, not 13's): the CRCs are over the same bytes. Chunks that change no pixel here (gamma,
 * profiles, texts) are skipped, with all they might unpack to. */
static void set_rules(png_structp png)
{
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
#ifdef PNG_IGNORE_ADLER32
    png_set_option(png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
#endif
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

static bool read_stream(FILE *file, png_task *task, void *context, image_fault *fault)
{
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, fault, image_fault_raise, ignore_warning);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool done = info == NULL ? image_fault_report(fault, "libpng does not start: ", strerror(ENOMEM))
                             : run(png, info, file, task, context);
    png_destroy_read_struct(&png, &info, NULL);
    return done;
}

/* Opening a pipe would wait for its other end; a device may never end. */
static FILE *open_file(const image_fault *fault, uint64_t *size)
{
    struct stat status;
    FILE *file = NULL;
    if (stat(fault->path, &status) != 0)
        image_fault_report(fault, "", strerror(errno));
    else if (!S_ISREG(status.st_mode))
        image_fault_report(fault, "", S_ISDIR(status.st_mode) ? strerror(EISDIR) : "it is not a regular file");
    else if ((file = fopen(fault->path, "rb")) == NULL)
        image_fault_report(fault, "", strerror(errno));
    else
        *size = (uint64_t)status.st_size;
    return file;
}

/* ---- Pixels ------------------------------------------------------------------------------------------------- */

/* What a file is turned into. */
typedef struct picture_request {
    image *out;
    uint64_t file_size;
    image_color background;
    png_byte color_type, depth; /* as stored */
    size_t samples;             /* of a pixel as libpng delivers it: 1, an index or a grey; 3; or 4, with alpha */
} picture_request;

static bool is_indexed(const picture_request *r)
{
    return r->color_type == PNG_COLOR_TYPE_PALETTE || (r->color_type == PNG_COLOR_TYPE_GRAY && r->depth <= 8);
}

/* Have libpng deliver whole samples, as exact as they are. Laying over a background is not left to it: 1.6.39 turns the
 * white of 16-bit files into 254. */
static void set_conversion(png_structp png, png_infop info, picture_request *r)
{
    r->color_type = png_get_color_type(png, info);
    r->depth = png_get_bit_depth(png, info);
    const bool keyed = png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    r->out->wide = r->depth == 16;
    r->out->transparent = keyed || (r->color_type & PNG_COLOR_MASK_ALPHA) != 0;
    r->samples = r->out->transparent ? 4 : 3;
    if (is_indexed(r)) {
        r->samples = 1;
        png_set_packing(png);
        return;
    }
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    const uint16_t one = 1;
    if (r->depth == 16 && *(const uint8_t *)&one == 1)
        png_set_swap(png);
}

/* Refuse before memory is spent on it. */
static void check_size(png_structp png, png_infop info, const picture_request *r)
{
    const png_uint_32 width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    if (width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)
        png_error(png, "a side is longer than this program's largest picture");
    const uint64_t stored = (uint64_t)png_get_rowbytes(png, info) * height;
    if (stored > MOST_BYTES_A_BYTE * r->file_size)
        png_error(png, "the file is cut short, or claims more pixels than it can hold");
}

static void create_pixels(png_structp png, png_infop info, picture_request *r)
{
    image *out = r->out;
    out->width = (int)png_get_image_width(png, info);
    out->height = (int)png_get_image_height(png, info);
    out->channels = r->samples == 1 ? 1 : 3;
    const size_t row_size = (size_t)out->width * r->samples * (out->wide ? 2 : 1);
    if (png_get_rowbytes(png, info) != row_size)
        png_error(png, "libpng cannot turn it into whole samples");
    out->pixels = malloc(row_size * (size_t)out->height);
    if (out->pixels == NULL)
        png_error(png, strerror(ENOMEM));
}

static void read_rows(png_structp png, const image *image, size_t row_size, int passes)
{
    for (int pass = 0; pass < passes; pass++) {
        for (int y = 0; y < image->height; y++)
            png_read_row(png, image->pixels + (size_t)y * row_size, NULL);
    }
}

static unsigned mix(unsigned value, unsigned ground, unsigned alpha, unsigned most)
{
    return (value * alpha + ground * (most - alpha) + most / 2) / most;
}

static image_color mix_color(image_color color, image_color ground, unsigned alpha)
{
    return (image_color){(uint8_t)mix(color.r, ground.r, alpha, 255), (uint8_t)mix(color.g, ground.g, alpha, 255),
                         (uint8_t)mix(color.b, ground.b, alpha, 255)};
}

/* From four samples a pixel to three, in place. */
static void lay_over(uint8_t *pixels, size_t count, image_color ground)
{
    for (size_t n = 0; n < count; n++) {
        const uint8_t *from = pixels + 4 * n;
        const image_color color = mix_color((image_color){from[0], from[1], from[2]}, ground, from[3]);
        memcpy(pixels + 3 * n, &color, 3);
    }
}

static void lay_over_wide(uint8_t *pixels, size_t count, image_color ground)
{
    const unsigned grounds[3] = {ground.r * 257u, ground.g * 257u, ground.b * 257u};
    for (size_t n = 0; n < count; n++) {
        uint16_t from[4], to[3];
        memcpy(from, pixels + n * sizeof from, sizeof from);
        for (size_t i = 0; i < 3; i++)
            to[i] = (uint16_t)mix(from[i], grounds[i], from[3], 65535);
        memcpy(pixels + n * sizeof to, to, sizeof to);
    }
}

static bool fits_bytes(const uint8_t *samples, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (samples[2 * i] != samples[2 * i + 1]) /* a multiple of 257 */
            return false;
    return true;
}

/* An image has 16 bits a sample only where it needs them, so that equal pictures are stored alike. */
static void narrow_where_exact(image *out)
{
    const size_t count = 3 * (size_t)out->width * (size_t)out->height;
    if (!fits_bytes(out->pixels, count))
        return;
    for (size_t i = 0; i < count; i++)
        out->pixels[i] = out->pixels[2 * i];
    out->wide = false;
}

/* The colours that the indices, or the greys, of a file stand for. */
static void set_colors(png_structp png, png_infop info, const picture_request *r)
{
    image_palette *palette = &r->out->palette;
    png_colorp colors = NULL;
    png_bytep alphas = NULL;
    png_color_16p key = NULL;
    int alpha_count = 0;
    png_get_tRNS(png, info, &alphas, &alpha_count, &key);
    const bool grey = r->color_type == PNG_COLOR_TYPE_GRAY;
    if (grey)
        palette->count = 1 << r->depth;
    else
        png_get_PLTE(png, info, &colors, &palette->count);
    for (int i = 0; i < palette->count; i++) {
        const uint8_t level = (uint8_t)(grey ? i * 255 / (palette->count - 1) : 0);
        const image_color color =
            grey ? (image_color){level, level, level} : (image_color){colors[i].red, colors[i].green, colors[i].blue};
        unsigned alpha = 255;
        if (grey)
            alpha = r->out->transparent && key->gray == i ? 0 : 255;
        else if (i < alpha_count)
            alpha = alphas[i];
        palette->colors[i] = mix_color(color, r->background, alpha);
    }
}

/* From what libpng delivered to what an image holds. */
static void finish_pixels(png_structp png, png_infop info, const picture_request *r)
{
    image *out = r->out;
    const size_t count = (size_t)out->width * (size_t)out->height;
    if (r->samples == 1) {
        set_colors(png, info, r);
        if (!image_has_colors(out)) /* libpng lets indices beyond the palette pass */
            png_error(png, "a pixel's index lies beyond the palette");
    }
    if (r->samples == 4 && !out->wide)
        lay_over(out->pixels, count, r->background);
    if (r->samples == 4 && out->wide)
        lay_over_wide(out->pixels, count, r->background);
    if (out->wide)
        narrow_where_exact(out);
}

static void decode(png_structp png, png_infop info, void *context)
{
    picture_request *r = (picture_request *)context;
    png_set_compression_buffer_size(png, COMPRESSED_BUFFER_SIZE);
    png_read_info(png, info);
    check_size(png, info, r);
    set_conversion(png, info, r);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    create_pixels(png, info, r);
    read_rows(png, r->out, png_get_rowbytes(png, info), passes);
    png_read_end(png, NULL);
    finish_pixels(png, info, r);
}

bool image_read_png_stream(FILE *stream, uint64_t size, const char *name, image_color background, image *image,
                           image_error *error)
{
    image_fault fault = {name, error};
    picture_request request = {.out = image, .file_size = size, .background = background};
    memset(image, 0, sizeof *image);
    if (read_stream(stream, decode, &request, &fault))
        return true;
    image_release(image);
    return false;
}

bool image_read_png_over(const char *path, image_color background, image *image, image_error *error)
{
    const image_fault fault = {path, error};
    uint64_t size;
    memset(image, 0, sizeof *image);
    FILE *file = open_file(&fault, &size);
    if (file == NULL)
        return false;
    const bool done = image_read_png_stream(file, size, path, background, image, error);
    fclose(file); /* only read from: nothing is left to fail */
    return done;
}

bool image_read_png(const char *path, image *image, image_error *error)
{
    return image_read_png_over(path, (image_color){255, 255, 255}, image, error);
}

/* ---- What can be told without the pixels --------------------------------------------------------------------- */

static void read_size(png_structp png, png_infop info, void *context)
{
    int *sides = (int *)context;
    png_read_info(png, info);
    sides[0] = (int)png_get_image_width(png, info);
    sides[1] = (int)png_get_image_height(png, info);
}

static bool ends_as_png(FILE *file)
{
    static const uint8_t end[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    uint8_t last[sizeof end];
    return fseek(file, -(long)sizeof last, SEEK_END) == 0 && fread(last, sizeof last, 1, file) == 1 &&
           memcmp(last, end, sizeof end) == 0;
}

bool image_read_png_ends(const char *path, int *width, int *height, bool *ends, image_error *error)
{
    image_fault fault = {path, error};
    uint64_t size;
    int sides[2] = {0, 0};
    FILE *file = open_file(&fault, &size);
    if (file == NULL)
        return false;
    const bool begins = read_stream(file, read_size, sides, &fault);
    *width = sides[0];
    *height = sides[1];
    *ends = begins && ends_as_png(file);
    fclose(file);
    return begins;
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
    image_fault fault = {path, &unread};
    uint64_t file_size;
    FILE *file = open_file(&fault, &file_size);
    if (file == NULL)
        return false;
    const bool read = read_stream(file, find_text, &request, &fault);
    fclose(file);
    return read && request.found;
}
