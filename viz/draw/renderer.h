/* SPDX-License-Identifier: MIT */
/* renderer.h - draws scenes as pictures of one size. Each pixel is an index into the theme's table of colours.
 *
 * paint.h turns a scene into flat quads. The integer rasterizer (fill.h) or GL (gl_surface.c) fills these quads; both
 * give the same pixels. With anti-aliasing, a renderer draws view.aa times as many samples on each axis, and
 * image_shrink() averages the samples of each pixel. Lines, markers and text keep their size in the picture. A renderer
 * may be used only from the thread that opened it. */
#ifndef DRAW_RENDERER_H
#define DRAW_RENDERER_H

#include "context.h"
#include "scene.h"

typedef struct renderer renderer;

/* Returns "integers", "checked" or "gl". Returns null if `fill` is not below DRAW_FILLS. */
const char *draw_fill_name(int fill);

/* A description of the rasterizer and its GL context. The strings are valid while the renderer is open. */
typedef struct renderer_info {
    draw_context kind;                       /* the kind of GL context; DRAW_AUTO without GL */
    const char *context;                     /* name of the GL context: "osmesa" or "egl" */
    const char *vendor, *renderer, *version; /* the strings of glGetString() */
    const char *fill; /* the rasterizer: "integers" or "gl"; with "integers" all other texts are null */
} renderer_info;

/* Open a renderer of this size in samples. Returns null with an error if a side is outside 1..VIEW_MAX_SIDE, if memory
 * runs out, or if GL is to draw and surface_open() fails. */
renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error);
void renderer_close(renderer *r);

renderer_info renderer_describe(const renderer *r);

/* Draw a scene as width * height indices of colours, rows from the top down. The scene's picture must have the
 * renderer's size in samples. Returns false with an error on failure. */
bool renderer_draw_scene(renderer *r, const scene *s, uint8_t *indices, octreel_error *error);

/* Draw again, with GL, the scene that renderer_draw_scene() drew last. This function is for DRAW_FILL_CHECKED. The
 * first call loads GL. *by receives the kind of context that drew. Returns false with an error if GL cannot be loaded
 * or fails. */
bool renderer_redraw_with_gl(renderer *r, uint8_t *indices, draw_context *by, octreel_error *error);

/* Returns an array of r, g, b for each sample of the last drawn scene. The colours are valid only for samples with the
 * index THEME_OWN. Returns null if all colours of the view are in the theme's table. The array is valid until the next
 * scene is drawn. */
const uint8_t *renderer_sample_colors(const renderer *r);

/* Returns the number of elements of the last drawn scene that cannot be drawn: their coordinates are not finite, or
 * overflow a double when they are projected. */
size_t renderer_left_out_count(const renderer *r);

#endif
