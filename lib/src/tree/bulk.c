/* SPDX-License-Identifier: MIT */
/* bulk.c - octree_insert_many(), octree_remove_many() and octree_move_many(): statuses, and the lists of points that
 * leave and arrive. */
#include "batch.h"
#include "float_rules.h"
#include "few.h"

#include <string.h>

/* End a batch. *done (may be null) receives the number of points changed. */
static octree_status finish(batch *b, octree_status status, size_t *done)
{
    if (status == OCTREE_OK && b->done > 0)
        b->tree->version++;
    if (status == OCTREE_OK && done)
        *done = b->done;
    batch_end(b);
    return status;
}

/* ---- Points in the tree's own memory ------------------------------------------------------------------------- */

/* Whether the caller's array lies in a leaf of the tree. */
static bool lie_in_leaf(const octree *tree, const octree_point *points, size_t count)
{
    if (!points || count == 0 || check_position(tree, points->position) != OCTREE_OK)
        return false;
    const path p = path_to(tree, morton_code(tree->axes, points->position));
    const node *end = path_end(&p);
    for (uint32_t i = 0; end->octants == 0 && i + count <= end->count; i++)
        if (points == &leaf_points(end)[i])
            return true;
    return false;
}

/* Make a batch of changes with a copy of the points. */
static octree_status change_copies(octree *tree, octree_change_kind kind, const octree_point *points,
                                   const double (*to)[3], size_t count, octree_status *statuses, size_t *done)
{
    arena *memory = &tree->store.memory;
    octree_point *copies = arena_take(memory, count * sizeof *copies);
    if (!copies)
        return OCTREE_NO_MEMORY;
    memcpy(copies, points, count * sizeof *copies);
    const octree_status status = change_batch(tree, kind, copies, to, count, statuses, done);
    arena_give(memory, copies, count * sizeof *copies);
    return status;
}

/* ---- Ids ---------------------------------------------------------------------------------------------------- */

/* Whether ids are close enough together for a table of one bit per id. */
static bool are_dense(const batch *b, uint64_t least, uint64_t most)
{
    return most - least < 64 * (uint64_t)b->count;
}

static bool bits_differ(const batch *b, uint64_t least, uint64_t *bits)
{
    for (size_t i = 0; i < b->count; i++) {
        const uint64_t at = b->points[i].id - least, bit = UINT64_C(1) << at % 64;
        if (bits[at / 64] & bit)
            return false;
        bits[at / 64] |= bit;
    }
    return true;
}

/* A hash table with linear probing; a slot holds an index + 1, or 0. */
static bool hashes_differ(const batch *b, uint32_t *table, size_t slots)
{
    for (size_t i = 0; i < b->count; i++) {
        const uint64_t id = b->points[i].id;
        size_t slot = (size_t)(id ^ (id >> 32) * UINT64_C(0x9e3779b97f4a7c15)) & (slots - 1);
        for (; table[slot]; slot = (slot + 1) & (slots - 1))
            if (b->points[table[slot] - 1].id == id)
                return false;
        table[slot] = (uint32_t)(i + 1);
    }
    return true;
}

bool ids_differ(const batch *b, bool *differ)
{
    uint64_t least = UINT64_MAX, most = 0;
    *differ = true;
    for (size_t i = 0; i < b->count; i++) {
        const uint64_t id = b->points[i].id;
        *differ &= i == 0 || id > most; /* true while ids ascend */
        least = id < least ? id : least;
        most = id > most ? id : most;
    }
    if (*differ)
        return true;
    size_t slots = 64;
    while (slots < 2 * b->count)
        slots *= 2;
    const bool dense = are_dense(b, least, most);
    const size_t size = dense ? ((size_t)(most - least) / 64 + 1) * sizeof(uint64_t) : slots * sizeof(uint32_t);
    arena *memory = &b->tree->store.memory;
    void *table = arena_take(memory, size);
    if (!table)
        return false;
    memset(table, 0, size);
    *differ = dense ? bits_differ(b, least, table) : hashes_differ(b, table, slots);
    arena_give(memory, table, size);
    return true;
}

/* ---- Inserting ---------------------------------------------------------------------------------------------- */

