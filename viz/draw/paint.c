/* paint.c - see paint.h. */
#include "paint.h"
#include "project.h"
#include "letters.h"
#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void painter_release(painter *p)
{
    quads_release(&p->quads);
    edges_release(&p->edges);
    free(p->nearest);
    memset(p, 0, sizeof *p);
}

static void stroke(painter *p, const scene *s, const piece *pieces, unsigned count, scene_look look, unsigned depth)
{
    static void (*const strokes[])(quad_list *, const pencil *, const piece *,
                                   unsigned) = {[STYLE_SOLID] = stroke_solid,
                                                [STYLE_DASHED] = stroke_dashed,
                                                [STYLE_CUT] = stroke_cut,
                                                [STYLE_ARROW] = stroke_arrow};
    const pencil with = pencil_make(s, look, depth);
    strokes[look.style](&p->quads, &with, pieces, count);
}

static void paint_segment(painter *p, const scene *s, const double from[3], const double to[3], scene_look look,
                          unsigned depth)
{
    piece pieces[QUAD_BANDS];
    bool overflowed;
    const unsigned count = project_segment(s, from, to, pieces, &overflowed);
    p->overflowed += overflowed;
    stroke(p, s, pieces, count, look, depth);
}

static void paint_flat(painter *p, const scene *s, const scene_segment *segment)
{
    piece flat;
    if (project_flat(s, segment->ends[0], segment->ends[1], &flat))
        stroke(p, s, &flat, 1, segment->look, 0);
}

/* Those of the world, or those of the picture. */
static void paint_segments(painter *p, const scene *s, bool in_picture)
{
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *segment = &s->segments.items[i];
        if (segment->in_picture != in_picture)
            continue;
        quads_begin(&p->quads, DRAW_SEGMENT, i);
        if (in_picture)
            paint_flat(p, s, segment);
        else
            paint_segment(p, s, segment->ends[0], segment->ends[1], segment->look, 0);
    }
}

static bool paint_boxes(painter *p, const scene *s)
{
    if (!edges_merge(&p->edges, s))
        return false;
    for (size_t i = 0; i < p->edges.count; i++) {
        const edge *e = &p->edges.items[i];
        quads_begin(&p->quads, DRAW_BOX, i);
        paint_segment(p, s, e->ends[0], e->ends[1], e->look, e->depth);
    }
    return true;
}

size_t paint_edge_count(const painter *p)
{
    return p->edges.count;
}

const edge *paint_edge_at(const painter *p, size_t index)
{
    return &p->edges.items[index];
}

static void paint_marker(painter *p, const scene *s, const scene_marker *marker)
{
    double pixel[2];
    unsigned band;
    if (!project_point(s, marker->at, pixel, &band))
        return;
    const pencil with = pencil_make(s, marker->look, 0);
    stroke_marker(&p->quads, &with, (scene_shape)marker->shape, pixel, band);
}

static bool is_point(const scene_marker *marker)
{
    return marker->look.layer == LAYER_POINTS;
}

bool paint_point_pixel(const scene *s, const scene_marker *marker, size_t *place, unsigned *band)
{
    double pixel[2];
    if (!is_point(marker) || !project_point(s, marker->at, pixel, band))
        return false;
    const double x = floor(pixel[0]), y = floor(pixel[1]);
    if (x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return false;
    *place = (size_t)y * (size_t)s->view.width + (size_t)x;
    return true;
}

/* Points on one pixel are one quad: the nearest band's, which would cover the others. */
static bool paint_points(painter *p, const scene *s)
{
    const size_t pixels = (size_t)s->view.width * (size_t)s->view.height;
    if (p->pixels != pixels) {
        free(p->nearest);
        p->nearest = malloc(pixels);
        p->pixels = p->nearest ? pixels : 0;
    }
    if (!p->nearest)
        return false;
    memset(p->nearest, 0, pixels);
    unsigned band;
    size_t place;
    for (size_t i = 0; i < s->markers.count; i++) {
        if (!paint_point_pixel(s, &s->markers.items[i], &place, &band))
            continue;
        uint8_t *at = &p->nearest[place];
        if (*at == 0 || *at > band + 1)
            *at = (uint8_t)(band + 1);
    }
    for (size_t i = 0; i < s->markers.count; i++) {
        if (!paint_point_pixel(s, &s->markers.items[i], &place, &band) || p->nearest[place] != band + 1)
            continue;
        quads_begin(&p->quads, DRAW_MARKER, i);
        paint_marker(p, s, &s->markers.items[i]);
        p->nearest[place] = UINT8_MAX; /* painted */
    }
    return true;
}

scene paint_samples(const scene *s)
{
    scene fine = *s;
    const int samples = view_samples(&s->view);
    fine.view.width *= samples;
    fine.view.height *= samples;
    fine.camera.zoom *= samples;
    fine.camera.middle[0] *= samples;
    fine.camera.middle[1] *= samples;
    return fine;
}

bool paint(painter *p, const scene *picture)
{
    const scene fine = paint_samples(picture), *s = &fine;
    p->quads.count = 0;
    p->quads.out_of_memory = false;
    p->overflowed = 0;
    if (!paint_boxes(p, s) || !paint_points(p, s))
        return false;
    paint_segments(p, s, false);
    for (size_t i = 0; i < s->markers.count; i++) {
        quads_begin(&p->quads, DRAW_MARKER, i);
        if (!is_point(&s->markers.items[i]))
            paint_marker(p, s, &s->markers.items[i]);
    }
    for (size_t i = 0; i < s->panels.count; i++) {
        quads_begin(&p->quads, DRAW_PANEL, i);
        stroke_panel(&p->quads, &s->panels.items[i], view_samples(&s->view));
    }
    paint_segments(p, s, true); /* on the panels of their layer */
    for (size_t i = 0; i < s->labels.count; i++) {
        quads_begin(&p->quads, DRAW_LABEL, i);
        letters_add(&p->quads, s, &s->labels.items[i]);
    }
    return !p->quads.out_of_memory && quads_sort(&p->quads);
}
