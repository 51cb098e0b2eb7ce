/* SPDX-License-Identifier: MIT */
/* cloud_pcd.c - reads the points of a PCD file, version 0.5 to 0.7. PCD is the format of the Point Cloud Library (PCL).
 *
 * A text header lists the fields of a point, each with a size, a type and a count. The data that follow are text lines,
 * packed points, or compressed points. Compressed data (LZF) are stored field by field: all values of the first field,
 * then all of the second, and so on. The same loop, add_points(), reads packed and decompressed data, with different
 * offsets and strides.
 */
#include "cloud_format.h"
#include "number.h"

#include <inttypes.h>
#include <lzf.h>
#include <stdlib.h>

enum {
    MAX_FIELDS = 1024,
    LZF_RATIO = 88, /* the highest compression ratio of LZF: 3 bytes encode a match of at most 264 bytes */
};

typedef enum pcd_encoding { PCD_ASCII, PCD_BINARY, PCD_COMPRESSED } pcd_encoding;

typedef struct pcd_field {
    cloud_scalar type;
    uint64_t count; /* the number of values that each point has in this field */
    cloud_span name;
    int channel;             /* the cloud_channel that the field's name stands for; -1: the field is ignored */
    uint64_t column, offset; /* the number of values, and the number of bytes, that precede the field in a point */
} pcd_field;

typedef struct pcd_reader {
    cloud_file *file;
    unsigned seen; /* bit i is set after the header line of keyword i was read */
    size_t field_count;
    /* the fields of the header; later only the fields to read, at most one for each channel */
    pcd_field fields[MAX_FIELDS];
    uint64_t width, height, points;
    pcd_encoding encoding;
    uint64_t columns, stride; /* the number of values, and the number of bytes, of a point */
} pcd_reader;

/* ---- Header lines ------------------------------------------------------------------------------------------- */

static bool read_version(pcd_reader *reader, cloud_span rest)
{
    cloud_span word;
    const char *end;
    double version;
    cloud_read_word(&rest, &word);
    bool known =
        number_parse(word.begin, word.limit, &end, &version) && end == word.limit && version >= 0.5 && version <= 0.7;
    return known ||
           cloud_fail_at_word(reader->file, word, "is not a supported version of PCD; versions 0.5 to 0.7 are");
}

static bool read_fields(pcd_reader *reader, cloud_span rest)
{
    cloud_span word;
    unsigned axes = 0;
    while (cloud_read_word(&rest, &word)) {
        int channel = cloud_find_channel(word);
        if (reader->field_count == MAX_FIELDS)
            return cloud_fail_line(reader->file, "more than %d fields", MAX_FIELDS);
        const unsigned axis_bit = channel >= CLOUD_X && channel <= CLOUD_Z ? 1U << channel : 0;
        if (axes & axis_bit)
            return cloud_fail_at_word(reader->file, word, "is already the name of another field");
        axes |= axis_bit;
        reader->fields[reader->field_count++] = (pcd_field){.name = word, .channel = channel, .count = 1};
    }
    for (int axis = 0; axis < 3; axis++)
        if (!(axes >> axis & 1))
            return cloud_fail_line(reader->file, "FIELDS has no field \"%c\"", "xyz"[axis]);
    return true;
}

static bool set_size(pcd_field *field, cloud_span word)
{
    const int power = cloud_find_word_in_list(word, "1 2 4 8");
    field->type.size = power < 0 ? 0 : 1U << power;
    return power >= 0;
}

static bool set_type(pcd_field *field, cloud_span word)
{
    static const cloud_scalar_kind kinds[] = {CLOUD_SIGNED, CLOUD_UNSIGNED, CLOUD_FLOAT};
    const int found = cloud_find_word_in_list(word, "I U F");
    if (found >= 0)
        field->type.kind = kinds[found];
    return found >= 0;
}

/* Set the count of a field. Because of the upper limit, the size of a point cannot overflow: a point has at most
 * MAX_FIELDS fields of 8-byte values. */
static bool set_count(pcd_field *field, cloud_span word)
{
    return cloud_parse_count(word, &field->count) && field->count > 0 && field->count <= UINT32_MAX;
}

/* Read a header line that has one word for each field. */
static bool read_word_per_field(pcd_reader *reader, cloud_span rest, bool (*set)(pcd_field *, cloud_span),
                                const char *reason)
{
    cloud_span word;
    for (size_t i = 0; i < reader->field_count; i++) {
        if (!cloud_read_word(&rest, &word))
            return cloud_fail_line(reader->file, "has %zu values, but FIELDS names %zu fields", i, reader->field_count);
        if (!set(&reader->fields[i], word))
            return cloud_fail_at_word(reader->file, word, reason);
    }
    return !cloud_read_word(&rest, &word) ||
           cloud_fail_at_word(reader->file, word, "is an extra value: the line must have one value for each field");
}

