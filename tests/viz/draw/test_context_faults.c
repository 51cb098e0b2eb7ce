/* SPDX-License-Identifier: MIT */
/* test_context_faults.c - missing functions and failures of OSMesa, EGL and GL: nothing is drawn, and the error says
 * why.
 *
 * The linker redirects the calls that open contexts and look up functions to this file (see tests/CMakeLists.txt). */
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "frames.h"

enum { SIDE = 16, MOST_NAMES = 64 };

/* The faults of a context's GL; null or zero: no fault. */
static struct {
    const char *missing, *driver;
    bool no_driver, not_current;
    GLint largest_view, largest_buffer;
    GLenum state, error;
} fault;

static const char *names[MOST_NAMES]; /* names of the GL functions that were looked up */
static size_t name_count;
static context real; /* the context that was opened last */

static const GLubyte *GLAPIENTRY get_driver(GLenum name)
{
    (void)name;
    return (const GLubyte *)fault.driver;
}

static void GLAPIENTRY get_limit(GLenum name, GLint *value)
{
    value[0] = SIDE;
    if (name == GL_MAX_VIEWPORT_DIMS)
        value[1] = fault.largest_view ? fault.largest_view : SIDE;
    else
        *value = fault.largest_buffer;
}

static GLenum GLAPIENTRY get_error(void)
{
    return fault.error;
}

static GLenum GLAPIENTRY get_state(GLenum target)
{
    (void)target;
    return fault.state;
}

static context_function find_function(const context *c, const char *name)
{
    if (name_count < MOST_NAMES)
        names[name_count++] = name;
    if (fault.missing && strcmp(name, fault.missing) == 0)
        return NULL;
    if ((fault.driver || fault.no_driver) && strcmp(name, "glGetString") == 0)
        return (context_function)get_driver;
    if ((fault.largest_view || fault.largest_buffer) && strcmp(name, "glGetIntegerv") == 0)
        return (context_function)get_limit;
    if (fault.error && strcmp(name, "glGetError") == 0)
        return (context_function)get_error;
    if (fault.state && strcmp(name, "glCheckFramebufferStatus") == 0)
        return (context_function)get_state;
    return real.find_function(c, name);
}

static bool make_current(context *c)
{
    return !fault.not_current && real.make_current(c);
}

context *__real_context_open(const renderer_choice *choice, octreel_error *error);
context *__wrap_context_open(const renderer_choice *choice, octreel_error *error);
void *__real_dlsym(void *library, const char *name);
void *__wrap_dlsym(void *library, const char *name);
void *__real_dlopen(const char *name, int how);
void *__wrap_dlopen(const char *name, int how);

context *__wrap_context_open(const renderer_choice *choice, octreel_error *error)
{
    context *c = __real_context_open(choice, error);
    if (c) {
        real = *c;
        c->find_function = find_function;
        c->make_current = make_current;
    }
    return c;
}

/* ---- GL ----------------------------------------------------------------------------------------------------- */

static void assert_refused(const char *why)
{
    octreel_error error = {""};
    renderer *r = renderer_open(SIDE, SIDE, &(renderer_choice){.fill = DRAW_FILL_GL}, &error);
    assert_null(r);
    assert_contains(error.text, why);
    memset(&fault, 0, sizeof fault);
}

static void error_names_the_missing_gl_function(void **state)
{
    (void)state;
    name_count = 0;
    renderer_close(open_gl_renderer(SIDE, SIDE));
    const size_t count = name_count;
    assert_true(count > 20 && count < MOST_NAMES);
    for (size_t i = 0; i < count; i++) {
        fault.missing = names[i];
        assert_refused(names[i]);
    }
}

static void driver_without_a_name_is_refused(void **state)
{
    (void)state;
    fault.no_driver = true;
    assert_refused("draws with \"nothing\"");
    fault.driver = "softpipe";
    assert_refused("draws with \"softpipe\"");
}

static void incomplete_framebuffer_is_an_error(void **state)
{
    static const char why[] = "cannot create a framebuffer of 16 x 16 pixels";
    (void)state;
    fault.largest_view = SIDE - 1;
    assert_refused(why);
    fault.largest_buffer = SIDE - 1;
    assert_refused(why);
    fault.state = GL_FRAMEBUFFER_UNSUPPORTED;
    assert_refused(why);
    fault.error = GL_OUT_OF_MEMORY;
    assert_refused(why);
}

static void context_that_fails_while_drawing_is_an_error(void **state)
{
    uint8_t indices[SIDE * SIDE];
    octreel_error error = {""};
    (void)state;
    scene s = busy_scene(SIDE, SIDE, CAMERA_ISO);
    renderer *r = open_gl_renderer(SIDE, SIDE);
    assert_true(renderer_draw_scene(r, &s, indices, &error));
    fault.not_current = true;
    assert_false(renderer_draw_scene(r, &s, indices, &error));
    assert_string_equal(error.text, "the OpenGL context cannot be made current");
    fault.not_current = false;
    assert_true(renderer_draw_scene(r, &s, indices, &error));
    renderer_close(r);
    scene_release(&s);
}

/* ---- The libraries ------------------------------------------------------------------------------------------ */

