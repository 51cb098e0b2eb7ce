/* SPDX-License-Identifier: MIT */
/* fuzz_deflate.c - libFuzzer entry of the encoder of rows: zlib's inflate must return the rows and accept their
 * checksum. Three bytes choose the length of the rows and how the other bytes become pixels. Build with clang
 * -fsanitize=fuzzer,address,undefined. */
#include "deflate.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool holds)
{
    if (!holds)
        abort();
}

/* The stream, inflated while it is written. */
typedef struct inflating {
    z_stream stream;
    int state;
} inflating;

static void inflate_more(void *context, const uint8_t *bytes, size_t size)
{
    inflating *i = context;
    check(size > 0 && i->state == Z_OK);
    i->stream.next_in = (Bytef *)bytes;
    i->stream.avail_in = (uInt)size;
    i->state = inflate(&i->stream, Z_NO_FLUSH);
    check(i->stream.avail_in == 0);
}

/* Undo PNG's filter Sub, which rows of RGB pictures may have. */
static void undo_filter(uint8_t *row, size_t size, size_t pixel)
{
    check(row[0] <= (pixel > 1));
    for (size_t i = 1 + pixel; row[0] && i < size; i++)
        row[i] = (uint8_t)(row[i] + row[i - pixel]);
    row[0] = 0;
}

/* Each byte of the input is a run of a colour, or repeats earlier pixels. */
static size_t fill(uint8_t *pixels, size_t room, const uint8_t *data, size_t size, unsigned spread)
{
    size_t made = 0;
    for (size_t i = 0; i + 1 < size && made < room; i += 2) {
        size_t length = 1 + (size_t)(data[i] & 15) * spread;
        const size_t back = 1 + (size_t)data[i + 1] * spread;
        for (; length > 0 && made < room; length--, made++)
            pixels[made] = data[i] & 128 && back <= made ? pixels[made - back] : data[i + 1];
    }
    return made;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MOST = 1 << 19 };
    static uint8_t pixels[MOST], expected[2 * MOST], got[2 * MOST];
    if (size < 4)
        return 0;
    const size_t pixel = data[0] & 1 ? 3 : 1;
    const size_t row = pixel * (1 + data[1] + (size_t)(data[0] & 126) * 100);
    const size_t rows = fill(pixels, MOST, data + 3, size - 3, data[2]) / row;
    if (rows == 0 || rows * (row + 1) > sizeof expected)
        return 0;
    inflating i = {.stream = {.next_out = got, .avail_out = sizeof got}};
    check(inflateInit(&i.stream) == Z_OK);
    deflater *d = deflater_open(row + 1, rows, pixel, inflate_more, &i);
    check(d);
    for (size_t y = 0; y < rows; y++) {
        expected[y * (row + 1)] = 0;
        memcpy(expected + y * (row + 1) + 1, pixels + y * row, row);
        deflater_add_row(d, pixels + y * row);
    }
    deflater_finish(d);
    deflater_close(d);
    check(i.state == Z_STREAM_END && i.stream.total_out == rows * (row + 1));
    for (size_t y = 0; y < rows; y++)
        undo_filter(got + y * (row + 1), row + 1, pixel);
    check(memcmp(expected, got, rows * (row + 1)) == 0);
    inflateEnd(&i.stream);
    return 0;
}
