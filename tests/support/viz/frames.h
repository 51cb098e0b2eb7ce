/* SPDX-License-Identifier: MIT */
/* frames.h - renderers and frames for tests.
 */
#ifndef FRAMES_H
#define FRAMES_H

#include "pixel.h"
#include "scenes.h"

/* A renderer; the test fails, with the sentence, when there is none. */
renderer *open_renderer(int width, int height);

/* One whose quads GL fills: of any context, or of one kind. */
renderer *open_gl_renderer(int width, int height);
renderer *open_renderer_of(draw_context kind, int width, int height);

/* One of a scene's size in samples. */
renderer *open_renderer_for(const scene *s);

/* The indices of a frame: one a sample. */
size_t frame_samples(const scene *s);

/* A frame of a scene, which the caller frees; the test fails when it is not drawn, or has an index of no role. */
uint8_t *draw(renderer *r, const scene *s);

/* A frame by a renderer of its own. */
uint8_t *draw_once(const scene *s);

/* Samples that are not background. */
size_t lit_pixels(const uint8_t *frame, const scene *s);

void assert_same_frame(const uint8_t *a, const uint8_t *b, const scene *s);

#endif
