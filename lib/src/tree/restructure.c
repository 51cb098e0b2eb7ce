/* SPDX-License-Identifier: MIT */
/* restructure.c - plans the successors of all nodes that a batch changes.
 *
 * Problem: after a batch the nodes must be those that single changes would have produced (the canonical form, tree.h),
 * and a failure halfway must leave the tree as it was.
 *
 * Idea: one recursion from the root, with the leaving and arriving points as items sorted by Morton code. At each node
 * the items are divided among the octants by binary search, so unchanged subtrees cost nothing. The node's new number
 * of points decides at once what happens to it: it stays, is edited in place, becomes a leaf, is divided, or is built
 * anew. So no node is split and then merged again within one batch. Nothing is changed yet. Successors are allocated
 * beside the old nodes, and entered in a plan of patches and edits. plan.c carries out the plan, which cannot fail.
 *
 * Under OCTREE_REFUSE a leaf takes the first points in the caller's order, as single insertions would.
 * Cost: O(items * D + points of the changed leaves).
 */
#include "division.h"

#include <stdlib.h>
#include <string.h>

/* ---- Dividing items -------------------------------------------------------------------------------------------- */

unsigned divide_items_by_octant(span all, unsigned depth, span shares[8])
{
    unsigned octants = 0;
    for (unsigned octant = 0; octant < 8; octant++)
        shares[octant] = (span){all.items, 0};
    while (all.count > 0) {
        const unsigned octant = morton_octant(all.items[0].code, depth);
        const size_t count = count_in_first_octant(all.items, all.count, depth);
        shares[octant] = (span){all.items, count};
        octants |= 1u << octant;
        all.items += count;
        all.count -= count;
    }
    return octants;
}

static int compare_indices(const void *a, const void *b)
{
    const morton_item *p = a, *q = b;
    return (p->index > q->index) - (p->index < q->index);
}

/* Sort the items of leaving points by the points' indices in the leaf. */
static void sort_by_index(span s)
{
    if (s.count > POOL_MAX_UNITS) {
        qsort(s.items, s.count, sizeof *s.items, compare_indices);
        return;
    }
    for (size_t i = 1; i < s.count; i++) {
        const morton_item item = s.items[i];
        size_t at = i;
        for (; at > 0 && s.items[at - 1].index > item.index; at--)
            s.items[at] = s.items[at - 1];
        s.items[at] = item;
    }
}

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

/* A comparison function that sorts items in the order of insertion: stored points come first, then the caller's points
 * in their given order. In this order a full leaf refuses the same points as with single insertions. */
static int compare_insertion_order(const void *a, const void *b)
{
    const morton_item *p = a, *q = b;
    const int p_new = p->index == MORTON_NEW, q_new = q->index == MORTON_NEW;
    return p_new != q_new ? p_new - q_new : (p->place > q->place) - (p->place < q->place);
}

/* Make a leaf of the items. Under OCTREE_REFUSE, the leaf takes items up to its capacity and refuses the other items.
 * Returns false if memory runs out. */
static bool make_leaf_of_items(batch *b, span items, node *made)
{
    const size_t capacity = b->tree->def.leaf_capacity;
    size_t taken = items.count;
    if (items.count > capacity && b->tree->def.full_leaf == OCTREE_REFUSE) {
        qsort(items.items, items.count, sizeof *items.items, compare_insertion_order);
        taken = capacity;
        b->overflow = b->to != NULL;
    }
    if (!leaf_create(b->store, made, (uint32_t)taken))
        return false;
    for (size_t i = 0; i < taken; i++) {
        const morton_item *item = &items.items[i];
        if (item->index == MORTON_NEW)
            prefetch_item(b, item);
        else
            prefetch_memory(&b->stored[item->index]);
    }
    for (size_t i = 0; i < taken; i++) {
        const octree_point point = point_of_item(b, &items.items[i]);
        leaf_append_unchecked(made, &point);
    }
    for (size_t i = taken; i < items.count; i++)
        set_item_status(b, &items.items[i], OCTREE_FULL);
    return true;
}

/* Append the points of one leaf to another leaf, except the leaving points. The list `leaving` is sorted by the points'
 * index in the leaf. */
