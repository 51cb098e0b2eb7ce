/* SPDX-License-Identifier: MIT */
/* splats.c - paints points as discs that form surfaces with shading.
 *
 * The problem: a point cloud has no triangles. If points were drawn as single pixels, there would be holes between
 * them, and points behind a wall would be visible through the holes. So each point becomes a disc as wide as the
 * spacing of points, and at each sample the nearest disc wins. A disc gets deeper towards its rim, like a paraboloid
 * seen from its tip. So where discs of the same size overlap at the same depth, each sample goes to the point whose
 * centre is nearest. This is a Voronoi diagram, which Hoff et al. (1999) draw with cones.
 *
 * Shading is computed from depth alone: eye-dome lighting (Boucheny 2009) darkens a sample that lies deeper than the
 * samples around it. The differences of depth to two opposite neighbours are added first: on a tilted plane the two
 * differences cancel, and the plane is lit evenly.
 *
 * Depths are integers, 8 units to a sample. Everything after projection is exact, so every machine gives the same
 * result, also for ties. Under perspective, the depth is the logarithm of the distance, so that a slope looks the same
 * near and far. */
#include "splats.h"
#include "array.h"
#include "layer.h"
#include "point_scale.h"
#include "project.h"
#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Position and size --------------------------------------------------------------------------------------- */

/* The values that all points of a scene share. */
typedef struct splatter {
    const scene *scene;
    double spacing; /* the diameter of a disc in samples; under perspective, the diameter of a disc at distance 1 */
    int most;       /* the largest diameter of a disc, in samples */
} splatter;

/* Returns log2 of a positive number, computed from the number's exponent and a polynomial. Unlike log2() of libm, the
 * result is the same on every machine. The error is at most 2e-5, and the function is increasing. */
static double approximate_log2(double x)
{
    int exponent;
    const double m = frexp(x, &exponent), t = (m - 0.70710678118654752) / (m + 0.70710678118654752), t2 = t * t;
    return exponent - 0.5 + t * (2.885390081777927 + t2 * (0.9617966939259757 + t2 * 0.5770780163555854));
}

#define LN_2 0.69314718055994531

static splatter make_splatter(const scene *s)
{
    return (splatter){.scene = s,
                      .spacing = point_scale_length_in_pixels(&s->camera, s->spacing) * POINT_OVERLAP,
                      .most = POINT_WIDEST * s->unit * s->view.aa};
}

/* Returns a view depth in integer units. Under perspective the result is the logarithm of the depth, because an object
 * at twice the distance appears half as large. */
static int32_t depth_in_units(const splatter *with, double depth)
{
    const camera *c = &with->scene->camera;
    const double rest = c->perspective ? approximate_log2(depth) * LN_2 : depth - c->near_depth;
    const double samples = floor(rest * c->zoom * DEPTH_PARTS);
    return samples > MOST_DEPTH ? MOST_DEPTH : samples < -MOST_DEPTH ? -MOST_DEPTH : (int32_t)samples;
}

/* Returns the diameter of a point's disc in samples. The diameter is at least the side of a marker. */
static int disc_diameter(const splatter *with, scene_style style, double depth)
{
    const scene *s = with->scene;
    const int least = stroke_marker_side(style.width, s->unit) * s->view.aa;
    const double side = ceil(s->camera.perspective ? with->spacing / depth : with->spacing);
    return side > with->most ? with->most : side > least ? (int)side : least;
}

static bool find_disc_square(const splatter *with, const scene_marker *marker, splat_square *square, double *depth)
{
    double pixel[2];
    if (marker->style.layer != LAYER_POINTS || !find_pixel_and_depth(with->scene, marker->at, pixel, depth))
        return false;
    square->side = disc_diameter(with, marker->style, *depth);
    square->left = (int)floor(pixel[0]) - (square->side - 1) / 2;
    square->top = (int)floor(pixel[1]) - (square->side - 1) / 2;
    return true;
}

/* ---- The nearest point --------------------------------------------------------------------------------------- */

/* Returns the counter of the pixel that contains the centre of a disc. Returns null if the centre is outside the
 * picture, or if points are not counted. */