static const char *unknown;   /* the function that every library lacks; null: none */
static void (*instead)(void); /* the function that is returned instead; may be null */
static bool nothing_loads;    /* every library is missing */

void *__wrap_dlopen(const char *name, int how)
{
    return nothing_loads ? __real_dlopen("/nowhere/at/all.so", how) : __real_dlopen(name, how);
}

void *__wrap_dlsym(void *library, const char *name)
{
    void *found = NULL;
    if (!unknown || strcmp(name, unknown) != 0)
        return __real_dlsym(library, name);
    memcpy(&found, &instead, sizeof found);
    return found;
}

static void assert_not_opened(draw_context kind, const char *why)
{
    octreel_error error = {""};
    assert_null(renderer_open(SIDE, SIDE, &(renderer_choice){.context = kind, .fill = DRAW_FILL_GL}, &error));
    if (!strstr(error.text, why))
        fail_msg("without %s: \"%s\" does not contain \"%s\"", unknown ? unknown : "libraries", error.text, why);
}

static void need(draw_context kind)
{
    if (!draw_context_is_built(kind))
        skip();
}

static void osmesa_without_one_of_its_functions_is_refused(void **state)
{
    static const char *const functions[] = {"OSMesaCreateContextAttribs", "OSMesaMakeCurrent", "OSMesaDestroyContext",
                                            "OSMesaGetProcAddress"};
    (void)state;
    need(DRAW_OSMESA);
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        unknown = functions[i];
        assert_not_opened(DRAW_OSMESA, "OSMesa cannot create an OpenGL compatibility context");
    }
    unknown = NULL;
}

static void egl_without_one_of_its_functions_is_refused(void **state)
{
    static const char *const functions[] = {"eglGetProcAddress", "eglQueryString", "eglGetError",
                                            "eglInitialize",     "eglBindAPI",     "eglCreateContext",
                                            "eglDestroyContext", "eglMakeCurrent"};
    (void)state;
    need(DRAW_EGL);
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        unknown = functions[i];
        assert_not_opened(DRAW_EGL, "EGL cannot create an OpenGL context without a display");
    }
    unknown = NULL;
}

/* Failing functions with the types of EGL. */
static unsigned refuse_api(unsigned api)
{
    (void)api;
    return 0;
}

static unsigned refuse_display(void *display, int *major, int *minor)
{
    (void)display;
    (void)major;
    (void)minor;
    return 0;
}

static void *refuse_context(void *display, void *config, void *shared, const int *list)
{
    (void)display;
    (void)config;
    (void)shared;
    (void)list;
    return NULL;
}

static unsigned refuse_current(void *display, void *to, void *from, void *c)
{
    (void)display;
    (void)to;
    (void)from;
    (void)c;
    return 0;
}

static void egl_failure_at_any_call_is_an_error(void **state)
{
    static const struct {
        const char *name;
        void (*refuse)(void);
    } rows[] = {{"eglBindAPI", (void (*)(void))refuse_api},
                {"eglInitialize", (void (*)(void))refuse_display},
                {"eglCreateContext", (void (*)(void))refuse_context},
                {"eglMakeCurrent", (void (*)(void))refuse_current}};
    (void)state;
    need(DRAW_EGL);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        unknown = rows[i].name;
        instead = rows[i].refuse;
        assert_not_opened(DRAW_EGL, "EGL cannot create an OpenGL context without a display");
    }
    unknown = NULL;
    instead = NULL;
}

static const char *know_nothing(void *display, int name)
{
    (void)display;
    (void)name;
    return NULL;
}

/* The surfaceless display remains. */
static void egl_without_a_device_list_draws(void **state)
{
    octreel_error error = {""};
    (void)state;
    need(DRAW_EGL);
    unknown = "eglQueryString";
    instead = (void (*)(void))know_nothing;
    renderer *r = renderer_open(SIDE, SIDE, &(renderer_choice){.context = DRAW_EGL}, &error);
    unknown = NULL;
    instead = NULL;
    if (!r)
        assert_non_null(strstr(error.text, "llvmpipe")); /* the machine has a graphics card */
    renderer_close(r);
}

static void missing_libraries_are_named_with_their_packages(void **state)
{
    (void)state;
    nothing_loads = true;
    if (draw_context_is_built(DRAW_OSMESA))
        assert_not_opened(DRAW_OSMESA, "cannot be loaded (Debian: libosmesa6)");
    if (draw_context_is_built(DRAW_EGL))
        assert_not_opened(DRAW_EGL, "cannot be loaded (Debian: libegl1)");
    assert_not_opened(DRAW_AUTO, "cannot be loaded (Debian: ");
    nothing_loads = false;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_names_the_missing_gl_function),
        cmocka_unit_test(driver_without_a_name_is_refused),
        cmocka_unit_test(incomplete_framebuffer_is_an_error),
        cmocka_unit_test(context_that_fails_while_drawing_is_an_error),
        cmocka_unit_test(osmesa_without_one_of_its_functions_is_refused),
        cmocka_unit_test(egl_without_one_of_its_functions_is_refused),
        cmocka_unit_test(egl_failure_at_any_call_is_an_error),
        cmocka_unit_test(egl_without_a_device_list_draws),
        cmocka_unit_test(missing_libraries_are_named_with_their_packages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
