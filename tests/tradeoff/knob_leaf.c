/* SPDX-License-Identifier: MIT */
/* knob_leaf.c - leaf capacity, greatest depth and AUTO: time for memory, and one operation for another. */
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "knob.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "leaf capacity; greatest depth; the capacity that AUTO chose", NULL},
    {"build_ns", "processor nanoseconds a point of a bulk build", NULL},
    {"change_ns", "of a removal or an insertion", NULL},
    {"nearest_ns", "of a nearest point", NULL},
    {"range_ns", "of a box of about 10 points", NULL},
    {"mix_ns", "of the three together: the default mix", NULL},
    {"nearest_nodes", "nodes visited by a search for the nearest", NULL},
    {"nearest_points", "points compared by it", NULL},
    {"bytes", "bytes of memory a point", NULL},
    {"nodes", "nodes a thousand points", NULL},
    {"depth", "of the deepest node", NULL},
    {"unlike", "answers that differ from those of the default", "0"},
};

static const chart charts[] = {
    {.title = "Time of an operation", .x = "setting", .y = "mix_ns", .x_log = true, .y_log = true},
    {.title = "Memory", .x = "setting", .y = "bytes", .x_log = true},
};

static const gain gains[] = {
    {"leaf capacity instead of 64",
     {.variant = "capacity", .setting = 64},
     {.variant = "capacity", .setting = NAN},
     "mix_ns"},
    {"a lower greatest depth",
     {.variant = "depth", .setting = OCTREE_MAX_DEPTH},
     {.variant = "depth", .setting = NAN},
     "mix_ns"},
};

static const size_t capacities[] = {64, 1, 2, 4, 8, 16, 32, 128, 256}; /* the default first: the others must agree */
static const size_t depths[] = {4, 5, 6, 7, 8, 10, 14, 21};
enum {
    CAPACITIES = sizeof capacities / sizeof capacities[0],
    DEPTHS = sizeof depths / sizeof depths[0],
    TREES = CAPACITIES + DEPTHS + 1
};

/* One tree of one scene. */
typedef struct trial {
    const workload *load;
    const char *variant;
    size_t capacity, depth;
    const double *extents; /* of each target: half the side of its box */
    octree *tree;
    uint64_t *nearest; /* the answers */
    size_t *hits;
} trial;

static void build(void *contestant)
{
    trial *u = contestant;
    octree_destroy(u->tree);
    u->tree = workload_tree(u->load, u->capacity, u->depth);
}

/* As many as targets, where there are so many points. */
static size_t count_changes(const workload *w)
{
    return w->count < w->target_count ? w->count : w->target_count;
}

static void change(void *contestant)
{
    trial *u = contestant;
    const size_t count = count_changes(u->load), step = u->load->count / count;
    for (size_t i = 0; i < count; i++) {
        const octree_point *p = &u->load->points[i * step];
        must(octree_remove(u->tree, p->position, p->id));
    }
    for (size_t i = 0; i < count; i++) {
        const octree_point *p = &u->load->points[i * step];
        must(octree_insert(u->tree, p->position, p->id));
    }
}

static void find_nearest(void *contestant)
{
    trial *u = contestant;
    for (size_t i = 0; i < u->load->target_count; i++) {
        octree_neighbor found;
        must(octree_nearest(u->tree, u->load->targets[i], OCTREE_SKIP_NONE, 0, &found));
        u->nearest[i] = found.point.id;
    }
}

