/* SPDX-License-Identifier: MIT */
/* move_order.c - moves one after the other in the order given, without the tree: which pairs are there, and under
 * OCTREE_REFUSE how many points each smallest cell holds, followed in hash tables. For batches in which an id comes
 * twice, a pair would be there twice, or a leaf may be full. */
#include "batch.h"
#include "octree/digest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NOBODY UINT32_MAX
#define FIRST_OWNER (UINT32_MAX - 1)

/* A pair (position, id) that a move leaves or goes to. */
typedef struct pair {
    octree_point point;
    uint64_t code;
    uint32_t owner; /* the move whose point is there: by its place in the batch; NOBODY; or who was first there */
    uint32_t index; /* in its leaf at first, MORTON_NEW where it was not stored */
} pair;

/* A cell that cannot be divided. */
typedef struct crowd {
    octree_address cell; /* 0: unused */
    uint32_t count;
} crowd;

typedef struct resolution {
    batch *batch;
    pair *pairs;
    size_t pair_count;
    uint32_t *slots; /* index + 1 of a pair, or 0; open addressing with linear probing */
    crowd *crowds;   /* likewise; null where no leaf refuses a point */
    size_t slot_count;
} resolution;

static bool same_pair(const octree_point *a, const octree_point *b)
{
    return a->id == b->id && same_position(a->position, b->position);
}

static size_t home_of(const resolution *r, const octree_point *point)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, point->id);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, point->position[i]);
    return (size_t)digest & (r->slot_count - 1);
}

static uint32_t stored_index(const octree *tree, const octree_point *point)
{
    found_point found;
    return find_point(tree, point->position, point->id, &found) ? found.index : MORTON_NEW;
}

static pair *pair_of(resolution *r, const octree_point *point)
{
    const octree *tree = r->batch->tree;
    size_t slot = home_of(r, point);
    while (r->slots[slot] && !same_pair(&r->pairs[r->slots[slot] - 1].point, point))
        slot = (slot + 1) & (r->slot_count - 1);
    if (!r->slots[slot]) {
        const uint32_t index = stored_index(tree, point);
        r->pairs[r->pair_count++] =
            (pair){*point, morton_code(tree->axes, point->position), index == MORTON_NEW ? NOBODY : FIRST_OWNER, index};
        r->slots[slot] = (uint32_t)r->pair_count;
    }
    return &r->pairs[r->slots[slot] - 1];
}

/* The cell that cannot be divided in which a code lies. */
static octree_address smallest_cell(const octree *tree, uint64_t code)
{
    cell c = root_cell();
    while (may_split(tree, c))
        c = cell_child(c, morton_octant(code, c.depth));
    return morton_address(code, c.depth);
}

static uint32_t stored_count(const octree *tree, uint64_t code, octree_address cell)
{
    const unsigned shift = 3 * (OCTREE_MAX_DEPTH - octree_address_depth(cell));
    const path p = path_to(tree, code);
    const node *leaf = path_end(&p);
    uint32_t count = 0;
    for (uint32_t i = 0; leaf->octants == 0 && i < leaf->count; i++)
        count += (morton_code(tree->axes, leaf_points(leaf)[i].position) ^ code) >> shift == 0;
    return count;
}

static crowd *crowd_of(const resolution *r, uint64_t code)
{
    const octree_address cell = smallest_cell(r->batch->tree, code);
    size_t slot = (size_t)octree_digest_word(OCTREE_DIGEST_START, cell) & (r->slot_count - 1);
    while (r->crowds[slot].cell && r->crowds[slot].cell != cell)
        slot = (slot + 1) & (r->slot_count - 1);
    if (!r->crowds[slot].cell)
        r->crowds[slot] = (crowd){cell, stored_count(r->batch->tree, code, cell)};
    return &r->crowds[slot];
}

/* Whether the leaf at the end of a move takes it. A leaf that cannot be divided has the points of just one cell. */
static bool takes(const resolution *r, uint64_t from, uint64_t to)
{
    if (!r->crowds)
        return true;
    crowd *left = crowd_of(r, from), *entered = crowd_of(r, to);
    if (entered != left && entered->count >= r->batch->tree->def.leaf_capacity)
        return false;
    left->count--;
    entered->count++;
    return true;
}

