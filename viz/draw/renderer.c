/* SPDX-License-Identifier: MIT */
/* renderer.c - quads into a framebuffer object, and its pixels back. GL rasterises and decides nothing else.
 *
 * The framebuffer has one channel, which holds the index of a colour: a frame is read back as it is written to a file.
 * The viewport is a square whose side is a power of two, so that every step from a snapped pixel to clip space and
 * back is exact in single precision: no CPU can round it differently, with FMA or without.
 */
#include "renderer.h"
#include "canvas.h"
#include "paint.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdlib.h>
#include <string.h>

/* The GL functions in use: result, name, parameters. */
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

/* False, with an error that names the first missing function, when the context lacks one. */
static bool gl_load(gl *functions, const context *c, octreel_error *error)
{
    const char *missing = NULL;
#define GL_LOOK_UP(result, name, parameters)                                                                           \
    functions->name = (result(GLAPIENTRY *) parameters)c->find(c, "gl" #name);                                         \
    if (!functions->name && !missing)                                                                                  \
        missing = "gl" #name;
    GL_FUNCTIONS(GL_LOOK_UP)
#undef GL_LOOK_UP
    return !missing || error_set(error, "the %s context has no %s", c->name, missing);
}

#define BATCH 8192 /* quads a draw call */

typedef struct vertex {
    GLfloat x, y;
    GLubyte color[4];
} vertex;

struct renderer {
    context *context;
    gl gl;
    int width, height;
    int side; /* of the viewport */
    painter painter;
    canvas canvas;
    size_t left_out;
    vertex vertices[BATCH * 4];
    GLuint indices[BATCH * 6];
};

/* Only llvmpipe is known to give the same pixels everywhere. */
static bool check_driver(renderer *r, bool any, octreel_error *error)
{
    const char *name = (const char *)r->gl.GetString(GL_RENDERER);
    if (name && (any || strncmp(name, "llvmpipe", 8) == 0))
        return true;
    return error_set(error,
                     "the %s context draws with \"%.60s\"; frames are the same everywhere with llvmpipe alone (is "
                     "GALLIUM_DRIVER set?)",
                     r->context->name, name ? name : "nothing");
}

static bool check_size(int width, int height, octreel_error *error)
{
    if (width >= 1 && height >= 1 && width <= VIEW_MAX_SIDE && height <= VIEW_MAX_SIDE)
        return true;
    return error_set(error, "a picture of %d x %d pixels cannot be drawn: each side must be 1 to %d", width, height,
                     VIEW_MAX_SIDE);
}

static bool make_framebuffer(renderer *r, octreel_error *error)
{
    const gl *gl = &r->gl;
    GLint limits[2] = {0, 0}, largest = 0;
    GLuint frame, color;
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, limits);
    gl->GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    gl->GenFramebuffers(1, &frame);
    gl->BindFramebuffer(GL_FRAMEBUFFER, frame);
    gl->GenRenderbuffers(1, &color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, color);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_R8, r->width, r->height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (r->side <= limits[0] && r->side <= limits[1] && r->width <= largest && r->height <= largest &&
        gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && gl->GetError() == GL_NO_ERROR)
        return true;
    return error_set(error, "the %s context gives no framebuffer of %d x %d pixels", r->context->name, r->width,
                     r->height);
}

/* All state that a frame depends on; nothing changes it later. */
static void set_state(renderer *r)
{
    const gl *gl = &r->gl;
    gl->DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl->Viewport(0, 0, r->side, r->side);
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
    gl->VertexPointer(2, GL_FLOAT, sizeof(vertex), &r->vertices[0].x);
    gl->ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(vertex), r->vertices[0].color);
}

/* Each quad is two triangles that share the diagonal from corner 0 to corner 2. */
static void make_indices(renderer *r)
{
    static const GLuint corners[6] = {0, 1, 2, 0, 2, 3};
    for (GLuint i = 0; i < BATCH * 6; i++)
        r->indices[i] = i / 6 * 4 + corners[i % 6];
}

renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error)
{
    if (!check_size(width, height, error))
        return NULL;
    renderer *r = calloc(1, sizeof *r);
    if (!r) {
        error_no_memory(error);
        return NULL;
    }
    r->width = width;
    r->height = height;
    r->canvas = (canvas){.width = width, .height = height};
    for (r->side = 1; r->side < width || r->side < height;)
        r->side *= 2;
    r->context = context_open(choice, error);
    if (!r->context || !gl_load(&r->gl, r->context, error) || !check_driver(r, choice->any_renderer, error) ||
        !make_framebuffer(r, error)) {
        renderer_close(r);
        return NULL;
    }
    make_indices(r);
    set_state(r);
    return r;
}

void renderer_close(renderer *r)
{
    if (!r)
        return;
    painter_release(&r->painter);
    canvas_release(&r->canvas);
    if (r->context)
        r->context->close(r->context);
    free(r);
}

renderer_info renderer_about(const renderer *r)
{
    r->context->use(r->context); /* GL answers for the context that is current */
    return (renderer_info){
        .context = r->context->name,
        .vendor = (const char *)r->gl.GetString(GL_VENDOR),
        .renderer = (const char *)r->gl.GetString(GL_RENDERER),
        .version = (const char *)r->gl.GetString(GL_VERSION),
    };
}

/* From 1/256 pixel to clip space: exact, since coordinates have at most 23 bits and the side is a power of two. */
static void put_vertices(renderer *r, const quad *quads, size_t count)
{
    const float scale = 2.0f / ((float)r->side * QUAD_SUBPIXELS);
    for (size_t i = 0; i < count; i++)
        for (int j = 0; j < 4; j++)
            r->vertices[4 * i + (size_t)j] = (vertex){
                (float)quads[i].x[j] * scale - 1, (float)quads[i].y[j] * scale - 1, {quads[i].color, 0, 0, 255}};
}

bool renderer_fits(const renderer *r, const scene *s, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    return (s->view.width * samples == r->width && s->view.height * samples == r->height) ||
           error_set(error, "the scene is not of the renderer's size");
}

bool renderer_rasterise(renderer *r, const quad *quads, size_t count, uint8_t ground, renderer_part part,
                        uint8_t *bytes, octreel_error *error)
{
    if (!r->context->use(r->context))
        return error_set(error, "the renderer's context cannot be made current");
    const gl *gl = &r->gl;
    gl->ClearColor((float)ground / 255, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    for (size_t start = 0; start < count; start += BATCH) {
        const size_t size = count - start < BATCH ? count - start : BATCH;
        put_vertices(r, quads + start, size);
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * size), GL_UNSIGNED_INT, r->indices);
    }
    gl->ReadPixels(part.x, part.y, part.width, part.height, GL_RED, GL_UNSIGNED_BYTE, bytes);
    const GLenum failure = gl->GetError();
    return failure == GL_NO_ERROR || error_set(error, "GL reports error 0x%04x", failure);
}

/* A rasteriser: see canvas.h. */
static bool rasterise_rows(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                           uint8_t *indices, octreel_error *error)
{
    renderer *r = context;
    const renderer_part rows = {0, first, r->width, end - first};
    return renderer_rasterise(r, quads, count, ground, rows, indices + (size_t)first * (size_t)r->width, error);
}

bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, octreel_error *error)
{
    if (!renderer_fits(r, s, error))
        return false;
    if (!paint(&r->painter, s))
        return error_no_memory(error);
    r->left_out = s->refused + r->painter.overflowed;
    return canvas_draw(&r->canvas, &r->painter.quads, rasterise_rows, r, indices, error);
}

size_t renderer_left_out(const renderer *r)
{
    return r->left_out;
}
