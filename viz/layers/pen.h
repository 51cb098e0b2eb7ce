/* SPDX-License-Identifier: MIT */
/* pen.h - writes into the text column at the left, line by line. All letters have the same width (lettering.h), so
 * positions in a line are counted in letters. */
#ifndef LAYERS_PEN_H
#define LAYERS_PEN_H

#include "layout.h"
#include "number.h"
#include "octree/types.h"
#include "scene.h"

#define DETAIL 10 /* the letter at which the detail of a row begins */

/* The position of the next line of text. */
typedef struct pen {
    scene *scene;
    int left, y;            /* the top left corner of the line's first letter, in pixels */
    int letters;            /* letters that fit into a line */
    theme_role name, value; /* the colours of a row's name and value */
    uint64_t next_id;
} pen;

/* Return a pen at the top of the column, or in the corner of a picture without a column. */
pen pen_in_column(scene *s);
pen pen_in_corner(scene *s);

/* Write a text that begins at letter `at` of the line, or that ends at the end of the line. A text that does not fit is
 * cut and ends in two dots. */
void write_text(pen *p, int at, theme_role role, const char *format, ...);
void write_right_aligned(pen *p, theme_role role, const char *text);

/* Write in title letters, which are twice as wide and twice as high. */
void write_title_text(pen *p, theme_role role, const char *text);

/* Write a line of text and move to the next line. */
void write_line(pen *p, theme_role role, const char *text);

/* Write a row: a name at the left, a formatted value at the right, and between them a detail, which may be empty. The
 * detail is cut where the value needs the room. */
void write_row(pen *p, const char *name, const char *detail, const char *format, ...);

/* Move down by half a line. write_rule also draws a thin line in the middle of the gap if there is a column. */
void write_gap(pen *p);
void write_rule(pen *p);

/* Write a row with the ids that fit, at most PEN_MOST_IDS, the number of further ids, and the count: "#17 #5 +1", "3
 * found". */
void write_ids(pen *p, const char *name, const octree_point *points, size_t count);
#define PEN_MOST_IDS 3

/* Print a number with as many significant digits as fit into `letters`, at most 9. Return `text`. */
const char *format_number_within(double value, size_t letters, char text[NUMBER_TEXT]);

/* Write a text x pixels to the right of the pen. */
void write_text_at(pen *p, int x, theme_role role, const char *text);

/* Fill a rectangle, given in pixels from the pen, in the colour of a role or in any other colour. */
void fill_rectangle(pen *p, int x, int y, int width, int height, unsigned role);
void fill_rectangle_in_color(pen *p, int x, int y, int width, int height, theme_color color);

/* Write a text in lines that fit the column, broken at spaces. */
void write_wrapped(pen *p, theme_role role, const char *text);

#endif
