/* SPDX-License-Identifier: MIT */
/* bulk.c - octree_insert_many(), octree_remove_many() and octree_move_many(). This file sets the statuses, and lists
 * the points that leave their positions and the points that arrive at new positions. */
#include "batch.h"
#include "../exact/float_mode.h"
#include "few.h"

#include <string.h>

/* ---- Inserting ---------------------------------------------------------------------------------------------- */

static octree_status insert_valid_points(batch *b)
{
    const uint32_t before = b->tree->root.count;
    if (!drop_repeated_pairs(b))
        return OCTREE_NO_MEMORY;
    if (b->valid.count > UINT32_MAX - before)
        return OCTREE_TOO_MANY;
    b->arriving = b->valid;
    b->may_be_stored = true;
    const octree_status status = restructure_tree(b);
    b->done = b->tree->root.count - before;
    set_statuses_of_repetitions(b, OCTREE_DUPLICATE);
    return status;
}

/* ---- Removing ----------------------------------------------------------------------------------------------- */

/* Find the items' points in a leaf, and add the items whose points are stored there to the list `leaving`, with the
 * points' indices in the leaf. */
static void find_removed_points(batch *b, node *leaf, unsigned depth, span items)
{
    (void)depth;
    for (size_t i = 0; i < items.count; i++) {
        const octree_point *point = &b->points[items.items[i].place];
        const uint32_t index = leaf ? leaf_find(leaf, point->position, point->id) : LEAF_NONE;
        if (index == LEAF_NONE)
            set_item_status(b, &items.items[i], OCTREE_NOT_FOUND);
        else
            b->leaving.items[b->leaving.count++] = (morton_item){items.items[i].code, items.items[i].place, index};
    }
}

static octree_status remove_valid_points(batch *b)
{
    if (!drop_repeated_pairs(b))
        return OCTREE_NO_MEMORY;
    b->leaving.items = b->valid.items;
    visit_batch_leaves(b, find_removed_points);
    set_statuses_of_repetitions(b, OCTREE_NOT_FOUND);
    b->done = b->leaving.count;
    return restructure_tree(b);
}

/* ---- Moving ------------------------------------------------------------------------------------------------- */

static bool have_same_bits(const double a[3], const double b[3])
{
    return memcmp(a, b, 3 * sizeof *a) == 0;
}

/* Move a point that was found in a leaf. If the point stays in its leaf, move it now; undo_moves_within_leaves() can
 * revert this without allocating memory. Otherwise list the point as leaving and as arriving. */
