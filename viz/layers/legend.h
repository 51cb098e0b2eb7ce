/* SPDX-License-Identifier: MIT */
/* legend.h - what colours and lines mean, at the foot of the column. Layers add their lines (layer_type.h). */
#ifndef LAYERS_LEGEND_H
#define LAYERS_LEGEND_H

#include "layer.h"
#include "pen.h"

typedef struct layer_source layer_source;

/* What a line shows before its words, in the colour of its role. */
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
    SIGN_RAMP, /* the colours of nodes, from the first: as many as there are in `steps` */
    SIGN_GROWING_RAMP,
    SIGN_NODES, /* of the diagram */
    SIGN_BARS,
    SIGN_NODE,
    SIGN_SWATCH, /* of the line's own colour */
    SIGN_CHECKS,
    SIGN_SCALE, /* the colours of amounts, across the column, with numbers in the line below: `scale`. Continues */
} legend_sign;

/* Amounts from one end of the colours to the other. */
typedef struct legend_scale {
    double low, high;
    bool doubling; /* low and high are powers of two, and the colours go by the power */
    bool pointed;  /* at both ends: what lies beyond has the colours of the ends */
} legend_scale;

/* When lines do not fit, those with the greatest value are dropped first. */
typedef enum legend_drop_order {
    DROP_LAST,
    DROP_LATE,  /* the panel shows its answer in the same colour */
    DROP_EARLY, /* nearly self-explanatory */
    DROP_FIRST, /* no elements in this frame */
} legend_drop_order;

typedef struct legend_line {
    view_layer layer;
    legend_drop_order worth;
    legend_sign sign;
    theme_role role;
    int steps;
    theme_color color;
    legend_scale scale;
    char text[SCENE_TEXT];
} legend_line;

#define LEGEND_MOST_LINES 64

typedef struct legend {
    const scene *scene;
    unsigned in_frame; /* bits of the layers with elements in this frame */
    legend_line next;  /* the initial value of added lines */
    legend_line lines[LEGEND_MOST_LINES];
    size_t count;
} legend;

/* Letters that fit into a line. */
#define LEGEND_LETTERS (LAYOUT_LETTERS - LEGEND_WORDS)
#define LEGEND_WORDS 4 /* the letter at which its words begin, behind the sign */

/* Add a line in the layer's colour. The result may be changed. */
legend_line *legend_add(legend *l, legend_sign sign, const char *format, ...);

/* Add the colours of amounts: two lines, which belong to the one before. */
void legend_add_scale(legend *l, legend_scale scale);

/* Add the colours of depths, which the deepest share: "nodes, depth 0-9+". */
void legend_add_depths(legend *l, const char *what, size_t deepest);

/* Draw them. */
void write_scale(pen *p, const legend_scale *scale);

/* Write the lines of the view's layers below the pen. When they do not fit, lines are dropped by their worth, and then
 * from the end, with a final line that counts them. */
void write_legend(pen *p, const layer_source *in);

#endif
