/* hull.h - the places that a box touches on its way: what doubles can tell of them. Private.
 *
 * The box position +- r goes from a by d. What it touches is a convex body whose faces are those of the box around the
 * whole step, and six more: a face's normal is across two of its edges, and these are the axes and d (a zonotope). On
 * the axes i and j the normal across d is (-d_j, d_i), and p lies between its two faces where
 *
 *     |side(p)| <= r (|d_i| + |d_j|) = R,    side(p) = d_i (p_j - a_j) - d_j (p_i - a_i).
 *
 * Where d_i or d_j is 0 the box around the step says that already.
 *
 * All is first multiplied by a power of two that brings steps, places and the world below 8, without rounding but for
 * less than 2^-1074. Let u = 2^-53 and S = |d_i| far_j + |d_j| far_i + R, where `far` is from a to the farther end of
 * the world. For a point, side is off by at most 5u S (a rounding in d, in p - a, in the product, in the sum, and what
 * they make of each other), and R by at most 4u S. For a cell the planes are taken as evenly spaced: at its lowest
 * corner's keys, side is that of the world's lowest corner (5u S) and two products of a key (each 4u of at most 2S),
 * and four sums of terms of at most 3S in all make 12u S more: 33u S. The planes themselves are off from their ideal
 * places by two ulps of the world's coordinates at most (test_exact_planes), of which four are taken. So a band of
 * 128u S, of those ulps times d, and of 2^-1000 for underflow, on either side of R, has room for all: beyond it is
 * surely outside, and below it surely inside.
 */
#ifndef OCTREE_HULL_H
#define OCTREE_HULL_H

#include "metric.h"
#include "region.h"
#include "sweep.h"

/* Two faces, across the step on two axes. */
typedef struct hull_faces {
    int i, j;
    double step_i, step_j;       /* d */
    double lowest;               /* side of the world's lowest corner */
    double per_key_i, per_key_j; /* what one key more on an axis takes from it, and adds to it */
    double reach, whole;         /* R and the band; R without it, maybe negative */
} hull_faces;

typedef struct hull {
    metric metric; /* from a */
    hull_faces faces[3];
    unsigned face_count; /* 1 for a step in a plane of two axes, else 3 */
} hull;

/* False for a step along an axis, which has no such faces; the hull is then left as it is. */
bool hull_make(hull *h, const octree *tree, const sweep *box);

/* Which octants of a cell may lie between all the faces, and which surely do; `low` are its lowest keys. */
octant_masks hull_octants(const hull *h, const int32_t low[3], unsigned depth);

static inline double hull_side(const hull *h, const hull_faces *f, const double p[3])
{
    const double x = metric_scaled(&h->metric, p[f->i]) - h->metric.scaled[f->i];
    const double y = metric_scaled(&h->metric, p[f->j]) - h->metric.scaled[f->j];
    return f->step_i * y - f->step_j * x;
}

#endif
