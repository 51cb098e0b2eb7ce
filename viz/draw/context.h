/* SPDX-License-Identifier: MIT */
/* context.h - the kinds of off-screen GL contexts: their names, and the interface that gl_surface.c draws through.
 * context_osmesa.c and context_egl.c are one kind each; CMake chooses which of them are built. */
#ifndef DRAW_CONTEXT_H
#define DRAW_CONTEXT_H

#include "error.h"

#include <stddef.h>

/* In the order in which DRAW_AUTO tries those that are built. */
typedef enum draw_context { DRAW_AUTO, DRAW_OSMESA, DRAW_EGL, DRAW_CONTEXTS } draw_context;

/* "auto", "osmesa", "egl"; null from DRAW_CONTEXTS on. And the inverse; false when there is no such name. */
const char *draw_context_name(draw_context kind);
bool draw_context_parse(const char *name, draw_context *kind);

/* Whether this program was built with it. */
bool draw_context_built(draw_context kind);

/* What fills the quads of a frame. Both rasterizers give the same pixels. */
typedef enum draw_fill {
    DRAW_FILL_INTEGERS, /* the integer rasterizer; GL is never loaded */
    DRAW_FILL_CHECKED,  /* the integer rasterizer; GL is loaded at the first renderer_redraw() */
    DRAW_FILL_GL,
    DRAW_FILLS
} draw_fill;

/* How to draw. All zero: with the integer rasterizer alone. */
typedef struct renderer_choice {
    draw_context context; /* which GL, where GL is loaded */
    draw_fill fill;
    bool any_renderer; /* draw with GL, whatever `fill` is, and accept drivers other than llvmpipe: a graphics card */
} renderer_choice;

/* Called when DRAW_AUTO opens context `name` because `instead_of`, which is installed, cannot be opened; `why` is the
 * reason. Each process has one such function. Null, the default: no report. */
typedef void draw_context_report(const char *name, const char *instead_of, const char *why);
void draw_context_set_report(draw_context_report *report);

/* ---- For this folder ---------------------------------------------------------------------------------------- */

typedef void (*context_function)(void);

/* The first member of each kind's own struct. */
typedef struct context context;
struct context {
    const char *name;

    /* Make it current in any case: contexts of different kinds share Mesa's notion of the current one, so a library's
     * own answer about it may be outdated. */
    bool (*use)(context *c);

    /* A GL function of this context's own library: two GL libraries in one process have the same symbols. Null when
     * unknown. */
    context_function (*find)(const context *c, const char *name);

    void (*close)(context *c);
};

/* llvmpipe waits for ever for threads that it could not start: where as many as it takes cannot be started, it is told
 * to draw without. The pixels are the same. */
void context_limit_threads(void);

/* Open a context and make it current. Null, with an error, when that fails. */
typedef context *context_opener(const renderer_choice *choice, octreel_error *error);
context_opener context_osmesa_open, context_egl_open;

/* The context of a choice; under DRAW_AUTO the first kind that opens. */
context_opener context_open;

/* For the kinds: open a library by either of two names; null, with an error, when neither is found. And look up one of
 * its functions, which is written to *function, a function pointer of `size` bytes. */
void *context_load(const char *name, const char *other_name, const char *sentence, octreel_error *error);
bool context_symbol(void *library, const char *name, void *function, size_t size);

#endif
