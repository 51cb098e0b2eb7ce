/* SPDX-License-Identifier: MIT */
/* pixel.c - finds the topmost element at each sample, all elements at one pixel, and the pixels of some layers.
 *
 * The technique is known as "item buffer": the quads of the picture are drawn a second time, and each quad has the
 * number of its element instead of its colour. The same rasterizer draws the same quads in the same order. So each
 * sample has the same topmost element as in the picture, and no second implementation of visibility is needed that
 * could disagree. A framebuffer has one byte per sample, so numbers are drawn byte by byte, in up to four passes.
 *
 * Boxes need one more step. A merged edge is drawn as one stroke, for all boxes that share the edge (edges.c). So the
 * drawn numbers are numbers of strokes. edge_boxes.c then finds the box that gives the stroke its colour at the sample.
 *
 * To list everything at one pixel, including hidden elements, each quad that may reach the pixel is drawn alone into a
 * picture of that pixel. */
#include "pixel.h"
#include "array.h"
#include "edge_boxes.h"
#include "fill.h"
#include "layer.h"
#include "paint.h"
#include "project.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The scene and its close-up ------------------------------------------------------------------------------ */

/* One of the two painted scenes of a picture: the outer scene, or the close-up inside it. A scene has one stroke for
 * each merged edge, and one stroke for each element that is not a box. Strokes are numbered from 1: first the merged
 * edges, then the other elements in their order. The numbers of a close-up's strokes follow the numbers of the outer
 * scene's strokes. */
typedef struct source {
    const scene *scene;
    const painter *painter;
    scene fine; /* a copy of `scene` from project_scene_to_samples() */
    edge_boxes boxes;
    uint64_t strokes;         /* the number of strokes of this scene */
    uint64_t strokes_before;  /* only for a close-up: the number of strokes of the outer scene */
    uint32_t elements_before; /* only for a close-up: the number of elements of the outer scene */
    int left, top;            /* the position of the scene's top left sample in the picture */
    bool points_listed;       /* true: add_painted_points() has listed this scene's points */
} source;

/* The outer scene, then its close-up. The second entry is empty if there is no close-up. */
typedef source sources[2];

static void release_sources(sources all)
{
    for (int i = 0; i < 2; i++)
        edge_boxes_release(&all[i].boxes);
}

/* Fill *from for a scene that `p` has painted. Returns false if memory runs out. */
static bool init_source(source *from, const scene *s, const painter *p)
{
    const int samples = s->view.aa;
    from->scene = s;
    from->painter = p;
    from->fine = project_scene_to_samples(s);
    from->strokes = painter_edge_count(p) + scene_count_elements(s) - s->boxes.count;
    from->left = s->place[0] * samples;
    from->top = s->place[1] * samples;
    return edge_boxes_collect_edges(&from->boxes, &from->fine);
}

/* Fill zeroed sources for a scene and its close-up. The sources must not be moved in memory afterwards. Returns false
 * if memory runs out. */
static bool init_sources(sources all, const scene *s, const painter *p)
{
    if (!init_source(&all[0], s, p) || (s->has_closeup && !init_source(&all[1], s->closeup, p->closeup)))
        return false;
    all[1].strokes_before = all[0].strokes;
    all[1].elements_before = (uint32_t)scene_count_elements(s);
    return true;
}

static source *find_source_of_quad(sources all, const quad *q)
{
    return &all[q->kind >= QUAD_IN_CLOSEUP];
}

/* Returns the element of a quad. If the quad belongs to a box, q->index is the index of a merged edge, and the caller
 * passes the index of the box in `index`. */
static scene_element make_quad_element(const quad *q, size_t index)
{
    return (scene_element){(scene_kind)(q->kind % QUAD_IN_CLOSEUP), index, q->kind >= QUAD_IN_CLOSEUP};
}

static bool is_edge_quad(const quad *q)
{
    return q->kind % QUAD_IN_CLOSEUP == SCENE_BOX;
}

/* ---- The topmost element of samples -------------------------------------------------------------------------- */

static size_t count_samples(const scene *s)
{
    const size_t side = (size_t)s->view.aa;
    return (size_t)s->view.width * (size_t)s->view.height * side * side;
}

/* Draw all quads of a painter into `samples`, one byte for each sample. */
static bool fill_all_quads(renderer *r, const scene *s, const painter *p, uint8_t *samples, octreel_error *error)
{
    const int side = s->view.aa;
    const renderer_part all = {0, 0, s->view.width * side, s->view.height * side};
    return renderer_fill_quads(r, p->quads.items, p->quads.count, all, samples, error);
}

