/* pixel.c - all elements that have to do with one pixel: the quads that may reach it are drawn one by one, by the same
 * rasteriser, and what each covers is read back. */
#include "edge_boxes.h"
#include "array.h"
#include "paint.h"
#include "rasterise.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST_SAMPLES 16 /* of a pixel: 4 on each axis */

/* The pixel that is asked about. */
typedef struct probe {
    const scene *picture;
    scene fine; /* in samples */
    painter painter;
    edge_boxes boxes;
    draw_box part;  /* its samples */
    unsigned taken; /* a bit for each that something is seen at already */
    draw_touches *list;
    bool out_of_memory;
} probe;

void draw_touches_release(draw_touches *list)
{
    free(list->items);
    *list = (draw_touches){0};
}

/* ---- The list ------------------------------------------------------------------------------------------------ */

static draw_touch *find_touch(draw_touches *list, uint32_t number)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].number == number)
            return &list->items[i];
    return NULL;
}

/* The entry of an element, at the end of the list where it has none yet; null when there is no memory. */
static draw_touch *take_touch(probe *p, scene_kind kind, size_t index)
{
    draw_touches *list = p->list;
    const uint32_t number = scene_number_of(p->picture, (scene_element){kind, index});
    draw_touch *found = find_touch(list, number);
    if (found)
        return found;
    draw_touch *items = array_reserve(list->items, list->count + 1, &list->room, sizeof *items);
    if (!items) {
        p->out_of_memory = true;
        return NULL;
    }
    list->items = items;
    list->items[list->count] = (draw_touch){.number = number};
    return &list->items[list->count++];
}

/* A sample that was painted for an element, from the last quad to the first. */
static void add_paint(probe *p, scene_kind kind, size_t index, uint8_t color, int sample)
{
    draw_touch *touch = take_touch(p, kind, index);
    const bool shown = !(p->taken >> sample & 1);
    if (!touch || touch->at >> sample & 1)
        return;
    if (touch->painted == 0 || (shown && touch->shown == 0))
        touch->color = color;
    touch->at |= (uint16_t)(1u << sample);
    touch->painted++;
    touch->shown += shown;
}

/* A box that is there by another's edge. */
static void add_box_too(size_t box, void *context)
{
    take_touch(context, SCENE_BOX, box);
}

/* The points that are on one sample with a point that is drawn. */
static void add_points_too(probe *p, size_t drawn)
{
    const scene *s = &p->fine;
    size_t place, other;
    unsigned band;
    if (!paint_point_pixel(s, &s->markers.items[drawn], &place, &band))
        return;
    for (size_t i = 0; i < s->markers.count; i++)
        if (paint_point_pixel(s, &s->markers.items[i], &other, &band) && other == place)
            take_touch(p, SCENE_MARKER, i);
}

/* ---- The quads ----------------------------------------------------------------------------------------------- */

/* Twice the area of the triangle of two corners and a place, doubled so that the place may lie between pixels. */
static int64_t side_of(const quad *q, int from, int to, int64_t x, int64_t y)
{
    return ((int64_t)q->x[to] - q->x[from]) * (y - q->y[from]) - ((int64_t)q->y[to] - q->y[from]) * (x - q->x[from]);
}

/* Whether all corners of a square are on the outer side of one of the quad's sides; `turn` is the sign of its area. */
static bool is_beyond(const quad *q, int from, int to, int turn, const int64_t x[2], const int64_t y[2])
{
    for (int corner = 0; corner < 4; corner++)
        if (turn * side_of(q, from, to, x[corner & 1], y[corner >> 1]) >= 0)
            return false;
    return true;
}

