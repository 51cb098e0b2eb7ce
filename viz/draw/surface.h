/* SPDX-License-Identifier: MIT */
/* surface.h - what fills quads in a renderer's stead: GL, in gl_surface.c, or nothing. For this folder. */
#ifndef DRAW_SURFACE_H
#define DRAW_SURFACE_H

#include "quads.h"
#include "renderer.h"

/* The first member of each kind's own struct. */
typedef struct surface surface;
struct surface {
    /* Fill quads in this order on a ground of zeros, and read a part of the result. */
    bool (*fill)(surface *s, const quad *quads, size_t count, renderer_part part, uint8_t *bytes, octreel_error *error);
    renderer_info (*about)(surface *s);
    void (*close)(surface *s);
};

/* Give a renderer a surface, which it closes; all quads are filled there if `fills`, else none. */
void renderer_use_surface(renderer *r, surface *s, bool fills);

#endif
