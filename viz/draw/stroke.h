/* SPDX-License-Identifier: MIT */
/* stroke.h - turns lines, markers and panels into quads. Private to this folder. */
#ifndef DRAW_STROKE_H
#define DRAW_STROKE_H

#include "project.h"

/* The style of a line or marker, and the sizes that follow from it. */
typedef struct pencil {
    scene_style style;
    int width;      /* the width of the line, in samples */
    int unit;       /* scene.unit: the size of a picture unit in pixels, which scales markers and arrow heads */
    int samples;    /* samples per pixel, on each axis */
    unsigned depth; /* the depth in the tree of the node to which the line or marker belongs */
} pencil;

pencil stroke_make_pencil(const scene *s, scene_style style, unsigned depth);

/* Add the quads of one segment, which consists of `pieces`. The pencil's style chooses the stroke. A visible segment
 * covers at least one pixel, however short the segment is. */
void stroke_add_line(quad_list *list, const pencil *with, const piece *pieces, unsigned count);

/* Returns the side of a marker in pixels. The side grows with `unit`, so that markers stay visible in large
 * pictures. */
static inline int stroke_marker_side(int width, int unit)
{
    const int side = 2 * (width * unit / 2) + 1, least = unit / 2;
    return side > least ? side : least;
}

void stroke_add_marker(quad_list *list, const pencil *with, scene_shape shape, const double pixel[2], unsigned band);
void stroke_add_panel(quad_list *list, const scene_panel *panel, int samples);

#endif
