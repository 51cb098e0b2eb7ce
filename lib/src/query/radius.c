/* SPDX-License-Identifier: MIT */
/* radius.c - range search in a closed ball: octree_radius(). */
#include "../exact/float_mode.h"
#include "region.h"

/* On each axis, squared distances from the ball's centre to the parts of a cell. The last index is 0 for the lower half
 * of the cell and 1 for the upper half: selecting a half by an index avoids an unpredictable branch. */
typedef struct ball_cell {
    double center[3];  /* the cell's centre, in units in which the world extends from -1 to 1 */
    double near[3];    /* the squared distance from the ball's centre to the nearest coordinate in the cell */
    double ends[3][2]; /* the squared distances to the cell's lower and upper planes */
    double middle[3];  /* the squared distance to the plane that splits the cell */
    double half[3][2]; /* the squared distances to the nearest coordinate in the lower and in the upper half */
} ball_cell;

typedef struct ball {
    metric metric;
    octree_mode mode;
    double radius; /* the radius in world units, not scaled */
    double square; /* the square of the scaled radius */
    double reach;  /* a point or cell with a greater scaled squared distance is outside the ball */
    /* A cell lies within radius + epsilon if the squared distance of its farthest corner is smaller than `whole`. */
    double whole;
    ball_cell cells[OCTREE_MAX_DEPTH];
} ball;

static octant_masks find_octant_masks(const ball *b, const ball_cell *c)
{
    double far[3][2];
    for (int i = 0; i < 3; i++)
        for (int upper = 0; upper < 2; upper++)
            far[i][upper] = larger(c->middle[i], c->ends[i][upper]);
    unsigned meets = 0, inside = 0;
    for (unsigned octant = 0; octant < 8; octant++) {
        const unsigned x = octant >> 2, y = octant >> 1 & 1, z = octant & 1;
        meets |= mask_if(!((c->half[0][x] + c->half[1][y]) + c->half[2][z] > b->reach), 1u << octant);
        inside |= mask_if((far[0][x] + far[1][y]) + far[2][z] < b->whole, 1u << octant);
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

static void measure_planes(const ball *b, const octree *tree, ball_cell *c)
{
    for (int i = 0; i < 3; i++) {
        const double plane = metric_scaled(&b->metric, plane_inside(&tree->axes[i], c->center[i]));
        const double beyond = b->metric.scaled[i] - plane;
        const bool above = beyond >= 0; /* the ball's centre is above the plane */
        c->middle[i] = beyond * beyond;
        c->half[i][above] = c->near[i];
        c->half[i][!above] = c->middle[i];
    }
}

static octant_masks enter_ball_cell(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    ball *b = shape;
    ball_cell *c = &b->cells[depth];
    if (depth > 0) {
        const ball_cell *parent = c - 1;
        const double half = 1.0 / (double)(1u << depth), sides[2] = {-half, half};
        for (int i = 0; i < 3; i++) {
            const bool upper = octant >> (2 - i) & 1;
            c->center[i] = parent->center[i] + sides[upper];
            c->near[i] = parent->half[i][upper];
            c->ends[i][upper] = parent->ends[i][upper];
            c->ends[i][!upper] = parent->middle[i];
        }
    }
    measure_planes(b, tree, c);
    return find_octant_masks(b, c);
}

static uint64_t scan_ball_points(const void *shape, const octree_point *points, unsigned count)
{
    const ball *b = shape;
    double squares[SCAN_POINTS];
    uint64_t found = 0;
    metric_compute_squares(&b->metric, points, count, squares);
    for (uint64_t left = metric_mask_within(squares, count, b->reach); left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        found |= (uint64_t)is_within_ball(&b->metric, b->mode, &points[i], squares[i], b->radius, b->square) << i;
    }
    return found;
}

/* Compare the root's cell with the ball, and store its distances in b->cells[0]. Returns masks whose bit 0 stands for
 * the root's cell itself. */
static octant_masks compare_root_with_ball(ball *b, const octree *tree)
{
    ball_cell *c = &b->cells[0];
    double near = 0, far = 0;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        const double low = b->metric.scaled[i] - metric_scaled(&b->metric, a->min);
        const double high = metric_scaled(&b->metric, a->max) - b->metric.scaled[i];
        const double gap = metric_interval_distance(&b->metric, i, a->min, a->max);
        c->center[i] = 0;
        c->near[i] = gap * gap;
        c->ends[i][0] = low * low;
        c->ends[i][1] = high * high;
        near += c->near[i];
        far += larger(c->ends[i][0], c->ends[i][1]);
    }
    return (octant_masks){!(near > b->reach), far < b->whole};
}

static double square_length(double length)
{
    return length * length;
}

static void search_ball(const octree *tree, const double center[3], double radius, const octree_search *how,
                        octree_point_visitor visit, void *context)
{
    ball b;
    b.metric = metric_make(tree->scale, is_subnormal_world(tree), center);
    b.mode = how->mode;
    b.radius = radius;
    b.square = square_length(radius * tree->scale);
    b.reach = metric_above(b.square);
    /* Lengths are scaled before they are added, because their sum may overflow. */
    b.whole = metric_below(square_length(radius * tree->scale + how->epsilon * tree->scale));
    region r = {tree, &b, enter_ball_cell, scan_ball_points, visit, context, .meter.how = how};
    region_search(&r, compare_root_with_ball(&b, tree));
}

octree_status octree_radius(const octree *tree, const double center[3], double radius, const octree_search *how,
                            octree_point_visitor visit, void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_radius, tree, center, radius, CALLER_SEARCH(how),
                           CALLER_VISITOR(visit, context));
    if (!tree || !center || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_search_options(&search);
    if (status == OCTREE_OK)
        status = check_finite_position(center);
    if (status == OCTREE_OK)
        status = check_length(radius);
    if (status == OCTREE_OK)
        search_ball(tree, center, radius, &search, visit, context);
    return status;
}
