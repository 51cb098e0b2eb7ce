/* SPDX-License-Identifier: MIT */
/* knob_float.c - what would be lost if coordinates were floats, as in most point files and libraries: the tree keeps
 * doubles.
 */
#include <math.h>
#include <string.h>

#include "knob.h"
#include "quick_oracle.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "the largest coordinate: the world is a cube of side 1000 there", NULL},
    {"asked", "nearest points asked for", NULL},
    {"wrong", "answers that are not the true nearest point, ties to the lowest id", "bound_wrong"},
    {"wrong_per_million", "the same per million", NULL},
    {"merged", "points that have the place of another one, and had not before", "bound_merged"},
    {"worst_error", "the worst distance minus the true one, in units of the coordinates", "bound_error"},
    {"mean_error", "the mean of it", NULL},
    {"bound_error", "proven: 0, or 4 sqrt(3) of the largest rounding error of a coordinate", NULL},
    {"bound_wrong", "proven", NULL},
    {"bound_merged", "proven", NULL},
    {"ns", "processor nanoseconds a search", NULL},
    {"bytes", "of the three coordinates of a point", NULL},
};

static const chart charts[] = {
    {.title = "Worst answer", .x = "setting", .y = "worst_error", .bound = "bound_error", .x_log = true, .y_log = true},
    {.title = "Wrong answers", .x = "setting", .y = "wrong_per_million", .x_log = true},
};

static const gain gains[] = {
    {"coordinates in floats", {.variant = "doubles", .setting = NAN}, {.variant = "floats", .setting = NAN}, "ns"},
};

/* Through a volatile one: gcc 12 is known to drop the rounding of floats that lie side by side. */
static double rounded(double value)
{
    volatile float narrow = (float)value;
    return narrow;
}

static double largest_coordinate(const octree_box *world)
{
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = fmax(most, fmax(fabs(world->min[axis]), fabs(world->max[axis])));
    return most;
}

/* A coordinate moves by half the spacing of floats at most. A place then moves by sqrt(3) of that, a distance by twice
 * that, and of two distances compared the one may seem shorter by so much and the other longer. */
static double error_bound(const octree_box *world)
{
    const float most = (float)largest_coordinate(world);
    const double spacing = (double)nextafterf(most, INFINITY) - (double)most;
    return 4 * 1.7320508075688774 * spacing / 2;
}

static workload round_workload(const workload *w)
{
    workload narrow = *w;
    narrow.truth = NULL;
    narrow.points = resize_memory(NULL, w->count * sizeof *w->points);
    narrow.targets = resize_memory(NULL, w->target_count * sizeof *w->targets);
    for (int axis = 0; axis < 3; axis++) {
        for (size_t i = 0; i < w->count; i++)
            narrow.points[i].position[axis] = rounded(w->points[i].position[axis]);
        for (size_t i = 0; i < w->target_count; i++)
            narrow.targets[i][axis] = rounded(w->targets[i][axis]);
        narrow.world.min[axis] = fmin(rounded(w->world.min[axis]), w->world.min[axis]);
        narrow.world.max[axis] = fmax(rounded(w->world.max[axis]), w->world.max[axis]);
    }
    for (size_t i = 0; i < w->count; i++)
        narrow.points[i].id = w->points[i].id;
    return narrow;
}

static int by_position(const void *a, const void *b)
{
    const octree_point *p = a, *q = b;
    for (int axis = 0; axis < 3; axis++)
        if (p->position[axis] != q->position[axis])
            return p->position[axis] < q->position[axis] ? -1 : 1;
    return 0;
}

static size_t count_places(const workload *w)
{
    octree_point *sorted = resize_memory(NULL, w->count * sizeof *sorted);
    size_t places = 0;
    memcpy(sorted, w->points, w->count * sizeof *sorted);
    qsort(sorted, w->count, sizeof *sorted, by_position);
    for (size_t i = 0; i < w->count; i++)
        places += i == 0 || by_position(&sorted[i - 1], &sorted[i]) != 0;
    free(sorted);
    return places;
}

/* ---- One tree ----------------------------------------------------------------------------------------------- */

typedef struct asked {
    const octree *tree;
    const workload *load; /* as the tree has it */
    uint64_t *answers;
} asked;

static void find_all(void *contestant)
{
    asked *a = contestant;
    for (size_t i = 0; i < a->load->target_count; i++) {
        octree_neighbor found;
        must(octree_nearest(a->tree, a->load->targets[i], OCTREE_SKIP_NONE, 0, &found));
        a->answers[i] = found.point.id;
    }
}

/* How much farther a point is than another, in the coordinates as they were. */
static double farther(const double target[3], const double found[3], const double truth[3], double bound)
{
    long double distances[2] = {0, 0};
    for (int axis = 0; axis < 3; axis++) {
        const long double x = (long double)found[axis] - target[axis], y = (long double)truth[axis] - target[axis];
        distances[0] += x * x;
        distances[1] += y * y;
    }
    if (quick_compare(target, found, truth) == 0)
        return 0;
    const double more = (double)(sqrtl(distances[0]) - sqrtl(distances[1]));
    return quick_compare_longer(target, found, truth, bound) <= 0 ? fmin(more, bound)
                                                                  : fmax(more, nextafter(bound, INFINITY));
}

