/* SPDX-License-Identifier: MIT */
/* move_order.c - simulates moves one by one in the given order, and finds out whether moves might meet full leaves.
 *
 * Problem: the result of a batch must be that of single moves. Usually moves do not interact, and all leaving and
 * arriving points can be changed at once. Moves interact if an id occurs twice (A to B, then B to C), if a pair
 * (position, id) would occur twice for a moment, or if a leaf is full: whether it refuses a point depends on which
 * points have already left the leaf.
 *
 * Idea: simulate without the tree. A table holds each pair (position, id) that a move leaves or reaches, and the move
 * whose point is currently there. If leaves refuse points (OCTREE_REFUSE), a second table holds the number of points in
 * each indivisible cell that a move leaves or reaches. A point is refused exactly if its indivisible cell is full,
 * because any larger leaf would split. Two leaves outside the tree serve as hash tables: leaf_find() returns the index
 * of a pair or of a cell. Each move is then O(1). At the end the table shows which stored points leave and which points
 * arrive, and restructure.c makes the change.
 *
 * Cost: about 250 bytes a move. To avoid this cost, can_overflow() and can_overflow_when_rebuilt() first rule out full
 * leaves where they can.
 */
#include "batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NO_OWNER UINT32_MAX
#define FIRST_OWNER (UINT32_MAX - 1)

/* A pair (position, id) that is the origin or the destination of a move. */
typedef struct pair {
    uint64_t code;
    /* index of the move whose point is at the pair; FIRST_OWNER: the point that was stored there before the batch;
     * NO_OWNER: no point */
    uint32_t owner;
    uint32_t index; /* the index of the pair in its leaf before the batch; MORTON_NEW: the pair was not stored */
} pair;

typedef struct simulation {
    batch *batch;
    node points; /* a leaf that serves as a hash table of the pairs: the point with index i is pairs[i] */
    pair *pairs;
    /* a leaf that serves as a hash table of indivisible cells: the ids of its points are the cells' addresses, the
     * positions are 0 */
    node cells;
    /* for each cell in `cells`, the current number of points in the cell; null if no leaf refuses points */
    uint32_t *counts;
} simulation;

static uint32_t find_stored_index(const octree *tree, const octree_point *point)
{
    found_point found;
    return find_point(tree, point->position, point->id, &found) ? found.index : MORTON_NEW;
}

/* Returns the index of a point in a leaf that serves as a hash table. A missing point is added at the end. */
static uint32_t find_or_add_point(node *table, const octree_point *point)
{
    const uint32_t index = leaf_find(table, point->position, point->id);
    if (index != LEAF_NONE)
        return index;
    leaf_append_unchecked(table, point);
    return table->count - 1;
}

static pair *find_or_add_pair(simulation *r, const octree_point *point)
{
    const octree *tree = r->batch->tree;
    const uint32_t known = r->points.count, at = find_or_add_point(&r->points, point);
    if (at == known) {
        const uint32_t index = find_stored_index(tree, point);
        r->pairs[at] =
            (pair){morton_code(tree->axes, point->position), index == MORTON_NEW ? NO_OWNER : FIRST_OWNER, index};
    }
    return &r->pairs[at];
}

/* Returns the address of the indivisible cell that contains a code. */
static octree_address find_indivisible_cell(const octree *tree, uint64_t code)
{
    cell c = root_cell();
    while (can_split(tree, c))
        c = cell_child(c, morton_octant(code, c.depth));
    return morton_address(code, c.depth);
}

static uint32_t count_stored_in_cell(const octree *tree, uint64_t code, octree_address cell)
{
    const unsigned shift = 3 * (OCTREE_MAX_DEPTH - octree_address_depth(cell));
    const path p = find_path(tree, code);
    const node *leaf = path_end(&p);
    uint32_t count = 0;
    for (uint32_t i = 0; leaf->octants == 0 && i < leaf->count; i++)
        count += (morton_code(tree->axes, leaf_points(leaf)[i].position) ^ code) >> shift == 0;
    return count;
}

