/* SPDX-License-Identifier: MIT */
/* clip.c - clips quads to a rectangle with the algorithm of Sutherland and Hodgman (1974). The quad is treated as a
 * polygon, which is cut at each of the four sides of the rectangle in turn. Each cut walks around the corners, keeps
 * the corners inside, and adds a corner where an edge crosses the side.
 *
 * All coordinates, also of new corners, are multiples of 1/256 pixel. GL would clip too, but in single precision, and
 * the pixels would depend on the CPU. find_crossing() sorts the two ends of an edge before it divides. So two quads
 * that share an edge get the same new corner, even if they list the ends in opposite order, and no gap opens between
 * them.
 *
 * The clipped polygon has up to eight corners. Rasterizers take only quads, so the polygon is split into a fan of quads
 * around its first corner. */
#include "quads.h"

/* A cut that changes a convex polygon removes at least one corner and adds two: 4 corners and 4 cuts give at most 8. */
#define MOST_CORNERS 8

typedef struct polygon {
    int32_t at[MOST_CORNERS][2];
    int count;
} polygon;

int enclosing_power_of_two(int width, int height)
{
    int side = 1;
    while (side < width || side < height)
        side *= 2;
    return side;
}

static void append_corner(polygon *p, int32_t x, int32_t y)
{
    if (p->count < MOST_CORNERS) {
        p->at[p->count][0] = x;
        p->at[p->count][1] = y;
        p->count++;
    }
}

/* Returns where the edge from a to b crosses a bound on `axis`: the coordinate of the crossing on the other axis,
 * rounded. Swapping a and b does not change the result. */
static int32_t find_crossing(const int32_t a[2], const int32_t b[2], int axis, int32_t bound)
{
    const int32_t *low = a[axis] < b[axis] ? a : b, *high = a[axis] < b[axis] ? b : a;
    const int64_t length = (int64_t)high[axis] - low[axis], rise = (int64_t)high[1 - axis] - low[1 - axis];
    const int64_t doubled = 2 * rise * ((int64_t)bound - low[axis]) + length, whole = 2 * length;
    return low[1 - axis] + (int32_t)(doubled / whole - (doubled % whole < 0));
}

/* Remove the part of a polygon whose coordinate on `axis` is less than the bound (side 1) or greater than the bound
 * (side -1). */
static void clip_to_bound(polygon *p, int axis, int side, int32_t bound)
{
    const polygon all = *p;
    p->count = 0;
    for (int i = 0; i < all.count; i++) {
        const int32_t *last = all.at[(i + all.count - 1) % all.count], *corner = all.at[i];
        const bool was_in = side > 0 ? last[axis] >= bound : last[axis] <= bound;
        const bool is_in = side > 0 ? corner[axis] >= bound : corner[axis] <= bound;
        if (was_in != is_in) {
            const int32_t across = find_crossing(last, corner, axis, bound);
            append_corner(p, axis ? across : bound, axis ? bound : across);
        }
        if (is_in)
            append_corner(p, corner[0], corner[1]);
    }
}

/* Split a polygon into quads that share the first corner of the polygon. If the last quad has only three different
 * corners, the last corner is repeated. Returns the number of quads. */
static int split_into_quads(const polygon *p, const quad *whole, quad pieces[CLIP_PIECES])
{
    int count = 0;
    for (int i = 1; i + 1 < p->count; i += 2) {
        const int corners[4] = {0, i, i + 1, i + 2 < p->count ? i + 2 : i + 1};
        quad *piece = &pieces[count++];
        *piece = *whole;
        for (int j = 0; j < 4; j++) {
            piece->x[j] = p->at[corners[j]][0];
            piece->y[j] = p->at[corners[j]][1];
        }
    }
    return count;
}

int clip_quad(const quad *q, const int32_t limits[2], quad pieces[CLIP_PIECES])
{
    polygon p = {.count = 0};
    for (int i = 0; i < 4; i++)
        append_corner(&p, q->x[i], q->y[i]);
    for (int axis = 0; axis < 2; axis++) {
        clip_to_bound(&p, axis, 1, 0);
        clip_to_bound(&p, axis, -1, limits[axis]);
    }
    return split_into_quads(&p, q, pieces);
}
