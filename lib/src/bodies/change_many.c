/* SPDX-License-Identifier: MIT */
/* change_many.c - changes of many bodies in one call.
 *
 * A call that fills an empty set adds the rows cell by cell (order.c), and the points of each level in one bulk call of
 * octree.h. Duplicates are in the same cell, so that this needs no hash table. Only if a cell has many bodies, a table
 * is made. It is dropped afterwards, unless a leaf is crowded (lookup.c).
 *
 * A call that changes a large share of the bodies changes a copy of the rows, whose hash table finds them, and fills
 * the set anew with the result. A call that changes fewer bodies changes them one by one; so does one that finds too
 * little memory for the copy.
 *
 * In both cases each body gets the status that a single call would give.
 */
#include "../exact/float_mode.h"
#include "../exact/point.h"
#include "../query/search.h"
#include "boxes.h"
#include "change_many.h"
#include "few_bodies.h"
#include "lookup.h"
#include "order.h"

enum { PREFETCH_AHEAD = 8 };

octree_status refuse_all(octree_status status, octree_status *statuses, size_t count)
{
    for (size_t i = 0; statuses && i < count; i++)
        statuses[i] = status;
    return status;
}

octree_status check_bulk(const octree_bodies *set, const octree_body *bodies, size_t count, size_t *changed)
{
    if (changed)
        *changed = 0;
    const octree_status status = check_set_change(set);
    if (status != OCTREE_OK)
        return status;
    return count > ROWS_AT_MOST ? OCTREE_TOO_MANY : count > 0 && !bodies ? OCTREE_NULL_ARGUMENT : OCTREE_OK;
}

/* ---- Fill an empty set -------------------------------------------------------------------------------------- */

typedef struct filling {
    octree_bodies *set;
    const octree_body *added;
    octree_status *statuses; /* may be null */
    row_order order;
    uint8_t *levels; /* of each row */
    octree_point *points;
    size_t ends[OCTREE_BODY_LEVELS + 1]; /* ends[level + 1] is the number of rows in a level */
} filling;

/* Returns whether a body is the same as an earlier one of the same cell. */
static bool is_repeated(const filling *f, size_t at)
{
    const octree_body *body = &f->added[body_in_order(&f->order, at)];
    for (size_t i = at; i-- > 0 && cell_in_order(&f->order, i) == cell_in_order(&f->order, at);)
        if (is_same_body(&f->added[body_in_order(&f->order, i)], body))
            return true;
    return false;
}

/* Add the row of a body. The hash is read only if the rows are hashed. */
static void add_row(filling *f, size_t at, uint32_t hash)
{
    const size_t index = body_in_order(&f->order, at);
    const octree_body *body = &f->added[index];
    octree_status status = check_body(f->set, body);
    uint32_t row = ROW_NONE;
    if (status == OCTREE_OK && rows_are_hashed(&f->set->rows))
        row = rows_add_if_new(&f->set->rows, body, hash);
    else if (status == OCTREE_OK && !is_repeated(f, at))
        row = rows_add(&f->set->rows, body);
    if (row != ROW_NONE) {
        const unsigned level = find_level(f->set, body->half);
        f->levels[row] = (uint8_t)level;
        f->ends[level + 1]++;
    } else if (status == OCTREE_OK)
        status = OCTREE_DUPLICATE;
    if (f->statuses)
        f->statuses[index] = status;
}

/* Add the rows in their order. The bodies and their slots of the hash table are loaded ahead, because they lie anywhere
 * in memory. */
static void add_rows(filling *f)
{
    const size_t count = f->order.count;
    uint32_t hashes[PREFETCH_AHEAD] = {0};
    for (size_t i = 0; i < count + PREFETCH_AHEAD; i++) {
        uint32_t *hash = &hashes[i % PREFETCH_AHEAD];
        if (i >= PREFETCH_AHEAD)
            add_row(f, i - PREFETCH_AHEAD, *hash);
        if (i < count && rows_are_hashed(&f->set->rows))
            *hash = rows_prefetch(&f->set->rows, &f->added[body_in_order(&f->order, i)]);
        if (i + PREFETCH_AHEAD < count)
            prefetch_body(&f->added[body_in_order(&f->order, i + PREFETCH_AHEAD)]);
    }
}

