/* SPDX-License-Identifier: MIT */
/* cloud_pcd.c - the points of a PCD file, version 0.5 to 0.7, the format of the Point Cloud Library (PCL).
 *
 * A text header lists the fields of a point, with a size, a type and a count for each. The data follow as text lines,
 * as packed points, or compressed by LZF with all values of one field together. Packed and compressed data are read by
 * the same loop, add_points(), with other offsets and strides.
 */
#include "cloud_format.h"
#include "number.h"

#include <inttypes.h>
#include <lzf.h>
#include <stdlib.h>

enum {
    MAX_FIELDS = 1024,
    LZF_RATIO = 88, /* highest compression of LZF: its longest match expands 3 bytes to 264 */
};

typedef enum pcd_encoding { PCD_ASCII, PCD_BINARY, PCD_COMPRESSED } pcd_encoding;

typedef struct pcd_field {
    cloud_scalar type;
    uint64_t count; /* values in each point */
    int channel;    /* a cloud_channel; -1: none */
} pcd_field;

/* The position of a channel within a point. */
typedef struct pcd_place {
    int channel;
    cloud_scalar type;
    uint64_t column; /* number of values before it */
    uint64_t offset; /* number of bytes before it */
} pcd_place;

typedef struct pcd_reader {
    cloud_file *file;
    cloud_lines lines;
    unsigned seen; /* bit i is set after keyword i was read */
    size_t field_count;
    pcd_field fields[MAX_FIELDS];
    uint64_t width, height, points;
    pcd_encoding encoding;
    pcd_place places[CLOUD_CHANNELS]; /* the channels to read, in the order of the fields */
    unsigned place_count;
    uint64_t columns, stride; /* values and bytes per point */
} pcd_reader;

/* ---- Header lines ------------------------------------------------------------------------------------------- */

static bool fail_header(const pcd_reader *reader, const char *reason, cloud_span word)
{
    return cloud_fail_word(reader->file, reader->lines.number, word, reason);
}

static bool read_version(pcd_reader *reader, cloud_span rest)
{
    cloud_span word;
    const char *end;
    double version;
    cloud_next_word(&rest, &word);
    bool known =
        number_parse(word.begin, word.limit, &end, &version) && end == word.limit && version >= 0.5 && version <= 0.7;
    return known || fail_header(reader, "is not a supported version of PCD: 0.5 to 0.7", word);
}

static bool read_fields(pcd_reader *reader, cloud_span rest)
{
    cloud_span word;
    unsigned channels = 0;
    while (cloud_next_word(&rest, &word)) {
        int channel = cloud_word_channel(word);
        if (reader->field_count == MAX_FIELDS)
            return cloud_fail_line(reader->file, reader->lines.number, "more than %d fields", MAX_FIELDS);
        const bool again = channel >= 0 && channels >> channel & 1;
        if (again && channel <= CLOUD_Z)
            return fail_header(reader, "is a second field with this name", word);
        if (channel >= 0)
            channels |= 1U << channel;
        reader->fields[reader->field_count++] = (pcd_field){.channel = again ? -1 : channel, .count = 1};
    }
    for (int axis = 0; axis < 3; axis++)
        if (!(channels >> axis & 1))
            return cloud_fail_line(reader->file, reader->lines.number, "FIELDS has no field \"%c\"", "xyz"[axis]);
    return true;
}

static bool set_size(pcd_field *field, cloud_span word)
{
    uint64_t size;
    if (!cloud_word_count(word, &size) || (size != 1 && size != 2 && size != 4 && size != 8))
        return false;
    field->type.size = (unsigned)size;
    return true;
}

static bool set_type(pcd_field *field, cloud_span word)
{
    static const char *const names[] = {[CLOUD_SIGNED] = "I", [CLOUD_UNSIGNED] = "U", [CLOUD_FLOAT] = "F"};
    for (int i = 0; i < 3; i++) {
        if (!cloud_word_is(word, names[i]))
            continue;
        field->type.kind = (cloud_scalar_kind)i;
        return true;
    }
    return false;
}

/* The limit keeps the sum over MAX_FIELDS fields of 8 bytes from overflowing. */
static bool set_count(pcd_field *field, cloud_span word)
{
    return cloud_word_count(word, &field->count) && field->count > 0 && field->count <= UINT32_MAX;
}

/* Read a line with one word for each field. */
static bool read_each(pcd_reader *reader, cloud_span rest, bool (*set)(pcd_field *, cloud_span), const char *reason)
{
    cloud_span word;
    for (size_t i = 0; i < reader->field_count; i++) {
        if (!cloud_next_word(&rest, &word))
            return cloud_fail_line(reader->file, reader->lines.number, "has %zu words for %zu fields", i,
                                   reader->field_count);
        if (!set(&reader->fields[i], word))
            return fail_header(reader, reason, word);
    }
    return !cloud_next_word(&rest, &word) || fail_header(reader, "is one word more than there are fields", word);
}

