/* SPDX-License-Identifier: MIT */
/* peer_grid.c - the structure that a game would use if everything moves: a uniform grid of doubles, rebuilt each tick
 * by one counting sort, with about two points in a cell. It is neither made slow on purpose nor optimized: distances
 * are rounded, and ties fall either way. */
#include "peer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct grid {
    octree_box world;
    size_t side, count; /* cells on an axis, points */
    double per_unit[3], extent[3];
    uint32_t *starts; /* of each cell in the points, x slowest, and their end */
    uint32_t *cells;  /* of each point, while it is built */
    octree_point *points;
} grid;

static void *create(const octree_box *world)
{
    grid *g = calloc(1, sizeof *g);
    if (g)
        g->world = *world;
    return g;
}

static void destroy(void *self)
{
    grid *g = self;
    if (!g)
        return;
    free(g->starts);
    free(g->cells);
    free(g->points);
    free(g);
}

static size_t memory(const void *self)
{
    const grid *g = self;
    return (g->side * g->side * g->side + 1 + g->count) * sizeof(uint32_t) + g->count * sizeof(octree_point);
}

static size_t clamp(const grid *g, double at)
{
    return at > 0 ? at < (double)g->side ? (size_t)at : g->side - 1 : 0;
}

static size_t slice_of(const grid *g, int axis, double x)
{
    return clamp(g, (x - g->world.min[axis]) * g->per_unit[axis]);
}

static size_t cell_at(const grid *g, size_t x, size_t y, size_t z)
{
    return (x * g->side + y) * g->side + z;
}

/* The memory is kept from one tick to the next. */
static bool make_room(grid *g, size_t count)
{
    if (g->points && g->count == count)
        return true;
    g->count = count;
    g->side = (size_t)cbrt((double)count / 2) + 1;
    for (int axis = 0; axis < 3; axis++) {
        g->extent[axis] = g->world.max[axis] - g->world.min[axis];
        g->per_unit[axis] = (double)g->side / g->extent[axis];
    }
    free(g->starts);
    free(g->cells);
    free(g->points);
    g->starts = malloc((g->side * g->side * g->side + 1) * sizeof *g->starts);
    g->cells = malloc(count * sizeof *g->cells);
    g->points = malloc(count * sizeof *g->points);
    return g->starts && g->cells && g->points;
}

static size_t build(void *self, const octree_point *points, const octree_point *to, size_t count)
{
    (void)to;
    grid *g = self;
    if (!make_room(g, count))
        return 0;
    const size_t cells = g->side * g->side * g->side;
    memset(g->starts, 0, (cells + 1) * sizeof *g->starts);
    for (size_t i = 0; i < count; i++) {
        const double *p = points[i].position;
        g->cells[i] = (uint32_t)cell_at(g, slice_of(g, 0, p[0]), slice_of(g, 1, p[1]), slice_of(g, 2, p[2]));
        g->starts[g->cells[i]]++;
    }
    for (size_t cell = 1; cell <= cells; cell++)
        g->starts[cell] += g->starts[cell - 1]; /* the end of each cell, until its points are in */
    for (size_t i = count; i-- > 0;)
        g->points[--g->starts[g->cells[i]]] = points[i];
    return count;
}

static void box(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    const grid *g = self;
    for (size_t q = 0; q < count; q++) {
        size_t low[3], high[3];
        double min[3], max[3];
        for (int axis = 0; axis < 3; axis++) {
            min[axis] = queries[q].at[axis] - queries[q].size;
            max[axis] = queries[q].at[axis] + queries[q].size;
            low[axis] = slice_of(g, axis, min[axis]);
            high[axis] = slice_of(g, axis, max[axis]);
        }
        peer_answer answer = {0};
        for (size_t x = low[0]; x <= high[0]; x++)
            for (size_t y = low[1]; y <= high[1]; y++) {
                const uint32_t end = g->starts[cell_at(g, x, y, high[2]) + 1];
                for (uint32_t i = g->starts[cell_at(g, x, y, low[2])]; i < end; i++) {
                    const double *p = g->points[i].position;
                    if (p[0] >= min[0] && p[0] <= max[0] && p[1] >= min[1] && p[1] <= max[1] && p[2] >= min[2] &&
                        p[2] <= max[2]) {
                        answer.count++;
                        answer.ids += g->points[i].id;
                    }
                }
            }
        answers[q] = answer;
    }
}

/* The least squared distance among the points of cells [low, high] of a row along z. */
static double nearest_in_row(const grid *g, const double at[3], size_t x, size_t y, const size_t range[2], double best)
{
    const uint32_t end = g->starts[cell_at(g, x, y, range[1]) + 1];
    for (uint32_t i = g->starts[cell_at(g, x, y, range[0])]; i < end; i++) {
        const double *p = g->points[i].position;
        const double d[3] = {p[0] - at[0], p[1] - at[1], p[2] - at[2]};
        const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        best = square < best ? square : best;
    }
    return best;
}

/* How far the faces of the cells within `ring` of the target's are from it, where there are more beyond them. */
static double reach(const grid *g, const double at[3], const size_t home[3], size_t ring)
{
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        const double width = g->extent[axis] / (double)g->side;
        if (home[axis] > ring)
            least = fmin(least, at[axis] - (g->world.min[axis] + (double)(home[axis] - ring) * width));
        if (home[axis] + ring + 1 < g->side)
            least = fmin(least, g->world.min[axis] + (double)(home[axis] + ring + 1) * width - at[axis]);
    }
    return least;
}

static double nearest_of(const grid *g, const double at[3])
{
    const size_t home[3] = {slice_of(g, 0, at[0]), slice_of(g, 1, at[1]), slice_of(g, 2, at[2])};
    double best = INFINITY, safe = 0;
    for (size_t ring = 0; safe < INFINITY && safe * safe <= best; ring++) {
        size_t low[3], high[3];
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = home[axis] > ring ? home[axis] - ring : 0;
            high[axis] = home[axis] + ring < g->side ? home[axis] + ring : g->side - 1;
        }
        for (size_t x = low[0]; x <= high[0]; x++)
            for (size_t y = low[1]; y <= high[1]; y++) {
                const bool shell =
                    x + ring == home[0] || x == home[0] + ring || y + ring == home[1] || y == home[1] + ring;
                if (shell) {
                    best = nearest_in_row(g, at, x, y, (size_t[]){low[2], high[2]}, best);
                    continue;
                }
                if (home[2] >= ring)
                    best = nearest_in_row(g, at, x, y, (size_t[]){low[2], low[2]}, best);
                if (home[2] + ring < g->side)
                    best = nearest_in_row(g, at, x, y, (size_t[]){high[2], high[2]}, best);
            }
        safe = reach(g, at, home, ring);
    }
    return best;
}

static void nearest(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t q = 0; q < count; q++)
        answers[q] = (peer_answer){.count = 1, .distance = sqrt(nearest_of(self, queries[q].at))};
}

const peer peer_grid = {
    .name = "grid-anew",
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .change = {[PEER_BUILD] = build},
    .ask = {[PEER_BOX] = box, [PEER_NEAREST] = nearest},
};