/* Write the points of all rows, level by level. Then ends[level] is the end of the level's points. */
static void write_points(filling *f)
{
    const octree_bodies *set = f->set;
    for (unsigned level = 0; level < OCTREE_BODY_LEVELS; level++)
        f->ends[level + 1] += f->ends[level];
    for (uint32_t row = 0; row < set->rows.count; row++) {
        const octree_body *body = row_at(&set->rows, row);
        const unsigned level = f->levels[row];
        f->points[f->ends[level]++] = make_point(&set->levels[level], row, body);
    }
}

static octree_status fill_level(filling *f, unsigned number)
{
    octree_bodies *set = f->set;
    const size_t begin = number > 0 ? f->ends[number - 1] : 0, count = f->ends[number] - begin;
    octree_status status = count > 0 ? create_level(set, number) : OCTREE_OK;
    if (status != OCTREE_OK || count == 0)
        return status;
    status = octree_insert_many(set->levels[number].tree, f->points + begin, count, NULL, NULL);
    if (status == OCTREE_OK)
        fit_all(&set->levels[number]);
    for (size_t i = begin; status == OCTREE_OK && i < f->ends[number]; i++)
        change_reach(set, number, row_at(&set->rows, row_of_point(&f->points[i]))->half, 1);
    return status;
}

/* Add the rows, and then the points of all levels. */
static octree_status fill_levels(filling *f)
{
    octree_status status = OCTREE_OK;
    if (!has_sparse_cells(&f->order) && !rows_hash(&f->set->rows, f->order.count))
        return OCTREE_NO_MEMORY;
    if (f->order.keys)
        choose_floor(f->set, &f->order);
    add_rows(f);
    write_points(f);
    const unsigned begun = begin_set_callbacks(f->set); /* the executor */
    for (unsigned level = 0; level < OCTREE_BODY_LEVELS && status == OCTREE_OK; level++)
        status = fill_level(f, level);
    end_callbacks(begun);
    if (rows_are_hashed(&f->set->rows) && !has_crowded_leaf(f->set))
        rows_drop_hash(&f->set->rows);
    return status;
}

/* Insert bodies into an empty set, which stays empty if memory runs out. */
static octree_status fill_set(octree_bodies *set, const octree_body *added, size_t count, octree_status *statuses)
{
    arena *memory = &set->memory;
    rows_release(&set->rows);
    octree_status status = rows_reserve(&set->rows, count);
    filling f = {.set = set, .added = added, .statuses = statuses, .order = make_order(set, added, count)};
    f.levels = arena_allocate(memory, count);
    f.points = f.levels ? arena_allocate(memory, count * sizeof *f.points) : NULL;
    if (status == OCTREE_OK)
        status = f.points ? fill_levels(&f) : OCTREE_NO_MEMORY;
    arena_free(memory, f.points, count * sizeof *f.points);
    arena_free(memory, f.levels, count);
    free_order(set, &f.order);
    if (status != OCTREE_OK)
        octree_bodies_clear(set);
    return status == OCTREE_OK ? OCTREE_OK : refuse_all(status, statuses, count);
}

/* ---- Change a set that has bodies --------------------------------------------------------------------------- */

/* Change a body in a list of rows, with the status of a single change. */
typedef octree_status row_change(const octree_bodies *set, rows *r, const octree_body *from, const octree_body *to);
typedef octree_status single_change(octree_bodies *set, const octree_body *from, const octree_body *to);

typedef struct bulk {
    octree_bodies *set;
    const octree_body *from, *to; /* arrays of the caller */
    size_t count;
    row_change *in_rows;
    single_change *alone;
    octree_status *statuses; /* may be null */
    size_t *changed;         /* may be null */
} bulk;

static void report(const bulk *b, size_t index, octree_status status)
{
    if (b->statuses)
        b->statuses[index] = status;
    if (b->changed)
        *b->changed += status == OCTREE_OK;
}

/* Returns the first status that is due to a lack of room, or OK. */
static octree_status change_one_by_one(const bulk *b)
{
    octree_status failure = OCTREE_OK;
    for (size_t i = 0; i < b->count; i++) {
        const octree_status status = b->alone(b->set, &b->from[i], &b->to[i]);
        report(b, i, status);
        if (failure == OCTREE_OK && (status == OCTREE_NO_MEMORY || status == OCTREE_TOO_MANY))
            failure = status;
    }
    return failure;
}

/* Make the changes in a copy of the rows, and fill the set with it, if anything has changed. Returns whether there was
 * enough memory. */
