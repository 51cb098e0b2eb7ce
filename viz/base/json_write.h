/* SPDX-License-Identifier: MIT */
/* json_write.h - JSON onto a stream, value after value; commas are put where they belong.
 *
 * Numbers are the shortest that read back to the same double, whatever the locale. Everything stays on one line but
 * where json_write_newline() is called. Errors stay with the stream: ask ferror() or fclose() at the end. For text in
 * memory give it a stream of open_memstream().
 */
#ifndef BASE_JSON_WRITE_H
#define BASE_JSON_WRITE_H

#include "octree/types.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Start as {.out = stream}. The caller pairs begin with end, and in an object each value with a key. */
typedef struct json_writer {
    FILE *out;
    bool comma;                    /* one is due before the next value or key */
    bool newline;                  /* one is due before the next value, key or end */
    const struct json_member *row; /* whose value is written by a table: json_table.h */
    const void *context;           /* of whoever writes */
} json_writer;

void json_write_begin_object(json_writer *writer);
void json_write_end_object(json_writer *writer);
void json_write_begin_array(json_writer *writer);
void json_write_end_array(json_writer *writer);

/* The name of an object's next value: text as for json_write_string(). */
void json_write_key(json_writer *writer, const char *key);

/* UTF-8 is passed through; a byte that belongs to none becomes U+FFFD. */
void json_write_string(json_writer *writer, const char *text);

/* A NaN or an infinity, for which JSON has no word, is written as null. */
void json_write_number(json_writer *writer, double value);
void json_write_integer(json_writer *writer, uint64_t value);
void json_write_bool(json_writer *writer, bool value);
void json_write_null(json_writer *writer);

/* Numbers one after the other, in less time; and as an array. */
void json_write_elements(json_writer *writer, const double *values, size_t count);
void json_write_numbers(json_writer *writer, const double *values, size_t count);

/* A member of an object: its key and its value. A vector is three numbers, a box an object of its corners. */
void json_member_integer(json_writer *writer, const char *key, uint64_t value);
void json_member_number(json_writer *writer, const char *key, double value);
void json_member_bool(json_writer *writer, const char *key, bool value);
void json_member_text(json_writer *writer, const char *key, const char *text);
void json_member_vector(json_writer *writer, const char *key, const double vector[3]);
void json_member_box(json_writer *writer, const char *key, const octree_box *box);
void json_member_begin_object(json_writer *writer, const char *key);
void json_member_begin_array(json_writer *writer, const char *key);

/* What comes next, the end of an array or object too, begins a new line. */
void json_write_newline(json_writer *writer);

/* End the line after a value that stands alone, as the objects of a stream do; the next one starts afresh. */
void json_write_end_line(json_writer *writer);

#endif
