/* context.h - an off-screen GL context and its functions. One kind a file, context_osmesa.c and context_egl.c; which of
 * them are there is CMake's choice, and context.c picks one. Private. */
#ifndef DRAW_CONTEXT_H
#define DRAW_CONTEXT_H

#include "renderer.h"

typedef void (*context_function)(void);

/* What the kinds begin their own structs with. */
typedef struct context context;
struct context {
    const char *name;

    /* Make it current, whatever was: contexts of several kinds share what Mesa calls current, and only their own
     * library tells the truth about it. */
    bool (*use)(context *c);

    /* A GL function of this very context: two GL libraries in one process have the same symbols. Null when unknown. */
    context_function (*find)(const context *c, const char *name);

    void (*close)(context *c);
};

/* A kind opens a context and makes it current. Null, and a sentence, when it cannot be. */
typedef context *context_opener(const renderer_choice *choice, octreel_error *error);
context_opener context_osmesa_open, context_egl_open;

/* The context of a choice; under DRAW_AUTO the first kind that opens. */
context_opener context_open;

/* For the kinds: open the first library of these names that there is; null, with a sentence, when there is none. And
 * find one of its functions, which goes into *function, a pointer to a function of `size` bytes. */
void *context_load(const char *const *names, size_t count, const char *sentence, octreel_error *error);
bool context_symbol(void *library, const char *name, void *function, size_t size);

#endif
