/* SPDX-License-Identifier: MIT */
/* gl_surface.c - fills quads with GL into a framebuffer object, and reads the pixels back. GL does nothing but
 * rasterize.
 *
 * The framebuffer has one channel, which holds indices of colours, as PNG files do. The viewport is a square whose side
 * is a power of two. The conversion from 1/256 pixel to clip space and back is then exact in single precision, and has
 * the same result on every CPU, with or without FMA. clip.c clips all quads to this square, so that GL has nothing to
 * clip. */
#include "context.h"
#include "fill.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdlib.h>
#include <string.h>

/* The GL functions that this file calls: result type, name, parameters. */
#define GL_FUNCTIONS(X)                                                                                                \
    X(const GLubyte *, GetString, (GLenum name))                                                                       \
    X(void, GetIntegerv, (GLenum name, GLint * value))                                                                 \
    X(GLenum, GetError, (void))                                                                                        \
    X(void, GenFramebuffers, (GLsizei count, GLuint * names))                                                          \
    X(void, BindFramebuffer, (GLenum target, GLuint name))                                                             \
    X(void, GenRenderbuffers, (GLsizei count, GLuint * names))                                                         \
    X(void, BindRenderbuffer, (GLenum target, GLuint name))                                                            \
    X(void, RenderbufferStorage, (GLenum target, GLenum format, GLsizei width, GLsizei height))                        \
    X(void, FramebufferRenderbuffer, (GLenum target, GLenum attachment, GLenum kind, GLuint name))                     \
    X(GLenum, CheckFramebufferStatus, (GLenum target))                                                                 \
    X(void, Viewport, (GLint x, GLint y, GLsizei width, GLsizei height))                                               \
    X(void, Disable, (GLenum what))                                                                                    \
    X(void, ShadeModel, (GLenum mode))                                                                                 \
    X(void, PixelStorei, (GLenum name, GLint value))                                                                   \
    X(void, ReadBuffer, (GLenum buffer))                                                                               \
    X(void, DrawBuffer, (GLenum buffer))                                                                               \
    X(void, ClearColor, (GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha))                                     \
    X(void, Clear, (GLbitfield mask))                                                                                  \
    X(void, MatrixMode, (GLenum mode))                                                                                 \
    X(void, LoadIdentity, (void))                                                                                      \
    X(void, EnableClientState, (GLenum array))                                                                         \
    X(void, VertexPointer, (GLint size, GLenum type, GLsizei stride, const void *pointer))                             \
    X(void, ColorPointer, (GLint size, GLenum type, GLsizei stride, const void *pointer))                              \
    X(void, DrawElements, (GLenum mode, GLsizei count, GLenum type, const void *indices))                              \
    X(void, ReadPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void *pixels))

typedef struct gl {
#define GL_MEMBER(result, name, parameters) result(GLAPIENTRY *name) parameters;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
} gl;

/* Look up all GL functions. If functions are missing, returns false with an error that names the last of them. */
static bool load_gl_functions(gl *functions, const context *c, octreel_error *error)
{
    const char *missing = NULL;
#define GL_LOOK_UP(result, name, parameters)                                                                           \
    functions->name = (result(GLAPIENTRY *) parameters)c->find_function(c, "gl" #name);                                \
    if (!functions->name)                                                                                              \
        missing = "gl" #name;
    GL_FUNCTIONS(GL_LOOK_UP)
#undef GL_LOOK_UP
    return !missing || error_set(error, "the %s context has no function %s", draw_context_name(c->kind), missing);
}

#define BATCH 8192 /* the maximum number of quads in one draw call */

typedef struct vertex {
    GLfloat x, y;
    GLubyte color[4];
} vertex;

typedef struct gl_surface {
    surface face;
    context *context;
    gl gl;
    int width, height;
    int side; /* the side of the viewport in samples */
    vertex vertices[BATCH * 4];
    GLuint indices[BATCH * 6];
} gl_surface;

/* Check that the driver is llvmpipe; if `any` is true, accept any driver. No driver but llvmpipe is known to give the
 * same pixels on every machine. */
static bool check_driver(gl_surface *s, bool any, octreel_error *error)
{
    const char *name = (const char *)s->gl.GetString(GL_RENDERER);
    if (name && (any || strncmp(name, "llvmpipe", 8) == 0))
        return true;
    return error_set(error,
                     "the %s context draws with \"%.60s\"; only llvmpipe draws the same frames on every machine (is "
                     "GALLIUM_DRIVER set?)",
                     draw_context_name(s->context->kind), name ? name : "nothing");
}

static bool make_framebuffer(gl_surface *s, octreel_error *error)
{
    const gl *gl = &s->gl;
    GLint limits[2] = {0, 0}, largest = 0;
    GLuint frame, color;
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, limits);
    gl->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    gl->GenFramebuffers(1, &frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
    gl->GenRenderbuffers(1, &color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, color);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_R8, s->width, s->height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (s->side <= limits[0] && s->side <= limits[1] && s->width <= largest && s->height <= largest &&
        gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && gl->GetError() == GL_NO_ERROR)
        return true;
    return error_set(error, "the %s context cannot create a framebuffer of %d x %d pixels",
                     draw_context_name(s->context->kind), s->width, s->height);
}

/* Set all GL state on which frames depend. Called once, after opening. */
static void set_gl_state(gl_surface *s)
{
    const gl *gl = &s->gl;
    gl->DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl->Viewport(0, 0, s->side, s->side);
    gl->Disable(GL_DITHER);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_MULTISAMPLE);
    gl->ShadeModel(GL_FLAT);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->MatrixMode(GL_PROJECTION);
    gl->LoadIdentity();
    gl->MatrixMode(GL_MODELVIEW);
    gl->LoadIdentity();
    gl->EnableClientState(GL_VERTEX_ARRAY);
    gl->EnableClientState(GL_COLOR_ARRAY);
    gl->VertexPointer(2, GL_FLOAT, sizeof(vertex), &s->vertices[0].x);
    gl->ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(vertex), s->vertices[0].color);
}

