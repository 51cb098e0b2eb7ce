/* SPDX-License-Identifier: MIT */
/* renderer.c - draws scenes as pictures of colour indices, with the integer rasterizer or with GL (gl_surface.c). */
#include "renderer.h"
#include "fill.h"
#include "paint.h"

#include <stdlib.h>
#include <string.h>

struct renderer {
    renderer_choice choice;
    surface *surface; /* the GL framebuffer; null: GL is not loaded */
    int width, height;
    painter painter;
    canvas canvas;
    size_t left_out;
};

static const char *const fills[DRAW_FILLS] = {
    [DRAW_FILL_INTEGERS] = "integers", [DRAW_FILL_CHECKED] = "checked", [DRAW_FILL_GL] = "gl"};

const char *draw_fill_name(int fill)
{
    return (unsigned)fill < DRAW_FILLS ? fills[fill] : NULL;
}

static bool check_size(int width, int height, octreel_error *error)
{
    if (width >= 1 && height >= 1 && width <= VIEW_MAX_SIDE && height <= VIEW_MAX_SIDE)
        return true;
    return error_set(error, "a picture of %d x %d pixels cannot be drawn: each side must be 1 to %d", width, height,
                     VIEW_MAX_SIDE);
}

/* Returns whether GL draws every scene, instead of the integer rasterizer. */
static bool fills_with_gl(const renderer *r)
{
    return r->choice.fill == DRAW_FILL_GL;
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
    *r = (renderer){.choice = *choice, .width = width, .height = height, .canvas = {.width = width, .height = height}};
    if (choice->any_renderer)
        r->choice.fill = DRAW_FILL_GL;
    if (fills_with_gl(r) && !(r->surface = surface_open(width, height, choice, error))) {
        renderer_close(r);
        return NULL;
    }
    return r;
}

void renderer_close(renderer *r)
{
    if (!r)
        return;
    painter_release(&r->painter);
    canvas_release(&r->canvas);
    if (r->surface)
        r->surface->close(r->surface);
    free(r);
}

renderer_info renderer_describe(const renderer *r)
{
    renderer_info info = {0};
    if (fills_with_gl(r))
        info = r->surface->about(r->surface);
    info.fill = draw_fill_name(r->choice.fill == DRAW_FILL_GL ? DRAW_FILL_GL : DRAW_FILL_INTEGERS);
    return info;
}

bool renderer_fits_scene(const renderer *r, const scene *s, octreel_error *error)
{
    const int samples = s->view.aa;
    return (s->view.width * samples == r->width && s->view.height * samples == r->height) ||
           error_set(error, "the scene and the renderer have different sizes");
}

bool renderer_fill_quads(renderer *r, const quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                         octreel_error *error)
{
    if (fills_with_gl(r))
        return r->surface->fill(r->surface, quads, count, part, bytes, error);
    memset(bytes, 0, (size_t)part.width * (size_t)part.height);
    fill_quads(quads, count, part, bytes);
    return true;
}

bool renderer_draw_scene(renderer *r, const scene *s, uint8_t *indices, octreel_error *error)
{
    if (!renderer_fits_scene(r, s, error))
        return false;
    if (!painter_paint_scene(&r->painter, s))
        return error_no_memory(error);
    r->left_out = s->refused + r->painter.overflowed;
    if (fills_with_gl(r))
        return renderer_fill_quads(r, r->painter.quads.items, r->painter.quads.count,
                                   (renderer_part){0, 0, r->width, r->height}, indices, error);
    canvas_fill_quads(&r->canvas, &r->painter.quads, indices);
    return true;
}

/* Draws the last scene again. The scene itself is not needed, because the canvas keeps its quads. */
bool renderer_redraw_with_gl(renderer *r, uint8_t *indices, draw_context *by, octreel_error *error)
{
    const renderer_part all = {0, 0, r->width, r->height};
    const quad_list *last = &r->canvas.last;
    if (!r->surface && !(r->surface = surface_open(r->width, r->height, &r->choice, error)))
        return false;
    *by = r->surface->about(r->surface).kind;
    return r->surface->fill(r->surface, last->items, last->count, all, indices, error);
}

const uint8_t *renderer_sample_colors(const renderer *r)
{
    return (const uint8_t *)r->painter.splats.colors;
}

size_t renderer_left_out_count(const renderer *r)
{
    return r->left_out;
}
