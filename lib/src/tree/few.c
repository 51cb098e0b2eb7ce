/* SPDX-License-Identifier: MIT */
/* few.c - batches of few points in a large tree: insert_small_batch() and remove_small_batch().
 *
 * Problem: of a thousand changes in a tree of a million points, hardly two change the same leaf. Sorting the changes
 * (batch.c) gains nothing. Making the changes one by one waits for a cache miss at every level of every descent.
 *
 * Idea: let 32 points descend in lockstep. At each level the next nodes of all 32 points are prefetched before the
 * first of these nodes is read, so that 32 cache misses overlap. Then the points are changed in the given order.
 * Insertion uses the found paths until a node moves in memory; points that meet a full leaf are collected and inserted
 * as one batch at the end. Removal first looks up all points, then allocates the leaves of all merges, and only then
 * changes anything.
 *
 * Cost: that of single changes, without most of the waiting for memory. For batches of up to a twentieth of the stored
 * points, this method is faster than sorting. is_small_batch() contains the measured limits.
 */
#include "few.h"
#include "tasks.h"

#include <string.h>

enum {
    CACHED = 300000, /* a tree with fewer points fits into a processor's caches, where sorting is cheaper */
    FEW = 20,        /* a batch is small if it has less than this part of the stored points: a twentieth */
    /* the same for a tree that fits into the caches: an eighth */
    FEW_OF_CACHED = 8,
};

bool is_small_batch(const octree *tree, size_t count)
{
    const uint32_t stored = tree->root.count;
    return count > 0 && count_tasks(tree, count) == 1 && count < stored / (stored < CACHED ? FEW_OF_CACHED : FEW) &&
           count <= UINT32_MAX - stored;
}

/* ---- Descents in lockstep ----------------------------------------------------------------------- */

enum { TOGETHER = 32 };

/* The paths of several points from the root to their leaves, stored level by level. A point outside the world has no
 * path. */
typedef struct descents {
    octree_status statuses[TOGETHER];
    uint64_t codes[TOGETHER];
    unsigned depths[TOGETHER];
    node *nodes[OCTREE_MAX_DEPTH + 1][TOGETHER];
} descents;

static void find_point_codes(descents *w, const octree *tree, const octree_point *points, size_t count)
{
    compute_morton_codes(tree->axes, points->position, sizeof *points / sizeof(double), count, w->codes);
    for (size_t i = 0; i < count; i++)
        w->statuses[i] = compute_code_if_unsure(tree, points[i].position, &w->codes[i]);
}

/* Let all points descend together, one level at a time, so that their cache misses overlap. */
static void find_leaves_of_points(descents *w, octree *tree, const octree_point *points, size_t count)
{
    size_t going = 0, left[TOGETHER];
    find_point_codes(w, tree, points, count);
    for (size_t i = 0; i < count; i++)
        if (w->statuses[i] == OCTREE_OK) {
            w->nodes[0][i] = &tree->root;
            left[going++] = i;
        }
    for (unsigned depth = 0; going > 0; depth++) {
        size_t next = 0;
        for (size_t k = 0; k < going; k++) {
            const size_t i = left[k];
            const node *n = w->nodes[depth][i];
            node *child = n->octants ? child_at(n, morton_octant(w->codes[i], depth)) : NULL;
            if (!child) {
                w->depths[i] = depth;
                continue;
            }
            w->nodes[depth + 1][i] = child;
            left[next++] = i;
            prefetch_node(child);
        }
        going = next;
    }
}

/* ---- Inserting ---------------------------------------------------------------------------------------------- */

typedef struct insertions {
    batch *batch;
    octree_point *full;      /* copies of the points that met a full leaf */
    octree_status *statuses; /* the statuses of all points, followed by the statuses of the points in `full` */
    size_t full_count;
} insertions;

/* Insert a point into the leaf at the end of its path. No node moves in memory, so that the paths of other points stay
 * valid. The number of points cannot overflow, because is_small_batch() has checked it. */
static octree_status insert_at_path_end(octree *tree, const octree_point *point, const descents *w, size_t i)
{
    node *leaf = w->nodes[w->depths[i]][i];
    if (leaf_find(leaf, point->position, point->id) != LEAF_NONE)
        return OCTREE_DUPLICATE;
    if (!fits_leaf(tree, (size_t)leaf->count + 1))
        return OCTREE_FULL;
    if (!leaf_append(&tree->store, leaf, point))
        return OCTREE_NO_MEMORY;
    for (unsigned depth = 0; depth < w->depths[i]; depth++)
        w->nodes[depth][i]->count++;
    return OCTREE_OK;
}

