/* SPDX-License-Identifier: MIT */
/* point_values.h - the values of points (colour, intensity, class), which are looked up by a point's id. The game does
 * not know values: an id keeps its values throughout a session, wherever its point moves. */
#ifndef SCENE_POINT_VALUES_H
#define SCENE_POINT_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum point_value_kind { POINT_COLOR, POINT_INTENSITY, POINT_CLASS, POINT_VALUE_KINDS } point_value_kind;

/* The values of one point: 12 bytes without padding. Missing values are zero. */
typedef struct point_value {
    float intensity; /* finite; the unit is that of the file */
    uint16_t class;  /* the point's classification: in LAS files 2 is ground and 6 a building, in other files any number
                      */
    unsigned char color[3]; /* red, green, blue */
    bool has[POINT_VALUE_KINDS];
} point_value;

/* A table of the values of many points: 12 bytes per point if ids are dense, else 20. A zeroed table is empty. */
typedef struct point_values {
    point_value *rows; /* owned */
    size_t count;      /* the number of rows; 0 if no point has a value */
    uint64_t first;    /* if `ids` is null, row n holds the values of id first + n */
    uint64_t *ids;     /* if not null: the id of each row, ascending; owned */
    unsigned kinds;    /* the kinds of values that rows have, as bits 1 << point_value_kind */
    size_t room, id_room;
} point_values;

/* An id with its values, from which a table is built. */
typedef struct point_entry {
    uint64_t id;
    point_value value;
} point_entry;

/* Returns the row of an id, or null. `v` may be null. Cost: O(1) if ids are dense, else O(log n). */
const point_value *point_values_find_row(const point_values *v, uint64_t id);

/* Returns all values of an id; they are zero if it has none. `v` may be null. */
point_value point_values_get(const point_values *v, uint64_t id);

/* Returns the kinds of values that any point has, as bits 1 << point_value_kind. `v` may be null. */
static inline unsigned point_values_kinds(const point_values *v)
{
    return v ? v->kinds : 0;
}

/* True if a point has any value. */
bool point_value_has_any(const point_value *value);
bool point_value_equals(const point_value *a, const point_value *b);

/* Append a row, which may be without values. False when out of memory: the rows are then unchanged. */
bool point_values_append_row(point_values *v, const point_value *value);

/* Insert a row without values before row `at`, which is at most v->count. The ids must be dense. False when out of
 * memory. */
bool point_values_insert_empty_row(point_values *v, size_t at);

/* Add entries in any order. Their ids must not have rows yet. False when out of memory: *v is then unchanged. Cost: O(n
 * log n) for n entries and rows together; O(entries) if their ids follow the last row. */
bool point_values_add_entries(point_values *v, const point_entry *entries, size_t count);

/* Free all memory and empty the table. */
void point_values_release(point_values *v);

#endif