/* Whether a quad may light a sample of the pixel: what is not, a sample's width from it, surely does not. */
static bool may_reach(const quad *q, const draw_box *part)
{
    const int64_t x[2] = {(int64_t)(part->x - 1) * QUAD_SUBPIXELS,
                          (int64_t)(part->x + part->width + 1) * QUAD_SUBPIXELS};
    const int64_t y[2] = {(int64_t)(part->y - 1) * QUAD_SUBPIXELS,
                          (int64_t)(part->y + part->height + 1) * QUAD_SUBPIXELS};
    int low[2] = {q->x[0], q->y[0]}, high[2] = {q->x[0], q->y[0]};
    for (int i = 1; i < 4; i++) {
        const int at[2] = {q->x[i], q->y[i]};
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = at[axis] < low[axis] ? at[axis] : low[axis];
            high[axis] = at[axis] > high[axis] ? at[axis] : high[axis];
        }
    }
    if (low[0] > x[1] || high[0] < x[0] || low[1] > y[1] || high[1] < y[0])
        return false;
    const int64_t area = side_of(q, 0, 1, q->x[2], q->y[2]);
    for (int i = 0; area != 0 && i < 4; i++)
        if (is_beyond(q, i, (i + 1) % 4, area > 0 ? 1 : -1, x, y))
            return false;
    return true;
}

/* The samples that a quad covers, as bits; nothing but `ok` tells that they could not be found. */
static unsigned covered(renderer *r, const probe *p, const quad *q, bool *ok, octreel_error *error)
{
    uint8_t bytes[MOST_SAMPLES];
    quad alone = *q;
    unsigned bits = 0;
    alone.color = 1;
    *ok = renderer_rasterise(r, &alone, 1, &p->part, bytes, error);
    for (int i = 0; *ok && i < p->part.width * p->part.height; i++)
        bits |= (unsigned)(bytes[i] != 0) << i;
    return bits;
}

/* Each sample of an edge may be another box's. Those that merely share it come behind. */
static void add_edge(probe *p, const quad *q, unsigned bits)
{
    const edge *e = paint_edge_at(&p->painter, q->index);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < p->part.width * p->part.height; i++) {
            const int x = p->part.x + i % p->part.width, y = p->part.y + i / p->part.width;
            if (!(bits >> i & 1))
                continue;
            if (pass == 0)
                add_paint(p, SCENE_BOX, edge_boxes_giver(&p->boxes, e, x, y), q->color, i);
            else
                edge_boxes_visit(&p->boxes, e, x, y, add_box_too, p);
        }
    }
}

static void add_quad(probe *p, const quad *q, unsigned bits)
{
    if (q->kind == SCENE_BOX)
        add_edge(p, q, bits);
    for (int i = 0; q->kind != SCENE_BOX && i < MOST_SAMPLES; i++)
        if (bits >> i & 1)
            add_paint(p, (scene_kind)q->kind, q->index, q->color, i);
    if (q->kind == SCENE_MARKER)
        add_points_too(p, q->index);
    p->taken |= bits;
}

static bool probe_quads(renderer *r, probe *p, octreel_error *error)
{
    bool ok = true;
    for (size_t i = p->painter.quads.count; ok && i-- > 0;) {
        const quad *q = &p->painter.quads.items[i];
        const unsigned bits = may_reach(q, &p->part) ? covered(r, p, q, &ok, error) : 0;
        if (bits)
            add_quad(p, q, bits);
    }
    return ok;
}

static bool is_inside(const scene *s, int x, int y, octreel_error *error)
{
    if (x >= 0 && y >= 0 && x < s->view.width && y < s->view.height)
        return true;
    snprintf(error->text, sizeof error->text, "pixel (%d, %d) is outside the picture, which has %d x %d pixels", x, y,
             s->view.width, s->view.height);
    return false;
}

bool renderer_pixel(renderer *r, const scene *s, int x, int y, draw_touches *list, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    probe p = {.picture = s, .fine = paint_samples(s), .part = {x * samples, y * samples, samples, samples}};
    p.list = list;
    list->count = 0;
    if (!renderer_fits(r, s, error) || !is_inside(s, x, y, error))
        return false;
    p.out_of_memory = !paint(&p.painter, s) || !edge_boxes_make(&p.boxes, &p.fine);
    const bool ok = p.out_of_memory || probe_quads(r, &p, error);
    edge_boxes_release(&p.boxes);
    painter_release(&p.painter);
    if (p.out_of_memory)
        snprintf(error->text, sizeof error->text, "there is no memory to tell what is drawn at a pixel");
    return ok && !p.out_of_memory;
}