/* Returns the number of the stroke to which a quad belongs. */
static uint64_t find_stroke_number(sources all, const quad *q)
{
    const source *from = find_source_of_quad(all, q);
    const scene_kind kind = make_quad_element(q, 0).kind;
    if (kind == SCENE_BOX)
        return from->strokes_before + 1 + q->index;
    return from->strokes_before + scene_element_number(from->scene, (scene_element){.kind = kind, .index = q->index}) -
           from->scene->boxes.count + painter_edge_count(from->painter);
}

/* Write the number of the topmost stroke to each sample. The quads are drawn once for each byte of the largest
 * number. */
static bool draw_stroke_numbers(renderer *r, const scene *s, painter *p, sources all, uint32_t *numbers,
                                octreel_error *error)
{
    const size_t size = count_samples(s);
    const uint64_t largest = all[0].strokes + all[1].strokes;
    uint8_t *bytes = largest <= UINT32_MAX ? malloc(size) : NULL;
    bool ok = bytes || error_no_memory(error);
    memset(numbers, 0, size * sizeof *numbers);
    for (unsigned shift = 0; ok && shift < 32 && largest >> shift; shift += 8) {
        for (size_t i = 0; i < p->quads.count; i++)
            p->quads.items[i].color = (uint8_t)(find_stroke_number(all, &p->quads.items[i]) >> shift);
        ok = fill_all_quads(r, s, p, bytes, error);
        for (size_t i = 0; ok && i < size; i++)
            numbers[i] |= (uint32_t)bytes[i] << shift;
    }
    free(bytes);
    return ok;
}

/* Returns the number of the element to which the stroke belongs at sample (x, y). */
static uint32_t find_element_number(const source *from, uint32_t stroke, int x, int y)
{
    const uint32_t edges = (uint32_t)painter_edge_count(from->painter);
    if (stroke > edges)
        return stroke - edges + (uint32_t)from->scene->boxes.count;
    return 1 + (uint32_t)edge_boxes_find_owner(&from->boxes, painter_edge_at(from->painter, stroke - 1), x - from->left,
                                               y - from->top);
}

/* Replace, at each sample, the number of the stroke by the number of its element. */
static void replace_stroke_numbers(const scene *s, const sources all, uint32_t *numbers)
{
    const size_t width = (size_t)s->view.width * (size_t)s->view.aa, size = count_samples(s);
    for (size_t i = 0; i < size; i++) {
        const source *from = &all[numbers[i] > all[0].strokes];
        if (numbers[i] > 0)
            numbers[i] = from->elements_before + find_element_number(from, numbers[i] - (uint32_t)from->strokes_before,
                                                                     (int)(i % width), (int)(i / width));
    }
}

bool renderer_find_element_numbers(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error)
{
    if (!renderer_fits_scene(r, s, error))
        return false;
    painter p = {0}; /* a painter of its own, because the renderer's painter must keep the previous frame */
    sources all = {0};
    const bool ok = ((painter_paint_scene(&p, s) && init_sources(all, s, &p)) || error_no_memory(error)) &&
                    draw_stroke_numbers(r, s, &p, all, numbers, error);
    if (ok)
        replace_stroke_numbers(s, all, numbers);
    release_sources(all);
    painter_release(&p);
    return ok;
}

/* ---- Layers -------------------------------------------------------------------------------------------------- */

/* Returns 1 << the layer of a quad's element. If the quad is in a close-up, the bit of LAYER_CLOSEUP is set too. */
static unsigned find_layer_bits_of_quad(const scene *s, const painter *p, const quad *q)
{
    const scene_element element = make_quad_element(q, q->index);
    const painter *of = element.in_closeup ? p->closeup : p;
    const unsigned own =
        is_edge_quad(q) ? painter_edge_at(of, q->index)->style.layer : scene_element_head(s, element).style.layer;
    return 1u << own | (element.in_closeup ? 1u << LAYER_CLOSEUP : 0);
}

/* Set a pixel of the mask if at least one of the pixel's samples is set. */
static void shrink_mask(const view *v, const uint8_t *samples, uint8_t *mask)
{
    const size_t side = (size_t)v->aa, width = (size_t)v->width;
    memset(mask, 0, width * (size_t)v->height);
    for (size_t y = 0; y < (size_t)v->height * side; y++)
        for (size_t x = 0; x < width * side; x++)
            mask[y / side * width + x / side] |= samples[y * width * side + x];
}

