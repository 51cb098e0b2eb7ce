/* SPDX-License-Identifier: MIT */
/* knob_range_epsilon.c - epsilon of boxes and balls: points too many for time. */
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "knob.h"
#include "quick_oracle.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "epsilon / half the box's side, or / the ball's radius", NULL},
    {"asked", "ranges", NULL},
    {"hits", "points truly in a range, mean", NULL},
    {"missed", "points that are in a range and were not visited, or visited twice", "0"},
    {"extra", "points visited that are not in the range / points in it", NULL},
    {"worst_outside", "farthest visited outside / half the side, or / the radius", "bound_outside"},
    {"bound_outside", "proven: epsilon", NULL},
    {"ns", "processor nanoseconds a range", NULL},
    {"nodes", "nodes visited a range", NULL},
    {"points", "points compared one by one a range", NULL},
};

static const chart charts[] = {
    {.title = "Farthest point outside", .x = "setting", .y = "worst_outside", .bound = "bound_outside"},
    {.title = "Points outside", .x = "setting", .y = "extra"},
    {.title = "Time of a range", .x = "setting", .y = "ns", .y_log = true},
};

static const gain gains[] = {
    {"epsilon of boxes", {.variant = "box", .setting = 0}, {.variant = "box", .setting = NAN}, "ns"},
    {"epsilon of balls", {.variant = "ball", .setting = 0}, {.variant = "ball", .setting = NAN}, "ns"},
};

static const double settings[] = {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
enum { SETTINGS = sizeof settings / sizeof settings[0], HITS = 1000 };

typedef enum shape { BOX, BALL } shape;
static const char *const names[] = {"box", "ball"};

/* All ranges of a workload with one epsilon. */
typedef struct asking_ranges {
    const octree *tree;
    const workload *load;
    const double *sizes; /* of each target's range: half the side, or the radius */
    size_t count;
    shape shape;
    double setting;
} asking_ranges;

static octree_box box_of(const double center[3], double size)
{
    octree_box box;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = center[axis] - size;
        box.max[axis] = center[axis] + size;
    }
    return box;
}

static void ask(const asking_ranges *a, size_t i, octree_cost *cost, octree_point_visitor visit, void *context)
{
    const octree_search how = {.epsilon = a->setting * a->sizes[i], .cost = cost};
    const octree_box box = box_of(a->load->targets[i], a->sizes[i]);
    if (a->shape == BOX)
        must(octree_range_search(a->tree, &box, &how, visit, context));
    else
        must(octree_radius(a->tree, a->load->targets[i], a->sizes[i], &how, visit, context));
}

static bool count_one(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

static void ask_ranges(void *contestant)
{
    size_t hits = 0;
    const asking_ranges *a = contestant;
    for (size_t i = 0; i < a->count; i++)
        ask(a, i, NULL, count_one, &hits);
}

/* ---- Judging ------------------------------------------------------------------------------------------------ */

static bool is_in(const asking_ranges *a, size_t i, const double at[3])
{
    const octree_box box = box_of(a->load->targets[i], a->sizes[i]);
    return a->shape == BOX ? box_holds(&box, at) : quick_compare_radius(a->load->targets[i], at, a->sizes[i], 0) <= 0;
}

/* Whether a point is at most epsilon outside, in real numbers. */
static bool is_near(const asking_ranges *a, size_t i, const double at[3], double epsilon)
{
    if (a->shape == BALL)
        return quick_compare_radius(a->load->targets[i], at, a->sizes[i], epsilon) <= 0;
    const octree_box box = box_of(a->load->targets[i], a->sizes[i]);
    for (int axis = 0; axis < 3; axis++)
        if ((at[axis] < box.min[axis] && !quick_within(box.min[axis], epsilon, at[axis])) ||
            (at[axis] > box.max[axis] && !quick_within(box.max[axis], epsilon, at[axis])))
            return false;
    return true;
}

/* How far outside, as a share of the size. */
static double outside_of(const asking_ranges *a, size_t i, const double at[3])
{
    const octree_box box = box_of(a->load->targets[i], a->sizes[i]);
    long double most = 0, square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const long double off = (long double)at[axis] - a->load->targets[i][axis];
        most = fmaxl(most, fmaxl((long double)box.min[axis] - at[axis], (long double)at[axis] - box.max[axis]));
        square += off * off;
    }
    const long double outside = a->shape == BOX ? most : sqrtl(square) - a->sizes[i];
    const double share = (double)(outside / a->sizes[i]);
    return is_near(a, i, at, a->setting * a->sizes[i]) ? fmin(share, a->setting)
                                                       : fmax(share, nextafter(a->setting, INFINITY));
}

typedef struct judging {
    const asking_ranges *asking;
    size_t range;
    uint32_t *stamps; /* of each point: the range that it was visited by last, plus 1 */
    size_t inside, extra, twice;
    double worst;
} judging;

static bool judge(const octree_point *point, void *context)
{
    judging *j = context;
    j->twice += j->stamps[point->id] == j->range + 1;
    j->stamps[point->id] = (uint32_t)(j->range + 1);
    if (is_in(j->asking, j->range, point->position)) {
        j->inside++;
    } else {
        j->extra++;
        j->worst = fmax(j->worst, outside_of(j->asking, j->range, point->position));
    }
    return true;
}