static uint32_t *find_or_add_cell_count(simulation *r, uint64_t code)
{
    const octree_address cell = find_indivisible_cell(r->batch->tree, code);
    const uint32_t known = r->cells.count, at = find_or_add_point(&r->cells, &(octree_point){.id = cell});
    if (at == known)
        r->counts[at] = count_stored_in_cell(r->batch->tree, code, cell);
    return &r->counts[at];
}

/* Move a point from one indivisible cell to another in the counts of points. Returns false if the other cell is full. A
 * full leaf that cannot split holds only points of one indivisible cell, so the leaf would refuse the point. */
static bool move_between_cells(simulation *r, uint64_t from, uint64_t to)
{
    if (!r->counts)
        return true;
    uint32_t *left = find_or_add_cell_count(r, from), *entered = find_or_add_cell_count(r, to);
    if (entered != left && *entered >= r->batch->tree->def.leaf_capacity)
        return false;
    --*left;
    ++*entered;
    return true;
}

static octree_status simulate_move(simulation *r, uint32_t place)
{
    const octree_point *from = &r->batch->points[place];
    const octree_point moved = arriving_point(r->batch, &(morton_item){.place = place});
    pair *left = find_or_add_pair(r, from), *entered = find_or_add_pair(r, &moved);
    if (left->owner == NO_OWNER)
        return OCTREE_NOT_FOUND;
    if (entered != left && entered->owner != NO_OWNER)
        return OCTREE_DUPLICATE;
    if (!move_between_cells(r, left->code, entered->code))
        return OCTREE_FULL;
    left->owner = NO_OWNER;
    entered->owner = place;
    return OCTREE_OK;
}

static int compare_places(const void *a, const void *b)
{
    const uint32_t p = ((const morton_item *)a)->place, q = ((const morton_item *)b)->place;
    return (p > q) - (p < q);
}

/* List the stored points that leave and the moved points that arrive. For each pair of a position and an id, compare
 * the owner before all moves with the owner after them. */
static void list_leaving_and_arriving(const simulation *r)
{
    batch *b = r->batch;
    for (size_t i = 0; i < r->points.count; i++) {
        const pair *p = &r->pairs[i];
        if (p->index != MORTON_NEW && p->owner != FIRST_OWNER)
            b->leaving.items[b->leaving.count++] = (morton_item){p->code, 0, p->index};
        if (p->owner != NO_OWNER && p->owner != FIRST_OWNER)
            b->arriving.items[b->arriving.count++] = (morton_item){p->code, p->owner, MORTON_NEW};
    }
    morton_sort(b->leaving.items, b->spare, b->leaving.count, 0, 0);
    morton_sort(b->arriving.items, b->spare, b->arriving.count, 0, 0);
}

static void simulate_all_moves(simulation *r)
{
    batch *b = r->batch;
    morton_item *items = b->valid.items;
    qsort(items, b->valid.count, sizeof *items, compare_places);
    for (size_t i = 0; i < b->valid.count; i++) {
        const octree_status status = simulate_move(r, items[i].place);
        set_item_status(b, &items[i], status);
        b->done += status == OCTREE_OK;
    }
    list_leaving_and_arriving(r);
}

bool simulate_moves_in_order(batch *b)
{
    store *s = &b->tree->store;
    const size_t count = 2 * b->valid.count + 1;
    const bool refuses = b->tree->def.full_leaf == OCTREE_REFUSE;
    simulation r = {.batch = b, .pairs = arena_allocate(&s->memory, count * sizeof *r.pairs)};
    r.counts = refuses ? arena_allocate(&s->memory, count * sizeof *r.counts) : NULL;
    const bool ok = r.pairs && (r.counts || !refuses) && count <= UINT32_MAX &&
                    leaf_create(s, &r.points, (uint32_t)count) &&
                    (!refuses || leaf_create(s, &r.cells, (uint32_t)count));
    if (ok)
        simulate_all_moves(&r);
    leaf_release(s, &r.points);
    leaf_release(s, &r.cells);
    arena_free(&s->memory, r.pairs, count * sizeof *r.pairs);
    arena_free(&s->memory, r.counts, count * sizeof *r.counts);
    return ok;
}

/* ---- Overflow ----------------------------------------------------------------------------------------------- */

