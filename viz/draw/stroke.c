/* SPDX-License-Identifier: MIT */
/* stroke.c - turns lines, markers and panels into quads.
 *
 * GL's own lines and points are not used, because versions of Mesa differ in the pixels that such lines and points
 * cover. Here every shape is a quad with corners on a grid of 1/256 sample. For quads, an exact rule decides which
 * pixels they cover (fill.c).
 *
 * A line is drawn as a parallelogram: each end is widened by half the line's width, along the axis on which the line is
 * shorter. A line of one sample's width thus covers exactly one sample in each column (or row), as with Bresenham's
 * algorithm. The rasterizer fills such a strip of constant width faster than any other slanted shape.
 *
 * Bands of depth cut a segment into pieces, which are shaded and ordered separately; dashes continue from piece to
 * piece. A segment shorter than a sample might cover no sample's centre, so it is drawn as a square. */
#include "stroke.h"
#include "layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The length of a dash, and the length of the gap after it, in half picture units. */
#define DASH 6
#define GAP 4

/* The head of an arrow, in half picture units: its length, and its extent to each side of the arrow. */
#define HEAD 8
#define HEAD_SIDE 4

#define RING_CORNERS 40

/* Returns the width of a line in pixels. Bold lines are at least 2 pixels wide, so that they look bold even in the
 * smallest picture. */
static int find_line_width(const scene *s, unsigned wanted)
{
    const int width = (int)wanted * s->unit / 2, least = wanted > 1 ? 2 : 1;
    return width > least ? width : least;
}

pencil stroke_make_pencil(const scene *s, scene_style style, unsigned depth)
{
    const int samples = s->view.aa;
    return (pencil){.style = style,
                    .width = find_line_width(s, style.width) * samples,
                    .unit = s->unit,
                    .samples = samples,
                    .depth = depth};
}

/* Returns the shade of an element at a band of depth. Layers that show the events of a tick fade with distance only a
 * third as much as the tree, because their elements would be hard to see in the farthest shades. */
static unsigned find_shade(const pencil *with, unsigned band)
{
    if (with->style.role == ROLE_BACKGROUND)
        return 0;
    return layer_rows[with->style.layer].fades ? band : band / 3;
}

static quad make_quad(const pencil *with, unsigned band)
{
    return (quad){
        .color = theme_color_index(with->style.role, find_shade(with, band)),
        .order = make_quad_order(with->style.layer, band, with->depth),
    };
}

static int32_t round_to_subpixel(double pixel)
{
    return (int32_t)floor(pixel * QUAD_SUBPIXELS + 0.5);
}

/* Add a line as a parallelogram: each end is widened by half the line's width to both sides, along the axis on which
 * the line is shorter. */
static void add_line(quad_list *list, const pencil *with, unsigned band, const double from[2], const double to[2])
{
    quad q = make_quad(with, band);
    const int32_t x0 = round_to_subpixel(from[0]), y0 = round_to_subpixel(from[1]), x1 = round_to_subpixel(to[0]),
                  y1 = round_to_subpixel(to[1]);
    const bool flat = abs(x1 - x0) >= abs(y1 - y0);
    const int32_t half = with->width * QUAD_SUBPIXELS / 2;
    const int32_t dx = flat ? 0 : half, dy = flat ? half : 0;
    memcpy(q.x, (int32_t[]){x0 - dx, x1 - dx, x1 + dx, x0 + dx}, sizeof q.x);
    memcpy(q.y, (int32_t[]){y0 - dy, y1 - dy, y1 + dy, y0 + dy}, sizeof q.y);
    quads_add_quad(list, &q);
}

/* Returns the coordinate of a pixel's left or top edge. Far outside the picture, the result is clamped to a value that
 * is still outside every picture. */
static int32_t find_pixel_edge(int64_t pixel)
{
    const int64_t most = 2 * VIEW_MAX_SIDE;
    return (int32_t)(pixel < -most ? -most : pixel > most ? most : pixel) * QUAD_SUBPIXELS;
}

/* Add a filled rectangle. The rectangle's position and size are in samples. */
static void add_rectangle(quad_list *list, quad q, int64_t x, int64_t y, int64_t width, int64_t height)
{
    quads_add_rectangle(list, &q, find_pixel_edge(x), find_pixel_edge(y), find_pixel_edge(x + width),
                        find_pixel_edge(y + height));
}

