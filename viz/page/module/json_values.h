/* SPDX-License-Identifier: MIT */
/* json_values.h - values of JSON as json_subset.c reads them. Private to this folder. */
#ifndef WEB_JSON_VALUES_H
#define WEB_JSON_VALUES_H

#include <jansson.h>
#include <stddef.h>

/* A part of an arena; the value that json_loadb() returns is at the start of its first. */
typedef struct chunk {
    struct chunk *next;
    size_t room, used;
    double aligned[]; /* bytes follow */
} chunk;

typedef struct real {
    json_t json;
    double value;
} real;

typedef struct string {
    json_t json;
    const char *text;
} string;

typedef struct array {
    json_t json;
    json_t **items;
    size_t count;
} array;

typedef struct entry {
    json_t *value;
    struct entry *next;
    char key[];
} entry;

typedef struct object {
    json_t json;
    entry *first;
    size_t count;
} object;

/* Free the chunks from this one on. */
void json_free_arena(chunk *first);

#endif
