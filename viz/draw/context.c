/* SPDX-License-Identifier: MIT */
#include "context.h"

#include <dlfcn.h>
#include <string.h>

static const struct {
    const char *name;
    context_opener *open; /* null: not built */
} kinds[DRAW_CONTEXTS] = {
    [DRAW_AUTO] = {"auto", context_open},
#ifdef OCTREEL_OSMESA
    [DRAW_OSMESA] = {"osmesa", context_osmesa_open},
#else
    [DRAW_OSMESA] = {"osmesa", NULL},
#endif
#ifdef OCTREEL_EGL
    [DRAW_EGL] = {"egl", context_egl_open},
#else
    [DRAW_EGL] = {"egl", NULL},
#endif
};

const char *draw_context_name(draw_context kind)
{
    return (unsigned)kind < DRAW_CONTEXTS ? kinds[kind].name : NULL;
}

bool draw_context_parse(const char *name, draw_context *kind)
{
    for (int i = 0; i < DRAW_CONTEXTS; i++) {
        if (strcmp(name, kinds[i].name) == 0) {
            *kind = (draw_context)i;
            return true;
        }
    }
    return false;
}

bool draw_context_built(draw_context kind)
{
    return (unsigned)kind < DRAW_CONTEXTS && kinds[kind].open;
}

/* When none opens, the first one's error is reported. */
static context *open_any(const renderer_choice *choice, octreel_error *error)
{
    octreel_error *reason = error, later;
    for (int i = DRAW_AUTO + 1; i < DRAW_CONTEXTS; i++) {
        context *c = kinds[i].open ? kinds[i].open(choice, reason) : NULL;
        if (c)
            return c;
        if (kinds[i].open)
            reason = &later;
    }
    return NULL;
}

context *context_open(const renderer_choice *choice, octreel_error *error)
{
    if (choice->context == DRAW_AUTO)
        return open_any(choice, error);
    if (draw_context_built(choice->context))
        return kinds[choice->context].open(choice, error);
    error_set(error, "this program was built without the %s context", draw_context_name(choice->context));
    return NULL;
}

void *context_load(const char *name, const char *other_name, const char *sentence, octreel_error *error)
{
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    library = library ? library : dlopen(other_name, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        error_set(error, "%s: %s", sentence, dlerror());
    return library;
}

/* ISO C has no cast from an object pointer to a function pointer; POSIX promises that the bits are the same. */
bool context_symbol(void *library, const char *name, void *function, size_t size)
{
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, size);
    return symbol != NULL;
}
