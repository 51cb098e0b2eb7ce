/* SPDX-License-Identifier: MIT */
/* knob_index.c - which index: queries per second against errors, for Octreel and for other libraries, over their
 * epsilons and leaf capacities.
 *
 * A scene of this chapter is "points / query / order of the targets". A variant is an index. All indexes of a scene are
 * built from the same points, and answer the same queries in turn. */
#include <math.h>
#include <string.h>

#include "index.h"
#include "answer_error.h"
#include "knob.h"
#include "measuring.h"
#include "program.h"
#include "timing.h"

static const column columns[] = {
    {"setting", "epsilon as the library defines it; for \"octreel leaves\", the points of a leaf", NULL},
    {"recall", "share of the true neighbours, or of the points in the region, that were found", NULL},
    {"worst_ratio", "the largest distance found / the true one of the same rank", NULL},
    {"mean_ratio", "the mean of it", NULL},
    {"extra", "points found outside of a region / points in it", NULL},
    {"per_second", "queries a second", NULL},
    {"spread", "of the time: the range of the middle half of the rounds / the median", NULL},
    {"build_ns", "nanoseconds a point to build the index", NULL},
};

static const chart charts[] = {
    {.title = "Queries a second against recall",
     .x = "recall",
     .x_label = "share of the true answer that is found",
     .y = "per_second",
     .y_label = "queries a second",
     .y_log = true,
     .by_variant = true},
    {.title = "Queries a second against the worst answer",
     .x = "worst_ratio",
     .x_label = "worst distance / true distance",
     .y = "per_second",
     .y_label = "queries a second",
     .y_log = true,
     .by_variant = true},
    {.title = "Queries a second against the mean answer",
     .x = "mean_ratio",
     .x_label = "mean distance / true distance",
     .y = "per_second",
     .y_label = "queries a second",
     .y_log = true,
     .by_variant = true},
};

static const double epsilons[] = {0, 0.1, 0.5, 1, 2, 4};
static const size_t capacities[] = {8, 16, 32, 128};
enum {
    EPSILONS = sizeof epsilons / sizeof epsilons[0],
    CAPACITIES = sizeof capacities / sizeof capacities[0],
    IDS = 4096,    /* room for an answer */
    REGIONS = 200, /* balls and boxes whose answers are compared */
    BUILDS_MOST = 32
};

/* An index that was built of a scene's points. */
typedef struct built {
    const spatial_index *index;
    const char *name;
    void *self;
    size_t capacity; /* 0: the library's default */
    double build_ns; /* a point */
} built;

/* One way to answer all queries of a scene. */
typedef struct contestant {
    const built *built;
    double setting;
    octree_query *queries;
    size_t count;
} contestant;

static void answer_all(void *context)
{
    static uint64_t ids[IDS];
    const contestant *c = context;
    const spatial_index *index = c->built->index;
    for (size_t i = 0; i < c->count; i++)
        if (index->ask(c->built->self, &c->queries[i], ids, IDS) == INDEX_REFUSED)
            stop_with_error("%s refuses a query", index->name);
}

/* ---- The queries -------------------------------------------------------------------------------------------- */

/* A row of the orders and kinds that are measured. */
typedef struct asking_kind {
    const char *name;
    octree_query_kind kind;
    size_t k;
} asking_kind;

static const asking_kind asking_kinds[] = {
    {"nearest", OCTREE_QUERY_NEAREST, 1},
    {"8 nearest", OCTREE_QUERY_KNEAREST, TRUE_NEIGHBORS},
    {"ball", OCTREE_QUERY_RADIUS, 0},
    {"box", OCTREE_QUERY_RANGE, 0},
};

/* Balls and boxes reach as far as the eighth neighbour. */
static octree_query make_query(const workload *w, size_t target, const asking_kind *kind, double epsilon)
{
    octree_query query = {.kind = kind->kind, .k = kind->k, .epsilon = epsilon};
    const double *at = w->targets[target], *eighth = w->truth[target][TRUE_NEIGHBORS - 1]->position;
    memcpy(query.target, at, sizeof query.target);
    query.radius = hypot(hypot(at[0] - eighth[0], at[1] - eighth[1]), at[2] - eighth[2]);
    for (int axis = 0; axis < 3; axis++) {
        query.box.min[axis] = at[axis] - query.radius;
        query.box.max[axis] = at[axis] + query.radius;
    }
    return query;
}

/* A place on a Morton curve through the world. */
typedef struct ordered_target {
    uint64_t code;
    size_t target;
} ordered_target;

static int compare_codes(const void *a, const void *b)
{
    const ordered_target *c = a, *d = b;
    return c->code != d->code ? (c->code > d->code) - (c->code < d->code)
                              : (c->target > d->target) - (c->target < d->target);
}

