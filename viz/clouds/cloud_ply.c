/* SPDX-License-Identifier: MIT */
/* cloud_ply.c - reads the vertices of a PLY file, ascii or binary (Greg Turk, "The PLY Polygon File Format", 1994). */
#include "cloud_format.h"

#include <inttypes.h>

enum {
    MAX_ELEMENTS = 64,
    MAX_PROPERTIES = 1024, /* the largest number of properties of all elements together */
};

typedef enum ply_encoding { PLY_NO_ENCODING, PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_encoding;

typedef struct ply_property {
    cloud_scalar type;   /* the type of the property's value; if the property is a list, the type of each item */
    cloud_scalar length; /* if the property is a list, the type of its length; else the size of this type is 0 */
    int channel;         /* the cloud_channel that the property of a vertex stands for; -1: no channel */
} ply_property;

typedef struct ply_element {
    cloud_span name;
    uint64_t count;
    size_t first_property, property_count;
} ply_element;

typedef struct ply_reader {
    cloud_file *file;
    size_t offset; /* the offset of the next byte to read in binary data */
    ply_encoding encoding;
    ply_element elements[MAX_ELEMENTS];
    size_t element_count;
    ply_property properties[MAX_PROPERTIES];
    size_t property_count;
    const ply_element *vertex; /* the element "vertex", which holds the points; null until the header declares it */
    unsigned full_color;       /* the assumed full scale of colours: 1 if they are floats, 255 if they are integers */
    bool has_all_points;       /* true: all points were read, so an error after the points becomes a note */
    bool is_truncated;         /* true: the file ends before its last element */
} ply_reader;

static bool is_ply(cloud_file *file)
{
    cloud_span line, word, more;
    cloud_rewind_lines(file);
    return cloud_read_next_line(file, &line) && cloud_read_word(&line, &word) && cloud_word_equals(word, "ply") &&
           !cloud_read_word(&line, &more);
}

/* ---- Header ------------------------------------------------------------------------------------------------- */

static bool find_type(cloud_span word, cloud_scalar *scalar)
{
    static const char names[] = "char int8 uchar uint8 short int16 ushort uint16 int int32 uint uint32 "
                                "float float32 double float64";
    static const cloud_scalar types[] = {{CLOUD_SIGNED, 1}, {CLOUD_UNSIGNED, 1}, {CLOUD_SIGNED, 2}, {CLOUD_UNSIGNED, 2},
                                         {CLOUD_SIGNED, 4}, {CLOUD_UNSIGNED, 4}, {CLOUD_FLOAT, 4},  {CLOUD_FLOAT, 8}};
    const int found = cloud_find_word_in_list(word, names);
    if (found >= 0)
        *scalar = types[found / 2]; /* the list has two names for each type */
    return found >= 0;
}

static bool read_format(ply_reader *reader, cloud_span rest)
{
    cloud_span name, version;
    cloud_read_word(&rest, &name);
    cloud_read_word(&rest, &version);
    if (reader->encoding != PLY_NO_ENCODING)
        return cloud_fail_at_word(reader->file, name, "is a second format in this header; a PLY header has only one");
    reader->encoding =
        (ply_encoding)(1 + cloud_find_word_in_list(name, "ascii binary_little_endian binary_big_endian"));
    if (reader->encoding == PLY_NO_ENCODING)
        return cloud_fail_at_word(
            reader->file, name,
            "is not a PLY format; the formats are ascii, binary_little_endian and binary_big_endian");
    return cloud_word_equals(version, "1.0") || cloud_fail_at_word(reader->file, version, "is not PLY version 1.0");
}

static bool read_element(ply_reader *reader, cloud_span rest)
{
    cloud_span name, number;
    uint64_t count;
    if (reader->element_count == MAX_ELEMENTS)
        return cloud_fail_line(reader->file, "more than %d elements", MAX_ELEMENTS);
    cloud_read_word(&rest, &name);
    cloud_read_word(&rest, &number);
    if (!cloud_parse_count(number, &count))
        return cloud_fail_at_word(reader->file, number, "is not a count of elements");
    ply_element *element = &reader->elements[reader->element_count++];
    *element = (ply_element){name, count, reader->property_count, 0};
    if (!cloud_word_equals(name, "vertex"))
        return true;
    if (reader->vertex)
        return cloud_fail_at_word(reader->file, name, "is already the name of another element");
    reader->vertex = element;
    return true;
}

/* Read the type of a property, which is a single value or a list. */
static bool read_type(ply_reader *reader, cloud_span *rest, ply_property *property)
{
    cloud_span word;
    cloud_read_word(rest, &word);
    if (cloud_word_equals(word, "list")) {
        cloud_read_word(rest, &word);
        if (!find_type(word, &property->length) || property->length.kind == CLOUD_FLOAT)
            return cloud_fail_at_word(reader->file, word, "is not an integer type for a list's length");
        cloud_read_word(rest, &word);
    }
    return find_type(word, &property->type) || cloud_fail_at_word(reader->file, word, "is not a PLY type");
}

/* Set the channel of a vertex property. A coordinate must be a single number and must occur only once. Any other
 * property that is a list or occurs twice is ignored. */
static bool set_channel(ply_reader *reader, ply_property *property, cloud_span name)
{
    const bool list = property->length.size > 0;
    const int channel = cloud_find_channel(name);
    if (cloud_add_channel(reader->file, list ? -1 : channel, name))
        property->channel = channel;
    else if (channel >= CLOUD_X && channel <= CLOUD_Z)
        return cloud_fail_at_word(reader->file, name,
                                  list ? "is a list; a coordinate must be a single number"
                                       : "is already the name of another property");
    if (property->channel == CLOUD_RED && property->type.kind == CLOUD_FLOAT)
        reader->full_color = 1;
    return true;
}

static bool read_property(ply_reader *reader, cloud_span rest)
{
    ply_property property = {.channel = -1};
    cloud_span name;
    if (reader->element_count == 0)
        return cloud_fail_line(reader->file, "a property stands before any element");
    if (reader->property_count == MAX_PROPERTIES)
        return cloud_fail_line(reader->file, "more than %d properties", MAX_PROPERTIES);
    ply_element *element = &reader->elements[reader->element_count - 1];
    if (!read_type(reader, &rest, &property))
        return false;
    if (!cloud_read_word(&rest, &name))
        return cloud_fail_line(reader->file, "a property has no name");
    if (element == reader->vertex && !set_channel(reader, &property, name))
        return false;
    reader->properties[reader->property_count++] = property;
    element->property_count++;
    return true;
}

static bool read_header_line(ply_reader *reader, cloud_span keyword, cloud_span rest)
{
    enum { UNKNOWN = -1, FORMAT, ELEMENT, PROPERTY };
    switch (cloud_find_word_in_list(keyword, "format element property comment obj_info")) {
    case UNKNOWN:
        return cloud_fail_at_word(reader->file, keyword, "does not belong in a PLY header");
    case FORMAT:
        return read_format(reader, rest);
    case ELEMENT:
        return read_element(reader, rest);
    case PROPERTY:
        return read_property(reader, rest);
    default:
        return true;
    }
}

/* Check that the header has all required parts. */
static bool check_header(const ply_reader *reader)
{
    if (reader->encoding == PLY_NO_ENCODING)
        return cloud_fail_line(reader->file, "the header has no format");
    if (!reader->vertex)
        return cloud_fail_line(reader->file, "the header has no element \"vertex\"");
    for (int axis = 0; axis < 3; axis++)
        if (!(reader->file->channels >> axis & 1))
            return cloud_fail_line(reader->file, "element \"vertex\" has no property \"%c\"", "xyz"[axis]);
    cloud_select_channels(reader->file, reader->full_color);
    return true;
}

/* Read the header, beginning at its second line. */
static bool read_header(ply_reader *reader)
{
    cloud_span line, keyword;
    while (cloud_read_next_line(reader->file, &line)) {
        if (!cloud_read_word(&line, &keyword))
            continue;
        if (cloud_word_equals(keyword, "end_header"))
            return check_header(reader);
        if (!read_header_line(reader, keyword, line))
            return false;
    }
    return cloud_fail_line(reader->file, "the file ends in its header");
}

/* ---- Ascii data --------------------------------------------------------------------------------------------- */

/* Read the words of one property from a line, and remove these words from the line. */
static bool read_property_words(ply_reader *reader, const ply_property *property, cloud_span *line,
                                double numbers[CLOUD_CHANNELS])
{
    cloud_span word;
    uint64_t count = 1;
    bool enough = cloud_read_word(line, &word);
    if (enough && property->channel >= 0)
        return cloud_parse_channel(reader->file, word, property->channel, &numbers[property->channel]);
    if (enough && property->length.size > 0) {
        if (!cloud_parse_count(word, &count))
            return cloud_fail_at_word(reader->file, word, "is not a valid length of a list");
        for (uint64_t i = 0; enough && i < count; i++)
            enough = cloud_read_word(line, &word);
    }
    return enough || cloud_fail_line(reader->file, "the line has too few values");
}

static bool read_ascii_row(ply_reader *reader, const ply_element *element, uint64_t row, double numbers[CLOUD_CHANNELS])
{
    cloud_span line, word;
    if (!cloud_read_nonblank_line(reader->file, &line)) {
        char quote[CLOUD_QUOTE];
        reader->is_truncated = true;
        return cloud_fail_line(reader->file, "the file ends after %" PRIu64 " of %" PRIu64 " %s", row, element->count,
                               cloud_quote_word(element->name, quote));
    }
    for (size_t i = 0; i < element->property_count; i++)
        if (!read_property_words(reader, &reader->properties[element->first_property + i], &line, numbers))
            return false;
    return !cloud_read_word(&line, &word) ||
           cloud_fail_at_word(reader->file, word, "is an extra value after the last property of the line");
}

/* ---- Binary data -------------------------------------------------------------------------------------------- */

/* Skip `count` values of a type. Return the address of the first value, or null if the file ends before the last
 * value. */
static const unsigned char *skip_values(ply_reader *reader, cloud_scalar type, uint64_t count)
{
    const unsigned char *at = reader->file->bytes + reader->offset;
    if (count > (reader->file->size - reader->offset) / type.size)
        return NULL;
    reader->offset += (size_t)count * type.size;
    return at;
}

static bool fail_at_file_end(ply_reader *reader, const ply_element *element, uint64_t row)
{
    char quote[CLOUD_QUOTE];
    reader->is_truncated = true;
    return cloud_fail_byte(reader->file, reader->offset,
                           "the file ends in the middle of row %" PRIu64 " of %" PRIu64 " %s", row + 1, element->count,
                           cloud_quote_word(element->name, quote));
}

static bool read_binary_row(ply_reader *reader, const ply_element *element, uint64_t row,
                            double numbers[CLOUD_CHANNELS])
{
    bool big_endian = reader->encoding == PLY_BIG_ENDIAN;
    for (size_t i = 0; i < element->property_count; i++) {
        const ply_property *property = &reader->properties[element->first_property + i];
        double count = 1;
        if (property->length.size > 0) {
            const unsigned char *length = skip_values(reader, property->length, 1);
            if (!length)
                return fail_at_file_end(reader, element, row);
            count = cloud_read_scalar(property->length, big_endian, length);
        }
        if (count < 0)
            return cloud_fail_byte(reader->file, reader->offset - property->length.size,
                                   "a list has a negative length");
        const unsigned char *value = skip_values(reader, property->type, (uint64_t)count);
        if (!value)
            return fail_at_file_end(reader, element, row);
        if (property->channel >= 0)
            numbers[property->channel] = cloud_read_scalar(property->type, big_endian, value);
    }
    return true;
}

/* Read the points of an element whose rows all have the same size. *read becomes true if all points were added, and
 * false with an error if memory runs out. If the element has lists, or if the file ends before the last row, returns
 * false without an error and reads nothing; the caller then reads row by row. */
static bool read_rows_of_equal_size(ply_reader *reader, const ply_element *element, bool *read)
{
    cloud_field fields[CLOUD_CHANNELS];
    size_t field_count = 0, size = 0;
    for (size_t i = 0; i < element->property_count; i++) {
        const ply_property *property = &reader->properties[element->first_property + i];
        if (property->length.size > 0)
            return false;
        if (property->channel >= 0)
            fields[field_count++] = (cloud_field){property->type, reader->encoding == PLY_BIG_ENDIAN, property->channel,
                                                  reader->file->bytes + reader->offset + size, 0};
        size += property->type.size;
    }
    if (element->count > (reader->file->size - reader->offset) / size)
        return false;
    for (size_t i = 0; i < field_count; i++)
        fields[i].step = size;
    reader->offset += (size_t)element->count * size;
    *read = cloud_add_records(reader->file, fields, field_count, element->count);
    return true;
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* Turn the reader's error into a note if all points were read before the error. A truncated file remains an error, even
 * if no point is missing. Returns whether the error became a note. */
static bool turn_late_error_into_note(const ply_reader *reader)
{
    return reader->has_all_points && !reader->is_truncated && cloud_turn_error_into_note(reader->file);
}

static bool read_rows(ply_reader *reader, const ply_element *element)
{
    bool (*read_row)(ply_reader *, const ply_element *, uint64_t, double *) =
        reader->encoding == PLY_ASCII ? read_ascii_row : read_binary_row;
    bool has_points = element == reader->vertex;
    double numbers[CLOUD_CHANNELS];
    if (element->property_count == 0)
        return true;
    if (has_points && reader->encoding != PLY_ASCII &&
        read_rows_of_equal_size(reader, element, &reader->has_all_points))
        return reader->has_all_points;
    if (has_points && !cloud_reserve_announced(reader->file, element->count, element->property_count))
        return false;
    for (uint64_t row = 0; row < element->count; row++) {
        cloud_report_progress(reader->file, row, row, element->count);
        if (!read_row(reader, element, row, numbers) &&
            !(reader->encoding == PLY_ASCII && turn_late_error_into_note(reader)))
            return false;
        if (has_points && !cloud_add_point(reader->file, numbers))
            return false;
    }
    reader->has_all_points = reader->has_all_points || has_points;
    return true;
}

static bool parse_ply(cloud_file *file)
{
    ply_reader reader = {.file = file, .full_color = 255};
    if (!is_ply(file)) {
        file->lines.number = 1;
        return cloud_fail_line(file, "is not a PLY file: its first line is not \"ply\"");
    }
    if (!read_header(&reader))
        return false;
    bool ascii = reader.encoding == PLY_ASCII;
    if (ascii && !cloud_check_text(file))
        return false;
    reader.offset = (size_t)(file->lines.at - (const char *)file->bytes);
    for (size_t i = 0; i < reader.element_count; i++)
        if (!read_rows(&reader, &reader.elements[i]))
            /* after an error, the next element of a binary file cannot be found */
            return turn_late_error_into_note(&reader);
    if (ascii)
        cloud_note_trailing_lines(file);
    else
        cloud_note_trailing_bytes(file, reader.offset);
    return true;
}

const cloud_format cloud_ply = {is_ply, parse_ply};