/* Insert up to TOGETHER points. If a point's path ends at an inner node, this node gets a new leaf, and nodes move in
 * memory. The remaining points then descend from the root again, one by one. */
static octree_status insert_point_group(insertions *f, size_t first, size_t count)
{
    descents w;
    bool moved = false;
    octree *tree = f->batch->tree;
    const octree_point *points = f->batch->points + first;
    find_leaves_of_points(&w, tree, points, count);
    for (size_t i = 0; i < count; i++) {
        octree_status status = w.statuses[i];
        const bool at_end = status == OCTREE_OK && !moved && !w.nodes[w.depths[i]][i]->octants;
        if (at_end)
            status = insert_at_path_end(tree, &points[i], &w, i);
        else if (status == OCTREE_OK)
            status = insert_point(tree, &points[i], w.codes[i], false);
        moved = moved || !at_end;
        f->statuses[first + i] = status;
        if (status == OCTREE_NO_MEMORY)
            return status;
        if (status == OCTREE_FULL)
            f->full[f->full_count++] = points[i];
        f->batch->done += status == OCTREE_OK;
    }
    return OCTREE_OK;
}

static void undo_insertions(const batch *b, const octree_status *statuses)
{
    for (size_t i = 0, left = b->done; left > 0; i++)
        if (statuses[i] == OCTREE_OK) {
            octree_point point = b->points[i];
            remove_point(b->tree, &point);
            left--;
        }
}

octree_status insert_small_batch(batch *b)
{
    arena *memory = &b->tree->store.memory;
    const size_t count = b->count, points_size = count * sizeof *b->points, size = 2 * count * sizeof *b->statuses;
    insertions f = {.batch = b, .full = arena_allocate(memory, points_size), .statuses = arena_allocate(memory, size)};
    batch full = {.tree = b->tree, .points = f.full, .inserts = true};
    octree_status status = f.full && f.statuses ? OCTREE_OK : OCTREE_NO_MEMORY;
    for (size_t i = 0; status == OCTREE_OK && i < count; i += TOGETHER)
        status = insert_point_group(&f, i, count - i < TOGETHER ? count - i : TOGETHER);
    if (status == OCTREE_OK && f.full_count > 0) {
        full.count = f.full_count;
        full.statuses = f.statuses + count;
        status = insert_in_morton_order(&full);
    }
    if (status != OCTREE_OK)
        undo_insertions(b, f.statuses);
    for (size_t i = 0, next = 0; status == OCTREE_OK && b->statuses && i < count; i++)
        b->statuses[i] = f.statuses[i] == OCTREE_FULL ? full.statuses[next++] : f.statuses[i];
    b->done += full.done;
    arena_free(memory, f.full, points_size);
    arena_free(memory, f.statuses, size);
    return status;
}

/* ---- Removing ----------------------------------------------------------------------------------------------- */

/* A point to remove, and the leaf that holds it. Nodes do not move in memory until the last point is removed. */
typedef struct removal {
    node *leaf, *parent; /* the leaf and its parent; the parent is null if the leaf is the root */
    uint32_t place, index;
} removal;

/* A node that will become a leaf because points of the batch are removed. */
typedef struct merging {
    node *at;
    node made; /* the new leaf, still empty but with room for the remaining points */
} merging;

typedef struct removals {
    const batch *batch;
    removal *found;
    size_t count;
    list mergings;
} removals;

/* Find up to TOGETHER points to remove, and set their statuses. Reduce the counts of the inner nodes above these
 * points, as if the points were already removed. */
static void find_removed_group(removals *r, size_t first, size_t count)
{
    descents w;
    const batch *b = r->batch;
    find_leaves_of_points(&w, b->tree, b->points + first, count);
    for (size_t i = 0; i < count; i++) {
        octree_status status = w.statuses[i];
        const octree_point *point = &b->points[first + i];
        node *end = status == OCTREE_OK ? w.nodes[w.depths[i]][i] : NULL;
        const uint32_t index = end && !end->octants ? leaf_find(end, point->position, point->id) : LEAF_NONE;
        if (index != LEAF_NONE) {
            node *parent = w.depths[i] ? w.nodes[w.depths[i] - 1][i] : NULL;
            r->found[r->count++] = (removal){end, parent, (uint32_t)(first + i), index};
            for (unsigned depth = 0; depth < w.depths[i]; depth++)
                w.nodes[depth][i]->count--;
        } else if (status == OCTREE_OK) {
            status = OCTREE_NOT_FOUND;
        }
        if (b->statuses)
            b->statuses[first + i] = status;
    }
}

