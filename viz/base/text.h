/* SPDX-License-Identifier: MIT */
/* text.h - text printed into memory, foreign text made printable or escaped for a markup language, plurals, and
 * base64. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A stream into memory. */
typedef struct text_stream {
    FILE *stream; /* null where there is no memory */
    char *text;
    size_t size;
} text_stream;

bool text_stream_begin(text_stream *s);

/* *text becomes what was printed, which the caller frees; null where that is nothing. False where there was no memory.
 */
bool text_stream_end(text_stream *s, char **text);

/* U+FFFD, which stands for bytes that are no UTF-8. */
#define UTF8_REPLACEMENT "\xef\xbf\xbd"

/* The bytes of the character beyond ASCII at `at`, 0 when there is none. The final zero ends every character. */
size_t utf8_length(const unsigned char *at);

/* Whether the character beyond ASCII there is none to show: control characters, marks that turn the direction of what
 * follows, ends of lines, and the two that are no characters. */
bool utf8_is_unprintable(const unsigned char *at);

/* Put a question mark in the place of every character of UTF-8, and of every byte that is of none, that is not
 * printable ASCII. Returns `text`. */
char *make_printable(char *text);

/* The end of a noun behind a count, "s" or "" for 1; and of its verb, "" or "s" for 1: "1 frame differs". */
const char *plural(uint64_t count);
const char *plural_verb(uint64_t count);

/* A list for people ends after so many lines: the next says how many there are beyond `shown`, and how to see all. */
#define LIST_LINES 10
void print_remaining_count(FILE *out, uint64_t count, uint64_t shown, const char *how);

/* What the character *at of `text` is written as; `room` may take it. Null: as it is. */
#define ESCAPE_ROOM 16
typedef const char *escape(const char *text, const char *at, char room[ESCAPE_ROOM]);

escape escape_nothing;  /* in a line for people, say on a terminal */
escape escape_xml;      /* inside an attribute or an element */
escape escape_xml_text; /* inside an element, where lines may end */
escape escape_markdown; /* inside a line, a cell of a table, or an element of HTML */

/* Write UTF-8 in which each character of ASCII is written as the escape says. Control characters it leaves as they are,
 * what is unfit and what is no UTF-8 become U+FFFD. */
void write_escaped(FILE *out, const char *text, escape *how);

/* Write what was printed into a stream of text, and end it. False where there was no memory. */
bool write_escaped_stream(FILE *out, text_stream *s, escape *how);

/* All that is left of `in` in base64 (RFC 4648), for addresses that hold their data. Errors stay with the streams. */
void base64_copy(FILE *in, FILE *out);

#endif