static uint32_t *find_density_counter(const splats *t, const scene *s, const splat_square *q)
{
    const int samples = s->view.aa, half = (q->side - 1) / 2;
    const int x = q->left + half, y = q->top + half;
    if (s->view.point_color != POINTS_BY_DENSITY || x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return NULL;
    return &t->shared[(size_t)(y / samples) * (size_t)(s->view.width / samples) + (size_t)(x / samples)];
}

static bool draw_discs(splats *t, const splatter *with)
{
    const scene *s = with->scene;
    for (size_t i = 0; i < s->markers.count; i++) {
        splat_square square;
        double depth;
        if (!find_disc_square(with, &s->markers.items[i], &square, &depth))
            continue;
        if (!splat_buffer_draw_disc(&t->nearest, s, i, &square, depth_in_units(with, depth)))
            return false;
        uint32_t *shared = find_density_counter(t, s, &square);
        if (shared)
            ++*shared;
    }
    return true;
}

/* ---- Colours ------------------------------------------------------------------------------------------------- */

/* Returns the colour for a number of points in a pixel. The ramp has one step for each doubling of the number; colours
 * in between are interpolated. */
static theme_color density_color(uint32_t count)
{
    unsigned whole = 0;
    double doublings = 0;
    while (UINT32_C(1) << whole < THEME_MOST_DENSITY && count >> (whole + 1))
        whole++;
    for (unsigned most = THEME_MOST_DENSITY; most > 1; most >>= 1)
        doublings++;
    const double rest = (double)count / (double)(UINT64_C(1) << whole) - 1;
    return theme_ramp_color((whole + rest) / doublings);
}

static theme_color marker_color(const splats *t, const scene *s, const splatter *with, uint32_t index)
{
    const scene_marker *marker = &s->markers.items[index];
    const bool counted = s->view.point_color == POINTS_BY_DENSITY, banded = s->view.shade == SHADE_BANDS;
    theme_color color = marker->color;
    splat_square square;
    double depth;
    if (!(counted || banded) || !find_disc_square(with, marker, &square, &depth))
        return color;
    if (counted) {
        const uint32_t *shared = find_density_counter(t, s, &square);
        color = density_color(shared ? *shared : 1);
    }
    return banded ? theme_shade_color(color, find_depth_band(&s->camera, depth)) : color;
}

static void add_run_quad(quad_list *quads, uint32_t index, int left, int right, int y)
{
    quad q = {.color = THEME_OWN, .order = make_quad_order(LAYER_POINTS, 0, 0)};
    quads_begin_element(quads, SCENE_MARKER, index);
    quads_add_rectangle(quads, &q, left * QUAD_SUBPIXELS, y * QUAD_SUBPIXELS, right * QUAD_SUBPIXELS,
                        (y + 1) * QUAD_SUBPIXELS);
}

/* Set the colours of a run of samples that show the same point. */
static void set_run_colors(splats *t, const splatter *with, uint32_t index, int x, int end, int y)
{
    const scene *s = with->scene;
    theme_color *row = t->colors + (size_t)y * (size_t)s->view.width;
    const theme_color color = marker_color(t, s, with, index);
    for (; x < end; x++)
        row[x] = s->view.shade == SHADE_EDL ? theme_fade_color(color, t->light[x]) : color;
}

/* Add the quads of row y: one quad for each run of samples that show the same point. */
static void paint_row(splats *t, quad_list *quads, const splatter *with, int y)
{
    const int width = with->scene->view.width;
    const uint32_t *owners = splat_buffer_row_owners(&t->nearest, y);
    if (with->scene->view.shade == SHADE_EDL)
        splat_buffer_find_light(&t->nearest, with->scene, y, t->light);
    for (int x = 0, end; x < width; x = end) {
        for (end = x + 1; end < width && owners[end] == owners[x];)
            end++;
        if (owners[x] == 0)
            continue;
        set_run_colors(t, with, owners[x] - 1, x, end, y);
        add_run_quad(quads, owners[x] - 1, x, end, y);
    }
}

/* ---- A scene -------------------------------------------------------------------------------------------------- */

void splats_release(splats *t)
{
    splat_buffer_release(&t->nearest);
    free(t->light);
    free(t->shared);
    free(t->colors);
    *t = (splats){0};
}

static bool reserve_samples(splats *t, const scene *s)
{
    const size_t size = (size_t)s->view.width * (size_t)s->view.height, side = (size_t)s->view.aa;
    const size_t pixels = s->view.point_color == POINTS_BY_DENSITY ? size / side / side : 0;
    if (!splat_buffer_clear(&t->nearest, s) ||
        !array_grow(&t->light, 2 * (size_t)s->view.width, &t->light_room, sizeof *t->light) ||
        !array_grow(&t->colors, size, &t->color_room, sizeof *t->colors) ||
        !array_grow(&t->shared, pixels, &t->shared_room, sizeof *t->shared))
        return false;
    if (pixels > 0)
        memset(t->shared, 0, pixels * sizeof *t->shared);
    return true;
}

bool splats_paint_points(splats *t, quad_list *quads, const scene *s)
{
    const splatter with = make_splatter(s);
    if (!reserve_samples(t, s) || !draw_discs(t, &with))
        return false;
    for (int y = 0; y < s->view.height; y++)
        paint_row(t, quads, &with, y);
    return true;
}

void splats_fill_panel(splats *t, const scene *s, const scene_panel *panel)
{
    const int samples = s->view.aa;
    for (int y = panel->y * samples; y < (panel->y + panel->height) * samples && y < s->view.height; y++)
        for (int x = panel->x * samples; x < (panel->x + panel->width) * samples && x < s->view.width; x++)
            if (x >= 0 && y >= 0)
                t->colors[(size_t)y * (size_t)s->view.width + (size_t)x] = panel->color;
}

void splats_copy_closeup(splats *t, const scene *s, const splats *closeup, const scene *closer)
{
    const size_t side = (size_t)s->view.aa, width = (size_t)s->view.width;
    const size_t row = (size_t)closer->view.width, left = (size_t)closer->place[0] * side,
                 top = (size_t)closer->place[1] * side;
    for (size_t y = 0; y < (size_t)closer->view.height; y++)
        memcpy(t->colors + (top + y) * width + left, closeup->colors + y * row, row * sizeof *t->colors);
}

/* ---- Hidden points -------------------------------------------------------------------------------------------- */

/* Find the least depth of a disc in a square of samples. Returns false if the disc covers none of these samples. */
static bool find_least_depth(const splat_square *q, int32_t depth, const splat_square *samples, int32_t *least)
{
    bool any = false;
    for (int i = 0; i < samples->side * samples->side; i++) {
        const int x = samples->left + i % samples->side, y = samples->top + i / samples->side;
        int32_t at;
        if (x < q->left || y < q->top || x >= q->left + q->side || y >= q->top + q->side ||
            !find_disc_depth(q, x, y, depth, &at))
            continue;
        *least = any && *least < at ? *least : at;
        any = true;
    }
    return any;
}

static int compare_by_depth(const void *a, const void *b)
{
    const splat_covering *p = a, *q = b;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    if (p->view_depth != q->view_depth)
        return p->view_depth < q->view_depth ? -1 : 1;
    return (p->id > q->id) - (p->id < q->id);
}

bool splats_list_covering_points(const scene *s, const splat_square *samples, splat_list *list)
{
    const splatter with = make_splatter(s);
    for (size_t i = 0; i < s->markers.count; i++) {
        splat_square square;
        splat_covering one = {.marker = i, .id = s->markers.items[i].id};
        if (!find_disc_square(&with, &s->markers.items[i], &square, &one.view_depth) ||
            !find_least_depth(&square, depth_in_units(&with, one.view_depth), samples, &one.depth))
            continue;
        if (!ARRAY_GROW(list, 1))
            return false;
        list->items[list->count++] = one;
    }
    if (list->count)
        qsort(list->items, list->count, sizeof *list->items, compare_by_depth);
    return true;
}
