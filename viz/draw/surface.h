/* SPDX-License-Identifier: MIT */
/* surface.h - a GL framebuffer that fills quads. gl_surface.c implements it; programs without GL have no_gl.c instead.
 * Private to this folder. */
#ifndef DRAW_SURFACE_H
#define DRAW_SURFACE_H

#include "quads.h"
#include "renderer.h"

/* The first member of gl_surface. */
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

#endif
