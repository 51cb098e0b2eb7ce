/* SPDX-License-Identifier: MIT */
/* point_values.h - the values of points (colour, intensity, class), found by a point's id.
 *
 * The game does not know values: an id keeps its values through a session, wherever its point moves.
 */
#ifndef SCENE_POINT_VALUES_H
#define SCENE_POINT_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum point_value_kind { POINT_COLOR, POINT_INTENSITY, POINT_CLASS, POINT_VALUE_KINDS } point_value_kind;

/* The values of one point: 12 bytes without padding. Missing values are zero. */
typedef struct point_value {
    float intensity;        /* finite; in the file's own units */
    uint16_t class;         /* in LAS 2 is ground, 6 a building; in other files any label */
    unsigned char color[3]; /* red, green, blue */
    bool has[POINT_VALUE_KINDS];
} point_value;

/* The values of many points: 12 bytes for each point if ids are dense, else 20. Zeroed: empty. */
typedef struct point_values {
    point_value *rows; /* owned */
    size_t count;      /* of rows; 0 if no point has any value */
    uint64_t first;    /* row n belongs to the id first + n, */
    uint64_t *ids;     /* unless this array, ascending and owned, holds the id of each row */
    unsigned kinds;    /* the kinds of values that any row has, as bits 1 << point_value_kind */
    size_t room, id_room;
} point_values;

/* An id and its values, to build a table from. */
typedef struct point_entry {
    uint64_t id;
    point_value value;
} point_entry;

/* The row of an id, or null. `v` may be null. Cost: O(1) if ids are dense, else O(log n). */
const point_value *point_values_find_row(const point_values *v, uint64_t id);

/* All values of an id; `v` may be null. */
point_value point_values_get(const point_values *v, uint64_t id);

/* The kinds of values that any point has, as bits 1 << point_value_kind. `v` may be null. */
static inline unsigned point_values_kinds(const point_values *v)
{
    return v ? v->kinds : 0;
}

/* True if a point has any value. */
bool point_value_has_any(const point_value *value);
bool point_value_equals(const point_value *a, const point_value *b);

/* Append a row, which may have no value. False when out of memory: the rows are then unchanged. */
bool point_values_append_row(point_values *v, const point_value *value);

/* Insert a row without values before row `at`, which is at most `count`; ids must be dense. False when out of memory.
 */
bool point_values_insert_empty_row(point_values *v, size_t at);

/* Add entries, each with an id that has no row yet, in any order. False when out of memory: *v is then unchanged.
 * Cost: O(n log n) for n entries and rows together; O(entries) if their ids follow the last row. */
bool point_values_add_entries(point_values *v, const point_entry *entries, size_t count);

/* Free all memory and empty the table. */
void point_values_release(point_values *v);

#endif
