/* SPDX-License-Identifier: MIT */
/* rebuild.c - a batch in which many points move: rebuilds the tree from the destinations and the staying points.
 *
 * Problem: when three tenths of the points or more move, as in every step of a simulation, nearly every leaf changes.
 * Finding each moved point by descent and then editing its leaf costs more than building a tree.
 *
 * Idea: read all stored points once, in memory order. A table of ids shows whether a stored point moves. If it does not
 * move, it is copied to the staying points; otherwise its address is entered in the table. Then go through the moves in
 * the caller's order, and compare the origin of each move with the stored point that the table has for the move's id.
 * Finally grid_fill.c or a sort builds the new tree from the destinations and the staying points.
 *
 * The table is a bit map with one pointer per id where ids are dense, else a hash table. If an id moves twice or is
 * stored twice, moves depend on one another; this method is then abandoned, and move_order.c simulates the moves. Cost:
 * O(n) time, and 90 to 140 bytes a point during the call.
 */
#include "grid_fill.h"
#include "tasks.h"

#include <stdatomic.h>
#include <string.h>

/* A table of the ids that move, with the address of each id's stored point. If the ids are dense, the slot of an id is
 * id - least; otherwise the table is a hash table with linear probing. */
typedef struct id_table {
    /* a table with stored_count entries: entry i is the address of the stored point of slot first + i, or null if none
     * was found. If two tasks write the same entry, the tree holds the id twice; the table is then discarded */
    const octree_point *_Atomic *stored;
    uint64_t *bits; /* for dense ids: bit i is set if a move has the id least + i; null for other ids */
    /* for ids that are not dense: for each slot, 1 + the index of the move, or 0 if the slot is empty; else null */
    uint32_t *places;
    size_t slot_count, first, stored_count;
    uint64_t least;
} id_table;

/* The results of one task. */
typedef struct findings {
    size_t first; /* index of the first stored point that the task reads */
    /* stay: the number of stored points that stay; looked_up: the number of stored points that the task has read */
    size_t stay, looked_up;
    size_t seen, moved; /* seen: the number of moves whose id is stored; moved: the number of valid moves */
} findings;

typedef struct rebuild {
    batch *whole; /* the batch of moves */
    id_table ids;
    /* copies of the points that stay; each task writes its copies from the index of the first point that it reads */
    octree_point *staying;
    /* the grid cells of all moves, followed by the grid cells of all staying points; without a grid, all cells of valid
     * moves and staying points are 0 */
    uint32_t *cells;
    size_t count; /* the number of moves */
    unsigned move_tasks;
    forest stored; /* the subtrees of the tree before the moves, divided among tasks */
    findings found[TASKS_AT_MOST];
} rebuild;

/* ---- The table of ids --------------------------------------------------------------------------------------- */

typedef struct id_check {
    const batch *whole;
    unsigned tasks;
    /* ascend[i]: whether the ids of the points of task i ascend, including the id before its first point */
    bool ascend[TASKS_AT_MOST];
} id_check;

static void check_ids_in_task(size_t number, void *context)
{
    id_check *check = context;
    const octree_point *points = check->whole->points;
    const size_t first = find_share_start(check->whole->count, check->tasks, number),
                 end = find_share_start(check->whole->count, check->tasks, number + 1);
    size_t i = first > 0 ? first : 1;
    while (i < end && points[i].id > points[i - 1].id)
        i++;
    check->ascend[number] = i >= end;
}

bool are_ids_ascending(const batch *b)
{
    id_check check = {.whole = b, .tasks = count_tasks(b->tree, b->count)};
    bool all = true;
    run_tasks(b->tree, check_ids_in_task, check.tasks, &check);
    for (unsigned task = 0; task < check.tasks; task++)
        all = all && check.ascend[task];
    return all;
}

/* Returns the slot of an id in a hash table. If the id is not in the table, returns the empty slot for it. */
static size_t find_id_slot(const id_table *t, const octree_point *points, uint64_t id)
{
    size_t slot = (size_t)((id ^ id >> 32) * UINT64_C(0x9e3779b97f4a7c15) >> 16) & (t->slot_count - 1);
    while (t->places[slot] && points[t->places[slot] - 1].id != id)
        slot = (slot + 1) & (t->slot_count - 1);
    return slot;
}

/* Returns the table entry of an id, which holds the address of its stored point. Returns null if no move has this
 * id. */
