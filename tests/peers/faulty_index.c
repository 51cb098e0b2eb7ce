/* SPDX-License-Identifier: MIT */
/* faulty_index.c - see faulty_index.h. Faults are planted in what the index is built from, in what it is asked, and in
 * what it answers, so that they are the same for all libraries. */
#include "faulty_index.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "quick_oracle.h"
#include "truth.h"

struct faulty_index {
    const spatial_index *index;
    planted_fault fault;
    octree_box world;
    octree_point *now;    /* the true points */
    octree_point *stored; /* those that the index was built from */
    size_t count, stored_count;
    void *self;
};

/* The cell that PLANTED_CHILD skips: an octant of the world. */
static bool is_in_skipped_cell(const faulty_index *f, const double at[3])
{
    bool in = true;
    for (int i = 0; i < 3; i++)
        in = in && at[i] >= f->world.min[i] / 2 + f->world.max[i] / 2;
    return in;
}

/* The point as the index stores it. */
static octree_point store(const faulty_index *f, const octree_point *point, const octree_point *before)
{
    octree_point stored = f->fault == PLANTED_STALE && point->id % 3 == 0 && before ? *before : *point;
    for (int i = 0; i < 3; i++)
        if (f->fault == PLANTED_ROUNDED)
            stored.position[i] = fmax(f->world.min[i], fmin(f->world.max[i], round_to_float(stored.position[i])));
    return stored;
}

static void build(faulty_index *f)
{
    if (f->self)
        f->index->destroy(f->self);
    f->self = f->index->create(f->stored, f->stored_count, &f->world, 0);
    if (!f->self)
        stop_with_error("%s refuses the points", f->index->name);
}

/* Choose what is stored. With PLANTED_STALE, a third of the points keep the places that they had at first. */
static void place(faulty_index *f, const octree_point *points, bool first)
{
    f->stored_count = 0;
    for (size_t i = 0; i < f->count; i++) {
        const octree_point stored = store(f, &points[i], first ? NULL : &f->stored[i]);
        if (f->fault != PLANTED_CHILD || !is_in_skipped_cell(f, stored.position))
            f->stored[f->stored_count++] = stored;
    }
    if (f->stored_count == 0) /* FLANN crashes without points */
        f->stored[f->stored_count++] = points[0];
    memcpy(f->now, points, f->count * sizeof *f->now);
    build(f);
}

faulty_index *faulty_index_create(const spatial_index *index, planted_fault fault, const octree_point *points,
                                  size_t count, const octree_box *world)
{
    faulty_index *f = resize_memory(NULL, sizeof *f);
    *f = (faulty_index){.index = index, .fault = fault, .world = *world, .count = count};
    f->now = resize_memory(NULL, count * sizeof *f->now);
    f->stored = resize_memory(NULL, count * sizeof *f->stored);
    place(f, points, true);
    return f;
}

void faulty_index_destroy(faulty_index *f)
{
    f->index->destroy(f->self);
    free(f->now);
    free(f->stored);
    free(f);
}

void faulty_index_update(faulty_index *f, const octree_point *points)
{
    place(f, points, false);
}

/* Whether a point lies exactly on the boundary of a region. */
static bool is_on_boundary(const octree_query *query, const double at[3])
{
    if (query->kind == OCTREE_QUERY_RADIUS)
        return quick_compare_radius(query->target, at, query->radius, 0) == 0;
    bool on = false;
    for (int i = 0; i < 3; i++)
        on = on || at[i] == query->box.min[i] || at[i] == query->box.max[i];
    return on;
}

static size_t drop_boundary(const faulty_index *f, const octree_query *query, uint64_t *ids, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!is_on_boundary(query, f->now[ids[i]].position))
            ids[kept++] = ids[i];
    return kept;
}

/* Ask for one neighbour more, and drop the one before it. */
static size_t ask_beyond(const faulty_index *f, octree_query asked, uint64_t *ids)
{
    const size_t k = asked.kind == OCTREE_QUERY_NEAREST ? 1 : asked.k;
    asked.kind = OCTREE_QUERY_KNEAREST;
    asked.k = k + 1;
    const size_t count = f->index->ask(f->self, &asked, ids, f->count + 1);
    if (count != k + 1)
        return count;
    ids[k - 1] = ids[k];
    return k;
}

size_t faulty_index_ask(const faulty_index *f, const octree_query *query, uint64_t *ids)
{
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    octree_query asked = *query;
    asked.epsilon = 0;
    asked.k = query->k < f->count ? query->k : f->count;
    if (f->fault == PLANTED_BOUND && neighbors && (f->index->kinds >> OCTREE_QUERY_KNEAREST & 1))
        return ask_beyond(f, asked, ids);
    if (f->fault == PLANTED_BOUND)
        asked.box.max[2] = fmax(asked.box.min[2], asked.box.max[1]);
    if (f->fault == PLANTED_FEWER && asked.k > 1)
        asked.k--;
    const size_t count = f->index->ask(f->self, &asked, ids, f->count + 1);
    if (count > f->count + 1)
        stop_with_error("%s refuses a query", f->index->name);
    return f->fault == PLANTED_STRICT && !neighbors ? drop_boundary(f, query, ids, count) : count;
}
