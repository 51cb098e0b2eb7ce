/* SPDX-License-Identifier: MIT */
/* inspect_advice.c - measures which leaf capacity and which epsilon make searches faster.
 *
 * A target is a place whose neighbours are searched. Most programs search near their points, so each target is a random
 * point of the cloud, moved by up to the distance of its eighth neighbour. An approximate answer (epsilon above 0) is
 * compared with the tree's exact answer. Each time is the median of several rounds, in processor time. Differences
 * below a tenth are noise on most machines, so they change no advice. */
#include "inspect_advice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "array.h"
#include "octree/octree.h"
#include "octree/sample.h"
#include "text.h"

enum { TARGETS = 10000, EIGHT = 8, ROUNDS = 5 };

#define WORTH 1.1 /* a setting is advised only if it makes searches at least this many times as fast */

/* The input of all measurements. */
typedef struct bench {
    const octree *tree;
    octree_point *points;
    size_t count;
    double (*targets)[3];
    octree_neighbor (*truth)[EIGHT]; /* truth[i]: the exact nearest neighbours of targets[i] */
} bench;

static double processor_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

/* ---- The targets -------------------------------------------------------------------------------------------- */

/* Choose a place near a random point of the cloud: the point, moved along each axis by up to the distance of its eighth
 * neighbour. */
static void choose_target(const bench *b, uint64_t *random, double target[3])
{
    const octree_point *p = &b->points[octree_random(random) % b->count];
    octree_neighbor near[EIGHT + 1];
    size_t count;
    memcpy(target, p->position, sizeof p->position);
    if (octree_nearest_k(b->tree, target, EIGHT + 1, NULL, near, &count) != OCTREE_OK || count == 0)
        return;
    for (int axis = 0; axis < 3; axis++)
        target[axis] += (2 * octree_random_unit(random) - 1) * near[count - 1].distance;
}

static void bench_release(bench *b)
{
    free(b->points);
    free(b->targets);
    free(b->truth);
}

static bool bench_prepare(bench *b, const octree *tree)
{
    const octree_box world = octree_definition(tree).world;
    uint64_t random = 1;
    *b = (bench){.tree = tree, .count = octree_count(tree)};
    b->points = malloc(b->count * sizeof *b->points);
    b->targets = malloc(TARGETS * sizeof *b->targets);
    b->truth = malloc(TARGETS * sizeof *b->truth);
    if (!b->points || !b->targets || !b->truth ||
        octree_range_collect(tree, &world, NULL, b->points, b->count, &b->count) != OCTREE_OK)
        return false;
    for (int i = 0; i < TARGETS; i++) {
        size_t found;
        choose_target(b, &random, b->targets[i]);
        if (octree_nearest_k(tree, b->targets[i], EIGHT, NULL, b->truth[i], &found) != OCTREE_OK)
            return false;
    }
    return true;
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

/* Returns the nanoseconds of one search for k neighbours: the mean over all targets. */
static double measure_round_ns(const octree *tree, const bench *b, size_t k, double epsilon)
{
    const octree_search how = {.epsilon = epsilon};
    octree_neighbor found[EIGHT];
    size_t count;
    const double start = processor_ns();
    for (int i = 0; i < TARGETS; i++)
        octree_nearest_k(tree, b->targets[i], k, &how, found, &count);
    return (processor_ns() - start) / TARGETS;
}

static double find_median(double rounds[ROUNDS])
{
    qsort(rounds, ROUNDS, sizeof *rounds, compare_float64);
    return rounds[ROUNDS / 2];
}

static double measure_search_ns(const octree *tree, const bench *b, size_t k)
{
    double rounds[ROUNDS];
    for (int round = 0; round < ROUNDS; round++)
        rounds[round] = measure_round_ns(tree, b, k, 0);
    return find_median(rounds);
}

/* Measure all epsilons in each round, so that a busy machine slows all of them alike. */
static void measure_epsilon_times(const bench *b, epsilon_row rows[ADVICE_EPSILONS])
{
    double rounds[ADVICE_EPSILONS][ROUNDS];
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < ADVICE_EPSILONS; i++)
            rounds[i][round] = measure_round_ns(b->tree, b, EIGHT, rows[i].epsilon);
    for (int i = 0; i < ADVICE_EPSILONS; i++)
        rows[i].eight_ns = find_median(rounds[i]);
}

