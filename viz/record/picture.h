/* SPDX-License-Identifier: MIT */
/* picture.h - draws scenes into an image. A picture owns a renderer, the pixels of the frame and the palette of the
 * theme. */
#ifndef RECORD_PICTURE_H
#define RECORD_PICTURE_H

#include "renderer.h"
#include "folder.h"
#include "png_write.h"
#include "point_values.h"

typedef struct picture {
    renderer *renderer;
    /* The frame, drawn from the last scene; pixels are indices into the palette of the theme, or RGB if
     * view_is_rgb(). */
    image frame;
    image samples; /* the palette indices from which an RGB frame is made; empty if the frame is not RGB */
} picture;

/* Fit the camera and the scales of a view to `tree`, the first tree that the view shows. Returns false with an error if
 * the view's filter excludes the whole tree. */
bool picture_fit_view(view *v, const octree *tree, const point_values *values, octreel_error *error);

/* Open a picture for scenes with this view's size and anti-aliasing. A size that is too large is an error, which is
 * found before memory is allocated. */
bool picture_open(picture *p, const view *v, const renderer_choice *choice, octreel_error *error);
void picture_close(picture *p);

/* Draw a scene into p->frame. */
bool picture_draw(picture *p, const scene *s, octreel_error *error);

/* Returns the image into which the renderer draws: one palette index per sample. picture_finish() then makes p->frame
 * from these samples. */
image *picture_samples(picture *p);
bool picture_finish(picture *p, const scene *s, octreel_error *error);

#endif
