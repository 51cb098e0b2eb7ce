/* SPDX-License-Identifier: MIT */
/* pen.h - writes into the text column at the left of the picture, line by line. All characters have the same width
 * (lettering.h), so positions in a line are counted in characters. */
#ifndef LAYERS_PEN_H
#define LAYERS_PEN_H

#include "json_write.h"
#include "layout.h"
#include "number.h"
#include "octree/types.h"
#include "scene.h"

#define DETAIL 10 /* position of the detail in a row: the character at which it begins */

/* The position of the next line of text in a scene.
 *
 * If view.text_apart is true, the pen writes rows for a page in place of labels. Each row is one of these objects:
 *   {"title": "tick 41"}
 *   {"text": "moved", "color": "#rrggbb"}
 *   {"name": "depth", "detail": "...", "value": "5 of max 5", "name_color": "#rrggbb", "color": "#rrggbb"}
 *   {"sign": [[x, y, width, height, "#rrggbb"], [x, "text"], ...], "text": "point"}
 *   {"rule": true}
 * Usual colours and empty details are left out. A sign is a symbol of the legend: rectangles, and texts with the x of
 * their left end. Its numbers are pixels for characters of PEN_ROW_LETTERING. Texts are not cut. */
typedef struct pen {
    scene *scene;
    lettering text;         /* the lettering of the lines */
    json_writer *rows;      /* null: the pen adds labels and rectangles to the scene */
    int left, y;            /* the top left corner of the line's first character, in pixels */
    int letters;            /* number of characters that fit into a line */
    theme_role name, value; /* the colours of a row's name and value */
    uint64_t next_id;
} pen;

/* The lettering of a pen that writes rows. */
#define PEN_ROW_LETTERING ((lettering){.face = FACE_8X16, .multiple = 1, .width = 8, .height = 16, .line = 19})

/* make_column_pen() returns a pen at the top of the column. make_corner_pen() returns a pen in the corner of a picture
 * without a column. */
pen make_column_pen(scene *s);
pen make_corner_pen(scene *s);

/* write_text() writes a text that begins at character `at` of the line. write_right_aligned() writes a text that ends
 * at the end of the line. A text that does not fit is cut and ends in two dots. */
void write_text(pen *p, int at, theme_role role, const char *format, ...);
void write_right_aligned(pen *p, theme_role role, const char *text);

/* Write a title in characters of twice the usual width and height. */
void write_title_text(pen *p, theme_role role, const char *text);

/* Write a text that may be longer than a label can be. */
void write_caption(pen *p, const char *text);

/* Write a line of text and move to the next line. */
void write_line(pen *p, theme_role role, const char *text);

/* Return the number of characters that a row has for its detail if its value has `value_length` characters. */
static inline int detail_room(const pen *p, size_t value_length)
{
    const int room = p->letters - DETAIL - 1 - (int)value_length;
    return room > 0 ? room : 0;
}

/* Write a row: a name at the left, a formatted value at the right, and between them a detail, which may be empty. A
 * long value may take room from the detail, which is then cut. */
void write_row(pen *p, const char *name, const char *detail, const char *format, ...);

/* Move down by half a line. If there is a column, write_separator_line() also draws a thin line in the middle of the
 * gap. */
void write_gap(pen *p);
void write_separator_line(pen *p);

/* Write a row with the ids of the first points and the number of points, such as "#17 #5 +1" and "3 found". At most
 * PEN_MOST_IDS ids are written, and only as many as fit; "+1" counts the other points. */
void write_ids(pen *p, const char *name, const octree_point *points, size_t count);
#define PEN_MOST_IDS 3

/* Print a number with as many significant digits as fit into `letters` characters, at most 9 digits. Return `text`. */
const char *format_number_within(double value, size_t letters, char text[NUMBER_TEXT]);

/* Write a row of the legend for a page. begin_sign() begins the row; the caller then writes the rectangles and texts of
 * the sign, and end_sign() ends the row with the row's text. */
void begin_sign(pen *p);
void end_sign(pen *p, const char *text);

/* Write a text x pixels to the right of the pen. */
void write_text_at(pen *p, int x, theme_role role, const char *text);

/* Fill a rectangle, in the colour of a role or in any other colour. The corner (x, y) of the rectangle is relative to
 * the pen. All numbers are in pixels. */
void fill_rectangle(pen *p, int x, int y, int width, int height, unsigned role);
void fill_rectangle_in_color(pen *p, int x, int y, int width, int height, theme_color color);

/* Write a text in as many lines as it needs, broken at spaces. */
void write_wrapped_text(pen *p, theme_role role, const char *text);

#endif
