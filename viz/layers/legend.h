/* SPDX-License-Identifier: MIT */
/* legend.h - the legend at the bottom of the column: what colours, lines and marks mean. Layers add their own lines
 * (layer_type.h). */
#ifndef LAYERS_LEGEND_H
#define LAYERS_LEGEND_H

#include "layer.h"
#include "pen.h"

typedef struct layer_source layer_source;

/* The symbol at the start of a legend line. Its colour is the line's role. */
typedef enum legend_sign {
    SIGN_NONE, /* continues the line before it */
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
    SIGN_RAMP, /* the first `steps` node colours, side by side */
    SIGN_GROWING_RAMP,
    SIGN_NODES, /* an inner node and a leaf of the diagram */
    SIGN_BARS,
    SIGN_NODE,
    SIGN_SWATCH, /* a square in the line's `color` */
    SIGN_CHECKS,
    SIGN_SCALE, /* a colour bar across the column, with numbers in the next line: `scale`. Continues the line before */
} legend_sign;

/* A colour bar: the amounts at its two ends. */
typedef struct legend_scale {
    double low, high;
    bool doubling; /* logarithmic: low and high are powers of two, and the colours follow the exponent */
    bool pointed;  /* both ends taper to a point: amounts beyond low and high have the colours of the ends */
} legend_scale;

/* When lines do not fit, lines with the greatest value are dropped first. */
typedef enum legend_drop_order {
    DROP_LAST,
    DROP_LATE,  /* the panel shows the layer's answer in the same colour */
    DROP_EARLY, /* the layer is nearly self-explanatory */
    DROP_FIRST, /* the layer has no elements in this frame */
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
#define LEGEND_LAST 200 /* the greatest legend_entry.order: layer_type.h */

typedef struct legend {
    const scene *scene;
    unsigned in_frame; /* bit i: layer i has elements in this frame */
    legend_line next;  /* the initial value of the lines that legend_add adds */
    legend_line lines[LEGEND_MOST_LINES];
    size_t count;
} legend;

/* The letters that fit into a line behind its sign, and the letter at which the text begins. */
#define LEGEND_LETTERS (LAYOUT_LETTERS - LEGEND_WORDS)
#define LEGEND_WORDS 4

/* Add a line in the layer's colour. Return it, so that the caller can change its role, steps or colour. */
legend_line *legend_add(legend *l, legend_sign sign, const char *format, ...);

/* Add a colour bar: two lines, which are kept or dropped together with the line before. */
void legend_add_scale(legend *l, legend_scale scale);

/* Add a line for the colours of depths, such as "nodes, depth 0-9+". The deepest depths share the last colour. */
void legend_add_depths(legend *l, const char *what, size_t deepest);

/* Draw a colour bar and its numbers at the pen's place. */
void write_scale(pen *p, const legend_scale *scale);

/* Write the legend of the view's layers below the pen. When the lines do not fit, some are dropped by their drop order,
 * then from the end, and a final line counts them. */
void write_legend(pen *p, const layer_source *in);

#endif
