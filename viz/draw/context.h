/* context.h - an off-screen GL context and its functions. One implementation a file: context_osmesa.c. Private. */
#ifndef DRAW_CONTEXT_H
#define DRAW_CONTEXT_H

#include "draw.h"

typedef struct context context;
typedef void (*context_function)(void);

/* Open a context and make it current. Null, and a sentence, when it cannot be. */
context *context_open(draw_error *error);
void context_close(context *c);

/* Make it current again, where another one is. */
bool context_use(context *c);

const char *context_name(const context *c);

/* A GL function of this very context: two GL libraries in one process have the same symbols. Null when unknown. */
context_function context_find(const context *c, const char *name);

#endif
