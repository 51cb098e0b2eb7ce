/* SPDX-License-Identifier: MIT */
/* picture.h - draws scenes into an image: a renderer, the pixels of the frame and the palette of the theme. */
#ifndef RECORD_PICTURE_H
#define RECORD_PICTURE_H

#include "renderer.h"
#include "folder.h"
#include "png_write.h"
#include "point_values.h"

typedef struct picture {
    renderer *renderer;
    image frame;   /* the last scene: indices of the theme's table, or RGB where view_is_rgb() */
    image samples; /* for RGB: the indices from which the frame is made; else empty */
} picture;

/* Fit a view to the first tree that it shows. False with an error where the filter can show nothing of it. */
bool picture_fit(view *v, const octree *tree, const point_values *values, octreel_error *error);

/* Open a picture for scenes with this view's size and anti-aliasing. Too large a size is refused before memory is used.
 */
bool picture_open(picture *p, const view *v, const renderer_choice *choice, octreel_error *error);
void picture_close(picture *p);

/* Draw a scene into p->frame. */
bool picture_draw(picture *p, const scene *s, octreel_error *error);

/* What the renderer draws into: one index for each sample. picture_finish() makes p->frame of it. */
image *picture_samples(picture *p);
bool picture_finish(picture *p, const scene *s, octreel_error *error);

#endif
