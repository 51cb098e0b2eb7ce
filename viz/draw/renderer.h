/* SPDX-License-Identifier: MIT */
/* renderer.h - draws scenes of one size into indices of the theme's colours.
 *
 * paint.h turns a scene into flat quads. The integer rasterizer (fill.h) or GL (gl_surface.c) fills them, with the same
 * pixels. With anti-aliasing a renderer draws view_samples_per_side() times as many samples on each axis, and
 * image_shrink() averages them; lines, markers and letters keep their size in the picture. Use a renderer only from the
 * thread that opened it.
 */
#ifndef DRAW_RENDERER_H
#define DRAW_RENDERER_H

#include "context.h"
#include "scene.h"

typedef struct renderer renderer;

/* "integers", "checked", "gl"; null from DRAW_FILLS on. */
const char *draw_fill_name(int fill);

/* The rasterizer that draws, and its context. The strings are valid while the renderer is open. */
typedef struct renderer_info {
    const char *context;                     /* "osmesa", "egl" */
    const char *vendor, *renderer, *version; /* GL's own strings */
    const char *fill; /* the rasterizer, "integers" or "gl"; unless it is "gl", all other members are null */
} renderer_info;

/* Open a renderer of this size in samples. Null with an error: the size is outside 1..VIEW_MAX_SIDE, there is no
 * memory, or, where GL draws, surface_open() fails. */
renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error);
void renderer_close(renderer *r);

renderer_info renderer_describe(const renderer *r);

/* Draw a scene whose picture has the renderer's size in samples into width * height indices, rows from the top. */
bool renderer_draw_scene(renderer *r, const scene *s, uint8_t *indices, octreel_error *error);

/* Draw the scene of the last renderer_draw_scene() again, with GL: for DRAW_FILL_CHECKED. The first call loads GL. *by:
 * the context that draws. False with an error where GL cannot be loaded or fails. */
bool renderer_redraw_with_gl(renderer *r, uint8_t *indices, draw_context *by, octreel_error *error);

/* The colours of samples with the index THEME_OWN in the last scene: r, g, b for each sample. Null where the view gives
 * points no colours of their own. Valid until the next scene. */
const uint8_t *renderer_sample_colors(const renderer *r);

/* The number of elements of the last scene that cannot be drawn: not finite, or too far away for doubles. */
size_t renderer_left_out_count(const renderer *r);

#endif
