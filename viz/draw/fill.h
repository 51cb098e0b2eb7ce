/* SPDX-License-Identifier: MIT */
/* fill.h - fills quads, with the integer rasterizer or with GL. Both rasterizers give exactly the same pixels. Private
 * to this folder. */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "quads.h"
#include "renderer.h"

/* A rectangle of the picture, in samples. */
typedef struct renderer_part {
    int x, y, width, height;
} renderer_part;

/* Fill quads, in the given order, with the integer rasterizer. `bytes` holds the samples of the rectangle `part`, one
 * byte for each sample. Corners of quads may be up to 2^22 pixels away from `part`. */
void fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes);

/* ---- canvas.c: the integer rasterizer with a cache ------------------------------------------------------------
 *
 * If a frame begins with the same quads as the last frame, for example with the tree's boxes under a still camera, the
 * pixels of these quads are copied instead of filled. */

/* The integer rasterizer with a cache of the previous frame. The cache is empty if all members except width and height
 * are zero. */
typedef struct canvas {
    int width, height;
    quad_list last;    /* the quads of the previous frame */
    uint8_t *kept;     /* a picture of only the first kept_count quads of `last` */
    size_t kept_count; /* number of quads in the picture `kept`; 0: no picture is kept */
} canvas;

void canvas_release(canvas *c);

/* Fill quads on a background of zeros. Returns the number of quads that were filled rather than copied from the cache.
 * Swaps *quads with c->last: afterwards c->last holds the new quads, and *quads holds the buffers of the previous frame
 * for reuse. */
size_t canvas_fill_quads(canvas *c, quad_list *quads, uint8_t *indices);

/* ---- gl_surface.c -------------------------------------------------------------------------------------------- */

/* A GL framebuffer. gl_surface.c implements the framebuffer; programs that are built without GL have no_gl.c
 * instead. */
typedef struct surface surface;
struct surface {
    /* Fill quads, in the given order, on a background of zeros. Read a part of the picture into `bytes`. */
    bool (*fill)(surface *s, const quad *quads, size_t count, renderer_part part, uint8_t *bytes, octreel_error *error);
    renderer_info (*about)(surface *s);
    void (*close)(surface *s);
};

/* Open a framebuffer of this size in samples. Returns null with an error if the context is not available, if its driver
 * is not llvmpipe, or if the driver refuses the size. Cost: about 0.2 s of processor time and 85 MB, to load Mesa and
 * LLVM. */
surface *surface_open(int width, int height, const renderer_choice *choice, octreel_error *error);

/* ---- renderer.c ---------------------------------------------------------------------------------------------- */

/* Returns true if the picture of a scene has the renderer's size in samples; otherwise false with an error. */
bool renderer_fits_scene(const renderer *r, const scene *s, octreel_error *error);

/* Fill quads, in the given order, with the renderer's rasterizer on a background of zeros. Read a part of the picture
 * into `bytes`. */
bool renderer_fill_quads(renderer *r, const quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                         octreel_error *error);

#endif
