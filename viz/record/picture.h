/* SPDX-License-Identifier: MIT */
/* picture.h - one scene becomes one image: a renderer, the frame's pixels and the theme's palette. */
#ifndef RECORD_PICTURE_H
#define RECORD_PICTURE_H

#include "renderer.h"
#include "folder.h"
#include "png_write.h"
#include "point_values.h"

typedef struct picture {
    renderer *renderer;
    image frame;   /* the scene that was drawn last: indices of the theme's table, or RGB: view_is_rgb() */
    image samples; /* of RGB what the frame is made of; else empty */
} picture;

/* Fit a view to the tree that it shows first. False with the reason where there is nothing in it to be seen. */
bool picture_fit(view *v, const octree *tree, const point_values *values, octreel_error *error);

/* For scenes of this view's size and anti-aliasing. What is too large is refused before memory is spent. */
bool picture_open(picture *p, const view *v, const renderer_choice *choice, octreel_error *error);
void picture_close(picture *p);

/* Draw a scene into p->frame. */
bool picture_draw(picture *p, const scene *s, octreel_error *error);

/* What the renderer draws into: one index for each sample. picture_finish() makes p->frame of it. */
image *picture_samples(picture *p);
bool picture_finish(picture *p, const scene *s, octreel_error *error);

#endif
