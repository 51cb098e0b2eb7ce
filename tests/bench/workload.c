/* SPDX-License-Identifier: MIT */
/* workload.c - the workload, the same for every tree: one set of points, changes to it, and targets of queries. */
#include "workload.h"
#include "program.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUERIES_AT_MOST = 100000, SORTED = 50000, SIZING_QUERIES = 200, SEED = 1 };

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
static bool sample_rows(const workload *w, octree_sample_kind set, const point_file *file, double (*rows)[3])
{
    const size_t n = w->count, q = w->query_count;
    if (file)
        memcpy(rows, file->rows, (n + q) * sizeof *rows);
    if (file || set != OCTREE_SAMPLE_LATTICE)
        return file || octree_sample(set, SEED, &w->world, n + q, rows) == OCTREE_OK;
    return octree_sample(set, SEED, &w->world, n, rows) == OCTREE_OK &&
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
    w->sorted = malloc(w->query_count * sizeof *w->sorted);
    return w->points && w->picks && w->near && w->far && w->stored && w->targets && w->sorted;
}

/* The Morton code of a place on a grid of 2^21 cells a side. */
static uint64_t code_of(const peer_query *query)
{
    uint64_t code = 0, cells[3];
    for (int axis = 0; axis < 3; axis++)
        cells[axis] = (uint64_t)((query->at[axis] - bench_world.min[axis]) / bench_side * (1 << 21));
    for (int bit = 20; bit >= 0; bit--)
        for (int axis = 2; axis >= 0; axis--)
            code = code << 1 | (cells[axis] >> bit & 1);
    return code;
}

static int compare_codes(const void *a, const void *b)
{
    const uint64_t c = code_of(a), d = code_of(b);
    return (c > d) - (c < d);
}

/* Sort as many targets as operations ask for at least, so that every operation asks for all of them. */
static void sort_targets(workload *w)
{
    memcpy(w->sorted, w->targets, w->query_count * sizeof *w->sorted);
    qsort(w->sorted, w->query_count < SORTED ? w->query_count : SORTED, sizeof *w->sorted, compare_codes);
}

static void read_rows(FILE *in, point_file *file)
{
    char line[512];
    double at[3];
    size_t room = 0;
    while (fgets(line, sizeof line, in)) {
        if (sscanf(line, "%lf%*[ ,;\t]%lf%*[ ,;\t]%lf", &at[0], &at[1], &at[2]) != 3)
            continue; /* a header */
        if (file->count == room)
            file->rows = resize_memory(file->rows, (room = 2 * room + 1024) * sizeof *file->rows);
        memcpy(file->rows[file->count++], at, sizeof at);
    }
}

static void shuffle_rows(double (*rows)[3], size_t count)
{
    uint64_t random = SEED;
    for (size_t i = count; i > 1; i--) {
        const size_t j = (size_t)(octree_random(&random) % i);
        double kept[3];
        memcpy(kept, rows[i - 1], sizeof kept);
        memcpy(rows[i - 1], rows[j], sizeof kept);
        memcpy(rows[j], kept, sizeof kept);
    }
}

/* Scale rows to nearly the whole world of the bench. */
static void scale_rows(double (*rows)[3], size_t count)
{
    double min[3] = {INFINITY, INFINITY, INFINITY}, side = 0;
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            min[axis] = fmin(min[axis], rows[i][axis]);
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            side = fmax(side, rows[i][axis] - min[axis]);
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            rows[i][axis] = bench_world.min[axis] + (rows[i][axis] - min[axis]) / side * bench_side * 0.999;
}

point_file read_point_file(const char *path)
{
    const char *slash = strrchr(path, '/');
    point_file file = {.name = slash ? slash + 1 : path};
    FILE *in = fopen(path, "r");
    if (!in)
        stop_with_error("%s: %s", path, strerror(errno));
    read_rows(in, &file);
    fclose(in);
    if (file.count < POINTS_AT_LEAST)
        stop_with_error("%s: %zu lines begin with three numbers; at least %d are needed", path, file.count,
                        POINTS_AT_LEAST);
    shuffle_rows(file.rows, file.count);
    scale_rows(file.rows, file.count);
    return file;
}

bool workload_make(workload *w, octree_sample_kind set, const point_file *file, size_t count)
{
    *w = (workload){.name = file ? file->name : octree_sample_name(set), .world = bench_world};
    w->count = file && count > file->count / 3 * 2 ? file->count / 3 * 2 : count;
    w->half = w->count / 2;
    count = w->count;
    w->query_count = w->half < QUERIES_AT_MOST ? w->half : QUERIES_AT_MOST;
    double(*rows)[3] = malloc((count + w->query_count) * sizeof *rows);
    if (!rows || !allocate(w) || !sample_rows(w, set, file, rows)) {
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
    sort_targets(w);
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
    free(w->sorted);
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