static bool read_number(const pcd_reader *reader, cloud_span rest, uint64_t *number)
{
    cloud_span word;
    cloud_next_word(&rest, &word);
    return cloud_word_count(word, number) || fail_header(reader, "is not a count of points", word);
}

static bool read_encoding(pcd_reader *reader, cloud_span rest)
{
    static const char *const names[] = {
        [PCD_ASCII] = "ascii", [PCD_BINARY] = "binary", [PCD_COMPRESSED] = "binary_compressed"};
    cloud_span word;
    cloud_next_word(&rest, &word);
    for (int i = PCD_ASCII; i <= PCD_COMPRESSED; i++) {
        if (!cloud_word_is(word, names[i]))
            continue;
        reader->encoding = (pcd_encoding)i;
        return true;
    }
    return fail_header(reader, "is not a kind of PCD data: ascii, binary or binary_compressed", word);
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

/* A line of the header. At most one of `read`, `set` and `number` is given; a line with none of them is skipped. */
typedef struct pcd_keyword {
    const char *name;
    bool required;
    bool (*read)(pcd_reader *reader, cloud_span rest);
    bool (*set)(pcd_field *field, cloud_span word); /* the line has one word for each field */
    const char *reason;                             /* the error if `set` refuses a word */
    size_t number;                                  /* the line holds one integer; its offset in pcd_reader */
} pcd_keyword;

static const pcd_keyword keywords[KEYS] = {
    [KEY_VERSION] = {"VERSION", .read = read_version},
    [KEY_FIELDS] = {"FIELDS", true, .read = read_fields},
    [KEY_SIZE] = {"SIZE", true, .set = set_size, .reason = "is not the size of a field: 1, 2, 4 or 8"},
    [KEY_TYPE] = {"TYPE", true, .set = set_type, .reason = "is not the type of a field: I, U or F"},
    [KEY_COUNT] = {"COUNT", .set = set_count, .reason = "is not the count of a field: 1 to 4294967295"},
    [KEY_WIDTH] = {"WIDTH", .number = offsetof(pcd_reader, width)},
    [KEY_HEIGHT] = {"HEIGHT", .number = offsetof(pcd_reader, height)},
    [KEY_VIEWPOINT] = {"VIEWPOINT", .required = false},
    [KEY_POINTS] = {"POINTS", .number = offsetof(pcd_reader, points)},
    [KEY_DATA] = {"DATA", true, .read = read_encoding},
};

static bool has_seen(const pcd_reader *reader, pcd_key key)
{
    return reader->seen >> key & 1;
}

static bool read_header_line(pcd_reader *reader, cloud_span word, cloud_span rest)
{
    for (int i = 0; i < KEYS; i++) {
        if (!cloud_word_is(word, keywords[i].name))
            continue;
        if (has_seen(reader, (pcd_key)i))
            return fail_header(reader, "occurs twice", word);
        if (keywords[i].set && !has_seen(reader, KEY_FIELDS))
            return fail_header(reader, "stands before FIELDS; FIELDS must come first", word);
        reader->seen |= 1U << i;
        if (keywords[i].read)
            return keywords[i].read(reader, rest);
        if (keywords[i].set)
            return read_each(reader, rest, keywords[i].set, keywords[i].reason);
        return !keywords[i].number || read_number(reader, rest, (uint64_t *)((char *)reader + keywords[i].number));
    }
    return fail_header(reader, "does not belong in a PCD header", word);
}

/* Read the next line of the header that is not a comment: its first word, and the rest. */
static bool next_header_line(cloud_lines *lines, cloud_span *word, cloud_span *rest)
{
    while (cloud_next_filled_line(lines, rest))
        if (cloud_next_word(rest, word) && *word->begin != '#')
            return true;
    return false;
}

static bool is_pcd(const cloud_file *file)
{
    cloud_lines lines = cloud_begin_lines(file);
    cloud_span word, rest;
    return next_header_line(&lines, &word, &rest) && (cloud_word_is(word, "VERSION") || cloud_word_is(word, "FIELDS"));
}

/* ---- The header as a whole ---------------------------------------------------------------------------------- */

/* Find the number of points: WIDTH times HEIGHT, or POINTS; both must agree if both are given. HEIGHT is 1 if missing.
 */
static bool find_point_count(pcd_reader *reader)
{
    size_t line = reader->lines.number;
    if (!has_seen(reader, KEY_WIDTH) && !has_seen(reader, KEY_POINTS))
        return cloud_fail_line(reader->file, line, "the header has neither WIDTH nor POINTS");
    if (!has_seen(reader, KEY_WIDTH))
        reader->width = reader->points;
    if (!has_seen(reader, KEY_HEIGHT))
        reader->height = 1;
    bool overflows = reader->height > 0 && reader->width > UINT64_MAX / reader->height;
    if (!has_seen(reader, KEY_POINTS) && !overflows)
        reader->points = reader->width * reader->height;
    if (overflows || reader->points != reader->width * reader->height)
        return cloud_fail_line(reader->file, line, "WIDTH %" PRIu64 " times HEIGHT %" PRIu64 " is not POINTS %" PRIu64,
                               reader->width, reader->height, reader->points);
    return true;
}

/* Add a field's channel to those that are read. A coordinate must be a single number; a value that is not is ignored. A
 * packed colour has four bytes, which many files declare as a float. */
static bool add_place(pcd_reader *reader, const pcd_field *field)
{
    pcd_place place = {field->channel, field->type, reader->columns, reader->stride};
    if (field->channel <= CLOUD_Z && field->count != 1)
        return cloud_fail_line(reader->file, reader->lines.number, "%c has a COUNT of %" PRIu64 ", which must be 1",
                               "xyz"[field->channel], field -> count);
    if (field->count != 1 || (field->channel == CLOUD_PACKED && field->type.size != 4))
        return true;
    if (field->channel == CLOUD_PACKED)
        place.type.kind = CLOUD_UNSIGNED;
    reader->places[reader->place_count++] = place;
    return true;
}

static bool lay_out_fields(pcd_reader *reader)
{
    for (size_t i = 0; i < reader->field_count; i++) {
        const pcd_field *field = &reader->fields[i];
        if (field->type.kind == CLOUD_FLOAT && field->type.size < 4)
            return cloud_fail_line(reader->file, reader->lines.number, "field %zu is a float of %u bytes, not 4 or 8",
                                   i + 1, field->type.size);
        if (field->channel >= 0 && !add_place(reader, field))
            return false;
        reader->columns += field->count;
        reader->stride += field->count * field->type.size;
    }
    return true;
}

/* Announce the channels. Colours that are floats are assumed to range from 0 to 1. */
static void set_channels(const pcd_reader *reader)
{
    unsigned channels = 0, full = 255;
    for (unsigned i = 0; i < reader->place_count; i++) {
        channels |= 1U << reader->places[i].channel;
        if (reader->places[i].channel == CLOUD_RED && reader->places[i].type.kind == CLOUD_FLOAT)
            full = 1;
    }
    cloud_set_channels(reader->file, channels, full);
}

static bool check_header(pcd_reader *reader)
{
    for (int i = 0; i < KEYS; i++)
        if (keywords[i].required && !has_seen(reader, (pcd_key)i))
            return cloud_fail_line(reader->file, reader->lines.number, "the header has no %s", keywords[i].name);
    return find_point_count(reader) && lay_out_fields(reader);
}

static bool read_header(pcd_reader *reader)
{
    cloud_span word, rest;
    while (!has_seen(reader, KEY_DATA)) {
        if (!next_header_line(&reader->lines, &word, &rest))
            return cloud_fail_line(reader->file, reader->lines.number, "the file ends in its header");
        if (!read_header_line(reader, word, rest))
            return false;
    }
    return check_header(reader);
}

/* ---- Ascii data --------------------------------------------------------------------------------------------- */

static bool read_line(const pcd_reader *reader, cloud_span line, double numbers[CLOUD_CHANNELS])
{
    cloud_span word;
    uint64_t column = 0;
    for (const pcd_place *place = reader->places; cloud_next_word(&line, &word); column++) {
        if (place == reader->places + reader->place_count || place->column != column)
            continue;
        if (!cloud_word_number(reader->file, reader->lines.number, word, place->channel, &numbers[place->channel]))
            return false;
        place++;
    }
    return column == reader->columns ||
           cloud_fail_line(reader->file, reader->lines.number, "has %" PRIu64 " values instead of %" PRIu64, column,
                           reader->columns);
}

static bool read_ascii(pcd_reader *reader)
{
    if (!cloud_check_text(reader->file) || !cloud_reserve_rows(reader->file, reader->points, reader->columns))
        return false;
    for (uint64_t i = 0; i < reader->points; i++) {
        cloud_span line;
        double numbers[CLOUD_CHANNELS];
        cloud_report_progress(reader->file, i, i, reader->points);
        if (!cloud_next_filled_line(&reader->lines, &line))
            return cloud_fail_line(reader->file, reader->lines.number,
                                   "the file ends after %" PRIu64 " of %" PRIu64 " points", i, reader->points);
        if (!read_line(reader, line, numbers) || !cloud_add(reader->file, numbers))
            return false;
    }
    cloud_note_trailing_lines(reader->file, &reader->lines);
    return true;
}

/* ---- Binary data -------------------------------------------------------------------------------------------- */

/* Read the points from binary data: the number of place k of point i begins at first[k] + i * step[k]. */
static bool add_points(const pcd_reader *reader, const unsigned char *bytes, const size_t *first, const size_t *step)
{
    if (!cloud_reserve(reader->file, reader->points))
        return false;
    for (size_t i = 0; i < reader->points; i++) {
        double numbers[CLOUD_CHANNELS];
        cloud_report_progress(reader->file, i, i, reader->points);
        for (unsigned k = 0; k < reader->place_count; k++)
            numbers[reader->places[k].channel] =
                cloud_read_scalar(reader->places[k].type, false, bytes + first[k] + i * step[k]);
        if (!cloud_add(reader->file, numbers))
            return false;
    }
    return true;
}

/* Read packed points, one after another. */
static bool read_binary(pcd_reader *reader, size_t offset)
{
    size_t left = reader->file->size - offset;
    size_t first[CLOUD_CHANNELS], step[CLOUD_CHANNELS];
    if (reader->points > left / reader->stride)
        return cloud_fail_byte(reader->file, offset,
                               "%" PRIu64 " points of %" PRIu64 " bytes are announced, but only %zu bytes follow",
                               reader->points, reader->stride, left);
    for (unsigned k = 0; k < reader->place_count; k++) {
        first[k] = (size_t)reader->places[k].offset;
        step[k] = (size_t)reader->stride;
    }
    cloud_note_trailing_bytes(reader->file, offset + (size_t)(reader->points * reader->stride));
    return add_points(reader, reader->file->bytes + offset, first, step);
}

/* Read decompressed points: all values of the first field, then all of the second, and so on. */
static bool add_unpacked(const pcd_reader *reader, const unsigned char *bytes)
{
    size_t first[CLOUD_CHANNELS], step[CLOUD_CHANNELS];
    for (unsigned k = 0; k < reader->place_count; k++) {
        first[k] = (size_t)(reader->places[k].offset * reader->points);
        step[k] = reader->places[k].type.size;
    }
    return add_points(reader, bytes, first, step);
}

static bool unpack(const pcd_reader *reader, size_t offset, uint32_t packed, uint32_t size)
{
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return cloud_fail_byte(reader->file, offset, "out of memory for %" PRIu32 " bytes of points", size);
    bool whole = lzf_decompress(reader->file->bytes + offset, packed, bytes, size) == size;
    bool done =
        whole ? add_unpacked(reader, bytes) : cloud_fail_byte(reader->file, offset, "the compressed data is damaged");
    free(bytes);
    return done;
}

static bool read_compressed(pcd_reader *reader, size_t offset)
{
    enum { SIZES = 8 };
    static const cloud_scalar size_type = {CLOUD_UNSIGNED, 4};
    const cloud_file *file = reader->file;
    if (file->size - offset < SIZES)
        return cloud_fail_byte(file, file->size, "the file ends before its compressed data");
    uint32_t packed = (uint32_t)cloud_read_scalar(size_type, false, file->bytes + offset);
    uint32_t size = (uint32_t)cloud_read_scalar(size_type, false, file->bytes + offset + 4);
    if (reader->points > UINT32_MAX / reader->stride || reader->points * reader->stride != size)
        return cloud_fail_byte(file, offset,
                               "%" PRIu64 " points of %" PRIu64 " bytes are announced, but %" PRIu32
                               " bytes of compressed data",
                               reader->points, reader->stride, size);
    offset += SIZES;
    if (packed > file->size - offset)
        return cloud_fail_byte(file, offset, "%" PRIu32 " compressed bytes are announced, but only %zu follow", packed,
                               file->size - offset);
    if (size > (uint64_t)packed * LZF_RATIO)
        return cloud_fail_byte(file, offset, "%" PRIu32 " compressed bytes cannot hold %" PRIu32 " bytes", packed,
                               size);
    cloud_note_trailing_bytes(file, offset + packed);
    return size == 0 || unpack(reader, offset, packed, size);
}

static bool parse_pcd(cloud_file *file)
{
    pcd_reader reader = {.file = file, .lines = cloud_begin_lines(file)};
    if (!read_header(&reader))
        return false;
    size_t offset = (size_t)(reader.lines.at - (const char *)file->bytes);
    set_channels(&reader);
    switch (reader.encoding) {
    case PCD_ASCII:
        return read_ascii(&reader);
    case PCD_BINARY:
        return read_binary(&reader, offset);
    case PCD_COMPRESSED:
        break;
    }
    return read_compressed(&reader, offset);
}

const cloud_format cloud_pcd = {is_pcd, parse_pcd};
