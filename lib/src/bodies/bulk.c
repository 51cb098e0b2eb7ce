/* SPDX-License-Identifier: MIT */
/* bulk.c - changes of many bodies in one call.
 *
 * The rows are changed one by one, with the results of the caller's order; so each body gets the status that a single
 * call would give. The hash table of the rows finds duplicates among the bodies of the call. It stays, because further
 * bulk calls are likely.
 *
 * A call that fills an empty set adds the bodies cell by cell (order.c), and duplicates are in the same cell. So it
 * needs no table. Only if a cell has many bodies, it makes a table, and drops it afterwards.
 *
 * The resulting changes of the trees are collected, and each level makes its changes in one bulk call of octree.h. If
 * this call fails, it has changed nothing in its tree, and the rows of this level's bodies are restored afterwards.
 *
 * A move that changes the level of a body, or the half extents in the id of its point, is made alone, after the
 * collected changes.
 *
 * Cost: that of the bulk calls, and one cache miss in the hash table for each body. The first call of many bodies
 * hashes all rows.
 */
#include "../exact/float_mode.h"
#include "../exact/point.h"
#include "../query/search.h"
#include "boxes.h"
#include "bulk.h"
#include "lookup.h"
#include "order.h"
#include "few_bodies.h"

enum { PREFETCH_AHEAD = 8 };

/* A change of a tree that is collected, but not made yet. */
typedef struct pending {
    size_t index; /* the index of the body in the caller's arrays */
    uint32_t row;
    unsigned level;
} pending;

/* Change the tree of a level, and its boxes. */
typedef octree_status bulk_change(const level *l, const octree_point *points, const double (*to)[3], size_t count);

typedef struct bulk {
    octree_bodies *set;
    pending *items;
    size_t count, room;
    /* While changes are collected, ends[level + 1] is their number for a level. After gather_points(), ends[level] is
     * the end of the level's points. */
    size_t ends[OCTREE_BODY_LEVELS + 1];
    octree_point *points; /* the points of the changes, level by level */
    double (*to)[3];
    const octree_body *from, *moved; /* the caller's arrays; `moved` is null unless bodies are moved */
    octree_status *statuses;         /* may be null */
    octree_status failure;           /* the first status of a bulk call that is not OK */
    size_t changed;
} bulk;

static void set_status(bulk *b, size_t index, octree_status status)
{
    if (b->statuses)
        b->statuses[index] = status;
    b->changed += status == OCTREE_OK;
}

static void end_bulk(bulk *b)
{
    arena *memory = &b->set->memory;
    arena_free(memory, b->items, (b->room + 1) * sizeof *b->items);
    arena_free(memory, b->points, (b->room + 1) * sizeof *b->points);
    arena_free(memory, b->to, (b->room + 1) * sizeof *b->to);
}

/* Allocate the lists of a bulk call. Returns false if memory runs out. */
static bool begin_bulk(bulk *b, size_t count)
{
    arena *memory = &b->set->memory;
    b->room = count;
    b->items = count <= SIZE_MAX / sizeof *b->items ? arena_allocate(memory, (count + 1) * sizeof *b->items) : NULL;
    b->points = b->items ? arena_allocate(memory, (count + 1) * sizeof *b->points) : NULL;
    b->to = b->points && b->moved ? arena_allocate(memory, (count + 1) * sizeof *b->to) : NULL;
    if (b->points && (b->to || !b->moved))
        return true;
    end_bulk(b);
    return false;
}

/* Hash the rows, and call begin_bulk(). */
static bool begin_hashed_bulk(bulk *b, size_t count)
{
    return (count == 0 || rows_hash(&b->set->rows, 0)) && begin_bulk(b, count);
}

static void collect(bulk *b, size_t index, uint32_t row, unsigned level)
{
    b->items[b->count++] = (pending){index, row, level};
    b->ends[level + 1]++;
}

/* Returns the body that is inserted or removed; before a move, the body that is moved. */
static const octree_body *body_of(const bulk *b, const pending *p)
{
    return b->moved ? &b->from[p->index] : row_at(&b->set->rows, p->row);
}

