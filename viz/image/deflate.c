/* SPDX-License-Identifier: MIT */
/* deflate.c - finds the repeats in a picture's rows; deflate_block.c writes the repeats as a compressed stream.
 *
 * Deflate (RFC 1951) describes bytes as literals and as repeats (length, distance) of bytes up to 32768 back. General
 * encoders find repeats by hashing every position, which costs most of their time. In a drawn picture nearly all useful
 * repeats lie at two known distances: one pixel back (a run of one colour) and one row back (the row above). So this
 * encoder first compares the next bytes with the bytes at these two distances, eight bytes at a time.
 *
 * Palette indices: a literal costs few bits. All bytes before the next possible repeat become literals together. If the
 * repeat at the next position is better than the repeat at the current position, one literal is written first (lazy
 * matching, as in zlib).
 *
 * RGB pictures: a pixel costs three literals, so a small hash table of two pixels each also finds repeats at other
 * distances. Repeats are searched once a pixel, not once a byte, and after a few pixels without a repeat only once in
 * two pixels. The three searches are compared without a branch, because a processor cannot predict which one succeeds.
 *
 * Filters: shaded surfaces have many colours but small differences between neighbouring pixels. PNG's filter Sub stores
 * these differences. Lines have few colours but many differences, and are larger with Sub. A sample of the pixels
 * decides; see sample_row().
 *
 * The Adler-32 checksum costs nothing for bytes that equal the row above. Both of its sums are linear in the bytes, so
 * only the change from one row to the next is added; see add_row_to_sums().
 *
 * Cost: O(bytes). On indexed line drawings, the result is smaller than that of zlib's level 6, and the encoder is
 * faster than level 1. On shaded point clouds in RGB, the result is as small as that of libdeflate's level 1 after the
 * filter Sub, in half the time. */
#include "deflate.h"
#include "bytes.h"
#include "deflate_block.h"

#include <stdlib.h>
#include <string.h>

enum {
    /* the maximum number of bytes that are collected before they are encoded; so many bytes fit the L1 cache */
    CHUNK = 32 << 10,
    RGB_CHUNK = 128 << 10, /* the same for RGB, where moving the hash table after each chunk costs time */
    WORD = 8,              /* the number of bytes after the window's end that may be read; their values do not matter */

    /* Estimated sizes in bits, used to choose among repeats. BYTE_BITS: a literal. RUN_BITS: a repeat of the pixel
     * before. ABOVE_BITS: a repeat of the row above. FAR_BITS: a repeat at any other distance. */
    BYTE_BITS = 3,
    RUN_BITS = 6,
    ABOVE_BITS = 14,
    FAR_BITS = 16,
    LONG_REPEAT = 64, /* if a repeat has at least this many bytes, no better repeat is searched for */

    HASH_BITS = 12,
    RGB = 3,      /* number of bytes of an RGB pixel */
    PATIENCE = 4, /* after so many pixels without a repeat, the next repeats are searched once in two pixels */
    SAMPLED = 29, /* one pixel in this many is sampled to choose the filter */
    SAMPLE = 512, /* the filter is chosen anew after so many sampled bytes */
    ADLER_BASE = 65521,
};

