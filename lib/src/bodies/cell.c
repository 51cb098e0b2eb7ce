/* SPDX-License-Identifier: MIT */
/* cell.c - boxes around the bodies of the eight octants of a cell, in levels whose nodes have no boxes: in sets that
 * show the points of a tree, and in level 0. */
#include "cell.h"
#include "../exact/lanes.h"
#include "../query/search.h"

/* Compute the centres and the half extents of both halves of a cell on one axis. Let u = 2^-53. A centre has an error
 * of at most u * |centre| plus 2^-1074, and the sums below of 3u; the bounds cover more than that. */
static inline void bound_halves(cell_halves *h, int axis, double reach)
{
    const lanes low = lanes_of(h->low[axis], h->middle[axis]), high = lanes_of(h->middle[axis], h->high[axis]);
    const lanes size = lanes_add(lanes_absolute(low), lanes_absolute(high)), one_half = lanes_all(0.5);
    const lanes extent =
        lanes_add(lanes_multiply(lanes_subtract(high, low), one_half), lanes_multiply(size, lanes_all(0x1p-50)));
    const lanes inner = lanes_add(lanes_multiply(extent, lanes_all(1 + 0x1p-50)), lanes_all(0x1p-1070));
    const lanes outer = lanes_multiply(lanes_add(inner, lanes_all(reach)), lanes_all(1 + 0x1p-50));
    const lanes excess = lanes_subtract(lanes_add(size, lanes_all(reach)), lanes_all(DBL_MAX / 16));
    const lanes beyond = lanes_if_positive(excess, HUGE_VAL); /* infinite in worlds near the range of doubles */
    lanes_store(h->center[axis], lanes_add(lanes_multiply(low, one_half), lanes_multiply(high, one_half)));
    lanes_store(h->inner[axis], lanes_larger(inner, beyond));
    lanes_store(h->outer[axis], lanes_larger(outer, beyond));
}

static void divide_cell(const level *l, cell c, cell_halves *h)
{
    for (int i = 0; i < 3; i++) {
        h->middle[i] = plane_at(&l->tree->axes[i], c.low[i] + cell_size(c.depth) / 2);
        bound_halves(h, i, l->reach[i]);
    }
}

void divide_root_cell(const level *l, cell_halves *h)
{
    for (int i = 0; i < 3; i++) {
        h->low[i] = l->tree->axes[i].min;
        h->high[i] = l->tree->axes[i].max;
    }
    divide_cell(l, root_cell(), h);
}

void divide_octant(const level *l, const cell_halves *parent, unsigned octant, cell c, cell_halves *h)
{
    for (int i = 0; i < 3; i++) {
        const unsigned half = half_of_octant(octant, i);
        h->low[i] = half ? parent->middle[i] : parent->low[i];
        h->high[i] = half ? parent->high[i] : parent->middle[i];
    }
    divide_cell(l, c, h);
}
