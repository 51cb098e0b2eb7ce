/* SPDX-License-Identifier: MIT */
/* json_read.h - JSON objects from a text, by jansson; errors name the file, the line and the place in the object. */
#ifndef BASE_JSON_READ_H
#define BASE_JSON_READ_H

#include "error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A member of an object or an element of an array, in the place above it, as in points[3].velocity. The object at hand
 * is the null place. */
typedef struct json_place {
    const struct json_place *parent;
    const char *member; /* null: the element at index */
    size_t index;
} json_place;

/* Write "points[3].velocity", cut where it does not fit; "" for the null place. Returns `text`. */
const char *json_place_format(const json_place *place, char *text, size_t size);

/* jansson's json_loadb(), but null, and error->line -1, wherever there was no memory. */
json_t *json_parse(const char *text, size_t size, size_t flags, json_error_t *error);

/* Let json_parse() see all of jansson's allocations, once and before there are threads: where one fails and the next do
 * not, jansson (2.14) leaves a letter out of a long string and says nothing. */
void json_watch_memory(void);

/* A text that is read object by object. */
typedef struct json_reader {
    const char *name;              /* of the file, for errors */
    const char *at, *limit;        /* the object at hand, and the end of the text */
    size_t line;                   /* where the object begins, from 1 on */
    const struct json_member *row; /* whose value is read by a table: json_table.h */
    void *context;                 /* for functions that read values */
    octreel_error *error;
} json_reader;

/* Pass over blanks. False at the end of the text. */
bool json_next_object(json_reader *r);

/* Read the object at hand with `read`, and go past it. Numbers are doubles alone: -0 keeps its sign, and integers
 * end where doubles cease to hold each of them. `alone`: nothing may follow it. */
typedef bool json_object_reader(json_reader *r, json_t *object);
bool json_read_object(json_reader *r, bool alone, json_object_reader *read);

/* Every JSON reader keeps this whole number, and those below it, exactly: 2^53 - 1. */
#define JSON_LARGEST_WHOLE 9007199254740991

/* ---- Errors ------------------------------------------------------------------------------------------------- */

/* The end of a file's name that leaves room for a reason. */
const char *json_name_end(const char *name);

/* The line where a place begins; of one that is missing that of the nearest place above it. Cost: O(size). */
size_t json_line(const json_reader *r, const json_place *at);

/* Write the error about a place, a printf format, and return false. */
bool json_fail(json_reader *r, const json_place *at, const char *format, ...);

/* The same with another line than the place's. */
bool json_fail_line(json_reader *r, size_t line, const json_place *at, const char *format, ...);

/* Write "expected <what>, found <the value>" and return false. */
bool json_expected(json_reader *r, const json_t *value, const json_place *at, const char *what);

#endif