bool renderer_find_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error)
{
    if (!renderer_fits_scene(r, s, error))
        return false;
    uint8_t *samples = malloc(count_samples(s));
    painter p = {0};
    bool ok = (samples && painter_paint_scene(&p, s)) || error_no_memory(error);
    for (size_t i = 0; ok && i < p.quads.count; i++)
        p.quads.items[i].color = (layers & find_layer_bits_of_quad(s, &p, &p.quads.items[i])) != 0;
    ok = ok && fill_all_quads(r, s, &p, samples, error);
    if (ok)
        shrink_mask(&s->view, samples, mask);
    painter_release(&p);
    free(samples);
    return ok;
}

/* ---- All elements of one pixel ------------------------------------------------------------------------------- */

#define MOST_SAMPLES 16 /* the maximum number of samples of a pixel: 4 on each axis */

/* The state of the search for the elements at one pixel. */
typedef struct probe {
    const scene *picture;
    painter painter;
    sources sources;
    renderer_part part; /* the rectangle of the pixel's samples */
    unsigned taken;     /* one bit for each sample of the pixel; set if the topmost element of the sample is known */
    const quad *quad;   /* the quad whose elements are being listed */
    draw_covers *list;
    bool out_of_memory;
} probe;

void draw_covers_release(draw_covers *list)
{
    free(list->items);
    *list = (draw_covers){0};
}

/* Append an element to the list. The list must not contain the element yet. Returns null if memory runs out. */
static draw_cover *append_cover(probe *p, uint32_t number)
{
    draw_covers *list = p->list;
    if (!ARRAY_GROW(list, 1)) {
        p->out_of_memory = true;
        return NULL;
    }
    list->items[list->count] = (draw_cover){.number = number};
    return &list->items[list->count++];
}

/* Find an element's entry in the list, or append an entry. Returns null if memory runs out. */
static draw_cover *find_or_append_cover(probe *p, scene_element element)
{
    const uint32_t number = scene_element_number(p->picture, element);
    for (size_t i = 0; i < p->list->count; i++)
        if (p->list->items[i].number == number)
            return &p->list->items[i];
    return append_cover(p, number);
}

/* Record that an element covers a sample: the element with the index `index` and the kind of p->quad. Must be called
 * for the topmost quad first and for the lowest quad last. */
static void add_covered_sample(probe *p, size_t index, int sample)
{
    draw_cover *cover = find_or_append_cover(p, make_quad_element(p->quad, index));
    const bool shown = !(p->taken >> sample & 1);
    if (!cover || cover->at >> sample & 1)
        return;
    if (cover->painted == 0 || (shown && cover->shown == 0))
        cover->color = p->quad->color;
    cover->at |= (uint16_t)(1u << sample);
    cover->painted++;
    cover->shown += shown;
}

/* Add a box that shares the merged edge of p->quad. */
static void add_sharing_box(size_t box, void *context)
{
    probe *p = context;
    find_or_append_cover(p, make_quad_element(p->quad, box));
}

/* Append a point to the list, unless it is the point of p->quad, which has an entry already. No search for an existing
 * entry is needed: the other points that callers pass have none, and there may be many. */
static void append_point_cover(probe *p, size_t index)
{
    if (index != p->quad->index)
        append_cover(p, scene_element_number(p->picture, make_quad_element(p->quad, index)));
}

/* Add the points that are projected to the same sample as the point of p->quad. */
static void add_sharing_points(probe *p, const source *from)
{
    const point_place *places = from->painter->places;
    for (size_t i = 0; i < from->scene->markers.count; i++)
        if (places[i].seen && places[i].pixel == places[p->quad->index].pixel)
            append_point_cover(p, i);
}

/* List the points that are painted as discs (view_paints_points()) and cover the pixel, including hidden points. Each
 * scene's points are listed only once. */
static void add_painted_points(probe *p, source *from)
{
    const splat_square samples = {p->part.x - from->left, p->part.y - from->top, p->part.width};
    splat_list list = {.count = 0};
    if (from->points_listed)
        return;
    from->points_listed = true;
    p->out_of_memory |= !splats_list_covering_points(&from->fine, &samples, &list);
    for (size_t i = 0; i < list.count; i++)
        append_point_cover(p, list.items[i].marker);
    free(list.items);
}

