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
#define LETTER 6                    /* the widest that most letters are; a row of text is cut to fit the panel by it */
#define SWATCH 20                   /* the width of a sign in the legend */
#define WORDS (MARGIN + SWATCH + 6) /* where its words begin */

/* Where the next line of text goes, in units. */
typedef struct pen {
    scene *scene;
    int y;
    theme_role name, value; /* the colours of names and values of rows */
    uint64_t next_id;
} pen;

/* Letters from `x` to the end of the column. */
size_t text_room(int x, int size);

/* One that is longer than its room is cut, and ends in two dots. */
void write_text(pen *p, int x, theme_role role, int size, const char *text);

/* A line of text, and of a name and a value. */
void write_line(pen *p, int x, theme_role role, const char *text);
void write_row(pen *p, const char *name, const char *format, ...);

/* A row of a number and as many ids as have room, a few at most: "3: 17 5 +1". */
void write_ids(pen *p, const char *name, const octree_point *points, size_t count);
#define PEN_MOST_IDS 3

/* A rectangle. */
void fill(pen *p, int x, int y, int width, int height, unsigned role);

#endif