static bool measure_capacity(const bench *b, capacity_row *row)
{
    octree_def def = octree_definition(b->tree);
    octree_stats stats;
    octree *tree;
    def.leaf_capacity = row->capacity;
    if (octree_create(&def, &tree) != OCTREE_OK)
        return false;
    const double start = processor_ns();
    bool ok = octree_insert_many(tree, b->points, b->count, NULL, NULL) != OCTREE_NO_MEMORY;
    row->build_ns = (processor_ns() - start) / (double)b->count;
    ok = ok && octree_statistics(tree, &stats) == OCTREE_OK;
    if (ok) {
        row->bytes = (double)stats.memory / (double)b->count;
        row->one_ns = measure_search_ns(tree, b, 1);
        row->eight_ns = measure_search_ns(tree, b, EIGHT);
    }
    octree_destroy(tree);
    return ok;
}

static void measure_accuracy(const bench *b, epsilon_row *row)
{
    const octree_search how = {.epsilon = row->epsilon};
    size_t ranks = 0, right = 0, count;
    row->worst_ratio = 1;
    for (int i = 0; i < TARGETS; i++) {
        octree_neighbor found[EIGHT];
        octree_nearest_k(b->tree, b->targets[i], EIGHT, &how, found, &count);
        for (size_t rank = 0; rank < count; rank++) {
            const double truth = b->truth[i][rank].distance;
            const double ratio = found[rank].distance > truth ? found[rank].distance / truth : 1;
            ranks++;
            right += ratio == 1;
            row->mean_ratio += ratio;
            row->worst_ratio = ratio > row->worst_ratio ? ratio : row->worst_ratio;
        }
    }
    row->mean_ratio /= (double)ranks;
    row->true_share = (double)right / (double)ranks;
}

/* Returns the time of one search for the nearest point plus one for the 8 nearest points. */
static double sum_search_ns(const capacity_row *row)
{
    return row->one_ns + row->eight_ns;
}

static void choose_advice(inspect_advice *a, size_t present)
{
    const capacity_row *best = &a->capacities[0], *own = NULL;
    for (int i = 0; i < ADVICE_CAPACITIES; i++) {
        best = sum_search_ns(&a->capacities[i]) < sum_search_ns(best) ? &a->capacities[i] : best;
        own = a->capacities[i].capacity == present ? &a->capacities[i] : own;
    }
    a->capacity = own && sum_search_ns(own) < WORTH * sum_search_ns(best) ? present : best->capacity;
    for (int i = ADVICE_EPSILONS - 1; i > 0; i--)
        if (a->epsilons[i].eight_ns * WORTH < a->epsilons[0].eight_ns)
            a->epsilon = a->epsilons[i].epsilon;
}

/* Set the capacities to measure: powers of two. The tree's own capacity replaces the one that is closest to it. */
static void choose_capacities(inspect_advice *a, size_t present)
{
    static const size_t capacities[ADVICE_CAPACITIES] = {8, 16, 32, 64, 128, 256};
    int nearest = 0;
    for (int i = 0; i < ADVICE_CAPACITIES; i++) {
        a->capacities[i].capacity = capacities[i];
        if (fabs(log((double)capacities[i] / (double)present)) <
            fabs(log((double)capacities[nearest] / (double)present)))
            nearest = i;
    }
    a->capacities[nearest].capacity = present;
}

static bool measure_all(const bench *b, const watcher *watch, inspect_advice *a)
{
    static const double epsilons[ADVICE_EPSILONS] = {0, 0.1, 0.5, 1, 2};
    for (int i = 0; i < ADVICE_CAPACITIES; i++) {
        if (!measure_capacity(b, &a->capacities[i]))
            return false;
        watcher_report(watch, (uint64_t)i + 1, ADVICE_CAPACITIES);
    }
    for (int i = 0; i < ADVICE_EPSILONS; i++) {
        a->epsilons[i].epsilon = epsilons[i];
        measure_accuracy(b, &a->epsilons[i]);
    }
    measure_epsilon_times(b, a->epsilons);
    return true;
}

bool inspect_advise(const inspection *i, const watcher *watch, inspect_advice *advice, octreel_error *error)
{
    const size_t present = octree_definition(i->tree).leaf_capacity;
    bench b;
    *advice = (inspect_advice){.queries = TARGETS};
    if (octree_count(i->tree) < ADVICE_LEAST_POINTS)
        return error_set(error, "--advise needs at least %d points in the tree; it has %zu", ADVICE_LEAST_POINTS,
                         octree_count(i->tree));
    choose_capacities(advice, present);
    const bool ok = bench_prepare(&b, i->tree) && measure_all(&b, watch, advice);
    bench_release(&b);
    choose_advice(advice, present);
    return ok || error_set(error, "out of memory");
}