/* If p->quad belongs to a point, append the points that it hides or that share it. */
static void append_points_sharing_quad(probe *p)
{
    source *from = find_source_of_quad(p->sources, p->quad);
    if (from->scene->markers.items[p->quad->index].style.layer != LAYER_POINTS)
        return;
    if (view_paints_points(&from->scene->view))
        add_painted_points(p, from);
    else
        add_sharing_points(p, from);
}

/* Returns whether a quad may cover a sample of the pixel: whether the quad's bounding box reaches the pixel. */
static bool can_reach_pixel(const quad *q, const renderer_part *part)
{
    const int32_t left = part->x * QUAD_SUBPIXELS, right = (part->x + part->width) * QUAD_SUBPIXELS;
    const int32_t top = part->y * QUAD_SUBPIXELS, bottom = (part->y + part->height) * QUAD_SUBPIXELS;
    /* the number of the quad's corners beyond each side of the pixel */
    int before = 0, after = 0, above = 0, below = 0;
    for (int i = 0; i < 4; i++) {
        before += q->x[i] < left;
        after += q->x[i] > right;
        above += q->y[i] < top;
        below += q->y[i] > bottom;
    }
    return before < 4 && after < 4 && above < 4 && below < 4;
}

/* Returns the samples of the pixel that p->quad covers, as bits. *ok becomes false if drawing fails. */
static unsigned find_covered_sample_bits(renderer *r, const probe *p, bool *ok, octreel_error *error)
{
    uint8_t bytes[MOST_SAMPLES];
    quad alone = *p->quad;
    unsigned bits = 0;
    alone.color = 1;
    *ok = renderer_fill_quads(r, &alone, 1, p->part, bytes, error);
    for (int i = 0; *ok && i < p->part.width * p->part.height; i++)
        bits |= (unsigned)(bytes[i] != 0) << i;
    return bits;
}

/* Add the boxes of a merged edge to the list: first, for each covered sample, the box that gives the edge its colour;
 * then the boxes that share the edge. */
static void add_edge_covers(probe *p, unsigned bits)
{
    const source *from = find_source_of_quad(p->sources, p->quad);
    const edge *e = painter_edge_at(from->painter, p->quad->index);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < p->part.width * p->part.height; i++) {
            const int x = p->part.x + i % p->part.width - from->left, y = p->part.y + i / p->part.width - from->top;
            if (!(bits >> i & 1))
                continue;
            if (pass == 0)
                add_covered_sample(p, edge_boxes_find_owner(&from->boxes, e, x, y), i);
            else
                edge_boxes_visit_sharing(&from->boxes, e, x, y, add_sharing_box, p);
        }
    }
}

static void add_quad_covers(probe *p, unsigned bits)
{
    if (is_edge_quad(p->quad))
        add_edge_covers(p, bits);
    for (int i = 0; !is_edge_quad(p->quad) && i < MOST_SAMPLES; i++)
        if (bits >> i & 1)
            add_covered_sample(p, p->quad->index, i);
    if (make_quad_element(p->quad, 0).kind == SCENE_MARKER)
        append_points_sharing_quad(p);
    p->taken |= bits;
}

static bool add_all_quad_covers(renderer *r, probe *p, octreel_error *error)
{
    bool ok = true;
    for (size_t i = p->painter.quads.count; ok && i-- > 0;) {
        p->quad = &p->painter.quads.items[i];
        const unsigned bits = can_reach_pixel(p->quad, &p->part) ? find_covered_sample_bits(r, p, &ok, error) : 0;
        if (bits)
            add_quad_covers(p, bits);
    }
    return ok;
}

bool renderer_list_pixel_covers(renderer *r, const scene *s, int x, int y, draw_covers *list, octreel_error *error)
{
    const int samples = s->view.aa;
    probe p = {.picture = s, .part = {x * samples, y * samples, samples, samples}, .list = list};
    list->count = 0;
    if (!renderer_fits_scene(r, s, error))
        return false;
    if (x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return error_set(error, "pixel (%d, %d) is outside the picture, which has %d x %d pixels", x, y, s->view.width,
                         s->view.height);
    p.out_of_memory = !painter_paint_scene(&p.painter, s) || !init_sources(p.sources, s, &p.painter);
    const bool ok = p.out_of_memory || add_all_quad_covers(r, &p, error);
    release_sources(p.sources);
    painter_release(&p.painter);
    return p.out_of_memory ? error_no_memory(error) : ok;
}
