/* SPDX-License-Identifier: MIT */
/* pen.h - writing into the column of text at the left, line by line. */
#ifndef LAYERS_PEN_H
#define LAYERS_PEN_H

#include "layout.h"
#include "octree/octree.h"
#include "scene.h"

/* In units (view_unit). */
#define COLUMN LAYOUT_COLUMN
#define MARGIN 8
#define LINE 13
#define VALUE 54                    /* where a row's value begins */
#define LETTER 6                    /* the width of the widest usual letter: text is cut by it to fit the panel */
#define SWATCH 20                   /* the width of a sign in the legend */
#define WORDS (MARGIN + SWATCH + 6) /* where its words begin */

/* Where the next line of text goes, in units. */
typedef struct pen {
    scene *scene;
    int y;
    theme_role name, value; /* the colours of names and values of rows */
    uint64_t next_id;
} pen;

/* How many letters fit from x to the end of the column. */
size_t text_room(int x, int size);

/* Write a text; one that does not fit is cut and ends in two dots. */
void write_text(pen *p, int x, theme_role role, int size, const char *text);

/* Write a line of text, or a row of a name and a value, and move to the next line. */
void write_line(pen *p, int x, theme_role role, const char *text);
void write_row(pen *p, const char *name, const char *format, ...);

/* Write a row of a count and as many ids as fit, PEN_MOST_IDS at most: "3: 17 5 +1". */
void write_ids(pen *p, const char *name, const octree_point *points, size_t count);
#define PEN_MOST_IDS 3

/* A rectangle. */
void fill(pen *p, int x, int y, int width, int height, unsigned role);

#endif