static void move_found_point(batch *b, node *leaf, unsigned depth, morton_item *item, uint32_t index)
{
    const double *to = b->to[item->place];
    octree_point *stored = &leaf_points(leaf)[index];
    const uint64_t code = morton_code(b->tree->axes, to), unlike = code ^ item->code;
    const bool is_simple =
        leaf->room != LEAF_HASHED && have_same_bits(stored->position, b->points[item->place].position);
    if (is_simple && unlike >> 3 * (OCTREE_MAX_DEPTH - depth) == 0) {
        const uint32_t taken = leaf_find(leaf, to, stored->id);
        if (taken != LEAF_NONE && taken != index) {
            set_item_status(b, item, OCTREE_DUPLICATE);
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

/* Returns the index of a point in a leaf, or LEAF_NONE. A leaf that was built from a batch keeps the order of the
 * batch, so the search begins with the point after `last`, the index that was found before. */
static uint32_t find_in_leaf_starting_after(const node *leaf, uint32_t last, const octree_point *point)
{
    const uint32_t next = last + 1; /* if no point was found yet, `last` is LEAF_NONE, and `next` becomes 0 */
    if (!leaf)
        return LEAF_NONE;
    if (next < leaf->count && leaf_points(leaf)[next].id == point->id &&
        is_same_position(leaf_points(leaf)[next].position, point->position))
        return next;
    return leaf_find(leaf, point->position, point->id);
}

static void find_moved_points(batch *b, node *leaf, unsigned depth, span items)
{
    uint32_t index = LEAF_NONE;
    for (size_t i = 0; i < items.count; i++) {
        morton_item *item = &items.items[i];
        index = find_in_leaf_starting_after(leaf, index, &b->points[item->place]);
        if (index == LEAF_NONE)
            set_item_status(b, item, OCTREE_NOT_FOUND);
        else
            move_found_point(b, leaf, depth, item, index);
    }
}

/* Revert the moves within leaves that move_found_point() has already made, the last one first. This is possible because
 * no node has moved or changed since then. */
static void undo_moves_within_leaves(batch *b)
{
    for (size_t i = b->valid.count; i-- > 0;) {
        morton_item *item = &b->valid.items[i];
        if (item->index == MORTON_NEW)
            continue;
        const path p = find_path(b->tree, item->code);
        leaf_points(path_end(&p))[item->index] = b->points[item->place];
        item->index = MORTON_NEW;
    }
}

/* Make moves whose ids differ. *settled becomes false if moves depend on one another; the tree is then unchanged. */
static octree_status make_independent_moves(batch *b, bool *settled)
{
    b->may_be_stored = true;
    visit_batch_leaves(b, find_moved_points);
    morton_sort_by_tasks(b->tree, &b->tree->store.memory, b->arriving.items, b->spare, b->arriving.count, 0, true);
    const octree_status status = restructure_tree(b);
    *settled = !b->duplicate && !b->overflow;
    if (status != OCTREE_OK || !*settled)
        undo_moves_within_leaves(b);
    return status;
}

static octree_status make_moves_in_order(batch *b)
{
    b->leaving.count = b->arriving.count = b->done = 0;
    b->may_be_stored = false;
    b->settled = true;
    return simulate_moves_in_order(b) ? restructure_tree(b) : OCTREE_NO_MEMORY;
}

static octree_status move_valid_points(batch *b)
{
    bool settled = false;
    octree_status status = OCTREE_OK;
    if (b->rebuilds) {
        status = move_points_by_rebuild(b, &settled);
        if (settled || status != OCTREE_OK)
            return status;
        status = collect_batch_points(b);
    } else if (!check_ids_differ(b, &settled)) {
        return OCTREE_NO_MEMORY;
    } else if (settled && b->valid.count > 0) {
        status = make_independent_moves(b, &settled);
    }
    return settled || status != OCTREE_OK ? status : make_moves_in_order(b);
}

/* ---- Many changes of one kind ------------------------------------------------------------------------------- */

static octree_status check_arguments(const batch *b, octree_change_kind kind)
{
    if (!b->tree || (b->count && (!b->points || (kind == OCTREE_MOVED && !b->to))))
        return OCTREE_NULL_ARGUMENT;
    if (b->count >= UINT32_MAX)
        return OCTREE_TOO_MANY;
    return is_running_callback(b->tree) ? OCTREE_BUSY : OCTREE_OK;
}

/* Returns whether the pointer `position` points into a leaf of the tree, as pointers into octree_node.points do. */
static bool is_in_tree_memory(const octree *tree, const double *position)
{
    if (check_position(tree, position) != OCTREE_OK)
        return false;
    const path p = find_path(tree, morton_code(tree->axes, position));
    const node *end = path_end(&p);
    /* for an address below the leaf's first point, the difference wraps around and is large */
    return end->octants == 0 &&
           (uintptr_t)position - (uintptr_t)leaf_points(end) < (size_t)end->count * sizeof(octree_point);
}

/* Sort the points of a batch, and call `change` to change the tree. */
static octree_status change_in_morton_order(batch *b, octree_status (*change)(batch *b))
{
    octree_status status = prepare_batch(b);
    if (status == OCTREE_OK)
        status = change(b);
    release_batch(b);
    return status;
}

octree_status insert_in_morton_order(batch *b)
{
    return change_in_morton_order(b, insert_valid_points);
}

static octree_status change_by_kind(batch *b, octree_change_kind kind)
{
    const bool few = kind != OCTREE_MOVED && is_small_batch(b->tree, b->count);
    bool differ = false;
    switch (kind) {
    case OCTREE_INSERTED:
        return few ? insert_small_batch(b) : insert_in_morton_order(b);
    case OCTREE_REMOVED:
        if (few && !check_ids_differ(b, &differ))
            return OCTREE_NO_MEMORY;
        return differ ? remove_small_batch(b) : change_in_morton_order(b, remove_valid_points);
    default:
        return change_in_morton_order(b, move_valid_points);
    }
}

/* ---- Logging ------------------------------------------------------------------------------------------------ */

/* Returns whether a coordinate of a position is zero. Only +0 and -0 are equal but have different bits, so a position
 * without zeros has the same bits as the equal stored position. */
static bool has_zero_coordinate(const double position[3])
{
    return position[0] == 0 || position[1] == 0 || position[2] == 0;
}

static bool any_has_zero_coordinate(const octree_point *points, size_t count)
{
    size_t i = 0;
    while (i < count && !has_zero_coordinate(points[i].position))
        i++;
    return i < count;
}

/* Give each zero in the points' positions the sign that this zero has in the stored position. */
static void copy_signs_of_zeros(const octree *tree, octree_point *points, size_t count)
{
    found_point found;
    for (size_t i = 0; i < count; i++)
        if (has_zero_coordinate(points[i].position) && check_in_world(tree, points[i].position) == OCTREE_OK &&
            find_point(tree, points[i].position, points[i].id, &found))
            points[i] = stored_point(&found);
}

/* The points with a zero coordinate that earlier moves of the batch have moved. They are stored in a leaf outside the
 * tree. A later move of the batch may start at one of these points. */
typedef struct moved_points {
    store *store;
    node points;
    bool complete; /* false: memory ran out, so some of the points are missing */
} moved_points;

/* Log a move. If an earlier move of the batch brought the point to its position, log the position with the bits that
 * the earlier move gave it. */
static void log_move(const batch *b, size_t i, moved_points *moved)
{
    octree_point old = b->points[i], made = {.id = old.id};
    memcpy(made.position, b->to[i], sizeof made.position);
    const uint32_t index =
        has_zero_coordinate(old.position) ? leaf_find(&moved->points, old.position, old.id) : LEAF_NONE;
    if (index != LEAF_NONE) {
        old = leaf_points(&moved->points)[index];
        leaf_remove(moved->store, &moved->points, index);
    }
    if (has_zero_coordinate(made.position))
        moved->complete = leaf_append(moved->store, &moved->points, &made);
    change_log_append(b->tree, OCTREE_MOVED, &old, made.position);
}

static void log_moves(const batch *b)
{
    change_log *log = &b->tree->changes;
    moved_points moved = {.store = &b->tree->store, .complete = true};
    for (size_t i = 0; i < b->count && moved.complete && change_log_is_on(log); i++)
        if (b->statuses[i] == OCTREE_OK)
            log_move(b, i, &moved);
    leaf_release(moved.store, &moved.points);
    if (!moved.complete)
        change_log_stop(log, &moved.store->memory);
}

static void log_changes(const batch *b, octree_change_kind kind)
{
    if (kind == OCTREE_MOVED) {
        log_moves(b);
        return;
    }
    for (size_t i = 0; i < b->count && change_log_is_on(&b->tree->changes); i++)
        if (b->statuses[i] == OCTREE_OK)
            change_log_append(b->tree, kind, &b->points[i], b->points[i].position);
}

/* Make a batch of changes and log the changes. Points and destinations that lie in the tree's own memory are copied
 * first. Points are also copied if a zero in them may have another sign than the stored zero. */
static octree_status apply_batch(batch b, octree_change_kind kind, size_t *done)
{
    octree_status status = check_arguments(&b, kind);
    if (status != OCTREE_OK)
        return status;
    change_log *log = &b.tree->changes;
    arena *memory = &b.tree->store.memory;
    const uint64_t version = b.tree->version;
    const bool in_tree = b.count > 0 && is_in_tree_memory(b.tree, b.points->position);
    const bool to_in_tree = b.count > 0 && b.to && is_in_tree_memory(b.tree, b.to[0]);
    bool logs = change_log_is_on(log) && b.count <= change_log_limit(b.tree);
    const bool signs = logs && kind != OCTREE_INSERTED && any_has_zero_coordinate(b.points, b.count);
    const size_t copies_size = in_tree || signs ? b.count * sizeof *b.points : 0;
    const size_t to_size = to_in_tree ? b.count * sizeof *b.to : 0;
    const size_t statuses_size = logs && !b.statuses ? b.count * sizeof *b.statuses : 0;
    octree_point *copies = copies_size ? arena_allocate(memory, copies_size) : NULL;
    void *to = to_size ? arena_allocate(memory, to_size) : NULL;
    octree_status *statuses = statuses_size ? arena_allocate(memory, statuses_size) : NULL;
    logs = logs && (copies || !signs);
    if (copies)
        b.points = memcpy(copies, b.points, copies_size);
    if (copies && signs)
        copy_signs_of_zeros(b.tree, copies, b.count);
    if (to)
        b.to = memcpy(to, b.to, to_size);
    if (statuses)
        b.statuses = statuses;
    status = (in_tree && !copies) || (to_in_tree && !to) ? OCTREE_NO_MEMORY : change_by_kind(&b, kind);
    const bool changes = status == OCTREE_OK && b.done > 0;
    b.tree->version = version + changes;
    if (changes && logs && b.statuses)
        log_changes(&b, kind);
    else if (changes && change_log_is_on(log))
        change_log_stop(log, memory);
    if (status == OCTREE_OK && done)
        *done = b.done;
    arena_free(memory, copies, copies_size);
    arena_free(memory, to, to_size);
    arena_free(memory, statuses, statuses_size);
    return status;
}

octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_insert_many, tree, points, count, statuses, inserted);
    const batch b = {.tree = tree, .points = points, .count = count, .statuses = statuses, .inserts = true};
    const octree_status status = apply_batch(b, OCTREE_INSERTED, inserted);
    if (status == OCTREE_OK)
        tune_if_due(tree);
    return status;
}

octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_remove_many, tree, points, count, statuses, removed);
    const batch b = {.tree = tree, .points = points, .count = count, .statuses = statuses};
    return apply_batch(b, OCTREE_REMOVED, removed);
}