static bool read_header_number(const pcd_reader *reader, cloud_span rest, uint64_t *number)
{
    cloud_span word;
    cloud_read_word(&rest, &word);
    return cloud_parse_count(word, number) || cloud_fail_at_word(reader->file, word, "is not a count of points");
}

static bool read_encoding(pcd_reader *reader, cloud_span rest)
{
    cloud_span word;
    cloud_read_word(&rest, &word);
    const int found = cloud_find_word_in_list(word, "ascii binary binary_compressed");
    reader->encoding = found < 0 ? PCD_ASCII : (pcd_encoding)found;
    return found >= 0 ||
           cloud_fail_at_word(reader->file, word,
                              "is not a kind of PCD data; the kinds are ascii, binary and binary_compressed");
}

typedef enum pcd_key {
    KEY_VERSION,
    KEY_FIELDS,
    KEY_SIZE,
    KEY_TYPE,
    KEY_COUNT,
    KEY_WIDTH,
    KEY_HEIGHT,
    KEY_VIEWPOINT,
    KEY_POINTS,
    KEY_DATA,
    KEYS
} pcd_key;

/* A kind of header line. At most one of the members `read`, `set` and `number` is used. If none is used, the line is
 * skipped. */
typedef struct pcd_keyword {
    const char *name;
    bool required;
    bool (*read)(pcd_reader *reader, cloud_span rest);
    /* for a line with one word for each field: sets a field from its word */
    bool (*set)(pcd_field *field, cloud_span word);
    const char *reason; /* the error if `set` returns false */
    /* for a line with one integer: the offset, in pcd_reader, of the member that stores the integer */
    size_t number;
} pcd_keyword;

static const pcd_keyword keywords[KEYS] = {
    [KEY_VERSION] = {"VERSION", .read = read_version},
    [KEY_FIELDS] = {"FIELDS", true, .read = read_fields},
    [KEY_SIZE] = {"SIZE", true, .set = set_size, .reason = "is not the size of a field; a size is 1, 2, 4 or 8"},
    [KEY_TYPE] = {"TYPE", true, .set = set_type, .reason = "is not the type of a field; a type is I, U or F"},
    [KEY_COUNT] = {"COUNT", .set = set_count, .reason = "is not the count of a field; a count is from 1 to 4294967295"},
    [KEY_WIDTH] = {"WIDTH", .number = offsetof(pcd_reader, width)},
    [KEY_HEIGHT] = {"HEIGHT", .number = offsetof(pcd_reader, height)},
    [KEY_VIEWPOINT] = {"VIEWPOINT", .required = false},
    [KEY_POINTS] = {"POINTS", .number = offsetof(pcd_reader, points)},
    [KEY_DATA] = {"DATA", true, .read = read_encoding},
};

static bool has_read_keyword(const pcd_reader *reader, pcd_key key)
{
    return reader->seen >> key & 1;
}

static bool read_header_line(pcd_reader *reader, cloud_span word, cloud_span rest)
{
    for (int i = 0; i < KEYS; i++) {
        if (!cloud_word_equals(word, keywords[i].name))
            continue;
        if (has_read_keyword(reader, (pcd_key)i))
            return cloud_fail_at_word(reader->file, word, "occurs twice");
        if (keywords[i].set && !has_read_keyword(reader, KEY_FIELDS))
            return cloud_fail_at_word(reader->file, word, "stands before FIELDS; FIELDS must come first");
        reader->seen |= 1U << i;
        if (keywords[i].read)
            return keywords[i].read(reader, rest);
        if (keywords[i].set)
            return read_word_per_field(reader, rest, keywords[i].set, keywords[i].reason);
        return !keywords[i].number ||
               read_header_number(reader, rest, (uint64_t *)((char *)reader + keywords[i].number));
    }
    return cloud_fail_at_word(reader->file, word, "does not belong in a PCD header");
}

/* Read the next header line that is not a comment. Split the line into its first word and the rest. */
static bool read_next_header_line(cloud_file *file, cloud_span *word, cloud_span *rest)
{
    while (cloud_read_nonblank_line(file, rest))
        if (cloud_read_word(rest, word) && *word->begin != '#')
            return true;
    return false;
}

