/* SPDX-License-Identifier: MIT */
/* bulk.c - many points inserted or removed at once. They are sorted by Morton code, and each node that changes is made
 * anew from its old self and its share of them; nodes that do not change are shared with the old tree. The new root
 * takes the place of the old one at the end, so that the change either happens or does not.
 */
#include "float_rules.h"
#include "morton_sort.h"
#include "tree.h"

#include <stdlib.h>
#include <string.h>

/* A point that repeats an earlier one of the batch: both by their index. */
typedef struct repetition {
    uint32_t place, first;
} repetition;

typedef struct bulk {
    octree *tree;
    const octree_point *points; /* the caller's */
    size_t point_count;
    octree_status *statuses;    /* the caller's, one for each point; may be null */
    const octree_point *stored; /* of the leaf whose points are among the items, if there is one */
    morton_item *items;         /* the points inside the world, by code; in cells that become leaves in any order */
    size_t count;
    bool repeated; /* some items may have the same code */
    list repetitions;
} bulk;

static const octree_point *point_of(const bulk *b, const morton_item *item)
{
    return (item->stored ? b->stored : b->points) + item->place;
}

static void set_status(const bulk *b, const morton_item *item, octree_status status)
{
    if (!item->stored && b->statuses)
        b->statuses[item->place] = status;
}

/* ---- Loading the points ------------------------------------------------------------------------------------- */

static void *take_items(const bulk *b)
{
    const size_t size = sizeof(morton_item);
    return b->point_count < SIZE_MAX / size ? arena_take(&b->tree->store.memory, (b->point_count + 1) * size) : NULL;
}

static void give_items(const bulk *b, morton_item *items)
{
    arena_give(&b->tree->store.memory, items, (b->point_count + 1) * sizeof *items);
}

/* How many items of a cell need not be sorted where nothing is stored yet: they become a leaf. */
static size_t unsorted_count(const octree *tree)
{
    return tree->def.leaf_capacity < MORTON_UNSORTED ? tree->def.leaf_capacity : MORTON_UNSORTED;
}

static bool sort_items(bulk *b)
{
    morton_item *spare = take_items(b);
    if (!spare)
        return false;
    const size_t unsorted = b->tree->root.count > 0 ? 0 : unsorted_count(b->tree);
    b->repeated = morton_sort(b->items, spare, b->count, 0, unsorted);
    give_items(b, spare);
    return true;
}

static void collect_items(bulk *b)
{
    const octree_box world = b->tree->def.world;
    for (size_t i = 0; i < b->point_count; i++) {
        const double *position = b->points[i].position;
        const octree_status status = box_contains(&world, position) ? OCTREE_OK : check_position(b->tree, position);
        if (status == OCTREE_OK)
            b->items[b->count++] = (morton_item){morton_code(b->tree->axes, position), (uint32_t)i, false};
        if (b->statuses)
            b->statuses[i] = status;
    }
}

