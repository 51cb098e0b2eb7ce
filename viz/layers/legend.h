/* legend.h - what colours and lines mean, at the foot of the column. Layers add their lines (layer_type.h). */
#ifndef LAYERS_LEGEND_H
#define LAYERS_LEGEND_H

#include "layer.h"
#include "pen.h"

typedef struct layer_source layer_source;

/* What a line shows before its words, in the colour of its role. */
typedef enum legend_sign {
    SIGN_NONE, /* the line belongs to the one before it */
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
    SIGN_RAMP, /* the colours of nodes, from the first: as many as there are in `steps` */
    SIGN_GROWING_RAMP,
    SIGN_NODES, /* of the diagram */
    SIGN_BARS,
    SIGN_NODE,
} legend_sign;

/* Where there is no room for all lines, those that are worth less go first. */
typedef enum legend_worth {
    WORTH_FULL,
    WORTH_ANSWER, /* the panel tells its answer in the same colour */
    WORTH_PLAIN,  /* says little that the picture does not say by itself */
    WORTH_ABSENT, /* nothing in this frame */
} legend_worth;

typedef struct legend_line {
    view_layer layer;
    legend_worth worth;
    legend_sign sign;
    theme_role role;
    int steps;
    char text[SCENE_TEXT];
} legend_line;

#define LEGEND_MOST_LINES 64

typedef struct legend {
    const scene *scene;
    unsigned in_frame; /* layers that have something in this frame, as bits */
    legend_line next;  /* what is added begins as this */
    legend_line lines[LEGEND_MOST_LINES];
    size_t count;
} legend;

/* Letters of a line's words that have room. */
#define LEGEND_LETTERS ((COLUMN - WORDS) / LETTER)

/* Add a line in the layer's colour; the line it returns may be changed. */
legend_line *legend_add(legend *l, legend_sign sign, const char *format, ...);

/* A line for each layer of the view that can have something in it, as far as there is room below the pen: first those
 * go that have nothing in this frame, then those that explain themselves, then those of answers; and then the last,
 * which a last line counts. */
void write_legend(pen *p, const layer_source *in);

#endif