static uint64_t code_of(const workload *w, const double at[3])
{
    uint64_t code = 0, cells[3];
    for (int axis = 0; axis < 3; axis++) {
        const double low = w->world.min[axis], side = w->world.max[axis] - low;
        cells[axis] = (uint64_t)((at[axis] - low) / side * 0x1FFFFF);
    }
    for (int bit = 20; bit >= 0; bit--)
        for (int axis = 2; axis >= 0; axis--)
            code = code << 1 | (cells[axis] >> bit & 1);
    return code;
}

/* The targets' numbers in the order in which they are asked. */
static ordered_target *order_targets(const workload *w, bool sorted)
{
    ordered_target *order = resize_memory(NULL, w->target_count * sizeof *order);
    for (size_t i = 0; i < w->target_count; i++)
        order[i] = (ordered_target){sorted ? code_of(w, w->targets[i]) : 0, i};
    qsort(order, w->target_count, sizeof *order, compare_codes);
    return order;
}

/* ---- Judging ------------------------------------------------------------------------------------------------ */

typedef struct findings {
    size_t expected, missing, extra, unknown;
    double worst, sum;
} findings;

static findings judge(const workload *w, const contestant *c, const ordered_target *order)
{
    static uint64_t ids[IDS];
    findings f = {.worst = 1};
    const bool neighbors = octree_query_about(c->queries[0].kind)->neighbors;
    const size_t count = neighbors || c->count < REGIONS ? c->count : REGIONS;
    for (size_t i = 0; i < count; i++) {
        const size_t found = c->built->index->ask(c->built->self, &c->queries[i], ids, IDS);
        if (found > IDS)
            stop_with_error("%s found %zu points", c->built->name, found);
        const answer_error e = find_answer_error(&c->queries[i], w->points, w->count, ids, found,
                                                 neighbors ? w->truth[order[i].target] : NULL);
        f.expected += e.expected;
        f.missing += e.missing;
        f.extra += e.extra + e.unknown;
        f.worst = fmax(f.worst, e.ratio);
        f.sum += e.ratio_sum;
    }
    return f;
}

static void add_row(table *t, const char *scene, const contestant *c, const findings *f, double ns, double spread)
{
    const double expected = (double)f->expected;
    const bool neighbors = octree_query_about(c->queries[0].kind)->neighbors;
    table_add(t, scene, c->built->name,
              (double[]){c->setting, 1 - (double)f->missing / expected, neighbors ? f->worst : NAN,
                         neighbors ? f->sum / expected : NAN, (double)f->extra / expected, 1e9 * (double)c->count / ns,
                         spread, c->built->build_ns});
}

/* ---- A scene ------------------------------------------------------------------------------------------------ */

/* Add a way to answer each target's query. */
static void add_contestant(contestant *all, size_t *count, const workload *w, const ordered_target *order,
                           const built *b, const asking_kind *kind, double epsilon)
{
    contestant *c = &all[(*count)++];
    *c = (contestant){.built = b, .setting = b->capacity ? (double)b->capacity : epsilon, .count = w->target_count};
    c->queries = resize_memory(NULL, c->count * sizeof *c->queries);
    for (size_t i = 0; i < c->count; i++)
        c->queries[i] = make_query(w, order[i].target, kind, epsilon);
}

static void measure_kind(const run *r, table *t, const workload *w, const built *all, size_t built_count,
                         const asking_kind *kind, bool sorted)
{
    static contestant contestants[CONTESTANTS_AT_MOST];
    double ns[CONTESTANTS_AT_MOST], spread[CONTESTANTS_AT_MOST];
    char scene[TABLE_NAME];
    size_t count = 0;
    ordered_target *order = order_targets(w, sorted);
    snprintf(scene, sizeof scene, "%s / %s / %s", w->name, kind->name, sorted ? "sorted" : "random");
    /* Each index follows another one, so that all find cold caches. */
    for (int i = 0; i < EPSILONS; i++)
        for (const built *b = all; b < all + built_count; b++) {
            const bool swept = b->index->approximates && !b->capacity && octree_query_about(kind->kind)->neighbors;
            if ((b->index->kinds >> kind->kind & 1) && (i == 0 || swept))
                add_contestant(contestants, &count, w, order, b, kind, epsilons[i]);
        }
    time_with_spread(answer_all, contestants, sizeof contestants[0], count, r->rounds, ns, spread);
    for (size_t i = 0; i < count; i++) {
        const findings f = judge(w, &contestants[i], order);
        add_row(t, scene, &contestants[i], &f, ns[i], spread[i]);
        free(contestants[i].queries);
    }
    free(order);
}

static void build(built *all, size_t *count, const workload *w, const spatial_index *index, const char *name,
                  size_t capacity)
{
    if (*count == BUILDS_MOST)
        stop_with_error("there are too many indexes");
    built *b = &all[(*count)++];
    const double start = processor_time();
    *b = (built){.index = index, .name = name, .capacity = capacity};
    b->self = index->create(w->points, w->count, &w->world, capacity);
    b->build_ns = (processor_time() - start) / (double)w->count;
    if (!b->self)
        stop_with_error("%s refuses the points of %s", name, w->name);
}

