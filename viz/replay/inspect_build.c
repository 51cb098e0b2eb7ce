/* SPDX-License-Identifier: MIT */
/* inspect_build.c - builds the tree of a point cloud in up to 16 portions.
 *
 * The problem: inserting all points in one call needs memory for all points and the whole tree at once, and cannot
 * report progress. Inserting the points one by one is slow.
 *
 * The idea: the points are sorted into portions. Each portion is inserted in bulk, and its memory is freed before the
 * next one. The points of a portion must lie close together, so that a portion fills subtrees that no other portion
 * touches; otherwise the tree would rework the same nodes 16 times. The world is divided into 32 x 32 x 32 cells, and a
 * portion is a run of cells in Morton order. Morton order interleaves the bits of the three cell coordinates, and so
 * visits all cells of an octant before the next octant. A counting sort by cell takes two passes and keeps the file
 * order within a portion.
 *
 * The nodes of a tree depend only on its points, so the result is the same as that of one call. Under OCTREE_REFUSE the
 * order decides which points are refused, so all points form one portion. Cost: O(n). */
#include "inspect.h"
#include "octree/octree.h"
#include "parallel.h"

#include <stdlib.h>
#include <string.h>

enum {
    /* Each portion has at least a sixteenth of the points, because octree_insert_many() inserts points one by one if
     * they are less than a twentieth of the tree. */
    MOST_PORTIONS = 16,
    LEAST_PORTION = 1 << 16,
    LEVELS = 5, /* number of times that the world is halved along each axis */
    SIDE = 1 << LEVELS,
    CELLS = 1 << 3 * LEVELS
};

/* The cells of the world, and the portion to which each cell belongs: a group of cells whose points are inserted at
 * once. */
typedef struct portions {
    double min[3], scale[3];
    /* spread[k]: the bits of cell coordinate k, with two zero bits between neighbouring bits. */
    unsigned spread[SIDE];
    size_t points[CELLS];                 /* number of points in each cell */
    unsigned char portion_of_cell[CELLS]; /* portion_of_cell[c]: the number of the portion of cell c */
    size_t ends[MOST_PORTIONS];           /* ends[i]: index of the first point after portion i */
    unsigned count;
} portions;

/* Returns the Morton number of the cell that contains a position. For a position outside the world it is the number of
 * the nearest cell. If the extent of the world overflows a double, the scale is 0 and every position is in the first
 * cell. */
static uint16_t find_cell(const portions *p, const double position[3])
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

/* Assign each cell to a portion. If the points after the last full portion are too few for a portion of their own, they
 * join that portion. */
static void assign_cells(portions *p, size_t count)
{
    const size_t share = count / MOST_PORTIONS, least = share > LEAST_PORTION ? share : LEAST_PORTION;
    size_t taken = 0, begun = 0;
    for (unsigned cell = 0; cell < CELLS; cell++) {
        p->portion_of_cell[cell] = (unsigned char)p->count;
        taken += p->points[cell];
        if (taken - begun >= least && count - taken >= least) {
            p->ends[p->count++] = taken;
            begun = taken;
        }
    }
    p->ends[p->count++] = count;
}

/* Sort the points by portion, and keep the file order within each portion. `cells` is scratch memory with room for one
 * number per point. */
static void distribute_points(const cloud *c, const octree_def *def, portions *p, uint16_t *cells, octree_point *points)
{
    size_t next[MOST_PORTIONS] = {0};
    begin_portions(p, &def->world);
    for (size_t i = 0; i < c->count; i++) {
        cells[i] = def->full_leaf == OCTREE_GROW ? find_cell(p, c->positions[i]) : 0;
        p->points[cells[i]]++;
    }
    assign_cells(p, c->count);
    memcpy(next + 1, p->ends, (p->count - 1) * sizeof *next);
    for (size_t i = 0; i < c->count; i++) {
        octree_point *point = &points[next[p->portion_of_cell[cells[i]]]++];
        memcpy(point->position, c->positions[i], sizeof point->position);
        point->id = cloud_row_number(c, i);
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

/* Insert the portions from the last to the first. An inserted portion is then always at the end of the array, where
 * realloc() can free its memory. */
static octree_status insert_portions(octree_point **points, const portions *p, const watcher *watch, inspection *result)
{
    octree_status status = OCTREE_OK;
    for (unsigned i = p->count; status == OCTREE_OK && i-- > 0;) {
        const size_t first = i > 0 ? p->ends[i - 1] : 0;
        status = insert_portion(*points + first, p->ends[i] - first, result);
        octree_point *rest = first > 0 ? realloc(*points, first * sizeof *rest) : NULL;
        *points = rest ? rest : *points;
        watcher_report(watch, result->points - first, result->points);
    }
    return status;
}

static octree_status insert_all(cloud *c, const octree_def *def, const watcher *watch, inspection *result)
{
    portions *p = calloc(1, sizeof *p);
    uint16_t *cells = malloc(c->count * sizeof *cells);
    octree_point *points = malloc(c->count * sizeof *points);
    const bool divided = p && cells && points;
    if (divided)
        distribute_points(c, def, p, cells, points);
    free(cells);
    free(c->positions); /* free the positions first, because the tree needs the same amount of memory */
    c->positions = NULL;
    const octree_status status = divided ? insert_portions(&points, p, watch, result) : OCTREE_NO_MEMORY;
    free(points);
    free(p);
    return status;
}

static void move_values(cloud *c, inspection *result)
{
    result->values = c->values;
    c->values = (point_values){0};
    result->color_full = c->color_full;
    memcpy(result->column_note, c->column_note, sizeof c->column_note);
    memcpy(result->out_of_range, c->out_of_range, sizeof c->out_of_range);
}

bool inspect_build(cloud *c, const octree_def *def, const watcher *watch, inspection *result, octreel_error *error)
{
    *result = (inspection){.points = c->count, .skipped = c->skipped, .why_skipped = c->why_skipped};
    octree_def on_all_cores = *def;
    on_all_cores.executor.run = parallel_run;
    octree_status status = octree_create(&on_all_cores, &result->tree);
    if (status == OCTREE_OK)
        status = insert_all(c, def, watch, result);
    if (status == OCTREE_OK) {
        move_values(c, result);
        status = inspect_count_classes(result) ? OCTREE_OK : OCTREE_NO_MEMORY;
    }
    if (status == OCTREE_OK)
        return true;
    inspect_release(result);
    return error_set(error, "the tree cannot be built: %s", octree_status_text(status));
}

void inspect_release(inspection *i)
{
    octree_destroy(i->tree);
    i->tree = NULL;
    point_values_release(&i->values);
    free(i->classes);
    i->classes = NULL;
}
