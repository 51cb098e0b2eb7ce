/* SPDX-License-Identifier: MIT */
/* point_block.c - writes and reads the points of a cloud or session as a block of bytes that compresses well.
 *
 * The problem: a page holds a million points as text, and its reader waits for every byte. As doubles, three
 * coordinates and a colour take 27 bytes, and deflate finds almost no repeats in the bytes of doubles.
 *
 * The idea: each number becomes an integer, its code, in an order-preserving way. Few files use all bits of a double:
 * most have decimals of a few digits, or single precision. For each column, the narrowest form is chosen that restores
 * every number bit for bit. Neighbours in a file lie close together, so a code is stored as its difference from the
 * code before it, unless codes without differences are shorter. The lowest bytes of all codes of a column follow each
 * other, then their next bytes, and so on: the high bytes are nearly constant and take almost no space after
 * compression.
 *
 * Layout, in little-endian order: "octreel points 1\n", the count of points, the address of the marked node, the kinds
 * of values with the bit MOVING, the size of the title, each in 8 bytes; the title; then the columns in the order of
 * column_name. A column begins with one byte each for form, digits, is-difference and width, and with the smallest code
 * in 8 bytes; then `width` planes of one byte for each point. Cost: O(points). */
#include "point_block.h"
#include "text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char beginning[] = "octreel points 1\n";
enum { BEGINNING = sizeof beginning - 1 };

typedef enum column_name {
    COLUMN_ID,
    COLUMN_X,
    COLUMN_Y,
    COLUMN_Z,
    COLUMN_VX, /* the velocity; this and the next two columns are present only if points move */
    COLUMN_VY,
    COLUMN_VZ,
    COLUMN_HAS, /* the kinds of values that the point has, as bits; this and the next columns are present only if there
                 * are values */
    COLUMN_RED, /* red - green: the channels of most colours are alike, so differences need fewer bits */
    COLUMN_GREEN,
    COLUMN_BLUE, /* blue - green */
    COLUMN_INTENSITY,
    COLUMN_CLASS,
    COLUMNS
} column_name;

/* A bit in the head of a block: the points have velocities. */
#define MOVING (1u << POINT_VALUE_KINDS)

static bool has_column(const point_block *b, column_name column)
{
    return column < COLUMN_VX || (column < COLUMN_HAS ? b->moving : b->values.kinds != 0);
}

/* ---- The code of a number -------------------------------------------------------------------------------------- */

typedef enum form_kind {
    FORM_QUOTIENT, /* the code is an integer k, the number is k / 10^digits, as in a text with `digits` decimals */
    FORM_PRODUCT,  /* the number is k * 10^-digits, as in LAS files without an offset */
    FORM_SHORT,    /* the number is k / 10^digits, rounded to single precision */
    FORM_SINGLE,   /* the code is the bits of the number in single precision */
    FORM_DOUBLE,   /* the code is all 64 bits of the number */
    FORM_WHOLE,    /* the number is an integer and its own code */
    FORMS
} form_kind;

typedef struct number_form {
    unsigned char kind, digits;
} number_form;

enum { MOST_DIGITS = 9 };

static const double powers[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
static const double fractions[] = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};

#define SIGN (UINT64_C(1) << 63)

/* Returns the code of a double: its bits, changed so that a larger number has a larger code. */
static uint64_t encode_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits & SIGN ? ~bits : bits | SIGN;
}

