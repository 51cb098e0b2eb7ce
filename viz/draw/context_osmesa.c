/* SPDX-License-Identifier: MIT */
/* context_osmesa.c - Mesa's off-screen context. The library is loaded at run time, so that the program starts without
 * it.
 */
#include "context.h"

#include <GL/osmesa.h>
#include <stdlib.h>

/* Octreel draws into a framebuffer object, but OSMesa requires a buffer as well; a tiny one will do. */
#define OWN_SIDE 4

typedef struct osmesa_context {
    context face;
    OSMesaContext mesa;
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*destroy)(OSMesaContext);
    OSMESAproc (*find)(const char *);
    unsigned char own[OWN_SIDE * OWN_SIDE * 4];
} osmesa_context;

static bool use(context *face)
{
    osmesa_context *c = (osmesa_context *)face;
    return c->make_current(c->mesa, c->own, GL_UNSIGNED_BYTE, OWN_SIDE, OWN_SIDE);
}

static context_function find(const context *face, const char *name)
{
    return (context_function)((const osmesa_context *)face)->find(name);
}

/* Keeps the library loaded: Mesa's threads and LLVM do not survive an unload followed by a second load. */
static void close_context(context *face)
{
    osmesa_context *c = (osmesa_context *)face;
    if (c->mesa)
        c->destroy(c->mesa);
    free(c);
}

static bool open_mesa(osmesa_context *c, void *library)
{
    OSMesaContext (*create)(const int *, OSMesaContext);
    if (!context_symbol(library, "OSMesaCreateContextAttribs", &create, sizeof create) ||
        !context_symbol(library, "OSMesaMakeCurrent", &c->make_current, sizeof c->make_current) ||
        !context_symbol(library, "OSMesaDestroyContext", &c->destroy, sizeof c->destroy) ||
        !context_symbol(library, "OSMesaGetProcAddress", &c->find, sizeof c->find))
        return false;
    const int wanted[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, OSMESA_DEPTH_BITS, 0, 0, 0};
    c->mesa = create(wanted, NULL);
    return c->mesa && use(&c->face);
}

context *context_osmesa_open(const renderer_choice *choice, octreel_error *error)
{
    (void)choice; /* OSMesa always draws with the CPU */
    void *library = context_load("libOSMesa.so.8", "libOSMesa.so",
                                 "OSMesa, the off-screen renderer, cannot be loaded (Debian: libosmesa6)", error);
    osmesa_context *c = library ? calloc(1, sizeof *c) : NULL;
    if (!c) {
        if (library)
            error_no_memory(error);
        return NULL;
    }
    c->face = (context){.name = "osmesa", .use = use, .find = find, .close = close_context};
    if (open_mesa(c, library))
        return &c->face;
    error_set(error, "OSMesa gives no compatibility context");
    close_context(&c->face);
    return NULL;
}