static void append_staying_points(node *made, const node *leaf, span leaving)
{
    for (uint32_t i = 0; i < leaf->count; i++) {
        if (leaving.count > 0 && leaving.items->index == i) {
            leaving.items++;
            leaving.count--;
        } else {
            leaf_append_unchecked(made, &leaf_points(leaf)[i]);
        }
    }
}

static void append_arriving_points(batch *b, node *made, span arriving)
{
    for (size_t i = 0; i < arriving.count; i++) {
        const octree_point point = arriving_point(b, &arriving.items[i]);
        leaf_append_unchecked(made, &point);
    }
}

static bool make_changed_leaf(batch *b, const node *old, span leaving, span arriving, node *made)
{
    if (!leaf_create(b->store, made, (uint32_t)(old->count - leaving.count + arriving.count)))
        return false;
    append_staying_points(made, old, leaving);
    append_arriving_points(b, made, arriving);
    return true;
}

/* Plan to edit a leaf in place. The leaf's block must have room for the resulting points. Returns false if memory runs
 * out. */
static bool plan_leaf_edit(batch *b, const node *old, span leaving, span arriving, node *made)
{
    edit *e = list_append(&b->store->memory, &b->edits, sizeof *e);
    if (!e)
        return false;
    const uint32_t count = (uint32_t)(old->count - leaving.count + arriving.count);
    const unsigned needed = leaf_block_room(count);
    made->count = count;
    made->room = needed < old->room ? (uint8_t)needed : old->room;
    *e = (edit){leaf_points(old), old->count, old->room, made->room, leaving, arriving};
    return true;
}

/* ---- Making nodes ------------------------------------------------------------------------------------------- */

bool is_inseparable(const octree *tree, cell c, const morton_item *items, size_t count)
{
    const uint64_t unlike = items[0].code ^ items[count - 1].code;
    for (; can_split(tree, c); c = cell_child(c, morton_octant(items[0].code, c.depth)))
        if (morton_octant(unlike, c.depth) != 0)
            return false;
    return true;
}

/* Build the inner node of a cell that holds only these items. */
static bool build_children(batch *b, cell c, span items, node *made);

/* Returns whether the items of a cell become a leaf. Under OCTREE_REFUSE, inseparable items stay in one leaf, which
 * refuses the items beyond its capacity: a node never splits only because of refused points. Separable items fill more
 * than one leaf, so the node must split. */
bool must_be_leaf(const batch *b, cell c, span items)
{
    const octree_def *def = &b->tree->def;
    return items.count <= def->leaf_capacity || !can_split(b->tree, c) ||
           (def->full_leaf == OCTREE_REFUSE && is_inseparable(b->tree, c, items.items, items.count));
}

bool build_node(batch *b, cell c, span items, node *made)
{
    if (is_planned_by_job(b, items.count))
        return get_next_job_result(b, made);
    return must_be_leaf(b, c, items) ? make_leaf_of_items(b, items, made) : build_children(b, c, items, made);
}

static bool build_children(batch *b, cell c, span items, node *made)
{
    span shares[8];
    const unsigned octants = divide_items_by_octant(items, c.depth, shares), children = bits_count8(octants);
    node *group = group_allocate(b->store, children);
    *made = (node){.below = group, .octants = (uint8_t)octants};
    if (!group)
        return false;
    memset(group, 0, children * sizeof *group);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (shares[octant].count == 0)
            continue;
        if (!build_node(b, cell_child(c, octant), shares[octant], group))
            return false;
        made->count += group++->count;
    }
    return true;
}

/* Divide a leaf: build a node from the leaf's staying points and the arriving items. If the cell cannot split, the new
 * node is a single leaf, whose items need no order. */