/* Collect and sort the items. Sets each point's status: OK, or why it is not among the items. */
static octree_status load(bulk *b)
{
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (b->point_count >= UINT32_MAX)
        return OCTREE_TOO_MANY;
    b->items = take_items(b);
    if (!b->items)
        return OCTREE_NO_MEMORY;
    collect_items(b);
    return sort_items(b) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

/* How many of the sorted items lie in the same octant of a cell of this depth as the first of them. */
static size_t octant_share(const morton_item *items, size_t count, unsigned depth)
{
    const unsigned octant = morton_octant(items[0].code, depth);
    size_t low = 1, high = count; /* the first that lies elsewhere is in [low, high] */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (morton_octant(items[middle].code, depth) == octant)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* How many items each octant of a cell receives. Returns the octants that receive any. */
static unsigned share_out(const morton_item *items, size_t count, unsigned depth, size_t shares[8])
{
    unsigned octants = 0;
    memset(shares, 0, 8 * sizeof *shares);
    for (size_t at = 0; at < count;) {
        const unsigned octant = morton_octant(items[at].code, depth);
        shares[octant] = octant_share(items + at, count - at, depth);
        octants |= 1u << octant;
        at += shares[octant];
    }
    return octants;
}

/* Load the points, make the new root from them, and put it in the place of the old one if it differs. *changed (may be
 * null) receives the difference in the number of points. */
static octree_status change_many(bulk b, octree_status (*change)(bulk *b, node *root), size_t *changed)
{
    octree *tree = b.tree;
    if (!tree || (!b.points && b.point_count))
        return OCTREE_NULL_ARGUMENT;
    const node old = tree->root;
    node root = old;
    octree_status status = load(&b);
    if (status == OCTREE_OK)
        status = change(&b, &root);
    if (status == OCTREE_OK && changed)
        *changed = root.count > old.count ? root.count - old.count : old.count - root.count;
    if (status == OCTREE_OK && root.count != old.count) {
        tree->root = root;
        tree->version++;
        node_release_unshared(&tree->store, &old, &root);
    } else {
        node_release_unshared(&tree->store, &root, &old);
    }
    list_release(&tree->store.memory, &b.repetitions, sizeof(repetition));
    give_items(&b, b.items);
    return status;
}

/* ---- Inserting ---------------------------------------------------------------------------------------------- */

/* Stored points first, then the caller's in their order: so a leaf refuses the same points as one by one. */
static int compare_places(const void *a, const void *b)
{
    const morton_item *p = a, *q = b;
    return p->stored != q->stored ? q->stored - p->stored : (p->place > q->place) - (p->place < q->place);
}

/* A leaf of the items, or of as many as it takes; the others are refused. */
static bool make_leaf(bulk *b, morton_item *items, size_t count, node *made)
{
    const size_t capacity = b->tree->def.leaf_capacity;
    size_t taken = count;
    if (count > capacity && b->tree->def.full_leaf == OCTREE_REFUSE) {
        qsort(items, count, sizeof *items, compare_places);
        taken = capacity;
    }
    if (!leaf_create(&b->tree->store, made, (uint32_t)taken))
        return false;
    for (size_t i = 0; i < taken; i++)
        prefetch(point_of(b, &items[i])); /* scattered, in the caller's order */
    for (size_t i = 0; i < taken; i++)
        leaf_put(made, point_of(b, &items[i]));
    for (size_t i = taken; i < count; i++)
        set_status(b, &items[i], OCTREE_FULL);
    return true;
}

/* An inner node of the old one's children (it may be null) and those that the items need. */
static bool build_children(bulk *b, const node *old, cell c, morton_item *items, size_t count, node *made);

/* Whether all sorted items lie in one cell of the greatest depth, so that splitting this one would not separate them.
 * Asked under OCTREE_REFUSE, where most of them are then refused: nothing is split for refused points. Where items are
 * separated, more of them are stored than one leaf holds, so that the split is needed. */
static bool inseparable(const octree *tree, cell c, const morton_item *items, size_t count)
{
    const uint64_t unlike = items[0].code ^ items[count - 1].code;
    for (; may_split(tree, c); c = cell_child(c, morton_octant(items[0].code, c.depth)))
        if (morton_octant(unlike, c.depth) != 0)
            return false;
    return true;
}

/* Make the node of a cell that holds only the items. */
static bool build(bulk *b, cell c, morton_item *items, size_t count, node *made)
{
    const octree_def *def = &b->tree->def;
    if (count <= def->leaf_capacity || !may_split(b->tree, c) ||
        (def->full_leaf == OCTREE_REFUSE && inseparable(b->tree, c, items, count)))
        return make_leaf(b, items, count, made);
    return build_children(b, NULL, c, items, count, made);
}

/* A leaf's points and its items together, sorted if the cell can be divided; the order does not matter where it cannot,
 * as for a hashed leaf. `all` has room for twice as many. */
static void merge_items(const octree *tree, const node *leaf, cell c, const morton_item *items, size_t count,
                        morton_item *all)
{
    const size_t sum = leaf->count + count;
    for (uint32_t i = 0; i < leaf->count; i++)
        all[i] = (morton_item){morton_code(tree->axes, leaf_points(leaf)[i].position), i, true};
    memcpy(all + leaf->count, items, count * sizeof *items);
    if (may_split(tree, c))
        morton_sort(all, all + sum, sum, c.depth, unsorted_count(tree));
}

/* Drop the items that the leaf stores already. Returns how many are left. */
static size_t drop_stored(const bulk *b, const node *leaf, morton_item *items, size_t count)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        const octree_point *point = point_of(b, &items[i]);
        if (leaf_find(leaf, point->position, point->id) == LEAF_NONE)
            items[left++] = items[i];
        else
            set_status(b, &items[i], OCTREE_DUPLICATE);
    }
    return left;
}

