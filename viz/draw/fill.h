/* SPDX-License-Identifier: MIT */
/* fill.h - fills quads, with the integer rasterizer or with GL. Both give exactly the same pixels. Private to this
 * folder. */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "quads.h"
#include "renderer.h"

/* A rectangle of samples. */
typedef struct renderer_part {
    int x, y, width, height;
} renderer_part;

/* The integer rasterizer: fill quads in this order; `bytes` is that part of the picture. Corners may be up to 2^22
 * pixels away from it. */
void fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);

/* ---- canvas.c: the integer rasterizer with a memory ----------------------------------------------------------
 *
 * Where a frame begins with the same quads as the last one, for example the tree's boxes under a still camera, their
 * pixels are copied instead. */

/* Empty when everything but the size is zero. */
typedef struct canvas {
    int width, height;
    quad_list last;    /* the quads of the last frame */
    uint8_t *kept;     /* the picture of the first kept_count quads of `last` alone */
    size_t kept_count; /* 0: no picture is kept */
} canvas;

void canvas_release(canvas *c);

/* Fill quads on a background of zeros. Returns the number of quads that were filled rather than copied. Swaps the list
 * with c->last, so that afterwards c->last holds these quads and `quads` the buffers of the last frame. */
size_t canvas_fill_quads(canvas *c, quad_list *quads, uint8_t *indices);

/* ---- gl_surface.c -------------------------------------------------------------------------------------------- */

/* A GL framebuffer. gl_surface.c implements it; programs without GL have no_gl.c instead. */
typedef struct surface surface;
struct surface {
    /* Fill quads in this order on a background of zeros, and read a part of the result. */
    bool (*fill)(surface *s, const quad *quads, size_t count, renderer_part part, uint8_t *bytes, octreel_error *error);
    renderer_info (*about)(surface *s);
    void (*close)(surface *s);
};

/* Open a framebuffer of this size in samples. Null with an error: there is no such context, its driver is not llvmpipe,
 * or it gives no framebuffer of this size. Cost: about 0.2 s of processor time for loading Mesa and LLVM, and 85 MB. */
surface *surface_open(int width, int height, const renderer_choice *choice, octreel_error *error);

/* ---- renderer.c ---------------------------------------------------------------------------------------------- */

/* True if a scene's picture has the renderer's size in samples; an error where it does not. */
bool renderer_fits_scene(const renderer *r, const scene *s, octreel_error *error);

/* Fill quads with the renderer's rasterizer, in this order on a background of zeros, and read a part of the result. */
bool renderer_fill_quads(renderer *r, const quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                         octreel_error *error);

#endif