static bool divide_leaf(batch *b, const node *old, cell c, span leaving, span arriving, node *made)
{
    const size_t sum = old->count - leaving.count + arriving.count, room = 2 * sum * sizeof(morton_item);
    /* unreachable: the size cannot overflow, because leaves and batches have at most UINT32_MAX points */
    morton_item *all = sum <= SIZE_MAX / 2 / sizeof *all ? arena_allocate(&b->store->memory, room) : NULL;
    if (!all)
        return false;
    size_t count = 0;
    for (uint32_t i = 0; i < old->count; i++) {
        if (leaving.count > 0 && leaving.items->index == i) {
            leaving.items++;
            leaving.count--;
        } else {
            all[count++] = (morton_item){morton_code(b->tree->axes, leaf_points(old)[i].position), 0, i};
        }
    }
    if (arriving.count > 0)
        memcpy(all + count, arriving.items, arriving.count * sizeof *all);
    if (can_split(b->tree, c))
        morton_sort(all, all + sum, sum, c.depth, unsorted_limit(b->tree));
    b->stored = leaf_points(old);
    const bool ok = build_node_by_tasks(b, c, (span){all, sum}, made);
    arena_free(&b->store->memory, all, room);
    return ok;
}

/* ---- Changing nodes ----------------------------------------------------------------------------------------- */

static bool is_leaving(span leaving, uint32_t index)
{
    /* invariant: the position in the list of the first item with at least this index is in [low, high] */
    size_t low = 0, high = leaving.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (leaving.items[middle].index < index)
            low = middle + 1;
        else
            high = middle;
    }
    return low < leaving.count && leaving.items[low].index == index;
}

/* Remove from `arriving` the items of points that the leaf already holds, unless these points leave the leaf. */
static void drop_stored_arrivals(batch *b, const node *leaf, span leaving, span *arriving)
{
    size_t left = 0;
    for (size_t i = 0; i < arriving->count; i++) {
        const octree_point point = arriving_point(b, &arriving->items[i]);
        const uint32_t index = leaf_find(leaf, point.position, point.id);
        if (index == LEAF_NONE || is_leaving(leaving, index)) {
            arriving->items[left++] = arriving->items[i];
        } else {
            set_item_status(b, &arriving->items[i], OCTREE_DUPLICATE);
            b->duplicate = true;
        }
    }
    arriving->count = left;
}

/* Set `overflow` if arriving points might meet a full leaf when they are moved one by one in some order. */
static void record_possible_overflow(batch *b, const node *old, cell c, span arriving)
{
    b->overflow = b->overflow || (b->to && can_overflow(b, old, c, arriving));
}

static bool change_leaf(batch *b, const node *old, cell c, span leaving, span arriving, node *made)
{
    sort_by_index(leaving);
    if (b->may_be_stored && arriving.count > 0)
        drop_stored_arrivals(b, old, leaving, &arriving);
    if (leaving.count + arriving.count == 0)
        return true;
    record_possible_overflow(b, old, c, arriving);
    const size_t count = old->count - leaving.count + arriving.count;
    if (!fits_leaf(b->tree, count))
        return divide_leaf(b, old, c, leaving, arriving, made);
    if (old->room != LEAF_HASHED && count <= old->room)
        return plan_leaf_edit(b, old, leaving, arriving, made);
    return make_changed_leaf(b, old, leaving, arriving, made);
}

/* Append the points of a subtree to the leaf `made`, except the points that leave the tree. `old` is the root of the
 * subtree. */
static void append_staying_points_below(const node *old, unsigned depth, span leaving, node *made)
{
    if (!old->octants) {
        sort_by_index(leaving);
        append_staying_points(made, old, leaving);
        return;
    }
    span shares[8];
    divide_items_by_octant(leaving, depth, shares);
    for (unsigned octant = 0; octant < 8; octant++)
        if (old->octants >> octant & 1)
            append_staying_points_below(child_at(old, octant), depth + 1, shares[octant], made);
}

/* Merge a node whose remaining points fit into one leaf. The new leaf is *made. Returns false if memory runs out. */
static bool merge_into_leaf(batch *b, const node *old, cell c, span leaving, span arriving, node *made)
{
    record_possible_overflow(b, old, c, arriving);
    if (!leaf_create(b->store, made, (uint32_t)(old->count - leaving.count + arriving.count)))
        return false;
    append_staying_points_below(old, c.depth, leaving, made);
    if (b->may_be_stored)
        drop_stored_arrivals(b, made, (span){NULL, 0}, &arriving);
    append_arriving_points(b, made, arriving);
    return true;
}

