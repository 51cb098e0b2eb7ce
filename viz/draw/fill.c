/* SPDX-License-Identifier: MIT */
/* fill.c - the integer rasterizer: fills exactly the pixels of a quad that llvmpipe would fill.
 *
 * GL's rule, which llvmpipe follows to the bit: a pixel is drawn if its centre is inside the shape. A centre on an edge
 * counts as inside if the edge is a left edge or a horizontal top edge. So two shapes with a common edge never draw the
 * same pixel. A quad is drawn as the triangles 0 1 2 and 0 2 3, in either winding. Corners are multiples of 1/256
 * pixel, so that integer arithmetic is exact and comes to the same decisions as GL.
 *
 * Testing every pixel of a quad's bounding box would be slow. Instead, an edge is walked from row to row (or column to
 * column) as Bresenham's algorithm walks a line. The point where the edge crosses a row is stored as a whole pixel and
 * a remainder, and a step to the next row takes two additions. Three shapes make up most of a picture and have faster
 * code, which gives the same pixels: axis-aligned rectangles, strips of constant width (lines), and convex quads. All
 * other quads are split into triangles. */
#include "fill.h"

#include <string.h>

#define CENTRE (QUAD_SUBPIXELS / 2)

/* A part of the picture, and its pixels. */
typedef struct target {
    uint8_t *bytes;
    int width, height;
} target;

/* Returns the first pixel whose centre is at or after a coordinate. The result is clamped to 0..size. */
static int find_first_pixel(int32_t at, int size)
{
    if (at <= CENTRE)
        return 0;
    const int32_t pixel = (at - CENTRE + QUAD_SUBPIXELS - 1) / QUAD_SUBPIXELS;
    return pixel < size ? pixel : size;
}

/* ---- Axis-aligned rectangles -------------------------------------------------------------------------------- */

static bool is_rectangle(const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    return (x[0] == x[3] && x[1] == x[2] && y[0] == y[1] && y[2] == y[3]) ||
           (x[0] == x[1] && x[2] == x[3] && y[1] == y[2] && y[3] == y[0]);
}

static void fill_rectangle(const target *t, const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    const int left = find_first_pixel(x[0] < x[2] ? x[0] : x[2], t->width);
    const int right = find_first_pixel(x[0] < x[2] ? x[2] : x[0], t->width);
    const int top = find_first_pixel(y[0] < y[2] ? y[0] : y[2], t->height);
    const int bottom = find_first_pixel(y[0] < y[2] ? y[2] : y[0], t->height);
    uint8_t *row = t->bytes + (size_t)top * (size_t)t->width + left;
    if (right - left == 1) { /* true of most points of a cloud; a call of memset() would take longer than storing one
                              * pixel */
        for (int i = top; i < bottom; i++, row += t->width)
            *row = q->color;
        return;
    }
    for (int i = top; i < bottom && left < right; i++, row += t->width)
        memset(row, q->color, (size_t)(right - left));
}

/* ---- Edges -------------------------------------------------------------------------------------------------- */

/* An edge that is walked pixel by pixel along one axis. `at` is the first pixel of the current row (or column) whose
 * centre is at or after the point where the edge crosses that row. This centre lies (beyond / whole) pixels after the
 * crossing point. */
typedef struct edge_walk {
    int64_t at, beyond;
    /* the distance between the crossings of two adjacent rows: turn + rest / whole pixels */
    int64_t turn, rest;
    int64_t whole;
} edge_walk;

/* Returns a / b rounded down. *rest becomes the remainder, from 0 to b - 1. b must be positive. */
static int64_t divide_rounding_down(int64_t a, int64_t b, int64_t *rest)
{
    int64_t quotient = a / b;
    *rest = a % b;
    if (*rest < 0) {
        *rest += b;
        quotient--;
    }
    return quotient;
}

/* Begin to walk the edge from (a0, b0) to (a1, b1) along axis a, where a0 < a1. The walk begins at the centre of pixel
 * number `pixel` of axis a. */
static edge_walk begin_edge_walk(int32_t a0, int32_t b0, int32_t a1, int32_t b1, int pixel)
{
    const int64_t length = (int64_t)a1 - a0, rise = (int64_t)b1 - b0;
    const int64_t along = (int64_t)pixel * QUAD_SUBPIXELS + CENTRE - a0;
    edge_walk w = {.whole = QUAD_SUBPIXELS * length};
    w.at = -divide_rounding_down(-((b0 - CENTRE) * length + rise * along), w.whole, &w.beyond);
    w.turn = divide_rounding_down(rise, length, &w.rest);
    w.rest *= QUAD_SUBPIXELS;
    return w;
}

