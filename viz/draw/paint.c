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
    static void (*const strokes[])(quad_list *, const pencil *, const piece *, unsigned) = {
        [STYLE_SOLID] = stroke_solid, [STYLE_DASHED] = stroke_dashed, [STYLE_CUT] = stroke_cut};
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

static bool paint_boxes(painter *p, const scene *s)
{
    if (!edges_merge(&p->edges, s))
        return false;
    for (size_t i = 0; i < p->edges.count; i++) {
        const edge *e = &p->edges.items[i];
        paint_segment(p, s, e->ends[0], e->ends[1], e->look, e->depth);
    }
    return true;
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

/* The byte of the pixel that a point lies on, or null when it is outside the picture. */
static uint8_t *pixel_of(painter *p, const scene *s, const scene_marker *marker, unsigned *band)
{
    double pixel[2];
    if (!project_point(s, marker->at, pixel, band))
        return NULL;
    const double x = floor(pixel[0]), y = floor(pixel[1]);
    if (x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return NULL;
    return &p->nearest[(size_t)y * (size_t)s->view.width + (size_t)x];
}

static bool is_point(const scene_marker *marker)
{
    return marker->look.layer == LAYER_POINTS;
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
    for (size_t i = 0; i < s->markers.count; i++) {
        uint8_t *at = is_point(&s->markers.items[i]) ? pixel_of(p, s, &s->markers.items[i], &band) : NULL;
        if (at && (*at == 0 || *at > band + 1))
            *at = (uint8_t)(band + 1);
    }
    for (size_t i = 0; i < s->markers.count; i++) {
        uint8_t *at = is_point(&s->markers.items[i]) ? pixel_of(p, s, &s->markers.items[i], &band) : NULL;
        if (!at || *at != band + 1)
            continue;
        paint_marker(p, s, &s->markers.items[i]);
        *at = UINT8_MAX; /* painted */
    }
    return true;
}

/* The scene as its samples see it: a picture that is larger, through a camera that enlarges. Its elements are shared.
 */
static scene in_samples(const scene *s)
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
    const scene fine = in_samples(picture), *s = &fine;
    p->quads.count = 0;
    p->quads.out_of_memory = false;
    p->overflowed = 0;
    if (!paint_boxes(p, s) || !paint_points(p, s))
        return false;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *segment = &s->segments.items[i];
        if (!segment->in_picture)
            paint_segment(p, s, segment->ends[0], segment->ends[1], segment->look, 0);
    }
    for (size_t i = 0; i < s->markers.count; i++)
        if (!is_point(&s->markers.items[i]))
            paint_marker(p, s, &s->markers.items[i]);
    for (size_t i = 0; i < s->panels.count; i++)
        stroke_panel(&p->quads, &s->panels.items[i], view_samples(&s->view));
    for (size_t i = 0; i < s->segments.count; i++) /* on the panels of their layer */
        if (s->segments.items[i].in_picture)
            paint_flat(p, s, &s->segments.items[i]);
    for (size_t i = 0; i < s->labels.count; i++)
        letters_add(&p->quads, s, &s->labels.items[i]);
    return !p->quads.out_of_memory && quads_sort(&p->quads);
}
