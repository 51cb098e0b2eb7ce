/* SPDX-License-Identifier: MIT */
/* cloud_format.h - the formats of point clouds, and what their readers share: the file in memory, its lines and words,
 * its binary numbers, the growing result and the sentence of an error. Private to cloud*.c.
 *
 * To add a format: a row of CLOUD_FORMAT_MAP, a file cloud_NAME.c that defines `const cloud_format cloud_NAME`, and its
 * test.
 */
#ifndef CLOUDS_CLOUD_FORMAT_H
#define CLOUDS_CLOUD_FORMAT_H

#include "cloud.h"

#include <stdint.h>

/* What a number of a point is: a column, field or property of a file. */
typedef enum cloud_channel {
    CLOUD_X,
    CLOUD_Y,
    CLOUD_Z,
    CLOUD_RED,
    CLOUD_GREEN,
    CLOUD_BLUE,
    CLOUD_PACKED, /* a colour in one whole number: 0xRRGGBB, above it what is passed over */
    CLOUD_INTENSITY,
    CLOUD_CLASS,
    CLOUD_CHANNELS
} cloud_channel;

/* A file being read, where its points go and where its error goes. */
typedef struct cloud_file {
    const char *name;
    const unsigned char *bytes;
    size_t size; /* at least 1 */
    cloud *out;
    octreel_error *error;
    const cloud_watch *watch; /* may be null */
    size_t room, row_room;    /* of out->positions and out->rows */
    unsigned channels;        /* bits 1 << cloud_channel: what the points have beside x, y and z */
    bool zero_is_none;        /* values that are zero in every point are none */
} cloud_file;

/* Each format, in the order in which they are tried; the last takes what no other recognises. */
#define CLOUD_FORMAT_MAP(X)                                                                                            \
    X(las)                                                                                                             \
    X(pcd)                                                                                                             \
    X(ply)                                                                                                             \
    X(text)

typedef struct cloud_format {
    const char *name, *ending;                 /* "PLY", ".ply"; the ending may be null */
    bool (*recognise)(const cloud_file *file); /* whether the contents say that it is this format; may be null */
    bool (*parse)(cloud_file *file);           /* read the whole file into file->out; false with the error written */
} cloud_format;

#define CLOUD_FORMAT_EXTERN(name) extern const cloud_format cloud_##name;
CLOUD_FORMAT_MAP(CLOUD_FORMAT_EXTERN)
#undef CLOUD_FORMAT_EXTERN

/* Whether the first line of a text that is no comment or header holds a point. */
bool cloud_text_begins(const cloud_file *file);

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* Say which channels the points have, before the first: bits. Colours of three channels begin with a full channel of
 * `full`, 1 or 255; it grows with what the file turns out to hold, and the colours before are then what they should be.
 */
void cloud_begin_values(cloud_file *file, unsigned channels, unsigned full);

/* The values that numbers[CLOUD_CHANNELS] are. */
point_value cloud_value_of(cloud_file *file, const double *numbers);

/* Forget the values that were read; none follow. */
void cloud_drop_values(cloud_file *file);

/* After the last point. */
void cloud_end_values(cloud_file *file);

/* Make room for so many points, of which the caller knows that they are there; or for as many as may be, where each has
 * so many columns or properties, of a byte at least. False when there is no memory. */
bool cloud_expect(cloud_file *file, uint64_t count);
bool cloud_expect_rows(cloud_file *file, uint64_t count, uint64_t columns);

/* Append a point, numbers[CLOUD_CHANNELS], of which x, y, z and the file's channels are read; one whose position is not
 * finite is skipped instead. False when there is no memory. */
bool cloud_add(cloud_file *file, const double *numbers);

/* Pass over a point of the file; `why` is a constant, the same for all of a file. */
void cloud_skip(const cloud_file *file, const char *why);

/* Pass over a point whose position is not finite: whether it is one. */
bool cloud_skips(const cloud_file *file, const double *position);