static inline const octree_point *_Atomic *find_stored_entry(const id_table *t, const octree_point *points, uint64_t id)
{
    size_t slot = (size_t)(id - t->least);
    bool has_move = t->bits && id - t->least < t->slot_count && (t->bits[slot / 64] >> slot % 64 & 1);
    if (!t->bits) {
        slot = find_id_slot(t, points, id);
        has_move = t->places[slot] != 0;
    }
    return has_move ? &t->stored[slot - t->first] : NULL;
}

static size_t bit_map_bytes(const id_table *t)
{
    return (t->slot_count / 64 + 1) * sizeof *t->bits;
}

static void release_id_table(arena *memory, id_table *t)
{
    arena_free(memory, (void *)t->stored, t->stored_count * sizeof *t->stored);
    arena_free(memory, t->bits, bit_map_bytes(t));
    arena_free(memory, t->places, t->slot_count * sizeof *t->places);
    *t = (id_table){0};
}

/* Set the bit of each id of the batch. Returns false if an id is not among the slot_count ids from t->least on. *differ
 * becomes false if an id occurs twice. */
static bool set_id_bits(const batch *b, id_table *t, bool *differ)
{
    size_t least = SIZE_MAX, most = 0;
    for (size_t i = 0; i < b->count; i++) {
        const uint64_t slot = b->points[i].id - t->least, bit = UINT64_C(1) << slot % 64;
        if (slot >= t->slot_count)
            return false;
        *differ &= !(t->bits[slot / 64] & bit);
        t->bits[slot / 64] |= bit;
        least = slot < least ? (size_t)slot : least;
        most = slot > most ? (size_t)slot : most;
    }
    t->first = least;
    t->stored_count = most - least + 1;
    return true;
}

/* Enter all ids into the hash table. Returns false if two ids are equal. */
static bool add_ids_to_hash_table(const batch *b, id_table *t)
{
    for (size_t i = 0; i < b->count; i++) {
        const size_t slot = find_id_slot(t, b->points, b->points[i].id);
        if (t->places[slot])
            return false;
        t->places[slot] = (uint32_t)i + 1;
    }
    return true;
}

/* Enter the ids of a batch into an empty table. The table is dense if all ids are among the `reach` * count ids around
 * the first id. Returns false if memory runs out. *differ becomes false if two ids are equal; the table must then not
 * be used. */
static bool fill_id_table(const batch *b, id_table *t, size_t reach, bool *differ)
{
    arena *memory = &b->tree->store.memory;
    t->least = b->points[0].id - reach / 2 * b->count; /* the difference wraps around modulo 2^64 */
    t->slot_count = reach * b->count;
    t->bits = arena_allocate(memory, bit_map_bytes(t));
    if (!t->bits)
        return false;
    memset(t->bits, 0, bit_map_bytes(t));
    *differ = true;
    if (set_id_bits(b, t, differ) || !*differ)
        return true;
    release_id_table(memory, t);
    t->slot_count = 64;
    while (t->slot_count < 2 * b->count)
        t->slot_count *= 2;
    t->places = arena_allocate(memory, t->slot_count * sizeof *t->places);
    if (!t->places)
        return false;
    memset(t->places, 0, t->slot_count * sizeof *t->places);
    *differ = add_ids_to_hash_table(b, t);
    t->stored_count = t->slot_count;
    return true;
}

bool check_ids_differ(const batch *b, bool *differ)
{
    id_table t = {0};
    *differ = are_ids_ascending(b);
    const bool ok = *differ || fill_id_table(b, &t, 64, differ);
    release_id_table(&b->tree->store.memory, &t);
    return ok;
}

/* Make the table of the ids of all moves. Returns false if memory runs out. *differ becomes false if two moves have the
 * same id. */
static bool make_move_table(const batch *b, id_table *t, bool *differ)
{
    if (!fill_id_table(b, t, 8, differ))
        return false;
    if (!*differ)
        return true;
    t->stored = arena_allocate(&b->tree->store.memory, t->stored_count * sizeof *t->stored);
    if (t->stored)
        memset((void *)t->stored, 0, t->stored_count * sizeof *t->stored);
    return t->stored != NULL;
}

/* ---- The stored points -------------------------------------------------------------------------------------- */

/* Find the grid cells of a range of staying points. */
static void find_staying_cells(const rebuild *r, size_t first, size_t count)
{
    find_grid_cells(r->whole, r->staying + first, count, r->cells + r->count + first, NULL);
}