/* Fill the lists of points. */
static void gather_points(bulk *b)
{
    for (unsigned level = 0; level < OCTREE_BODY_LEVELS; level++)
        b->ends[level + 1] += b->ends[level];
    for (size_t i = 0; i < b->count; i++) {
        const pending *p = &b->items[i];
        const octree_body *body = body_of(b, p);
        const size_t at = b->ends[p->level]++;
        b->points[at].id = make_point_id(&b->set->levels[p->level], p->row, body->half);
        memcpy(b->points[at].position, body->position, sizeof body->position);
        if (b->moved)
            memcpy(b->to[at], b->moved[p->index].position, sizeof b->to[at]);
    }
}

/* Make the collected changes of a level in one bulk call. */
static octree_status change_level_in_bulk(bulk *b, unsigned level, bulk_change *change)
{
    const size_t begin = level > 0 ? b->ends[level - 1] : 0, count = b->ends[level] - begin;
    if (count == 0)
        return OCTREE_OK;
    const unsigned begun = begin_set_callbacks(b->set); /* the executor */
    octree_status status = create_level(b->set, level);
    if (status == OCTREE_OK)
        status =
            change(&b->set->levels[level], b->points + begin, b->to ? (const double(*)[3])b->to + begin : NULL, count);
    end_callbacks(begun);
    b->failure = b->failure == OCTREE_OK ? status : b->failure;
    return status;
}

/* Make the collected changes of all levels. Then call `finish` for each change: in the caller's order if the bulk call
 * of the level succeeded; in the reverse order, to restore the rows, if it failed. */
static void make_changes(bulk *b, bulk_change *change, void (*finish)(bulk *b, const pending *p, bool made))
{
    octree_status results[OCTREE_BODY_LEVELS];
    gather_points(b);
    for (unsigned level = 0; level < OCTREE_BODY_LEVELS; level++)
        results[level] = change_level_in_bulk(b, level, change);
    for (size_t i = 0; i < b->count; i++)
        if (results[b->items[i].level] == OCTREE_OK)
            finish(b, &b->items[i], true);
    for (size_t i = b->count; i-- > 0;)
        if (results[b->items[i].level] != OCTREE_OK)
            finish(b, &b->items[i], false);
    for (size_t i = 0; i < b->count; i++)
        set_status(b, b->items[i].index, results[b->items[i].level]);
    b->count = 0;
    memset(b->ends, 0, sizeof b->ends);
}

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

static octree_status finish_bulk(bulk *b, size_t *changed)
{
    end_bulk(b);
    if (changed)
        *changed = b->changed;
    return b->failure;
}

static void prefetch_row_of(const bulk *b, size_t index, size_t count)
{
    if (index + PREFETCH_AHEAD < count)
        rows_prefetch(&b->set->rows, &b->from[index + PREFETCH_AHEAD]);
}

/* ---- Few changes --------------------------------------------------------------------------------------------- */

/* Hashing the rows of a set for the first time costs about as much as a change of a sixteenth of its bodies. So calls
 * of fewer bodies make single changes. */
enum { HASHING_CHANGES = 16 };

static bool are_few(const octree_bodies *set, size_t count)
{
    return !rows_are_hashed(&set->rows) && count < set->rows.count / HASHING_CHANGES;
}

/* Change bodies one by one: move them, or call `change` for each. Returns the first status that is due to a lack of
 * room, or OK. */
static octree_status change_one_by_one(bulk *b, size_t count, size_t *changed,
                                       octree_status change(octree_bodies *set, const octree_body *body))
{
    for (size_t i = 0; i < count; i++) {
        const octree_status status =
            b->moved ? octree_bodies_move(b->set, &b->from[i], &b->moved[i]) : change(b->set, &b->from[i]);
        set_status(b, i, status);
        if (b->failure == OCTREE_OK && (status == OCTREE_NO_MEMORY || status == OCTREE_TOO_MANY))
            b->failure = status;
    }
    if (changed)
        *changed = b->changed;
    return b->failure;
}

/* ---- Insert ------------------------------------------------------------------------------------------------- */

static octree_status insert_points(const level *l, const octree_point *points, const double (*to)[3], size_t count)
{
    (void)to;
    const octree_status status = octree_insert_many(l->tree, points, count, NULL, NULL);
    if (status == OCTREE_OK)
        fit_changes(l, points, count, true);
    return status;
}

static void finish_insertion(bulk *b, const pending *p, bool made)
{
    if (made)
        change_reach(b->set, p->level, body_of(b, p)->half, 1);
    else
        rows_remove(&b->set->rows, p->row);
}

