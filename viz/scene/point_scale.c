/* SPDX-License-Identifier: MIT */
/* point_scale.c - measures the ranges of values for the colours of points, and the spacing of points for their sizes,
 * in one walk over the points of tick 0.
 *
 * Ranges: with the full range of values, a single outlier would take most colours from all other points. So a range
 * extends from the 1st to the 99th percentile.
 *
 * The sample: sorting all points would need memory for all of them, and a sample of at most MOST_SAMPLES points is
 * enough. A point is in the sample if the lowest bits of a hash of its id and position are zero. When the sample is
 * full, one more bit must be zero. The sample thus depends only on the set of points, not on their order or on the
 * tree, and frames with other leaf capacities have the same colours.
 *
 * Spacing: points of a scan lie on surfaces. The points of a leaf are treated as a square grid that covers the two
 * longer sides of their box. The result is the median over the leaves, weighted by their number of points.
 *
 * Percentiles and the median are found by quickselect with random pivots: O(n) on average, for any order of the
 * values. */
#include "point_scale.h"
#include "array.h"
#include "octree/digest.h"
#include "octree/octree.h"

#include <math.h>
#include <stdlib.h>

/* One of OUTLIERS points is cut off at each end of a range: the lowest and the highest 1 %. */
#define OUTLIERS 100

/* The spacing is not measured in a leaf with fewer points than this. */
#define FEWEST 4

/* The maximum number of points in the sample. With this number, the rank of a percentile is accurate to about a
 * tenth. */
#define MOST_SAMPLES ((size_t)1 << 16)

/* The spacing of the visible points of one leaf, and their number. */
typedef struct leaf_spacing {
    double spacing;
    size_t count;
} leaf_spacing;

typedef struct sample {
    uint64_t hash;
    double values[4]; /* x, y, z and the intensity; NaN is a missing intensity */
} sample;

/* A sample of the points: the points whose hash has no bit in common with `mask`. */
typedef struct samples {
    sample *items;
    size_t count, room;
    uint64_t mask; /* the low bits that must be 0 in the hash of each sampled point; grows when the sample is full */
} samples;

typedef struct gathering {
    const view_filter *filter;
    octree_box world;
    leaf_spacing *leaves;
    size_t count, room, points;
    samples samples;
    double ids[2];
    const point_values *values; /* the values of points; null if intensities are not needed */
    bool out_of_memory;
} gathering;

static double minimum(double a, double b)
{
    return a < b ? a : b;
}

static double maximum(double a, double b)
{
    return a > b ? a : b;
}

/* Returns the spacing of points in a box. A grid of k x k points has k - 1 spaces along each side. The shortest of the
 * box's three sides is the thickness of the surface and is ignored. Returns 0 for fewer than FEWEST points. */
static double find_spacing(const double low[3], const double high[3], size_t count)
{
    const double a = high[0] - low[0], b = high[1] - low[1], c = high[2] - low[2];
    const double longest = maximum(a, maximum(b, c)), middle = maximum(minimum(a, b), minimum(maximum(a, b), c));
    return count >= FEWEST ? sqrt(longest) * sqrt(middle) / (sqrt((double)count) - 1) : 0;
}

static uint64_t hash_point(const octree_point *point)
{
    uint64_t hash = octree_digest_word(OCTREE_DIGEST_START, point->id);
    for (int i = 0; i < 3; i++)
        hash = octree_digest_double(hash, point->position[i]);
    return hash;
}

/* Add bits to the mask and drop samples until at most MOST_SAMPLES samples are left. */
static void discard_samples(samples *s)
{
    while (s->count > MOST_SAMPLES) {
        size_t kept = 0;
        s->mask = s->mask << 1 | 1;
        for (size_t i = 0; i < s->count; i++)
            if (!(s->items[i].hash & s->mask))
                s->items[kept++] = s->items[i];
        s->count = kept;
    }
}

static void add_sample(gathering *g, const octree_point *point)
{
    samples *s = &g->samples;
    const uint64_t hash = hash_point(point);
    if (hash & s->mask)
        return;
    if (!ARRAY_GROW(s, 1)) {
        g->out_of_memory = true;
        return;
    }
    const point_value value = point_values_get(g->values, point->id);
    const double *at = point->position, intensity = value.has[POINT_INTENSITY] ? (double)value.intensity : NAN;
    s->items[s->count++] = (sample){hash, {at[0], at[1], at[2], intensity}};
    discard_samples(s);
}

static void measure_leaf(gathering *g, const octree_node *leaf)
{
    double low[3] = {0}, high[3] = {0};
    size_t count = 0;
    for (size_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf->points[i];
        const double id = (double)point->id;
        if (!filter_shows_point(g->filter, point->position))
            continue;
        for (int axis = 0; axis < 3; axis++) {
            const double at = point->position[axis];
            low[axis] = count ? minimum(low[axis], at) : at;
            high[axis] = count ? maximum(high[axis], at) : at;
        }
        g->ids[0] = g->points ? minimum(g->ids[0], id) : id;
        g->ids[1] = g->points ? maximum(g->ids[1], id) : id;
        add_sample(g, point);
        count++;
        g->points++;
    }
    if (count == 0)
        return;
    if (array_grow(&g->leaves, g->count + 1, &g->room, sizeof *g->leaves))
        g->leaves[g->count++] = (leaf_spacing){find_spacing(low, high, count), count};
    else
        g->out_of_memory = true;
}

