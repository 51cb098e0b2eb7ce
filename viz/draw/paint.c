/* SPDX-License-Identifier: MIT */
/* paint.c - turns a scene into quads in painter's order. */
#include "paint.h"
#include "layer.h"
#include "letters.h"
#include "stroke.h"

#include <stdlib.h>
#include <string.h>

void painter_release(painter *p)
{
    quads_release(&p->quads);
    edges_release(&p->tree);
    edges_release(&p->edges);
    free(p->nearest);
    free(p->places);
    splats_release(&p->splats);
    if (p->closeup)
        painter_release(p->closeup);
    free(p->closeup);
    memset(p, 0, sizeof *p);
}

static void add_stroke(painter *p, const scene *s, const piece *pieces, unsigned count, scene_style style,
                       unsigned depth)
{
    const pencil with = stroke_make_pencil(s, style, depth);
    stroke_add_line(&p->quads, &with, pieces, count);
}

static void paint_segment(painter *p, const scene *s, const double from[3], const double to[3], scene_style style,
                          unsigned depth)
{
    piece pieces[QUAD_BANDS];
    bool overflowed;
    const unsigned count = project_segment(s, from, to, pieces, &overflowed);
    p->overflowed += overflowed;
    add_stroke(p, s, pieces, count, style, depth);
}

/* Paint the segments in picture coordinates if `in_picture` is true. Otherwise paint the segments in world
 * coordinates. */
static void paint_segments(painter *p, const scene *s, bool in_picture)
{
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *segment = &s->segments.items[i];
        piece flat;
        if (segment->in_picture != in_picture)
            continue;
        quads_begin_element(&p->quads, SCENE_SEGMENT, i);
        if (!in_picture)
            paint_segment(p, s, segment->ends[0], segment->ends[1], segment->style, 0);
        else if (clip_picture_segment(s, segment->ends[0], segment->ends[1], &flat))
            add_stroke(p, s, &flat, 1, segment->style, 0);
    }
}

static bool paint_boxes(painter *p, const scene *s)
{
    if (!edges_merge(&p->tree, s, 0, LAYER_NODES + 1) || !edges_merge(&p->edges, s, LAYER_NODES + 1, LAYER_ALL))
        return false;
    for (size_t i = 0; i < painter_edge_count(p); i++) {
        const edge *e = painter_edge_at(p, i);
        quads_begin_element(&p->quads, SCENE_BOX, i);
        paint_segment(p, s, e->ends[0], e->ends[1], e->style, e->depth);
    }
    return true;
}

size_t painter_edge_count(const painter *p)
{
    return p->tree.now.count + p->edges.now.count;
}

const edge *painter_edge_at(const painter *p, size_t index)
{
    const edge_array *tree = &p->tree.now;
    return index < tree->count ? &tree->items[index] : &p->edges.now.items[index - tree->count];
}

static void paint_marker(painter *p, const scene *s, const scene_marker *marker)
{
    double pixel[2];
    unsigned band;
    if (!find_pixel_and_band(s, marker->at, pixel, &band))
        return;
    const pencil with = stroke_make_pencil(s, marker->style, 0);
    stroke_add_marker(&p->quads, &with, (scene_shape)marker->shape, pixel, band);
}

static bool is_point_marker(const scene_marker *marker)
{
    return marker->style.layer == LAYER_POINTS;
}

/* Allocate p->nearest, zeroed, with one byte for each sample, and p->places, with one entry for each marker. */
static bool reserve_point_buffers(painter *p, const scene *s)
{
    const size_t samples = (size_t)s->view.width * (size_t)s->view.height;
    if (!array_grow(&p->nearest, samples, &p->nearest_room, 1) ||
        !array_grow(&p->places, s->markers.count, &p->place_room, sizeof *p->places))
        return false;
    memset(p->nearest, 0, samples);
    return true;
}

/* Paint one quad at each sample that has points. The quad shows a point of the nearest band, because such a point
 * covers the points of all other bands. */