static void advance_edge(edge_walk *w)
{
    w->at += w->turn;
    w->beyond -= w->rest;
    if (w->beyond < 0) {
        w->beyond += w->whole;
        w->at++;
    }
}

/* ---- Strips -------------------------------------------------------------------------------------------------
 *
 * Most lines of stroke.c are strips: parallelograms with two sides that are parallel to an axis and whose length is a
 * whole number of pixels. Every row (or column) then has the same number of pixels, and only one edge needs to be
 * walked. */

/* Returns whether a quad is a strip: its sides 0-3 and 1-2 are parallel to the axis `across` and have the same length,
 * which is a whole number of pixels. */
static bool is_strip(const int32_t along[4], const int32_t across[4])
{
    const int32_t width = across[3] - across[0];
    return along[0] == along[3] && along[1] == along[2] && width == across[2] - across[1] && width > 0 &&
           width % QUAD_SUBPIXELS == 0;
}

/* An axis of the picture: its number of pixels, and the distance in bytes from one pixel to the next. */
typedef struct fill_axis {
    int size;
    ptrdiff_t step;
} fill_axis;

/* A strip that is walked along its long axis. Each step sets `width` pixels on the other axis, `across`. */
typedef struct strip_walk {
    uint8_t *step;  /* address of pixel 0 of the current row (or column) */
    ptrdiff_t next; /* the number of bytes from this row (or column) to the next */
    fill_axis across;
    int steps, width;
    bool lower_is_out; /* true: a pixel whose centre lies on the edge `lower` is outside the strip */
    edge_walk lower;   /* the long edge with the lower coordinates on `across` */
    uint8_t color;
} strip_walk;

static int64_t find_first_strip_pixel(const strip_walk *w)
{
    return w->lower.at + (w->lower_is_out && w->lower.beyond == 0);
}

static void fill_strip_clipped(strip_walk w)
{
    for (; w.steps > 0; w.steps--, w.step += w.next, advance_edge(&w.lower)) {
        const int64_t first = find_first_strip_pixel(&w);
        for (int64_t j = first < 0 ? 0 : first; j < first + w.width && j < w.across.size; j++)
            w.step[j * w.across.step] = w.color;
    }
}

static void fill_strip_unclipped(strip_walk w)
{
    for (; w.steps > 0; w.steps--, w.step += w.next, advance_edge(&w.lower)) {
        uint8_t *pixel = w.step + (ptrdiff_t)find_first_strip_pixel(&w) * w.across.step;
        for (int j = 0; j < w.width; j++, pixel += w.across.step)
            *pixel = w.color;
    }
}

/* Returns whether a strip lies inside the picture on the axis `across`. */
static bool is_strip_inside(const int32_t across[4], int size)
{
    const int64_t end = (int64_t)size * QUAD_SUBPIXELS;
    return across[0] >= 0 && across[1] >= 0 && across[2] <= end && across[3] <= end;
}

/* Fill a strip. `flat` is true if the strip is walked along x. By GL's rule, a pixel centre on the long edge with the
 * lower coordinates is inside the strip. Exception: if a flat strip falls to the right, this edge is neither a left
 * edge nor a horizontal top edge, so a centre on the edge is outside. */
static void fill_strip(const target *t, const quad *q, bool flat)
{
    const int32_t *along = flat ? q->x : q->y, *across = flat ? q->y : q->x;
    const int from = along[0] > along[1], to = 1 - from;
    const fill_axis x = {t->width, 1}, y = {t->height, t->width}, long_axis = flat ? x : y, other = flat ? y : x;
    const int begin = find_first_pixel(along[from], long_axis.size), end = find_first_pixel(along[to], long_axis.size);
    if (begin >= end)
        return;
    const strip_walk w = {.step = t->bytes + begin * long_axis.step,
                          .next = long_axis.step,
                          .across = other,
                          .steps = end - begin,
                          .width = (across[3] - across[0]) / QUAD_SUBPIXELS,
                          .lower_is_out = flat && across[to] > across[from],
                          .lower = begin_edge_walk(along[from], across[from], along[to], across[to], begin),
                          .color = q->color};
    if (is_strip_inside(across, other.size))
        fill_strip_unclipped(w);
    else
        fill_strip_clipped(w);
}