static octree_status move_one(resolution *r, uint32_t place)
{
    const octree_point *from = &r->batch->points[place];
    const octree_point moved = arriving_point(r->batch, &(morton_item){.place = place});
    pair *left = pair_of(r, from), *entered = pair_of(r, &moved);
    if (left->owner == NOBODY)
        return OCTREE_NOT_FOUND;
    if (entered != left && entered->owner != NOBODY)
        return OCTREE_DUPLICATE;
    if (!takes(r, left->code, entered->code))
        return OCTREE_FULL;
    left->owner = NOBODY;
    entered->owner = place;
    return OCTREE_OK;
}

static int compare_places(const void *a, const void *b)
{
    const uint32_t p = ((const morton_item *)a)->place, q = ((const morton_item *)b)->place;
    return (p > q) - (p < q);
}

/* What the pairs have become. */
static void list_changes(const resolution *r)
{
    batch *b = r->batch;
    for (size_t i = 0; i < r->pair_count; i++) {
        const pair *p = &r->pairs[i];
        if (p->index != MORTON_NEW && p->owner != FIRST_OWNER)
            b->leaving.items[b->leaving.count++] = (morton_item){p->code, 0, p->index};
        if (p->owner != NOBODY && p->owner != FIRST_OWNER)
            b->arriving.items[b->arriving.count++] = (morton_item){p->code, p->owner, MORTON_NEW};
    }
    morton_sort(b->leaving.items, b->spare, b->leaving.count, 0, 0);
    morton_sort(b->arriving.items, b->spare, b->arriving.count, 0, 0);
}

static void resolve(resolution *r)
{
    batch *b = r->batch;
    morton_item *items = b->valid.items;
    memset(r->slots, 0, r->slot_count * sizeof *r->slots);
    if (r->crowds)
        memset(r->crowds, 0, r->slot_count * sizeof *r->crowds);
    qsort(items, b->valid.count, sizeof *items, compare_places);
    for (size_t i = 0; i < b->valid.count; i++) {
        const octree_status status = move_one(r, items[i].place);
        set_status(b, &items[i], status);
        b->done += status == OCTREE_OK;
    }
    list_changes(r);
}

bool resolve_moves_in_order(batch *b)
{
    arena *memory = &b->tree->store.memory;
    const bool refuses = b->tree->def.full_leaf == OCTREE_REFUSE;
    resolution r = {.batch = b, .slot_count = 64};
    while (r.slot_count < 4 * b->valid.count)
        r.slot_count *= 2;
    const size_t pairs_size = (2 * b->valid.count + 1) * sizeof(pair);
    r.pairs = arena_take(memory, pairs_size);
    r.slots = arena_take(memory, r.slot_count * sizeof *r.slots);
    r.crowds = refuses ? arena_take(memory, r.slot_count * sizeof *r.crowds) : NULL;
    const bool ok = r.pairs && r.slots && (r.crowds || !refuses);
    if (ok)
        resolve(&r);
    arena_give(memory, r.pairs, pairs_size);
    arena_give(memory, r.slots, r.slot_count * sizeof *r.slots);
    arena_give(memory, r.crowds, r.slot_count * sizeof *r.crowds);
    return ok;
}

/* ---- Overflow ----------------------------------------------------------------------------------------------- */

