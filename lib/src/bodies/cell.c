/* SPDX-License-Identifier: MIT */
/* cell.c - boxes around the bodies of the eight octants of a cell. */
#include "cell.h"
#include "../query/search.h"

/* Compute the centre and the half extents of one half. Let u = 2^-53. The centre has an error of at most u * |centre|
 * plus 2^-1074, and the sums below of 3u; the bounds cover more than that. */
static void bound_half(cell_halves *h, int axis, unsigned half, double low, double high, double reach)
{
    const double size = fabs(low) + fabs(high);
    const double inner = ((high - low) * 0.5 + size * 0x1p-50) * (1 + 0x1p-50) + 0x1p-1070;
    const bool too_large = !(size + reach < DBL_MAX / 16);
    h->center[axis][half] = low * 0.5 + high * 0.5;
    h->inner[axis][half] = too_large ? HUGE_VAL : inner;
    h->outer[axis][half] = too_large ? HUGE_VAL : (inner + reach) * (1 + 0x1p-50);
}

static void divide_cell(const level *l, cell c, cell_halves *h)
{
    for (int i = 0; i < 3; i++) {
        h->middle[i] = plane_at(&l->tree->axes[i], c.low[i] + cell_size(c.depth) / 2);
        bound_half(h, i, 0, h->low[i], h->middle[i], l->reach[i]);
        bound_half(h, i, 1, h->middle[i], h->high[i], l->reach[i]);
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
