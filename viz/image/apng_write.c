/* SPDX-License-Identifier: MIT */
/* apng_write.c - writes the chunks of APNG files; deflate.h compresses the pixels.
 *
 * An APNG is a PNG with three more kinds of chunks. acTL holds the number of frames. An fcTL chunk precedes each frame:
 * it holds the frame's rectangle, its duration and how the frame is drawn onto the previous one. fdAT holds the pixels
 * of a frame; only the first frame has its pixels in IDAT. The chunks fcTL and fdAT are numbered in one sequence.
 * Specification: W3C, PNG third edition, 11.3.2.
 *
 * A later frame holds only the rectangle that changed. Inside the rectangle, an unchanged pixel can be stored in two
 * ways. In the plain form it has its own colour, so that it may repeat the row above. In the masked form it is
 * transparent, so that the pixel of the previous frame stays visible and all unchanged pixels form runs of one value.
 * It depends on the picture which form is smaller: a few points may move, or the whole scene. Both forms are tried, and
 * the smaller one is written. The masked form needs a free palette entry for the transparent colour, so RGB frames are
 * always plain. */
#include "apng_write.h"
#include "array.h"
#include "bytes.h"
#include "deflate.h"
#include "file.h"

#include <errno.h>
#include <stdlib.h>
#include <zlib.h>

/* An fdAT chunk begins with its number, which has this many bytes. An encoding begins with room for the number; IDAT is
 * written without this room. */
enum { NUMBER_SIZE = 4 };

/* The compressed pixels of a rectangle, after NUMBER_SIZE bytes for the number of an fdAT chunk. */
typedef struct encoding {
    ARRAY(uint8_t) bytes;
    bool lacks_memory;
} encoding;

/* A rectangle of pixels. `right` and `bottom` are exclusive. */
typedef struct rectangle {
    int left, top, right, bottom;
} rectangle;

struct apng_writer {
    file_writer file;
    int write_error; /* errno of the first write that failed, or 0 */
    apng_description about;
    size_t pixel;           /* bytes per pixel: 1 or 3 */
    int transparent;        /* the palette index of the transparent colour, or -1 */
    uint32_t number;        /* the number of the next fcTL or fdAT chunk */
    uint8_t *before;        /* the pixels of the last frame; null before the first frame */
    uint8_t *row;           /* room for a row of palette indices */
    encoding plain, masked; /* the two forms of the current frame */
};

/* ---- Chunks -------------------------------------------------------------------------------------------------- */

static uint8_t *store_big_endian(uint8_t *to, uint32_t value, int size)
{
    for (int i = 0; i < size; i++)
        *to++ = (uint8_t)(value >> 8 * (size - 1 - i));
    return to;
}

static void put_bytes(apng_writer *w, const void *bytes, size_t size)
{
    if (size > 0 && w->write_error == 0 && fwrite(bytes, 1, size, w->file.stream) != size)
        w->write_error = errno;
}

static void put_chunk(apng_writer *w, const char *name, const uint8_t *data, size_t size)
{
    uint8_t word[4];
    uLong crc = crc32(0, (const uint8_t *)name, 4);
    crc = size > 0 ? crc32(crc, data, (uInt)size) : crc;
    store_big_endian(word, (uint32_t)size, 4);
    put_bytes(w, word, 4);
    put_bytes(w, name, 4);
    put_bytes(w, data, size);
    store_big_endian(word, (uint32_t)crc, 4);
    put_bytes(w, word, 4);
}

static void put_palette(apng_writer *w, const image_palette *palette)
{
    uint8_t colors[3 * 256] = {0}, alphas[256];
    const size_t count = (size_t)palette->count + (w->transparent >= 0);
    memcpy(colors, palette->colors, 3 * (size_t)palette->count);
    put_chunk(w, "PLTE", colors, 3 * count);
    if (w->transparent < 0)
        return;
    memset(alphas, 255, sizeof alphas);
    alphas[w->transparent] = 0;
    put_chunk(w, "tRNS", alphas, count);
}