static octree_status move_one(const batch *b, size_t *moved)
{
    const octree_status status = octree_move(b->tree, b->points->position, b->points->id, b->to[0]);
    if (status == OCTREE_NO_MEMORY)
        return status;
    if (b->statuses)
        *b->statuses = status;
    if (moved)
        *moved = status == OCTREE_OK;
    return OCTREE_OK;
}

/* Returns whether a batch of moves is made one by one. The arrays of a batch that move_few() does not copy must lie
 * outside the tree's memory. */
static bool should_move_one_by_one(const batch *b)
{
    return is_small_batch_of_moves(b) &&
           (b->count <= FEW_AT_ONCE ||
            (!is_in_tree_memory(b->tree, b->points->position) && !is_in_tree_memory(b->tree, b->to[0])));
}

/* Move few points one by one. At most FEW_AT_ONCE moves are copied, which takes less time than finding out whether they
 * lie in the tree's memory. */
static octree_status move_few(batch b, size_t *moved)
{
    octree_point points[FEW_AT_ONCE];
    double to[FEW_AT_ONCE][3];
    if (b.count <= FEW_AT_ONCE) {
        b.points = memcpy(points, b.points, b.count * sizeof *points);
        b.to = (const double(*)[3])memcpy(to, b.to, b.count * sizeof *to);
    }
    return move_small_batch(&b, moved);
}

octree_status octree_move_many(octree *tree, const octree_point *points, const double (*to)[3], size_t count,
                               octree_status *statuses, size_t *moved)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_move_many, tree, points, to, count, statuses, moved);
    const batch b = {.tree = tree, .points = points, .to = to, .count = count, .statuses = statuses};
    const octree_status status = check_arguments(&b, OCTREE_MOVED);
    if (status != OCTREE_OK)
        return status;
    if (count == 1)
        return move_one(&b, moved);
    return should_move_one_by_one(&b) ? move_few(b, moved) : apply_batch(b, OCTREE_MOVED, moved);
}
