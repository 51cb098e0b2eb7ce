/* SPDX-License-Identifier: MIT */
/* text.h - functions for text: printing into memory, making untrusted text printable, escaping for XML and Markdown,
 * plurals, and base64. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A stream that prints into memory. The struct must keep its address until text_stream_end(). */
typedef struct text_stream {
    FILE *stream; /* null: memory ran out */
    char *text;
    size_t size, room; /* `size` is set by text_stream_end() */
} text_stream;

bool text_stream_begin(text_stream *s);

/* Closes the stream. Sets *text to the printed text, which the caller frees, or to null if nothing was printed. If
 * memory has run out, sets *text to null and returns false. */
bool text_stream_end(text_stream *s, char **text);

/* U+FFFD, which replaces bytes that are not valid UTF-8. */
#define UTF8_REPLACEMENT "\xef\xbf\xbd"

/* Returns the length in bytes of the non-ASCII character at `at`, or 0 if the bytes are not valid UTF-8. The text is
 * zero-terminated. */
size_t utf8_sequence_length(const unsigned char *at);

/* Returns whether the non-ASCII character at `at` must not be printed. Such characters are control characters, marks
 * that change the direction of writing, line separators, U+FFFE and U+FFFF. */
bool utf8_is_unprintable(const unsigned char *at);

/* Replaces every character that is not printable ASCII, and every invalid byte, by a question mark. Returns `text`. */
char *make_printable(char *text);

/* plural_ending() returns the ending of a noun after a count: "" for 1, otherwise "s". verb_ending() returns the ending
 * of the verb after such a noun: "s" for 1, otherwise "". */
const char *plural_ending(uint64_t count);
const char *verb_ending(uint64_t count);

/* Printed lists end after LIST_LINES lines. print_remaining_count() then prints the number of items that are not shown,
 * and the text `how`, which explains how to list them. */
#define LIST_LINES 10
void print_remaining_count(FILE *out, uint64_t count, uint64_t shown, const char *how);

/* A function that escapes the ASCII character *at of `text`. Returns the escaped form, which may be stored in `room`.
 * Returns null if the character needs no escape. */
#define ESCAPE_ROOM 16
typedef const char *escape(const char *text, const char *at, char room[ESCAPE_ROOM]);

escape escape_nothing;            /* for plain text, such as a line on a terminal */
escape escape_xml_character;      /* for text in an XML attribute or element */
escape escape_xml_text;           /* for text in an XML element that may contain line ends */
escape escape_markdown_character; /* for text in a Markdown line, a table cell or an HTML element */

/* Writes UTF-8 text. `how` escapes ASCII characters of the text. Invalid bytes, unprintable characters, and control
 * characters that `how` does not escape become U+FFFD. */
void write_escaped(FILE *out, const char *text, escape *how);

/* Returns the next line of a text, and moves *at past the line. The line end is replaced by a zero byte. Returns null
 * at the end of the text. */
char *text_next_line(char **at);

/* Writes the rest of the stream `in` as base64 (RFC 4648), for data URLs. The caller checks both streams for errors. */
void base64_encode(FILE *in, FILE *out);

#endif