static octree_walk_order gather_leaf(const octree_node *node, void *context)
{
    gathering *g = context;
    if (!filter_shows_subtree(g->filter, &g->world, node))
        return OCTREE_WALK_SKIP;
    if (node->leaf && filter_shows_points_of(g->filter, &g->world, node))
        measure_leaf(g, node);
    return g->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

/* ---- Quantiles ---------------------------------------------------------------------------------------------- */

/* A value, and its weight: the number of points that have it. */
typedef struct weighted {
    double value;
    size_t weight;
} weighted;

static void swap_values(weighted *a, weighted *b)
{
    const weighted kept = *a;
    *a = *b;
    *b = kept;
}

/* Partition the values: values below the pivot move to [0, *low), values above the pivot to [*high, count). Returns the
 * total weight of the values below the pivot, and adds the weight of the values equal to the pivot to *equal. */
static size_t partition(weighted *values, size_t count, double pivot, size_t *low, size_t *high, size_t *equal)
{
    size_t below = 0;
    *low = 0;
    *high = count;
    for (size_t i = 0; i < *high;) {
        if (values[i].value < pivot) {
            below += values[i].weight;
            swap_values(&values[i++], &values[(*low)++]);
        } else if (values[i].value > pivot) {
            swap_values(&values[i], &values[--*high]);
        } else {
            *equal += values[i++].weight;
        }
    }
    return below;
}

/* Quickselect: returns the value at a rank, counted from the smallest value. A value of weight w takes w ranks. Returns
 * the largest value if the rank is beyond the total weight. Reorders the values. Cost: O(count) on average. */
static double select_value(weighted *values, size_t count, size_t rank)
{
    uint64_t state = 1;
    for (;;) {
        size_t low, high, equal = 0;
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        const double pivot = values[(size_t)((double)(state >> 11) * 0x1p-53 * (double)count)].value;
        const size_t below = partition(values, count, pivot, &low, &high, &equal);
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

/* Find the 1st and the 99th percentile of values[which] over all samples. `room` is scratch memory for all samples. */
static void find_percentiles(const samples *s, int which, weighted *room, double *low, double *high)
{
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++)
        if (!isnan(s->items[i].values[which]))
            room[count++] = (weighted){s->items[i].values[which], 1};
    if (count == 0)
        return;
    *low = select_value(room, count, count / OUTLIERS);
    *high = select_value(room, count, count - 1 - count / OUTLIERS);
}

static double find_typical_spacing(const gathering *g, weighted *room)
{
    for (size_t i = 0; i < g->count; i++)
        room[i] = (weighted){g->leaves[i].spacing, g->leaves[i].count};
    const double spacing = select_value(room, g->count, g->points / 2);
    return isfinite(spacing) ? spacing : 0;
}

static point_scale measure_scale(const gathering *g, weighted *room)
{
    point_scale s = {.ids = {g->ids[0], g->ids[1]}};
    for (int axis = 0; axis < 3; axis++)
        find_percentiles(&g->samples, axis, room, &s.low[axis], &s.high[axis]);
    find_percentiles(&g->samples, 3, room, &s.intensities[0], &s.intensities[1]);
    s.spacing = find_typical_spacing(g, room);
    return s;
}

double point_scale_length_in_pixels(const camera *c, double length)
{
    return length * c->scale / c->size * 2 * c->zoom;
}

bool point_scale_compute(view *v, const octree *tree, const point_values *values)
{
    if (!view_paints_points(v) || v->point_scale.given)
        return true;
    gathering g = {.filter = &v->filter,
                   .world = octree_definition(tree).world,
                   .values = v->point_color == POINTS_BY_INTENSITY ? values : NULL};
    octree_walk(tree, gather_leaf, &g);
    const size_t count = g.count > g.samples.count ? g.count : g.samples.count;
    weighted *room = count ? malloc(count * sizeof *room) : NULL;
    const bool measured = !g.out_of_memory && (room || count == 0);
    v->point_scale.given = measured && g.count > 0;
    if (v->point_scale.given)
        v->point_scale.of = measure_scale(&g, room);
    free(room);
    free(g.leaves);
    free(g.samples.items);
    return measured;
}

const char *point_scale_missing_value(const view *v, const point_values *values)
{
    static const struct {
        view_point_color color;
        point_value_kind kind;
        const char *name;
    } rows[] = {{POINTS_BY_FILE, POINT_COLOR, "a colour"},
                {POINTS_BY_INTENSITY, POINT_INTENSITY, "an intensity"},
                {POINTS_BY_CLASS, POINT_CLASS, "a class"}};
    const unsigned kinds = point_values_kinds(values);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (v->point_color == rows[i].color && !(kinds >> rows[i].kind & 1))
            return rows[i].name;
    return NULL;
}
