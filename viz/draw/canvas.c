/* SPDX-License-Identifier: MIT */
#include "canvas.h"

#include <stdlib.h>
#include <string.h>

/* One more pass of the rasteriser, with its clear and read, costs about as much as drawing so many quads. */
#define WORTH_A_PASS 256

/* The index that is transparent when a picture is laid over another. */
#define NOTHING 255
_Static_assert(THEME_COLORS <= NOTHING, "an index is left over");

#define CENTRE (QUAD_SUBPIXELS / 2)

/* A frame under way. */
typedef struct drawing {
    canvas *canvas;
    const quad *quads;
    rasteriser *rasterise;
    void *context;
    uint8_t *indices;
    octreel_error *error;
    bool blank; /* nothing has been drawn to `indices` yet */
} drawing;

void canvas_release(canvas *c)
{
    free(c->over);
    free(c->kept);
    quads_release(&c->last);
    memset(c, 0, sizeof *c);
}

static size_t count_pixels(const canvas *c)
{
    return (size_t)c->width * (size_t)c->height;
}

/* ---- Filling -------------------------------------------------------------------------------------------------
 *
 * Corners are whole 1/256 pixels, so that integers decide whether a pixel's centre is in a quad. By GL's rule, which
 * llvmpipe follows, a pixel is drawn if its centre is inside; a centre on an edge is inside if that is a left edge, or
 * a horizontal top edge.
 */

static bool is_rectangle(const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    return (x[0] == x[3] && x[1] == x[2] && y[0] == y[1] && y[2] == y[3]) ||
           (x[0] == x[1] && x[2] == x[3] && y[1] == y[2] && y[3] == y[0]);
}

/* Whether the sides 0-3 and 1-2 are parallel to the axis `across` and of the same whole number of pixels. */
static bool is_strip(const int32_t along[4], const int32_t across[4])
{
    const int32_t width = across[3] - across[0];
    return along[0] == along[3] && along[1] == along[2] && width == across[2] - across[1] && width > 0 &&
           width % QUAD_SUBPIXELS == 0;
}

static bool is_inside(const drawing *d, const quad *q)
{
    const int32_t right = d->canvas->width * QUAD_SUBPIXELS, bottom = d->canvas->height * QUAD_SUBPIXELS;
    bool inside = true;
    for (int i = 0; i < 4; i++)
        inside &= q->x[i] >= 0 && q->y[i] >= 0 && q->x[i] <= right && q->y[i] <= bottom;
    return inside;
}

/* Upright rectangles; and lines as stroke.c makes them: parallelograms with two sides along an axis, a whole number of
 * pixels long. These must lie within the picture, since GL clips others in single precision. */
static bool can_fill(const drawing *d, const quad *q)
{
    return is_rectangle(q) || (is_inside(d, q) && (is_strip(q->x, q->y) || is_strip(q->y, q->x)));
}

/* The first pixel whose centre is at or after a coordinate: 0 to `size`. */
static int first_pixel(int32_t at, int size)
{
    if (at <= CENTRE)
        return 0;
    const int32_t pixel = (at - CENTRE + QUAD_SUBPIXELS - 1) / QUAD_SUBPIXELS;
    return pixel < size ? pixel : size;
}

static void fill_rectangle(const drawing *d, const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    const int width = d->canvas->width, height = d->canvas->height;
    const int left = first_pixel(x[0] < x[2] ? x[0] : x[2], width);
    const int right = first_pixel(x[0] < x[2] ? x[2] : x[0], width);
    const int top = first_pixel(y[0] < y[2] ? y[0] : y[2], height);
    const int bottom = first_pixel(y[0] < y[2] ? y[2] : y[0], height);
    uint8_t *row = d->indices + (size_t)top * (size_t)width + left;
    for (int i = top; i < bottom && left < right; i++, row += width)
        memset(row, q->color, (size_t)(right - left));
}

/* An axis of the picture: its pixels, and the bytes from one to the next. */
typedef struct fill_axis {
    int size;
    ptrdiff_t step;
} fill_axis;

/* Quotient and remainder, rounded down. */
static int64_t divide(int64_t a, int64_t b, int64_t *rest)
{
    int64_t quotient = a / b;
    *rest = a % b;
    if (*rest < 0) {
        *rest += b;
        quotient--;
    }
    return quotient;
}

/* For each step along one axis, fill `width` pixels across. The lower edge runs from (a0, b0) to (a1, b1), a0 < a1; at
 * the centre of step i it is P / Q pixels from the centre of pixel 0 across, with Q = 256 (a1 - a0). */
static void fill_strip(uint8_t *indices, uint8_t color, fill_axis along, fill_axis across, const int32_t a[2],
                       const int32_t b[2], int width, bool lower_is_in)
{
    const int64_t length = a[1] - a[0], rise = b[1] - b[0], whole = QUAD_SUBPIXELS * length;
    const int begin = first_pixel(a[0], along.size), end = first_pixel(a[1], along.size);
    const int64_t centre = (int64_t)begin * QUAD_SUBPIXELS + CENTRE;
    int64_t rest, more;
    int64_t at = divide((b[0] - CENTRE) * length + rise * (centre - a[0]), whole, &rest);
    const int64_t turn = divide(rise * QUAD_SUBPIXELS, whole, &more);
    uint8_t *step = indices + begin * along.step;
    for (int i = begin; i < end; i++, step += along.step) {
        const int64_t first = at + (rest > 0 || !lower_is_in);
        for (int64_t j = first < 0 ? 0 : first; j < first + width && j < across.size; j++)
            step[j * across.step] = color;
        at += turn;
        rest += more;
        if (rest >= whole) {
            rest -= whole;
            at++;
        }
    }
}