static size_t lower_bound(span s, uint64_t code)
{
    size_t low = 0, high = s.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (s.items[middle].code < code)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Of a leaf: where its points are, where those that move were and where they arrive, by code. */
static bool crowds(const batch *b, const node *leaf, cell c, span arriving)
{
    const size_t capacity = b->tree->def.leaf_capacity;
    const uint64_t first = morton_interleave(c.low);
    const size_t start = lower_bound(b->valid, first);
    const size_t moved = lower_bound(b->valid, first + (UINT64_C(1) << 3 * (OCTREE_MAX_DEPTH - c.depth))) - start;
    const size_t sum = leaf->count + moved + arriving.count, room = 2 * sum * sizeof(morton_item);
    arena *memory = &b->store->memory;
    /* unreachable: where size_t has 64 bits, for leaves and batches have at most UINT32_MAX points */
    morton_item *all = sum <= SIZE_MAX / 2 / sizeof *all ? arena_take(memory, room) : NULL;
    if (!all)
        return true;
    for (uint32_t i = 0; i < leaf->count; i++)
        all[i] = (morton_item){morton_code(b->tree->axes, leaf_points(leaf)[i].position), 0, i};
    if (moved)
        memcpy(all + leaf->count, b->valid.items + start, moved * sizeof *all);
    memcpy(all + leaf->count + moved, arriving.items, arriving.count * sizeof *all);
    morton_sort(all, all + sum, sum, c.depth, 0);
    bool crowded = false;
    for (size_t i = 0; !crowded && i + capacity < sum; i++)
        crowded = inseparable(b->tree, c, all + i, capacity + 1);
    arena_give(memory, all, room);
    return crowded;
}

bool may_overflow(const batch *b, const node *old, cell c, span arriving)
{
    static const node empty = {0};
    if (b->tree->def.full_leaf != OCTREE_REFUSE || arriving.count == 0 || b->settled)
        return false;
    if (!old->octants)
        return !fits_leaf(b->tree, old->count + arriving.count) && crowds(b, old, c, arriving);
    span shares[8];
    share_out(arriving, c.depth, shares);
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *child = child_at(old, octant);
        if (may_overflow(b, child ? child : &empty, cell_child(c, octant), shares[octant]))
            return true;
    }
    return false;
}

/* ---- Overflow of a tree built anew ---------------------------------------------------------------------------- */

/* Two points that lie farther apart than this on some axis are not in one cell that cannot be divided: such a cell is
 * of the greatest depth, or no double lies inside it. */
static void least_distance(const octree *tree, double distance[3])
{
    const octree_box *world = &tree->def.world;
    for (int i = 0; i < 3; i++) {
        const double highest = fmax(fabs(world->min[i]), fabs(world->max[i]));
        distance[i] =
            ldexp(world->max[i] - world->min[i], 1 - (int)tree->def.max_depth) + ldexp(highest, -48) + 0x1p-1070;
    }
}

static bool are_close(const octree_point *a, const octree_point *b, const double distance[3])
{
    return fabs(a->position[0] - b->position[0]) <= distance[0] &&
           fabs(a->position[1] - b->position[1]) <= distance[1] && fabs(a->position[2] - b->position[2]) <= distance[2];
}

/* At most how many of twice `half` points lie in one cell that cannot be divided: one of each two that are not close.
 */
static size_t most_of_pairs(const octree_point *points, uint32_t half, const double distance[3])
{
    size_t most = half;
    for (uint32_t i = 0; i < half; i++)
        most += are_close(&points[i], &points[i + half], distance);
    return most;
}

/* The same of the points of two leaves. */
static size_t most_in_a_cell(const node *old, const node *made, const double distance[3])
{
    const octree_point *before = leaf_points(old), *after = leaf_points(made);
    const uint32_t odd = old->count % 2, also_odd = made->count % 2;
    size_t most = most_of_pairs(before + odd, old->count / 2, distance) +
                  most_of_pairs(after, made->count / 2, distance) + (odd | also_odd);
    if (odd && also_odd)
        most += are_close(&before[0], &after[made->count - 1], distance);
    return most;
}

static bool may_crowd(const octree *tree, const node *old, const node *made, const double distance[3])
{
    if (fits_leaf(tree, (size_t)old->count + made->count))
        return false;
    if (old->octants == 0 && made->octants == 0)
        return !fits_leaf(tree, most_in_a_cell(old, made, distance));
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *before = old->octants ? child_at(old, octant) : old;
        const node *after = made->octants ? child_at(made, octant) : made;
        if (before && after && may_crowd(tree, before, after, distance))
            return true;
    }
    return false;
}

bool may_overflow_anew(const octree *tree, const node *made)
{
    double distance[3];
    if (tree->def.full_leaf != OCTREE_REFUSE)
        return false;
    least_distance(tree, distance);
    return may_crowd(tree, &tree->root, made, distance);
}
