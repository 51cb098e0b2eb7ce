/* SPDX-License-Identifier: MIT */
/* stroke.h - lines and marks as quads of whole 1/256 samples. For this folder. */
#ifndef DRAW_STROKE_H
#define DRAW_STROKE_H

#include "project.h"

/* What a line is drawn with. */
typedef struct pencil {
    scene_style style;
    int width;      /* of lines, samples */
    int unit;       /* view_unit of the scene: pixels */
    int samples;    /* a pixel, on each axis */
    unsigned depth; /* of the node that the line belongs to */
} pencil;

pencil pencil_make(const scene *s, scene_style style, unsigned depth);

/* Draw the pieces of one segment with its stroke; however short, at least one pixel. */
void stroke_line(quad_list *list, const pencil *with, const piece *pieces, unsigned count);

/* How many pixels a marker of a width has to each side: what is a pixel in the smallest picture grows with the unit, so
 * that it is not dust in a large one. */
static inline int stroke_marker_side(int width, int unit)
{
    const int side = 2 * (width * unit / 2) + 1, least = unit / 2;
    return side > least ? side : least;
}

void stroke_marker(quad_list *list, const pencil *with, scene_shape shape, const double pixel[2], unsigned band);
void stroke_panel(quad_list *list, const scene_panel *panel, int samples);

#endif