/* ---- Convex quads ------------------------------------------------------------------------------------------- */

/* The left or right side of a quad: a chain of edges, walked from row to row. */
typedef struct side {
    int corner; /* the number of the corner at which the current edge ends */
    int step;   /* 1 or 3: corner (i + step) modulo 4 comes after corner i in the chain */
    int end;    /* the row after the last row of the current edge */
    edge_walk edge;
} side;

/* Begin to walk the next edge of the side that reaches the centres of a row's pixels. */
static void begin_next_edge_of_side(side *s, const quad *q, int row, int height)
{
    int from;
    do {
        from = s->corner;
        s->corner = (from + s->step) & 3;
        s->end = find_first_pixel(q->y[s->corner], height);
    } while (s->end <= row);
    s->edge = begin_edge_walk(q->y[from], q->x[from], q->y[s->corner], q->x[s->corner], row);
}

/* Fill a convex quad. `turn` is the sign of the quad's area: positive if its corners go clockwise on the screen. */
static void fill_convex_quad(const target *t, const quad *q, int turn)
{
    int top = 0, bottom = 0;
    for (int i = 1; i < 4; i++) {
        top = q->y[i] < q->y[top] ? i : top;
        bottom = q->y[i] > q->y[bottom] ? i : bottom;
    }
    const int end = find_first_pixel(q->y[bottom], t->height);
    side left = {.corner = top, .step = turn > 0 ? 3 : 1}, right = {.corner = top, .step = turn > 0 ? 1 : 3};
    for (int row = find_first_pixel(q->y[top], t->height); row < end; row++) {
        if (row >= left.end)
            begin_next_edge_of_side(&left, q, row, t->height);
        if (row >= right.end)
            begin_next_edge_of_side(&right, q, row, t->height);
        const int64_t first = left.edge.at > 0 ? left.edge.at : 0,
                      last = right.edge.at < t->width ? right.edge.at : t->width;
        if (first < last)
            memset(t->bytes + (size_t)row * (size_t)t->width + (size_t)first, q->color, (size_t)(last - first));
        advance_edge(&left.edge);
        advance_edge(&right.edge);
    }
}

/* ---- Any quad ----------------------------------------------------------------------------------------------- */

/* Returns how the path a, b, c turns at corner b: 1 clockwise on the screen, -1 counterclockwise, 0 straight. */
static int find_corner_turn(const quad *q, int a, int b, int c)
{
    const int64_t area = ((int64_t)q->x[b] - q->x[a]) * ((int64_t)q->y[c] - q->y[b]) -
                         ((int64_t)q->y[b] - q->y[a]) * ((int64_t)q->x[c] - q->x[b]);
    return (area > 0) - (area < 0);
}

/* Fill the triangle of the corners 0, b and c, as a quad with a repeated corner. */
static void fill_triangle(const target *t, const quad *q, int b, int c)
{
    const int turn = find_corner_turn(q, 0, b, c);
    quad alone = *q;
    alone.x[1] = q->x[b], alone.y[1] = q->y[b];
    alone.x[2] = alone.x[3] = q->x[c], alone.y[2] = alone.y[3] = q->y[c];
    if (turn)
        fill_convex_quad(t, &alone, turn);
}

static void fill_quad(const target *t, const quad *q)
{
    if (is_rectangle(q)) {
        fill_rectangle(t, q);
        return;
    }
    const bool flat = is_strip(q->x, q->y);
    if (flat || is_strip(q->y, q->x)) {
        fill_strip(t, q, flat);
        return;
    }
    const int turn = find_corner_turn(q, 0, 1, 2);
    if (turn && find_corner_turn(q, 1, 2, 3) == turn && find_corner_turn(q, 2, 3, 0) == turn &&
        find_corner_turn(q, 3, 0, 1) == turn) {
        fill_convex_quad(t, q, turn);
        return;
    }
    fill_triangle(t, q, 1, 2);
    fill_triangle(t, q, 2, 3);
}

void fill_quads(const quad *quads, size_t count, renderer_part part, uint8_t *bytes)
{
    const target t = {bytes, part.width, part.height};
    const int32_t left = part.x * QUAD_SUBPIXELS, top = part.y * QUAD_SUBPIXELS;
    for (size_t i = 0; i < count; i++) {
        quad q = quads[i];
        for (int j = 0; j < 4; j++) {
            q.x[j] -= left;
            q.y[j] -= top;
        }
        fill_quad(&t, &q);
    }
}
