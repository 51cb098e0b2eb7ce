/* SPDX-License-Identifier: MIT */
/* knob_nearest_epsilon.c - epsilon of nearest neighbours: a ratio of distances for time. */
#include <math.h>

#include "fixture.h"
#include "knob.h"
#include "neighbors.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "epsilon", NULL},
    {"asked", "targets", NULL},
    {"worst_ratio", "the worst distance / the true one (of the i-th found to the true i-th)", "bound_ratio"},
    {"mean_ratio", "the mean of it", NULL},
    {"bound_ratio", "proven: 1 + epsilon", NULL},
    {"recall", "share of the true neighbours that were found", NULL},
    {"ns", "processor nanoseconds a search", NULL},
    {"nodes", "nodes visited a search", NULL},
    {"points", "points compared a search", NULL},
};

static const chart charts[] = {
    {.title = "Worst answer", .x = "setting", .y = "worst_ratio", .bound = "bound_ratio"},
    {.title = "Neighbours that are the true ones", .x = "setting", .y = "recall"},
    {.title = "Time of a search", .x = "setting", .y = "ns", .y_log = true},
};

static const gain gains[] = {
    {"epsilon up to 2, one neighbour", {.variant = "k1", .setting = 0}, {.variant = "k1", .setting = NAN}, "ns"},
    {"epsilon up to 2, 8 neighbours", {.variant = "k8", .setting = 0}, {.variant = "k8", .setting = NAN}, "ns"},
};

static const double epsilons[] = {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2};
enum { EPSILONS = sizeof epsilons / sizeof epsilons[0] };

/* Rounded as 1 + epsilon is, where the excess is within its bound. */
static void add_row(table *t, const char *scene, const char *variant, double epsilon, const findings *f, double ns)
{
    const double asked = (double)f->asked;
    table_add(t, scene, variant,
              (double[]){epsilon, asked, 1 + f->worst, 1 + f->mean, 1 + epsilon, f->recall, ns / asked,
                         (double)f->cost.nodes / asked, (double)f->cost.points / asked});
}

static void measure_k(const run *r, table *t, workload *w, const octree *tree, size_t k, const char *variant)
{
    asking ways[EPSILONS];
    double ns[EPSILONS];
    for (int i = 0; i < EPSILONS; i++)
        ways[i] = (asking){.tree = tree, .load = w, .k = k, .how = {.epsilon = epsilons[i]}};
    time_in_turn(ask_all, ways, sizeof ways[0], EPSILONS, r->rounds, ns);
    for (int i = 0; i < EPSILONS; i++) {
        const findings f = judge_answers(&ways[i]);
        add_row(t, w->name, variant, epsilons[i], &f, ns[i]);
    }
}

/* ---- Pairs that come as near to the bound as doubles let them ------------------------------------------------ */

/* One point lies across a plane, as far from the target as its cell, and another with the target, 1 + epsilon times as
 * far, less a small part: nearest octant first, that one is found before the other's cell is judged. Parts below 2^-47
 * are within the slack for rounding, and the other's cell is entered. */
static void ask_pair(double epsilon, uint64_t *random, findings *f)
{
    const octree_def def = define(cube(-8, 8), 1, OCTREE_MAX_DEPTH, OCTREE_GROW);
    const double gap = ldexp(random_between(random, 0.5, 1), -(int)random_below(random, 30));
    const double part = ldexp(1, -30 - (int)random_below(random, 23));
    const double y = random_between(random, 0, 1), z = random_between(random, 0, 1);
    const double reach = gap * (1 + epsilon) * (random_below(random, 2) == 0 ? 1 - part : 1 + part);
    const octree_point pair[] = {{{-gap - reach, y, z}, 0}, {{0, y, z}, 1}};
    const double target[3] = {-gap, y, z};
    const octree_search how = {.epsilon = epsilon, .cost = &f->cost};
    octree_neighbor found;
    octree *tree;
    size_t count;
    must(octree_create(&def, &tree));
    must(octree_insert_many(tree, pair, 2, NULL, NULL));
    must(octree_nearest_k(tree, target, 1, &how, &found, &count));
    const double excess = excess_of(&how, &def.world, target, found.point.position, pair[1].position);
    f->asked++;
    f->worst = fmax(f->worst, excess);
    f->mean += excess;
    f->recall += excess == 0;
    octree_destroy(tree);
}

static void measure_pairs(const run *r, table *t)
{
    const size_t pairs = r->quick ? 300 : 20000;
    uint64_t random = 3;
    for (int i = 0; i < EPSILONS; i++) {
        findings f = {0};
        while (f.asked < pairs)
            ask_pair(epsilons[i], &random, &f);
        f.mean /= (double)pairs;
        f.recall /= (double)pairs;
        add_row(t, "pairs-at-the-bound", "pairs", epsilons[i], &f, NAN);
    }
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < r->loads->count; i++) {
        workload *w = &r->loads->of[i];
        octree *tree = workload_tree(w, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH);
        measure_k(r, t, w, tree, 1, "k1");
        measure_k(r, t, w, tree, TRUE_NEIGHBORS, "k8");
        octree_destroy(tree);
    }
    measure_pairs(r, t);
}

static void tell(const table *t, FILE *out)
{
    static const double told[] = {0.1, 0.5, 2};
    fputs("Exact is the default;", out);
    for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
        const pick exact = {.variant = "k1", .setting = 0}, near = {.variant = "k1", .setting = told[i]};
        fprintf(out, "%s at epsilon = %g the nearest point comes %.2f x faster (%.2f x fewer nodes), worst measured ",
                i == 0 ? "" : ";", told[i], table_ratio(t, exact, near, "ns"), table_ratio(t, exact, near, "nodes"));
        const pick eight = {.variant = "k8", .setting = told[i]}, pairs = {.variant = "pairs", .setting = told[i]};
        fprintf(out, "%.3f (%.4f on pairs made to be worst), proven %g",
                fmax(table_most(t, near, "worst_ratio"), table_most(t, eight, "worst_ratio")),
                table_most(t, pairs, "worst_ratio"), 1 + told[i]);
    }
    fputc('.', out);
}

static void defend(const table *t, FILE *out)
{
    const pick exact = {.variant = "k8", .setting = 0}, loose = {.variant = "k8", .setting = 0.1};
    const double recall = table_sum(t, loose, "recall") / (double)table_count(t, loose);
    fprintf(out,
            "0 is kept: of the time for 8 neighbours, 0.1 saves %.0f %% (median of the scenes), and it misses %.2g %% "
            "of them.",
            100 * (1 - table_ratio(t, loose, exact, "ns")), 100 * (1 - recall));
}

const knob knob_nearest_epsilon = {
    .name = "nearest-epsilon",
    .title = "Epsilon of nearest neighbours",
    .trades = "octree_search.epsilon for neighbours: time for the distance of what is found.",
    .preset = "0: exact",
    .proven = "The i-th distance is at most 1 + epsilon times the true i-th (octree_nearest_k).",
    .truth = "A scan of all points by long doubles with a proven error bound, and by whole numbers (GMP: exact) where "
             "that bound cannot tell. Whether a ratio is within its bound is decided the same way.",
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