struct deflater {
    size_t stride, rows, pixel;
    size_t kept;           /* the number of bytes that slide_window() keeps: the history that repeats may refer to */
    size_t room;           /* size of the window in bytes */
    size_t end;            /* number of bytes in the window */
    size_t at;             /* index in the window of the first byte that is not encoded yet */
    bool begun;            /* true: the first row was added */
    bool above;            /* true: the distance to the row above is within deflate's largest distance */
    size_t block;          /* index in the window of the current block's first byte */
    bool block_whole;      /* true: all bytes of the current block are still in the window */
    size_t unsummed;       /* index in the window of the first byte that is not in the Adler-32 sums yet */
    size_t row;            /* index in the window of the first byte of the row that contains the byte at `unsummed` */
    size_t rows_left;      /* number of rows of the picture from the row at `row` on, that row included */
    int64_t row_change;    /* sum of (byte - byte above) over the bytes of the row at `row` before `unsummed` */
    int64_t row_by_column; /* sum of (byte - byte above) * column over the same bytes as row_change */
    int64_t sums[2];       /* the two sums of Adler-32, without the initial 1 of the first sum */
    bool filtered;         /* true: the next row is stored with the filter Sub; only for RGB */
    size_t sampled;        /* number of bytes in the sample */
    /* index: whether the filter is Sub; number of times that each byte occurs in the sample, and number of pairs of
     * equal bytes in the sample */
    uint16_t seen[2][256];
    uint32_t pairs[2];
    deflate_blocks blocks;
    /* only for RGB; index: a hash; value: the last position of bytes with this hash, or 0 */
    uint32_t heads[1 << HASH_BITS];
    /* the window; at first it begins with `kept` zeros, which stand for the bytes before the first row */
    uint8_t *window;
};

/* ---- Adler-32 ------------------------------------------------------------------------------------------------ */

/* Add the changes of a row to the two sums of Adler-32. Both sums are linear in the bytes, so a byte equal to the byte
 * above costs nothing.
 *
 * Let a byte at column x differ by c from the byte above, and let m be the number of remaining rows, this row included.
 * The change persists through these m rows. It adds m * c to the first sum. It adds (m * (m + 1) / 2 * stride - m * x)
 * * c to the second sum, which weights each byte by its distance from the end. */
static void add_row_to_sums(deflater *d)
{
    const int64_t m = (int64_t)d->rows_left--, plain = d->row_change % ADLER_BASE;
    const int64_t twice = m * (m + 1) / 2 % ADLER_BASE * (int64_t)d->stride % ADLER_BASE;
    d->sums[0] = (d->sums[0] + m * plain) % ADLER_BASE;
    d->sums[1] = (d->sums[1] + twice * plain - m * (d->row_by_column % ADLER_BASE)) % ADLER_BASE;
    d->row_change = d->row_by_column = 0;
    d->row += d->stride;
}

static void add_span_changes(deflater *d, size_t from, size_t end)
{
    const uint8_t *bytes = d->window + from, *above = bytes - d->stride;
    int32_t plain = 0, by_place = 0;
    for (int32_t i = 0; i < (int32_t)(end - from); i++) {
        const int16_t change = (int16_t)(bytes[i] - above[i]), place = (int16_t)i;
        plain += change;
        by_place += change * place;
    }
    d->row_change += plain;
    d->row_by_column += by_place + (int64_t)(from - d->row) * plain;
}

/* Add the changes of the bytes from `unsummed` up to `end` to the sums of the row. Bytes in repeats of the row above
 * are skipped, because they have no change. */
static void add_changes(deflater *d, size_t end)
{
    enum { MOST = 256 }; /* the maximum number of bytes whose products can be summed in 32 bits */
    for (size_t at = d->unsummed, next; at < end; at = next) {
        while (at - d->row >= d->stride)
            add_row_to_sums(d);
        next = d->row + d->stride < end ? d->row + d->stride : end;
        next = next - at < MOST ? next : at + MOST;
        add_span_changes(d, at, next);
    }
    d->unsummed = end;
}

static uint32_t compute_final_adler32(deflater *d)
{
    add_row_to_sums(d);
    /* The first sum of Adler-32 begins with 1. This 1 is added to the second sum once for each byte. */
    const int64_t each = (int64_t)(d->stride * d->rows) % ADLER_BASE;
    const int64_t first = (d->sums[0] + 1 + ADLER_BASE) % ADLER_BASE;
    const int64_t second = (d->sums[1] + each + ADLER_BASE) % ADLER_BASE;
    return (uint32_t)second << 16 | (uint32_t)first;
}

/* ---- Tokens -------------------------------------------------------------------------------------------------- */