static bool paint_points(painter *p, const scene *s)
{
    if (!reserve_point_buffers(p, s))
        return false;
    project_points(s, s->markers.items, s->markers.count, p->places);
    for (size_t i = 0; i < s->markers.count; i++) {
        point_place *at = &p->places[i];
        at->seen = at->seen && is_point_marker(&s->markers.items[i]);
        if (at->seen && (p->nearest[at->pixel] == 0 || p->nearest[at->pixel] > at->band + 1))
            p->nearest[at->pixel] = (uint8_t)(at->band + 1);
    }
    for (size_t i = 0; i < s->markers.count; i++) {
        const point_place at = p->places[i];
        const scene_marker *marker = &s->markers.items[i];
        if (!at.seen || p->nearest[at.pixel] != at.band + 1)
            continue;
        const pencil with = stroke_make_pencil(s, marker->style, 0);
        const uint32_t width = (uint32_t)s->view.width;
        quads_begin_element(&p->quads, SCENE_MARKER, i);
        stroke_add_marker(&p->quads, &with, (scene_shape)marker->shape,
                          (const double[2]){at.pixel % width, (double)(at.pixel / width)}, at.band);
        p->nearest[at.pixel] = UINT8_MAX; /* marks the sample as painted, so that no further point is painted there */
    }
    return true;
}

/* Set the limits to which quads are clipped: for a close-up, its part of the picture; for any other scene, the square
 * of enclosing_power_of_two(). */
static void set_clip_limits(quad_list *list, const scene *s)
{
    const int square = enclosing_power_of_two(s->view.width, s->view.height);
    const bool is_closeup = s->times > 0;
    list->limits[0] = (is_closeup ? s->view.width : square) * QUAD_SUBPIXELS;
    list->limits[1] = (is_closeup ? s->view.height : square) * QUAD_SUBPIXELS;
}

static bool paint_closeup(painter *p, const scene *s)
{
    const scene closer = project_scene_to_samples(s->closeup);
    const int subpixels = QUAD_SUBPIXELS * closer.view.aa;
    p->closeup = p->closeup ? p->closeup : calloc(1, sizeof *p->closeup);
    if (!p->closeup || !painter_paint_scene(p->closeup, s->closeup))
        return false;
    if (view_paints_points(&s->view))
        splats_copy_closeup(&p->splats, s, &p->closeup->splats, &closer);
    return quads_insert_closeup(&p->quads, &p->closeup->quads,
                                (int32_t[]){closer.place[0] * subpixels, closer.place[1] * subpixels});
}

bool painter_paint_scene(painter *p, const scene *picture)
{
    const scene fine = project_scene_to_samples(picture), *s = &fine;
    p->quads.count = 0;
    p->quads.out_of_memory = false;
    set_clip_limits(&p->quads, s);
    p->overflowed = 0;
    if (!paint_boxes(p, s) ||
        !(view_paints_points(&s->view) ? splats_paint_points(&p->splats, &p->quads, s) : paint_points(p, s)))
        return false;
    paint_segments(p, s, false);
    for (size_t i = 0; i < s->markers.count; i++) {
        quads_begin_element(&p->quads, SCENE_MARKER, i);
        if (!is_point_marker(&s->markers.items[i]))
            paint_marker(p, s, &s->markers.items[i]);
    }
    for (size_t i = 0; i < s->panels.count; i++) {
        quads_begin_element(&p->quads, SCENE_PANEL, i);
        stroke_add_panel(&p->quads, &s->panels.items[i], s->view.aa);
        if (s->panels.items[i].style.role == ROLE_OWN)
            splats_fill_panel(&p->splats, s, &s->panels.items[i]);
    }
    /* segments in picture coordinates cover panels, so these segments are painted after panels */
    paint_segments(p, s, true);
    for (size_t i = 0; i < s->labels.count; i++) {
        quads_begin_element(&p->quads, SCENE_LABEL, i);
        add_label_letters(&p->quads, s, &s->labels.items[i]);
    }
    return !p->quads.out_of_memory && quads_sort(&p->quads) && (!s->has_closeup || paint_closeup(p, s));
}