/* Returns whether a body is the same as an earlier one of the same cell. */
static bool is_repeated(const bulk *b, const row_order *order, size_t at)
{
    const octree_body *body = &b->from[body_in_order(order, at)];
    for (size_t i = at; i-- > 0 && cell_in_order(order, i) == cell_in_order(order, at);)
        if (is_same_body(&b->from[body_in_order(order, i)], body))
            return true;
    return false;
}

/* Add the row of a body. The hash is read only if the rows are hashed. */
static void add_row(bulk *b, const row_order *order, size_t at, uint32_t hash)
{
    const size_t index = body_in_order(order, at);
    const octree_body *body = &b->from[index];
    const octree_status status = check_body(b->set, body);
    uint32_t row = ROW_NONE;
    if (status == OCTREE_OK && rows_are_hashed(&b->set->rows))
        row = rows_add_if_new(&b->set->rows, body, hash);
    else if (status == OCTREE_OK && !is_repeated(b, order, at))
        row = rows_add(&b->set->rows, body);
    if (row == ROW_NONE)
        set_status(b, index, status == OCTREE_OK ? OCTREE_DUPLICATE : status);
    else
        collect(b, index, row, find_level(b->set, body->half));
}

/* Add the rows in their order. The bodies and their slots of the hash table are loaded ahead, because they lie anywhere
 * in memory. */
static void add_rows(bulk *b, const row_order *order)
{
    uint32_t hashes[PREFETCH_AHEAD] = {0};
    for (size_t i = 0; i < order->count + PREFETCH_AHEAD; i++) {
        uint32_t *hash = &hashes[i % PREFETCH_AHEAD];
        if (i >= PREFETCH_AHEAD)
            add_row(b, order, i - PREFETCH_AHEAD, *hash);
        if (i < order->count && rows_are_hashed(&b->set->rows))
            *hash = rows_prefetch(&b->set->rows, &b->from[body_in_order(order, i)]);
        if (i + PREFETCH_AHEAD < order->count)
            prefetch_body(&b->from[body_in_order(order, i + PREFETCH_AHEAD)]);
    }
}

octree_status octree_bodies_insert_many(octree_bodies *bodies, const octree_body *added, size_t count,
                                        octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_insert_many, bodies, added, count, statuses, changed);
    octree_status status = check_bulk(bodies, added, count, changed);
    bulk b = {.set = bodies, .from = added, .statuses = statuses};
    if (status == OCTREE_OK && are_few(bodies, count))
        return change_one_by_one(&b, count, changed, octree_bodies_insert);
    if (status == OCTREE_OK)
        status = rows_reserve(&bodies->rows, count);
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    const bool first = bodies->rows.count == 0 && !rows_are_hashed(&bodies->rows);
    const row_order order = make_order(bodies, added, count);
    const bool needs_hash = count > 0 && !(first && has_sparse_cells(&order));
    if ((needs_hash && !rows_hash(&bodies->rows, count)) || !begin_bulk(&b, count)) {
        free_order(bodies, &order);
        return refuse_all(OCTREE_NO_MEMORY, statuses, count);
    }
    if (order.keys && bodies->rows.count == 0)
        choose_floor(bodies, &order);
    add_rows(&b, &order);
    free_order(bodies, &order);
    make_changes(&b, insert_points, finish_insertion);
    status = finish_bulk(&b, changed);
    if (first && !has_crowded_leaf(bodies))
        rows_drop_hash(&bodies->rows);
    rebuild_if_due(bodies);
    return status;
}

/* ---- Remove ------------------------------------------------------------------------------------------------- */

static octree_status remove_points(const level *l, const octree_point *points, const double (*to)[3], size_t count)
{
    (void)to;
    const octree_status status = octree_remove_many(l->tree, points, count, NULL, NULL);
    if (status == OCTREE_OK)
        fit_changes(l, points, count, false);
    return status;
}

static void finish_removal(bulk *b, const pending *p, bool made)
{
    if (!made) {
        rows_show(&b->set->rows, p->row);
        return;
    }
    change_reach(b->set, p->level, body_of(b, p)->half, -1);
    rows_free(&b->set->rows, p->row);
}

static void hide_row(bulk *b, size_t index)
{
    const octree_body *body = &b->from[index];
    const octree_status status = check_body(b->set, body);
    const uint32_t row = status == OCTREE_OK ? rows_find(&b->set->rows, body) : ROW_NONE;
    if (row == ROW_NONE) {
        set_status(b, index, status == OCTREE_OK ? OCTREE_NOT_FOUND : status);
        return;
    }
    collect(b, index, row, find_level(b->set, body->half));
    rows_hide(&b->set->rows, row);
}

