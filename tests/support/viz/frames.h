/* SPDX-License-Identifier: MIT */
/* frames.h - renderers and frames for tests. */
#ifndef FRAMES_H
#define FRAMES_H

#include "pixel.h"
#include "scenes.h"

/* A renderer; the test fails with the error if it cannot be created. */
renderer *open_renderer(int width, int height);

/* A renderer that draws with GL: with any kind of context, or with the given kind. */
renderer *open_gl_renderer(int width, int height);
renderer *open_renderer_of(draw_context kind, int width, int height);

/* A renderer with the size of a scene in samples. */
renderer *open_renderer_for(const scene *s);

/* The number of indices of a frame, one for each sample. */
size_t frame_samples(const scene *s);

/* Draw a scene; the caller frees the frame. The test fails if drawing fails or a pixel's index has no meaning. */
uint8_t *draw(renderer *r, const scene *s);

/* Draw a scene with a new renderer. */
uint8_t *draw_once(const scene *s);

/* The number of samples that are not background. */
size_t lit_pixels(const uint8_t *frame, const scene *s);

void assert_same_frame(const uint8_t *a, const uint8_t *b, const scene *s);

#endif
