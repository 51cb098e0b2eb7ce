/* SPDX-License-Identifier: MIT */
/* cloud_format.h - the interface of a cloud format, and functions that all readers share. These functions parse lines,
 * words and binary numbers of a file in memory, append points to the result, and set errors. Private to cloud*.c.
 *
 * cloud.h says how to add a format. */
#ifndef CLOUDS_CLOUD_FORMAT_H
#define CLOUDS_CLOUD_FORMAT_H

#include "cloud.h"

#include <stdint.h>
#include <string.h>

/* What a column, a field or a property of a file means. */
typedef enum cloud_channel {
    CLOUD_X,
    CLOUD_Y,
    CLOUD_Z,
    CLOUD_RED,
    CLOUD_GREEN,
    CLOUD_BLUE,
    CLOUD_PACKED, /* a colour as the integer 0xRRGGBB; higher bits are ignored */
    CLOUD_INTENSITY,
    CLOUD_CLASS,
    CLOUD_CHANNELS
} cloud_channel;

/* The bits of the three colour channels in cloud_file.channels. */
#define CLOUD_COLOR (1U << CLOUD_RED | 1U << CLOUD_GREEN | 1U << CLOUD_BLUE)

/* A part of a file: the characters from `begin` up to `limit`. `limit` is exclusive. */
typedef struct cloud_span {
    const char *begin, *limit;
} cloud_span;

/* A cursor over the lines of a file. All lines end in the same way as the first line: with \n, \r\n or a single \r. */
typedef struct cloud_lines {
    const char *at, *limit;
    char terminator;
    size_t number; /* the number of the last line that was read; the first line has number 1 */
} cloud_lines;

/* A file that is being read, and the cloud and the error that the reader sets. */
typedef struct cloud_file {
    const char *name;
    const unsigned char *bytes;
    size_t size; /* the size of the file in bytes, at least 1 */
    cloud_lines lines;
    cloud *out;
    octreel_error *error;
    const cloud_watch *watch;                 /* the callbacks for progress; may be null */
    size_t room, row_room;                    /* the capacities of out->positions and out->rows, in points */
    unsigned channels;                        /* the channels that the file has, as bits 1 << cloud_channel */
    cloud_span channel_names[CLOUD_CHANNELS]; /* for each channel of the file, its name in the file */
} cloud_file;

typedef struct cloud_format {
    bool (*recognise)(cloud_file *file); /* Returns true if the contents are certainly of this format. May be null. */
    bool (*parse)(cloud_file *file);     /* Reads the whole file into file->out. Returns false with an error. */
} cloud_format;

#define CLOUD_FORMAT_EXTERN(id, names, endings) extern const cloud_format cloud_##id;
CLOUD_FORMAT_MAP(CLOUD_FORMAT_EXTERN)
#undef CLOUD_FORMAT_EXTERN
extern const cloud_format cloud_text; /* reads any text file; this format has no recognise() */

/* Returns whether the text of a file begins with a point. Comments and a line of column names, or of the number of
 * points, may come before the point. */
bool cloud_text_is_recognised(cloud_file *file);

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* Adds a channel to file->channels. `name` is the channel's name in the file. If `channel` is -1 or was added before,
 * returns false and adds a note that the value `name` is ignored. */
bool cloud_add_channel(cloud_file *file, int channel, cloud_span name);

/* Removes from file->channels the coordinates, and the colour channels that cannot be used: an incomplete set of red,
 * green and blue, or a packed colour beside a complete set. Adds a note about the removed colours. Call this function
 * after the last channel and before the first point is added. `full` (1 or 255) is the assumed full scale of colour
 * channels. If a point has a larger channel, the full scale is raised, and the colours that were read before are
 * rescaled. */
void cloud_select_channels(cloud_file *file, unsigned full);

/* Converts the numbers of one point, indexed by cloud_channel, to the values of the point. `value` is a row of
 * file->out->values in which all values are missing. */
void cloud_convert_values(cloud_file *file, const double *numbers, point_value *value);

/* If the colours of all points are zero, discards the colours and adds a note. Intensities are treated in the same way.
 * Call this function after the last point was added. */
void cloud_discard_zero_values(cloud_file *file);

/* Discards the values that were read so far. Points that are added later have no values. */
void cloud_discard_values(cloud_file *file);

/* If no point has a value, frees file->out->values. If no point has a colour, sets file->out->color_full to 0. Call
 * this function after the last point was added. */
void cloud_discard_absent_values(cloud_file *file);

/* Reserves memory for `count` points. The caller has checked that the file contains this many points. Returns false if
 * memory runs out. */
bool cloud_reserve(cloud_file *file, uint64_t count);

/* Reserves memory for the number of points that the file announces. Each point has `columns` numbers, which take at
 * least one byte each. So a wrong number reserves no more memory than a file of this size can need. */
bool cloud_reserve_announced(cloud_file *file, uint64_t count, uint64_t columns);

/* Appends a point. `numbers` is indexed by cloud_channel and must hold x, y, z and the channels of the file. If the
 * position is not finite, the point is skipped. Returns false if memory runs out. */
bool cloud_add_point(cloud_file *file, const double *numbers);

/* Counts a skipped point. `why` is the reason, a text with static storage. All skipped points of a file must have
 * the same reason. */
void cloud_count_skipped(const cloud_file *file, const char *why);

/* Skips a point if its position is not finite. Returns whether the point was skipped. */
bool cloud_skip_nonfinite(const cloud_file *file, const double *position);

/* Reports the progress: `done` of `total` units. Only every 65536th call reports. `calls` is the number of calls so
 * far. */
void cloud_report_progress(const cloud_file *file, uint64_t calls, uint64_t done, uint64_t total);

