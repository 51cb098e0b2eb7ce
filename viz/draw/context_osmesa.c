/* context_osmesa.c - Mesa's off-screen context, opened at run time: without the library there is a sentence and not a
 * program that does not start. */
#include "context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The framebuffer object is what is drawn to; Mesa wants a buffer for its own all the same. */
#define OWN_SIDE 4

struct context {
    void *library;
    OSMesaContext mesa;
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    OSMesaContext (*current)(void);
    void (*destroy)(OSMesaContext);
    OSMESAproc (*find)(const char *);
    unsigned char own[OWN_SIDE * OWN_SIDE * 4];
};

static const char *const library_names[] = {"libOSMesa.so.8", "libOSMesa.so"};

static void *open_library(draw_error *error)
{
    void *library = NULL;
    for (size_t i = 0; !library && i < sizeof library_names / sizeof library_names[0]; i++)
        library = dlopen(library_names[i], RTLD_NOW | RTLD_LOCAL);
    if (!library)
        snprintf(error->text, sizeof error->text,
                 "OSMesa, the off-screen renderer, cannot be loaded (Debian: libosmesa6): %s", dlerror());
    return library;
}

/* ISO C has no cast from an object pointer to a function pointer; POSIX promises that the bits are the same. */
static bool find_symbol(void *library, const char *name, void *function, size_t size)
{
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, size);
    return symbol != NULL;
}

static bool open_mesa(context *c)
{
    OSMesaContext (*create)(const int *, OSMesaContext);
    if (!find_symbol(c->library, "OSMesaCreateContextAttribs", &create, sizeof create) ||
        !find_symbol(c->library, "OSMesaMakeCurrent", &c->make_current, sizeof c->make_current) ||
        !find_symbol(c->library, "OSMesaGetCurrentContext", &c->current, sizeof c->current) ||
        !find_symbol(c->library, "OSMesaDestroyContext", &c->destroy, sizeof c->destroy) ||
        !find_symbol(c->library, "OSMesaGetProcAddress", &c->find, sizeof c->find))
        return false;
    const int wanted[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, OSMESA_DEPTH_BITS, 0, 0, 0};
    c->mesa = create(wanted, NULL);
    return c->mesa && context_use(c);
}

bool context_use(context *c)
{
    return c->current() == c->mesa || c->make_current(c->mesa, c->own, GL_UNSIGNED_BYTE, OWN_SIDE, OWN_SIDE);
}

context *context_open(draw_error *error)
{
    context *c = calloc(1, sizeof *c);
    if (!c) {
        snprintf(error->text, sizeof error->text, "there is no memory for a context");
        return NULL;
    }
    c->library = open_library(error);
    if (c->library && open_mesa(c))
        return c;
    if (c->library)
        snprintf(error->text, sizeof error->text, "OSMesa gives no compatibility context");
    context_close(c);
    return NULL;
}

void context_close(context *c)
{
    if (!c)
        return;
    if (c->mesa)
        c->destroy(c->mesa);
    /* The library stays loaded: Mesa's threads and LLVM do not survive being unloaded and loaded again. */
    free(c);
}

const char *context_name(const context *c)
{
    (void)c;
    return "osmesa";
}

context_function context_find(const context *c, const char *name)
{
    return (context_function)c->find(name);
}
