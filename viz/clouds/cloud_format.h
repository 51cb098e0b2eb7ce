/* SPDX-License-Identifier: MIT */
/* cloud_format.h - the interface of a cloud format, and functions that all readers share. These are about the file in
 * memory, its lines and words, its binary numbers, the growing result, and errors. Private to cloud*.c.
 *
 * cloud.h says how to add a format.
 */
#ifndef CLOUDS_CLOUD_FORMAT_H
#define CLOUDS_CLOUD_FORMAT_H

#include "cloud.h"

#include <stdint.h>

/* The meaning of a column, a field or a property of a file. */
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

/* The bits of the channels of a colour. */
#define CLOUD_COLOR (1U << CLOUD_RED | 1U << CLOUD_GREEN | 1U << CLOUD_BLUE)

/* The characters of a file from `begin` up to `limit`, which is exclusive. */
typedef struct cloud_span {
    const char *begin, *limit;
} cloud_span;

/* A cursor over the lines of a file. All lines end as the first line does: with \n, \r\n or a single \r. */
typedef struct cloud_lines {
    const char *at, *limit;
    char terminator;
    size_t number; /* the number of the line that was read last; the first line is 1 */
} cloud_lines;

/* A file that is being read, and where its points and its error are stored. */
typedef struct cloud_file {
    const char *name;
    const unsigned char *bytes;
    size_t size; /* the size of the file in bytes, at least 1 */
    cloud_lines lines;
    cloud *out;
    octreel_error *error;
    const cloud_watch *watch;                 /* the callbacks for progress; may be null */
    size_t room, row_room;                    /* capacities of out->positions and out->rows */
    unsigned channels;                        /* bits 1 << cloud_channel of the values that the file has */
    cloud_span channel_names[CLOUD_CHANNELS]; /* the names that cloud_add_channel() was given */
} cloud_file;

typedef struct cloud_format {
    bool (*recognise)(cloud_file *file); /* returns true if the contents are certainly of this format; may be null */
    bool (*parse)(cloud_file *file);     /* reads the whole file into file->out; false: the error is set */
} cloud_format;

#define CLOUD_FORMAT_EXTERN(id, names, endings) extern const cloud_format cloud_##id;
CLOUD_FORMAT_MAP(CLOUD_FORMAT_EXTERN)
#undef CLOUD_FORMAT_EXTERN
extern const cloud_format cloud_text; /* reads any text; it has no recognise() */

/* Returns whether the first line of a text that is neither a comment nor a line of column names contains a point. */
bool cloud_text_is_recognised(cloud_file *file);

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* Adds the channel of a value with this name to file->channels. Returns false with a note that the value is ignored if
 * `channel` is -1 or was added before. */
bool cloud_add_channel(cloud_file *file, int channel, cloud_span name);

/* Completes file->channels. Call this before the first point. `full` (1 or 255) is the assumed full scale of colour
 * channels. If a channel in the file is larger, the full scale is raised and colours that were read before are
 * rescaled. */
void cloud_complete_channels(cloud_file *file, unsigned full);

/* Converts numbers[CLOUD_CHANNELS] to the values of one point. */
point_value cloud_convert_values(cloud_file *file, const double *numbers);

/* Discards colours and intensities that are zero in every point, with a note. Call this after the last point. */
void cloud_discard_zeros(cloud_file *file);

/* Discards the values that were read so far. Points that follow have no values. */
void cloud_discard_values(cloud_file *file);

/* Completes the values. Call this after the last point. */
void cloud_finish_values(cloud_file *file);

/* Reserves memory for `count` points. The caller has checked that the file contains so many points. Returns false if
 * memory runs out. */
bool cloud_reserve(cloud_file *file, uint64_t count);

/* Reserves memory for a count of points that the file announces. A point has `columns` numbers of at least one byte
 * each. No more is reserved than a file of this size can hold. */
bool cloud_reserve_announced(cloud_file *file, uint64_t count, uint64_t columns);

/* Appends a point from numbers[CLOUD_CHANNELS]: its x, y and z and the channels of the file are used. If the
 * position is not finite, the point is skipped instead. Returns false if memory runs out. */
