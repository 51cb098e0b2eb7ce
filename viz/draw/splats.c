/* SPDX-License-Identifier: MIT */
#include "splats.h"
#include "array.h"
#include "layer.h"
#include "point_scale.h"
#include "project.h"
#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Where and how large ------------------------------------------------------------------------------------- */

/* Depths are kept in so many parts of a sample, so that differences of depth are slopes, whatever the scale of the
 * world, the camera and the picture. */
#define DEPTH_PARTS 8
#define MOST_DEPTH (1 << 29)

/* What is nearest at a sample. */
typedef struct splat {
    int32_t depth;
    uint32_t owner; /* 1 + the index of its marker; 0: there is no point */
} splat;

/* What is the same for all points of a scene. */
typedef struct splatter {
    const scene *scene;
    double spacing; /* between points, in samples; under perspective, at distance 1 */
    int most;       /* the longest side, in samples */
} splatter;

/* log2 of a number above 0, from its exponent and a polynomial: the same on every machine, unlike libm's. It is within
 * 2e-5, and it grows with x. */
static double log2_of(double x)
{
    int exponent;
    const double m = frexp(x, &exponent), t = (m - 0.70710678118654752) / (m + 0.70710678118654752), t2 = t * t;
    return exponent - 0.5 + t * (2.885390081777927 + t2 * (0.9617966939259757 + t2 * 0.5770780163555854));
}

#define LN_2 0.69314718055994531

static splatter splatter_make(const scene *s)
{
    return (splatter){.scene = s,
                      .spacing = point_scale_pixels(&s->camera, s->spacing) * POINT_OVERLAP,
                      .most = POINT_WIDEST * s->unit * view_samples(&s->view)};
}

/* Under perspective differences of logarithms, since what is twice as far appears half as large. */
static int32_t depth_of(const splatter *with, double depth)
{
    const camera *c = &with->scene->camera;
    const double rest = c->perspective ? log2_of(depth) * LN_2 : depth - c->near_depth;
    const double samples = floor(rest * c->zoom * DEPTH_PARTS);
    return samples > MOST_DEPTH ? MOST_DEPTH : samples < -MOST_DEPTH ? -MOST_DEPTH : (int32_t)samples;
}

/* At least as large as a mark. */
static int side_of(const splatter *with, scene_style style, double depth)
{
    const scene *s = with->scene;
    const int least = stroke_marker_side(style.width, s->unit) * view_samples(&s->view);
    const double side = ceil(s->camera.perspective ? with->spacing / depth : with->spacing);
    return side > with->most ? with->most : side > least ? (int)side : least;
}

static bool place(const splatter *with, const scene_marker *marker, splat_square *square, double *depth)
{
    double pixel[2];
    if (marker->style.layer != LAYER_POINTS || !project_place(with->scene, marker->at, pixel, depth))
        return false;
    square->side = side_of(with, marker->style, *depth);
    square->left = (int)floor(pixel[0]) - (square->side - 1) / 2;
    square->top = (int)floor(pixel[1]) - (square->side - 1) / 2;
    return true;
}

/* ---- What is nearest ----------------------------------------------------------------------------------------- */

/* Of two points at the same depth in parts of a sample. */
static bool is_nearer(const scene *s, size_t a, size_t b)
{
    double seen[2][3];
    camera_transform(&s->camera, s->markers.items[a].at, seen[0]);
    camera_transform(&s->camera, s->markers.items[b].at, seen[1]);
    if (seen[0][2] != seen[1][2])
        return seen[0][2] < seen[1][2];
    return s->markers.items[a].id < s->markers.items[b].id;
}

/* The samples of a disc, from its middle in half samples. */
static bool is_in_disc(int side, int far)
{
    return side <= 2 || far <= side * side;
}

/* A disc lies the deeper the farther from its middle: of discs that overlap each has what is nearest to it. False
 * beyond its rim; `depth` is that of its middle. */
static bool disc_depth(const splat_square *q, int x, int y, int32_t depth, int32_t *at)
{
    const int dx = 2 * (x - q->left) - q->side + 1, dy = 2 * (y - q->top) - q->side + 1, far = dx * dx + dy * dy;
    *at = depth + far / (4 * q->side);
    return is_in_disc(q->side, far);
}

static void put(splats *t, const scene *s, size_t index, const splat_square *q, int32_t depth)
{
    const int right = q->left + q->side, bottom = q->top + q->side;
    const int left = q->left > 0 ? q->left : 0, end = right < s->view.width ? right : s->view.width;
    for (int y = q->top > 0 ? q->top : 0; y < bottom && y < s->view.height; y++) {
        splat *row = t->samples + (size_t)y * (size_t)s->view.width;
        for (int x = left; x < end; x++) {
            const splat now = row[x];
            int32_t at;
            if (disc_depth(q, x, y, depth, &at) &&
                (now.owner == 0 || at < now.depth || (at == now.depth && is_nearer(s, index, now.owner - 1))))
                row[x] = (splat){at, (uint32_t)index + 1};
        }
    }
}