static bool count_one(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

static void find_ranges(void *contestant)
{
    trial *u = contestant;
    for (size_t i = 0; i < u->load->target_count; i++) {
        octree_box box;
        u->hits[i] = 0;
        must(octree_collision_box(u->load->targets[i], u->extents[i], &box));
        must(octree_range(u->tree, &box, count_one, &u->hits[i]));
    }
}

/* ---- One scene ---------------------------------------------------------------------------------------------- */

static double *size_ranges(const workload *w)
{
    double *extents = resize_memory(NULL, w->target_count * sizeof *extents);
    octree *tree = workload_tree(w, 16, OCTREE_MAX_DEPTH);
    for (size_t i = 0; i < w->target_count; i++) {
        octree_neighbor found[10];
        size_t count;
        must(octree_nearest_k(tree, w->targets[i], 10, NULL, found, &count));
        extents[i] = 0.806 * found[count - 1].distance;
    }
    octree_destroy(tree);
    return extents;
}

static void begin(trial *trials, const workload *w, const double *extents)
{
    for (size_t i = 0; i < TREES; i++) {
        trial *u = &trials[i];
        *u = (trial){
            .load = w, .extents = extents, .capacity = octree_def_default().leaf_capacity, .depth = OCTREE_MAX_DEPTH};
        u->variant = i < CAPACITIES ? "capacity" : i < CAPACITIES + DEPTHS ? "depth" : "auto";
        if (i < CAPACITIES)
            u->capacity = capacities[i];
        else if (i < CAPACITIES + DEPTHS)
            u->depth = depths[i - CAPACITIES];
        else
            u->capacity = OCTREE_AUTO;
        u->nearest = resize_memory(NULL, w->target_count * sizeof *u->nearest);
        u->hits = resize_memory(NULL, w->target_count * sizeof *u->hits);
    }
}

static void end(trial *trials)
{
    for (size_t i = 0; i < TREES; i++) {
        octree_destroy(trials[i].tree);
        free(trials[i].nearest);
        free(trials[i].hits);
    }
}

static octree_cost count_cost(const trial *u)
{
    octree_cost cost = {0};
    for (size_t i = 0; i < u->load->target_count; i++) {
        octree_neighbor found;
        size_t count;
        must(octree_nearest_k(u->tree, u->load->targets[i], 1, &(octree_search){.cost = &cost}, &found, &count));
    }
    return cost;
}

static size_t count_unlike(const trial *u, const trial *other)
{
    size_t unlike = 0;
    for (size_t i = 0; i < u->load->target_count; i++)
        unlike += u->nearest[i] != other->nearest[i] || u->hits[i] != other->hits[i];
    return unlike;
}

/* Times of all trees by kind of work. */
typedef struct times {
    double build[TREES], change[TREES], nearest[TREES], range[TREES];
} times;

static void add_row(table *t, const trial *trials, size_t i, const times *ns)
{
    const trial *u = &trials[i];
    octree_stats stats;
    must(octree_statistics(u->tree, &stats));
    const octree_cost cost = count_cost(u);
    const double n = (double)u->load->count, asked = (double)u->load->target_count;
    const size_t setting =
        i >= CAPACITIES && i < CAPACITIES + DEPTHS ? u->depth : octree_definition(u->tree).leaf_capacity;
    const double change_ns = ns->change[i] / (double)count_changes(u->load) / 2;
    const double mix = (change_ns + ns->nearest[i] / asked + ns->range[i] / asked) / 3;
    table_add(t, u->load->name, u->variant,
              (double[]){(double)setting, ns->build[i] / n, change_ns, ns->nearest[i] / asked, ns->range[i] / asked,
                         mix, (double)cost.nodes / asked, (double)cost.points / asked, (double)stats.memory / n,
                         1000 * (double)stats.nodes / n, stats.depth, (double)count_unlike(u, &trials[0])});
}

static void measure_scene(const run *r, table *t, const workload *w)
{
    trial trials[TREES];
    times ns;
    double *extents = size_ranges(w);
    begin(trials, w, extents);
    time_in_turn(build, trials, sizeof trials[0], TREES, r->rounds, ns.build);
    time_in_turn(find_nearest, trials, sizeof trials[0], TREES, r->rounds, ns.nearest);
    time_in_turn(find_ranges, trials, sizeof trials[0], TREES, r->rounds, ns.range);
    time_in_turn(change, trials, sizeof trials[0], TREES, r->rounds, ns.change);
    for (size_t i = 0; i < TREES; i++)
        add_row(t, trials, i, &ns);
    end(trials);
    free(extents);
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < r->loads->count; i++)
        if (r->loads->of[i].ordinary)
            measure_scene(r, t, &r->loads->of[i]);
}

static size_t best_capacity(const table *t, double *least)
{
    size_t best = octree_def_default().leaf_capacity;
    const pick preset = {.variant = "capacity", .setting = (double)best};
    *least = 1;
    for (size_t i = 0; i < CAPACITIES; i++) {
        const double to_preset =
            table_ratio(t, (pick){.variant = "capacity", .setting = (double)capacities[i]}, preset, "mix_ns");
        if (to_preset < *least) {
            *least = to_preset;
            best = capacities[i];
        }
    }
    return best;
}

static void tell(const table *t, FILE *out)
{
    double least;
    const size_t best = best_capacity(t, &least);
    const size_t usual = octree_def_default().leaf_capacity;
    const pick preset = {.variant = "capacity", .setting = (double)usual},
               automatic = {.variant = "auto", .setting = NAN};
    const double count = (double)table_count(t, preset);
    fprintf(out,
            "No setting changes an answer (%.0f unlike); %zu points a leaf is the default: over the mix of changes, "
            "nearest points and ranges ",
            table_sum(t, (pick){.setting = NAN}, "unlike"), usual);
    if (best == usual)
        fputs("no other fixed capacity is faster", out);
    else
        fprintf(out, "it costs %.1f %% more than the best fixed one, %zu", 100 * (1 / least - 1), best);
    fprintf(out, ", with %.1f bytes a point; AUTO takes %.2f of its time, capacity 1 %.2f and %.1f bytes.",
            table_sum(t, preset, "bytes") / count, table_ratio(t, automatic, preset, "mix_ns"),
            table_ratio(t, (pick){.variant = "capacity", .setting = 1}, preset, "mix_ns"),
            table_sum(t, (pick){.variant = "capacity", .setting = 1}, "bytes") / count);
}

static void defend(const table *t, FILE *out)
{
    const pick deepest = {.variant = "depth", .setting = OCTREE_MAX_DEPTH};
    double least;
    const size_t best = best_capacity(t, &least);
    ratio shallow = {.median = INFINITY};
    for (size_t i = 0; i < DEPTHS; i++) {
        const ratio r = table_ratios(t, (pick){.variant = "depth", .setting = (double)depths[i]}, deepest, "mix_ns");
        shallow.median = fmin(shallow.median, r.median);
        shallow.most = fmax(shallow.most, r.most);
    }
    fprintf(out,
            "64 is %s: %zu is the fastest fixed capacity over the mix. Depth 21 is kept: a lower limit saves at most "
            "%.0f %% (median of the scenes; where no leaf is that deep, it is noise) and takes up to %.1f x the time.",
            best == octree_def_default().leaf_capacity ? "kept" : "not the best", best, 100 * (1 - shallow.median),
            shallow.most);
}

const knob knob_leaf = {
    .name = "leaf",
    .title = "Leaf capacity, greatest depth, AUTO",
    .trades = "octree_def.leaf_capacity, .max_depth: few large leaves for many small ones. No answer depends on it.",
    .preset = "64 points, depth 21; OCTREE_AUTO chooses by what the default mix would visit",
    .proven = "For the same contents capacity and depth never change an answer: nothing unlike.",
    .truth = "The answers of the tree with the default capacity.",
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
