/* SPDX-License-Identifier: MIT */
/* context.h - off-screen GL contexts: the names of their kinds, and the interface that gl_surface.c uses.
 * context_osmesa.c and context_egl.c implement one kind each; CMake chooses which of them are compiled. */
#ifndef DRAW_CONTEXT_H
#define DRAW_CONTEXT_H

#include "error.h"

#include <stddef.h>

/* The kinds of GL contexts. DRAW_AUTO tries DRAW_OSMESA first, then DRAW_EGL. */
typedef enum draw_context { DRAW_AUTO, DRAW_OSMESA, DRAW_EGL, DRAW_CONTEXTS } draw_context;

/* Returns "auto", "osmesa" or "egl"; null if `kind` is not below DRAW_CONTEXTS. */
const char *draw_context_name(int kind);

/* True if this program was compiled with this kind of context. */
bool draw_context_is_built(draw_context kind);

/* The rasterizer that fills the quads of a frame. Both rasterizers give the same pixels. */
typedef enum draw_fill {
    DRAW_FILL_INTEGERS, /* the integer rasterizer; GL is never loaded */
    DRAW_FILL_CHECKED,  /* the integer rasterizer; the first renderer_redraw_with_gl() loads GL */
    DRAW_FILL_GL,
    DRAW_FILLS
} draw_fill;

/* The choice of a rasterizer and a GL context. All zero: the integer rasterizer, without GL. */
typedef struct renderer_choice {
    draw_context context; /* the kind of GL context, if GL is loaded */
    draw_fill fill;
    bool any_renderer; /* draw with GL, whatever `fill` is, and accept any driver, such as a graphics card's */
} renderer_choice;

/* Called when DRAW_AUTO falls back to the context `name`: the preferred context `instead_of` is installed but cannot be
 * opened, for the reason `why`. The function is global to the process. Null, the default: no report. */
typedef void draw_context_report(const char *name, const char *instead_of, const char *why);
void draw_context_set_report(draw_context_report *report);

/* ---- Private to this folder ---------------------------------------------------------------------------------- */

typedef void (*context_function)(void);

/* The members that all kinds of contexts have. It is the first member of the struct of each kind. */
typedef struct context context;
struct context {
    draw_context kind;
    void *library; /* handle of the loaded library, set by context_create() */

    /* Make the context current, even if its library reports that it is current already: contexts of different kinds
     * share Mesa's current context, so a library may not notice that another library changed it. */
    bool (*make_current)(context *c);

    /* Look up a GL function in this context's own library, because two GL libraries in one process export the same
     * symbols. Null if the library does not have the function. */
    context_function (*find_function)(const context *c, const char *name);

    void (*close)(context *c);
};

/* Set LP_NUM_THREADS=0 if this process cannot start as many threads as llvmpipe uses. llvmpipe then draws in the
 * calling thread, with the same pixels. Otherwise it would wait forever for a thread that did not start. */
void context_limit_threads(void);

/* Open a context and make it current. Null with an error. */
typedef context *context_opener(const renderer_choice *choice, octreel_error *error);
context_opener context_osmesa_open, context_egl_open;

/* Opens a context of the kind in choice->context; for DRAW_AUTO, of the first kind that can be opened. */
context_opener context_open;

/* Load a library, which has two possible file names, and allocate a context of `size` bytes: a copy of `face`, then
 * zeros. Null with an error; if the library cannot be loaded, the error begins with `sentence`. */
void *context_create(const context *face, size_t size, const char *const names[2], const char *sentence,
                     octreel_error *error);

/* Look up a function of a library and write its address to *function, a function pointer of `size` bytes. False if the
 * library does not have it. */
bool context_find_symbol(void *library, const char *name, void *function, size_t size);

#endif
