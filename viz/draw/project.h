/* project.h - world geometry through the camera: clipped, cut into bands of depth, in pixels; all in doubles. For this
 * folder. */
#ifndef DRAW_PROJECT_H
#define DRAW_PROJECT_H

#include "quads.h"

/* The scene as its samples see it, which is what is painted: a picture that is larger, through a camera that enlarges.
 * Its elements are shared. All else here is of such a scene: its pixels are samples. */
scene project_samples(const scene *s);

/* A piece of a segment within one band, in pixels. */
typedef struct piece {
    double from[2], to[2];
    unsigned band;
} piece;

/* Clip a segment to what is before the camera and to the picture (with a margin), and cut it at the band planes.
 * Returns the number of pieces, 0 to QUAD_BANDS, from the first end to the second. Ends whose camera coordinates
 * overflow a double give none: *overflowed is then set. */
unsigned project_segment(const scene *s, const double from[3], const double to[3], piece pieces[QUAD_BANDS],
                         bool *overflowed);

/* The piece of a segment of the picture: nearest, clipped likewise. False when nothing of it is in the picture. */
bool project_flat(const scene *s, const double from[3], const double to[3], piece *p);

/* A point's pixel and band; false when it lies behind the camera or outside the picture. */
bool project_point(const scene *s, const double position[3], double pixel[2], unsigned *band);

#endif
