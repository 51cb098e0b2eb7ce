/* pick.c - which element of a scene is seen at each sample.
 *
 * The framebuffer holds one byte a sample. The quads of the picture are drawn once for each byte of the largest number
 * that is needed, as they are for the picture itself but for what their colour stands for: no sample can be decided
 * otherwise than there.
 */
#include "edge_boxes.h"
#include "paint.h"
#include "rasterise.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is painted has numbers too: the merged edges take the places of the boxes. */
static uint64_t stroke_number(const scene *s, const painter *p, const quad *q)
{
    if (q->kind == SCENE_BOX)
        return 1 + (uint64_t)q->index;
    return (uint64_t)scene_number_of(s, (scene_element){(scene_kind)q->kind, q->index}) - s->boxes.count +
           paint_edge_count(p);
}

static bool no_memory(octreel_error *error)
{
    snprintf(error->text, sizeof error->text, "there is no memory to tell what is drawn where");
    return false;
}

/* One byte of each sample's stroke. */
static bool draw_byte(renderer *r, const scene *s, painter *p, unsigned shift, uint8_t *bytes, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    const draw_box all = {0, 0, s->view.width * samples, s->view.height * samples};
    for (size_t i = 0; i < p->quads.count; i++)
        p->quads.items[i].color = (uint8_t)(stroke_number(s, p, &p->quads.items[i]) >> shift);
    return renderer_rasterise(r, p->quads.items, p->quads.count, &all, bytes, error);
}

static bool draw_strokes(renderer *r, const scene *s, painter *p, size_t size, uint32_t *numbers, octreel_error *error)
{
    const uint64_t largest =
        paint_edge_count(p) + s->segments.count + s->markers.count + s->panels.count + s->labels.count;
    uint8_t *bytes = largest <= UINT32_MAX ? malloc(size) : NULL;
    bool ok = bytes || no_memory(error);
    if (!ok)
        return false;
    memset(numbers, 0, size * sizeof *numbers);
    for (unsigned shift = 0; ok && largest >> shift; shift += 8) {
        ok = draw_byte(r, s, p, shift, bytes, error);
        for (size_t i = 0; ok && i < size; i++)
            numbers[i] |= (uint32_t)bytes[i] << shift;
    }
    free(bytes);
    return ok;
}

/* From strokes to elements. */
static bool name_boxes(const scene *s, const painter *p, uint32_t *numbers, octreel_error *error)
{
    const scene fine = paint_samples(s);
    const size_t width = (size_t)fine.view.width, size = width * (size_t)fine.view.height;
    const uint32_t edges = (uint32_t)paint_edge_count(p);
    edge_boxes boxes;
    if (!edge_boxes_make(&boxes, &fine))
        return no_memory(error);
    for (size_t i = 0; i < size; i++) {
        if (numbers[i] > edges)
            numbers[i] = numbers[i] - edges + (uint32_t)s->boxes.count;
        else if (numbers[i] > 0)
            numbers[i] = 1 + (uint32_t)edge_boxes_giver(&boxes, paint_edge_at(p, numbers[i] - 1), (int)(i % width),
                                                        (int)(i / width));
    }
    edge_boxes_release(&boxes);
    return true;
}

bool renderer_pick(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error)
{
    if (!renderer_fits(r, s, error))
        return false;
    const size_t samples = (size_t)view_samples(&s->view);
    const size_t size = (size_t)s->view.width * (size_t)s->view.height * samples * samples;
    painter p = {0}; /* not the renderer's, which may keep what it has painted */
    const bool ok = (paint(&p, s) || no_memory(error)) && draw_strokes(r, s, &p, size, numbers, error) &&
                    name_boxes(s, &p, numbers, error);
    painter_release(&p);
    return ok;
}

/* ---- Layers -------------------------------------------------------------------------------------------------- */

static unsigned layer_of(const scene *s, const painter *p, const quad *q)
{
    return q->kind == SCENE_BOX ? paint_edge_at(p, q->index)->style.layer
                                : scene_style_of(s, (scene_element){(scene_kind)q->kind, q->index}).layer;
}

/* Draw a 1 for the quads of the wanted layers and a 0 for all others, in the picture's order. */
static bool draw_layers(renderer *r, const scene *s, painter *p, unsigned layers, uint8_t *samples,
                        octreel_error *error)
{
    const int side = view_samples(&s->view);
    const draw_box all = {0, 0, s->view.width * side, s->view.height * side};
    for (size_t i = 0; i < p->quads.count; i++)
        p->quads.items[i].color = layers >> layer_of(s, p, &p->quads.items[i]) & 1;
    return renderer_rasterise(r, p->quads.items, p->quads.count, &all, samples, error);
}

/* A pixel is in the mask where one of its samples is. */
static void shrink_mask(const view *v, const uint8_t *samples, uint8_t *mask)
{
    const size_t side = (size_t)view_samples(v), width = (size_t)v->width;
    memset(mask, 0, width * (size_t)v->height);
    for (size_t y = 0; y < (size_t)v->height * side; y++)
        for (size_t x = 0; x < width * side; x++)
            mask[y / side * width + x / side] |= samples[y * width * side + x];
}

bool renderer_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error)
{
    if (!renderer_fits(r, s, error))
        return false;
    const size_t side = (size_t)view_samples(&s->view);
    uint8_t *samples = malloc((size_t)s->view.width * (size_t)s->view.height * side * side);
    painter p = {0};
    bool ok = (samples && paint(&p, s)) || error_no_memory(error);
    ok = ok && draw_layers(r, s, &p, layers, samples, error);
    if (ok)
        shrink_mask(&s->view, samples, mask);
    painter_release(&p);
    free(samples);
    return ok;
}
