/* SPDX-License-Identifier: MIT */
/* text.h - helpers for text: printing into memory, making foreign text printable, escaping for XML and Markdown,
 * plurals, base64. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A stream into memory. */
typedef struct text_stream {
    FILE *stream; /* null: out of memory */
    char *text;
    size_t size;
} text_stream;

bool text_stream_begin(text_stream *s);

/* Close the stream. *text becomes the printed text, which the caller frees, or null if nothing was printed. False: out
 * of memory. */
bool text_stream_end(text_stream *s, char **text);

/* U+FFFD, the replacement for bytes that are no valid UTF-8. */
#define UTF8_REPLACEMENT "\xef\xbf\xbd"

/* Returns the length in bytes of the non-ASCII character at `at`; 0 if it is not valid UTF-8. The text ends with a
 * zero. */
size_t utf8_sequence_length(const unsigned char *at);

/* True if the non-ASCII character at `at` must not be printed: a control character, a mark that changes the direction
 * of writing, a line separator, U+FFFE or U+FFFF. */
bool utf8_is_unprintable(const unsigned char *at);

/* Replace every character except printable ASCII, and every invalid byte, by a question mark. Returns `text`. */
char *make_printable(char *text);

/* Return the ending of a noun after a count ("" for 1, otherwise "s"), and of its verb ("s" for 1, otherwise ""). */
const char *plural_ending(uint64_t count);
const char *verb_ending(uint64_t count);

/* Printed lists end after LIST_LINES lines. Print the number of items beyond `shown` and how to list them. */
#define LIST_LINES 10
void print_remaining_count(FILE *out, uint64_t count, uint64_t shown, const char *how);

/* Returns the escaped form of the ASCII character *at of `text`, which may be stored in `room`; null: no escape needed.
 */
#define ESCAPE_ROOM 16
typedef const char *escape(const char *text, const char *at, char room[ESCAPE_ROOM]);

escape escape_nothing;  /* plain text, such as a line on a terminal */
escape escape_xml;      /* inside an attribute or an element */
escape escape_xml_text; /* inside an element, where lines may end */
escape escape_markdown; /* inside a line, a cell of a table, or an element of HTML */

/* Write UTF-8 text and escape its ASCII characters with `how`. Control characters that `how` does not escape,
 * characters that must not be printed, and invalid bytes become U+FFFD. */
void write_escaped(FILE *out, const char *text, escape *how);

/* Return the next line of a text, with its line end replaced by a zero, and move *at behind it. Returns null at the
 * end. */
char *text_cut_line(char **at);

/* Write the rest of `in` as base64 (RFC 4648), for data URLs. The caller checks both streams for errors. */
void base64_encode(FILE *in, FILE *out);

#endif
