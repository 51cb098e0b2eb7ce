/* SPDX-License-Identifier: MIT */
/* context.h - off-screen GL contexts: the names of the kinds of contexts, and the interface that gl_surface.c uses.
 * context_osmesa.c and context_egl.c implement one kind each; CMake chooses which of these two files are compiled. */
#ifndef DRAW_CONTEXT_H
#define DRAW_CONTEXT_H

#include "error.h"

#include <stddef.h>

/* The kinds of GL contexts. DRAW_AUTO tries DRAW_OSMESA first, then DRAW_EGL. */
typedef enum draw_context { DRAW_AUTO, DRAW_OSMESA, DRAW_EGL, DRAW_CONTEXTS } draw_context;

/* Returns "auto", "osmesa" or "egl". Returns null if `kind` is not below DRAW_CONTEXTS. */
const char *draw_context_name(int kind);

/* Returns whether this program was compiled with this kind of context. */
bool draw_context_is_built(draw_context kind);

/* The rasterizer that fills the quads of a frame. Both rasterizers give the same pixels. */
typedef enum draw_fill {
    DRAW_FILL_INTEGERS, /* draw with the integer rasterizer; never load GL */
    DRAW_FILL_CHECKED,  /* draw with the integer rasterizer; the first call of renderer_redraw_with_gl() loads GL */
    DRAW_FILL_GL,
    DRAW_FILLS
} draw_fill;

/* The choice of a rasterizer and a GL context. A zeroed struct chooses the integer rasterizer, without GL. */
typedef struct renderer_choice {
    draw_context context; /* the kind of GL context, if GL is loaded */
    draw_fill fill;
    /* true: draw with GL, whatever `fill` is, and accept any driver, also the driver of a graphics card */
    bool any_renderer;
} renderer_choice;

/* A function that is called when DRAW_AUTO falls back to the context `name`: the preferred context `instead_of` is
 * installed but cannot be opened, for the reason `why`. A process has one such function. By default the function is
 * null, and nothing is reported. */
typedef void draw_context_report(const char *name, const char *instead_of, const char *why);
void draw_context_set_report(draw_context_report *report);

/* ---- Private to this folder ---------------------------------------------------------------------------------- */

typedef void (*context_function)(void);

/* The members that all kinds of contexts have. This struct is the first member of the struct of each kind. */
typedef struct context context;
struct context {
    draw_context kind;
    void *library; /* handle of the loaded library, set by context_create() */

    /* Make the context current, even if its library reports that the context is current already. OSMesa and EGL share
     * the current context of Mesa, and one library may not notice that the other has changed the current context. */
    bool (*make_current)(context *c);

    /* Look up a GL function in this context's own library, because two GL libraries in one process export the same
     * symbols. Returns null if the library does not have the function. */
    context_function (*find_function)(const context *c, const char *name);

    void (*close)(context *c);
};

/* Set LP_NUM_THREADS=0 if this process cannot start as many threads as llvmpipe uses. llvmpipe then draws in the
 * calling thread, with the same pixels. Without this setting, llvmpipe would wait forever for a thread that did not
 * start. */
void context_limit_threads(void);

/* Open a context and make it current. Returns null with an error on failure. */
typedef context *context_opener(const renderer_choice *choice, octreel_error *error);
context_opener context_osmesa_open, context_egl_open;

/* Opens a context of the kind choice->context. For DRAW_AUTO, opens a context of the first kind that can be opened. */
context_opener context_open;

/* Load a library, which has two possible file names, and allocate a context of `size` bytes, which begins with a copy
 * of *face; the other bytes are zero. Returns null with an error on failure. If the library cannot be loaded, the error
 * begins with `sentence`. */
void *context_create(const context *face, size_t size, const char *const names[2], const char *sentence,
                     octreel_error *error);

/* Look up a function of a library and write its address to *function, a function pointer of `size` bytes. Returns false
 * if the library does not have the function. */
bool context_find_symbol(void *library, const char *name, void *function, size_t size);

#endif
