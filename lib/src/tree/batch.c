/* SPDX-License-Identifier: MIT */
/* batch.c - prepares a batch of changes: checks its points, sorts them by Morton code, drops repeated points, and finds
 * their leaves.
 *
 * Problem: a thousand changes made one by one walk down from the root a thousand times, in random order of memory, and
 * split and merge the same leaves repeatedly.
 *
 * Idea: sort the changes by Morton code, which is the order of the leaves in a walk. All changes of one leaf are then
 * adjacent, so that one pass over the tree visits each changed leaf once. The pass keeps its path from the root, and
 * goes up only as far as the next code requires. It finds and prefetches six leaves before it visits the first of these
 * leaves.
 *
 * A point that occurs twice in a batch is changed once. An item is the Morton code and the index of a point. Items with
 * equal codes are compared in a small leaf, which serves as a hash table. A repeated item gets the status of the first
 * item of the same point.
 *
 * Large batches are divided into tasks (division.h), each with the items of whole subtrees. restructure.c then plans
 * the changes, and plan.c makes them. Cost: O(count) radix passes and one visit per leaf.
 */
#include "division.h"
#include "grid_fill.h"

#include <string.h>

/* Allocate memory for `each` items per point of the batch. An item (morton_item) is the Morton code and the index of a
 * point. */
static morton_item *allocate_items(const batch *b, size_t each)
{
    /* unreachable: the size cannot overflow, because size_t has 64 bits and a batch has at most UINT32_MAX points */
    if (b->count >= SIZE_MAX / sizeof(morton_item) / each - 1)
        return NULL;
    return arena_allocate(&b->tree->store.memory, each * (b->count + 1) * sizeof(morton_item));
}

static void release_items(const batch *b, morton_item *items, size_t each)
{
    arena_free(&b->tree->store.memory, items, each * (b->count + 1) * sizeof *items);
}

/* Returns the number of lists that share one allocation: four for a batch of moves, else one. If each list were
 * allocated separately, malloc would return the pages to the system, and every batch would cause page faults again. */
static size_t shared_list_count(const batch *b)
{
    return b->to ? 4 : 1;
}

static bool allocate_lists(batch *b)
{
    const size_t room = b->count + 1;
    b->lists = allocate_items(b, shared_list_count(b));
    b->valid.items = b->lists;
    if (b->to && b->lists) {
        b->spare = b->lists + room;
        b->leaving.items = b->lists + 2 * room;
        b->arriving.items = b->lists + 3 * room;
    }
    return b->lists != NULL;
}

enum { TOGETHER = 64 }; /* the number of positions whose codes are computed in one call */

/* Check the position of a point and, if the batch moves points, the destination. */
static octree_status check_point_and_destination(const batch *b, size_t place, uint64_t *code)
{
    const octree_status status = compute_code_if_unsure(b->tree, b->points[place].position, code);
    return status == OCTREE_OK && b->to ? check_in_world(b->tree, b->to[place]) : status;
}

/* Append items for the valid points among points[first .. first + count - 1]. */
static void collect_valid_points(batch *b, size_t first, size_t count)
{
    uint64_t codes[TOGETHER];
    compute_morton_codes(b->tree->axes, b->points[first].position, sizeof *b->points / sizeof(double), count, codes);
    for (size_t i = 0; i < count; i++) {
        const size_t place = first + i;
        const octree_status status = check_point_and_destination(b, place, &codes[i]);
        if (status == OCTREE_OK)
            b->valid.items[b->valid.count++] = (morton_item){codes[i], (uint32_t)place, MORTON_NEW};
        if (b->statuses)
            b->statuses[place] = status;
    }
}

static void collect_valid_range(batch *b, size_t first, size_t end)
{
    for (size_t i = first; i < end; i += TOGETHER)
        collect_valid_points(b, i, end - i < TOGETHER ? end - i : TOGETHER);
}

/* Collect the items of one part of the batch. The items are stored from the index of the part's first point on. */
static void collect_valid_points_of_part(size_t number, void *context)
{
    division *d = context;
    batch *b = &d->parts[number].batch;
    const size_t first = find_share_start(b->count, d->tasks, number);
    b->valid = (span){b->valid.items + first, 0};
    collect_valid_range(b, first, find_share_start(b->count, d->tasks, number + 1));
}

