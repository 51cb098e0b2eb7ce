/* SPDX-License-Identifier: MIT */
/* legend.h - the legend at the bottom of the text column explains the colours, lines and markers that occur in the
 * frame. Layers add their own lines (layer_type.h). */
#ifndef LAYERS_LEGEND_H
#define LAYERS_LEGEND_H

#include "layer.h"
#include "pen.h"

typedef struct layer_source layer_source;

/* The symbol at the start of a legend line. It has the colour of the line's role. */
typedef enum legend_sign {
    SIGN_NONE, /* no symbol: the line continues the line before it */
    SIGN_LINE,
    SIGN_BOLD,
    SIGN_DASHES,
    SIGN_PLUS,
    SIGN_DASHED_PLUS,
    SIGN_FRAME,
    SIGN_DOT,
    SIGN_SQUARE,
    SIGN_ARROW,
    SIGN_CROSS,
    SIGN_RING,
    SIGN_TRIANGLE,
    SIGN_WEDGE,
    SIGN_RAMP, /* a bar of the first `steps` node colours, side by side */
    SIGN_GROWING_RAMP,
    SIGN_NODES, /* the diagram's symbols: an inner node and a leaf */
    SIGN_BARS,
    SIGN_NODE,
    SIGN_SWATCH, /* a square in the line's `color` */
    SIGN_CHECKS,
    /* A colour bar across the column, for the line's `scale`. The next line has the numbers of the bar. SIGN_SCALE
     * continues the line before it. */
    SIGN_SCALE,
} legend_sign;

/* A colour bar from `low` at its left end to `high` at its right end. */
typedef struct legend_scale {
    double low, high;
    /* True: the bar is logarithmic; low and high are powers of two, and the colours follow the exponent. */
    bool doubling;
    bool pointed; /* true: both ends taper to a point; numbers outside low to high have the colours of the ends */
} legend_scale;

/* The order in which lines are dropped if not all lines fit: lines with the greatest value are dropped first. */
typedef enum legend_drop_order {
    DROP_LAST,
    DROP_LATE,  /* the panel shows the layer's answer in the layer's colour */
    DROP_FIRST, /* readers understand the layer without its legend line */
} legend_drop_order;

typedef struct legend_line {
    view_layer layer;
    legend_drop_order drop_order;
    legend_sign sign;
    theme_role role;
    int steps;
    theme_color color;
    legend_scale scale;
    char text[SCENE_TEXT];
} legend_line;

#define LEGEND_MOST_LINES 64
#define LEGEND_LAST 200 /* maximum value of legend_entry.order (layer_type.h) */

typedef struct legend {
    const scene *scene;
    unsigned in_frame; /* bit i is set if layer i has elements in this frame */
    legend_line next;  /* a template for the next line: legend_add() copies it, and sets sign and text */
    legend_line lines[LEGEND_MOST_LINES];
    size_t count;
} legend;

/* LEGEND_WORDS: the column at which the text of a line begins, behind the line's sign. LEGEND_LETTERS: the number of
 * characters of text in a line. */
#define LEGEND_LETTERS (LAYOUT_LETTERS - LEGEND_WORDS)
#define LEGEND_WORDS 4

/* Add a line in the layer's colour. Return the line, so that the caller can change its role, steps or colour. */
legend_line *legend_add(legend *l, legend_sign sign, const char *format, ...);

/* Add a colour bar and its numbers, which are two lines. The two lines are kept or dropped together with the line
 * before them. */
void legend_add_scale(legend *l, legend_scale scale);

/* Add a line that explains the colours of depths, such as "nodes, depth 0-9+". All depths beyond the last colour have
 * the last colour. */
void legend_add_depths(legend *l, const char *what, size_t deepest);

/* Draw a colour bar and its numbers at the position of the pen. */
void write_scale(pen *p, const legend_scale *scale);

/* Write the legend of the view's layers below the pen. If not all lines fit, lines are dropped by their drop order and
 * then from the end. A final line counts the dropped lines. */
void write_legend(pen *p, const layer_source *in);

#endif
