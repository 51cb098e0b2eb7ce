/* SPDX-License-Identifier: MIT */
/* image_digest.c - digests of a picture's colours, by two algorithms.
 *
 * A digest must not depend on the palette, on the number of rows that are decoded at a time, or on the machine. It
 * should cost far less than drawing the frame. Hashing every pixel in order is slow and serial. Two observations help:
 * a drawn frame is mostly background, and most of a row equals the row above.
 *
 * "runs", the older algorithm, hashes the length and colour of each run of equal pixels in reading order.
 *
 * "rows" cuts each row into groups of 8 pixels. Each pixel has a hash of its place in the group and its colour. The
 * group's number is a hash of two values: the sum of its pixels' hashes, and the group's place in the row. A row's
 * number is the sum of the numbers of its groups. The digest hashes the numbers of all rows in order.
 *
 * Such sums can be updated from row to row. A group that equals the group above it has the same number and is skipped.
 * For a changed group, its new number replaces the old number in the row's sum. For indexed images, the pixel hashes
 * come from a table of 8 * 256 entries.
 *
 * Cost of "rows": one comparison per 64 pixels that repeat the row above, and 8 table look-ups per changed group. */
#include "image_digest.h"
#include "bytes.h"
#include "octree/digest.h"
#include "png_read.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Names and texts ----------------------------------------------------------------------------------------- */

static const char *const kind_names[] = {
#define KIND_NAME(kind, name) name,
    IMAGE_DIGEST_MAP(KIND_NAME)
#undef KIND_NAME
};

const char *image_digest_kind_name(image_digest_kind kind)
{
    return kind_names[kind];
}

image_digest_kind image_find_digest_kind(const char *name, size_t length)
{
    int kind = 0;
    while (kind < IMAGE_DIGEST_KINDS && (strlen(kind_names[kind]) != length || memcmp(kind_names[kind], name, length)))
        kind++;
    return (image_digest_kind)kind;
}

enum { DIGITS = 16 };

char *image_digest_print(image_digest_kind kind, uint64_t digest, char text[IMAGE_DIGEST_TEXT])
{
    const bool bare = kind == IMAGE_DIGEST_RUNS;
    snprintf(text, IMAGE_DIGEST_TEXT, "%s%s%016" PRIx64, bare ? "" : kind_names[kind], bare ? "" : "-", digest);
    return text;
}

bool image_digest_parse(const char *text, image_digest_kind *kind, uint64_t *digest)
{
    const size_t name = strcspn(text, "-");
    const bool bare = text[name] == 0;
    const char *digits = bare ? text : text + name + 1;
    const image_digest_kind named = bare ? IMAGE_DIGEST_RUNS : image_find_digest_kind(text, name);
    if (named == IMAGE_DIGEST_KINDS || bare != (named == IMAGE_DIGEST_RUNS) ||
        strspn(digits, "0123456789abcdef") != DIGITS || digits[DIGITS] != 0)
        return false;
    *kind = named;
    *digest = strtoull(digits, NULL, 16);
    return true;
}

/* ---- Runs ---------------------------------------------------------------------------------------------------- */

enum { GROUP = 8 };

/* The state of a digest after some of the picture's rows were added. */
typedef struct digest_state {
    image_digest_kind kind;
    uint64_t digest;
    bool wide;
    uint64_t color;                /* algorithm "runs": the colour of the current run */
    size_t length;                 /* algorithm "runs": the number of pixels of the current run so far */
    uint64_t of_index[GROUP][256]; /* algorithm "rows": the hash of each palette index at each place of a group */
} digest_state;

static uint64_t pack_color(image_color color)
{
    return (uint64_t)color.r << 16 | (uint64_t)color.g << 8 | color.b;
}

/* Returns the colour of a pixel as one word, with 8 or 16 bits per sample. */
static uint64_t pixel_color_word(const image *image, const uint8_t *at)
{
    if (image->wide) {
        uint16_t samples[3];
        memcpy(samples, at, sizeof samples);
        return (uint64_t)samples[0] << 32 | (uint64_t)samples[1] << 16 | samples[2];
    }
    return pack_color(image->channels == 1 ? image->palette.colors[*at] : (image_color){at[0], at[1], at[2]});
}

