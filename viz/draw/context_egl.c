/* SPDX-License-Identifier: MIT */
/* context_egl.c - an EGL context without a display, surface or configuration. Such a context draws off-screen also with
 * versions of Mesa that no longer have OSMesa (25.1 and later).
 *
 * EGL prefers graphics cards, so the software device is requested if EGL can list devices. The library is loaded at run
 * time. */
#include "context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

#define MOST_DEVICES 32

typedef struct egl {
    PFNEGLGETPROCADDRESSPROC GetProcAddress;
    PFNEGLQUERYSTRINGPROC QueryString;
    PFNEGLGETERRORPROC GetError;
    PFNEGLINITIALIZEPROC Initialize;
    PFNEGLBINDAPIPROC BindAPI;
    PFNEGLCREATECONTEXTPROC CreateContext;
    PFNEGLDESTROYCONTEXTPROC DestroyContext;
    PFNEGLMAKECURRENTPROC MakeCurrent;
} egl;

typedef struct egl_context {
    context face;
    egl egl;
    EGLDisplay display;
    EGLContext mesa;
} egl_context;

static bool load_egl_functions(egl *egl, void *library)
{
#define EGL_FIND(name) context_find_symbol(library, "egl" #name, &egl->name, sizeof egl->name)
    return EGL_FIND(GetProcAddress) && EGL_FIND(QueryString) && EGL_FIND(GetError) && EGL_FIND(Initialize) &&
           EGL_FIND(BindAPI) && EGL_FIND(CreateContext) && EGL_FIND(DestroyContext) && EGL_FIND(MakeCurrent);
#undef EGL_FIND
}

static bool contains(const char *list, const char *word)
{
    return list && strstr(list, word);
}

/* Returns the EGL device that draws with the CPU. Returns null if EGL cannot list devices, or if no device draws with
 * the CPU. */
static EGLDeviceEXT find_software_device(const egl *egl)
{
    const PFNEGLQUERYDEVICESEXTPROC list = (PFNEGLQUERYDEVICESEXTPROC)egl->GetProcAddress("eglQueryDevicesEXT");
    const PFNEGLQUERYDEVICESTRINGEXTPROC describe =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->GetProcAddress("eglQueryDeviceStringEXT");
    const char *known = egl->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    EGLDeviceEXT devices[MOST_DEVICES];
    EGLint count = 0;
    if (!list || !describe || !contains(known, "EGL_EXT_platform_device") || !list(MOST_DEVICES, devices, &count))
        return NULL;
    for (EGLint i = 0; i < count; i++)
        if (contains(describe(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
            return devices[i];
    return NULL;
}

/* Initialize a display for off-screen drawing: the display of the software device or, if there is no such device, the
 * display without a window system. */
static EGLDisplay open_display(const egl *egl, bool any_renderer)
{
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl->GetProcAddress("eglGetPlatformDisplayEXT");
    const EGLDeviceEXT device = any_renderer ? NULL : find_software_device(egl);
    EGLDisplay display = get && device ? get(EGL_PLATFORM_DEVICE_EXT, device, NULL) : EGL_NO_DISPLAY;
    if (display && egl->Initialize(display, NULL, NULL))
        return display;
    display = get ? get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : EGL_NO_DISPLAY;
    return display && egl->Initialize(display, NULL, NULL) ? display : EGL_NO_DISPLAY;
}

/* Makes a context current. Releases the context first: EGL ignores the call for a context that it believes to be
 * current, even if another library has made a different context current. */
static bool make_current(context *face)
{
    const egl_context *c = (const egl_context *)face;
    const egl *egl = &c->egl;
    return egl->BindAPI(EGL_OPENGL_API) &&
           egl->MakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT) &&
           egl->MakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->mesa);
}

static context_function find_function(const context *face, const char *name)
{
    return ((const egl_context *)face)->egl.GetProcAddress(name);
}

/* Closes a context. Does not terminate the display, because all contexts of the process share the display. */
static void close_context(context *face)
{
    egl_context *c = (egl_context *)face;
    if (c->mesa) {
        c->egl.MakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        c->egl.DestroyContext(c->display, c->mesa);
    }
    free(c);
}

static bool create_mesa_context(egl_context *c, bool any_renderer)
{
    const egl *egl = &c->egl;
    c->display = open_display(egl, any_renderer);
    if (!c->display || !egl->BindAPI(EGL_OPENGL_API))
        return false;
    c->mesa = egl->CreateContext(c->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, NULL);
    return c->mesa && make_current(&c->face);
}

context *context_egl_open(const renderer_choice *choice, octreel_error *error)
{
    static const context face = {
        .kind = DRAW_EGL, .make_current = make_current, .find_function = find_function, .close = close_context};
    egl_context *c = context_create(&face, sizeof *c, (const char *const[]){"libEGL.so.1", "libEGL.so"},
                                    "EGL, the off-screen renderer, cannot be loaded (Debian: libegl1)", error);
    if (!c)
        return NULL;
    if (load_egl_functions(&c->egl, c->face.library) && create_mesa_context(c, choice->any_renderer))
        return &c->face;
    error_set(error,
              "EGL cannot create an OpenGL context without a display (Debian: libegl-mesa0 and libgl1-mesa-dri): error "
              "0x%04x",
              c->egl.GetError ? (unsigned)c->egl.GetError() : 0);
    close_context(&c->face);
    return NULL;
}
