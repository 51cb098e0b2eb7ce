/* SPDX-License-Identifier: MIT */
/* renderer.h - draws scenes.
 *
 * A renderer draws scenes of one size into indices of the theme's colours: it fills their quads by integers, or lets
 * the GL of its off-screen context fill them all. The pixels are the same. Under anti-aliasing it draws view_samples()
 * times as many pixels on each axis, which image_shrink() makes colours of: lines, marks and letters are as large in
 * the picture as without. Use it from the thread that opened it.
 */
#ifndef DRAW_RENDERER_H
#define DRAW_RENDERER_H

#include "context.h"
#include "scene.h"

typedef struct renderer renderer;

/* "integers", "gl"; null from DRAW_FILLS on. And the inverse; false when there is no such name. */
const char *draw_fill_name(draw_fill fill);
bool draw_fill_parse(const char *name, draw_fill *fill);

/* Which driver draws; valid while the renderer is open. */
typedef struct renderer_info {
    const char *context;                     /* "osmesa", "egl"; "memory" is none */
    const char *vendor, *renderer, *version; /* GL's own strings; null without a context */
    const char *fill;                        /* draw_fill_name() */
} renderer_info;

/* Open a context and a framebuffer of this size, in samples. Null, and a sentence, when there is no such context, when
 * something else than llvmpipe would draw, or when the size is outside 1..VIEW_MAX_SIDE. Cost: some 10 ms and 85 MB. */
renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error);
void renderer_close(renderer *r);

/* The same without any context, in memory alone: integers fill. Null, and a sentence, when the size is outside
 * 1..VIEW_MAX_SIDE or there is no memory. */
renderer *renderer_open_memory(int width, int height, octreel_error *error);

renderer_info renderer_about(const renderer *r);

/* Draw a scene whose picture has the renderer's size in samples into width * height indices, rows from the top. */
bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, octreel_error *error);

/* Of the scene that was drawn last, where its view paints points: r, g, b a sample, the colour where the index is
 * THEME_OWN. Valid until the next one. */
const uint8_t *renderer_own_colors(const renderer *r);

/* Elements of the last scene that are not in its frame: NaN or infinite, or too far off for doubles. */
size_t renderer_left_out(const renderer *r);

/* ---- For this folder ---------------------------------------------------------------------------------------- */

struct quad;

/* Whether a scene's picture has the renderer's size in samples; a sentence where it has not. */
bool renderer_fits(const renderer *r, const scene *s, octreel_error *error);

/* A rectangle of samples. */
typedef struct renderer_part {
    int x, y, width, height;
} renderer_part;

/* Fill quads in this order on a ground of zeros, and read a part of the result. */
bool renderer_fill(renderer *r, const struct quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                   octreel_error *error);

#endif