static void end_block(deflater *d, bool last)
{
    deflate_write_block(&d->blocks, d->block_whole ? d->window + d->block : NULL, d->at - d->block, last);
    d->block = d->at;
    d->block_whole = true;
}

static void add_literals(deflater *d, size_t count)
{
    deflate_add_literals(&d->blocks, d->window + d->at, count);
    d->at += count;
}

/* Returns whether each of the next `size` bytes equals the byte one pixel before it. A repeat of the pixel before takes
 * the fewest bits. */
static inline bool repeats_last_pixel(const deflater *d, size_t size)
{
    const uint8_t *bytes = d->window + d->at, *before = bytes - d->pixel;
    return bytes[0] == before[0] && bytes[size - 1] == before[size - 1] && memcmp(bytes, before, size) == 0;
}

static void add_repeat(deflater *d, size_t length, size_t distance)
{
    if (distance == d->stride) {
        add_changes(d, d->at);
        d->unsummed += length;
    }
    while (length > 0) {
        size_t part = length < DEFLATE_LONGEST ? length : DEFLATE_LONGEST;
        if (length > part && length - part < DEFLATE_SHORTEST)
            part -= DEFLATE_SHORTEST;
        deflate_add_repeat(&d->blocks, part, repeats_last_pixel(d, part) ? d->pixel : distance);
        d->at += part;
        length -= part;
        if (deflate_is_block_full(&d->blocks))
            end_block(d, false);
    }
}

/* Returns the number of bytes, at most DEFLATE_GROUP, before the next byte at which a repeat of 3 bytes may begin.
 * These bytes become literals. */
static inline size_t count_literals(const deflater *d)
{
    const uint8_t *at = d->window + d->at;
    const uint64_t word = bytes_load_word(at);
    const uint64_t run = bytes_mark_zero_bytes(word ^ bytes_load_word(at - d->pixel));
    const uint64_t above = d->above ? bytes_mark_zero_bytes(word ^ bytes_load_word(at - d->stride)) : 0;
    const uint64_t three = (run & run >> 8 & run >> 16) | (above & above >> 8 & above >> 16);
    const size_t count = bytes_count_zeros_at_start(three | UINT64_C(0x80) << (8 * DEFLATE_GROUP)),
                 left = d->end - d->at;
    return count < left ? count : left;
}

typedef struct repeat {
    size_t length, distance;
    int64_t gain; /* estimated number of bits that the repeat saves; a repeat is used only if this is positive */
} repeat;

/* Replace *best by the repeat at position `at` with this distance if this repeat saves more bits. `cost` is its
 * estimated size in bits. */
static inline void improve_repeat(const deflater *d, size_t at, size_t distance, int64_t cost, repeat *best)
{
    const uint8_t *bytes = d->window + at;
    const size_t length = bytes_common_prefix_length(bytes, bytes - distance, d->end - at);
    const int64_t gain = (int64_t)length * BYTE_BITS - cost;
    if (gain > best->gain)
        *best = (repeat){length, distance, gain};
}

/* Find the repeat at position `at` with the largest estimated gain, among runs and repeats of the row above. */
static inline repeat find_index_repeat(const deflater *d, size_t at)
{
    repeat best = {.gain = 0};
    if (d->above)
        improve_repeat(d, at, d->stride, ABOVE_BITS, &best);
    if (best.length < LONG_REPEAT)
        improve_repeat(d, at, 1, RUN_BITS, &best);
    return best;
}

/* Encode palette indices: the next literals or the next repeat. */
static void encode_next_indices(deflater *d)
{
    const size_t count = count_literals(d);
    add_literals(d, count);
    if (count == DEFLATE_GROUP || d->at == d->end)
        return;
    repeat found = find_index_repeat(d, d->at);
    if (found.gain > 0 && found.length < LONG_REPEAT && d->at + 1 < d->end) {
        const repeat next = find_index_repeat(d, d->at + 1);
        if (next.gain > found.gain) {
            add_literals(d, 1);
            found = next;
        }
    }
    if (found.gain > 0)
        add_repeat(d, found.length, found.distance);
    else
        add_literals(d, 1);
}

