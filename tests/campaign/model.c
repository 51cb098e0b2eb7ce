/* SPDX-License-Identifier: MIT */
/* model.c - see model.h. */
#include "model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "octree/digest.h"
#include "program.h"

void model_begin(model *m, const octree_def *def)
{
    *m = (model){.def = *def};
}

void model_end(model *m)
{
    free(m->points);
    free(m->cells);
    free(m->seals);
    *m = (model){0};
}

void model_clear(model *m)
{
    m->count = 0;
}

uint64_t model_seal(const octree_point *point)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, point->id);
    for (int axis = 0; axis < 3; axis++) {
        uint64_t bits;
        memcpy(&bits, &point->position[axis], sizeof bits);
        digest = octree_digest_word(digest, bits);
    }
    return digest;
}

size_t model_find(const model *m, const double at[3], uint64_t id)
{
    for (size_t i = 0; i < m->count; i++)
        if (m->points[i].id == id && same_position(m->points[i].position, at))
            return i;
    return MODEL_NONE;
}

size_t model_find_bits(const model *m, const octree_point *point)
{
    const uint64_t seal = model_seal(point);
    for (size_t i = 0; i < m->count; i++)
        if (m->seals[i] == seal)
            return i;
    return MODEL_NONE;
}

int model_order(const octree_point *a, const octree_point *b)
{
    if (a->id != b->id)
        return a->id < b->id ? -1 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (a->position[axis] != b->position[axis])
            return a->position[axis] < b->position[axis] ? -1 : 1;
    return 0;
}

octree_status model_check(const model *m, const double at[3])
{
    if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]))
        return OCTREE_NOT_FINITE;
    return box_holds(&m->def.world, at) ? OCTREE_OK : OCTREE_OUTSIDE;
}

/* The smallest cell that a leaf can have at a position: down the planes, until the greatest depth is reached or no
 * plane lies inside the cell. */
static octree_address smallest_cell(const octree_def *def, const double at[3])
{
    octree_address address = OCTREE_ROOT;
    octree_box cell = def->world;
    for (size_t depth = 0; depth < def->max_depth; depth++) {
        const octree_box upper = octree_cell_box(&def->world, address << 3 | 7);
        unsigned octant = 0;
        bool divisible = false;
        for (int axis = 0; axis < 3; axis++) {
            const double plane = upper.min[axis];
            const bool above = at[axis] >= plane;
            divisible = divisible || (cell.min[axis] < plane && plane < cell.max[axis]);
            octant = octant << 1 | above;
            *(above ? &cell.min[axis] : &cell.max[axis]) = plane;
        }
        if (!divisible)
            break;
        address = address << 3 | octant;
    }
    return address;
}

static octree_address cell_in(const octree_def *def, const double at[3])
{
    return def->full_leaf == OCTREE_REFUSE ? smallest_cell(def, at) : 0;
}

/* A leaf that cannot split holds the points of one smallest cell. */
static bool is_full(const model *m, octree_address cell)
{
    size_t count = 0;
    if (m->def.full_leaf != OCTREE_REFUSE || m->count < m->def.leaf_capacity)
        return false;
    for (size_t i = 0; i < m->count; i++)
        count += m->cells[i] == cell;
    return count >= m->def.leaf_capacity;
}

static void put(model *m, size_t at, const octree_point *point, octree_address cell)
{
    m->points[at] = *point;
    m->cells[at] = cell;
    m->seals[at] = model_seal(point);
}

static void append(model *m, const octree_point *point, octree_address cell)
{
    if (m->count == m->room) {
        m->room = m->room == 0 ? 64 : 2 * m->room;
        m->points = resize_memory(m->points, m->room * sizeof *m->points);
        m->cells = resize_memory(m->cells, m->room * sizeof *m->cells);
        m->seals = resize_memory(m->seals, m->room * sizeof *m->seals);
    }
    put(m, m->count++, point, cell);
}

octree_status model_insert(model *m, const double at[3], uint64_t id)
{
    const octree_status status = model_check(m, at);
    if (status != OCTREE_OK)
        return status;
    if (model_find(m, at, id) != MODEL_NONE)
        return OCTREE_DUPLICATE;
    const octree_address cell = cell_in(&m->def, at);
    if (is_full(m, cell))
        return OCTREE_FULL;
    append(m, &(octree_point){{at[0], at[1], at[2]}, id}, cell);
    return OCTREE_OK;
}

octree_status model_remove(model *m, const double at[3], uint64_t id)
{
    const octree_status status = model_check(m, at);
    if (status != OCTREE_OK)
        return status;
    const size_t i = model_find(m, at, id);
    if (i == MODEL_NONE)
        return OCTREE_NOT_FOUND;
    m->count--;
    m->points[i] = m->points[m->count];
    m->cells[i] = m->cells[m->count];
    m->seals[i] = m->seals[m->count];
    return OCTREE_OK;
}

octree_status model_move(model *m, const double from[3], uint64_t id, const double to[3])
{
    octree_status status = model_check(m, from);
    if (status == OCTREE_OK)
        status = model_check(m, to);
    if (status != OCTREE_OK)
        return status;
    const size_t i = model_find(m, from, id), taken = model_find(m, to, id);
    if (i == MODEL_NONE)
        return OCTREE_NOT_FOUND;
    if (taken != MODEL_NONE && taken != i)
        return OCTREE_DUPLICATE;
    const octree_address cell = cell_in(&m->def, to);
    if (cell != m->cells[i] && is_full(m, cell))
        return OCTREE_FULL;
    put(m, i, &(octree_point){{to[0], to[1], to[2]}, id}, cell);
    return OCTREE_OK;
}

static bool is_world(const octree_box *world)
{
    for (int axis = 0; axis < 3; axis++)
        if (!isfinite(world->min[axis]) || !isfinite(world->max[axis]) || !(world->min[axis] < world->max[axis]))
            return false;
    return true;
}

octree_status model_reworld(model *m, const octree_box *world)
{
    if (!is_world(world))
        return OCTREE_BAD_WORLD;
    model moved;
    model_begin(&moved, &m->def);
    moved.def.world = *world;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; i < m->count && status == OCTREE_OK; i++)
        status = model_check(&moved, m->points[i].position);
    for (size_t i = 0; i < m->count && status == OCTREE_OK; i++)
        status = model_insert(&moved, m->points[i].position, m->points[i].id);
    if (status == OCTREE_OK) {
        const model old = *m;
        *m = moved;
        moved = old;
    }
    model_end(&moved);
    return status;
}