static octree_status insert_valid(batch *b)
{
    const uint32_t before = b->tree->root.count;
    if (!drop_repetitions(b))
        return OCTREE_NO_MEMORY;
    if (b->valid.count > UINT32_MAX - before)
        return OCTREE_TOO_MANY;
    b->arriving = b->valid;
    b->may_be_stored = true;
    const octree_status status = restructure(b);
    b->done = b->tree->root.count - before;
    set_repeated_statuses(b, OCTREE_DUPLICATE);
    return status;
}

octree_status insert_sorted(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                            size_t *inserted)
{
    batch b = {.tree = tree, .points = points, .count = count, .statuses = statuses, .inserts = true};
    octree_status status = batch_begin(&b);
    if (status == OCTREE_OK)
        status = insert_valid(&b);
    return finish(&b, status, inserted);
}

octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted)
{
    if (lie_in_leaf(tree, points, count))
        return change_copies(tree, OCTREE_INSERTED, points, NULL, count, statuses, inserted);
    if (tree && change_log_is_on(&tree->changes))
        return change_batch_and_log(tree, OCTREE_INSERTED, points, NULL, count, statuses, inserted);
    const bool few = tree && points && are_few(tree, count) && float_mode_is_default();
    const octree_status status = (few ? insert_few : insert_sorted)(tree, points, count, statuses, inserted);
    if (status == OCTREE_OK)
        tune_if_due(tree);
    return status;
}

/* ---- Removing ----------------------------------------------------------------------------------------------- */

/* List the items that are stored as leaving, with their index in the leaf. */
static void find_removed(batch *b, node *leaf, unsigned depth, span items)
{
    (void)depth;
    for (size_t i = 0; i < items.count; i++) {
        const octree_point *point = &b->points[items.items[i].place];
        const uint32_t index = leaf ? leaf_find(leaf, point->position, point->id) : LEAF_NONE;
        if (index == LEAF_NONE)
            set_status(b, &items.items[i], OCTREE_NOT_FOUND);
        else
            b->leaving.items[b->leaving.count++] = (morton_item){items.items[i].code, items.items[i].place, index};
    }
}

static octree_status remove_valid(batch *b)
{
    if (!drop_repetitions(b))
        return OCTREE_NO_MEMORY;
    b->leaving.items = b->valid.items;
    batch_visit_leaves(b, find_removed);
    set_repeated_statuses(b, OCTREE_NOT_FOUND);
    b->done = b->leaving.count;
    return restructure(b);
}

octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed)
{
    if (lie_in_leaf(tree, points, count))
        return change_copies(tree, OCTREE_REMOVED, points, NULL, count, statuses, removed);
    if (tree && change_log_is_on(&tree->changes))
        return change_batch_and_log(tree, OCTREE_REMOVED, points, NULL, count, statuses, removed);
    batch b = {.tree = tree, .points = points, .count = count, .statuses = statuses};
    octree_status status = OCTREE_OK;
    bool differ = false;
    if (tree && points && are_few(tree, count) && float_mode_is_default() && !ids_differ(&b, &differ))
        return OCTREE_NO_MEMORY;
    if (differ)
        return remove_few(tree, points, count, statuses, removed);
    status = batch_begin(&b);
    if (status == OCTREE_OK)
        status = remove_valid(&b);
    return finish(&b, status, removed);
}

/* ---- Moving ------------------------------------------------------------------------------------------------- */

static bool same_bits(const double a[3], const double b[3])
{
    return memcmp(a, b, 3 * sizeof *a) == 0;
}

/* Overwrite a point that stays in its leaf at once, which undo_moves() reverts without memory; list others as leaving
 * and arriving. */
