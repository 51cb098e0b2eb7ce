/* SPDX-License-Identifier: MIT */
#include "point_scale.h"
#include "array.h"

#include <math.h>
#include <stdlib.h>

/* One point in so many may be an outlier at either end. */
#define OUTLIERS 100

/* The points of a leaf that tell how far they are apart. */
#define FEWEST 4

/* The points that are shown of one leaf. A sum over leaves does not depend on the order of the points in them. */
typedef struct leaf_extent {
    double low[3], high[3], spacing;
    size_t count;
} leaf_extent;

typedef struct gathering {
    const view_filter *filter;
    octree_box world;
    leaf_extent *leaves;
    size_t count, room, points;
    double ids[2];
    const point_values *values; /* null: intensities are not asked for */
    float *intensities;         /* of the points that have one */
    size_t intensity_count, intensity_room;
    bool out_of_memory;
} gathering;

static double least(double a, double b)
{
    return a < b ? a : b;
}

static double most(double a, double b)
{
    return a > b ? a : b;
}

/* Of k x k points on a grid k - 1 spaces lie along a side. The shortest side of the three is the way through the
 * surface that the points are on. Few points are on no surface that could be seen. */
static double spacing_of(const leaf_extent *e)
{
    const double a = e->high[0] - e->low[0], b = e->high[1] - e->low[1], c = e->high[2] - e->low[2];
    const double longest = most(a, most(b, c)), middle = most(least(a, b), least(most(a, b), c));
    return e->count >= FEWEST ? sqrt(longest) * sqrt(middle) / (sqrt((double)e->count) - 1) : 0;
}

static void add_intensity(gathering *g, uint64_t id)
{
    const size_t row = point_values_row(g->values, id);
    if (!point_values_has(g->values, row, POINT_INTENSITY))
        return;
    float *all = array_reserve(g->intensities, g->intensity_count + 1, &g->intensity_room, sizeof *all);
    g->out_of_memory |= !all;
    if (!all)
        return;
    g->intensities = all;
    all[g->intensity_count++] = g->values->intensities[row];
}

static void add_leaf(gathering *g, const octree_node *leaf)
{
    leaf_extent e = {.count = 0};
    for (size_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf->points[i];
        const double id = (double)point->id;
        if (!filter_shows_point(g->filter, point->position))
            continue;
        for (int axis = 0; axis < 3; axis++) {
            const double at = point->position[axis];
            e.low[axis] = e.count ? least(e.low[axis], at) : at;
            e.high[axis] = e.count ? most(e.high[axis], at) : at;
        }
        g->ids[0] = g->points ? least(g->ids[0], id) : id;
        g->ids[1] = g->points ? most(g->ids[1], id) : id;
        add_intensity(g, point->id);
        e.count++;
        g->points++;
    }
    leaf_extent *leaves = e.count ? array_reserve(g->leaves, g->count + 1, &g->room, sizeof *leaves) : NULL;
    g->out_of_memory |= e.count && !leaves;
    if (!leaves)
        return;
    e.spacing = spacing_of(&e);
    g->leaves = leaves;
    g->leaves[g->count++] = e;
}