/* Append the items of a part to the items of the previous parts, so that no gap is left between them. */
static void append_part_items(span *all, span part)
{
    if (part.count > 0 && all->items + all->count != part.items)
        memmove(all->items + all->count, part.items, part.count * sizeof *part.items);
    all->count += part.count;
}

static void collect_valid_items(batch *b)
{
    division *d = b->division;
    if (!d) {
        collect_valid_range(b, 0, b->count);
        return;
    }
    run_task_for_each_part(b, collect_valid_points_of_part);
    for (unsigned i = 0; i < d->tasks; i++)
        append_part_items(&b->valid, d->parts[i].batch.valid);
}

enum { LEAST_REBUILT = 64 };

static bool sort_items(batch *b)
{
    morton_item *spare = b->spare ? b->spare : allocate_items(b, 1);
    if (!spare)
        return false;
    const size_t unsorted = b->tree->root.count == 0 ? unsorted_limit(b->tree) : 0;
    const bool differ = unsorted > 0 && are_ids_ascending(b);
    b->repeated =
        morton_sort_by_tasks(b->tree, &b->tree->store.memory, b->valid.items, spare, b->valid.count, unsorted, differ);
    if (!b->spare)
        release_items(b, spare, 1);
    return true;
}

enum { LEVELS_BELOW = 6 };

/* Returns whether moves rarely meet a full leaf. This is so if the tree never refuses a point, or if a cell at the
 * maximum depth is much smaller than a cell of the deepest grid (grid_fill.c). */
static bool rarely_refuses_points(const octree_def *def)
{
    return def->full_leaf != OCTREE_REFUSE || def->max_depth >= GRID_DEEPEST + LEVELS_BELOW;
}

/* A rebuild is worth its cost if at least three tenths of the points move. A rebuild writes up to 64 bytes of new
 * memory for each stored point, and page faults in this memory take half of the time of the first rebuild. For a move
 * of a fifth of the points, a rebuild took longer than a loop of octree_move (octree-bench, move_20%). */
bool is_rebuild_cheaper(const octree *tree, size_t count)
{
    return tree->root.count >= LEAST_REBUILT && count >= tree->root.count / 10 * 3;
}

/* Decide whether a batch of moves rebuilds the tree, by a grid (grid_fill.c) or by sorting. A grid is tried only if
 * moves rarely meet a full leaf, because only sorting finds the points that may meet one. Returns false if memory runs
 * out. */
static bool decide_rebuild(batch *b)
{
    const size_t stored = b->tree->root.count;
    b->rebuilds = b->to && is_rebuild_cheaper(b->tree, b->count);
    return !b->rebuilds || !rarely_refuses_points(&b->tree->def) || choose_grid(b, stored);
}

octree_status prepare_batch(batch *b)
{
    b->store = &b->tree->store;
    if (!decide_rebuild(b))
        return OCTREE_NO_MEMORY;
    divide_work_of_batch(b);
    return b->rebuilds ? OCTREE_OK : collect_batch_points(b);
}

/* Find the grid cells of one task's points. A batch that is inserted into an empty tree uses these cells instead of
 * items. */
static void find_cells_in_task(size_t number, void *context)
{
    const batch *b = context;
    const unsigned tasks = count_tasks(b->tree, b->count);
    const size_t end = find_share_start(b->count, tasks, number + 1);
    for (size_t i = find_share_start(b->count, tasks, number); i < end; i += GRID_TOGETHER)
        find_grid_cells(b, b->points + i, end - i < GRID_TOGETHER ? end - i : GRID_TOGETHER, b->cells + i,
                        b->statuses ? b->statuses + i : NULL);
}

