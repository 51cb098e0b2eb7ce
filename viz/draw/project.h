/* SPDX-License-Identifier: MIT */
/* project.h - world geometry through the camera: clipped, cut into bands of depth, in pixels; all in doubles. For this
 * folder. */
#ifndef DRAW_PROJECT_H
#define DRAW_PROJECT_H

#include "quads.h"

/* The scene with samples for pixels, which is what is painted: the picture and the camera's zoom are multiplied. It
 * shares the elements of s. The functions below take such a scene. */
scene project_samples(const scene *s);

/* A piece of a segment within one band, in pixels. */
typedef struct piece {
    double from[2], to[2];
    unsigned band;
} piece;

/* Clip a segment to the space in front of the camera and to the picture (with a margin), and cut it at the band planes.
 * Returns the number of pieces, 0 to QUAD_BANDS, from the first end to the second. If camera coordinates overflow a
 * double there are none, and *overflowed is set. */
unsigned project_segment(const scene *s, const double from[3], const double to[3], piece pieces[QUAD_BANDS],
                         bool *overflowed);

/* The piece of a segment in picture coordinates: of the nearest band, clipped likewise. False when it is outside the
 * picture. */
bool project_flat(const scene *s, const double from[3], const double to[3], piece *p);

/* A point's pixel and view depth; false when it lies behind the camera or outside the picture. */
bool project_place(const scene *s, const double position[3], double pixel[2], double *depth);

/* Where a point is drawn. */
typedef struct point_place {
    uint32_t pixel; /* row by row */
    uint8_t band;
    bool seen; /* project_point() is true, and the pixel is in the picture */
} point_place;

/* Those of many markers, several at a time. */
void project_points(const scene *s, const scene_marker *markers, size_t count, point_place *places);

/* The band of a view depth. */
unsigned project_band(const camera *c, double depth);

/* A point's pixel and band; false when it lies behind the camera or outside the picture. */
bool project_point(const scene *s, const double position[3], double pixel[2], unsigned *band);

#endif
