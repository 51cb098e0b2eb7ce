/* SPDX-License-Identifier: MIT */
/* table.h - what was measured of one knob: rows of numbers under named columns, and which column bounds which. */
#ifndef TRADEOFF_TABLE_H
#define TRADEOFF_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { TABLE_COLUMNS_AT_MOST = 16, TABLE_NAME = 48 };

typedef struct column {
    const char *name;    /* as in the CSV file */
    const char *meaning; /* with its unit */
    const char *bound;   /* the column that this one must not exceed, row by row; "0": it must be zero; null: none */
} column;

/* NaN stands for what was not measured, and as a bound for none. */
typedef struct row {
    char scene[TABLE_NAME];
    char variant[TABLE_NAME];
    double values[TABLE_COLUMNS_AT_MOST];
} row;

typedef struct table {
    const column *columns; /* the first is the knob's setting */
    size_t column_count;
    row *rows;
    size_t count, room;
    struct json_t *notes;    /* null, or an array of {"scene", "variants": [...], "text"} */
    struct json_t *pictures; /* null, or an array of {"caption", "png": base64} */
} table;

/* Append a row: one value a column, in their order. */
void table_add(table *t, const char *scene, const char *variant, const double *values);
void table_free(table *t);

/* Attach a text, such as a session, to the row of a scene and a variant. Equal texts of a scene are kept once. */
void table_note(table *t, const char *scene, const char *variant, const char *text);

double table_value(const table *t, const row *r, const char *column);

/* Some rows: null and NaN stand for any. */
typedef struct pick {
    const char *scene, *variant;
    double setting;
} pick;

/* How many rows are picked; the largest value and the sum over them, leaving out NaN; 0 for none. */
size_t table_count(const table *t, pick p);
double table_most(const table *t, pick p, const char *column);
double table_sum(const table *t, pick p, const char *column);

/* A column's value under `a`, divided by that under `b`: the median over scenes, and the scene where it is largest
 * (null when there is none). */
typedef struct ratio {
    double median, most;
    const char *scene;
} ratio;

ratio table_ratios(const table *t, pick a, pick b, const char *column);
double table_ratio(const table *t, pick a, pick b, const char *column); /* the median alone */

/* Round all values to the five digits that a CSV file has, so that the sentences about a table and about its file are
 * the same. Judge first: a value may exceed its bound by less. */
void table_round(table *t);

/* "scene,variant,<columns>" and a line a row. Compact: a scene or variant that is that of the row before is empty. */
void table_write_csv(const table *t, bool compact, FILE *out);

/* Append the rows of a table that table_write_csv wrote; a line "<" or the end of the text ends it. False if the
 * columns are others, or a row is damaged. */
bool table_read_csv(table *t, const char *text);

/* A line a row, a JSON object; what is not finite is null. */
void table_write_json(const table *t, const char *knob, FILE *out);

/* Say on `out` which values are beyond their bound times `tighten`. Returns how many there are. */
size_t table_judge(const table *t, const char *knob, double tighten, FILE *out);

#endif