static void separate_moving_points_in_leaf(const rebuild *r, const node *leaf, findings *f)
{
    /* a local copy, so that the compiler knows that the stores below do not change the table */
    const id_table ids = r->ids;
    const octree_point *moves = r->whole->points;
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        const octree_point *_Atomic *stored = find_stored_entry(&ids, moves, point->id);
        if (stored)
            atomic_store_explicit(stored, point, memory_order_relaxed);
        else
            r->staying[f->first + f->stay++] = *point;
    }
    f->looked_up += leaf->count;
}

static void separate_moving_points_below(const rebuild *r, const node *n, findings *f)
{
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++) {
        if (i + 1 < children && !children_of(n)[i + 1].octants)
            leaf_prefetch(&children_of(n)[i + 1]);
        separate_moving_points_below(r, &children_of(n)[i], f);
    }
    if (children == 0)
        separate_moving_points_in_leaf(r, n, f);
}

static void separate_moving_points_in_task(size_t number, void *context)
{
    rebuild *r = context;
    const subtree *s = first_subtree(&r->stored, number), *end = first_subtree(&r->stored, number + 1);
    findings *f = &r->found[number];
    *f = (findings){.first = s < end ? s->before : 0};
    for (; s < end; s++)
        separate_moving_points_below(r, s->node, f);
    find_staying_cells(r, f->first, f->stay);
    for (size_t at = f->stay; at < f->looked_up; at++)
        r->cells[r->count + f->first + at] = GRID_NONE;
}

/* ---- The moves ---------------------------------------------------------------------------------------------- */

/* Returns the error of an invalid move, by checking its origin and its destination. */
static octree_status find_move_error(const batch *b, size_t place)
{
    octree_status status = check_in_world(b->tree, b->points[place].position);
    if (status == OCTREE_OK)
        status = check_in_world(b->tree, b->to[place]);
    return status == OCTREE_OK ? OCTREE_NOT_FOUND : status;
}

/* Returns whether a move is valid. *to is the grid cell of the move's destination. If the cell is still unknown
 * (GRID_NONE) and the move is valid, the function computes the cell. */
static bool is_valid_move(const rebuild *r, size_t place, const octree_point *stored, uint32_t *to)
{
    const batch *b = r->whole;
    if (!stored || !is_same_position(stored->position, b->points[place].position))
        return false;
    if (*to != GRID_NONE)
        return true;
    if (check_in_world(b->tree, b->to[place]) != OCTREE_OK)
        return false;
    *to = b->grid ? compute_grid_cell(b->tree->axes, b->grid, b->to[place]) : 0;
    return true;
}

/* Check a group of moves. The stored points of all moves are prefetched before the first move is checked, so that cache
 * misses overlap. */
static void check_move_group(const rebuild *r, size_t first, size_t count, findings *f)
{
    const batch *b = r->whole;
    const octree_point *stored[GRID_TOGETHER];
    for (size_t i = 0; i < count; i++) {
        stored[i] =
            atomic_load_explicit(find_stored_entry(&r->ids, b->points, b->points[first + i].id), memory_order_relaxed);
        if (stored[i])
            prefetch_memory(stored[i]);
    }
    /* without a grid, the cells of all moves are GRID_NONE at first */
    if (b->grid)
        compute_grid_cells(b->tree->axes, b->grid, b->to[first], 3, count, r->cells + first);
    else
        memset(r->cells + first, 0xff, count * sizeof *r->cells);
    for (size_t i = 0; i < count; i++) {
        const size_t place = first + i;
        const bool made = is_valid_move(r, place, stored[i], &r->cells[place]);
        f->seen += stored[i] != NULL;
        f->moved += made;
        if (!made)
            r->cells[place] = GRID_NONE;
        if (b->statuses)
            b->statuses[place] = made ? OCTREE_OK : find_move_error(b, place);
    }
}

static void check_moves_in_task(size_t number, void *context)
{
    rebuild *r = context;
    const size_t end = find_share_start(r->count, r->move_tasks, number + 1);
    for (size_t i = find_share_start(r->count, r->move_tasks, number); i < end; i += GRID_TOGETHER)
        check_move_group(r, i, end - i < GRID_TOGETHER ? end - i : GRID_TOGETHER, &r->found[number]);
}

/* ---- The new tree ------------------------------------------------------------------------------------------ */

