/* SPDX-License-Identifier: MIT */
/* json_values.c - the functions of jansson that are needed to read sessions and views, for WebAssembly.
 *
 * The problem: Debian has no jansson for WebAssembly, but every browser has a JSON parser. The idea: the page parses a
 * text with JSON.parse() and writes the value into one block of memory, in the form of the structures below. These
 * functions use jansson's own headers, so the code that reads sessions compiles unchanged. viewer/json_values.js is the
 * other half of this file. */
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct value {
    json_t json;
    union {
        double number;
        struct {
            size_t count; /* number of items of an array, members of an object, or bytes of a string */
            void *first;  /* first value of an array, first entry of an object, or bytes of a string */
        };
    };
} value;

typedef struct entry {
    value member;
    struct entry *next;
    char key[];
} entry;

_Static_assert(sizeof(value) == 16 && offsetof(entry, next) == 16 && offsetof(entry, key) == 20 &&
                   offsetof(json_error_t, position) == 8 && offsetof(json_error_t, text) == 92,
               "json_values.js writes these structures");

/* ---- Functions that the page provides ---------------------------------------------------------------------------- */

#define FROM_PAGE(name) __attribute__((import_module("page"), import_name(name)))

/* Parse a JSON text. If `alone` is true, bytes after the first value are an error. Returns the number of bytes of
 * memory that the value needs, and sets error->position to the end of the value in the text. If the text is not JSON,
 * returns 0 and sets the line and the reason in *error. */
FROM_PAGE("parse_json") size_t page_parse_json(const char *text, size_t size, bool alone, json_error_t *error);

/* Write the value that page_parse_json() parsed last to the memory at `to`. */
FROM_PAGE("write_json") void page_write_json(value *to);

/* ---- Functions of jansson ------------------------------------------------------------------------------------ */

/* Unlike jansson's function of this name, this one turns every number into a JSON_REAL, and always refuses an object
 * that has two members with the same name. */
json_t *json_loadb(const char *text, size_t size, size_t flags, json_error_t *error)
{
    const size_t bytes = page_parse_json(text, size, !(flags & JSON_DISABLE_EOF_CHECK), error);
    value *v = bytes ? malloc(bytes) : NULL;
    if (v)
        page_write_json(v);
    else if (bytes)
        error->line = -1; /* jansson reports lack of memory in the same way */
    return (json_t *)v;
}

/* Free a value. The value must have been returned by json_loadb(); it must not be a part of another value. */
void json_delete(json_t *json)
{
    free(json);
}

size_t json_array_size(const json_t *json)
{
    return json_is_array(json) ? ((const value *)json)->count : 0;
}

json_t *json_array_get(const json_t *json, size_t index)
{
    return index < json_array_size(json) ? (json_t *)((value *)((const value *)json)->first + index) : NULL;
}

size_t json_object_size(const json_t *json)
{
    return json_is_object(json) ? ((const value *)json)->count : 0;
}

void *json_object_iter(json_t *json)
{
    return json_object_size(json) > 0 ? ((value *)json)->first : NULL;
}

void *json_object_iter_next(json_t *json, void *iter)
{
    (void)json;
    return ((entry *)iter)->next;
}

const char *json_object_iter_key(void *iter)
{
    return iter ? ((entry *)iter)->key : NULL;
}

json_t *json_object_iter_value(void *iter)
{
    return iter;
}

void *json_object_key_to_iter(const char *key)
{
    return key ? (char *)key - offsetof(entry, key) : NULL;
}

json_t *json_object_get(const json_t *json, const char *key)
{
    entry *e = json_object_iter((json_t *)json);
    while (e && strcmp(e->key, key) != 0)
        e = e->next;
    return (json_t *)e;
}

const char *json_string_value(const json_t *json)
{
    return json_is_string(json) ? ((const value *)json)->first : NULL;
}

size_t json_string_length(const json_t *json)
{
    return json_is_string(json) ? ((const value *)json)->count : 0;
}

double json_real_value(const json_t *json)
{
    return json_is_real(json) ? ((const value *)json)->number : 0;
}

double json_number_value(const json_t *json)
{
    return json_real_value(json);
}