static void put_header(apng_writer *w)
{
    enum { BITS = 8, COLOR_RGB = 2, COLOR_INDEXED = 3 };
    const apng_description *about = &w->about;
    uint8_t header[13], control[8] = {0}; /* the last four bytes of acTL are 0: the film repeats for ever */
    store_big_endian(store_big_endian(header, (uint32_t)about->width, 4), (uint32_t)about->height, 4);
    memcpy(header + 8, (const uint8_t[]){BITS, about->palette ? COLOR_INDEXED : COLOR_RGB, 0, 0, 0}, 5);
    store_big_endian(control, about->frames, 4);
    put_bytes(w, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(w, "IHDR", header, sizeof header);
    put_chunk(w, "acTL", control, sizeof control);
    if (about->palette)
        put_palette(w, about->palette);
}

static void put_frame_control(apng_writer *w, const rectangle *area, uint16_t shown, bool over)
{
    uint8_t control[26], *at = store_big_endian(control, w->number++, 4);
    at = store_big_endian(at, (uint32_t)(area->right - area->left), 4);
    at = store_big_endian(at, (uint32_t)(area->bottom - area->top), 4);
    at = store_big_endian(at, (uint32_t)area->left, 4);
    at = store_big_endian(at, (uint32_t)area->top, 4);
    at = store_big_endian(at, shown, 2);
    at = store_big_endian(at, w->about.rate, 2);
    *at++ = 0;    /* dispose_op none: the next frame is put on this one */
    *at++ = over; /* blend_op: 0 replaces the pixels, 1 keeps the pixels below transparent ones */
    put_chunk(w, "fcTL", control, sizeof control);
}

static void put_frame_data(apng_writer *w, encoding *e)
{
    uint8_t *bytes = e->bytes.items;
    const size_t size = e->bytes.count;
    if (!w->before) {
        put_chunk(w, "IDAT", bytes + NUMBER_SIZE, size - NUMBER_SIZE);
        return;
    }
    store_big_endian(bytes, w->number++, NUMBER_SIZE);
    put_chunk(w, "fdAT", bytes, size);
}

/* ---- Pixels -------------------------------------------------------------------------------------------------- */

static size_t pixel_offset(const apng_writer *w, int x, int y)
{
    return ((size_t)y * (size_t)w->about.width + (size_t)x) * w->pixel;
}

/* Extend a rectangle by the changed pixels of a row. */
static void extend_by_row_changes(const apng_writer *w, const uint8_t *pixels, int y, rectangle *area)
{
    const uint8_t *now = pixels + pixel_offset(w, 0, y), *before = w->before + pixel_offset(w, 0, y);
    const size_t size = (size_t)w->about.width * w->pixel, first = bytes_common_prefix_length(now, before, size);
    size_t last = size;
    if (first == size)
        return;
    while (now[last - 1] == before[last - 1])
        last--;
    const int left = (int)(first / w->pixel), right = (int)((last - 1) / w->pixel) + 1;
    area->left = left < area->left ? left : area->left;
    area->right = right > area->right ? right : area->right;
    area->top = y < area->top ? y : area->top;
    area->bottom = y + 1;
}

/* Returns the smallest rectangle with all changed pixels. The first frame is a change everywhere. If nothing changed,
 * returns the first pixel, because a rectangle cannot be empty. */
static rectangle find_changes(const apng_writer *w, const uint8_t *pixels)
{
    const int width = w->about.width, height = w->about.height;
    rectangle area = {width, height, 0, 0};
    if (!w->before)
        return (rectangle){0, 0, width, height};
    for (int y = 0; y < height; y++)
        extend_by_row_changes(w, pixels, y, &area);
    return area.bottom > 0 ? area : (rectangle){0, 0, 1, 1};
}

/* Returns the pixels of a row in which each unchanged pixel is replaced by the transparent colour. */
static const uint8_t *mask_row(apng_writer *w, const uint8_t *now, const uint8_t *before, size_t count)
{
    for (size_t i = 0; i < count; i++)
        w->row[i] = now[i] == before[i] ? (uint8_t)w->transparent : now[i];
    return w->row;
}

static void append_bytes(void *context, const uint8_t *bytes, size_t size)
{
    encoding *e = context;
    e->lacks_memory = e->lacks_memory || !ARRAY_GROW(&e->bytes, size);
    if (e->lacks_memory)
        return;
    memcpy(e->bytes.items + e->bytes.count, bytes, size);
    e->bytes.count += size;
}

static bool encode_frame(apng_writer *w, const uint8_t *pixels, const rectangle *area, bool masked, encoding *e)
{
    const size_t count = (size_t)(area->right - area->left), rows = (size_t)(area->bottom - area->top);
    deflater *d = deflater_open(count * w->pixel + 1, rows, w->pixel, append_bytes, e);
    e->bytes.count = 0;
    append_bytes(e, (const uint8_t[NUMBER_SIZE]){0}, NUMBER_SIZE);
    for (int y = area->top; d && y < area->bottom; y++) {
        const size_t at = pixel_offset(w, area->left, y);
        deflater_add_row(d, masked ? mask_row(w, pixels + at, w->before + at, count) : pixels + at);
    }
    if (d)
        deflater_finish(d);
    deflater_close(d);
    return d && !e->lacks_memory;
}

static bool store_previous_frame(apng_writer *w, const uint8_t *pixels)
{
    const size_t size = pixel_offset(w, 0, w->about.height);
    if (!w->before)
        w->before = malloc(size);
    if (w->before)
        memcpy(w->before, pixels, size);
    return w->before != NULL;
}

bool apng_writer_add(apng_writer *w, const uint8_t *pixels, uint16_t shown, octreel_error *error)
{
    const rectangle area = find_changes(w, pixels);
    const bool both = w->before && w->transparent >= 0;
    if (!encode_frame(w, pixels, &area, false, &w->plain) ||
        (both && !encode_frame(w, pixels, &area, true, &w->masked)))
        return error_no_memory(error);
    const bool over = both && w->masked.bytes.count < w->plain.bytes.count;
    put_frame_control(w, &area, shown, over);
    put_frame_data(w, over ? &w->masked : &w->plain);
    if (w->write_error != 0)
        return error_set(error, "%s: cannot be written: %s", file_output_display_name(w->file.path),
                         strerror(w->write_error));
    return store_previous_frame(w, pixels) || error_no_memory(error);
}

/* ---- The file ------------------------------------------------------------------------------------------------ */

static void release_writer(apng_writer *w)
{
    free(w->before);
    free(w->row);
    free(w->plain.bytes.items);
    free(w->masked.bytes.items);
    free(w);
}

apng_writer *apng_writer_open(const char *path, const apng_description *about, octreel_error *error)
{
    apng_writer *w = calloc(1, sizeof *w);
    uint8_t *row = w ? malloc((size_t)about->width) : NULL;
    if (row ? !file_writer_open(&w->file, path, error) : !error_no_memory(error)) {
        free(row);
        free(w);
        return NULL;
    }
    w->about = *about;
    w->row = row;
    w->pixel = about->palette ? 1 : 3;
    w->transparent = about->palette && about->palette->count < 256 && about->frames > 1 ? about->palette->count : -1;
    put_header(w);
    return w;
}

bool apng_writer_close(apng_writer *w, octreel_error *error)
{
    put_chunk(w, "IEND", NULL, 0);
    errno = w->write_error;
    const bool whole = file_writer_close(&w->file, error);
    release_writer(w);
    return whole;
}

bool apng_writer_discard(apng_writer *w)
{
    if (!w)
        return false;
    file_writer_discard(&w->file);
    release_writer(w);
    return false;
}