/* Returns whether the next `size` bytes, at most WORD, equal the bytes at a distance. */
static inline bool repeats_bytes(const uint8_t *at, size_t distance, size_t size)
{
    return (bytes_load_word(at) ^ bytes_load_word(at - distance)) << (8 * (WORD - size)) == 0;
}

/* Returns the distance to the last position that had the same hash of the next two pixels, and records the position
 * `at`. Without such a position, returns a distance beyond deflate's largest, because the window keeps more bytes. */
static inline size_t find_last_distance(deflater *d, size_t at)
{
    const uint64_t two = bytes_load_word(d->window + at) << (8 * (WORD - 2 * RGB));
    uint32_t *head = &d->heads[two * UINT64_C(0x9e3779b97f4a7c15) >> (64 - HASH_BITS)];
    const size_t distance = at - *head;
    *head = (uint32_t)at;
    return distance;
}

/* Find the repeat at the next pixel with the largest estimated gain. */
static inline repeat find_pixel_repeat(deflater *d)
{
    const uint8_t *bytes = d->window + d->at;
    const size_t distance = find_last_distance(d, d->at);
    const bool run = repeats_bytes(bytes, RGB, RGB), above = d->above & repeats_bytes(bytes, d->stride, 2 * RGB),
               far = (distance <= DEFLATE_FARTHEST) & repeats_bytes(bytes, distance, 2 * RGB);
    repeat best = {.gain = 0};
    if (!(run | above | far))
        return best;
    if (above)
        improve_repeat(d, d->at, d->stride, ABOVE_BITS, &best);
    if (run)
        improve_repeat(d, d->at, RGB, RUN_BITS, &best);
    if (far && best.length < LONG_REPEAT)
        improve_repeat(d, d->at, distance, FAR_BITS, &best);
    return best;
}

static void end_block_if_full(deflater *d)
{
    if (deflate_is_block_full(&d->blocks))
        end_block(d, false);
}

static void encode_indices(deflater *d)
{
    while (d->at < d->end) {
        encode_next_indices(d);
        end_block_if_full(d);
    }
}

static void add_pixel(deflater *d)
{
    deflate_add_pixel(&d->blocks, d->window + d->at);
    d->at += RGB;
}

static void encode_pixels(deflater *d)
{
    size_t misses = 0; /* number of searches since the last repeat */
    for (size_t left; (left = d->end - d->at) > 0; end_block_if_full(d)) {
        const repeat found = find_pixel_repeat(d);
        if (found.gain > 0) {
            add_repeat(d, found.length, found.distance);
            misses = 0;
        } else if (left < 2 * RGB) {
            add_literals(d, left);
        } else {
            add_pixel(d);
            if (misses++ >= PATIENCE)
                add_pixel(d);
        }
    }
}

static void encode_window(deflater *d)
{
    (d->pixel == 1 ? encode_indices : encode_pixels)(d);
    add_changes(d, d->at);
}

/* ---- The window ---------------------------------------------------------------------------------------------- */

/* Move the last `kept` bytes to the window's beginning. */
static void slide_window(deflater *d)
{
    if (d->end <= d->kept)
        return;
    const size_t by = d->end - d->kept;
    memmove(d->window, d->window + by, d->kept);
    d->block_whole = d->block_whole && d->block >= by;
    d->block -= by; /* The index may wrap around below 0. From then on, only its difference from `at` is used. */
    d->row -= by;
    d->at -= by;
    d->unsummed -= by;
    d->end -= by;
    for (size_t i = 0; d->pixel > 1 && i < 1 << HASH_BITS; i++)
        d->heads[i] = d->heads[i] > by ? d->heads[i] - (uint32_t)by : 0;
}