/* ---- Printing ----------------------------------------------------------------------------------------------- */

static void print_advice_sentence(const inspect_advice *a, size_t present, FILE *out)
{
    if (a->capacity == present)
        fprintf(out, "advice: keep capacity %zu, because no other capacity saves a tenth of the time", present);
    else
        fprintf(out, "advice: --capacity %zu", a->capacity);
    if (a->epsilon == 0) {
        fputs("; epsilon saves less than a tenth of the time, so use exact searches (epsilon 0)\n", out);
        return;
    }
    for (int i = 0; i < ADVICE_EPSILONS; i++)
        if (a->epsilons[i].epsilon == a->epsilon)
            fprintf(out,
                    "; if errors are allowed, epsilon %g finds the 8 nearest points %.2f times as fast, and %.1f %% of "
                    "them are the true neighbours\n",
                    a->epsilon, a->epsilons[0].eight_ns / a->epsilons[i].eight_ns, 100 * a->epsilons[i].true_share);
}

static void print_text(const inspect_advice *a, const inspection *i, const char *name, FILE *out)
{
    const size_t present = octree_definition(i->tree).leaf_capacity;
    inspect_print_name(name, out);
    fprintf(out, "%zu searches near %zu points, processor time of one core\n", a->queries, octree_count(i->tree));
    fputs("  capacity  build ns/point  nearest ns  8 nearest ns  bytes/point\n", out);
    for (int row = 0; row < ADVICE_CAPACITIES; row++) {
        const capacity_row *c = &a->capacities[row];
        fprintf(out, "%c %8zu  %14.1f  %10.0f  %12.0f  %11.1f\n", c->capacity == present ? '*' : ' ', c->capacity,
                c->build_ns, c->one_ns, c->eight_ns, c->bytes);
    }
    fputs("   epsilon  8 nearest ns  true ones  mean distance / true  worst\n", out);
    for (int row = 0; row < ADVICE_EPSILONS; row++) {
        const epsilon_row *e = &a->epsilons[row];
        fprintf(out, "%10g  %12.0f  %7.2f %%  %20.4f  %5.2f\n", e->epsilon, e->eight_ns, 100 * e->true_share,
                e->mean_ratio, e->worst_ratio);
    }
    print_advice_sentence(a, present, out);
}

static void write_json(const inspect_advice *a, const inspection *i, const char *name, FILE *out)
{
    json_writer w = {.out = out};
    json_write_begin_object(&w);
    json_write_text_member(&w, "cloud", name);
    json_write_integer_member(&w, "points", octree_count(i->tree));
    json_write_integer_member(&w, "searches", a->queries);
    json_begin_array_member(&w, "capacities");
    for (int row = 0; row < ADVICE_CAPACITIES; row++) {
        const capacity_row *c = &a->capacities[row];
        json_write_begin_object(&w);
        json_write_integer_member(&w, "capacity", c->capacity);
        json_write_number_member(&w, "build_ns", c->build_ns);
        json_write_number_member(&w, "nearest_ns", c->one_ns);
        json_write_number_member(&w, "eight_nearest_ns", c->eight_ns);
        json_write_number_member(&w, "bytes", c->bytes);
        json_write_end_object(&w);
    }
    json_write_end_array(&w);
    json_begin_array_member(&w, "epsilons");
    for (int row = 0; row < ADVICE_EPSILONS; row++) {
        const epsilon_row *e = &a->epsilons[row];
        json_write_begin_object(&w);
        json_write_number_member(&w, "epsilon", e->epsilon);
        json_write_number_member(&w, "eight_nearest_ns", e->eight_ns);
        json_write_number_member(&w, "true_share", e->true_share);
        json_write_number_member(&w, "mean_ratio", e->mean_ratio);
        json_write_number_member(&w, "worst_ratio", e->worst_ratio);
        json_write_end_object(&w);
    }
    json_write_end_array(&w);
    json_write_integer_member(&w, "capacity", a->capacity);
    json_write_number_member(&w, "epsilon", a->epsilon);
    json_write_end_object(&w);
    fputc('\n', out);
}

void inspect_print_advice(const inspect_advice *advice, const inspection *i, const char *name, bool json, FILE *out)
{
    if (json)
        write_json(advice, i, name, out);
    else
        print_text(advice, i, name, out);
}
