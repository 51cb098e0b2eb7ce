/* SPDX-License-Identifier: MIT */
/* context_osmesa.c - OSMesa, Mesa's off-screen context. The library is loaded at run time, so that the program also
 * starts on machines without the library. */
#include "context.h"

#include <GL/osmesa.h>
#include <stdlib.h>

/* The side of OSMesa's own buffer, in pixels. OSMesa requires a buffer, although Octreel draws into a framebuffer
 * object. */
#define OWN_SIDE 4

typedef struct osmesa_context {
    context face;
    OSMesaContext mesa;
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*destroy)(OSMesaContext);
    OSMESAproc (*find_function)(const char *);
    unsigned char own[OWN_SIDE * OWN_SIDE * 4];
} osmesa_context;

static bool make_current(context *face)
{
    osmesa_context *c = (osmesa_context *)face;
    return c->make_current(c->mesa, c->own, GL_UNSIGNED_BYTE, OWN_SIDE, OWN_SIDE);
}

static context_function find_function(const context *face, const char *name)
{
    return (context_function)((const osmesa_context *)face)->find_function(name);
}

/* Closes a context. Does not unload the library, because Mesa's threads and LLVM do not survive an unload followed by a
 * second load. */
static void close_context(context *face)
{
    osmesa_context *c = (osmesa_context *)face;
    if (c->mesa)
        c->destroy(c->mesa);
    free(c);
}

static bool create_mesa_context(osmesa_context *c)
{
    OSMesaContext (*create)(const int *, OSMesaContext);
    void *library = c->face.library;
    if (!context_find_symbol(library, "OSMesaCreateContextAttribs", &create, sizeof create) ||
        !context_find_symbol(library, "OSMesaMakeCurrent", &c->make_current, sizeof c->make_current) ||
        !context_find_symbol(library, "OSMesaDestroyContext", &c->destroy, sizeof c->destroy) ||
        !context_find_symbol(library, "OSMesaGetProcAddress", &c->find_function, sizeof c->find_function))
        return false;
    const int wanted[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, OSMESA_DEPTH_BITS, 0, 0, 0};
    c->mesa = create(wanted, NULL);
    return c->mesa && make_current(&c->face);
}

context *context_osmesa_open(const renderer_choice *choice, octreel_error *error)
{
    (void)choice; /* unused, because OSMesa always draws with the CPU */
    static const context face = {
        .kind = DRAW_OSMESA, .make_current = make_current, .find_function = find_function, .close = close_context};
    osmesa_context *c = context_create(&face, sizeof *c, (const char *const[]){"libOSMesa.so.8", "libOSMesa.so"},
                                       "OSMesa, the off-screen renderer, cannot be loaded (Debian: libosmesa6)", error);
    if (!c)
        return NULL;
    if (create_mesa_context(c))
        return &c->face;
    error_set(error, "OSMesa cannot create an OpenGL compatibility context");
    close_context(&c->face);
    return NULL;
}