/* The point of an invalid move stays where it is: copy it to the staying points. The copies fill the gaps that the
 * tasks left in the array. */
static void keep_points_of_invalid_moves(rebuild *r)
{
    unsigned task = 0;
    for (size_t i = 0; i < r->count; i++) {
        const batch *b = r->whole;
        const octree_point *point =
            r->cells[i] == GRID_NONE ? *find_stored_entry(&r->ids, b->points, b->points[i].id) : NULL;
        if (!point)
            continue;
        while (r->found[task].stay == r->found[task].looked_up)
            task++;
        const size_t at = r->found[task].first + r->found[task].stay++;
        r->staying[at] = *point;
        find_staying_cells(r, at, 1);
    }
}

/* Sort all points and build the tree from them. With sorted points, the test whether a move may meet a full leaf is
 * exact. */
static octree_status sort_and_build(batch *b, size_t total)
{
    arena *memory = &b->store->memory;
    const size_t unsorted = b->tree->def.full_leaf == OCTREE_REFUSE ? 0 : unsorted_limit(b->tree);
    morton_item *lists = arena_allocate(memory, 2 * total * sizeof *lists);
    if (!lists)
        return OCTREE_NO_MEMORY;
    b->arriving = (span){lists, make_grid_items(b, NULL, lists)};
    morton_sort_by_tasks(b->tree, memory, lists, lists + total, total, unsorted, true);
    const octree_status status = rebuild_from_batch(b);
    arena_free(memory, lists, 2 * total * sizeof *lists);
    return status;
}

static octree_status build_moved_tree(rebuild *r, bool *settled)
{
    const batch *whole = r->whole;
    const size_t total = whole->tree->root.count;
    batch b = *whole;
    b.statuses = NULL; /* the caller's statuses are final, and building the tree must not change them */
    b.stored = r->staying;
    b.stored_count = total;
    b.cells = r->cells;
    if (whole->done < r->count)
        keep_points_of_invalid_moves(r);
    octree_status status = b.grid ? rebuild_from_batch(&b) : OCTREE_OK;
    if (status == OCTREE_OK && (b.grid == 0 || b.overflow)) {
        b.grid = 0;
        status = sort_and_build(&b, total);
    }
    *settled = !b.overflow;
    return status;
}

static octree_status check_moves_and_build(rebuild *r, bool *settled)
{
    batch *b = r->whole;
    size_t looked_up = 0, stay = 0, seen = 0;
    if (!make_move_table(b, &r->ids, settled))
        return OCTREE_NO_MEMORY;
    if (!*settled)
        return OCTREE_OK;
    divide_tree(&r->stored, b->tree, NULL, NULL);
    r->move_tasks = count_tasks(b->tree, r->count);
    memset(r->found, 0, sizeof r->found);
    run_tasks(b->tree, separate_moving_points_in_task, r->stored.tasks, r);
    run_tasks(b->tree, check_moves_in_task, r->move_tasks, r);
    b->done = 0;
    for (unsigned i = 0; i < TASKS_AT_MOST; i++) {
        looked_up += r->found[i].looked_up;
        stay += r->found[i].stay;
        seen += r->found[i].seen;
        b->done += r->found[i].moved;
    }
    /* looked_up - stay is the number of stored points that move, and `seen` is the number of moves whose id is stored.
     * The two numbers differ if an id that moves is stored twice. */
    *settled = looked_up - stay == seen;
    return *settled && b->done > 0 ? build_moved_tree(r, settled) : OCTREE_OK;
}

octree_status move_points_by_rebuild(batch *b, bool *settled)
{
    arena *memory = &b->store->memory;
    const size_t stored = b->tree->root.count, cells = (b->count + stored) * sizeof(uint32_t);
    rebuild *r = arena_allocate(memory, sizeof *r);
    octree_status status = OCTREE_NO_MEMORY;
    *settled = true;
    if (!r)
        return status;
    r->whole = b;
    r->count = b->count;
    r->ids = (id_table){0};
    r->staying = arena_allocate(memory, stored * sizeof *r->staying);
    r->cells = arena_allocate(memory, cells);
    if (r->staying && r->cells)
        status = check_moves_and_build(r, settled);
    b->grid = 0;
    arena_free(memory, r->staying, stored * sizeof *r->staying);
    arena_free(memory, r->cells, cells);
    release_id_table(memory, &r->ids);
    arena_free(memory, r, sizeof *r);
    return status;
}