/* Returns the end of the run of pixels that equal the pixel `start`. Within a run, each byte equals the byte one pixel
 * before it. */
static size_t find_run_end(const image *image, size_t start, size_t pixel_count)
{
    const size_t step = image_pixel_size(image);
    const uint8_t *first = image->pixels + start * step;
    const size_t rest = (pixel_count - start - 1) * step;
    return start + 1 + bytes_common_prefix_length(first + step, first, rest) / step;
}

static uint64_t digest_run(uint64_t digest, size_t length, uint64_t color, bool wide)
{
    if (length == 0)
        return digest;
    if (wide)
        return octree_digest_word(octree_digest_word(digest, (uint64_t)length), color);
    return octree_digest_word(digest, (uint64_t)length << 24 | color);
}

/* Hash the runs of a band. Runs of different palette indices with the same colour are joined, and a run may continue in
 * the next band. So the digest depends neither on the palette nor on the height of bands. */
static void digest_runs(digest_state *d, const image *rows)
{
    const size_t pixel_count = (size_t)rows->width * (size_t)rows->height;
    for (size_t at = 0, end; at < pixel_count; at = end) {
        end = find_run_end(rows, at, pixel_count);
        const uint64_t next = pixel_color_word(rows, rows->pixels + at * image_pixel_size(rows));
        if (next != d->color) {
            d->digest = digest_run(d->digest, d->length, d->color, d->wide);
            d->color = next;
            d->length = 0;
        }
        d->length += end - at;
    }
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

/* Returns the hash of a colour at one place of a group. */
static inline uint64_t hash_color_at(size_t place, uint64_t color, bool wide)
{
    return octree_digest_word(~(uint64_t)place, color | (uint64_t)wide << 48);
}

/* Returns the sum of the pixel hashes of a group of `count` pixels, at most GROUP; the last group of a row may be
 * shorter. */
static uint64_t sum_group_hashes(const digest_state *d, const image *rows, const uint8_t *pixels, size_t count)
{
    const size_t step = image_pixel_size(rows);
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += rows->channels == 1 ? d->of_index[i][pixels[i]]
                                   : hash_color_at(i, pixel_color_word(rows, pixels + i * step), rows->wide);
    return sum;
}

/* Returns the result of sum_group_hashes() for GROUP palette indices, which are the bytes of a word. */
static inline uint64_t sum_index_hashes(const digest_state *d, uint64_t word)
{
    return d->of_index[0][word & 255] + d->of_index[1][word >> 8 & 255] + d->of_index[2][word >> 16 & 255] +
           d->of_index[3][word >> 24 & 255] + d->of_index[4][word >> 32 & 255] + d->of_index[5][word >> 40 & 255] +
           d->of_index[6][word >> 48 & 255] + d->of_index[7][word >> 56];
}

/* The numbers of the groups of the current row, and the sum of these numbers. */
typedef struct row_groups {
    uint64_t sum, of_group[IMAGE_MAX_SIDE / GROUP];
} row_groups;

static inline void set_group_number(row_groups *g, size_t group, uint64_t sum)
{
    const uint64_t digest = octree_digest_word((uint64_t)group, sum);
    g->sum += digest - g->of_group[group];
    g->of_group[group] = digest;
}

enum { BLOCK = 8 }; /* the number of groups that are compared together with the groups above them */

static inline bool is_block_changed(const uint8_t *row, const uint8_t *above)
{
    uint64_t differ = 0;
    for (int i = 0; i < BLOCK; i++)
        differ |= bytes_load_word(row + GROUP * i) ^ bytes_load_word(above + GROUP * i);
    return differ != 0;
}

/* List the groups that differ from the groups above them, and return their number. Blocks of BLOCK groups that all
 * equal the row above are skipped. In other blocks the groups are listed without a branch, because a processor cannot
 * predict which groups differ. */
static size_t list_changed_groups(uint16_t *changed, const uint8_t *row, const uint8_t *above, size_t groups)
{
    size_t count = 0;
    for (size_t i = 0; i < groups; i += BLOCK) {
        const size_t end = i + BLOCK < groups ? i + BLOCK : groups;
        if (end == i + BLOCK && !is_block_changed(row + GROUP * i, above + GROUP * i))
            continue;
        for (size_t k = i; k < end; k++) {
            changed[count] = (uint16_t)k;
            count += bytes_load_word(row + GROUP * k) != bytes_load_word(above + GROUP * k);
        }
    }
    return count;
}

/* Update the numbers of the first `groups` groups of a row of palette indices. `above` is the row above, null for the
 * first row. */
static void update_index_groups(const digest_state *d, row_groups *g, const uint8_t *row, const uint8_t *above,
                                size_t groups)
{
    uint16_t changed[IMAGE_MAX_SIDE / GROUP];
    const size_t count = above ? list_changed_groups(changed, row, above, groups) : groups;
    for (size_t n = 0; n < count; n++) {
        const size_t i = above ? changed[n] : n;
        set_group_number(g, i, sum_index_hashes(d, bytes_load_word(row + GROUP * i)));
    }
}

static void digest_rows(digest_state *d, const image *rows)
{
    const size_t step = image_pixel_size(rows), width = (size_t)rows->width, size = width * step;
    const size_t whole = rows->channels == 1 ? width / GROUP : 0, groups = (width + GROUP - 1) / GROUP;
    row_groups g;
    g.sum = 0;
    memset(g.of_group, 0, groups * sizeof *g.of_group);
    for (int y = 0; y < rows->height; y++) {
        const uint8_t *row = rows->pixels + (size_t)y * size, *above = y > 0 ? row - size : NULL;
        update_index_groups(d, &g, row, above, whole);
        for (size_t i = whole; i < groups; i++) {
            const size_t at = i * GROUP * step, count = width - i * GROUP < GROUP ? width - i * GROUP : GROUP;
            if (!above || memcmp(row + at, above + at, count * step) != 0)
                set_group_number(&g, i, sum_group_hashes(d, rows, row + at, count));
        }
        d->digest = octree_digest_word(d->digest, g.sum);
    }
}

/* ---- A picture ------------------------------------------------------------------------------------------------ */

static void init_digest(digest_state *d, image_digest_kind kind, const image *about)
{
    d->kind = kind;
    d->digest =
        octree_digest_word(octree_digest_word(OCTREE_DIGEST_START, (uint64_t)about->width), (uint64_t)about->height);
    d->wide = about->wide;
    d->color = 0;
    d->length = 0;
    for (size_t place = 0; kind == IMAGE_DIGEST_ROWS && about->channels == 1 && place < GROUP; place++)
        for (int i = 0; i < 256; i++)
            d->of_index[place][i] = hash_color_at(place, pack_color(about->palette.colors[i]), false);
}

static void digest_band(digest_state *d, const image *rows)
{
    if (d->kind == IMAGE_DIGEST_RUNS)
        digest_runs(d, rows);
    else
        digest_rows(d, rows);
}

static uint64_t finish_digest(const digest_state *d)
{
    return d->kind == IMAGE_DIGEST_RUNS ? digest_run(d->digest, d->length, d->color, d->wide) : d->digest;
}

uint64_t image_digest_with(image_digest_kind kind, const image *image)
{
    digest_state d;
    init_digest(&d, kind, image);
    digest_band(&d, image);
    return finish_digest(&d);
}

uint64_t image_digest(const image *image)
{
    return image_digest_with(IMAGE_DIGEST_NEWEST, image);
}

bool image_digest_png(image_digest_kind kind, const char *path, image_color background, image *about, uint64_t *digest,
                      octreel_error *error)
{
    image_source *source = image_source_open(path, background, false, error);
    if (!source)
        return false;
    *about = *image_source_description(source);
    about->pixels = NULL;
    const int rows = image_find_band_height(about);
    digest_state d;
    init_digest(&d, kind, about);
    for (image band; image_source_read_band(source, rows, &band);)
        digest_band(&d, &band);
    *digest = finish_digest(&d);
    const bool done = !image_source_has_failed(source);
    image_source_close(source);
    return done;
}
