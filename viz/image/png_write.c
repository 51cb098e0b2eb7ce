/* png_write.c - an image to a PNG file: whole, or not at all. */
#include "fault.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

/* Large enough for the whole of a usual frame: one IDAT chunk, which stdio passes on without copying. */
#define COMPRESSED_BUFFER_SIZE ((size_t)1 << 16)

/* What goes into the file. */
typedef struct content {
    const image_rows *rows;
    const image_text *texts;
    size_t text_count;
} content;

/* Why this image cannot be written, or NULL. */
static const char *refusal(const image *image)
{
    if (image->pixels == NULL || image->width < 1 || image->height < 1)
        return "the image has no pixels";
    if (image->wide)
        return "the image has more than 8 bits a sample";
    if (image->channels == 3)
        return NULL;
    if (image->channels != 1)
        return "the image has neither one channel nor three";
    if (image->palette.count < 1 || image->palette.count > 256)
        return "the palette has not 1 to 256 colours";
    if (!image_has_colors(image))
        return "a pixel's index lies beyond the palette";
    return NULL;
}

static void write_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *file = (FILE *)png_get_io_ptr(png);
    if (fwrite(bytes, 1, size, file) != size)
        png_error(png, strerror(errno));
}

static void set_header(png_structp png, png_infop info, const image_rows *rows)
{
    const image_palette *palette = rows->palette;
    bool indexed = palette != NULL;
    png_set_IHDR(png, info, (png_uint_32)rows->width, (png_uint_32)rows->height, 8,
                 indexed ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    if (indexed) {
        png_color colors[256];
        for (int i = 0; i < palette->count; i++) {
            image_color color = palette->colors[i];
            colors[i] = (png_color){color.r, color.g, color.b};
        }
        png_set_PLTE(png, info, colors, palette->count);
    }
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, indexed ? Z_RLE : Z_DEFAULT_STRATEGY);
    png_set_compression_buffer_size(png, COMPRESSED_BUFFER_SIZE);
    png_set_check_for_invalid_index(png, 0); /* done, faster, by refusal() */
}

static void set_texts(png_structp png, png_infop info, const image_text *texts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        /* libpng copies both, but takes them without const. */
        png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE,
                         .key = (png_charp)texts[i].keyword,
                         .text = (png_charp)texts[i].text};
        png_set_text(png, info, &text, 1);
    }
}

static void write_rows(png_structp png, const image_rows *rows)
{
    for (int y = 0; y < rows->height; y++)
        png_write_row(png, rows->row(y, rows->context));
}

/* The function that libpng's errors jump back to; nothing in it changes between setjmp and jump. */
static bool write_chunks(png_structp png, png_infop info, const content *content, FILE *file)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_write_fn(png, file, write_bytes, NULL);
    set_header(png, info, content->rows);
    set_texts(png, info, content->texts, content->text_count);
    png_write_info(png, info);
    write_rows(png, content->rows);
    png_write_end(png, NULL);
    return true;
}

/* Warnings are errors here: libpng warns where it would write something else than it was given, a keyword say. */
static bool encode(const content *content, FILE *file, image_fault *fault)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, fault, image_fault_raise, image_fault_raise);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    bool whole = info == NULL ? image_fault_report(fault, "libpng does not start: ", strerror(ENOMEM))
                              : write_chunks(png, info, content, file);
    png_destroy_write_struct(&png, &info);
    return whole;
}

/* A rename would put a file in the place of a device or a pipe. */
static bool is_replaceable(const char *path)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode); /* a folder stays */
}

/* A full disk may show as late as in fclose, when stdio hands over its last bytes. */
static bool write_by_rename(const content *content, const char *part, image_fault *fault)
{
    FILE *file = fopen(part, "wb");
    if (file == NULL)
        return image_fault_report(fault, "cannot create its .part file: ", strerror(errno));
    bool whole = encode(content, file, fault);
    if (fclose(file) != 0 && whole)
        whole = image_fault_report(fault, "", strerror(errno));
    if (whole && rename(part, fault->path) != 0)
        whole = image_fault_report(fault, "cannot rename its .part file: ", strerror(errno));
    if (!whole)
        unlink(part);
    return whole;
}

static bool write_content(const content *content, image_fault *fault)
{
    if (!is_replaceable(fault->path))
        return image_fault_report(fault, "cannot be replaced: ", "it is there, and is not a regular file");
    size_t part_size = strlen(fault->path) + sizeof ".part";
    char *part = malloc(part_size);
    if (part == NULL)
        return image_fault_report(fault, "", strerror(ENOMEM));
    snprintf(part, part_size, "%s.part", fault->path);
    bool written = write_by_rename(content, part, fault);
    free(part);
    return written;
}

static const uint8_t *row_of_image(int y, void *context)
{
    const image *image = context;
    return image->pixels + (size_t)y * (size_t)image->width * (size_t)image->channels;
}

bool image_write_png(const image *image, const char *path, const image_text *texts, size_t text_count,
                     octreel_error *error)
{
    image_fault fault = {path, error};
    const char *reason = refusal(image);
    if (reason != NULL)
        return image_fault_report(&fault, "", reason);
    const image_rows rows = {.width = image->width,
                             .height = image->height,
                             .palette = image->channels == 1 ? &image->palette : NULL,
                             .row = row_of_image,
                             .context = (void *)image}; /* which is only read */
    return write_content(&(content){&rows, texts, text_count}, &fault);
}

bool image_write_png_rows(const image_rows *rows, const char *path, octreel_error *error)
{
    image_fault fault = {path, error};
    return write_content(&(content){.rows = rows}, &fault);
}

char *image_library(char text[IMAGE_LIBRARY_TEXT])
{
    snprintf(text, IMAGE_LIBRARY_TEXT, "libpng %s, zlib %s", png_get_libpng_ver(NULL), zlibVersion());
    return text;
}