static path path_to_removal(const removals *r, const removal *found)
{
    return find_path(r->batch->tree, morton_code(r->batch->tree->axes, r->batch->points[found->place].position));
}

/* Find the highest node above a removed point whose remaining points fit into one leaf, and allocate this leaf. A
 * nonzero `room` marks an inner node whose leaf is already allocated. Returns false if memory runs out. */
static bool plan_merge(removals *r, const removal *found)
{
    store *s = &r->batch->tree->store;
    const path p = path_to_removal(r, found);
    merging m = {.at = p.nodes[0]};
    for (unsigned depth = 0; !fits_leaf(r->batch->tree, m.at->count);)
        m.at = p.nodes[++depth];
    if (m.at->room)
        return true;
    if (!leaf_create(s, &m.made, m.at->count))
        return false;
    if (!list_push(&s->memory, &r->mergings, &m, sizeof m)) {
        leaf_release(s, &m.made);
        return false;
    }
    m.at->room = 1;
    return true;
}

static bool plan_merges(removals *r)
{
    bool ok = true;
    for (size_t i = 0; ok && i < r->count; i++)
        if (r->found[i].parent && fits_leaf(r->batch->tree, r->found[i].parent->count))
            ok = plan_merge(r, &r->found[i]);
    return ok;
}

static void undo_removals(removals *r)
{
    const merging *mergings = r->mergings.items;
    for (size_t i = 0; i < r->mergings.count; i++) {
        mergings[i].at->room = 0;
        leaf_release(&r->batch->tree->store, &mergings[i].made);
    }
    for (size_t i = 0; i < r->count; i++) {
        const path p = path_to_removal(r, &r->found[i]);
        for (unsigned depth = 0; depth < p.depth; depth++)
            p.nodes[depth]->count++;
    }
}

/* Remove the points from their leaves. Returns the number of removals after which the leaf was empty; these removals
 * are moved to the start of `found`. */
static size_t remove_found_points(removals *r)
{
    size_t emptied = 0;
    for (size_t i = 0; i < r->count; i++) {
        removal *it = &r->found[i];
        const octree_point *point = &r->batch->points[it->place];
        /* the removal of another point has moved this point to another index in the leaf */
        if (it->index >= it->leaf->count)
            it->index = leaf_find(it->leaf, point->position, point->id);
        leaf_remove(&r->batch->tree->store, it->leaf, it->index);
        if (it->leaf->count == 0)
            r->found[emptied++] = *it;
    }
    return emptied;
}

/* Change the tree as planned: use the allocated leaves of merging nodes, and remove the found points. Cannot fail. */
static void carry_out_removals(removals *r)
{
    octree *tree = r->batch->tree;
    const size_t emptied = remove_found_points(r);
    merging *mergings = r->mergings.items;
    for (size_t i = 0; i < r->mergings.count; i++) {
        leaf_append_all(&mergings[i].made, mergings[i].at, NULL);
        node_release(&tree->store, mergings[i].at);
        *mergings[i].at = mergings[i].made;
    }
    for (size_t i = 0; i < emptied; i++) {
        const path p = path_to_removal(r, &r->found[i]);
        if (path_end(&p)->count == 0) /* the empty leaf is never the root, because most points of the tree stay */
            remove_empty_child(tree, p.nodes[p.depth - 1], path_end(&p));
    }
}

octree_status remove_small_batch(batch *b)
{
    arena *memory = &b->tree->store.memory;
    removals r = {.batch = b, .found = arena_allocate(memory, b->count * sizeof *r.found)};
    if (!r.found)
        return OCTREE_NO_MEMORY;
    for (size_t i = 0; i < b->count; i += TOGETHER)
        find_removed_group(&r, i, b->count - i < TOGETHER ? b->count - i : TOGETHER);
    const bool ok = plan_merges(&r);
    if (ok)
        carry_out_removals(&r);
    else
        undo_removals(&r);
    b->done = r.count;
    arena_free(memory, r.found, b->count * sizeof *r.found);
    list_release(memory, &r.mergings, sizeof(merging));
    return ok ? OCTREE_OK : OCTREE_NO_MEMORY;
}
