/* SPDX-License-Identifier: MIT */
/* apng_read.c - see apng_read.h. */
#include "apng_read.h"
#include "files.h"
#include "fixture.h"
#include "png_by_hand.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

typedef struct chunk {
    char type[5];
    const uint8_t *data;
    uint32_t size;
} chunk;

typedef struct reader {
    const uint8_t *at, *end;
    apng_film film;
    uint32_t promised, number; /* frames in acTL; the next sequence number */
    uint8_t palette[256][3], alphas[256];
    uint8_t *canvas;
} reader;

static chunk next_chunk(reader *r)
{
    chunk c = {.size = 0};
    assert_true(r->end - r->at >= 12);
    c.size = png_u32_at(r->at);
    assert_true((size_t)(r->end - r->at) - 12 >= c.size);
    memcpy(c.type, r->at + 4, 4);
    c.data = r->at + 8;
    assert_int_equal(crc32(0, r->at + 4, c.size + 4), png_u32_at(c.data + c.size));
    r->at = c.data + c.size + 4;
    return c;
}

static void read_header(reader *r)
{
    assert_memory_equal(r->at, "\x89PNG\r\n\x1a\n", 8);
    r->at += 8;
    chunk c = next_chunk(r);
    assert_string_equal(c.type, "IHDR");
    r->film.width = (int)png_u32_at(c.data);
    r->film.height = (int)png_u32_at(c.data + 4);
    const bool indexed = c.data[9] == 3;
    assert_true(c.data[8] == 8 && (indexed || c.data[9] == 2) && c.data[12] == 0);
    c = next_chunk(r);
    assert_string_equal(c.type, "acTL");
    r->promised = png_u32_at(c.data);
    r->film.plays = png_u32_at(c.data + 4);
    memset(r->alphas, 255, sizeof r->alphas);
    if (!indexed)
        return;
    c = next_chunk(r);
    assert_string_equal(c.type, "PLTE");
    r->film.colors = (int)c.size / 3;
    memcpy(r->palette, c.data, c.size);
}

static apng_frame read_control(reader *r, const chunk *c)
{
    assert_string_equal(c->type, "fcTL");
    assert_int_equal(c->size, 26);
    assert_int_equal(png_u32_at(c->data), r->number++);
    const apng_frame f = {.width = (int)png_u32_at(c->data + 4),
                          .height = (int)png_u32_at(c->data + 8),
                          .left = (int)png_u32_at(c->data + 12),
                          .top = (int)png_u32_at(c->data + 16),
                          .shown = (unsigned)c->data[20] << 8 | c->data[21],
                          .rate = (unsigned)c->data[22] << 8 | c->data[23],
                          .over = c->data[25] == 1};
    assert_int_equal(c->data[24], 0);
    assert_true(f.width > 0 && f.height > 0);
    assert_true(f.left + f.width <= r->film.width && f.top + f.height <= r->film.height);
    return f;
}

/* Put the rows of a rectangle on the canvas. */
static void compose(reader *r, const apng_frame *f, const uint8_t *data, size_t size)
{
    const size_t pixel = r->film.colors ? 1 : 3, row = (size_t)f->width * pixel + 1;
    uLongf room = row * (size_t)f->height;
    uint8_t *rows = malloc(room);
    assert_non_null(rows);
    assert_int_equal(uncompress(rows, &room, data, size), Z_OK);
    assert_int_equal(room, row * (size_t)f->height);
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width; x++) {
            const uint8_t *from = rows + (size_t)y * row + 1 + (size_t)x * pixel;
            uint8_t *to = r->canvas + 3 * ((size_t)(f->top + y) * (size_t)r->film.width + (size_t)(f->left + x));
            assert_int_equal(rows[(size_t)y * row], 0);
            if (pixel == 3) {
                memcpy(to, from, 3);
                continue;
            }
            assert_true(*from < r->film.colors);
            assert_true(r->alphas[*from] == 255 || f->over);
            if (r->alphas[*from] == 255)
                memcpy(to, r->palette[*from], 3);
        }
    free(rows);
}

static void add_frame(reader *r, apng_frame f)
{
    const size_t size = 3 * (size_t)r->film.width * (size_t)r->film.height;
    f.rgb = malloc(size);
    r->film.frames = realloc(r->film.frames, (r->film.count + 1) * sizeof f);
    assert_true(f.rgb && r->film.frames);
    memcpy(f.rgb, r->canvas, size);
    r->film.frames[r->film.count++] = f;
}

static void read_frame(reader *r, const chunk *control)
{
    const apng_frame f = read_control(r, control);
    const chunk c = next_chunk(r);
    assert_string_equal(c.type, r->film.count == 0 ? "IDAT" : "fdAT");
    if (r->film.count > 0) {
        assert_int_equal(png_u32_at(c.data), r->number++);
        compose(r, &f, c.data + 4, c.size - 4);
    } else {
        assert_true(f.width == r->film.width && f.height == r->film.height && !f.over);
        compose(r, &f, c.data, c.size);
    }
    add_frame(r, f);
}

apng_film apng_read(const char *path)
{
    size_t size;
    char *bytes = file_read(path, &size);
    reader r = {.at = (const uint8_t *)bytes, .end = (const uint8_t *)bytes + size};
    read_header(&r);
    r.canvas = calloc(3 * (size_t)r.film.width, (size_t)r.film.height);
    assert_non_null(r.canvas);
    chunk c = next_chunk(&r);
    if (strcmp(c.type, "tRNS") == 0) {
        assert_true((int)c.size <= r.film.colors);
        memcpy(r.alphas, c.data, c.size);
        c = next_chunk(&r);
    }
    for (; strcmp(c.type, "IEND") != 0; c = next_chunk(&r))
        read_frame(&r, &c);
    assert_ptr_equal(r.at, r.end);
    assert_int_equal(r.film.count, r.promised);
    free(r.canvas);
    free(bytes);
    return r.film;
}

void apng_release(apng_film *film)
{
    for (size_t i = 0; i < film->count; i++)
        free(film->frames[i].rgb);
    free(film->frames);
    *film = (apng_film){0};
}