static void move_found(batch *b, node *leaf, unsigned depth, morton_item *item, uint32_t index)
{
    const double *to = b->to[item->place];
    octree_point *stored = &leaf_points(leaf)[index];
    const uint64_t code = morton_code(b->tree->axes, to), unlike = code ^ item->code;
    if (leaf->room != LEAF_HASHED && unlike >> 3 * (OCTREE_MAX_DEPTH - depth) == 0 &&
        same_bits(stored->position, b->points[item->place].position)) {
        const uint32_t taken = leaf_find(leaf, to, stored->id);
        if (taken != LEAF_NONE && taken != index) {
            set_status(b, item, OCTREE_DUPLICATE);
            return;
        }
        memcpy(stored->position, to, sizeof stored->position);
        item->index = index;
    } else {
        b->leaving.items[b->leaving.count++] = (morton_item){item->code, item->place, index};
        b->arriving.items[b->arriving.count++] = (morton_item){code, item->place, MORTON_NEW};
    }
    b->done++;
}

/* Find a point in a leaf. A leaf built from a batch keeps the batch's order, so the point after the last is tried
 * first. */
static uint32_t find_after(const node *leaf, uint32_t last, const octree_point *point)
{
    const uint32_t next = last + 1; /* LEAF_NONE + 1 is 0 */
    if (!leaf)
        return LEAF_NONE;
    if (next < leaf->count && leaf_points(leaf)[next].id == point->id &&
        same_position(leaf_points(leaf)[next].position, point->position))
        return next;
    return leaf_find(leaf, point->position, point->id);
}

static void find_moved(batch *b, node *leaf, unsigned depth, span items)
{
    uint32_t index = LEAF_NONE;
    for (size_t i = 0; i < items.count; i++) {
        morton_item *item = &items.items[i];
        index = find_after(leaf, index, &b->points[item->place]);
        if (index == LEAF_NONE)
            set_status(b, item, OCTREE_NOT_FOUND);
        else
            move_found(b, leaf, depth, item, index);
    }
}

/* Restore the points that were overwritten in place. No node has changed since. */
static void undo_moves(batch *b)
{
    for (size_t i = 0; i < b->valid.count; i++) {
        morton_item *item = &b->valid.items[i];
        if (item->index == MORTON_NEW)
            continue;
        const path p = path_to(b->tree, item->code);
        memcpy(leaf_points(path_end(&p))[item->index].position, b->points[item->place].position,
               sizeof b->points->position);
        item->index = MORTON_NEW;
    }
}

/* Make moves whose ids differ. *settled becomes false if they depend on one another; the tree is then unchanged. */
static octree_status move_independent(batch *b, bool *settled)
{
    b->may_be_stored = true;
    batch_visit_leaves(b, find_moved);
    morton_sort_tasks(b->tree, &b->tree->store.memory, b->arriving.items, b->spare, b->arriving.count, 0, true);
    const octree_status status = restructure(b);
    *settled = !b->duplicate && !b->overflow;
    if (status != OCTREE_OK || !*settled)
        undo_moves(b);
    return status;
}

static octree_status move_in_order(batch *b)
{
    b->leaving.count = b->arriving.count = b->done = 0;
    b->may_be_stored = false;
    b->settled = true;
    return resolve_moves_in_order(b) ? restructure(b) : OCTREE_NO_MEMORY;
}

static octree_status move_valid(batch *b)
{
    bool settled = false;
    octree_status status = OCTREE_OK;
    if (b->remakes) {
        status = remake_tree(b, &settled);
        if (settled || status != OCTREE_OK)
            return status;
        status = batch_collect(b);
    } else if (!ids_differ(b, &settled)) {
        return OCTREE_NO_MEMORY;
    } else if (settled && b->valid.count > 0) {
        status = move_independent(b, &settled);
    }
    return settled || status != OCTREE_OK ? status : move_in_order(b);
}

octree_status octree_move_many(octree *tree, const octree_point *points, const double (*to)[3], size_t count,
                               octree_status *statuses, size_t *moved)
{
    if (lie_in_leaf(tree, points, count))
        return change_copies(tree, OCTREE_MOVED, points, to, count, statuses, moved);
    if (tree && change_log_is_on(&tree->changes))
        return change_batch_and_log(tree, OCTREE_MOVED, points, to, count, statuses, moved);
    if (count && !to)
        return OCTREE_NULL_ARGUMENT;
    batch b = {.tree = tree, .points = points, .to = to, .count = count, .statuses = statuses};
    octree_status status = batch_begin(&b);
    if (status == OCTREE_OK)
        status = move_valid(&b);
    return finish(&b, status, moved);
}
