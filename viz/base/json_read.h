/* SPDX-License-Identifier: MIT */
/* json_read.h - reads JSON objects with jansson. Errors name the file, the line and the place in the object. */
#ifndef BASE_JSON_READ_H
#define BASE_JSON_READ_H

#include "error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A place in the current object, such as points[3].velocity: a member or an element, and the place that contains it.
 * The current object itself is the null place. */
typedef struct json_place {
    const struct json_place *parent;
    const char *member; /* null: the element at index */
    size_t index;
} json_place;

/* Write a place as "points[3].velocity", cut to `size`; "" for the null place. Returns `text`. */
const char *json_place_format(const json_place *place, char *text, size_t size);

/* Call jansson's json_loadb(). When memory runs out, returns null with error->line -1; see
 * json_detect_failed_allocations(). */
json_t *json_parse(const char *text, size_t size, size_t flags, json_error_t *error);

/* Make json_parse() notice every failed allocation of jansson. Call it once, before any thread starts. Without it,
 * jansson 2.14 silently drops a letter of a long string if one allocation fails and the next one succeeds. */
void json_detect_failed_allocations(void);

/* Reads a text object by object. */
typedef struct json_reader {
    const char *name;              /* the file name in errors */
    const char *at, *limit;        /* the current object, and the end of the text */
    size_t line;                   /* the line where the object begins, counted from 1 */
    const struct json_member *row; /* the row whose value is being read; see json_table.h */
    void *context;                 /* for the caller's functions that read values */
    octreel_error *error;
} json_reader;

/* Skip whitespace before the next object. False: end of the text. */
bool json_skip_to_object(json_reader *r);

/* Read the current object with `read` and move past it. All numbers are read as doubles, so -0 keeps its sign and
 * integers are exact up to 2^53. `alone`: nothing may follow the object. */
typedef bool json_object_reader(json_reader *r, json_t *object);
bool json_read_object(json_reader *r, bool alone, json_object_reader *read);

/* The largest whole number that every JSON reader keeps exactly: 2^53 - 1. */
#define JSON_LARGEST_WHOLE 9007199254740991

/* ---- Errors ------------------------------------------------------------------------------------------------- */

/* Returns the end of a file name, short enough to leave room for a reason in an error. */
const char *json_shorten_name(const char *name);

/* Returns the line where a place begins, or the line of the nearest containing place if it is missing. Cost: O(size).
 */
size_t json_find_line(const json_reader *r, const json_place *at);

/* Write an error about a place with a printf format. Always returns false. */
bool json_fail(json_reader *r, const json_place *at, const char *format, ...);

/* Write an error with a given line number. Always returns false. */
bool json_fail_line(json_reader *r, size_t line, const json_place *at, const char *format, ...);

/* Write the error "expected WHAT, found VALUE". Always returns false. */
bool json_fail_expected(json_reader *r, const json_t *value, const json_place *at, const char *what);

#endif
