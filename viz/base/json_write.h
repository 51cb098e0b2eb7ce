/* SPDX-License-Identifier: MIT */
/* json_write.h - writes JSON to a stream, value by value. Commas are written automatically.
 *
 * A number is written as the shortest text that reads back to the same double, in any locale. All text is on one line,
 * except where json_start_new_line() is called. Write errors are stored in the stream: the caller checks ferror() or
 * fclose() at the end. To write into memory, use a text_stream.
 */
#ifndef BASE_JSON_WRITE_H
#define BASE_JSON_WRITE_H

#include "octree/types.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A writer is initialized as {.out = stream}. The caller ends every array and object that it begins, and in an object
 * writes a key before each value. */
typedef struct json_writer {
    FILE *out;
    bool comma;                    /* true: a comma precedes the next value or key */
    bool newline;                  /* true: a line end precedes the next value, key or closing bracket */
    const struct json_member *row; /* the table row of the member that is being written; see json_table.h */
    const void *context;           /* passed to the caller's functions that write values */
} json_writer;

void json_write_begin_object(json_writer *writer);
void json_write_end_object(json_writer *writer);
void json_write_begin_array(json_writer *writer);
void json_write_end_array(json_writer *writer);

/* Writes the key of the next value in an object. */
void json_write_key(json_writer *writer, const char *key);

/* Writes UTF-8 text as a string. Bytes that are not valid UTF-8 become U+FFFD. */
void json_write_string(json_writer *writer, const char *text);

/* Writes a number. NaN and infinities, which JSON cannot represent, are written as null. */
void json_write_number(json_writer *writer, double value);
void json_write_integer(json_writer *writer, uint64_t value);
void json_write_bool(json_writer *writer, bool value);
void json_write_null(json_writer *writer);

/* Write several numbers. One call is faster than many calls of json_write_number(). json_write_elements() writes them
 * as elements of an array that the caller has begun. json_write_numbers() writes a whole array. */
void json_write_elements(json_writer *writer, const double *values, size_t count);
void json_write_numbers(json_writer *writer, const double *values, size_t count);

/* Write a member of an object: its key and its value. A vector is written as an array of three numbers, a box as an
 * object with two corners. */
void json_write_integer_member(json_writer *writer, const char *key, uint64_t value);
void json_write_number_member(json_writer *writer, const char *key, double value);
void json_write_bool_member(json_writer *writer, const char *key, bool value);
void json_write_text_member(json_writer *writer, const char *key, const char *text);
void json_write_vector_member(json_writer *writer, const char *key, const double vector[3]);
void json_write_box_member(json_writer *writer, const char *key, const octree_box *box);
void json_begin_object_member(json_writer *writer, const char *key);
void json_begin_array_member(json_writer *writer, const char *key);

/* Writes a line end before the next value, key or closing bracket. */
void json_start_new_line(json_writer *writer);

/* Ends the line after a complete value. The next value begins a new JSON text. */
void json_write_end_line(json_writer *writer);

#endif
