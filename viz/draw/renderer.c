/* SPDX-License-Identifier: MIT */
/* renderer.c - scenes into indices: painted, clipped and filled. What GL does is in gl_surface.c. */
#include "renderer.h"
#include "canvas.h"
#include "fill.h"
#include "paint.h"
#include "surface.h"

#include <stdlib.h>
#include <string.h>

struct renderer {
    surface *surface; /* null: in memory alone */
    bool surface_fills;
    int width, height;
    painter painter;
    canvas canvas;
    size_t left_out;
};

static const char *const fills[DRAW_FILLS] = {[DRAW_FILL_INTEGERS] = "integers", [DRAW_FILL_GL] = "gl"};

const char *draw_fill_name(draw_fill fill)
{
    return (unsigned)fill < DRAW_FILLS ? fills[fill] : NULL;
}

bool draw_fill_parse(const char *name, draw_fill *fill)
{
    for (int i = 0; i < DRAW_FILLS; i++) {
        if (strcmp(name, fills[i]) == 0) {
            *fill = (draw_fill)i;
            return true;
        }
    }
    return false;
}

static bool check_size(int width, int height, octreel_error *error)
{
    if (width >= 1 && height >= 1 && width <= VIEW_MAX_SIDE && height <= VIEW_MAX_SIDE)
        return true;
    return error_set(error, "a picture of %d x %d pixels cannot be drawn: each side must be 1 to %d", width, height,
                     VIEW_MAX_SIDE);
}

renderer *renderer_open_memory(int width, int height, octreel_error *error)
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
    return r;
}

void renderer_use_surface(renderer *r, surface *s, bool fills)
{
    r->surface = s;
    r->surface_fills = fills;
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

renderer_info renderer_about(const renderer *r)
{
    renderer_info info = {.context = "memory"};
    if (r->surface)
        info = r->surface->about(r->surface);
    info.fill = draw_fill_name(r->surface_fills ? DRAW_FILL_GL : DRAW_FILL_INTEGERS);
    return info;
}

bool renderer_fits(const renderer *r, const scene *s, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    return (s->view.width * samples == r->width && s->view.height * samples == r->height) ||
           error_set(error, "the scene is not of the renderer's size");
}

bool renderer_fill(renderer *r, const quad *quads, size_t count, renderer_part part, uint8_t *bytes,
                   octreel_error *error)
{
    if (r->surface_fills)
        return r->surface->fill(r->surface, quads, count, part, bytes, error);
    memset(bytes, 0, (size_t)part.width * (size_t)part.height);
    fill_quads(quads, count, part, bytes);
    return true;
}

bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, octreel_error *error)
{
    if (!renderer_fits(r, s, error))
        return false;
    if (!paint(&r->painter, s))
        return error_no_memory(error);
    r->left_out = s->refused + r->painter.overflowed;
    if (r->surface_fills)
        return renderer_fill(r, r->painter.quads.items, r->painter.quads.count,
                             (renderer_part){0, 0, r->width, r->height}, indices, error);
    canvas_draw(&r->canvas, &r->painter.quads, indices);
    return true;
}

const uint8_t *renderer_own_colors(const renderer *r)
{
    return r->painter.splats.colors;
}

size_t renderer_left_out(const renderer *r)
{
    return r->left_out;
}