bool cloud_add_point(cloud_file *file, const double *numbers);

/* Counts a skipped point. `why` has static storage and is the same for all skipped points of a file. */
void cloud_count_skipped(const cloud_file *file, const char *why);

/* Skips a point if its position is not finite. Returns whether the point was skipped. */
bool cloud_skip_nonfinite(const cloud_file *file, const double *position);

/* Reports on every 65536th call that `done` of `total` is done. `calls` is the number of calls so far. */
void cloud_report_progress(const cloud_file *file, uint64_t calls, uint64_t done, uint64_t total);

/* Set the error from a printf format and return false. The error names the file. cloud_fail_line() adds the number
 * of the last line that was read; cloud_fail_byte() adds a byte offset in the file. */
#define cloud_fail(file, ...) cloud_fail_at(file, NULL, 0, __VA_ARGS__)
#define cloud_fail_line(file, ...) cloud_fail_at(file, "", (file)->lines.number, __VA_ARGS__)
#define cloud_fail_byte(file, offset, ...) cloud_fail_at(file, "byte ", offset, __VA_ARGS__)
bool cloud_fail_at(const cloud_file *file, const char *unit, size_t number, const char *format, ...);

/* Turns an error in data after the last point into a note of the cloud, unless the cloud already has a note. Returns
 * true. */
bool cloud_turn_error_into_note(const cloud_file *file);

/* ---- Lines and words ---------------------------------------------------------------------------------------- */

/* Moves the cursor to the start of the first line. */
void cloud_rewind_lines(cloud_file *file);

/* Reads the next line without its line end. Returns false at the end of the file. */
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

/* Returns the channel with this name, or -1. x, y and z must be in lower case; other names may be in any case. */
int cloud_find_channel(cloud_span word);

/* Parses a whole word as an integer from 0 to 2^64 - 1. */
bool cloud_parse_count(cloud_span word, uint64_t *count);

/* Parses a whole word as a coordinate. "nan" and "inf" give NaN. On failure, the error names the line that was read
 * last. */
bool cloud_parse_coordinate(const cloud_file *file, cloud_span word, double *coordinate);

/* Parses a whole word as a value of a channel. A packed colour is written as an integer, or as the float that has
 * the same bits. */
bool cloud_parse_channel(const cloud_file *file, cloud_span word, int channel, double *number);

/* The size of a quoted word with its final zero, in bytes. */
#define CLOUD_QUOTE 48

/* Quotes a word for an error. Unprintable bytes are escaped and long words are shortened. Returns `text`. */
const char *cloud_quote_word(cloud_span word, char text[CLOUD_QUOTE]);

/* Sets the error "'WORD' REASON" for the line that was read last. Returns false. */
bool cloud_fail_at_word(const cloud_file *file, cloud_span word, const char *reason);

/* Checks that the file is text. Returns false with an error if it contains a NUL byte. */
bool cloud_check_text(const cloud_file *file);

/* Adds a note if another line that is not blank follows. */
void cloud_note_trailing_lines(cloud_file *file);

/* ---- Binary data -------------------------------------------------------------------------------------------- */

typedef enum cloud_scalar_kind { CLOUD_SIGNED, CLOUD_UNSIGNED, CLOUD_FLOAT } cloud_scalar_kind;

/* The type of a binary number. */
typedef struct cloud_scalar {
    cloud_scalar_kind kind;
    unsigned size; /* size in bytes: 1, 2, 4 or 8; for a float 4 or 8 */
} cloud_scalar;

/* Reads an unsigned integer of 1 to 8 bytes. */
uint64_t cloud_read_bits(unsigned size, bool big_endian, const unsigned char *bytes);

/* Reads a number. Integers above 2^53 are rounded to doubles. */
double cloud_read_scalar(cloud_scalar type, bool big_endian, const unsigned char *bytes);

/* Adds a note if a byte at or after `offset` is not zero. Zeros are accepted, because some writers fill files up to
 * a whole page. */
void cloud_note_trailing_bytes(const cloud_file *file, size_t offset);

#endif
