/* SPDX-License-Identifier: MIT */
#include "clip.h"

/* A side of the square cuts off at least one corner of a convex polygon, and adds two. */
#define MOST_CORNERS 8

typedef struct polygon {
    int32_t at[MOST_CORNERS][2];
    int count;
} polygon;

int clip_square(int width, int height)
{
    int side = 1;
    while (side < width || side < height)
        side *= 2;
    return side;
}

static void add_corner(polygon *p, int32_t x, int32_t y)
{
    if (p->count < MOST_CORNERS) {
        p->at[p->count][0] = x;
        p->at[p->count][1] = y;
        p->count++;
    }
}

/* Where the edge between two corners meets a bound of an axis: the other axis, rounded. The same both ways. */
static int32_t crossing(const int32_t a[2], const int32_t b[2], int axis, int32_t bound)
{
    const int32_t *low = a[axis] < b[axis] ? a : b, *high = a[axis] < b[axis] ? b : a;
    const int64_t length = (int64_t)high[axis] - low[axis], rise = (int64_t)high[1 - axis] - low[1 - axis];
    const int64_t doubled = 2 * rise * ((int64_t)bound - low[axis]) + length, whole = 2 * length;
    return low[1 - axis] + (int32_t)(doubled / whole - (doubled % whole < 0));
}

/* Keep what is at least (side 1) or at most (side -1) a bound on one axis. */
static void keep_side(polygon *p, int axis, int side, int32_t bound)
{
    const polygon all = *p;
    p->count = 0;
    for (int i = 0; i < all.count; i++) {
        const int32_t *last = all.at[(i + all.count - 1) % all.count], *corner = all.at[i];
        const bool was_in = side > 0 ? last[axis] >= bound : last[axis] <= bound;
        const bool is_in = side > 0 ? corner[axis] >= bound : corner[axis] <= bound;
        if (was_in != is_in) {
            const int32_t across = crossing(last, corner, axis, bound);
            add_corner(p, axis ? across : bound, axis ? bound : across);
        }
        if (is_in)
            add_corner(p, corner[0], corner[1]);
    }
}

/* A fan of quads around the first corner; the last of them may be a triangle. */
static int fan(const polygon *p, const quad *of, quad pieces[CLIP_PIECES])
{
    int count = 0;
    for (int i = 1; i + 1 < p->count; i += 2) {
        const int corners[4] = {0, i, i + 1, i + 2 < p->count ? i + 2 : i + 1};
        quad *piece = &pieces[count++];
        *piece = *of;
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
        add_corner(&p, q->x[i], q->y[i]);
    for (int axis = 0; axis < 2; axis++) {
        keep_side(&p, axis, 1, 0);
        keep_side(&p, axis, -1, limits[axis]);
    }
    return fan(&p, q, pieces);
}