/* Sample a row to choose the filter of the next rows. Only pixels that differ from the pixel before count, because runs
 * take few bits with any filter. Bytes that are distributed less evenly take fewer bits; the number of pairs of equal
 * bytes measures this without logarithms. The filter changes if the other one has clearly more pairs, because a row
 * seldom repeats a row above that has another filter. */
static void sample_row(deflater *d, const uint8_t *pixels)
{
    for (size_t x = RGB * (1 + d->sampled % SAMPLED); x < d->stride - 1; x += RGB * SAMPLED) {
        const uint8_t *at = pixels + x, *before = at - RGB;
        if (at[0] == before[0] && at[1] == before[1] && at[2] == before[2])
            continue;
        for (size_t i = 0; i < RGB; i++) {
            d->pairs[0] += d->seen[0][at[i]]++;
            d->pairs[1] += d->seen[1][(uint8_t)(at[i] - before[i])]++;
        }
        d->sampled += RGB;
    }
    if (d->sampled < SAMPLE)
        return;
    d->filtered = 4 * d->pairs[1] > (d->filtered ? 3 : 5) * d->pairs[0];
    memset(d->seen, 0, sizeof d->seen);
    d->pairs[0] = d->pairs[1] = d->sampled = 0;
}

/* Store the row's bytes minus the bytes one pixel before. */
static void filter_row(uint8_t *restrict to, const uint8_t *restrict pixels, size_t size)
{
    memcpy(to, pixels, RGB);
    for (size_t i = RGB; i < size; i++)
        to[i] = (uint8_t)(pixels[i] - pixels[i - RGB]);
}

void deflater_add_row(deflater *d, const uint8_t *pixels)
{
    if (d->end + d->stride > d->room) {
        encode_window(d);
        slide_window(d);
    }
    if (d->pixel > 1)
        sample_row(d, pixels);
    d->window[d->end] = d->filtered;
    if (d->filtered)
        filter_row(d->window + d->end + 1, pixels, d->stride - 1);
    else
        memcpy(d->window + d->end + 1, pixels, d->stride - 1);
    d->end += d->stride;
    if (d->begun)
        return;
    add_literals(d, d->pixel); /* the first pixel has no pixel before it to repeat, so its bytes are literals */
    encode_window(d);
    d->begun = true;
    d->above = d->stride <= DEFLATE_FARTHEST;
}

deflater *deflater_open(size_t row_size, size_t rows, size_t pixel, deflate_sink *sink, void *context)
{
    deflater *d = calloc(1, sizeof *d);
    const size_t kept = row_size + (pixel > 1 ? DEFLATE_FARTHEST : 0),
                 room = kept + (pixel > 1 ? RGB_CHUNK : CHUNK) + row_size;
    uint8_t *window = d ? calloc(room + WORD, 1) : NULL;
    if (!window) {
        free(d);
        return NULL;
    }
    d->window = window;
    d->stride = row_size;
    d->rows = d->rows_left = rows;
    d->pixel = pixel;
    d->kept = kept;
    d->room = room;
    d->end = d->at = d->block = d->unsummed = d->row = kept;
    d->block_whole = true;
    deflate_begin_blocks(&d->blocks, pixel > 1 ? BLOCK_TOKENS : INDEXED_BLOCK_TOKENS, sink, context);
    /* header of the zlib stream: 32 KiB window, fastest level */
    deflate_write_bytes(&d->blocks, (const uint8_t[]){0x78, 0x01}, 2);
    return d;
}

void deflater_close(deflater *d)
{
    if (d)
        free(d->window);
    free(d);
}

void deflater_finish(deflater *d)
{
    encode_window(d);
    end_block(d, true);
    const uint32_t sum = compute_final_adler32(d);
    const uint8_t bytes[] = {(uint8_t)(sum >> 24), (uint8_t)(sum >> 16), (uint8_t)(sum >> 8), (uint8_t)sum};
    deflate_write_bytes(&d->blocks, bytes, sizeof bytes);
    deflate_flush_output(&d->blocks);
}