static double decode_double(uint64_t code)
{
    const uint64_t bits = code & SIGN ? code ^ SIGN : ~code;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t encode_single(double number)
{
    const float value = (float)number;
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 31 ? ~bits : bits | UINT32_C(1) << 31;
}

static double decode_single(uint64_t code)
{
    const uint32_t bits = code >> 31 & 1 ? (uint32_t)code ^ UINT32_C(1) << 31 : ~(uint32_t)code;
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* Returns the code of an integer, which must have less than 54 bits. Other numbers get the code of 0. */
static uint64_t encode_integer(double value)
{
    const double rounded = floor(value + 0.5);
    return SIGN ^ (uint64_t)(fabs(rounded) < 0x1p53 ? (int64_t)rounded : 0);
}

static uint64_t encode_number(number_form form, double value)
{
    switch ((form_kind)form.kind) {
    case FORM_SINGLE:
        return encode_single(value);
    case FORM_DOUBLE:
        return encode_double(value);
    default:
        return encode_integer(value * powers[form.digits]);
    }
}

static double decode_number(number_form form, uint64_t code)
{
    const double integer = (double)(int64_t)(code ^ SIGN);
    switch ((form_kind)form.kind) {
    case FORM_QUOTIENT:
        return integer / powers[form.digits];
    case FORM_PRODUCT:
        return integer * fractions[form.digits];
    case FORM_SHORT:
        return (double)(float)(integer / powers[form.digits]);
    case FORM_SINGLE:
        return decode_single(code);
    default:
        return decode_double(code);
    }
}

static double number_at(const point_block *b, column_name column, size_t i)
{
    const octree_game_body *body = &b->bodies[i];
    return column == COLUMN_INTENSITY ? (double)point_values_get(&b->values, body->id).intensity
           : column >= COLUMN_VX      ? body->velocity[column - COLUMN_VX]
                                      : body->position[column - COLUMN_X];
}

/* Returns whether every number of a column keeps all its bits, also the sign of -0, if it is encoded in this form and
 * decoded again. */
static bool is_form_exact(const point_block *b, column_name column, number_form form)
{
    for (size_t i = 0; i < b->count; i++) {
        const double value = number_at(b, column, i);
        if (encode_double(decode_number(form, encode_number(form, value))) != encode_double(value))
            return false;
    }
    return true;
}

static bool is_number_column(column_name column)
{
    return (column >= COLUMN_X && column <= COLUMN_VZ) || column == COLUMN_INTENSITY;
}

static number_form find_narrowest_form(const point_block *b, column_name column)
{
    if (!is_number_column(column))
        return (number_form){FORM_WHOLE, 0};
    for (unsigned char digits = 0; digits <= MOST_DIGITS; digits++)
        for (unsigned char kind = FORM_QUOTIENT; kind <= FORM_SHORT; kind++)
            if (is_form_exact(b, column, (number_form){kind, digits}))
                return (number_form){kind, digits};
    const number_form single = {FORM_SINGLE, 0};
    return is_form_exact(b, column, single) ? single : (number_form){FORM_DOUBLE, 0};
}

static uint64_t code_at(const point_block *b, column_name column, number_form form, size_t i)
{
    if (is_number_column(column))
        return encode_number(form, number_at(b, column, i));
    if (column == COLUMN_ID)
        return b->bodies[i].id;
    const point_value value = point_values_get(&b->values, b->bodies[i].id);
    unsigned has = 0;
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
        has |= (unsigned)value.has[kind] << kind;
    return column == COLUMN_HAS     ? has
           : column == COLUMN_CLASS ? value.class
           : column == COLUMN_GREEN ? value.color[1]
                                    : (unsigned char)(value.color[column - COLUMN_RED] - value.color[1]);
}

/* ---- Writing --------------------------------------------------------------------------------------------------- */

static void write_uint64(FILE *out, uint64_t value)
{
    for (int i = 0; i < 8; i++)
        putc((int)(value >> 8 * i & 255), out);
}

/* Differences of both signs become small integers: 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4. */
static uint64_t fold_difference(uint64_t difference)
{
    return difference << 1 ^ (difference & SIGN ? UINT64_MAX : 0);
}

static uint64_t unfold_difference(uint64_t folded)
{
    return folded >> 1 ^ (folded & 1 ? UINT64_MAX : 0);
}

static unsigned count_bits(uint64_t value)
{
    unsigned bits = 0;
    for (; value > 255; value >>= 8)
        bits += 8;
    for (; value; value >>= 1)
        bits++;
    return bits;
}

static uint64_t find_smallest(const uint64_t *codes, size_t count)
{
    uint64_t smallest = UINT64_MAX;
    for (size_t i = 0; i < count; i++)
        smallest = codes[i] < smallest ? codes[i] : smallest;
    return smallest;
}

/* Returns whether the differences between successive codes take fewer bits than the differences from `base`. */
static bool are_differences_shorter(const uint64_t *codes, size_t count, uint64_t base)
{
    uint64_t bits = 0, bits_of_differences = 0, last = base;
    for (size_t i = 0; i < count; last = codes[i++]) {
        bits += count_bits(codes[i] - base);
        bits_of_differences += count_bits(fold_difference(codes[i] - last));
    }
    return bits_of_differences < bits;
}

/* Replace each code by the integer that is stored: the folded difference from the previous code, or the difference from
 * `base`. Returns the number of bytes of the largest integer. */
static unsigned convert_to_stored_integers(uint64_t *codes, size_t count, uint64_t base, bool by_differences)
{
    uint64_t last = base, all = 0;
    for (size_t i = 0; i < count; i++) {
        const uint64_t code = codes[i];
        codes[i] = by_differences ? fold_difference(code - last) : code - base;
        all |= codes[i];
        last = code;
    }
    return (count_bits(all) + 7) / 8;
}

static void write_column(const point_block *b, column_name column, uint64_t *codes, char *plane, FILE *out)
{
    const number_form form = find_narrowest_form(b, column);
    for (size_t i = 0; i < b->count; i++)
        codes[i] = code_at(b, column, form, i);
    const uint64_t base = find_smallest(codes, b->count);
    const bool by_differences = are_differences_shorter(codes, b->count, base);
    const unsigned width = convert_to_stored_integers(codes, b->count, base, by_differences);
    const unsigned char head[] = {form.kind, form.digits, by_differences, (unsigned char)width};
    fwrite(head, 1, sizeof head, out);
    write_uint64(out, base);
    for (unsigned byte = 0; byte < width; byte++) {
        for (size_t i = 0; i < b->count; i++)
            plane[i] = (char)(codes[i] >> 8 * byte);
        fwrite(plane, 1, b->count, out);
    }
}

bool point_block_write(const point_block *b, FILE *out)
{
    const size_t length = strlen(b->title), room = b->count > 0 ? b->count : 1;
    const uint64_t head[] = {b->count, b->node, b->values.kinds | (b->moving ? MOVING : 0), length};
    uint64_t *codes = malloc(room * sizeof *codes);
    char *plane = malloc(room);
    const bool ok = codes && plane;
    fwrite(beginning, 1, BEGINNING, out);
    for (size_t i = 0; i < sizeof head / sizeof head[0]; i++)
        write_uint64(out, head[i]);
    fwrite(b->title, 1, length, out);
    for (unsigned column = 0; ok && column < COLUMNS; column++)
        if (has_column(b, (column_name)column))
            write_column(b, (column_name)column, codes, plane, out);
    free(codes);
    free(plane);
    return ok;
}

/* ---- Reading --------------------------------------------------------------------------------------------------- */

/* The rest of a block that is being read. */
typedef struct block_reader {
    const char *at;
    size_t left;
} block_reader;

/* Returns the next bytes, or null if there are too few. */
static const unsigned char *read_bytes(block_reader *r, size_t size)
{
    const char *at = r->at;
    if (size > r->left)
        return NULL;
    r->at += size;
    r->left -= size;
    return (const unsigned char *)at;
}

static bool read_uint64(block_reader *r, uint64_t *value)
{
    const unsigned char *bytes = read_bytes(r, 8);
    *value = 0;
    for (int i = 0; bytes && i < 8; i++)
        *value |= (uint64_t)bytes[i] << 8 * i;
    return bytes != NULL;
}

static bool read_head(block_reader *r, point_block *b)
{
    uint64_t count, kinds, length;
    const unsigned char *begins = read_bytes(r, BEGINNING), *title;
    if (!begins || memcmp(begins, beginning, BEGINNING) != 0 || !read_uint64(r, &count) || !read_uint64(r, &b->node) ||
        !read_uint64(r, &kinds) || !read_uint64(r, &length) || count > POINT_BLOCK_MOST || kinds >= 2 * MOVING ||
        length >= sizeof b->title)
        return false;
    title = read_bytes(r, (size_t)length);
    if (title)
        memcpy(b->title, title, (size_t)length);
    b->count = (size_t)count;
    b->values.kinds = (unsigned)kinds & (MOVING - 1);
    b->moving = kinds & MOVING;
    return title != NULL;
}

static void set_value_by_code(point_block *b, column_name column, number_form form, size_t i, uint64_t code)
{
    point_value *value = b->values.rows ? b->values.rows + i : NULL;
    if (column == COLUMN_ID)
        b->bodies[i].id = code;
    else if (column <= COLUMN_Z)
        b->bodies[i].position[column - COLUMN_X] = decode_number(form, code);
    else if (column <= COLUMN_VZ)
        b->bodies[i].velocity[column - COLUMN_VX] = decode_number(form, code);
    else if (column == COLUMN_INTENSITY)
        value->intensity = (float)decode_number(form, code);
    else if (column == COLUMN_CLASS)
        value->class = (uint16_t)code;
    else if (column == COLUMN_HAS)
        for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
            value->has[kind] = code >> kind & 1;
    else
        value->color[column - COLUMN_RED] = (unsigned char)code;
}

static bool read_column(block_reader *r, point_block *b, column_name column, uint64_t *codes)
{
    uint64_t base, last;
    const unsigned char *head = read_bytes(r, 4);
    if (!head || head[0] >= FORMS || (head[0] == FORM_WHOLE) == is_number_column(column) || head[1] > MOST_DIGITS ||
        head[3] > 8 || !read_uint64(r, &base))
        return false;
    memset(codes, 0, b->count * sizeof *codes);
    for (unsigned byte = 0; byte < head[3]; byte++) {
        const unsigned char *plane = read_bytes(r, b->count);
        for (size_t i = 0; plane && i < b->count; i++)
            codes[i] |= (uint64_t)plane[i] << 8 * byte;
        if (!plane)
            return false;
    }
    last = base;
    for (size_t i = 0; i < b->count; i++) {
        last = head[2] ? last + unfold_difference(codes[i]) : base + codes[i];
        set_value_by_code(b, column, (number_form){head[0], head[1]}, i, last);
    }
    return true;
}

/* Add green to red and blue, and store the ids in the table of values. If the ids are consecutive, the table needs only
 * the first. Returns false if memory runs out. */
static bool restore_colors_and_ids(point_block *b)
{
    point_values *v = &b->values;
    bool consecutive = true;
    for (size_t i = 0; i < b->count; i++) {
        v->rows[i].color[0] = (unsigned char)(v->rows[i].color[0] + v->rows[i].color[1]);
        v->rows[i].color[2] = (unsigned char)(v->rows[i].color[2] + v->rows[i].color[1]);
        consecutive &= b->bodies[i].id == b->bodies[0].id + i;
    }
    v->count = v->room = b->count;
    v->first = b->count > 0 ? b->bodies[0].id : 0;
    if (consecutive)
        return true;
    v->ids = malloc(b->count * sizeof *v->ids);
    for (size_t i = 0; v->ids && i < b->count; i++)
        v->ids[i] = b->bodies[i].id;
    v->id_room = v->ids ? b->count : 0;
    return v->ids != NULL;
}

static bool are_ids_ascending(const point_block *b)
{
    for (size_t i = 1; i < b->count; i++)
        if (b->bodies[i].id <= b->bodies[i - 1].id)
            return false;
    return true;
}

static bool read_columns(block_reader *r, point_block *b, octreel_error *error)
{
    const size_t room = b->count > 0 ? b->count : 1;
    uint64_t *codes = malloc(room * sizeof *codes);
    b->bodies = calloc(room, sizeof *b->bodies);
    b->values.rows = b->values.kinds ? calloc(room, sizeof *b->values.rows) : NULL;
    const bool has_memory = codes && b->bodies && (b->values.rows || !b->values.kinds);
    bool ok = has_memory;
    for (unsigned column = 0; ok && column < COLUMNS; column++)
        ok = !has_column(b, (column_name)column) || read_column(r, b, (column_name)column, codes);
    free(codes);
    if (!has_memory || (ok && b->values.kinds && !restore_colors_and_ids(b)))
        return error_set(error, "out of memory for %zu points", b->count);
    return (ok && r->left == 0 && are_ids_ascending(b)) ||
           error_set(error, "the points in this page are cut off or damaged; make the page again");
}

bool point_block_read(const char *bytes, size_t size, point_block *b, octreel_error *error)
{
    block_reader r = {bytes, size};
    *b = (point_block){0};
    const bool ok =
        (read_head(&r, b) || error_set(error, "the points in this page are cut off or damaged; make the page again")) &&
        read_columns(&r, b, error);
    if (!ok)
        point_block_release(b);
    return ok;
}

void point_block_release(point_block *b)
{
    free(b->bodies);
    point_values_release(&b->values);
    *b = (point_block){0};
}
