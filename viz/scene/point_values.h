/* SPDX-License-Identifier: MIT */
/* point_values.h - the values of points (colour, intensity, class), found by a point's id.
 *
 * Code that draws a point does
 *   const size_t row = point_values_row(values, point->id);
 *   if (point_values_has(values, row, POINT_COLOR)) ... values->colors[row] ...
 *
 * The game does not know values: an id keeps its values through a session, wherever its point moves.
 */
#ifndef SCENE_POINT_VALUES_H
#define SCENE_POINT_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum point_value_kind { POINT_COLOR, POINT_INTENSITY, POINT_CLASS, POINT_VALUE_KINDS } point_value_kind;

/* The values of one point. Missing values are zero. */
typedef struct point_value {
    unsigned char color[3]; /* red, green, blue */
    uint16_t class;         /* in LAS 2 is ground, 6 a building; in other files any label */
    float intensity;        /* finite; in the file's own units */
    bool has[POINT_VALUE_KINDS];
} point_value;

/* The values of many points, one row for each: at most 10 bytes for each point if ids are dense, else 18. Zeroed:
 * empty.
 */
typedef struct point_values {
    size_t count;               /* rows; 0 where no point has any values */
    uint64_t first;             /* row n belongs to the id first + n, */
    uint64_t *ids;              /* unless this array, ascending and owned, holds the id of each row */
    unsigned char (*colors)[3]; /* this and the next two: `count` items; null if no point has the value; owned */
    float *intensities;
    uint16_t *classes;
    unsigned char *given; /* for each row, bits 1 << point_value_kind of the values it has; null: each row has a value
                             in every array that is not null; owned */
    size_t color_room, intensity_room, class_room, given_room, id_room;
} point_values;

/* An id and its values, to build a table from. */
typedef struct point_entry {
    uint64_t id;
    point_value value;
} point_entry;

#define POINT_VALUES_NONE SIZE_MAX

/* The row of an id among ids. Cost: O(log n). */
size_t point_values_search(const point_values *v, uint64_t id);

/* The row of an id; POINT_VALUES_NONE where there is none. `v` may be null. Cost: O(1) where ids are dense. */
static inline size_t point_values_row(const point_values *v, uint64_t id)
{
    if (!v || v->count == 0)
        return POINT_VALUES_NONE;
    if (v->ids)
        return point_values_search(v, id);
    return id - v->first < v->count ? (size_t)(id - v->first) : POINT_VALUES_NONE;
}

/* The kinds of values that any point has, as bits 1 << point_value_kind. `v` may be null. */
static inline unsigned point_values_kinds(const point_values *v)
{
    return !v ? 0U
              : (unsigned)(v->colors != NULL) << POINT_COLOR | (unsigned)(v->intensities != NULL) << POINT_INTENSITY |
                    (unsigned)(v->classes != NULL) << POINT_CLASS;
}

/* Whether a row, which may be POINT_VALUES_NONE, has a value. */
static inline bool point_values_has(const point_values *v, size_t row, point_value_kind kind)
{
    return row != POINT_VALUES_NONE && (v->given ? v->given[row] : point_values_kinds(v)) >> kind & 1;
}

/* All values of an id; `v` may be null. */
point_value point_values_get(const point_values *v, uint64_t id);

bool point_value_is_set(const point_value *value);
bool point_value_same(const point_value *a, const point_value *b);

/* Append a row, which may have no value. False when there is no memory: the rows are then as they were. */
bool point_values_append(point_values *v, const point_value *value);

/* Put a row without values before row `at`, which is at most `count`; ids are dense. False when there is no memory. */
bool point_values_open_row(point_values *v, size_t at);

/* Remove all values of a kind. */
void point_values_drop(point_values *v, point_value_kind kind);

/* Add entries, each with an id that has no row yet; they are sorted. False when there is no memory: *v is then as it
 * was. Cost: O(n log n) of the entries and the rows together. */
bool point_values_add(point_values *v, const point_entry *entries, size_t count);

/* Free the arrays and empty it. */
void point_values_release(point_values *v);

#endif