octree_status octree_bodies_remove_many(octree_bodies *bodies, const octree_body *removed, size_t count,
                                        octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_remove_many, bodies, removed, count, statuses, changed);
    octree_status status = check_bulk(bodies, removed, count, changed);
    bulk b = {.set = bodies, .from = removed, .statuses = statuses};
    if (status == OCTREE_OK && are_few(bodies, count))
        return change_one_by_one(&b, count, changed, octree_bodies_remove);
    if (status == OCTREE_OK && !begin_hashed_bulk(&b, count))
        status = OCTREE_NO_MEMORY;
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    for (size_t i = 0; i < count; i++) {
        prefetch_row_of(&b, i, count);
        hide_row(&b, i);
    }
    make_changes(&b, remove_points, finish_removal);
    return finish_bulk(&b, changed);
}

/* ---- Move --------------------------------------------------------------------------------------------------- */

static octree_status move_points(const level *l, const octree_point *points, const double (*to)[3], size_t count)
{
    const octree_status status = octree_move_many(l->tree, points, to, count, NULL, NULL);
    if (status == OCTREE_OK)
        fit_moves(l, points, to, count);
    return status;
}

static void finish_move(bulk *b, const pending *p, bool made)
{
    if (!made) {
        rows_replace(&b->set->rows, p->row, body_of(b, p));
        return;
    }
    const double *half = body_of(b, p)->half, *half_moved = b->moved[p->index].half;
    if (is_same_position(half, half_moved))
        return;
    change_reach(b->set, p->level, half, -1);
    change_reach(b->set, p->level, half_moved, 1);
}

/* Check a move, and find the row of the moved body. */
static octree_status find_moved_row(const octree_bodies *set, const octree_body *from, const octree_body *to,
                                    uint32_t *row)
{
    const octree_status status = check_move(set, from, to);
    if (status != OCTREE_OK)
        return status;
    *row = rows_find(&set->rows, from);
    if (*row == ROW_NONE)
        return OCTREE_NOT_FOUND;
    const uint32_t other = rows_find(&set->rows, to);
    return other == ROW_NONE || other == *row ? OCTREE_OK : OCTREE_DUPLICATE;
}

static void move_row(bulk *b, size_t index)
{
    uint32_t row;
    const octree_body *moved = &b->moved[index];
    const octree_status status = find_moved_row(b->set, &b->from[index], moved, &row);
    if (status != OCTREE_OK) {
        set_status(b, index, status);
        return;
    }
    const double *half = b->from[index].half;
    const unsigned level = find_level(b->set, moved->half);
    const struct level *l = &b->set->levels[level];
    if (level == find_level(b->set, half) && make_point_id(l, 0, half) == make_point_id(l, 0, moved->half)) {
        collect(b, index, row, level);
        rows_replace(&b->set->rows, row, moved);
        return;
    }
    make_changes(b, move_points, finish_move);
    const octree_status made = octree_bodies_move(b->set, &b->from[index], moved);
    set_status(b, index, made);
    b->failure = b->failure == OCTREE_OK ? made : b->failure;
}

octree_status octree_bodies_move_many(octree_bodies *bodies, const octree_body *from, const octree_body *to,
                                      size_t count, octree_status *statuses, size_t *changed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_move_many, bodies, from, to, count, statuses, changed);
    octree_status status = check_bulk(bodies, from, count, changed);
    if (status == OCTREE_OK && count > 0 && !to)
        status = OCTREE_NULL_ARGUMENT;
    bulk b = {.set = bodies, .from = from, .moved = to, .statuses = statuses};
    if (status == OCTREE_OK && are_few(bodies, count))
        return change_one_by_one(&b, count, changed, NULL);
    if (status == OCTREE_OK && !begin_hashed_bulk(&b, count))
        status = OCTREE_NO_MEMORY;
    if (status != OCTREE_OK)
        return refuse_all(status, statuses, count);
    for (size_t i = 0; i < count; i++) {
        prefetch_row_of(&b, i, count);
        move_row(&b, i);
    }
    make_changes(&b, move_points, finish_move);
    return finish_bulk(&b, changed);
}