/* Report at each 65536th call that `done` of `total` have been read. `times` counts the calls. */
void cloud_tell(const cloud_file *file, uint64_t times, uint64_t done, uint64_t total);

/* Write the error's sentence, a printf format, and return false: for the file, a line from 1 on, a byte from 0 on. */
bool cloud_fail(const cloud_file *file, const char *format, ...);
bool cloud_fail_line(const cloud_file *file, size_t line, const char *format, ...);
bool cloud_fail_byte(const cloud_file *file, size_t offset, const char *format, ...);

/* Turn the error that was written, of something that comes after the last point, into the cloud's note, unless it has
 * one. Returns true. */
bool cloud_forgive(const cloud_file *file);

/* ---- Lines and words ---------------------------------------------------------------------------------------- */

/* Characters of the file, from begin up to limit. */
typedef struct cloud_span {
    const char *begin, *limit;
} cloud_span;

/* A cursor over the lines of a file. Lines end as the first one does: \n, \r\n, or \r alone. */
typedef struct cloud_lines {
    const char *at, *limit;
    char terminator;
    size_t number; /* of the line given last, from 1 on */
} cloud_lines;

cloud_lines cloud_lines_of(const cloud_file *file);

/* The next line without its end. False at the end of the file. */
bool cloud_next_line(cloud_lines *lines, cloud_span *line);

/* The next line with a word in it. */
bool cloud_next_filled_line(cloud_lines *lines, cloud_span *line);

bool cloud_is_blank(char c);

/* Cut the next word, between blanks and tabs, off the front of a line. False when there is none. */
bool cloud_next_word(cloud_span *line, cloud_span *word);

bool cloud_word_is(cloud_span word, const char *text);

/* The channel that a word names, x y z as they are and others in any case; -1 for none. */
int cloud_word_channel(cloud_span word);

/* Read a whole word as a count, 0 to 2^64 - 1. */
bool cloud_word_count(cloud_span word, uint64_t *count);

/* Read a whole word as a coordinate; "nan" and "inf" give NaN. False with an error for the line. */
bool cloud_word_coordinate(const cloud_file *file, size_t line, cloud_span word, double *coordinate);

/* The same for any channel; a packed colour may be a whole number or the float of the same bits. */
bool cloud_word_number(const cloud_file *file, size_t line, cloud_span word, int channel, double *number);

/* Room for a quoted word. */
#define CLOUD_QUOTE 48

/* A word fit for an error's sentence: printable, in quotes, and cut when it is long. Returns `text`. */
const char *cloud_quote(cloud_span word, char text[CLOUD_QUOTE]);

/* Write the error "'word' reason" for a line, and return false. */
bool cloud_fail_word(const cloud_file *file, size_t line, cloud_span word, const char *reason);

/* False with an error when the file holds a NUL byte: it is then no text. */
bool cloud_check_text(const cloud_file *file);

/* Note it when a line with words follows. */
void cloud_note_lines(const cloud_file *file, cloud_lines *lines);

/* ---- Binary data -------------------------------------------------------------------------------------------- */

typedef enum cloud_scalar_kind { CLOUD_SIGNED, CLOUD_UNSIGNED, CLOUD_FLOAT } cloud_scalar_kind;

/* A type of binary numbers. */
typedef struct cloud_scalar {
    cloud_scalar_kind kind;
    unsigned size; /* 1, 2, 4 or 8 bytes; floats are of 4 or 8 */
} cloud_scalar;

/* The whole number of 1 to 8 bytes at `bytes`. */
uint64_t cloud_bits_read(unsigned size, bool big_endian, const unsigned char *bytes);

/* The number at `bytes`; integers beyond 2^53 are rounded. */
double cloud_scalar_read(cloud_scalar type, bool big_endian, const unsigned char *bytes);

/* Note it when anything but zero bytes follows from `offset` on: some writers pad to a whole page. */
void cloud_note_bytes(const cloud_file *file, size_t offset);

#endif
