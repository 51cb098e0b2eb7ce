/* SPDX-License-Identifier: MIT */
/* swept.c - the points that a box touches on its way from one position to another: octree_collide_swept().
 *
 * Problem: the swept volume of a diagonal step is a small part of the box around the step, so testing that box alone
 * visits far too many nodes. The exact test of one point (sweep.h) is too slow for every point.
 *
 * Idea: three tests, from cheap to exact: the box around the step by integer keys, the convex hull of the step by
 * doubles with an error bound, and sweep_touches() for the points that the hull's error bound leaves undecided.
 *
 * The box position +- r moves from a by d. On its way it covers a convex body (a zonotope) with up to twelve faces: the
 * six faces of the box around the step, and up to three pairs of parallel faces whose normals are perpendicular to d
 * and to one axis. A pair whose normal lies in the plane of the axes i and j has the normal (-d_j, d_i), and a point p
 * lies between the two faces if
 *
 *     |side(p)| <= r (|d_i| + |d_j|) = R,    side(p) = d_i (p_j - a_j) - d_j (p_i - a_i).
 *
 * If d_i or d_j is 0, every point in the box around the step fulfils this condition.
 *
 * Error bound. Everything is scaled by a power of two that brings step, positions and world below 8. The scaling has an
 * error below 2^-1074. Let u = 2^-53 and S = |d_i| far_j + |d_j| far_i + R, where far_i is the distance on axis i from
 * a to the farther end of the world.
 *
 * For a point, the error of side() is at most 5u S (roundings in d, in p - a, in the product, in the sum, and their
 * combination), and the error of R is at most 4u S. For a cell, planes are treated as evenly spaced. side() at the
 * cell's lowest corner is side() at the world's lowest corner (error 5u S) plus two products with a key (each at most
 * 2S, with an error of 4u times that). Four sums of terms of at most 3S add 12u S. The total is 33u S. The planes
 * themselves are at most two ulps of the world's coordinates off their ideal position (test_exact_planes); the code
 * allows four ulps.
 *
 * To cover all of these errors, R gets a band of 128u S, plus the four ulps times d, plus 2^-1000 for underflow, on
 * either side. If |side(p)| is above the band, p is certainly outside; if it is below the band, p is certainly inside.
 */
#include "../exact/float_mode.h"
#include "region.h"
#include "../exact/sweep.h"

/* Two parallel faces of the hull. Their normal lies in the plane of the axes i and j. */
typedef struct hull_faces {
    int i, j;
    double step_i, step_j;       /* the components of the step d on the axes i and j */
    double lowest;               /* the value of side() at the world's lowest corner */
    double per_key_i, per_key_j; /* the decrease of side() per key on axis i, and its increase per key on axis j */
    /* reach: R plus the error band; points and cells with a larger |side()| are not touched. whole: R minus the error
     * band, which may be negative; points and cells with a smaller |side()| lie between the faces */
    double reach, whole;
} hull_faces;

typedef struct hull {
    metric metric; /* the metric whose target is the start of the step */
    hull_faces faces[3];
    unsigned face_count; /* 1 if the step changes two coordinates, 3 if it changes three */
} hull;

/* Returns the largest absolute coordinate on an axis. */
static double largest_coordinate(const axis *a)
{
    return larger(fabs(a->min), fabs(a->max));
}

static double choose_scale(const octree *tree, const sweep *box)
{
    double largest = box->size;
    for (int i = 0; i < 3; i++)
        largest =
            larger(larger(largest, largest_coordinate(&tree->axes[i])), larger(fabs(box->from[i]), fabs(box->to[i])));
    int exponent;
    frexp(largest, &exponent);
    return ldexp(1.0, -(exponent < -1000 ? -1000 : exponent > 1021 ? 1021 : exponent));
}

/* The step and the bounds of the world on one axis, scaled and relative to the start of the step. */
typedef struct axis_view {
    double step, low, high;
    double far;   /* the distance from the start of the step to the farther bound of the world */
    double error; /* the largest error of the position of a plane between cells */
} axis_view;

static axis_view make_axis_view(const metric *m, const axis *a, double start, double end)
{
    axis_view o = {
        .step = end - start, .low = metric_scaled(m, a->min) - start, .high = metric_scaled(m, a->max) - start};
    o.far = larger(fabs(o.low), fabs(o.high));
    o.error = metric_scaled(m, largest_coordinate(a)) * 0x1p-50 + m->scale * 0x1p-1000 * 0x1p-72;
    return o;
}

static hull_faces make_faces(const axis_view view[3], double size, int i, int j)
{
    const axis_view *x = &view[i], *y = &view[j];
    const double level = size * (fabs(x->step) + fabs(y->step));
    const double sum = fabs(x->step) * y->far + fabs(y->step) * x->far + level;
    const double band = sum * 0x1p-46 + (fabs(x->step) * y->error + fabs(y->step) * x->error) + 0x1p-1000;
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

/* Make the hull of a diagonal step. Returns false for a step along one axis, and does not write *h: the hull of such a
 * step is the box around the step. */
static bool make_hull(hull *h, const octree *tree, const sweep *box)
{
    bool moves[3];
    for (int i = 0; i < 3; i++)
        moves[i] = box->from[i] != box->to[i];
    if (moves[0] + moves[1] + moves[2] < 2)
        return false;
    axis_view view[3];
    const double scale = choose_scale(tree, box);
    const metric end = metric_make(scale, is_subnormal_world(tree), box->to);
    h->metric = metric_make(scale, is_subnormal_world(tree), box->from);
    for (int i = 0; i < 3; i++)
        view[i] = make_axis_view(&h->metric, &tree->axes[i], h->metric.scaled[i], end.scaled[i]);
    h->face_count = 0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (moves[i] && moves[j])
            h->faces[h->face_count++] = make_faces(view, box->size * scale, i, j);
    }
    return true;
}