static size_t count_true(const asking_ranges *a, size_t i)
{
    size_t count = 0;
    for (size_t p = 0; p < a->load->count; p++)
        count += is_in(a, i, a->load->points[p].position);
    return count;
}

static void add_row(table *t, const asking_ranges *a, const size_t *truth, double ns)
{
    octree_cost cost = {0};
    judging j = {.asking = a, .stamps = resize_memory(NULL, a->load->count * sizeof *j.stamps)};
    size_t hits = 0;
    memset(j.stamps, 0, a->load->count * sizeof *j.stamps);
    for (j.range = 0; j.range < a->count; j.range++) {
        ask(a, j.range, &cost, judge, &j);
        hits += truth[j.range];
    }
    const double asked = (double)a->count;
    table_add(t, a->load->name, names[a->shape],
              (double[]){a->setting, asked, (double)hits / asked, (double)(hits - j.inside) + 2 * (double)j.twice,
                         (double)j.extra / (double)hits, j.worst, a->setting, ns / asked, (double)cost.nodes / asked,
                         (double)cost.points / asked});
    free(j.stamps);
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

/* About each target the ball with HITS points, and the cube as large. */
static double *size_ranges(const octree *tree, const workload *w, size_t count, shape shape)
{
    octree_neighbor found[HITS];
    double *sizes = resize_memory(NULL, count * sizeof *sizes);
    for (size_t i = 0, hits; i < count; i++) {
        must(octree_nearest_k(tree, w->targets[i], w->count / 8 < HITS ? w->count / 8 : HITS, NULL, found, &hits));
        sizes[i] = found[hits - 1].distance * (shape == BOX ? 0.806 : 1);
    }
    return sizes;
}

static void measure_shape(const run *r, table *t, const workload *w, const octree *tree, shape shape)
{
    const size_t most = r->quick ? 40 : 400, count = w->target_count < most ? w->target_count : most;
    double *sizes = size_ranges(tree, w, count, shape), ns[SETTINGS];
    size_t *truth = resize_memory(NULL, count * sizeof *truth);
    asking_ranges ways[SETTINGS];
    for (size_t i = 0; i < SETTINGS; i++)
        ways[i] = (asking_ranges){tree, w, sizes, count, shape, settings[i]};
    for (size_t i = 0; i < count; i++)
        truth[i] = count_true(&ways[0], i);
    time_in_turn(ask_ranges, ways, sizeof ways[0], SETTINGS, r->rounds, ns);
    for (size_t i = 0; i < SETTINGS; i++)
        add_row(t, &ways[i], truth, ns[i]);
    free(sizes);
    free(truth);
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < r->loads->count; i++) {
        const workload *w = &r->loads->of[i];
        octree *tree = workload_tree(w, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH);
        measure_shape(r, t, w, tree, BOX);
        measure_shape(r, t, w, tree, BALL);
        octree_destroy(tree);
    }
}

static void tell_shape(const table *t, const char *shape, double setting, FILE *out)
{
    const pick exact = {.variant = shape, .setting = 0}, loose = {.variant = shape, .setting = setting};
    fprintf(out,
            "%s are found %.2f x faster (%.2f x fewer points compared), %.0f %% too many at most, worst measured %.3g "
            "outside, "
            "proven %g",
            shape[1] == 'o' ? "boxes" : "balls", table_ratio(t, exact, loose, "ns"),
            table_ratio(t, exact, loose, "points"), 100 * table_most(t, loose, "extra"),
            table_most(t, loose, "worst_outside"), setting);
}

static void tell(const table *t, FILE *out)
{
    fputs("Exact is the default; with epsilon = 0.1 of the size ", out);
    tell_shape(t, "box", 0.1, out);
    fputs("; ", out);
    tell_shape(t, "ball", 0.1, out);
    double hits = 0;
    for (size_t i = 0; i < t->count; i++)
        hits += table_value(t, &t->rows[i], "hits") * table_value(t, &t->rows[i], "asked");
    fprintf(out, "; missed at any epsilon: %.0f of %.0f points.", table_sum(t, (pick){.setting = NAN}, "missed"), hits);
}

static void defend(const table *t, FILE *out)
{
    const pick box[] = {{.variant = "box", .setting = 0}, {.variant = "box", .setting = 0.1}};
    const pick ball[] = {{.variant = "ball", .setting = 0}, {.variant = "ball", .setting = 0.1}};
    fprintf(
        out,
        "0 is kept: a tenth of the size saves %.0f %% of the time of boxes and %.0f %% of that of balls (medians of "
        "the scenes), for up to %.0f %% points too many.",
        100 * (1 - table_ratio(t, box[1], box[0], "ns")), 100 * (1 - table_ratio(t, ball[1], ball[0], "ns")),
        100 * fmax(table_most(t, box[1], "extra"), table_most(t, ball[1], "extra")));
}

const knob knob_range_epsilon = {
    .name = "range-epsilon",
    .title = "Epsilon of boxes and balls",
    .trades = "octree_search.epsilon for ranges: time for points that are a little outside.",
    .preset = "0: exact",
    .proven = "Nothing in the range is missed, and nothing is visited that is farther than epsilon outside it "
              "(octree_range_search, octree_radius).",
    .truth = "A scan of all points: comparisons of doubles for boxes, which are exact; long doubles and whole numbers "
             "(GMP) for balls and for epsilon.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .gains = gains,
    .gain_count = sizeof gains / sizeof gains[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