static bool add_to_leaf(bulk *b, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    if (old->count == 0)
        return build(b, c, items, count, made);
    count = drop_stored(b, old, items, count);
    if (count == 0)
        return true;
    const size_t room = 2 * (old->count + count) * sizeof(morton_item);
    morton_item *all = arena_take(&b->tree->store.memory, room);
    if (!all)
        return false;
    merge_items(b->tree, old, c, items, count, all);
    b->stored = leaf_points(old);
    const bool ok = build(b, c, all, old->count + count, made);
    arena_give(&b->tree->store.memory, all, room);
    return ok;
}

/* Make a node's successor with the items added. False when there is no memory; *made then holds what was made. */
static bool insert_below(bulk *b, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    *made = *old;
    if (count == 0)
        return true;
    return old->octants ? build_children(b, old, c, items, count, made) : add_to_leaf(b, old, c, items, count, made);
}

static bool build_children(bulk *b, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    static const node empty = {0};
    size_t shares[8];
    const unsigned octants = share_out(items, count, c.depth, shares) | (old ? old->octants : 0u);
    const size_t children = bits_count8(octants);
    node *group = pool_take(&b->tree->store.nodes, (unsigned)children);
    *made = (node){.below = group, .octants = (uint8_t)octants};
    if (!group)
        return false;
    memset(group, 0, children * sizeof *group);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (!(octants >> octant & 1))
            continue;
        const node *before = old ? child_at(old, octant) : NULL;
        if (!insert_below(b, before ? before : &empty, cell_child(c, octant), items, shares[octant], group))
            return false;
        made->count += group->count;
        items += shares[octant];
        group++;
    }
    return true;
}

/* Whether no two items can be the same point, as where ids are counted: then they need not be looked up. */
static bool ids_ascend(const bulk *b, const morton_item *items, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (point_of(b, &items[i])->id <= point_of(b, &items[i - 1])->id)
            return false;
    return true;
}

/* Keep the first of each pair among items of one code, which are in the caller's order. *kept receives how many are
 * left. False when there is no memory. */
static bool drop_repeated(bulk *b, morton_item *items, size_t count, size_t *kept)
{
    store *st = &b->tree->store;
    node seen;
    *kept = count;
    if (ids_ascend(b, items, count))
        return true;
    bool ok = leaf_create(st, &seen, (uint32_t)count);
    for (size_t i = 0; ok && i < count; i++) {
        const octree_point *point = point_of(b, &items[i]);
        const uint32_t first = leaf_find(&seen, point->position, point->id);
        if (first == LEAF_NONE) {
            items[seen.count] = items[i];
            leaf_put(&seen, point);
            continue;
        }
        repetition *r = list_append(&st->memory, &b->repetitions, sizeof *r);
        ok = r != NULL;
        if (ok)
            *r = (repetition){items[i].place, items[first].place};
    }
    *kept = seen.count;
    leaf_release(st, &seen);
    return ok;
}

/* Drop the items that repeat an earlier one of the batch: they must not make leaves split. */
static bool drop_repetitions(bulk *b)
{
    size_t left = 0;
    for (size_t start = 0, end, kept; start < b->count; start = end, left += kept) {
        for (end = start + 1; end < b->count && b->items[end].code == b->items[start].code; end++)
            ;
        kept = 1;
        if (end - start > 1 && !drop_repeated(b, b->items + start, end - start, &kept))
            return false;
        memmove(b->items + left, b->items + start, kept * sizeof *b->items);
    }
    b->count = left;
    return true;
}

/* A repeated point is a duplicate, unless the first one was refused, as it would then be too. */
static void set_repeated_statuses(const bulk *b)
{
    const repetition *all = b->repetitions.items;
    for (size_t i = 0; b->statuses && i < b->repetitions.count; i++)
        b->statuses[all[i].place] = b->statuses[all[i].first] == OCTREE_FULL ? OCTREE_FULL : OCTREE_DUPLICATE;
}

static octree_status insert_items(bulk *b, node *root)
{
    if (b->repeated && !drop_repetitions(b))
        return OCTREE_NO_MEMORY;
    if (b->count > UINT32_MAX - b->tree->root.count)
        return OCTREE_TOO_MANY;
    if (!insert_below(b, &b->tree->root, root_cell(), b->items, b->count, root))
        return OCTREE_NO_MEMORY;
    set_repeated_statuses(b);
    return OCTREE_OK;
}

octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted)
{
    const bulk b = {.tree = tree, .points = points, .point_count = count, .statuses = statuses};
    const octree_status status = change_many(b, insert_items, inserted);
    if (status == OCTREE_OK)
        tune_if_due(tree);
    return status;
}

/* ---- Removing ----------------------------------------------------------------------------------------------- */

/* A leaf of the points that are not marked as gone. */
static bool make_remaining(bulk *b, const node *old, const bool *gone, uint32_t left, node *made)
{
    if (!leaf_create(&b->tree->store, made, left))
        return false;
    for (uint32_t i = 0; i < old->count; i++)
        if (!gone[i])
            leaf_put(made, &leaf_points(old)[i]);
    return true;
}

static bool take_from_leaf(bulk *b, const node *old, const morton_item *items, size_t count, node *made)
{
    arena *memory = &b->tree->store.memory;
    bool *gone = arena_take(memory, old->count + 1);
    if (!gone)
        return false;
    memset(gone, 0, old->count + 1);
    uint32_t left = old->count;
    for (size_t i = 0; i < count; i++) {
        const octree_point *point = point_of(b, &items[i]);
        const uint32_t index = leaf_find(old, point->position, point->id);
        if (index == LEAF_NONE || gone[index]) {
            set_status(b, &items[i], OCTREE_NOT_FOUND);
        } else {
            gone[index] = true;
            left--;
        }
    }
    const bool ok = left == old->count || make_remaining(b, old, gone, left, made);
    arena_give(memory, gone, old->count + 1);
    return ok;
}

/* One leaf of the points of a node's children. */
static bool merge_children(bulk *b, const node *old, const node children[8], uint32_t count, node *made)
{
    if (!leaf_create(&b->tree->store, made, count))
        return false;
    for (unsigned octant = 8; octant-- > 0;)
        if (old->octants >> octant & 1)
            node_gather(made, &children[octant], NULL);
    return true;
}

/* An inner node of the children that are not empty. */
static bool keep_children(bulk *b, const node *old, const node children[8], uint32_t count, node *made)
{
    unsigned octants = 0;
    for (unsigned octant = 0; octant < 8; octant++)
        if ((old->octants >> octant & 1) && children[octant].count > 0)
            octants |= 1u << octant;
    node *group = pool_take(&b->tree->store.nodes, bits_count8(octants));
    *made = (node){.below = group, .count = count, .octants = (uint8_t)octants};
    for (unsigned octant = 0; group && octant < 8; octant++)
        if (octants >> octant & 1)
            *group++ = children[octant];
    return group != NULL;
}

/* Make the successor of a node of this depth without the items. Without memory false, and nothing is allocated. */
static bool remove_below(bulk *b, const node *old, unsigned depth, const morton_item *items, size_t count, node *made)
{
    *made = *old;
    if (!old->octants)
        return take_from_leaf(b, old, items, count, made);
    node children[8];
    size_t shares[8];
    uint32_t left = old->count;
    bool ok = true;
    share_out(items, count, depth, shares);
    for (unsigned octant = 0; octant < 8; items += shares[octant++]) {
        const node *child = child_at(old, octant);
        for (size_t i = 0; !child && i < shares[octant]; i++)
            set_status(b, &items[i], OCTREE_NOT_FOUND);
        if (!child)
            continue;
        children[octant] = *child;
        if (ok && shares[octant] > 0)
            ok = remove_below(b, child, depth + 1, items, shares[octant], &children[octant]);
        left -= child->count - children[octant].count;
    }
    if (ok && left == old->count)
        return true;
    const bool merges = fits_leaf(b->tree, left);
    ok = ok && (merges ? merge_children : keep_children)(b, old, children, left, made);
    for (unsigned octant = 0; (merges || !ok) && octant < 8; octant++)
        if (old->octants >> octant & 1)
            node_release_unshared(&b->tree->store, &children[octant], child_at(old, octant));
    return ok;
}

static octree_status remove_items(bulk *b, node *root)
{
    return remove_below(b, &b->tree->root, 0, b->items, b->count, root) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed)
{
    return change_many((bulk){.tree = tree, .points = points, .point_count = count, .statuses = statuses}, remove_items,
                       removed);
}