bool plan_replacement(batch *b, node *at, const node *made)
{
    /* If the block and the count are the same, the node is unchanged: its octants and its room are then also the
     * same. */
    if (at->below == made->below && at->count == made->count)
        return true;
    const patch p = {at, *made};
    if (list_push(&b->store->memory, &b->patches, &p, sizeof p))
        return true;
    node_release_unshared(b->store, made, at);
    return false;
}

/* Make the successor of one child of a node in *made. If `made` is null, add the successor to the plan instead. Returns
 * false if memory runs out. */
static bool change_child(batch *b, const node *old, cell c, unsigned octant, const span leaving[8],
                         const span arriving[8], node *made, uint32_t *count)
{
    static const node empty = {0};
    node *child = child_at(old, octant), successor = {0};
    const bool ok = change_node(b, child ? child : &empty, cell_child(c, octant), leaving[octant], arriving[octant],
                                made ? made : &successor);
    *count += made ? made->count : successor.count;
    if (made)
        return ok;
    if (!ok)
        node_release_unshared(b->store, &successor, child);
    return ok && plan_replacement(b, child, &successor);
}

/* Change some children of a node whose set of octants stays the same. Returns false if memory runs out. */
static bool change_same_children(batch *b, const node *old, cell c, const span leaving[8], const span arriving[8],
                                 node *made)
{
    for (unsigned octant = 0; octant < 8; octant++) {
        if (leaving[octant].count + arriving[octant].count == 0)
            continue;
        const uint32_t before = child_at(old, octant)->count;
        uint32_t after = 0;
        if (!change_child(b, old, c, octant, leaving, arriving, NULL, &after))
            return false;
        made->count += after - before;
    }
    return true;
}

/* Prefetch the leaves in which items arrive, and the first items that arrive in each of these leaves. */
static void prefetch_arrival_leaves(const batch *b, const node *parent, const span arriving[8])
{
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *child = arriving[octant].count > 0 ? child_at(parent, octant) : NULL;
        if (!child || child->octants)
            continue;
        leaf_prefetch(child);
        for (size_t i = 0; i < arriving[octant].count && i < POOL_MAX_UNITS; i++)
            prefetch_item(b, &arriving[octant].items[i]);
    }
}

static bool change_children(batch *b, const node *old, cell c, span leaving, span arriving, node *made)
{
    span out[8], in[8];
    divide_items_by_octant(leaving, c.depth, out);
    unsigned octants = divide_items_by_octant(arriving, c.depth, in);
    for (unsigned octant = 0; octant < 8; octant++)
        if ((old->octants >> octant & 1) && child_at(old, octant)->count > out[octant].count)
            octants |= 1u << octant;
    prefetch_arrival_leaves(b, old, in);
    if (octants == old->octants)
        return change_same_children(b, old, c, out, in, made);
    const unsigned children = bits_count8(octants);
    node *group = group_allocate(b->store, children);
    *made = (node){.below = group, .octants = (uint8_t)octants};
    if (!group)
        return false;
    memset(group, 0, children * sizeof *group);
    for (unsigned octant = 0; octant < 8; octant++)
        if ((octants >> octant & 1) && !change_child(b, old, c, octant, out, in, group++, &made->count))
            return false;
    return true;
}

/* If all points of a node leave, the successor is built from the arriving items only. */
bool change_node(batch *b, const node *old, cell c, span leaving, span arriving, node *made)
{
    const bool is_emptied = leaving.count == old->count;
    *made = is_emptied ? (node){0} : *old;
    if (arriving.count == 0 && (is_emptied || leaving.count == 0))
        return true;
    if (is_planned_by_job(b, leaving.count + arriving.count))
        return get_next_job_result(b, made);
    if (is_emptied) {
        record_possible_overflow(b, old, c, arriving);
        return build_node(b, c, arriving, made);
    }
    if (!old->octants)
        return change_leaf(b, old, c, leaving, arriving, made);
    if (fits_leaf(b->tree, old->count - leaving.count + arriving.count))
        return merge_into_leaf(b, old, c, leaving, arriving, made);
    return change_children(b, old, c, leaving, arriving, made);
}