/* Set the error from a printf format and return false. The error names the file. cloud_fail_line() also adds the
 * number of the last line that was read. cloud_fail_byte() also adds a byte offset in the file. */
#define cloud_fail(file, ...) cloud_fail_at(file, NULL, 0, __VA_ARGS__)
#define cloud_fail_line(file, ...) cloud_fail_at(file, "", (file)->lines.number, __VA_ARGS__)
#define cloud_fail_byte(file, offset, ...) cloud_fail_at(file, "byte ", offset, __VA_ARGS__)
bool cloud_fail_at(const cloud_file *file, const char *unit, size_t number, const char *format, ...);

/* Turns an error after the last point of the file into a note of the cloud. If the cloud already has a note, only
 * clears the error. Returns true. */
bool cloud_turn_error_into_note(const cloud_file *file);

/* ---- Lines and words ---------------------------------------------------------------------------------------- */

/* Moves the cursor to the start of the first line, and finds out how lines end. */
void cloud_rewind_lines(cloud_file *file);

/* Reads the next line. The line end is not part of *line. Returns false at the end of the file. */
bool cloud_read_next_line(cloud_file *file, cloud_span *line);

/* Read the next line that is not blank. */
bool cloud_read_nonblank_line(cloud_file *file, cloud_span *line);

static inline bool cloud_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* Removes the first word from a line. Words are separated by blanks and tabs. Returns false if the line has no word. */
bool cloud_read_word(cloud_span *line, cloud_span *word);

bool cloud_word_equals(cloud_span word, const char *text);

/* Returns the index of a word in a list of words that are separated by blanks, or -1. */
int cloud_find_word_in_list(cloud_span word, const char *list);

/* Returns the channel with this name, or -1 if there is none. The names x, y and z must be in lower case. All other
 * names may be in upper or lower case. */
int cloud_find_channel(cloud_span word);

/* Parses a whole word as an integer from 0 to 2^64 - 1. */
bool cloud_parse_count(cloud_span word, uint64_t *count);

/* Parses a whole word as a coordinate. "nan" and "inf" give NaN. On failure, the error names the line that was read
 * last. */
bool cloud_parse_coordinate(const cloud_file *file, cloud_span word, double *coordinate);

/* Parses a whole word as the value of a channel. A packed colour may be an integer, or the float that has the same
 * bits. */
bool cloud_parse_channel(const cloud_file *file, cloud_span word, int channel, double *number);

/* The size of the text that cloud_quote_word() writes, in bytes with the final zero. */
#define CLOUD_QUOTE 48

/* Quotes a word for an error. Unprintable bytes are escaped and long words are shortened. Returns `text`. */
const char *cloud_quote_word(cloud_span word, char text[CLOUD_QUOTE]);

/* Sets the error "'WORD' REASON" with the number of the last line that was read. Returns false. */
bool cloud_fail_at_word(const cloud_file *file, cloud_span word, const char *reason);

/* Checks that the file is text. Returns false with an error if it contains a NUL byte. */
bool cloud_check_text(const cloud_file *file);

/* Adds a note if at least one more line follows that is not blank. */
void cloud_note_trailing_lines(cloud_file *file);

/* ---- Binary data -------------------------------------------------------------------------------------------- */

typedef enum cloud_scalar_kind { CLOUD_SIGNED, CLOUD_UNSIGNED, CLOUD_FLOAT } cloud_scalar_kind;

/* The type of a binary number. */
typedef struct cloud_scalar {
    cloud_scalar_kind kind;
    unsigned size; /* size in bytes: 1, 2, 4 or 8; for a float 4 or 8 */
} cloud_scalar;

/* Reads an unsigned integer of 1 to 8 bytes. */
static inline uint64_t cloud_read_bits(unsigned size, bool big_endian, const unsigned char *bytes)
{
    uint64_t bits = 0;
    /* the most frequent case has its own code, because compilers turn this code into one load */
    if (size == 4 && !big_endian)
        return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
    for (unsigned i = 0; i < size; i++)
        bits = bits << 8 | bytes[big_endian ? i : size - 1 - i];
    return bits;
}

/* Reads a number. Integers above 2^53 are rounded to doubles. */
static inline double cloud_read_scalar(cloud_scalar type, bool big_endian, const unsigned char *bytes)
{
    const uint64_t bits = cloud_read_bits(type.size, big_endian, bytes), sign = UINT64_C(1) << (8 * type.size - 1);
    const uint32_t low = (uint32_t)bits;
    float narrow;
    double wide;
    switch (type.kind) {
    case CLOUD_FLOAT:
        memcpy(&narrow, &low, sizeof narrow);
        memcpy(&wide, &bits, sizeof wide);
        return type.size == 8 ? wide : (double)narrow;
    case CLOUD_SIGNED: /* in two's complement, the sign bit stands for the negative of its unsigned value */
        return bits & sign ? -(double)(sign - (bits & (sign - 1))) : (double)bits;
    case CLOUD_UNSIGNED:
        break;
    }
    return (double)bits;
}

/* A field that every record of a series contains: the type, the meaning and the place of its number. */
typedef struct cloud_field {
    cloud_scalar type;
    bool big_endian;
    int channel;                /* the cloud_channel that the number stands for */
    const unsigned char *first; /* the number in the first record */
    size_t step;                /* distance from the number in one record to that in the next, in bytes */
} cloud_field;

/* Adds the points of `count` records. The caller has checked that the file contains this many records. Returns false if
 * memory runs out. */
bool cloud_add_records(cloud_file *file, const cloud_field *fields, size_t field_count, uint64_t count);

/* Adds a note if any byte from `offset` to the end of the file is not zero. Zeros are accepted, because some writers
 * fill the last page of a file with zeros. */
void cloud_note_trailing_bytes(const cloud_file *file, size_t offset);

#endif
