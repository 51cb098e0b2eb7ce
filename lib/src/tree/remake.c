/* SPDX-License-Identifier: MIT */
/* remake.c - a batch of which many points move: all points of the tree are looked up in the batch, leaf by leaf, and
 * the tree is built anew. That reads and writes each point twice, whatever the share that moves. */
#include "division.h"

#include <string.h>

/* The moves by their ids: by the id itself where ids are dense, else by open addressing with linear probing. */
typedef struct id_table {
    uint32_t *slots; /* the place of a move, and 1; 0: none */
    size_t slot_count;
    uint64_t least; /* id */
    bool dense;
} id_table;

typedef struct remake {
    batch *whole; /* the moves */
    id_table ids;
    bool *found;         /* of each move: it was stored */
    octree_point *fresh; /* all points as they will be, leaf by leaf */
    morton_item *items, *spare;
    unsigned tasks;
    size_t subtree_count;
    subtree subtrees[SUBTREES_AT_MOST];
    size_t moved[TASKS_AT_MOST];
} remake;

/* ---- The moves by their ids --------------------------------------------------------------------------------- */

static bool take_table(const batch *b, id_table *t)
{
    uint64_t least = UINT64_MAX, most = 0;
    for (size_t i = 0; i < b->valid.count; i++) {
        const uint64_t id = b->points[b->valid.items[i].place].id;
        least = id < least ? id : least;
        most = id > most ? id : most;
    }
    t->least = least;
    t->dense = most - least < 4 * (uint64_t)b->valid.count;
    t->slot_count = t->dense ? (size_t)(most - least) + 1 : 64;
    while (!t->dense && t->slot_count < 2 * b->valid.count)
        t->slot_count *= 2;
    t->slots = arena_take(&b->store->memory, t->slot_count * sizeof *t->slots);
    if (t->slots)
        memset(t->slots, 0, t->slot_count * sizeof *t->slots);
    return t->slots != NULL;
}

static size_t home_of(const id_table *t, uint64_t id)
{
    return (size_t)((id ^ id >> 32) * UINT64_C(0x9e3779b97f4a7c15) >> 16) & (t->slot_count - 1);
}

/* The slot of an id, or the empty one where the search ends; null when no move can have it. */
static uint32_t *slot_of(const id_table *t, const octree_point *points, uint64_t id)
{
    if (t->dense)
        return id - t->least < t->slot_count ? &t->slots[id - t->least] : NULL;
    size_t slot = home_of(t, id);
    while (t->slots[slot] && points[t->slots[slot] - 1].id != id)
        slot = (slot + 1) & (t->slot_count - 1);
    return &t->slots[slot];
}

/* False when two moves have one id. */
static bool fill_table(const batch *b, id_table *t)
{
    for (size_t i = 0; i < b->valid.count; i++) {
        const uint32_t place = b->valid.items[i].place;
        uint32_t *slot = slot_of(t, b->points, b->points[place].id);
        if (*slot)
            return false;
        *slot = place + 1;
    }
    return true;
}

/* ---- The points as they will be ----------------------------------------------------------------------------- */

enum { TOGETHER = 64 };

/* Points of a leaf. Where they are in the batch is found first, so that this memory is loaded at once. */
static size_t move_some(const remake *r, const octree_point *stored, size_t count, octree_point *fresh)
{
    const batch *b = r->whole;
    uint32_t places[TOGETHER];
    size_t moved = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t *slot = slot_of(&r->ids, b->points, stored[i].id);
        places[i] = slot ? *slot : 0;
        if (places[i]) {
            prefetch(&b->points[places[i] - 1]);
            prefetch(&b->to[places[i] - 1]);
        }
    }
    for (size_t i = 0; i < count; i++) {
        fresh[i] = stored[i];
        if (!places[i] || !same_position(b->points[places[i] - 1].position, stored[i].position))
            continue;
        memcpy(fresh[i].position, b->to[places[i] - 1], sizeof fresh[i].position);
        r->found[places[i] - 1] = true;
        moved++;
    }
    return moved;
}

static void code_some(const remake *r, size_t first, size_t count)
{
    const axis *axes = r->whole->tree->axes;
    uint64_t codes[TOGETHER];
    morton_codes(axes, r->fresh[first].position, sizeof *r->fresh / sizeof(double), count, codes);
    for (size_t i = 0; i < count; i++) {
        const uint64_t code = codes[i] == MORTON_UNSURE ? morton_code(axes, r->fresh[first + i].position) : codes[i];
        r->items[first + i] = (morton_item){code, (uint32_t)(first + i), MORTON_NEW};
    }
}