static bool change_copy(const bulk *b)
{
    arena memory = {.allocator = b->set->memory.allocator};
    rows copy;
    size_t made = 0;
    rows_init(&copy, &memory);
    bool done =
        rows_copy(&copy, &b->set->rows) && rows_reserve(&copy, b->count) == OCTREE_OK && rows_hash(&copy, b->count);
    for (size_t i = 0; done && i < b->count; i++) {
        if (i + PREFETCH_AHEAD < b->count)
            rows_prefetch(&copy, &b->from[i + PREFETCH_AHEAD]);
        const octree_status status = b->in_rows(b->set, &copy, &b->from[i], &b->to[i]);
        report(b, i, status);
        made += status == OCTREE_OK;
    }
    done = done && (made == 0 || rebuild_from_rows(b->set, &copy) == OCTREE_OK);
    rows_release(&copy);
    if (!done && b->changed)
        *b->changed = 0;
    return done;
}

/* Filling a set anew takes about as long as changing a third of its bodies one by one. */
enum { REBUILD_SHARE = 3 };

static octree_status change_many(const bulk *b)
{
    const bool few = b->count < b->set->rows.count / REBUILD_SHARE || b->count == 0 || b->set->rows.count == 0;
    return !few && change_copy(b) ? OCTREE_OK : change_one_by_one(b);
}

/* ---- Public functions --------------------------------------------------------------------------------------- */

static octree_status insert_row(const octree_bodies *set, rows *r, const octree_body *from, const octree_body *to)
{
    (void)from;
    const octree_status status = check_body(set, to);
    if (status != OCTREE_OK)
        return status;
    return rows_add_if_new(r, to, rows_prefetch(r, to)) == ROW_NONE ? OCTREE_DUPLICATE : OCTREE_OK;
}

static octree_status insert_alone(octree_bodies *set, const octree_body *from, const octree_body *to)
{
    (void)from;
    return octree_bodies_insert(set, to);
}

octree_status octree_bodies_insert_many(octree_bodies *bodies, const octree_body *added, size_t count,
                                        octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_insert_many, bodies, added, count, statuses, changed);
    octree_status status = check_bulk(bodies, added, count, changed);
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    if (bodies->rows.count > 0 || count == 0)
        return change_many(&(bulk){bodies, added, added, count, insert_row, insert_alone, statuses, changed});
    status = fill_set(bodies, added, count, statuses);
    if (changed)
        *changed = bodies->rows.count;
    return status;
}

/* Find the row of a body after a check of its numbers, which returned `checked`. Returns `checked` if it is an error,
 * or NOT_FOUND. */
static octree_status find_row(const rows *r, octree_status checked, const octree_body *body, uint32_t *row)
{
    if (checked != OCTREE_OK)
        return checked;
    *row = rows_find(r, body);
    return *row == ROW_NONE ? OCTREE_NOT_FOUND : OCTREE_OK;
}

static octree_status remove_row(const octree_bodies *set, rows *r, const octree_body *from, const octree_body *to)
{
    uint32_t row;
    (void)to;
    const octree_status status = find_row(r, check_body(set, from), from, &row);
    if (status == OCTREE_OK)
        rows_remove(r, row);
    return status;
}

static octree_status remove_alone(octree_bodies *set, const octree_body *from, const octree_body *to)
{
    (void)to;
    return octree_bodies_remove(set, from);
}

octree_status octree_bodies_remove_many(octree_bodies *bodies, const octree_body *removed, size_t count,
                                        octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_remove_many, bodies, removed, count, statuses, changed);
    const octree_status status = check_bulk(bodies, removed, count, changed);
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    return change_many(&(bulk){bodies, removed, removed, count, remove_row, remove_alone, statuses, changed});
}

static octree_status move_row(const octree_bodies *set, rows *r, const octree_body *from, const octree_body *to)
{
    uint32_t row;
    const octree_status status = find_row(r, check_move(set, from, to), from, &row);
    if (status != OCTREE_OK)
        return status;
    const uint32_t other = rows_find(r, to);
    if (other != ROW_NONE && other != row)
        return OCTREE_DUPLICATE;
    rows_replace(r, row, to);
    return OCTREE_OK;
}

octree_status octree_bodies_move_many(octree_bodies *bodies, const octree_body *from, const octree_body *to,
                                      size_t count, octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_move_many, bodies, from, to, count, statuses, changed);
    octree_status status = check_bulk(bodies, from, count, changed);
    if (status == OCTREE_OK && count > 0 && !to)
        status = OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    return change_many(&(bulk){bodies, from, to, count, move_row, octree_bodies_move, statuses, changed});
}