/* A left edge includes centres that lie on it; when a flat strip falls to the right its lower edge is not one. */
static void fill_quad(const drawing *d, const quad *q)
{
    const bool flat = is_strip(q->x, q->y);
    if (is_rectangle(q)) {
        fill_rectangle(d, q);
        return;
    }
    const int32_t *along = flat ? q->x : q->y, *across = flat ? q->y : q->x;
    const int first = along[0] > along[1], last = 1 - first;
    const int32_t a[2] = {along[first], along[last]}, b[2] = {across[first], across[last]};
    const fill_axis x = {d->canvas->width, 1}, y = {d->canvas->height, d->canvas->width};
    fill_strip(d->indices, q->color, flat ? x : y, flat ? y : x, a, b, (across[3] - across[0]) / QUAD_SUBPIXELS,
               !flat || b[1] <= b[0]);
}

static void fill_all(drawing *d, size_t start, size_t end)
{
    if (d->blank)
        memset(d->indices, 0, count_pixels(d->canvas));
    d->blank = false;
    for (size_t i = start; i < end; i++)
        fill_quad(d, &d->quads[i]);
}

/* ---- The rasteriser ----------------------------------------------------------------------------------------- */

/* The rows that quads may cover. */
static void find_rows(const drawing *d, size_t start, size_t end, int *first, int *end_row)
{
    int32_t least = INT32_MAX, most = INT32_MIN;
    for (size_t i = start; i < end; i++)
        for (int j = 0; j < 4; j++) {
            const int32_t y = d->quads[i].y[j];
            least = y < least ? y : least;
            most = y > most ? y : most;
        }
    const int height = d->canvas->height, rows = most <= 0 ? 0 : (int)(most / QUAD_SUBPIXELS) + 1;
    *first = least <= 0 ? 0 : (int)(least / QUAD_SUBPIXELS);
    *end_row = rows < height ? rows : height;
}

static bool lay_over(drawing *d, size_t start, size_t end)
{
    canvas *c = d->canvas;
    int first, end_row;
    find_rows(d, start, end, &first, &end_row);
    if (first >= end_row)
        return true;
    c->over = c->over ? c->over : malloc(count_pixels(c));
    if (!c->over)
        return error_no_memory(d->error);
    if (!d->rasterise(d->context, d->quads + start, end - start, NOTHING, first, end_row, c->over, d->error))
        return false;
    const size_t last = (size_t)end_row * (size_t)c->width;
    for (size_t i = (size_t)first * (size_t)c->width; i < last; i++)
        d->indices[i] = c->over[i] == NOTHING ? d->indices[i] : c->over[i];
    return true;
}

static bool rasterise_all(drawing *d, size_t start, size_t end)
{
    if (start == end)
        return true;
    if (!d->blank)
        return lay_over(d, start, end);
    d->blank = false;
    return d->rasterise(d->context, d->quads + start, end - start, 0, 0, d->canvas->height, d->indices, d->error);
}

/* ---- A frame ------------------------------------------------------------------------------------------------ */

/* Fill long runs of rectangles, and those at the end; rasterise the rest. */
static bool draw_span(drawing *d, size_t start, size_t end)
{
    size_t begun = start;
    for (size_t i = start, run; i < end; i = run + 1) {
        for (run = i; run < end && can_fill(d, &d->quads[run]);)
            run++;
        if (run == i || (run < end && run - i < WORTH_A_PASS))
            continue;
        if (!rasterise_all(d, begun, i))
            return false;
        fill_all(d, i, run);
        begun = run;
    }
    return rasterise_all(d, begun, end);
}

static bool same_quad(const quad *a, const quad *b)
{
    return a->color == b->color && a->order == b->order && memcmp(a->x, b->x, sizeof a->x) == 0 &&
           memcmp(a->y, b->y, sizeof a->y) == 0;
}

static size_t count_same(const quad_list *a, const quad_list *b)
{
    size_t same = 0;
    while (same < a->count && same < b->count && same_quad(&a->items[same], &b->items[same]))
        same++;
    return same;
}

/* Whether it pays to keep the picture of the first `same` quads, of which `start` are drawn, and there is memory for
 * it. */
static bool is_worth_keeping(canvas *c, size_t start, size_t same)
{
    if (same - start < WORTH_A_PASS)
        return false;
    c->kept = c->kept ? c->kept : malloc(count_pixels(c));
    return c->kept != NULL;
}

bool canvas_draw(canvas *c, quad_list *quads, rasteriser *rasterise, void *context, uint8_t *indices,
                 octreel_error *error)
{
    drawing d = {c, quads->items, rasterise, context, indices, error, true};
    const size_t same = count_same(&c->last, quads);
    size_t start = c->kept_count <= same ? c->kept_count : 0;
    if (start > 0) {
        memcpy(indices, c->kept, count_pixels(c));
        d.blank = false;
    }
    c->kept_count = start;
    if (is_worth_keeping(c, start, same)) {
        if (!draw_span(&d, start, same))
            return false;
        memcpy(c->kept, indices, count_pixels(c));
        c->kept_count = start = same;
    }
    if (!draw_span(&d, start, quads->count))
        return false;
    if (d.blank)
        memset(indices, 0, count_pixels(c));
    const quad_list last = c->last;
    c->last = *quads;
    *quads = last;
    return true;
}