/* Returns whether an indivisible cell of a leaf might get too many points: more than `capacity` points lie in the cell,
 * counting the leaf's points, the origins of moves and the destinations of moves. Also returns true if memory runs
 * out. */
static bool can_overfill_leaf(const batch *b, const node *leaf, cell c, span arriving)
{
    const size_t capacity = b->tree->def.leaf_capacity;
    const uint64_t first = morton_interleave(c.low);
    const uint64_t end = first + (UINT64_C(1) << 3 * (OCTREE_MAX_DEPTH - c.depth));
    const size_t start = find_item_by_first_word(b->valid.items, sizeof *b->valid.items, b->valid.count, first);
    const size_t moved = find_item_by_first_word(b->valid.items, sizeof *b->valid.items, b->valid.count, end) - start;
    const size_t sum = leaf->count + moved + arriving.count, room = 2 * sum * sizeof(morton_item);
    arena *memory = &b->store->memory;
    /* unreachable: the size cannot overflow, because leaves and batches have at most UINT32_MAX points */
    morton_item *all = sum <= SIZE_MAX / 2 / sizeof *all ? arena_allocate(memory, room) : NULL;
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
        crowded = is_inseparable(b->tree, c, all + i, capacity + 1);
    arena_free(memory, all, room);
    return crowded;
}

bool can_overflow(const batch *b, const node *old, cell c, span arriving)
{
    static const node empty = {0};
    if (b->tree->def.full_leaf != OCTREE_REFUSE || arriving.count == 0 || b->settled)
        return false;
    if (!old->octants)
        return !fits_leaf(b->tree, old->count + arriving.count) && can_overfill_leaf(b, old, c, arriving);
    span shares[8];
    divide_items_by_octant(arriving, c.depth, shares);
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *child = child_at(old, octant);
        if (can_overflow(b, child ? child : &empty, cell_child(c, octant), shares[octant]))
            return true;
    }
    return false;
}

/* ---- Overflow of a rebuilt tree ---------------------------------------------------------------------------- */

/* Compute a distance for each axis: two points that are farther apart on some axis never lie in one indivisible cell.
 * An indivisible cell has the greatest depth, or contains no double between its planes. */
static void compute_separating_distance(const octree *tree, double distance[3])
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

/* Returns an upper bound of the number of points in one indivisible cell, among 2 * half points. Point i is paired with
 * point i + half. If the two points of a pair are not close to each other, at most one of them can lie in the cell. */
static size_t max_paired_points_in_one_cell(const octree_point *points, uint32_t half, const double distance[3])
{
    size_t most = half;
    for (uint32_t i = 0; i < half; i++)
        most += are_close(&points[i], &points[i + half], distance);
    return most;
}

/* Returns an upper bound of the number of points in one indivisible cell, among all points of two leaves. */
static size_t max_points_per_sort_cell(const node *old, const node *made, const double distance[3])
{
    const octree_point *before = leaf_points(old), *after = leaf_points(made);
    const uint32_t odd = old->count % 2, made_odd = made->count % 2;
    size_t most = max_paired_points_in_one_cell(before + odd, old->count / 2, distance) +
                  max_paired_points_in_one_cell(after, made->count / 2, distance) + (odd | made_odd);
    if (odd && made_odd)
        most += are_close(&before[0], &after[made->count - 1], distance);
    return most;
}

static bool can_overflow_in_nodes(const octree *tree, const node *old, const node *made, const double distance[3])
{
    if (fits_leaf(tree, (size_t)old->count + made->count))
        return false;
    if (old->octants == 0 && made->octants == 0)
        return !fits_leaf(tree, max_points_per_sort_cell(old, made, distance));
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *before = old->octants ? child_at(old, octant) : old;
        const node *after = made->octants ? child_at(made, octant) : made;
        if (before && after && can_overflow_in_nodes(tree, before, after, distance))
            return true;
    }
    return false;
}

bool can_overflow_when_rebuilt(const octree *tree, const node *made)
{
    double distance[3];
    if (tree->def.full_leaf != OCTREE_REFUSE)
        return false;
    compute_separating_distance(tree, distance);
    return can_overflow_in_nodes(tree, &tree->root, made, distance);
}
