/* SPDX-License-Identifier: MIT */
/* cloud_format.h - the interface of a cloud format, and the tools that all readers share: the file in memory, its lines
 * and words, its binary numbers, the growing result, and errors. Private to cloud*.c.
 *
 * cloud.h says how to add a format.
 */
#ifndef CLOUDS_CLOUD_FORMAT_H
#define CLOUDS_CLOUD_FORMAT_H

#include "cloud.h"

#include <stdint.h>

/* The meaning of a column, field or property of the file. */
typedef enum cloud_channel {
    CLOUD_X,
    CLOUD_Y,
    CLOUD_Z,
    CLOUD_RED,
    CLOUD_GREEN,
    CLOUD_BLUE,
    CLOUD_PACKED, /* a colour as one integer, 0xRRGGBB; higher bits are ignored */
    CLOUD_INTENSITY,
    CLOUD_CLASS,
    CLOUD_CHANNELS
} cloud_channel;

/* Characters of the file from `begin` to the exclusive `limit`. */
typedef struct cloud_span {
    const char *begin, *limit;
} cloud_span;

/* A cursor over the lines of a file. Lines end as the first one does: \n, \r\n, or \r alone. */
typedef struct cloud_lines {
    const char *at, *limit;
    char terminator;
    size_t number; /* the number of the last line read, from 1 on */
} cloud_lines;

/* A file that is being read, with the destinations of its points and of its error. */
typedef struct cloud_file {
    const char *name;
    const unsigned char *bytes;
    size_t size; /* at least 1 */
    cloud_lines lines;
    cloud *out;
    octreel_error *error;
    const cloud_watch *watch; /* may be null */
    size_t room, row_room;    /* capacities of out->positions and out->rows */
    unsigned channels;        /* bits 1 << cloud_channel: the values of each point beside x, y and z */
    bool zero_is_missing;     /* a value that is zero in every point is missing */
} cloud_file;

typedef struct cloud_format {
    bool (*recognise)(cloud_file *file); /* true if the contents are certainly of this format; may be null */
    bool (*parse)(cloud_file *file);     /* read the whole file into file->out; on false the error is set */
} cloud_format;

#define CLOUD_FORMAT_EXTERN(id, names, endings) extern const cloud_format cloud_##id;
CLOUD_FORMAT_MAP(CLOUD_FORMAT_EXTERN)
#undef CLOUD_FORMAT_EXTERN
extern const cloud_format cloud_text; /* has no recognise(); reads any text */

/* True if the first line that is neither a comment nor a header contains a point. */
bool cloud_text_is_recognised(cloud_file *file);

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* Call before the first point: `channels` (bits) are the values of each point. `full` (1 or 255) is the assumed full
 * scale of colour channels; a larger channel in the file raises it, and colours read before are rescaled. */
void cloud_set_channels(cloud_file *file, unsigned channels, unsigned full);

/* Convert numbers[CLOUD_CHANNELS] to the values of a point. */
point_value cloud_convert_values(cloud_file *file, const double *numbers);

/* Discard the values read so far; points that follow have none. */
void cloud_discard_values(cloud_file *file);

/* Call after the last point. */
void cloud_finish_values(cloud_file *file);

/* Reserve room for `count` points; the caller has checked that the file contains them. Returns false if memory runs
 * out. */
bool cloud_reserve(cloud_file *file, uint64_t count);

/* Reserve room for a count that the file announces, of points with `columns` numbers of at least one byte each.
 * Reserves no more than the file's size can hold. */
bool cloud_reserve_announced(cloud_file *file, uint64_t count, uint64_t columns);

/* Append a point from numbers[CLOUD_CHANNELS]: x, y, z and the file's channels are read. A point whose position is not
 * finite is skipped instead. Returns false if memory runs out. */
bool cloud_add_point(cloud_file *file, const double *numbers);

/* Count a skipped point. `why` has static storage and is the same for all points of a file. */
void cloud_count_skipped(const cloud_file *file, const char *why);

/* Skip a point if its position is not finite; returns whether it was skipped. */
bool cloud_skip_nonfinite(const cloud_file *file, const double *position);

