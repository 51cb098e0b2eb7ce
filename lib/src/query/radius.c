/* SPDX-License-Identifier: MIT */
/* radius.c - the points in a closed ball. */
#include "region.h"

/* The squares of the distances from the centre to a cell, axis by axis. */
typedef struct ball_cell {
    double center[3]; /* of the cell, from -1 to 1 in the world */
    double near[3];   /* to its nearest place */
    double low[3];    /* to its lower plane */
    double middle[3]; /* to the plane that cuts it */
    double high[3];   /* to its upper plane */
    bool above[3];    /* the ball's centre is above the plane that cuts it, or on it */
} ball_cell;

typedef struct ball {
    metric metric;
    octree_mode mode;
    double radius; /* as given */
    double square; /* of the radius, scaled */
    double reach;  /* what has a square beyond this is outside */
    double whole;  /* what has a square below this is inside the ball of radius + epsilon */
    ball_cell cells[OCTREE_MAX_DEPTH];
} ball;

/* Of the two halves of a cell on an axis, the squares to the nearest place and to the farthest. */
static double near_square(const ball_cell *c, int axis, bool upper)
{
    return c->above[axis] == upper ? c->near[axis] : c->middle[axis];
}

static double far_square(const ball_cell *c, int axis, bool upper)
{
    return larger(c->middle[axis], upper ? c->high[axis] : c->low[axis]);
}

static octant_masks masks_of(const ball *b, const ball_cell *c)
{
    double near[3][2], far[3][2];
    for (int i = 0; i < 3; i++)
        for (int upper = 0; upper < 2; upper++) {
            near[i][upper] = near_square(c, i, upper);
            far[i][upper] = far_square(c, i, upper);
        }
    unsigned meets = 0, inside = 0;
    for (unsigned octant = 0; octant < 8; octant++) {
        const unsigned x = octant >> 2, y = octant >> 1 & 1, z = octant & 1;
        meets |= !((near[0][x] + near[1][y]) + near[2][z] > b->reach) ? 1u << octant : 0;
        inside |= (far[0][x] + far[1][y]) + far[2][z] < b->whole ? 1u << octant : 0;
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

static void cut(const ball *b, const octree *tree, ball_cell *c)
{
    for (int i = 0; i < 3; i++) {
        const double plane = metric_scaled(&b->metric, plane_inside(&tree->axes[i], c->center[i]));
        const double beyond = b->metric.scaled[i] - plane;
        c->middle[i] = beyond * beyond;
        c->above[i] = beyond >= 0;
    }
}

static octant_masks enter(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    ball *b = shape;
    ball_cell *c = &b->cells[depth];
    if (depth > 0) {
        const ball_cell *parent = c - 1;
        const double half = 1.0 / (double)(1u << depth);
        for (int i = 0; i < 3; i++) {
            const bool upper = octant >> (2 - i) & 1;
            c->center[i] = parent->center[i] + (upper ? half : -half);
            c->near[i] = near_square(parent, i, upper);
            c->low[i] = upper ? parent->middle[i] : parent->low[i];
            c->high[i] = upper ? parent->high[i] : parent->middle[i];
        }
    }
    cut(b, tree, c);
    return masks_of(b, c);
}

static unsigned scan(const void *shape, const octree_point *points, unsigned count, uint8_t hits[])
{
    const ball *b = shape;
    double squares[SCAN_POINTS];
    unsigned found = 0;
    for (uint64_t left = metric_points(&b->metric, points, count, b->reach, squares).within; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        hits[found] = (uint8_t)i;
        found += is_within(&b->metric, b->mode, &points[i], squares[i], b->radius, b->square);
    }
    return found;
}

/* The world's own cell, which nothing has cut yet. */
static octant_masks measure_root(ball *b, const octree *tree)
{
    ball_cell *c = &b->cells[0];
    double near = 0, far = 0;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        const double low = b->metric.scaled[i] - metric_scaled(&b->metric, a->min);
        const double high = metric_scaled(&b->metric, a->max) - b->metric.scaled[i];
        const double gap = metric_gap(&b->metric, i, a->min, a->max);
        c->center[i] = 0;
        c->near[i] = gap * gap;
        c->low[i] = low * low;
        c->high[i] = high * high;
        near += c->near[i];
        far += larger(c->low[i], c->high[i]);
    }
    return (octant_masks){!(near > b->reach), far < b->whole};
}

static double square_of(double length)
{
    return length * length;
}

static void run_query(const octree *tree, const double center[3], double radius, const octree_search *how,
                      octree_point_visitor visit, void *context)
{
    ball b;
    b.metric = metric_make(tree->scale, is_subnormal_world(tree), center);
    b.mode = how->mode;
    b.radius = radius;
    b.square = square_of(radius * tree->scale);
    b.reach = metric_above(b.square);
    b.whole = metric_below(square_of(radius * tree->scale + how->epsilon * tree->scale)); /* their sum may overflow */
    region r = {
        .tree = tree,
        .shape = &b,
        .enter = enter,
        .scan = scan,
        .visit = visit,
        .context = context,
        .meter = {.how = how},
    };
    region_search(&r, measure_root(&b, tree));
}

octree_status octree_radius(const octree *tree, const double center[3], double radius, const octree_search *how,
                            octree_point_visitor visit, void *context)
{
    if (!tree || !center || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_search(&search);
    if (status == OCTREE_OK)
        status = check_finite(center);
    if (status == OCTREE_OK)
        status = check_length(radius);
    if (status == OCTREE_OK)
        run_query(tree, center, radius, &search, visit, context);
    return status;
}
