/* SPDX-License-Identifier: MIT */
/* pixel.c - a picture's quads are drawn again with numbers for colours, so that every sample has the same winner as in
 * the picture. For one pixel, the quads that may cover it are drawn one by one. */
#include "pixel.h"
#include "array.h"
#include "paint.h"
#include "project.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The boxes that lie on a merged edge ---------------------------------------------------------------------
 *
 * An edge is one stroke for all boxes that share it. To find these at a sample, the sample is mapped back to a place on
 * the line. The map from a line to its projection is a quotient of linear functions, and so is its inverse.
 */

/* One edge of one box. */
typedef struct box_edge {
    line_key line;
    double from, to;
    uint32_t box;
    uint8_t depth;
} box_edge;

/* The edges of all boxes of a scene, sorted by the lines that they lie on. */
typedef struct edge_boxes {
    const scene *scene; /* in samples; must outlive this */
    box_edge *items;
    size_t count;
} edge_boxes;

static int compare_edges(const void *a, const void *b)
{
    const box_edge *p = a, *q = b;
    const int lines = line_key_compare(&p->line, &q->line);
    if (lines)
        return lines;
    const int from = compare_doubles(p->from, q->from);
    return from ? from : (p->box > q->box) - (p->box < q->box);
}

static box_edge edge_of(const scene_box *box, size_t index, unsigned axis, unsigned corner)
{
    return (box_edge){
        .line = line_key_of(box, axis, corner),
        .from = box->box.min[axis],
        .to = box->box.max[axis],
        .box = (uint32_t)index,
        .depth = box->depth,
    };
}

static bool edge_boxes_make(edge_boxes *all, const scene *s)
{
    *all = (edge_boxes){.scene = s};
    const size_t size = 12 * sizeof *all->items;
    if (s->boxes.count == 0)
        return true;
    all->items = s->boxes.count <= SIZE_MAX / size ? malloc(s->boxes.count * size) : NULL;
    if (!all->items)
        return false;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        const size_t before = all->count;
        for (unsigned axis = 0; axis < 3; axis++)
            for (unsigned corner = 0; corner < 4 && box->box.min[axis] < box->box.max[axis]; corner++)
                all->items[all->count++] = edge_of(box, i, axis, corner);
        if (all->count == before) /* a dot */
            all->items[all->count++] = edge_of(box, i, 0, 0);
    }
    qsort(all->items, all->count, sizeof *all->items, compare_edges);
    return true;
}

static void edge_boxes_release(edge_boxes *all)
{
    free(all->items);
    *all = (edge_boxes){0};
}

/* A merged edge as it was painted. */
typedef struct stroke {
    const edge *edge;
    line_key line;
    double from, to;
    double seen[2][3]; /* of the ends, in camera coordinates */
    int across;        /* the picture's axis that the stroke is longer on */
    bool speck;        /* too small on screen to tell places on the line apart */
} stroke;

static stroke stroke_of(const scene *s, const edge *e)
{
    unsigned axis = 0;
    while (axis < 2 && e->ends[0][axis] == e->ends[1][axis])
        axis++;
    if (e->ends[0][axis] == e->ends[1][axis])
        axis = 0;
    stroke k = {
        .edge = e, .line = line_key_at(e->style, axis, e->ends[0]), .from = e->ends[0][axis], .to = e->ends[1][axis]};
    piece pieces[QUAD_BANDS];
    bool overflowed;
    const unsigned count = project_segment(s, e->ends[0], e->ends[1], pieces, &overflowed);
    if (count == 0) {
        k.speck = true;
        return k;
    }
    const double dx = fabs(pieces[count - 1].to[0] - pieces[0].from[0]);
    const double dy = fabs(pieces[count - 1].to[1] - pieces[0].from[1]);
    k.speck = dx < 1 && dy < 1;
    k.across = dy > dx;
    for (int end = 0; end < 2; end++)
        camera_transform(&s->camera, e->ends[end], k.seen[end]);
    return k;
}

/* The place on the line that is seen at a coordinate of the picture, within the edge. */
static double place_at(const scene *s, const stroke *k, double pixel)
{
    const camera *c = &s->camera;
    const double slope = (pixel - c->middle[k->across]) / c->zoom * (k->across ? -1 : 1);
    double off[2]; /* distance of each end from the plane through the eye and this coordinate */
    for (int end = 0; end < 2; end++)
        off[end] = k->seen[end][k->across] - slope * (c->perspective ? k->seen[end][2] : 1);
    const double part = off[0] / (off[0] - off[1]);
    if (!(part > 0))
        return k->from;
    return part < 1 ? k->from * (1 - part) + k->to * part : k->to;
}

