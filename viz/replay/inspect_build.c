/* SPDX-License-Identifier: MIT */
/* inspect_build.c - the tree of a cloud, built of one part of space after the other: what has been inserted is freed
 * while the tree grows, and it can be told how far it is. The nodes are a function of the contents: they are the same.
 */
#include "inspect.h"
#include "octree/octree.h"
#include "parallel.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_PORTIONS = 16, /* each of a sixteenth or more: fewer than a twentieth would be inserted one by one */
    LEAST_PORTION = 1 << 16,
    LEVELS = 5, /* of the cells that are shared out */
    SIDE = 1 << LEVELS,
    CELLS = 1 << 3 * LEVELS
};

/* Portions of a cloud, each a run of cells in Morton order, which lies together in space. */
typedef struct portions {
    double min[3], scale[3];
    unsigned spread[SIDE];        /* the bits of a coordinate, two others between each */
    size_t points[CELLS];         /* in each */
    unsigned char of_cell[CELLS]; /* the portion of each */
    size_t ends[MOST_PORTIONS];   /* where the next portion begins */
    unsigned count;
} portions;

/* Outside the world too; where the world's extent overflows it is the first. */
static uint16_t cell_of(const portions *p, const double position[3])
{
    unsigned cell = 0;
    for (int axis = 0; axis < 3; axis++) {
        double at = (position[axis] - p->min[axis]) * p->scale[axis];
        at = at > 0 ? at : 0;
        at = at < SIDE - 1 ? at : SIDE - 1;
        cell = cell << 1 | p->spread[(int)at];
    }
    return (uint16_t)cell;
}

static void begin_portions(portions *p, const octree_box *world)
{
    for (int axis = 0; axis < 3; axis++) {
        p->min[axis] = world->min[axis];
        p->scale[axis] = SIDE / (world->max[axis] - world->min[axis]);
    }
    for (unsigned k = 0; k < SIDE; k++)
        for (unsigned bit = 0; bit < LEVELS; bit++)
            p->spread[k] |= (k >> bit & 1) << 3 * bit;
}

/* What is left after the last full portion joins it. */
static void share_out(portions *p, size_t count)
{
    const size_t share = count / MOST_PORTIONS, least = share > LEAST_PORTION ? share : LEAST_PORTION;
    size_t taken = 0, begun = 0;
    for (unsigned cell = 0; cell < CELLS; cell++) {
        p->of_cell[cell] = (unsigned char)p->count;
        taken += p->points[cell];
        if (taken - begun >= least && count - taken >= least) {
            p->ends[p->count++] = taken;
            begun = taken;
        }
    }
    p->ends[p->count++] = count;
}

/* The points of a cloud in their portions, where they keep their order; `cells` has room for one of each. A full leaf
 * that refuses takes the first in the order of the file: then all are one portion. */
static void divide(const cloud *c, const octree_def *def, portions *p, uint16_t *cells, octree_point *points)
{
    size_t next[MOST_PORTIONS] = {0};
    begin_portions(p, &def->world);
    for (size_t i = 0; i < c->count; i++) {
        cells[i] = def->full_leaf == OCTREE_GROW ? cell_of(p, c->positions[i]) : 0;
        p->points[cells[i]]++;
    }
    share_out(p, c->count);
    memcpy(next + 1, p->ends, (p->count - 1) * sizeof *next);
    for (size_t i = 0; i < c->count; i++) {
        octree_point *point = &points[next[p->of_cell[cells[i]]]++];
        memcpy(point->position, c->positions[i], sizeof point->position);
        point->id = cloud_row(c, i);
    }
}

static octree_status insert_portion(const octree_point *points, size_t count, inspection *result)
{
    octree_status *statuses = malloc(count * sizeof *statuses);
    const octree_status status =
        statuses ? octree_insert_many(result->tree, points, count, statuses, NULL) : OCTREE_NO_MEMORY;
    for (size_t i = 0; status == OCTREE_OK && i < count; i++) {
        result->refused += statuses[i] == OCTREE_FULL;
        result->outside += statuses[i] == OCTREE_OUTSIDE;
    }
    free(statuses);
    return status;
}

/* From the last portion on, so that what was inserted can be cut off. */
static octree_status insert_portions(octree_point **points, const portions *p, inspect_progress *progress,
                                     void *context, inspection *result)
{
    octree_status status = OCTREE_OK;
    for (unsigned i = p->count; status == OCTREE_OK && i-- > 0;) {
        const size_t first = i > 0 ? p->ends[i - 1] : 0;
        status = insert_portion(*points + first, p->ends[i] - first, result);
        octree_point *rest = first > 0 ? realloc(*points, first * sizeof *rest) : NULL;
        *points = rest ? rest : *points;
        if (progress)
            progress(result->points - first, result->points, context);
    }
    return status;
}

static octree_status insert_all(cloud *c, const octree_def *def, inspect_progress *progress, void *context,
                                inspection *result)
{
    portions *p = calloc(1, sizeof *p);
    uint16_t *cells = malloc(c->count * sizeof *cells);
    octree_point *points = malloc(c->count * sizeof *points);
    const bool divided = p && cells && points;
    if (divided)
        divide(c, def, p, cells, points);
    free(cells);
    free(c->positions); /* before the tree takes as much again */
    c->positions = NULL;
    const octree_status status = divided ? insert_portions(&points, p, progress, context, result) : OCTREE_NO_MEMORY;
    free(points);
    free(p);
    return status;
}

static void take_values(cloud *c, inspection *result)
{
    result->values = c->values;
    c->values = (point_values){0};
    result->color_full = c->color_full;
    result->column_note = c->column_note;
    memcpy(result->out_of_range, c->out_of_range, sizeof c->out_of_range);
}

bool inspect_build(cloud *c, const octree_def *def, inspect_progress *progress, void *context, inspection *result,
                   octreel_error *error)
{
    *result = (inspection){.points = c->count, .skipped = c->skipped, .why_skipped = c->why_skipped};
    octree_def on_all_cores = *def;
    on_all_cores.executor.run = parallel_run;
    octree_status status = octree_create(&on_all_cores, &result->tree);
    if (status == OCTREE_OK)
        status = insert_all(c, def, progress, context, result);
    if (status == OCTREE_OK) {
        take_values(c, result);
        status = inspect_count_classes(result) ? OCTREE_OK : OCTREE_NO_MEMORY;
    }
    if (status == OCTREE_OK)
        return true;
    inspect_release(result);
    return error_set(error, "the tree cannot be made: %s", octree_status_text(status));
}

void inspect_release(inspection *i)
{
    octree_destroy(i->tree);
    i->tree = NULL;
    point_values_release(&i->values);
    free(i->classes);
    i->classes = NULL;
}