/* Returns whether a segment is shorter than a sample on both axes. As a parallelogram, such a segment might cover no
 * sample's centre. */
static bool is_shorter_than_sample(const piece *pieces, unsigned count)
{
    const piece *first = &pieces[0], *last = &pieces[count - 1];
    return fabs(first->from[0] - last->to[0]) < 1 && fabs(first->from[1] - last->to[1]) < 1;
}

static void add_solid_line(quad_list *list, const pencil *with, const piece *pieces, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        add_line(list, with, pieces[i].band, pieces[i].from, pieces[i].to);
}

/* Add a dashed line. Dashes continue from piece to piece: `phase` is the current position within the pattern of one
 * dash and one gap. */
static void add_dashed_line(quad_list *list, const pencil *with, const piece *pieces, unsigned count)
{
    const double half_unit = with->unit * with->samples / 2.0, dash = DASH * half_unit, period = dash + GAP * half_unit;
    double phase = 0;
    for (unsigned i = 0; i < count; i++) {
        const double dx = pieces[i].to[0] - pieces[i].from[0], dy = pieces[i].to[1] - pieces[i].from[1];
        const double length = sqrt(dx * dx + dy * dy);
        for (double start = -phase; start < length; start += period) {
            const double a = start > 0 ? start : 0, b = start + dash < length ? start + dash : length;
            if (a >= b)
                continue;
            const double from[2] = {pieces[i].from[0] + dx * a / length, pieces[i].from[1] + dy * a / length};
            const double to[2] = {pieces[i].from[0] + dx * b / length, pieces[i].from[1] + dy * b / length};
            add_line(list, with, pieces[i].band, from, to);
        }
        phase = fmod(phase + length, period);
    }
}

/* Add the head of an arrow. The head is at most half as long as the arrow. A head that would be too small to see is
 * left out. */
static void add_arrow_head(quad_list *list, const pencil *with, const piece *first, const piece *last)
{
    const double half_unit = with->unit * with->samples / 2.0;
    const double dx = last->to[0] - first->from[0], dy = last->to[1] - first->from[1];
    const double length = sqrt(dx * dx + dy * dy), most = HEAD * half_unit;
    const double back = length / 2 < most ? length / 2 : most, side = back * HEAD_SIDE / HEAD;
    if (side < with->samples)
        return;
    for (int sign = -1; sign <= 1; sign += 2) {
        const double end[2] = {last->to[0] - (dx * back + dy * side * sign) / length,
                               last->to[1] - (dy * back - dx * side * sign) / length};
        add_line(list, with, last->band, last->to, end);
    }
}

void stroke_add_line(quad_list *list, const pencil *with, const piece *pieces, unsigned count)
{
    if (count == 0)
        return;
    if (is_shorter_than_sample(pieces, count)) {
        const double *at = pieces[0].from;
        const int x = (int)floor(at[0]), y = (int)floor(at[1]);
        add_rectangle(list, make_quad(with, pieces[0].band), x, y, with->width, with->width);
        return;
    }
    pencil under = *with;
    if (with->style.stroke == STROKE_CUT)
        under.style.role = ROLE_BACKGROUND;
    if (with->style.stroke != STROKE_DASHED)
        add_solid_line(list, &under, pieces, count);
    if (with->style.stroke == STROKE_DASHED || with->style.stroke == STROKE_CUT)
        add_dashed_line(list, with, pieces, count);
    if (with->style.stroke == STROKE_ARROW)
        add_arrow_head(list, with, &pieces[0], &pieces[count - 1]);
}

static void add_square_outline(quad_list *list, quad q, int left, int top, int side, int line)
{
    add_rectangle(list, q, left, top, side, line);
    add_rectangle(list, q, left, top + side - line, side, line);
    add_rectangle(list, q, left, top, line, side);
    add_rectangle(list, q, left + side - line, top, line, side);
}

static void add_diamond(quad_list *list, quad q, int left, int top, int side)
{
    const int32_t reach = side * QUAD_SUBPIXELS / 2;
    const int32_t cx = left * QUAD_SUBPIXELS + reach, cy = top * QUAD_SUBPIXELS + reach;
    memcpy(q.x, (int32_t[]){cx - reach, cx, cx + reach, cx}, sizeof q.x);
    memcpy(q.y, (int32_t[]){cy, cy - reach, cy, cy + reach}, sizeof q.y);
    quads_add_quad(list, &q);
}