/* The first edge of a box on a line, or where it would be. */
static size_t first_on(const edge_boxes *all, const line_key *wanted)
{
    size_t low = 0, high = all->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (line_key_compare(&all->items[middle].line, wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool is_on(const edge_boxes *all, size_t i, const stroke *k)
{
    return i < all->count && line_key_compare(&all->items[i].line, &k->line) == 0 && all->items[i].from <= k->to;
}

static double distance(const box_edge *of, double at)
{
    return at < of->from ? of->from - at : at > of->to ? at - of->to : 0;
}

/* The index of the box that gives an edge of edges_merge() its colour at a sample. */
static size_t edge_boxes_owner(const edge_boxes *all, const edge *e, int x, int y)
{
    const stroke k = stroke_of(all->scene, e);
    const double at = k.speck ? k.from : place_at(all->scene, &k, (k.across ? y : x) + 0.5);
    const box_edge *best = NULL;
    for (size_t i = first_on(all, &k.line); is_on(all, i, &k); i++) {
        const box_edge *found = &all->items[i];
        const bool gives = found->depth == e->depth && all->scene->boxes.items[found->box].style.role == e->style.role;
        if (gives && found->to >= k.from && (!best || distance(found, at) < distance(best, at)))
            best = found;
    }
    return best->box; /* not null: an edge consists of the edges of boxes */
}

/* All boxes that have an edge where this one passes through a sample, the owner among them; some twice. */
static void edge_boxes_visit(const edge_boxes *all, const edge *e, int x, int y,
                             void (*visit)(size_t box, void *context), void *context)
{
    const stroke k = stroke_of(all->scene, e);
    double low = k.from, high = k.to;
    if (!k.speck) {
        const int pixel = k.across ? y : x;
        const double ends[2] = {place_at(all->scene, &k, pixel), place_at(all->scene, &k, pixel + 1)};
        low = fmin(ends[0], ends[1]);
        high = fmax(ends[0], ends[1]);
    }
    for (size_t i = first_on(all, &k.line); is_on(all, i, &k); i++)
        if (all->items[i].from <= high && all->items[i].to >= low)
            visit(all->items[i].box, context);
}

/* ---- The element at each sample ------------------------------------------------------------------------------ */

static size_t count_samples(const scene *s)
{
    const size_t side = (size_t)view_samples(&s->view);
    return (size_t)s->view.width * (size_t)s->view.height * side * side;
}

/* Fill all quads, a byte a sample. */
static bool fill_all(renderer *r, const scene *s, const painter *p, uint8_t *samples, octreel_error *error)
{
    const int side = view_samples(&s->view);
    const renderer_part all = {0, 0, s->view.width * side, s->view.height * side};
    return renderer_fill(r, p->quads.items, p->quads.count, all, samples, error);
}

/* Quads are numbered as elements are, with the merged edges in the place of the boxes. */
static uint64_t stroke_number(const scene *s, const painter *p, const quad *q)
{
    if (q->kind == SCENE_BOX)
        return 1 + (uint64_t)q->index;
    return (uint64_t)scene_number_of(s, (scene_element){(scene_kind)q->kind, q->index}) - s->boxes.count +
           paint_edge_count(p);
}

/* The framebuffer holds one byte a sample: the quads are drawn once for each byte of the largest number. */
static bool draw_strokes(renderer *r, const scene *s, painter *p, uint32_t *numbers, octreel_error *error)
{
    const size_t size = count_samples(s);
    const uint64_t largest =
        paint_edge_count(p) + s->segments.count + s->markers.count + s->panels.count + s->labels.count;
    uint8_t *bytes = largest <= UINT32_MAX ? malloc(size) : NULL;
    bool ok = bytes || error_no_memory(error);
    memset(numbers, 0, size * sizeof *numbers);
    for (unsigned shift = 0; ok && shift < 32 && largest >> shift; shift += 8) {
        for (size_t i = 0; i < p->quads.count; i++)
            p->quads.items[i].color = (uint8_t)(stroke_number(s, p, &p->quads.items[i]) >> shift);
        ok = fill_all(r, s, p, bytes, error);
        for (size_t i = 0; ok && i < size; i++)
            numbers[i] |= (uint32_t)bytes[i] << shift;
    }
    free(bytes);
    return ok;
}

/* Replace the numbers of strokes by those of elements. */
static bool name_boxes(const scene *s, const painter *p, uint32_t *numbers, octreel_error *error)
{
    const scene fine = project_samples(s);
    const size_t width = (size_t)fine.view.width, size = count_samples(s);
    const uint32_t edges = (uint32_t)paint_edge_count(p);
    edge_boxes boxes;
    if (!edge_boxes_make(&boxes, &fine))
        return error_no_memory(error);
    for (size_t i = 0; i < size; i++) {
        if (numbers[i] > edges)
            numbers[i] = numbers[i] - edges + (uint32_t)s->boxes.count;
        else if (numbers[i] > 0)
            numbers[i] = 1 + (uint32_t)edge_boxes_owner(&boxes, paint_edge_at(p, numbers[i] - 1), (int)(i % width),
                                                        (int)(i / width));
    }
    edge_boxes_release(&boxes);
    return true;
}

bool renderer_pick(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error)
{
    if (!renderer_fits(r, s, error))
        return false;
    painter p = {0}; /* the renderer's own may be in use by the next frame */
    const bool ok = (paint(&p, s) || error_no_memory(error)) && draw_strokes(r, s, &p, numbers, error) &&
                    name_boxes(s, &p, numbers, error);
    painter_release(&p);
    return ok;
}

/* ---- Layers -------------------------------------------------------------------------------------------------- */

static unsigned layer_of(const scene *s, const painter *p, const quad *q)
{
    return q->kind == SCENE_BOX ? paint_edge_at(p, q->index)->style.layer
                                : scene_head_of(s, (scene_element){(scene_kind)q->kind, q->index}).style.layer;
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
    uint8_t *samples = malloc(count_samples(s));
    painter p = {0};
    bool ok = (samples && paint(&p, s)) || error_no_memory(error);
    for (size_t i = 0; ok && i < p.quads.count; i++)
        p.quads.items[i].color = layers >> layer_of(s, &p, &p.quads.items[i]) & 1;
    ok = ok && fill_all(r, s, &p, samples, error);
    if (ok)
        shrink_mask(&s->view, samples, mask);
    painter_release(&p);
    free(samples);
    return ok;
}

/* ---- All elements of one pixel ------------------------------------------------------------------------------- */

#define MOST_SAMPLES 16 /* of a pixel: 4 on each axis */

/* A query about one pixel. */
typedef struct probe {
    const scene *picture;
    scene fine; /* in samples */
    painter painter;
    edge_boxes boxes;
    renderer_part part; /* its samples */
    unsigned taken;     /* bits of those that have an element on top already */
    draw_touches *list;
    bool out_of_memory;
} probe;

void draw_touches_release(draw_touches *list)
{
    free(list->items);
    *list = (draw_touches){0};
}

static draw_touch *find_touch(draw_touches *list, uint32_t number)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].number == number)
            return &list->items[i];
    return NULL;
}

