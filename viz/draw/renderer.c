/* renderer.c - quads into a framebuffer object, and its pixels back. GL rasterises and decides nothing else.
 *
 * The framebuffer has one channel, which holds the index of a colour: a frame is read back as it is written to a file.
 * The viewport is a square whose side is a power of two, so that every step from a snapped pixel to clip space and
 * back is exact in single precision: no CPU can round it differently, with FMA or without.
 */
#include "renderer.h"
#include "canvas.h"
#include "gl.h"
#include "paint.h"
#include "rasterise.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    snprintf(error->text, sizeof error->text,
             "the %s context draws with \"%.60s\"; frames are the same everywhere with llvmpipe alone (is "
             "GALLIUM_DRIVER set?)",
             r->context->name, name ? name : "nothing");
    return false;
}

static bool check_size(int width, int height, octreel_error *error)
{
    if (width >= 1 && height >= 1 && width <= VIEW_MAX_SIDE && height <= VIEW_MAX_SIDE)
        return true;
    snprintf(error->text, sizeof error->text, "a picture of %d x %d pixels cannot be drawn: each side must be 1 to %d",
             width, height, VIEW_MAX_SIDE);
    return false;
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
    snprintf(error->text, sizeof error->text, "the %s context gives no framebuffer of %d x %d pixels", r->context->name,
             r->width, r->height);
    return false;
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
        snprintf(error->text, sizeof error->text, "there is no memory for a renderer");
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

static bool fail(octreel_error *error, const char *sentence)
{
    snprintf(error->text, sizeof error->text, "%s", sentence);
    return false;
}

bool renderer_fits(const renderer *r, const scene *s, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    return (s->view.width * samples == r->width && s->view.height * samples == r->height) ||
           fail(error, "the scene is not of the renderer's size");
}

/* Draw quads on a ground of one byte. */
static bool send_quads(renderer *r, const quad *quads, size_t count, uint8_t ground, const draw_box *part,
                       uint8_t *bytes, octreel_error *error)
{
    if (!r->context->use(r->context))
        return fail(error, "the renderer's context cannot be made current");
    const gl *gl = &r->gl;
    gl->ClearColor((float)ground / 255, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    for (size_t start = 0; start < count; start += BATCH) {
        const size_t size = count - start < BATCH ? count - start : BATCH;
        put_vertices(r, quads + start, size);
        gl->DrawElements(GL_TRIANGLES, (GLsizei)(6 * size), GL_UNSIGNED_INT, r->indices);
    }
    gl->ReadPixels(part->x, part->y, part->width, part->height, GL_RED, GL_UNSIGNED_BYTE, bytes);
    const GLenum failure = gl->GetError();
    if (failure != GL_NO_ERROR)
        snprintf(error->text, sizeof error->text, "GL reports error 0x%04x", failure);
    return failure == GL_NO_ERROR;
}

bool renderer_rasterise(renderer *r, const quad *quads, size_t count, const draw_box *part, uint8_t *bytes,
                        octreel_error *error)
{
    return send_quads(r, quads, count, 0, part, bytes, error);
}

/* Who rasterises for the canvas, and why it failed. */
typedef struct sender {
    renderer *renderer;
    octreel_error *error;
    bool failed;
} sender;

/* A rasteriser: see canvas.h. */
static bool send_rows(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                      uint8_t *indices)
{
    sender *to = context;
    const int width = to->renderer->width;
    const draw_box rows = {0, first, width, end - first};
    to->failed =
        !send_quads(to->renderer, quads, count, ground, &rows, indices + (size_t)first * (size_t)width, to->error);
    return !to->failed;
}

bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, octreel_error *error)
{
    sender to = {r, error, false};
    if (!renderer_fits(r, s, error))
        return false;
    if (!paint(&r->painter, s))
        return fail(error, "there is no memory for a frame");
    r->left_out = s->refused + r->painter.overflowed;
    return canvas_draw(&r->canvas, &r->painter.quads, send_rows, &to, indices) ||
           (!to.failed && fail(error, "there is no memory for a frame"));
}

size_t renderer_left_out(const renderer *r)
{
    return r->left_out;
}