/* The middle of a square, if it is in the picture: its pixel. */
static uint32_t *shared_at(const splats *t, const scene *s, const splat_square *q)
{
    const int samples = view_samples(&s->view), half = (q->side - 1) / 2;
    const int x = q->left + half, y = q->top + half;
    if (!t->shared || x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return NULL;
    return &t->shared[(size_t)(y / samples) * (size_t)(s->view.width / samples) + (size_t)(x / samples)];
}

static void put_all(splats *t, const splatter *with)
{
    const scene *s = with->scene;
    for (size_t i = 0; i < s->markers.count; i++) {
        splat_square square;
        double depth;
        if (!place(with, &s->markers.items[i], &square, &depth))
            continue;
        put(t, s, i, &square, depth_of(with, depth));
        uint32_t *shared = shared_at(t, s, &square);
        if (shared)
            ++*shared;
    }
}

/* ---- Light --------------------------------------------------------------------------------------------------- */

/* Half the light is left where the slopes sum up to this, in parts of a sample to a sample. */
#define HALF_LIGHT 160

/* A slope counts up to this: beyond it is another thing. */
#define STEEPEST (4 * DEPTH_PARTS)

#define NO_POINT INT32_MIN

/* How much nearer the point at a sample is. */
static int32_t nearer_by(const splats *t, const scene *s, int x, int y, int32_t depth)
{
    if (x < 0 || y < 0 || x >= s->view.width || y >= s->view.height)
        return NO_POINT;
    const splat *n = &t->samples[(size_t)y * (size_t)s->view.width + (size_t)x];
    return n->owner ? depth - n->depth : NO_POINT;
}

static int32_t limit(int32_t value, int32_t most)
{
    return value == NO_POINT ? 0 : value > most ? most : value < -most ? -most : value;
}

/* How deep a sample lies below those around it, so far from it. Opposite ones are taken together, so that a plane is
 * lit evenly, however steep it is seen. */
static int32_t sunken(const splats *t, const scene *s, int x, int y, int reach)
{
    static const int8_t around[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    const int32_t depth = t->samples[(size_t)y * (size_t)s->view.width + (size_t)x].depth, most = STEEPEST * reach;
    int32_t sum = 0;
    for (int i = 0; i < 4; i++) {
        const int dx = around[i][0] * reach, dy = around[i][1] * reach;
        const int32_t both =
            limit(nearer_by(t, s, x + dx, y + dy, depth), most) + limit(nearer_by(t, s, x - dx, y - dy, depth), most);
        sum += both > 0 ? both : 0;
    }
    return sum / reach;
}

/* Eye-dome lighting (Boucheny 2009) at two distances, for fine and for large forms: 256ths of the full colour. */
static int light_at(const splats *t, const scene *s, int x, int y)
{
    const int reach = s->unit * view_samples(&s->view);
    return 256 * HALF_LIGHT / (HALF_LIGHT + sunken(t, s, x, y, reach) + sunken(t, s, x, y, 4 * reach));
}

/* ---- Colours ------------------------------------------------------------------------------------------------- */

/* The same step for each doubling, from one point of a pixel on. */
static theme_color color_of_density(uint32_t count)
{
    unsigned whole = 0;
    double doublings = 0;
    while (UINT32_C(1) << whole < THEME_MOST_DENSITY && count >> (whole + 1))
        whole++;
    for (unsigned most = THEME_MOST_DENSITY; most > 1; most >>= 1)
        doublings++;
    const double rest = (double)count / (double)(UINT64_C(1) << whole) - 1;
    return theme_ramp((whole + rest) / doublings);
}

static theme_color color_of(const splats *t, const scene *s, const splatter *with, uint32_t index)
{
    const scene_marker *marker = &s->markers.items[index];
    const bool counted = s->view.point_color == POINTS_BY_DENSITY, banded = s->view.shade == SHADE_BANDS;
    theme_color color = marker->color;
    splat_square square;
    double depth;
    if (!(counted || banded) || !place(with, marker, &square, &depth))
        return color;
    if (counted) {
        const uint32_t *shared = shared_at(t, s, &square);
        color = color_of_density(shared ? *shared : 1);
    }
    return banded ? theme_shade(color, project_band(&s->camera, depth)) : color;
}

static void set_color(uint8_t *at, theme_color color)
{
    at[0] = color.r;
    at[1] = color.g;
    at[2] = color.b;
}

static void add_run(quad_list *quads, uint32_t index, int left, int right, int y)
{
    quad q = {.color = THEME_OWN, .order = quad_order(LAYER_POINTS, 0, 0)};
    for (int i = 0; i < 4; i++) {
        q.x[i] = (i == 1 || i == 2 ? right : left) * QUAD_SUBPIXELS;
        q.y[i] = (i < 2 ? y : y + 1) * QUAD_SUBPIXELS;
    }
    quads_begin(quads, SCENE_MARKER, index);
    quads_add(quads, &q);
}

static void color_run(splats *t, const splatter *with, int x, int end, int y)
{
    const scene *s = with->scene;
    const size_t row = (size_t)y * (size_t)s->view.width;
    const theme_color color = color_of(t, s, with, t->samples[row + (size_t)x].owner - 1);
    for (; x < end; x++)
        set_color(t->colors + 3 * (row + (size_t)x),
                  s->view.shade == SHADE_EDL ? theme_fade(color, light_at(t, s, x, y)) : color);
}

/* A run of samples with one owner is one quad. */
static void paint_row(splats *t, quad_list *quads, const splatter *with, int y)
{
    const int width = with->scene->view.width;
    const splat *row = t->samples + (size_t)y * (size_t)width;
    for (int x = 0, end; x < width; x = end) {
        for (end = x + 1; end < width && row[end].owner == row[x].owner;)
            end++;
        if (row[x].owner == 0)
            continue;
        color_run(t, with, x, end, y);
        add_run(quads, row[x].owner - 1, x, end, y);
    }
}

/* ---- All ------------------------------------------------------------------------------------------------------ */

void splats_release(splats *t)
{
    free(t->samples);
    free(t->shared);
    free(t->colors);
    *t = (splats){0};
}

static bool make_room(splats *t, const scene *s)
{
    const size_t size = (size_t)s->view.width * (size_t)s->view.height;
    const size_t side = (size_t)view_samples(&s->view), pixels = size / side / side;
    const bool counts = s->view.point_color == POINTS_BY_DENSITY;
    if (t->room != size || (counts && !t->shared)) {
        splats_release(t);
        t->samples = malloc(size * sizeof *t->samples);
        t->colors = malloc(3 * size);
        t->shared = counts ? malloc(pixels * sizeof *t->shared) : NULL;
        t->room = size;
    }
    if (!t->samples || !t->colors || (counts && !t->shared)) {
        splats_release(t);
        return false;
    }
    memset(t->samples, 0, size * sizeof *t->samples);
    if (counts)
        memset(t->shared, 0, pixels * sizeof *t->shared);
    return true;
}

bool splats_paint(splats *t, quad_list *quads, const scene *s)
{
    const splatter with = splatter_make(s);
    if (!make_room(t, s))
        return false;
    put_all(t, &with);
    for (int y = 0; y < s->view.height; y++)
        paint_row(t, quads, &with, y);
    return true;
}

void splats_fill(splats *t, const scene *s, const scene_panel *panel)
{
    const int samples = view_samples(&s->view);
    for (int y = panel->y * samples; y < (panel->y + panel->height) * samples && y < s->view.height; y++)
        for (int x = panel->x * samples; x < (panel->x + panel->width) * samples && x < s->view.width; x++)
            if (x >= 0 && y >= 0)
                set_color(t->colors + ((size_t)y * (size_t)s->view.width + (size_t)x) * 3, panel->color);
}

void splats_put_closeup(splats *t, const scene *s, const splats *closeup, const scene *closer)
{
    const size_t side = (size_t)view_samples(&s->view), width = (size_t)s->view.width;
    const size_t row = (size_t)closer->view.width, left = (size_t)closer->place[0] * side,
                 top = (size_t)closer->place[1] * side;
    for (size_t y = 0; y < (size_t)closer->view.height; y++)
        memcpy(t->colors + 3 * ((top + y) * width + left), closeup->colors + 3 * y * row, 3 * row);
}

/* ---- What others hide ---------------------------------------------------------------------------------------- */

/* The least depth of a disc in a square of samples; false where it covers none. */
static bool covers(const splat_square *q, int32_t depth, const splat_square *samples, int32_t *least)
{
    bool any = false;
    for (int i = 0; i < samples->side * samples->side; i++) {
        const int x = samples->left + i % samples->side, y = samples->top + i / samples->side;
        int32_t at;
        if (x < q->left || y < q->top || x >= q->left + q->side || y >= q->top + q->side ||
            !disc_depth(q, x, y, depth, &at))
            continue;
        *least = any && *least < at ? *least : at;
        any = true;
    }
    return any;
}

static int compare_covering(const void *a, const void *b)
{
    const splat_covering *p = a, *q = b;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    if (p->view_depth != q->view_depth)
        return p->view_depth < q->view_depth ? -1 : 1;
    return (p->id > q->id) - (p->id < q->id);
}

bool splats_list(const scene *s, const splat_square *samples, splat_list *list)
{
    const splatter with = splatter_make(s);
    for (size_t i = 0; i < s->markers.count; i++) {
        splat_square square;
        splat_covering one = {.marker = i, .id = s->markers.items[i].id};
        if (!place(&with, &s->markers.items[i], &square, &one.view_depth) ||
            !covers(&square, depth_of(&with, one.view_depth), samples, &one.depth))
            continue;
        splat_covering *items = array_reserve(list->items, list->count + 1, &list->room, sizeof *items);
        if (!items)
            return false;
        list->items = items;
        items[list->count++] = one;
    }
    if (list->count)
        qsort(list->items, list->count, sizeof *list->items, compare_covering);
    return true;
}
