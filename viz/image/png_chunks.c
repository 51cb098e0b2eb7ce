/* png_read.c - a PNG file to an image that is at hand whole, to its size or to one of its texts. */
#include "png_read.h"

#include <string.h>

/* ---- Pixels ------------------------------------------------------------------------------------------------- */

/* Take the image out of a source that has read it whole. */
static bool take_image(image_source *source, image *image)
{
    memset(image, 0, sizeof *image);
    if (!source)
        return false;
    image_source_take(source, image);
    return true;
}

bool image_read_png_stream(FILE *stream, uint64_t size, const char *name, image_color background, image *image,
                           octreel_error *error)
{
    return take_image(image_source_open_stream(stream, size, name, background, true, error), image);
}

bool image_read_png_over(const char *path, image_color background, image *image, octreel_error *error)
{
    return take_image(image_source_open(path, background, true, error), image);
}

bool image_read_png(const char *path, image *image, octreel_error *error)
{
    return image_read_png_over(path, IMAGE_WHITE, image, error);
}

/* ---- What can be told without the pixels --------------------------------------------------------------------- */

static void read_size(png_structp png, png_infop info, void *context)
{
    int *sides = (int *)context;
    png_read_info(png, info);
    sides[0] = (int)png_get_image_width(png, info);
    sides[1] = (int)png_get_image_height(png, info);
}

/* Take one step of reading a file. */
static bool read_file(FILE *file, const char *path, decoder_task *task, void *context, octreel_error *error)
{
    decoder d;
    const bool done = decoder_open(&d, file, path, error) && decoder_run(&d, task, context);
    decoder_close(&d);
    return done;
}

static bool ends_as_png(FILE *file)
{
    static const uint8_t end[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    uint8_t last[sizeof end];
    return fseek(file, -(long)sizeof last, SEEK_END) == 0 && fread(last, sizeof last, 1, file) == 1 &&
           memcmp(last, end, sizeof end) == 0;
}

bool image_read_png_ends(const char *path, int *width, int *height, bool *ends, octreel_error *error)
{
    const image_fault fault = {path, error};
    uint64_t size;
    int sides[2] = {0, 0};
    FILE *file = decoder_open_file(&fault, &size);
    if (file == NULL)
        return false;
    const bool begins = read_file(file, path, read_size, sides, error);
    *width = sides[0];
    *height = sides[1];
    *ends = begins && ends_as_png(file);
    fclose(file);
    return begins;
}

typedef struct text_request {
    const char *keyword;
    char *text;
    size_t size;
    bool found;
} text_request;

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
    octreel_error unread;
    const image_fault fault = {path, &unread};
    uint64_t file_size;
    FILE *file = decoder_open_file(&fault, &file_size);
    if (file == NULL)
        return false;
    const bool read = read_file(file, path, find_text, &request, &unread);
    fclose(file);
    return read && request.found;
}
