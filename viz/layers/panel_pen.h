/* panel_pen.h - writing into the column of text, line by line. Private to the panel's files. */
#ifndef SCENE_PANEL_PEN_H
#define SCENE_PANEL_PEN_H

#include "layout.h"
#include "scene.h"

/* In units (view_unit). */
#define COLUMN LAYOUT_COLUMN
#define MARGIN 8
#define LINE 13
#define VALUE 54 /* where a row's value begins */
#define SWATCH 20
#define LETTER 6 /* the widest that most letters are; a row of text is cut to fit the panel by it */

/* Where the next line of text goes, in units. */
typedef struct pen {
    scene *scene;
    int y;
    theme_role name; /* the colour of names of rows */
    uint64_t next_id;
} pen;

/* Letters from `x` to the end of the column. */
size_t text_room(int x, int size);

/* One that is longer than its room is cut, and ends in two dots. */
void write_text(pen *p, int x, theme_role role, int size, const char *text);

/* A line of a name and a value. */
void write_row(pen *p, const char *name, const char *format, ...);

/* A rectangle. */
void fill(pen *p, int x, int y, int width, int height, unsigned role);

#endif