static void add_row(table *t, workload *w, const asked *a, bool narrow, double ns)
{
    const true_neighbors *truth = workload_truth(w);
    const double bound = narrow ? error_bound(&w->world) : 0, count = (double)w->target_count;
    const size_t merged = narrow ? count_places(w) - count_places(a->load) : 0;
    size_t wrong = 0;
    double worst = 0, sum = 0;
    for (size_t i = 0; i < w->target_count; i++) {
        const double more = farther(w->targets[i], w->points[a->answers[i]].position, truth[i][0]->position, bound);
        wrong += a->answers[i] != truth[i][0]->id;
        worst = fmax(worst, more);
        sum += more;
    }
    table_add(t, w->name, narrow ? "floats" : "doubles",
              (double[]){largest_coordinate(&w->world), count, (double)wrong, 1e6 * (double)wrong / count,
                         (double)merged, worst, sum / count, bound, narrow ? NAN : 0, narrow ? NAN : 0, ns / count,
                         narrow ? 3 * sizeof(float) : 3 * sizeof(double)});
}

static void measure_scene(const run *r, table *t, workload *w)
{
    workload narrow = round_workload(w);
    uint64_t *answers[] = {resize_memory(NULL, w->target_count * sizeof *answers[0]),
                           resize_memory(NULL, w->target_count * sizeof *answers[0])};
    octree *trees[] = {workload_tree(w, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH),
                       workload_tree(&narrow, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH)};
    asked ways[] = {{trees[0], w, answers[0]}, {trees[1], &narrow, answers[1]}};
    double ns[2];
    time_in_turn(find_all, ways, sizeof ways[0], 2, r->rounds, ns);
    for (int i = 0; i < 2; i++) {
        add_row(t, w, &ways[i], i == 1, ns[i]);
        octree_destroy(trees[i]);
        free(answers[i]);
    }
    workload_free(&narrow);
}

static void measure(const run *r, table *t)
{
    static const double offsets[] = {0, 1e3, 1e6, 1e12};
    static const octree_sample_kind kinds[] = {OCTREE_SAMPLE_UNIFORM, OCTREE_SAMPLE_CLUSTERED};
    const size_t points = r->loads->of[0].count, targets = r->loads->of[0].target_count;
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < sizeof offsets / sizeof offsets[0]; j++) {
            const double low = offsets[j], high = low + 1000;
            const octree_box world = {{low, low, low}, {high, high, high}};
            workload w = workload_sample(octree_sample_name(kinds[i]), kinds[i], world, points, targets);
            measure_scene(r, t, &w);
            workload_free(&w);
        }
    for (size_t i = 0; i < r->loads->count; i++)
        if (strcmp(r->loads->of[i].name, "cloud") == 0)
            measure_scene(r, t, &r->loads->of[i]);
}

static void tell(const table *t, FILE *out)
{
    const pick doubles = {.variant = "doubles", .setting = NAN};
    fprintf(
        out,
        "Doubles are what the tree keeps; they cost 12 bytes a point more than floats would, and were wrong in %.0f "
        "of %.0f answers",
        table_sum(t, doubles, "wrong"), table_sum(t, doubles, "asked"));
    static const double told[] = {1000, 1e6 + 1000, 1e12 + 1000};
    static const char *const names[] = {"about 0", "at 1e6 (UTM)", "at 1e12"};
    for (size_t i = 0; i < 3; i++) {
        const pick at = {.variant = "floats", .setting = told[i]};
        fprintf(out, "%s floats %s were wrong in up to %.0f per million, worst measured error %.2g, proven %.2g",
                i == 0 ? ";" : ",", names[i], table_most(t, at, "wrong_per_million"), table_most(t, at, "worst_error"),
                table_most(t, at, "bound_error"));
    }
    fputc('.', out);
}

static void defend(const table *t, FILE *out)
{
    const pick utm = {.variant = "floats", .setting = 1e6 + 1000};
    fprintf(out,
            "Doubles are kept: 12 bytes a point less would make up to %.1f %% of the answers wrong at UTM coordinates.",
            1e-4 * table_most(t, utm, "wrong_per_million"));
}

const knob knob_float = {
    .name = "float",
    .title = "Doubles, or coordinates rounded to float on the way in",
    .trades = "The caller's choice before the tree: 12 bytes a point for answers about places that have moved.",
    .preset = "doubles: there are no others",
    .proven =
        "Doubles: no wrong answer. Floats: what is found is at most 4 sqrt(3) half-spacings of floats farther than "
        "the true nearest; which point it is, is not bounded.",
    .truth = "A scan of all points in doubles as they were before rounding, by long doubles and whole numbers (GMP: "
             "exact).",
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