/* The leaves below a node, whose points come after `first` others. Returns how many move. */
static size_t move_below(const remake *r, const node *n, size_t first)
{
    size_t moved = 0;
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++) {
        const node *child = &children_of(n)[i];
        if (i + 1 < children && !child[1].octants)
            leaf_prefetch(&child[1]);
        moved += move_below(r, child, first);
        first += child->count;
    }
    for (size_t i = 0; children == 0 && i < n->count; i += TOGETHER) {
        const size_t count = n->count - i < TOGETHER ? n->count - i : TOGETHER;
        moved += move_some(r, leaf_points(n) + i, count, r->fresh + first + i);
        code_some(r, first + i, count);
    }
    return moved;
}

static void move_share(size_t number, void *context)
{
    remake *r = context;
    const octree *tree = r->whole->tree;
    const size_t end = subtrees_share(tree, r->subtrees, r->subtree_count, r->tasks, number + 1);
    r->moved[number] = 0;
    for (size_t i = subtrees_share(tree, r->subtrees, r->subtree_count, r->tasks, number); i < end; i++)
        r->moved[number] += move_below(r, r->subtrees[i].node, r->subtrees[i].before);
}

/* ---- The tree anew ------------------------------------------------------------------------------------------ */

static void set_absent_statuses(const remake *r)
{
    const batch *b = r->whole;
    for (size_t i = 0; i < b->valid.count; i++)
        if (!r->found[b->valid.items[i].place])
            set_status(b, &b->valid.items[i], OCTREE_NOT_FOUND);
}

static octree_status build_fresh(remake *r, bool *settled)
{
    octree *tree = r->whole->tree;
    const size_t count = tree->root.count;
    const size_t unsorted = tree->def.full_leaf == OCTREE_REFUSE ? 0 : unsorted_count(tree);
    batch b = {.tree = tree,
               .store = r->whole->store,
               .division = r->whole->division,
               .points = r->fresh,
               .count = count,
               .valid = {r->items, count}};
    b.repeated = morton_sort_tasks(tree, &tree->store.memory, r->items, r->spare, count, unsorted);
    octree_status status = drop_repetitions(&b) ? OCTREE_OK : OCTREE_NO_MEMORY;
    *settled = b.repetitions.count == 0;
    if (status == OCTREE_OK && *settled) {
        b.arriving = b.leaving = b.valid;
        b.valid.count = 0;
        status = restructure(&b);
        *settled = !b.overflow;
    }
    release_repetitions(&b);
    return status;
}

static octree_status move_and_build(remake *r, bool *settled)
{
    batch *b = r->whole;
    if (!fill_table(b, &r->ids)) {
        *settled = false;
        return OCTREE_OK;
    }
    r->tasks = tasks_for(b->tree, b->tree->root.count);
    r->subtree_count = subtrees_of(b->tree, r->tasks, NULL, NULL, r->subtrees);
    tasks_run(b->tree, move_share, r->tasks, r);
    b->done = 0;
    for (unsigned i = 0; i < r->tasks; i++)
        b->done += r->moved[i];
    const octree_status status = b->done > 0 ? build_fresh(r, settled) : OCTREE_OK;
    if (b->done < b->valid.count)
        set_absent_statuses(r);
    return status;
}

octree_status remake_tree(batch *b, bool *settled)
{
    arena *memory = &b->store->memory;
    const size_t count = b->tree->root.count;
    remake *r = arena_take(memory, sizeof *r);
    octree_status status = OCTREE_NO_MEMORY;
    *settled = true;
    if (!r)
        return status;
    r->whole = b;
    r->ids.slots = NULL;
    r->found = arena_take(memory, b->count);
    r->fresh = arena_take(memory, count * sizeof *r->fresh);
    r->items = arena_take(memory, 2 * count * sizeof *r->items);
    r->spare = r->items ? r->items + count : NULL;
    if (r->found && r->fresh && r->items && take_table(b, &r->ids)) {
        memset(r->found, 0, b->count);
        status = move_and_build(r, settled);
    }
    arena_give(memory, r->found, b->count);
    arena_give(memory, r->fresh, count * sizeof *r->fresh);
    arena_give(memory, r->items, 2 * count * sizeof *r->items);
    arena_give(memory, r->ids.slots, r->ids.slots ? r->ids.slot_count * sizeof *r->ids.slots : 0);
    arena_give(memory, r, sizeof *r);
    return status;
}