/* Returns masks of the octants of a cell: those that may lie between all pairs of faces, and those that certainly lie
 * between them. `low` holds the lowest keys of the cell. */
static octant_masks find_hull_octants(const hull *h, const int32_t low[3], unsigned depth)
{
    const double half = (double)cell_size(depth) / 2, quarter = half / 2;
    unsigned misses = 0, leaves = 0;
    for (unsigned k = 0; k < h->face_count; k++) {
        const hull_faces *f = &h->faces[k];
        const double middle = f->lowest + (low[f->j] + half) * f->per_key_j - (low[f->i] + half) * f->per_key_i;
        const double x = f->per_key_i * quarter, y = f->per_key_j * quarter, grown = fabs(x) + fabs(y);
        for (int column = 0; column < 4; column++) { /* each column is two octants that differ on the third axis only */
            const int upper_i = column >> 1, upper_j = column & 1;
            const unsigned octants = octants_beside[f->i][upper_i] & octants_beside[f->j][upper_j];
            const double side = fabs((middle + (upper_j ? y : -y)) - (upper_i ? x : -x));
            misses |= mask_if(side > f->reach + grown, octants);
            leaves |= mask_if(!(side + grown < f->whole), octants);
        }
    }
    return (octant_masks){(uint8_t)~misses, (uint8_t)~leaves};
}

static double measure_side_of_face(const hull *h, const hull_faces *f, const double p[3])
{
    const double x = metric_scaled(&h->metric, p[f->i]) - h->metric.scaled[f->i];
    const double y = metric_scaled(&h->metric, p[f->j]) - h->metric.scaled[f->j];
    return f->step_i * y - f->step_j * x;
}

/* ---- The search --------------------------------------------------------------------------------------------- */

typedef struct swept_shape {
    box_shape around; /* the box around the whole step. The first member, because box_shape_enter() casts the shape to a
                         box_shape */
    hull hull;
    sweep box;
} swept_shape;

static octant_masks enter_swept_cell(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    swept_shape *s = shape;
    const octant_masks around = box_shape_enter(&s->around, tree, depth, octant);
    /* If only one octant meets the box, the hull is not compared with the octants here, but with the octants of that
     * octant. */
    if ((around.meets & (around.meets - 1)) == 0)
        return (octant_masks){around.meets, 0};
    const octant_masks between = find_hull_octants(&s->hull, s->around.low[depth], depth);
    return (octant_masks){around.meets & between.meets, around.inside & between.inside};
}

/* Returns whether the moving box touches a point that lies in the box around the step. */
static bool is_point_touched(const swept_shape *s, const double p[3])
{
    bool certain = true;
    for (unsigned k = 0; k < s->hull.face_count; k++) {
        const double side = fabs(measure_side_of_face(&s->hull, &s->hull.faces[k], p));
        if (side > s->hull.faces[k].reach)
            return false;
        certain = certain && side < s->hull.faces[k].whole;
    }
    return certain || sweep_touches(&s->box, p, p, NULL);
}

static uint64_t scan_swept_points(const void *shape, const octree_point *points, unsigned count)
{
    const swept_shape *s = shape;
    uint64_t found = 0;
    for (uint64_t left = box_shape_scan(&s->around, points, count); left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        found |= (uint64_t)is_point_touched(s, points[i].position) << i;
    }
    return found;
}

static void search_swept_box(const octree *tree, const sweep *box, const octree_box *around, const octree_search *how,
                             collision *visitor)
{
    swept_shape shape;
    shape.around = box_shape_make(tree, around, around);
    shape.box = *box;
    const bool diagonal = make_hull(&shape.hull, tree, box);
    region r = {tree, &shape, enter_swept_cell, scan_swept_points, visit_unless_self, visitor, .meter.how = how};
    if (!diagonal) { /* for a step along one axis, the box around the step is the exact answer */
        r.enter = box_shape_enter;
        r.scan = box_shape_scan;
    }
    octant_masks root = box_shape_root(&shape.around, tree);
    if (diagonal)
        root.inside = 0;
    region_search(&r, root);
}

octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                   void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_collide_swept, tree, from, to, box_size, self, CALLER_SEARCH(how),
                           CALLER_VISITOR(visit, context));
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    octree_box start, end;
    const octree_search search = search_or_default(how);
    octree_status status = octree_collision_box(from, box_size, &start);
    if (status == OCTREE_OK)
        status = octree_collision_box(to, box_size, &end);
    if (status == OCTREE_OK)
        status = check_search_options(&search);
    if (status != OCTREE_OK)
        return status;
    for (int i = 0; i < 3; i++) { /* the box around the whole step */
        start.min[i] = fmin(start.min[i], end.min[i]);
        start.max[i] = fmax(start.max[i], end.max[i]);
    }
    search_swept_box(tree, &(sweep){from, to, box_size}, &start, &search, &(collision){self, visit, context});
    return OCTREE_OK;
}
