/* hull.c - see hull.h. */
#include "hull.h"
#include "bits.h"

#include <math.h>

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The largest coordinate on an axis. */
static double largest_on(const axis *a)
{
    return larger(fabs(a->min), fabs(a->max));
}

static double scale_for(const octree *tree, const sweep *box)
{
    double largest = box->size;
    for (int i = 0; i < 3; i++)
        largest = larger(larger(largest, largest_on(&tree->axes[i])), larger(fabs(box->from[i]), fabs(box->to[i])));
    int exponent;
    frexp(largest, &exponent);
    return ldexp(1.0, -(exponent < -1000 ? -1000 : exponent > 1021 ? 1021 : exponent));
}

/* The world as seen from where the step begins, on one axis; scaled. */
typedef struct outlook {
    double step, low, high;
    double far;   /* the way to the farther end */
    double doubt; /* how far a plane may be off, at most */
} outlook;

static outlook look_along(const metric *m, const axis *a, double start, double end)
{
    outlook o = {
        .step = end - start, .low = metric_scaled(m, a->min) - start, .high = metric_scaled(m, a->max) - start};
    o.far = larger(fabs(o.low), fabs(o.high));
    o.doubt = metric_scaled(m, largest_on(a)) * 0x1p-50 + m->scale * 0x1p-1000 * 0x1p-72;
    return o;
}

static hull_faces make_faces(const outlook view[3], double size, int i, int j)
{
    const outlook *x = &view[i], *y = &view[j];
    const double level = size * (fabs(x->step) + fabs(y->step));
    const double sum = fabs(x->step) * y->far + fabs(y->step) * x->far + level;
    const double band = sum * 0x1p-46 + (fabs(x->step) * y->doubt + fabs(y->step) * x->doubt) + 0x1p-1000;
    return (hull_faces){
        .i = i,
        .j = j,
        .step_i = x->step,
        .step_j = y->step,
        .lowest = x->step * y->low - y->step * x->low,
        .per_key_i = y->step * (x->high - x->low) / PLANE_GRID,
        .per_key_j = x->step * (y->high - y->low) / PLANE_GRID,
        .reach = level + band,
        .whole = level - band,
    };
}

bool hull_make(hull *h, const octree *tree, const sweep *box)
{
    bool moves[3];
    for (int i = 0; i < 3; i++)
        moves[i] = box->from[i] != box->to[i];
    if (moves[0] + moves[1] + moves[2] < 2)
        return false;
    outlook view[3];
    const double scale = scale_for(tree, box);
    const metric end = metric_make(scale, is_subnormal_world(tree), box->to);
    h->metric = metric_make(scale, is_subnormal_world(tree), box->from);
    for (int i = 0; i < 3; i++)
        view[i] = look_along(&h->metric, &tree->axes[i], h->metric.scaled[i], end.scaled[i]);
    h->face_count = 0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (moves[i] && moves[j])
            h->faces[h->face_count++] = make_faces(view, box->size * scale, i, j);
    }
    return true;
}

octant_masks hull_octants(const hull *h, const int32_t low[3], unsigned depth)
{
    const double half = (double)cell_size(depth) / 2, quarter = half / 2;
    unsigned misses = 0, leaves = 0;
    for (unsigned k = 0; k < h->face_count; k++) {
        const hull_faces *f = &h->faces[k];
        const double middle = f->lowest + (low[f->j] + half) * f->per_key_j - (low[f->i] + half) * f->per_key_i;
        const double x = f->per_key_i * quarter, y = f->per_key_j * quarter, grown = fabs(x) + fabs(y);
        for (int column = 0; column < 4; column++) { /* of two octants */
            const int upper_i = column >> 1, upper_j = column & 1;
            const unsigned octants = octants_beside[f->i][upper_i] & octants_beside[f->j][upper_j];
            const double side = fabs((middle + (upper_j ? y : -y)) - (upper_i ? x : -x));
            misses |= bits_if(side > f->reach + grown, octants);
            leaves |= bits_if(!(side + grown < f->whole), octants);
        }
    }
    return (octant_masks){(uint8_t)~misses, (uint8_t)~leaves};
}