static void measure_scene(const run *r, table *t, workload *w)
{
    built all[BUILDS_MOST];
    size_t count = 0;
    workload_truth(w);
    for (size_t i = 0; all_indexes[i]; i++)
        build(all, &count, w, all_indexes[i], all_indexes[i]->name, 0);
    for (size_t i = 0; i < CAPACITIES; i++)
        build(all, &count, w, &index_octreel, "octreel leaves", capacities[i]);
    for (size_t i = 0; i < sizeof asking_kinds / sizeof asking_kinds[0]; i++)
        for (int sorted = 0; sorted < 2; sorted++)
            measure_kind(r, t, w, all, count, &asking_kinds[i], sorted == 1);
    for (size_t i = 0; i < count; i++)
        all[i].index->destroy(all[i].self);
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < r->loads->count; i++)
        if (r->loads->of[i].ordinary || strcmp(r->loads->of[i].name, "lattice") == 0)
            measure_scene(r, t, &r->loads->of[i]);
}

/* ---- In a sentence ------------------------------------------------------------------------------------------ */

/* The most queries a second of other libraries in a scene, each with its smallest error; 0 if there is none. */
static double best_other(const table *t, const char *scene)
{
    double best = 0;
    for (size_t i = 0; i < t->count; i++)
        if (strcmp(t->rows[i].scene, scene) == 0 && strncmp(t->rows[i].variant, "octreel", 7) != 0 &&
            t->rows[i].values[0] == 0)
            best = fmax(best, table_value(t, &t->rows[i], "per_second"));
    return best;
}

/* Compare exact answers with the best of the others, in all scenes of a kind of query. */
static void tell_lead(const table *t, const char *kind, bool first, FILE *out)
{
    double ratios[64], least = INFINITY, most = 0;
    size_t count = 0;
    for (size_t i = 0; i < t->count; i++) {
        const row *r = &t->rows[i];
        if (strcmp(r->variant, "octreel") != 0 || r->values[0] != 0 || !strstr(r->scene, kind))
            continue;
        const double other = best_other(t, r->scene);
        if (other == 0 || count == sizeof ratios / sizeof ratios[0])
            continue;
        ratios[count] = table_value(t, r, "per_second") / other;
        least = fmin(least, ratios[count]);
        most = fmax(most, ratios[count++]);
    }
    if (count > 0)
        fprintf(out, "%s %s %.2f (%.2f to %.2f)", first ? "" : ",", kind + 2, median(ratios, count), least, most);
}

static void tell(const table *t, FILE *out)
{
    const pick exact = {.variant = "octreel", .setting = 0}, near = {.variant = "octreel", .setting = 1};
    fputs(
        "Speed relative to the fastest other library in each scene (above 1: Octreel is faster), as the median of the "
        "scenes, with the range in brackets:",
        out);
    for (size_t i = 0; i < sizeof asking_kinds / sizeof asking_kinds[0]; i++) {
        char kind[32];
        snprintf(kind, sizeof kind, "/ %s", asking_kinds[i].name);
        tell_lead(t, kind, i == 0, out);
    }
    fprintf(out,
            ". Approximate answers: with epsilon = 1 (a neighbour may be up to twice as far as the true one), Octreel "
            "is %.2f times as fast as "
            "with exact answers, and %.1f %% of its neighbours are still the true ones.",
            table_ratio(t, near, exact, "per_second"),
            100 * table_sum(t, near, "recall") / (double)table_count(t, near));
}

static void defend(const table *t, FILE *out)
{
    size_t wrong = 0, answered = 0;
    for (size_t i = 0; i < t->count; i++)
        if (strncmp(t->rows[i].variant, "octreel", 7) == 0 &&
            (t->rows[i].values[0] == 0 || strcmp(t->rows[i].variant, "octreel leaves") == 0)) {
            answered++;
            wrong += table_value(t, &t->rows[i], "recall") < 1 || table_value(t, &t->rows[i], "extra") > 0;
        }
    fprintf(out, "Without epsilon, %zu of %zu rows of Octreel have a wrong answer.", wrong, answered);
}

const knob knob_index = {
    .name = "index",
    .title = "Which index: queries a second against errors",
    .trades = "The choice of a library, of its epsilon, and of points in float or double.",
    .preset = "epsilon 0 everywhere, and each library's own leaf capacity",
    .proven =
        "Octreel: no wrong answer at epsilon 0, and at most 1 + epsilon times the true distance. Libraries define "
        "epsilon in different ways: some apply it to the squares of distances.",
    .truth = "A scan of all points by long doubles with a proven error bound, and by whole numbers (GMP: exact) where "
             "that bound does not decide. Points at equal distances are equally right. Of balls and boxes the first "
             "200 are compared.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
