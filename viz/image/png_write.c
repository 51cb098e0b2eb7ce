/* SPDX-License-Identifier: MIT */
/* png_write.c - writes PNG files: libpng writes the chunks, and deflate.h compresses the pixels. */
#include "png_write.h"
#include "deflate.h"
#include "file.h"
#include "text.h"

#include <errno.h>
#include <png.h>
#include <string.h>
#include <zlib.h>

/* A file that is being written. libpng's error handler receives a pointer to this struct. */
typedef struct output {
    const image_rows *rows;
    const image_text *texts;
    size_t text_count;
    file_writer file;
    deflater *deflater;
    octreel_error *error;
} output;

/* Returns the reason why an image cannot be written, or null if the image can be written. */
static const char *find_reason_to_refuse(const image *image)
{
    if (image->wide)
        return "the image has more than 8 bits per sample";
    if (image->channels == 3)
        return NULL;
    if (image->palette.count < 1 || image->palette.count > 256)
        return "the palette must have 1 to 256 colours";
    return image_has_valid_indices(image) ? NULL : "a pixel's index is beyond the palette";
}

static void write_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *file = (FILE *)png_get_io_ptr(png);
    if (fwrite(bytes, 1, size, file) != size)
        png_error(png, strerror(errno));
}

static void write_pixels(void *png, const uint8_t *bytes, size_t size)
{
    png_write_chunk(png, (png_const_bytep) "IDAT", bytes, size);
}

static void set_header(png_structp png, png_infop info, const image_rows *rows)
{
    const image_palette *palette = rows->palette;
    bool indexed = palette != NULL;
    png_set_IHDR(png, info, (png_uint_32)rows->width, (png_uint_32)rows->height, 8,
                 indexed ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    if (indexed) {
        png_color colors[256]; /* png_color has the same three bytes as image_color */
        memcpy(colors, palette->colors, sizeof colors);
        png_set_PLTE(png, info, colors, palette->count);
    }
}

static void set_texts(png_structp png, png_infop info, const image_text *texts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        /* libpng copies the keyword and the text, although its parameters are not const. */
        png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE,
                         .key = (png_charp)texts[i].keyword,
                         .text = (png_charp)texts[i].text};
        png_set_text(png, info, &text, 1);
    }
}

/* libpng's error handler: store the reason and jump back to write_chunks(). */
static _Noreturn void raise_error(png_structp png, png_const_charp message)
{
    const output *out = png_get_error_ptr(png);
    char reason[200]; /* a printable copy of libpng's message, which may quote a keyword */
    snprintf(reason, sizeof reason, "%s", message);
    error_set(out->error, "%s: cannot be written: %s", out->file.path, make_printable(reason));
    png_longjmp(png, 1);
}

/* Write all chunks. Returns false if libpng reports an error. No local variable changes between setjmp and longjmp. */
static bool write_chunks(png_structp png, png_infop info, const output *out)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_write_fn(png, out->file.stream, write_bytes, NULL);
    set_header(png, info, out->rows);
    set_texts(png, info, out->texts, out->text_count);
    png_write_info(png, info);
    for (int y = 0; y < out->rows->height; y++)
        deflater_add_row(out->deflater, out->rows->row(y, out->rows->context));
    deflater_finish(out->deflater);
    png_write_chunk(png, (png_const_bytep) "IEND", NULL, 0);
    return true;
}

/* libpng's warnings are treated as errors: libpng warns if it changes its input, for example an invalid keyword. */
static bool encode_png(output *out)
{
    const size_t pixel = out->rows->palette ? 1 : 3, row_size = (size_t)out->rows->width * pixel + 1;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, out, raise_error, raise_error);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    out->deflater = deflater_open(row_size, (size_t)out->rows->height, pixel, write_pixels, png);
    const bool whole = info && out->deflater ? write_chunks(png, info, out) : error_no_memory(out->error);
    deflater_close(out->deflater);
    png_destroy_write_struct(&png, &info);
    return whole;
}

/* Returns whether `path` is a standard stream, a regular file, a folder, or missing. For a folder, opening the file
 * later fails with its own error. Anything else is refused, because opening a pipe would block. */
static bool is_replaceable(const char *path)
{
    struct stat status;
    return file_is_standard_stream(path) || stat(path, &status) != 0 || S_ISREG(status.st_mode) ||
           S_ISDIR(status.st_mode);
}

static bool write_file(output *out, const char *path)
{
    if (!is_replaceable(path))
        return error_set(out->error, "%s: exists and is not a regular file; choose another name", path);
    if (!file_writer_open(&out->file, path, out->error))
        return false;
    return encode_png(out) ? file_writer_close(&out->file, out->error) : file_writer_discard(&out->file);
}

static const uint8_t *get_image_row(int y, void *context)
{
    const image *image = context;
    return image->pixels + (size_t)y * (size_t)image->width * (size_t)image->channels;
}

bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error)
{
    const char *reason = find_reason_to_refuse(image);
    if (reason)
        return error_set(error, "%s: %s", path, reason);
    const image_rows rows = {.width = image->width,
                             .height = image->height,
                             .palette = image->channels == 1 ? &image->palette : NULL,
                             .row = get_image_row,
                             /* the cast removes const, but get_image_row() only reads the image */
                             .context = (void *)image};
    return write_file(&(output){.rows = &rows, .texts = texts, .text_count = text_count, .error = error}, path);
}

bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error)
{
    return write_file(&(output){.rows = rows, .error = error}, path);
}

char *image_print_library_versions(char text[IMAGE_LIBRARY_TEXT])
{
    snprintf(text, IMAGE_LIBRARY_TEXT, "libpng %s, zlib %s", png_get_libpng_ver(NULL), zlibVersion());
    return text;
}
