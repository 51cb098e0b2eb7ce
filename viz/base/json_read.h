/* SPDX-License-Identifier: MIT */
/* json_read.h - reads JSON objects with jansson. An error message names the file, the line and the place in the
 * object. */
#ifndef BASE_JSON_READ_H
#define BASE_JSON_READ_H

#include "error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A place in the current object, such as points[3].velocity. The place is a member or an element, and its parent is the
 * place that contains it. A null pointer means the current object itself. */
typedef struct json_place {
    const struct json_place *parent;
    const char *member; /* name of the member; null: the place is the element with the index `index` */
    size_t index;
} json_place;

/* Writes a place as "points[3].velocity", cut to `size` bytes. A null place is written as "". Returns `text`. */
const char *json_place_format(const json_place *place, char *text, size_t size);

/* Calls jansson's json_loadb(). If memory runs out, returns null and sets error->line to -1; see
 * json_detect_failed_allocations(). */
json_t *json_parse(const char *text, size_t size, size_t flags, json_error_t *error);

/* Makes json_parse() notice every failed allocation of jansson. Must be called once, before any thread starts. Without
 * this call, jansson 2.14 silently drops a character of a long string if one allocation fails and the next allocation
 * succeeds. */
void json_detect_failed_allocations(void);

/* Reads a JSON text object by object. */
typedef struct json_reader {
    const char *name;              /* the file's name for error messages */
    const char *at, *limit;        /* the start of the current object, and the end of the text */
    size_t line;                   /* the number of the line in which the current object begins; the first line is 1 */
    const struct json_member *row; /* the table row of the member that is being read; see json_table.h */
    void *context;                 /* passed to the caller's functions that read values */
    octreel_error *error;
} json_reader;

/* Skips whitespace before the next object. Returns false at the end of the text. */
bool json_skip_to_object(json_reader *r);

/* Reads the current object with `read`. If `alone` is true, text after the object is an error; otherwise the reader
 * moves past the object. All numbers are read as doubles: -0 keeps its sign, and integers are exact up to 2^53. */
typedef bool json_object_reader(json_reader *r, json_t *object);
bool json_read_object(json_reader *r, bool alone, json_object_reader *read);

/* 2^53 - 1: every JSON reader reads whole numbers up to this number exactly. */
#define JSON_LARGEST_WHOLE 9007199254740991

/* ---- Errors ------------------------------------------------------------------------------------------------- */

/* Returns the end of a file name. The returned part is short enough to leave room for a reason in an error message. */
const char *json_shorten_name(const char *name);

/* Returns the line in which a place begins. If the place is missing from the text, returns the line of the nearest
 * place that contains it. Cost: O(size of the object's text). */
size_t json_find_line(const json_reader *r, const json_place *at);

/* Writes an error about a place from a printf format. Always returns false. */
bool json_fail(json_reader *r, const json_place *at, const char *format, ...);

/* Writes an error about a place with a given line number. Always returns false. */
bool json_fail_line(json_reader *r, size_t line, const json_place *at, const char *format, ...);

/* Writes the error "expected WHAT, found VALUE". Always returns false. */
bool json_fail_expected(json_reader *r, const json_t *value, const json_place *at, const char *what);

#endif
