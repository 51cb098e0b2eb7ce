/* SPDX-License-Identifier: MIT */
/* pen.h - writing into the column of text at the left, line by line. Letters are all as wide (lettering.h), so that
 * places in a line are counted in letters. */
#ifndef LAYERS_PEN_H
#define LAYERS_PEN_H

#include "layout.h"
#include "number.h"
#include "octree/types.h"
#include "scene.h"

#define DETAIL 10 /* the letter of a row at which its detail begins */

/* Where the next line of text goes. */
typedef struct pen {
    scene *scene;
    int left, y;            /* pixels of the top left corner of its first letter */
    int letters;            /* that fit into a line */
    theme_role name, value; /* the colours of names and values of rows */
    uint64_t next_id;
} pen;

/* A pen in the column, or where there is none in the corner of the picture. */
pen pen_in_column(scene *s);
pen pen_in_corner(scene *s);

/* Write a text at a letter of the line, or to end at its end. One that does not fit is cut and ends in two dots. */
void write_text(pen *p, int at, theme_role role, const char *text);
void write_right_aligned(pen *p, theme_role role, const char *text);

/* Write in the letters of titles, which are twice as wide and as high. */
void write_title_text(pen *p, theme_role role, const char *text);

/* Write a line of text and move to the next line. */
void write_line(pen *p, theme_role role, const char *text);

/* Write a line of a name at its left and a value at its right; and a detail between them, which is cut
 * where the value needs the room. */
void write_row(pen *p, const char *name, const char *format, ...);
void write_detailed_row(pen *p, const char *name, const char *detail, const char *format, ...);

/* Move down by half a line; with a thin line in its middle where there is a column, or without. */
void write_gap(pen *p);
void write_rule(pen *p);

/* Write a row of as many ids as fit, PEN_MOST_IDS at most, and the count: "#17 #5 +1", "3 found". */
void write_ids(pen *p, const char *name, const octree_point *points, size_t count);
#define PEN_MOST_IDS 3

/* A number with as many significant digits as fit into so many letters, 9 at most. Returns `text`. */
const char *format_number_within(double value, size_t letters, char text[NUMBER_TEXT]);

/* Write a text so many pixels from the pen's place. */
void write_text_at(pen *p, int x, theme_role role, const char *text);

/* A rectangle, in pixels from the pen's place; and one of its own colour, where the view paints points. */
void fill_rectangle(pen *p, int x, int y, int width, int height, unsigned role);
void fill_rectangle_in_color(pen *p, int x, int y, int width, int height, theme_color color);

/* The sentence in lines that fit the column, broken at blanks. */
void write_wrapped(pen *p, theme_role role, const char *text);

#endif