/* Report the progress `done` of `total` on every 65536th call. `calls` is the number of calls so far. */
void cloud_report_progress(const cloud_file *file, uint64_t calls, uint64_t done, uint64_t total);

/* Set the error from a printf format and return false. It names the file and the last line read, a byte (from 0), or no
 * place if `unit` is null. */
#define cloud_fail(file, ...) cloud_fail_at(file, NULL, 0, __VA_ARGS__)
#define cloud_fail_line(file, ...) cloud_fail_at(file, "", (file)->lines.number, __VA_ARGS__)
#define cloud_fail_byte(file, offset, ...) cloud_fail_at(file, "byte ", offset, __VA_ARGS__)
bool cloud_fail_at(const cloud_file *file, const char *unit, size_t number, const char *format, ...);

/* Turn an error in data after the last point into the cloud's note, unless it has a note already. Returns true. */
bool cloud_turn_error_into_note(const cloud_file *file);

/* ---- Lines and words ---------------------------------------------------------------------------------------- */

/* Move the cursor before the first line. */
void cloud_rewind_lines(cloud_file *file);

/* Read the next line without its terminator. Returns false at the end of the file. */
bool cloud_read_next_line(cloud_file *file, cloud_span *line);

/* Read the next line that is not blank. */
bool cloud_read_nonblank_line(cloud_file *file, cloud_span *line);

bool cloud_is_blank(char c);

/* Remove the first word from a line; blanks and tabs separate words. Returns false if there is none. */
bool cloud_read_word(cloud_span *line, cloud_span *word);

bool cloud_word_equals(cloud_span word, const char *text);

/* Returns the index of a word in a list whose words are separated by blanks, or -1. */
int cloud_find_word_in_list(cloud_span word, const char *list);

/* Returns the channel of this name, or -1. x, y and z must be lower case; other names may have any case. */
int cloud_find_channel(cloud_span word);

/* Parse a whole word as an integer from 0 to 2^64 - 1. */
bool cloud_parse_count(cloud_span word, uint64_t *count);

/* Parse a whole word as a coordinate; "nan" and "inf" give NaN. On failure, the error names the last line read. */
bool cloud_parse_coordinate(const cloud_file *file, cloud_span word, double *coordinate);

/* Parse a whole word as a value of a channel. A packed colour is an integer, or the float with the same bits. */
bool cloud_parse_channel(const cloud_file *file, cloud_span word, int channel, double *number);

/* Size of a quoted word with its final zero. */
#define CLOUD_QUOTE 48

/* Quote a word for an error: unprintable bytes are escaped, long words are shortened. Returns `text`. */
const char *cloud_quote_word(cloud_span word, char text[CLOUD_QUOTE]);

/* Set the error "'WORD' REASON" for the last line read. Returns false. */
bool cloud_fail_at_word(const cloud_file *file, cloud_span word, const char *reason);

/* Returns false, with an error, if the file contains a NUL byte and so is not text. */
bool cloud_check_text(const cloud_file *file);

/* Add a note if another line follows that is not blank. */
void cloud_note_trailing_lines(cloud_file *file);

/* ---- Binary data -------------------------------------------------------------------------------------------- */

typedef enum cloud_scalar_kind { CLOUD_SIGNED, CLOUD_UNSIGNED, CLOUD_FLOAT } cloud_scalar_kind;

/* The type of a binary number. */
typedef struct cloud_scalar {
    cloud_scalar_kind kind;
    unsigned size; /* bytes: 1, 2, 4 or 8; of a float 4 or 8 */
} cloud_scalar;

/* Read an unsigned integer of `size` (1 to 8) bytes. */
uint64_t cloud_read_bits(unsigned size, bool big_endian, const unsigned char *bytes);

/* Read a number; integers beyond 2^53 are rounded. */
double cloud_read_scalar(cloud_scalar type, bool big_endian, const unsigned char *bytes);

/* Add a note if a byte from `offset` on is not zero. Zeros are accepted: some writers pad files to a whole page. */
void cloud_note_trailing_bytes(const cloud_file *file, size_t offset);

#endif