/* The entry of an element, which is appended if it has none; null when there is no memory. */
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

/* Note that an element covers a sample. Quads come from the last to the first. */
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

/* Add a box that shares an edge. */
static void add_box_too(size_t box, void *context)
{
    take_touch(context, SCENE_BOX, box);
}

/* Add the points that share the sample of a point that is drawn. */
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

/* Whether a quad may cover a sample of the pixel: it is less than a sample's width away. */
static bool may_reach(const quad *q, const renderer_part *part)
{
    const int64_t x[2] = {(int64_t)(part->x - 1) * QUAD_SUBPIXELS,
                          (int64_t)(part->x + part->width + 1) * QUAD_SUBPIXELS};
    const int64_t y[2] = {(int64_t)(part->y - 1) * QUAD_SUBPIXELS,
                          (int64_t)(part->y + part->height + 1) * QUAD_SUBPIXELS};
    int left = 0, right = 0, above = 0, below = 0; /* corners of the quad */
    for (int i = 0; i < 4; i++) {
        left += q->x[i] < x[0];
        right += q->x[i] > x[1];
        above += q->y[i] < y[0];
        below += q->y[i] > y[1];
    }
    const int64_t area = side_of(q, 0, 1, q->x[2], q->y[2]);
    bool apart = left == 4 || right == 4 || above == 4 || below == 4;
    for (int i = 0; area != 0 && !apart && i < 4; i++)
        apart = is_beyond(q, i, (i + 1) % 4, area > 0 ? 1 : -1, x, y);
    return !apart;
}

/* The samples that a quad covers, as bits; *ok is false when drawing fails. */
static unsigned covered(renderer *r, const probe *p, const quad *q, bool *ok, octreel_error *error)
{
    uint8_t bytes[MOST_SAMPLES];
    quad alone = *q;
    unsigned bits = 0;
    alone.color = 1;
    *ok = renderer_fill(r, &alone, 1, p->part, bytes, error);
    for (int i = 0; *ok && i < p->part.width * p->part.height; i++)
        bits |= (unsigned)(bytes[i] != 0) << i;
    return bits;
}

/* The owner of an edge may differ from sample to sample. Boxes that merely share it come last. */
static void add_edge(probe *p, const quad *q, unsigned bits)
{
    const edge *e = paint_edge_at(&p->painter, q->index);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < p->part.width * p->part.height; i++) {
            const int x = p->part.x + i % p->part.width, y = p->part.y + i / p->part.width;
            if (!(bits >> i & 1))
                continue;
            if (pass == 0)
                add_paint(p, SCENE_BOX, edge_boxes_owner(&p->boxes, e, x, y), q->color, i);
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

bool renderer_pixel(renderer *r, const scene *s, int x, int y, draw_touches *list, octreel_error *error)
{
    const int samples = view_samples(&s->view);
    probe p = {.picture = s, .fine = project_samples(s), .part = {x * samples, y * samples, samples, samples}};
    p.list = list;
    list->count = 0;
    if (!renderer_fits(r, s, error))
        return false;
    if (x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return error_set(error, "pixel (%d, %d) is outside the picture, which has %d x %d pixels", x, y, s->view.width,
                         s->view.height);
    p.out_of_memory = !paint(&p.painter, s) || !edge_boxes_make(&p.boxes, &p.fine);
    const bool ok = p.out_of_memory || probe_quads(r, &p, error);
    edge_boxes_release(&p.boxes);
    painter_release(&p.painter);
    return p.out_of_memory ? error_no_memory(error) : ok;
}
