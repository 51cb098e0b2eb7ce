/* SPDX-License-Identifier: MIT */
/* knob_mode.c - exact against FAST: what decides between distances that doubles cannot tell apart. */
#include <math.h>

#include "knob.h"
#include "mirrored.h"
#include "neighbors.h"
#include "octree/octree.h"
#include "timing.h"
#include "program.h"

static const column columns[] = {
    {"setting", "0 exact, 1 FAST", NULL},
    {"asked", "nearest points asked for", NULL},
    {"wrong", "answers that are not the true nearest point, ties to the lowest id", "bound_wrong"},
    {"wrong_per_million", "the same per million", NULL},
    {"worst_excess", "the worst distance / the true one, - 1", "bound_excess"},
    {"mean_excess", "the mean of it", NULL},
    {"bound_excess", "proven", NULL},
    {"bound_wrong", "proven", NULL},
    {"ns", "processor nanoseconds a search", NULL},
    {"nodes", "nodes visited a search", NULL},
    {"points", "points compared a search", NULL},
};

static const chart charts[] = {
    {.title = "Worst answer", .x = "setting", .y = "worst_excess", .bound = "bound_excess", .y_log = true},
    {.title = "Time of a search", .x = "setting", .y = "ns"},
};

static const gain gains[] = {
    {"OCTREE_FAST, one neighbour", {.variant = "exact", .setting = 0}, {.variant = "fast", .setting = 1}, "ns"},
};

static const char *const names[] = {"exact", "fast"};

static void add_row(table *t, const char *scene, const octree_search *how, const findings *f, double ns)
{
    const double asked = (double)f->asked;
    const bool exact = how->mode == OCTREE_EXACT;
    const double values[] = {how->mode,
                             asked,
                             (double)f->wrong,
                             1e6 * (double)f->wrong / asked,
                             f->worst,
                             f->mean,
                             promised_excess(how),
                             exact ? 0 : NAN,
                             ns / asked,
                             (double)f->cost.nodes / asked,
                             (double)f->cost.points / asked};
    table_add(t, scene, names[how->mode], values);
}

static void add_findings(findings *sum, const findings *f)
{
    sum->asked += f->asked;
    sum->wrong += f->wrong;
    sum->worst = fmax(sum->worst, f->worst);
    sum->mean += f->mean;
    sum->cost.nodes += f->cost.nodes;
    sum->cost.points += f->cost.points;
}

/* A tree a target: too small to be timed. */
static void measure_mirrored(const run *r, table *t)
{
    const size_t trees = r->quick ? 300 : 20000;
    const octree_search how[2] = {{.mode = OCTREE_EXACT}, {.mode = OCTREE_FAST}};
    findings sums[2] = {{0}};
    uint64_t random = 9;
    for (size_t i = 0; i < trees; i++) {
        workload w = mirrored_make("mirrored", &random);
        octree *tree = workload_tree(&w, 4, OCTREE_MAX_DEPTH);
        for (int j = 0; j < 2; j++) {
            const findings f = judge_answers(&(asking){.tree = tree, .load = &w, .k = 1, .how = how[j]});
            add_findings(&sums[j], &f);
        }
        octree_destroy(tree);
        workload_free(&w);
    }
    for (int j = 0; j < 2; j++) {
        sums[j].mean /= (double)trees;
        add_row(t, "mirrored", &how[j], &sums[j], NAN);
    }
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < r->loads->count; i++) {
        workload *w = &r->loads->of[i];
        octree *tree = workload_tree(w, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH);
        asking ways[] = {{.tree = tree, .load = w, .k = 1},
                         {.tree = tree, .load = w, .k = 1, .how = {.mode = OCTREE_FAST}}};
        double ns[2];
        time_in_turn(ask_all, ways, sizeof ways[0], 2, 3 * r->rounds, ns);
        for (size_t j = 0; j < 2; j++) {
            const findings f = judge_answers(&ways[j]);
            add_row(t, w->name, &ways[j].how, &f, ns[j]);
        }
        octree_destroy(tree);
    }
    measure_mirrored(r, t);
}

static const row *worst_row(const table *t)
{
    const row *worst = NULL;
    for (size_t i = 0; i < t->count; i++)
        if (!worst || table_value(t, &t->rows[i], "wrong_per_million") > table_value(t, worst, "wrong_per_million"))
            worst = &t->rows[i];
    return worst;
}

static void tell(const table *t, FILE *out)
{
    const pick exact = {.variant = "exact", .setting = NAN}, fast = {.variant = "fast", .setting = NAN};
    const ratio cost = table_ratios(t, exact, fast, "ns");
    const row *worst = worst_row(t);
    fprintf(
        out,
        "Exact is the default; it costs %.0f %% (median of the scenes; most on %s, %.0f %%) and was wrong in %.0f of "
        "%.0f answers; FAST was wrong in %.0f of them, most often on %s (%.0f per million), worst measured excess "
        "of a distance %.2g, proven %.2g.",
        100 * (cost.median - 1), cost.scene, 100 * (cost.most - 1), table_sum(t, exact, "wrong"),
        table_sum(t, exact, "asked"), table_sum(t, fast, "wrong"), worst->scene,
        table_value(t, worst, "wrong_per_million"), table_most(t, fast, "worst_excess"),
        table_most(t, fast, "bound_excess"));
}

static void defend(const table *t, FILE *out)
{
    const pick exact = {.variant = "exact", .setting = NAN}, fast = {.variant = "fast", .setting = NAN};
    fprintf(
        out,
        "Exact is kept: FAST saves %.0f %% of the time (median of the scenes), and of near ties it gets %.0f %% wrong.",
        100 * (1 - table_ratio(t, fast, exact, "ns")), 1e-4 * table_most(t, fast, "wrong_per_million"));
}

const knob knob_mode = {
    .name = "mode",
    .title = "Exact or FAST nearest neighbours",
    .trades = "octree_search.mode: time for the certainty that it is the true nearest point that is named.",
    .preset = "OCTREE_EXACT",
    .proven =
        "Exact: the true minimum of the real distance, ties to the lowest id. FAST: at most 1 + 2^-50 times the true "
        "distance (or 2^-490 of the world's extent more).",
    .truth = "A scan of all points by long doubles with a proven error bound, and by whole numbers (GMP: exact) where "
             "that bound cannot tell; ties to the lowest id.",
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
