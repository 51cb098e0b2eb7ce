/* range.c - Algorithm 4: the points in a closed box. */
#include "exact.h"
#include "region.h"
#include "search.h"

#include <math.h>

/* A box in keys: what it is compared with are integers from then on. Keys are monotone, so a point whose key lies
 * strictly between the ends' keys lies in the box, and one whose key lies outside them does not. Where the box reaches
 * the world's face, the end is one key beyond all. */
typedef struct key_box {
    int32_t min[3], max[3];
} key_box;

static key_box box_keys(const octree *tree, const octree_box *box)
{
    key_box keys;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys.min[i] = box->min[i] > a->min ? (int32_t)plane_key(a, fmin(box->min[i], a->max)) : -1;
        keys.max[i] = box->max[i] < a->max ? (int32_t)plane_key(a, fmax(box->max[i], a->min)) : (int32_t)PLANE_GRID;
    }
    return keys;
}

static bool misses_world(const octree *tree, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < tree->axes[i].min || box->min[i] > tree->axes[i].max)
            return true;
    return false;
}

typedef struct box_shape {
    const octree_box *box;
    key_box near;                     /* of the box: what does not meet it is left out */
    key_box whole;                    /* of the box moved out by epsilon: what is inside is taken whole */
    int32_t low[OCTREE_MAX_DEPTH][3]; /* of the cell at each depth */
} box_shape;

/* The octants below a plane, and those above, on each axis. */
static const uint8_t below_plane[3] = {0x0f, 0x33, 0x55};
static const uint8_t above_plane[3] = {0xf0, 0xcc, 0xaa};

static unsigned if_true(bool condition, unsigned mask)
{
    return condition ? mask : 0;
}

static octant_masks enter(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    (void)tree;
    box_shape *s = shape;
    const int32_t size = (int32_t)cell_size(depth), half = size / 2;
    unsigned meets = 0xff, inside = 0xff;
    for (int i = 0; i < 3; i++) {
        const int32_t low = depth == 0 ? 0 : s->low[depth - 1][i] + (octant & (4u >> i) ? size : 0);
        const int32_t middle = low + half, high = low + size;
        s->low[depth][i] = low;
        meets &= if_true(s->near.min[i] < middle && low <= s->near.max[i], below_plane[i]) |
                 if_true(s->near.min[i] < high && middle <= s->near.max[i], above_plane[i]);
        inside &= if_true(s->whole.min[i] < low && middle <= s->whole.max[i], below_plane[i]) |
                  if_true(s->whole.min[i] < middle && high <= s->whole.max[i], above_plane[i]);
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

static unsigned scan(const void *shape, const octree_point *points, unsigned count, uint8_t hits[])
{
    const octree_box box = *((const box_shape *)shape)->box;
    unsigned found = 0;
    for (unsigned i = 0; i < count; i++) {
        hits[found] = (uint8_t)i;
        found += box_contains(&box, points[i].position);
    }
    return found;
}

static octant_masks measure_root(const box_shape *s, const octree *tree)
{
    octant_masks root = {1, 1};
    if (misses_world(tree, s->box))
        return (octant_masks){0, 0};
    for (int i = 0; i < 3; i++)
        if (s->whole.min[i] >= 0 || s->whole.max[i] < (int32_t)PLANE_GRID)
            root.inside = 0;
    return root;
}

/* The box moved out by epsilon, rounded so that nothing beyond it counts as inside. */
static octree_box widen(const octree_box *box, double epsilon)
{
    octree_box wide;
    for (int i = 0; i < 3; i++) {
        wide.min[i] = isfinite(box->min[i]) ? exact_add_up(box->min[i], -epsilon) : box->min[i];
        wide.max[i] = isfinite(box->max[i]) ? exact_add_down(box->max[i], epsilon) : box->max[i];
    }
    return wide;
}

/* Visit or count. The box has been checked. */
static size_t run_query(const octree *tree, const octree_box *box, const octree_search *how, octree_point_visitor visit,
                        void *context)
{
    const octree_box wide = widen(box, how->epsilon);
    box_shape shape;
    shape.box = box;
    shape.near = box_keys(tree, box);
    shape.whole = how->epsilon > 0 ? box_keys(tree, &wide) : shape.near;
    region r = {
        .tree = tree,
        .shape = &shape,
        .enter = enter,
        .scan = scan,
        .visit = visit,
        .context = context,
        .meter = {.how = how},
    };
    region_descend(&r, measure_root(&shape, tree));
    meter_report(&r.meter);
    return r.count;
}

octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context)
{
    if (!tree || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = check_box(box);
    if (status == OCTREE_OK)
        status = check_search(&search);
    if (status == OCTREE_OK)
        run_query(tree, box, &search, visit, context);
    return status;
}

octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context)
{
    return octree_range_search(tree, box, NULL, visit, context);
}

octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count)
{
    if (!tree || !count)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = check_box(box);
    *count = status == OCTREE_OK ? run_query(tree, box, &(octree_search){0}, NULL, NULL) : 0;
    return status;
}