/* Make the indices of the vertices: a quad is two triangles that share the diagonal from corner 0 to corner 2. */
static void make_vertex_indices(gl_surface *s)
{
    static const GLuint corners[6] = {0, 1, 2, 0, 2, 3};
    for (GLuint i = 0; i < BATCH * 6; i++)
        s->indices[i] = i / 6 * 4 + corners[i % 6];
}

/* Convert corners from units of 1/256 pixel to clip space. The conversion is exact, because coordinates have at most 23
 * bits, and the viewport's side is a power of two. */
static void write_vertices(gl_surface *s, const quad *quads, size_t count)
{
    const float scale = 2.0f / ((float)s->side * QUAD_SUBPIXELS);
    for (size_t i = 0; i < count; i++)
        for (int j = 0; j < 4; j++)
            s->vertices[4 * i + (size_t)j] = (vertex){
                (float)quads[i].x[j] * scale - 1, (float)quads[i].y[j] * scale - 1, {quads[i].color, 0, 0, 255}};
}

static bool fill_with_gl(surface *face, const quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                         octreel_error *error)
{
    gl_surface *s = (gl_surface *)face;
    if (!s->context->make_current(s->context))
        return error_set(error, "the OpenGL context cannot be made current");
    const gl *gl = &s->gl;
    gl->ClearColor(0, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    for (size_t start = 0; start < count; start += BATCH) {
        const size_t size = count - start < BATCH ? count - start : BATCH;
        write_vertices(s, quads + start, size);
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * size), GL_UNSIGNED_INT, s->indices);
    }
    gl->ReadPixels(part.x, part.y, part.width, part.height, GL_RED, GL_UNSIGNED_BYTE, bytes);
    const GLenum failure = gl->GetError();
    return failure == GL_NO_ERROR || error_set(error, "GL reports error 0x%04x", failure);
}

static renderer_info describe_surface(surface *face)
{
    gl_surface *s = (gl_surface *)face;
    /* glGetString() describes the current context, so this context must be current */
    s->context->make_current(s->context);
    return (renderer_info){
        .kind = s->context->kind,
        .context = draw_context_name(s->context->kind),
        .vendor = (const char *)s->gl.GetString(GL_VENDOR),
        .renderer = (const char *)s->gl.GetString(GL_RENDERER),
        .version = (const char *)s->gl.GetString(GL_VERSION),
    };
}

static void close_surface(surface *face)
{
    gl_surface *s = (gl_surface *)face;
    if (s->context)
        s->context->close(s->context);
    free(s);
}

surface *surface_open(int width, int height, const renderer_choice *choice, octreel_error *error)
{
    gl_surface *s = calloc(1, sizeof *s);
    if (!s) {
        error_no_memory(error);
        return NULL;
    }
    s->face = (surface){.fill = fill_with_gl, .about = describe_surface, .close = close_surface};
    s->width = width;
    s->height = height;
    s->side = enclosing_power_of_two(width, height);
    context_limit_threads();
    s->context = context_open(choice, error);
    if (!s->context || !load_gl_functions(&s->gl, s->context, error) || !check_driver(s, choice->any_renderer, error) ||
        !make_framebuffer(s, error)) {
        close_surface(&s->face);
        return NULL;
    }
    make_vertex_indices(s);
    set_gl_state(s);
    return &s->face;
}
