/* SPDX-License-Identifier: MIT */
/* json_write.h - writes JSON to a stream, value by value. Commas are written automatically.
 *
 * Numbers are the shortest text that reads back to the same double, whatever the locale. Everything is on one line,
 * except where json_start_new_line() is called. Errors stay with the stream: check ferror() or fclose() at the end. To
 * write into memory, use open_memstream().
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
    bool comma;                    /* write a comma before the next value or key */
    bool newline;                  /* write a line end before the next value, key or end */
    const struct json_member *row; /* the row whose value is being written; see json_table.h */
    const void *context;           /* for the caller's functions that write values */
} json_writer;

void json_write_begin_object(json_writer *writer);
void json_write_end_object(json_writer *writer);
void json_write_begin_array(json_writer *writer);
void json_write_end_array(json_writer *writer);

/* Write the name of an object's next value. */
void json_write_key(json_writer *writer, const char *key);

/* Write UTF-8. Bytes that are no valid UTF-8 become U+FFFD. */
void json_write_string(json_writer *writer, const char *text);

/* NaN and infinities, which JSON does not have, are written as null. */
void json_write_number(json_writer *writer, double value);
void json_write_integer(json_writer *writer, uint64_t value);
void json_write_bool(json_writer *writer, bool value);
void json_write_null(json_writer *writer);

/* Write several numbers, faster than one by one: as elements of a begun array, or as a whole array. */
void json_write_elements(json_writer *writer, const double *values, size_t count);
void json_write_numbers(json_writer *writer, const double *values, size_t count);

/* Write a member of an object: its key and value. A vector is an array of three numbers, a box an object with two
 * corners. */
void json_write_integer_member(json_writer *writer, const char *key, uint64_t value);
void json_write_number_member(json_writer *writer, const char *key, double value);
void json_write_bool_member(json_writer *writer, const char *key, bool value);
void json_write_text_member(json_writer *writer, const char *key, const char *text);
void json_write_vector_member(json_writer *writer, const char *key, const double vector[3]);
void json_write_box_member(json_writer *writer, const char *key, const octree_box *box);
void json_begin_object_member(json_writer *writer, const char *key);
void json_begin_array_member(json_writer *writer, const char *key);

/* Write a line end before the next value, key or end. */
void json_start_new_line(json_writer *writer);

/* End the line after a complete value. The next value starts a new text. */
void json_write_end_line(json_writer *writer);

#endif