octree_status collect_batch_points(batch *b)
{
    if (b->inserts && b->tree->root.count == 0 && are_ids_ascending(b) && !choose_grid(b, b->count))
        return OCTREE_NO_MEMORY;
    if (b->grid > 0) {
        b->cells = arena_allocate(&b->store->memory, b->count * sizeof *b->cells);
        if (!b->cells)
            return OCTREE_NO_MEMORY;
        run_tasks(b->tree, find_cells_in_task, count_tasks(b->tree, b->count), b);
        return OCTREE_OK;
    }
    if (!allocate_lists(b))
        return OCTREE_NO_MEMORY;
    collect_valid_items(b);
    return sort_items(b) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

/* A point that repeats an earlier point of the batch: its index, and the index of the earlier point. */
typedef struct repetition {
    uint32_t place, first;
} repetition;

void release_repetitions(batch *b)
{
    list_release(&b->tree->store.memory, &b->repetitions, sizeof(repetition));
}

void release_batch(batch *b)
{
    release_repetitions(b);
    release_work_division(b);
    release_items(b, b->lists, shared_list_count(b));
    arena_free(&b->tree->store.memory, b->cells, b->count * sizeof *b->cells);
}

size_t count_in_first_octant(const morton_item *items, size_t count, unsigned depth)
{
    const unsigned octant = morton_octant(items[0].code, depth);
    size_t low = 1, high = count; /* invariant: the index of the first item in another octant is in [low, high] */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (morton_octant(items[middle].code, depth) == octant)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Returns whether the ids of the items' points are strictly ascending. */
static bool are_item_ids_ascending(const batch *b, const morton_item *items, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (b->points[items[i].place].id <= b->points[items[i - 1].place].id)
            return false;
    return true;
}

/* Of several items with the same pair (position, id), keep the first; the items have equal codes and are in the
 * caller's order. Add the other items to the list of repetitions. *kept receives the number of items kept. Returns
 * false if memory runs out. */
static bool drop_repeated_items(batch *b, morton_item *items, size_t count, size_t *kept)
{
    store *st = &b->tree->store;
    node distinct;
    *kept = count;
    if (are_item_ids_ascending(b, items, count))
        return true;
    bool ok = leaf_create(st, &distinct, (uint32_t)count);
    for (size_t i = 0; ok && i < count; i++) {
        const octree_point *point = &b->points[items[i].place];
        const uint32_t first = leaf_find(&distinct, point->position, point->id);
        if (first == LEAF_NONE) {
            items[distinct.count] = items[i];
            leaf_append_unchecked(&distinct, point);
            continue;
        }
        const repetition r = {items[i].place, items[first].place};
        ok = list_push(&st->memory, &b->repetitions, &r, sizeof r);
    }
    *kept = distinct.count;
    leaf_release(st, &distinct);
    return ok;
}

bool drop_repeated_pairs(batch *b)
{
    morton_item *items = b->valid.items;
    size_t left = 0;
    for (size_t start = 0, end, kept; b->repeated && start < b->valid.count; start = end, left += kept) {
        for (end = start + 1; end < b->valid.count && items[end].code == items[start].code; end++)
            ;
        kept = 1;
        if (end - start > 1 && !drop_repeated_items(b, items + start, end - start, &kept))
            return false;
        memmove(items + left, items + start, kept * sizeof *items);
    }
    if (b->repeated)
        b->valid.count = left;
    return true;
}

void set_statuses_of_repetitions(const batch *b, octree_status status)
{
    const repetition *all = b->repetitions.items;
    for (size_t i = 0; b->statuses && i < b->repetitions.count; i++)
        b->statuses[all[i].place] = b->statuses[all[i].first] == OCTREE_FULL ? OCTREE_FULL : status;
}

/* ---- Visiting the leaves of the items --------------------------------------------------------------------------- */

/* A leaf, and the items of the batch in the leaf's cell. A null node means that no node exists for the items'
 * octant. */
typedef struct visit {
    node *node;
    unsigned depth;
    span items;
} visit;

/* Returns the number of items that lie in the same cell of this depth as the first item. The items are sorted. The
 * search is linear, because the number is usually small. */
static size_t count_in_first_cell(const batch *b, span items, unsigned depth)
{
    const unsigned below = 3 * (OCTREE_MAX_DEPTH - depth);
    size_t share = 0;
    for (; share < items.count && (items.items[share].code ^ items.items[0].code) >> below == 0; share++)
        prefetch_item(b, &items.items[share]);
    return share;
}

/* Extend the path down to the leaf of the first item, and store this leaf and its items in *next. Then shorten the path
 * to its deepest node that also contains the first item of the next leaf. */
static void find_next_visit(const batch *b, path *p, unsigned top, span *items, visit *next)
{
    const uint64_t code = items->items[0].code;
    node *n = path_end(p);
    while (n && n->octants) {
        n = child_at(n, morton_octant(code, p->depth));
        p->nodes[++p->depth] = n;
    }
    if (n)
        leaf_prefetch(n);
    const size_t share = count_in_first_cell(b, *items, p->depth);
    *next = (visit){n, p->depth, {items->items, share}};
    items->items += share;
    items->count -= share;
    while (items->count > 0 && p->depth > top &&
           (items->items[0].code ^ code) >> 3 * (OCTREE_MAX_DEPTH - p->depth) != 0)
        p->depth--;
}

enum { LEAVES_TOGETHER = 6 }; /* the number of leaves that are prefetched before the first of these leaves is visited */

/* Visit the leaves that contain the items. All items lie below a node of this depth. */
static void visit_leaves_below(batch *b, node *n, unsigned depth, span items, leaf_visitor *visitor)
{
    path p = {.depth = depth};
    p.nodes[depth] = n;
    while (items.count > 0) {
        visit next[LEAVES_TOGETHER];
        size_t count = 0;
        while (items.count > 0 && count < LEAVES_TOGETHER)
            find_next_visit(b, &p, depth, &items, &next[count++]);
        for (size_t i = 0; i < count; i++)
            visitor(b, next[i].node, next[i].depth, next[i].items);
    }
}

/* ---- Visiting by tasks -------------------------------------------------------------------------------------- */

/* Add jobs that visit the leaves of the items. A job is a subtree with its items. It has at most `grain` items, or its
 * subtree is a single leaf. Returns false if memory runs out. */
static bool add_visit_jobs(batch *b, const node *n, unsigned depth, span items)
{
    if (!n || !n->octants || items.count <= b->division->grain)
        return add_job(b, n, (cell){.depth = depth}, (span){NULL, 0}, items);
    span shares[8];
    divide_items_by_octant(items, depth, shares);
    for (unsigned octant = 0; octant < 8; octant++)
        if (shares[octant].count > 0 && !add_visit_jobs(b, child_at(n, octant), depth + 1, shares[octant]))
            return false;
    return true;
}

/* Returns an empty list that uses the memory of another list, from index `before` on. */
static span empty_span_at(span list, size_t before)
{
    return (span){list.items ? list.items + before : NULL, 0};
}

/* Visit the leaves of one part. The part writes its lists into the shared lists, from the index of its first item on,
 * so that the lists of parts do not overlap. */
static void visit_leaves_of_part(size_t number, void *context)
{
    division *d = context;
    const size_t first = d->starts[number], end = d->starts[number + 1];
    const job *jobs = d->work.jobs.items;
    batch *b = &d->parts[number].batch;
    const size_t before = first < end ? (size_t)(jobs[first].arriving.items - b->valid.items) : 0;
    b->leaving = empty_span_at(b->leaving, before);
    b->arriving = empty_span_at(b->arriving, before);
    b->done = 0;
    /* The cast removes const, which is correct because the nodes of the tree are not const. */
    for (size_t i = first; i < end; i++)
        visit_leaves_below(b, (node *)(uintptr_t)jobs[i].old, jobs[i].cell.depth, jobs[i].arriving, d->visitor);
}

/* Visit the leaves of all items by tasks. Returns false if memory runs out; no leaf was visited then. */
static bool visit_leaves_by_tasks(batch *b, leaf_visitor *visitor)
{
    division *d = b->division;
    const bool ok = add_visit_jobs(b, &b->tree->root, 0, b->valid);
    if (ok) {
        d->visitor = visitor;
        assign_jobs_to_tasks(d);
        run_task_for_each_part(b, visit_leaves_of_part);
    }
    for (unsigned i = 0; ok && i < d->tasks; i++) {
        const batch *part = &d->parts[i].batch;
        append_part_items(&b->leaving, part->leaving);
        append_part_items(&b->arriving, part->arriving);
        b->done += part->done;
    }
    list_release(&b->store->memory, &d->work.jobs, sizeof(job));
    return ok;
}

void visit_batch_leaves(batch *b, leaf_visitor *visitor)
{
    if (b->valid.count == 0 || (b->division && visit_leaves_by_tasks(b, visitor)))
        return;
    visit_leaves_below(b, &b->tree->root, 0, b->valid, visitor);
}
