/* SPDX-License-Identifier: MIT */
/* workload.c - the workload, the same for every tree: one set of points, changes to it, and targets of queries. */
#include "workload.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { QUERIES_AT_MOST = 100000, SIZING_QUERIES = 200, SEED = 1 };

static const octree_box bench_world = {.min = {-1000, -1000, -1000}, .max = {1000, 1000, 1000}};
static const double bench_side = 2000;

static size_t common_divisor(size_t a, size_t b)
{
    while (b) {
        const size_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static void shuffle(octree_point *points, size_t count, uint64_t *random)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = (size_t)(octree_random(random) % i);
        const octree_point swapped = points[i - 1];
        points[i - 1] = points[j];
        points[j] = swapped;
    }
}

/* In steps that meet each point once and have nothing to do with the order of insertion. */
static void pick_points(workload *w)
{
    size_t step = (size_t)(0.618 * (double)w->count) + 1;
    while (common_divisor(step, w->count) != 1)
        step++;
    for (size_t i = 0, at = 0; i < w->count; i++, at = (at + step) % w->count)
        w->picks[i] = w->points[at];
}

static octree_point step_away(const octree_point *from, double length, uint64_t *random)
{
    double way[3], square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; axis++) {
            way[axis] = 2 * octree_random_unit(random) - 1;
            square += way[axis] * way[axis];
        }
    } while (square > 1 || square < 0.01);
    octree_point to = *from;
    for (int axis = 0; axis < 3; axis++) {
        const double x = from->position[axis] + length * way[axis] / sqrt(square);
        to.position[axis] = fmin(fmax(x, bench_world.min[axis]), bench_world.max[axis]);
    }
    return to;
}

octree_point workload_step(const workload *w, const octree_point *from, uint64_t *random)
{
    return step_away(from, bench_side / cbrt((double)w->count), random);
}

static void place_targets(workload *w, const double (*rows)[3], uint64_t *random)
{
    for (size_t i = 0; i < w->query_count; i++) {
        w->near[i] = workload_step(w, &w->picks[i], random);
        w->far[i].id = w->picks[i].id;
        w->stored[i].size = w->targets[i].size = 0;
        memcpy(w->far[i].position, rows[i], sizeof rows[i]);
        memcpy(w->targets[i].at, rows[i], sizeof rows[i]);
        memcpy(w->stored[i].at, w->picks[i].position, sizeof rows[i]);
    }
}

/* Points and targets come from one sample, so that clusters are where they are for both. */
static bool sample_rows(const workload *w, double (*rows)[3])
{
    const size_t n = w->count, q = w->query_count;
    if (w->set != OCTREE_SAMPLE_LATTICE)
        return octree_sample(w->set, SEED, &w->world, n + q, rows) == OCTREE_OK;
    return octree_sample(w->set, SEED, &w->world, n, rows) == OCTREE_OK &&
           octree_sample(OCTREE_SAMPLE_UNIFORM, SEED, &w->world, q, rows + n) == OCTREE_OK;
}

static bool allocate(workload *w)
{
    w->points = malloc(w->count * sizeof *w->points);
    w->picks = malloc(w->count * sizeof *w->picks);
    w->near = malloc(w->query_count * sizeof *w->near);
    w->far = malloc(w->query_count * sizeof *w->far);
    w->stored = malloc(w->query_count * sizeof *w->stored);
    w->targets = malloc(w->query_count * sizeof *w->targets);
    return w->points && w->picks && w->near && w->far && w->stored && w->targets;
}

bool workload_make(workload *w, octree_sample_kind set, size_t count)
{
    *w = (workload){.set = set, .world = bench_world, .count = count, .half = count / 2};
    w->query_count = w->half < QUERIES_AT_MOST ? w->half : QUERIES_AT_MOST;
    double(*rows)[3] = malloc((count + w->query_count) * sizeof *rows);
    if (!rows || !allocate(w) || !sample_rows(w, rows)) {
        free(rows);
        workload_free(w);
        return false;
    }
    uint64_t random = SEED;
    for (size_t i = 0; i < count; i++)
        memcpy(w->points[i].position, rows[i], sizeof rows[i]);
    shuffle(w->points, count, &random);
    for (size_t i = 0; i < count; i++)
        w->points[i].id = i;
    pick_points(w);
    place_targets(w, (const double(*)[3])(rows + count), &random);
    free(rows);
    return true;
}

void workload_free(workload *w)
{
    free(w->points);
    free(w->picks);
    free(w->near);
    free(w->far);
    free(w->stored);
    free(w->targets);
    *w = (workload){0};
}

static void set_size(workload *w, double size)
{
    for (size_t i = 0; i < w->query_count; i++)
        w->targets[i].size = size;
}

static double mean_hits(workload *w, const void *tree, peer_ask ask, double size)
{
    peer_answer answers[SIZING_QUERIES];
    const size_t count = w->query_count < SIZING_QUERIES ? w->query_count : SIZING_QUERIES;
    size_t hits = 0;
    set_size(w, size);
    ask(tree, w->targets, count, answers);
    for (size_t i = 0; i < count; i++)
        hits += answers[i].count;
    return (double)hits / (double)count;
}

bool workload_size_targets(workload *w, peer_ask_kind kind, size_t hits)
{
    const peer_ask ask = peer_octree.ask[kind];
    const double wanted = (double)(hits < w->count / 2 ? hits : w->count / 2);
    void *tree = peer_octree.create(&w->world);
    if (!tree || peer_octree.change[PEER_BUILD](tree, w->points, NULL, w->count) != w->count) {
        peer_octree.destroy(tree);
        return false;
    }
    double low = 0, high = bench_side / cbrt((double)w->count) / 8;
    while (mean_hits(w, tree, ask, high) < wanted) {
        low = high;
        high *= 2;
    }
    for (int i = 0; i < 20; i++) {
        const double middle = low + (high - low) / 2;
        *(mean_hits(w, tree, ask, middle) < wanted ? &low : &high) = middle;
    }
    set_size(w, high);
    peer_octree.destroy(tree);
    return true;
}
