/* SPDX-License-Identifier: MIT */
/* point_values.h - the values of points (colour, intensity, class), which are looked up by a point's id. The game
 * itself has no values: a point keeps the values of its id throughout a session, wherever the point moves. */
#ifndef SCENE_POINT_VALUES_H
#define SCENE_POINT_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum point_value_kind { POINT_COLOR, POINT_INTENSITY, POINT_CLASS, POINT_VALUE_KINDS } point_value_kind;

/* The values of one point: 12 bytes without padding. Missing values are zero. */
typedef struct point_value {
    float intensity;        /* the intensity: a finite number, in the unit of the point file */
    uint16_t class;         /* the class: in LAS files 2 means ground and 6 a building; in other files any number */
    unsigned char color[3]; /* red, green, blue */
    bool has[POINT_VALUE_KINDS];
} point_value;

/* A table of the values of many points. A point takes 12 bytes if the ids have few gaps, else 20 bytes. A zeroed table
 * is empty. */
typedef struct point_values {
    point_value *rows; /* one row for each point; owned by the table */
    size_t count;      /* the number of rows; 0 if no point has a value */
    uint64_t first;    /* if `ids` is null, row n holds the values of id first + n */
    uint64_t *ids;     /* the id of each row, in ascending order; owned by the table; null: ids are consecutive */
    unsigned kinds;    /* the kinds of values that some row has, as bits 1 << point_value_kind */
    size_t room, id_room;
} point_values;

/* An id with its values, from which a table is built. */
typedef struct point_entry {
    uint64_t id;
    point_value value;
} point_entry;

/* Returns the row of an id, or null if the id has no row. `v` may be null. Cost: O(1) if ids are consecutive, else
 * O(log n). */
const point_value *point_values_find_row(const point_values *v, uint64_t id);

/* Returns all values of an id; the values are zero if the id has none. `v` may be null. */
point_value point_values_get(const point_values *v, uint64_t id);

/* Returns the kinds of values that some point has, as bits 1 << point_value_kind. `v` may be null. */
static inline unsigned point_values_kinds(const point_values *v)
{
    return v ? v->kinds : 0;
}

/* Returns whether a point has any value. */
bool point_value_has_any(const point_value *value);
bool point_value_equals(const point_value *a, const point_value *b);

/* Append a row, which may be without values. Returns false and leaves the rows unchanged if memory runs out. */
bool point_values_append_row(point_values *v, const point_value *value);

/* Insert a row without values before the row with the index `at`, which is at most v->count. The table's ids must be
 * consecutive. Returns false if memory runs out. */
bool point_values_insert_empty_row(point_values *v, size_t at);

/* Add entries in any order. Their ids must not have rows yet. Returns false and leaves *v unchanged if memory runs out.
 * Cost: O(n log n) for n entries and rows together; O(entries) if the entries' ids follow the last row. */
bool point_values_add_entries(point_values *v, const point_entry *entries, size_t count);

/* Free all memory and empty the table. */
void point_values_release(point_values *v);

#endif
