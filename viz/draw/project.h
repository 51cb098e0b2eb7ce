/* SPDX-License-Identifier: MIT */
/* project.h - projects points and segments of the world into the picture. Private to this folder. */
#ifndef DRAW_PROJECT_H
#define DRAW_PROJECT_H

#include "quads.h"

/* Returns a copy of a scene whose pixels are samples: the size of the picture and the camera's zoom are multiplied by
 * view.aa. The copy shares the elements of `s`. The other functions of this file take such a copy. */
scene project_scene_to_samples(const scene *s);

/* The part of a segment that lies in one band of depth, in pixels. */
typedef struct piece {
    double from[2], to[2];
    unsigned band;
} piece;

/* Clip a segment to the space in front of the camera and to the picture with a margin, and cut the segment at the
 * planes between bands of depth. Returns the number of pieces, 0 to QUAD_BANDS; the pieces are ordered from the first
 * end to the second. If camera coordinates would overflow a double, returns 0 and sets *overflowed to true. */
unsigned project_segment(const scene *s, const double from[3], const double to[3], piece pieces[QUAD_BANDS],
                         bool *overflowed);

/* Clip a segment in picture coordinates to the picture with the margin of project_segment(). The resulting piece is in
 * band 0, the nearest. Returns false if the segment is outside the picture. */
bool clip_picture_segment(const scene *s, const double from[3], const double to[3], piece *p);

/* Project a point to its pixel and view depth. Returns false if the point is behind the camera, or outside the picture
 * with its margin. */
bool find_pixel_and_depth(const scene *s, const double position[3], double pixel[2], double *depth);

/* The pixel at which a point is drawn, and the point's band of depth. */
typedef struct point_place {
    uint32_t pixel; /* index of the sample in the picture: y * width + x */
    uint8_t band;
    bool seen; /* whether the point is visible: find_pixel_and_band() would succeed, and the pixel is in the picture */
} point_place;

/* Project the positions of `count` markers. Write one entry of `places` for each marker. */
void project_points(const scene *s, const scene_marker *markers, size_t count, point_place *places);

/* Returns the band of a view depth; band 0 is the nearest. */
unsigned find_depth_band(const camera *c, double depth);

/* Project a point to its pixel and band of depth. Returns false in the same cases as find_pixel_and_depth(). */
bool find_pixel_and_band(const scene *s, const double position[3], double pixel[2], unsigned *band);

#endif