static bool is_pcd(cloud_file *file)
{
    cloud_span word, rest;
    cloud_rewind_lines(file);
    return read_next_header_line(file, &word, &rest) && cloud_find_word_in_list(word, "VERSION FIELDS") >= 0;
}

/* ---- Whole header ------------------------------------------------------------------------------------------- */

/* Find the number of points: WIDTH times HEIGHT, or POINTS. If the header has both, the two numbers must be equal.
 * If HEIGHT is missing, it counts as 1. */
static bool find_point_count(pcd_reader *reader)
{
    if (!has_read_keyword(reader, KEY_WIDTH) && !has_read_keyword(reader, KEY_POINTS))
        return cloud_fail_line(reader->file, "the header has neither WIDTH nor POINTS");
    if (!has_read_keyword(reader, KEY_WIDTH))
        reader->width = reader->points;
    if (!has_read_keyword(reader, KEY_HEIGHT))
        reader->height = 1;
    bool overflows = reader->height > 0 && reader->width > UINT64_MAX / reader->height;
    if (!has_read_keyword(reader, KEY_POINTS) && !overflows)
        reader->points = reader->width * reader->height;
    if (overflows || reader->points != reader->width * reader->height)
        return cloud_fail_line(reader->file, "WIDTH %" PRIu64 " times HEIGHT %" PRIu64 " is not POINTS %" PRIu64,
                               reader->width, reader->height, reader->points);
    return true;
}

/* Compute the offset of each field in a point, and list the fields to read. A coordinate must have a single number.
 * Any other field with several numbers is ignored. A packed colour has four bytes, although many files declare it as
 * a float. Other colours that are declared as floats are assumed to range from 0 to 1. */
static bool set_field_offsets(pcd_reader *reader)
{
    size_t kept = 0;
    unsigned full = 255;
    for (size_t i = 0; i < reader->field_count; i++) {
        pcd_field field = reader->fields[i];
        const bool is_float = field.type.kind == CLOUD_FLOAT;
        if (is_float && field.type.size < 4)
            return cloud_fail_line(reader->file, "field %zu is a float of %u bytes, not 4 or 8", i + 1,
                                   field.type.size);
        if (field.channel >= 0 && field.channel <= CLOUD_Z && field.count != 1)
            return cloud_fail_line(reader->file, "%c has a COUNT of %" PRIu64 ", which must be 1", "xyz"[field.channel],
                                   field.count);
        field.column = reader->columns;
        field.offset = reader->stride;
        reader->columns += field.count;
        reader->stride += field.count * field.type.size;
        if (field.count != 1 || (field.channel == CLOUD_PACKED && field.type.size != 4))
            field.channel = -1;
        if (!cloud_add_channel(reader->file, field.channel, field.name))
            continue;
        if (field.channel == CLOUD_PACKED)
            field.type.kind = CLOUD_UNSIGNED;
        if (field.channel == CLOUD_RED && is_float)
            full = 1;
        reader->fields[kept++] = field;
    }
    reader->field_count = kept;
    cloud_select_channels(reader->file, full);
    return true;
}

static bool check_header(pcd_reader *reader)
{
    for (int i = 0; i < KEYS; i++)
        if (keywords[i].required && !has_read_keyword(reader, (pcd_key)i))
            return cloud_fail_line(reader->file, "the header has no %s", keywords[i].name);
    return find_point_count(reader) && set_field_offsets(reader);
}

static bool read_header(pcd_reader *reader)
{
    cloud_span word, rest;
    while (!has_read_keyword(reader, KEY_DATA)) {
        if (!read_next_header_line(reader->file, &word, &rest))
            return cloud_fail_line(reader->file, "the file ends in its header");
        if (!read_header_line(reader, word, rest))
            return false;
    }
    return check_header(reader);
}

/* ---- Ascii data --------------------------------------------------------------------------------------------- */

static bool read_ascii_point(const pcd_reader *reader, cloud_span line, double numbers[CLOUD_CHANNELS])
{
    cloud_span word;
    uint64_t column = 0;
    for (const pcd_field *field = reader->fields; cloud_read_word(&line, &word); column++) {
        if (field == reader->fields + reader->field_count || field->column != column)
            continue;
        if (!cloud_parse_channel(reader->file, word, field->channel, &numbers[field->channel]))
            return false;
        field++;
    }
    return column == reader->columns ||
           cloud_fail_line(reader->file, "has %" PRIu64 " values instead of %" PRIu64, column, reader->columns);
}