/* Add the outline of a diamond as four lines. */
static void add_diamond_outline(quad_list *list, const pencil *with, unsigned band, int left, int top, int side)
{
    const double half = (side - with->samples) / 2.0, cx = left + side / 2.0, cy = top + side / 2.0;
    const double corners[5][2] = {{cx - half, cy}, {cx, cy - half}, {cx + half, cy}, {cx, cy + half}, {cx - half, cy}};
    for (int i = 0; i < 4; i++)
        add_line(list, with, band, corners[i], corners[i + 1]);
}

static void add_cross(quad_list *list, const pencil *with, unsigned band, int x, int y, int side)
{
    const double left = x, right = x + side, top = y, bottom = y + side;
    add_line(list, with, band, (double[2]){left, top}, (double[2]){right, bottom});
    add_line(list, with, band, (double[2]){left, bottom}, (double[2]){right, top});
}

/* Add the area between two regular polygons with a common centre. The first corner of the polygons is above the centre
 * if `up` is true, otherwise below the centre. */
static void add_ring(quad_list *list, quad q, const double center[2], int corners, bool up, const double radii[2])
{
    double from[2] = {0, up ? -1 : 1}, to[2];
    for (int i = 1; i <= corners; i++) {
        camera_compute_cosine_sine((double)i / corners, &to[1], &to[0]);
        to[1] = up ? -to[1] : to[1];
        for (int corner = 0; corner < 4; corner++) {
            const double *direction = corner == 0 || corner == 3 ? from : to;
            q.x[corner] = round_to_subpixel(center[0] + direction[0] * radii[corner / 2]);
            q.y[corner] = round_to_subpixel(center[1] + direction[1] * radii[corner / 2]);
        }
        quads_add_quad(list, &q);
        from[0] = to[0];
        from[1] = to[1];
    }
}

/* Add a ring, triangle or wedge that fits into a square. `side` is the side of the square, `corner` its top left
 * corner. */
static void add_polygon(quad_list *list, const pencil *with, quad q, scene_shape shape, const double corner[2],
                        int side)
{
    const double center[2] = {corner[0] + side / 2.0, corner[1] + side / 2.0}, reach = side / 2.0;
    const double line = (shape == SHAPE_RING ? 3 : 4) * with->unit / 2.0 * with->samples;
    const double inner = shape == SHAPE_WEDGE || line > reach ? 0 : reach - line;
    add_ring(list, q, center, shape == SHAPE_RING ? RING_CORNERS : 3, shape != SHAPE_WEDGE, (double[2]){reach, inner});
}

void stroke_add_marker(quad_list *list, const pencil *with, scene_shape shape, const double pixel[2], unsigned band)
{
    const int side = stroke_marker_side(with->style.width, with->unit) * with->samples;
    const int left = (int)floor(pixel[0]) - (side - 1) / 2, top = (int)floor(pixel[1]) - (side - 1) / 2;
    const quad q = make_quad(with, band);
    pencil thin = *with, thick = *with;
    thin.width = (with->unit / 2 > 1 ? with->unit / 2 : 1) * with->samples;
    thick.width = with->unit * with->samples;
    switch (shape) {
    case SHAPE_SQUARE:
        add_rectangle(list, q, left, top, side, side);
        break;
    case SHAPE_DIAMOND:
        add_diamond(list, q, left, top, side);
        break;
    case SHAPE_FRAME:
        add_square_outline(list, q, left, top, side, thin.width);
        break;
    case SHAPE_LOZENGE:
        add_diamond_outline(list, &thin, band, left, top, side);
        break;
    case SHAPE_CROSS:
        add_cross(list, &thick, band, left, top, side);
        break;
    case SHAPE_RING:
    case SHAPE_TRIANGLE:
    case SHAPE_WEDGE:
        add_polygon(list, with, q, shape, (const double[2]){left, top}, side);
        break;
    case SHAPE_COUNT:
        break;
    }
}

void stroke_add_panel(quad_list *list, const scene_panel *panel, int samples)
{
    const quad q = {.color = theme_color_index(panel->style.role, 0), .order = make_text_order(panel->style.layer)};
    add_rectangle(list, q, (int64_t)panel->x * samples, (int64_t)panel->y * samples, (int64_t)panel->width * samples,
                  (int64_t)panel->height * samples);
}