static octree_walk_order gather(const octree_node *node, void *context)
{
    gathering *g = context;
    if (!filter_enters(g->filter, &g->world, node))
        return OCTREE_WALK_SKIP;
    if (node->leaf && filter_shows_points_of(g->filter, &g->world, node))
        add_leaf(g, node);
    return g->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

/* ---- Quantiles ---------------------------------------------------------------------------------------------- */

/* A value, and the points that it stands for. */
typedef struct weighted {
    double value;
    size_t weight;
} weighted;

static void swap(weighted *a, weighted *b)
{
    const weighted kept = *a;
    *a = *b;
    *b = kept;
}

/* Bring what is below the pivot to [0, *low), what is above it to [*high, count). Returns the weight of the former; the
 * others' is added to *equal. */
static size_t divide(weighted *values, size_t count, double pivot, size_t *low, size_t *high, size_t *equal)
{
    size_t below = 0;
    *low = 0;
    *high = count;
    for (size_t i = 0; i < *high;) {
        if (values[i].value < pivot) {
            below += values[i].weight;
            swap(&values[i++], &values[(*low)++]);
        } else if (values[i].value > pivot) {
            swap(&values[i], &values[--*high]);
        } else {
            *equal += values[i++].weight;
        }
    }
    return below;
}

/* The value that points of this weight are not above; the last where they have less. The values are left in another
 * order. Cost: O(count) on average, whatever their order is: the pivots are drawn. */
static double select_value(weighted *values, size_t count, size_t rank)
{
    uint64_t state = 1;
    for (;;) {
        size_t low, high, equal = 0;
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        const double pivot = values[(size_t)((double)(state >> 11) * 0x1p-53 * (double)count)].value;
        const size_t below = divide(values, count, pivot, &low, &high, &equal);
        if (rank < below) {
            count = low;
        } else if (rank < below + equal || high == count) {
            return pivot;
        } else {
            values += high;
            count -= high;
            rank -= below + equal;
        }
    }
}

/* The value that `rank` points are not above. `offset` is that of the values in a leaf_extent. */
static double value_at(const gathering *g, weighted *values, size_t offset, size_t rank)
{
    for (size_t i = 0; i < g->count; i++)
        values[i] = (weighted){*(const double *)((const char *)&g->leaves[i] + offset), g->leaves[i].count};
    return select_value(values, g->count, rank);
}

static point_scale measure(const gathering *g, weighted *values)
{
    const size_t few = g->points / OUTLIERS;
    point_scale s = {.ids = {g->ids[0], g->ids[1]}};
    for (size_t i = 0; i < 3; i++) {
        const size_t axis = i * sizeof(double);
        s.low[i] = value_at(g, values, offsetof(leaf_extent, low) + axis, few);
        s.high[i] = most(s.low[i], value_at(g, values, offsetof(leaf_extent, high) + axis, g->points - 1 - few));
    }
    s.spacing = value_at(g, values, offsetof(leaf_extent, spacing), g->points / 2);
    s.spacing = isfinite(s.spacing) ? s.spacing : 0;
    return s;
}

static int compare_floats(const void *a, const void *b)
{
    const float p = *(const float *)a, q = *(const float *)b;
    return (p > q) - (p < q);
}

static void measure_intensities(const gathering *g, double ends[2])
{
    const size_t count = g->intensity_count, few = count / OUTLIERS;
    if (count == 0)
        return;
    qsort(g->intensities, count, sizeof *g->intensities, compare_floats);
    ends[0] = (double)g->intensities[few];
    ends[1] = (double)g->intensities[count - 1 - few];
}

double point_scale_pixels(const camera *c, double length)
{
    return length * c->scale / c->size * 2 * c->zoom;
}

bool point_scale_fit(view *v, const octree *tree, const point_values *values)
{
    if (!view_paints_points(v) || v->point_scale.given)
        return true;
    gathering g = {.filter = &v->filter,
                   .world = octree_definition(tree).world,
                   .values = v->point_color == POINTS_BY_INTENSITY ? values : NULL};
    octree_walk(tree, gather, &g);
    weighted *sorted = g.count ? malloc(g.count * sizeof *sorted) : NULL;
    const bool measured = !g.out_of_memory && (sorted || g.count == 0);
    v->point_scale.given = measured && g.count > 0;
    if (v->point_scale.given) {
        v->point_scale.of = measure(&g, sorted);
        measure_intensities(&g, v->point_scale.of.intensities);
    }
    free(sorted);
    free(g.leaves);
    free(g.intensities);
    return measured;
}

const char *point_scale_lacks(const view *v, const point_values *values)
{
    static const struct {
        view_point_color color;
        point_value_kind kind;
        const char *name;
    } rows[] = {{POINTS_BY_FILE, POINT_COLOR, "a colour"},
                {POINTS_BY_INTENSITY, POINT_INTENSITY, "an intensity"},
                {POINTS_BY_CLASS, POINT_CLASS, "a class"}};
    const unsigned kinds = values ? point_values_kinds(values) : 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (v->point_color == rows[i].color && !(kinds >> rows[i].kind & 1))
            return rows[i].name;
    return NULL;
}