static bool read_ascii_points(pcd_reader *reader, size_t offset)
{
    (void)offset;
    if (!cloud_check_text(reader->file) || !cloud_reserve_announced(reader->file, reader->points, reader->columns))
        return false;
    for (uint64_t i = 0; i < reader->points; i++) {
        cloud_span line;
        double numbers[CLOUD_CHANNELS];
        cloud_report_progress(reader->file, i, i, reader->points);
        if (!cloud_read_nonblank_line(reader->file, &line))
            return cloud_fail_line(reader->file, "the file ends after %" PRIu64 " of %" PRIu64 " points", i,
                                   reader->points);
        if (!read_ascii_point(reader, line, numbers) || !cloud_add_point(reader->file, numbers))
            return false;
    }
    cloud_note_trailing_lines(reader->file);
    return true;
}

/* ---- Binary data -------------------------------------------------------------------------------------------- */

/* Add the points of binary data. Packed data hold one point after another. Decompressed data hold one field after
 * another: all values of the first field, then all values of the second, and so on. */
static bool add_points(const pcd_reader *reader, const unsigned char *bytes)
{
    const bool packed = reader->encoding == PCD_BINARY;
    cloud_field fields[CLOUD_CHANNELS];
    for (size_t k = 0; k < reader->field_count; k++) {
        const pcd_field *field = &reader->fields[k];
        fields[k] = (cloud_field){.type = field->type,
                                  .channel = field->channel,
                                  .first = bytes + field->offset * (packed ? 1 : reader->points),
                                  .step = packed ? (size_t)reader->stride : field->type.size};
    }
    return cloud_add_records(reader->file, fields, reader->field_count, reader->points);
}

static bool read_binary_points(pcd_reader *reader, size_t offset)
{
    size_t left = reader->file->size - offset;
    if (reader->points > left / reader->stride)
        return cloud_fail_byte(reader->file, offset,
                               "%" PRIu64 " points of %" PRIu64
                               " bytes each should follow, but the file has only %zu bytes left",
                               reader->points, reader->stride, left);
    cloud_note_trailing_bytes(reader->file, offset + (size_t)(reader->points * reader->stride));
    return add_points(reader, reader->file->bytes + offset);
}

static bool decompress_points(const pcd_reader *reader, size_t offset, uint32_t packed, uint32_t size)
{
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return cloud_fail_byte(reader->file, offset, "out of memory for %" PRIu32 " bytes of points", size);
    bool whole = lzf_decompress(reader->file->bytes + offset, packed, bytes, size) == size;
    bool done =
        whole ? add_points(reader, bytes) : cloud_fail_byte(reader->file, offset, "the compressed data is damaged");
    free(bytes);
    return done;
}

static bool read_compressed_points(pcd_reader *reader, size_t offset)
{
    enum { SIZES = 8 };
    const cloud_file *file = reader->file;
    if (file->size - offset < SIZES)
        return cloud_fail_byte(file, file->size, "the file ends before its compressed data");
    uint32_t packed = (uint32_t)cloud_read_bits(4, false, file->bytes + offset);
    uint32_t size = (uint32_t)cloud_read_bits(4, false, file->bytes + offset + 4);
    if (reader->points > UINT32_MAX / reader->stride || reader->points * reader->stride != size)
        return cloud_fail_byte(file, offset,
                               "%" PRIu64 " points of %" PRIu64
                               " bytes each should follow, but the compressed data claims to hold %" PRIu32 " bytes",
                               reader->points, reader->stride, size);
    offset += SIZES;
    if (packed > file->size - offset)
        return cloud_fail_byte(file, offset,
                               "%" PRIu32 " compressed bytes should follow, but the file has only %zu bytes left",
                               packed, file->size - offset);
    if (size > (uint64_t)packed * LZF_RATIO)
        return cloud_fail_byte(file, offset, "%" PRIu32 " compressed bytes are too few for %" PRIu32 " bytes of points",
                               packed, size);
    cloud_note_trailing_bytes(file, offset + packed);
    return size == 0 || decompress_points(reader, offset, packed, size);
}

static bool parse_pcd(cloud_file *file)
{
    static bool (*const readers[])(pcd_reader * reader, size_t offset) = {
        [PCD_ASCII] = read_ascii_points, [PCD_BINARY] = read_binary_points, [PCD_COMPRESSED] = read_compressed_points};
    pcd_reader reader = {.file = file};
    cloud_rewind_lines(file);
    if (!read_header(&reader))
        return false;
    return readers[reader.encoding](&reader, (size_t)(file->lines.at - (const char *)file->bytes));
}

const cloud_format cloud_pcd = {is_pcd, parse_pcd};
