/* SPDX-License-Identifier: MIT */
/* tree_summary.c - updates the digest, the statistics and the list of inner nodes by walking only the changed subtrees.
 */
#include "tree_summary.h"
#include "../tree/walk.h"

#define SUBTREE_POINTS 512

/* A leaf, or a subtree of at most SUBTREE_POINTS points whose parent has more points. */
typedef struct subtree {
    octree_address address;
    size_t first_inner, inner_count; /* the part of the list `inner` that belongs to the subtree */
    octree_stats stats;
    uint64_t sum; /* the sum of digest_node() of all nodes of the subtree */
} subtree;

/* The state of an update. An update walks the tree in pre-order. The lists are in pre-order too, so each list needs
 * only one index, which never goes back. */
typedef struct update {
    tree_summary *to;
    arena *memory;
    size_t next_before, next_touched;
    bool out_of_memory;
} update;

void tree_summary_record_change(tree_summary *s, arena *memory, const octree *tree, const double position[3])
{
    if (!s->known)
        return;
    /* If more positions have changed, sorting the positions costs more than walking the whole tree. */
    const bool few = s->touched.count < 64 + tree->root.count / 16;
    const uint64_t code = morton_code(tree->axes, position);
    s->known = few && list_push(memory, &s->touched, &code, sizeof code);
}

void tree_summary_release(tree_summary *s, arena *memory)
{
    list_release(memory, &s->touched, sizeof(uint64_t));
    list_release(memory, &s->subtrees, sizeof(subtree));
    list_release(memory, &s->subtrees_before, sizeof(subtree));
    list_release(memory, &s->inner, sizeof(octree_address));
    list_release(memory, &s->inner_before, sizeof(octree_address));
}

/* ---- A subtree ---------------------------------------------------------------------------------------------- */

static void add_inner_node(update *u, octree_address address)
{
    u->out_of_memory |= !list_push(u->memory, &u->to->inner, &address, sizeof address);
}

/* Find the subtree with this address in the list of the previous update. Returns null if the list has no such
 * subtree. */
static const subtree *find_previous_subtree(update *u, octree_address address)
{
    const subtree *before = u->to->subtrees_before.items;
    const size_t count = u->to->subtrees_before.count;
    while (u->next_before < count && compare_addresses(&before[u->next_before].address, &address) < 0)
        u->next_before++;
    return u->next_before < count && before[u->next_before].address == address ? &before[u->next_before] : NULL;
}

/* Returns whether a point in the cell with this address was inserted or removed since the previous update. */
static bool has_cell_changed(update *u, octree_address address)
{
    const uint64_t *codes = u->to->touched.items;
    const size_t count = u->to->touched.count;
    const unsigned below = 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
    const uint64_t first = morton_of_address(address);
    while (u->next_touched < count && codes[u->next_touched] < first)
        u->next_touched++;
    return u->next_touched < count && codes[u->next_touched] - first < UINT64_C(1) << below;
}

static void copy_previous_inner_nodes(update *u, const subtree *before)
{
    const octree_address *addresses = u->to->inner_before.items;
    for (size_t i = 0; i < before->inner_count; i++)
        add_inner_node(u, addresses[before->first_inner + i]);
}

static void add_nodes_below(update *u, octree_stats *stats, uint64_t *sum, const node *n, octree_address address,
                            bool whole);

static void add_subtree(update *u, const node *n, octree_address address)
{
    const subtree *before = find_previous_subtree(u, address);
    subtree *made = list_append(u->memory, &u->to->subtrees, sizeof *made);
    if (!made) {
        u->out_of_memory = true;
        return;
    }
    const size_t first_inner = u->to->inner.count;
    if (before && !has_cell_changed(u, address)) {
        *made = *before;
        copy_previous_inner_nodes(u, before);
    } else {
        *made = (subtree){.address = address};
        add_nodes_below(u, &made->stats, &made->sum, n, address, true);
    }
    made->first_inner = first_inner;
    made->inner_count = u->to->inner.count - first_inner;
}

/* ---- The whole tree ----------------------------------------------------------------------------------------- */

/* Add a node and all its descendants, in pre-order. If `whole` is false, a subtree of at most SUBTREE_POINTS points is
 * added to the list of subtrees, and its nodes are not added one by one. */
static void add_nodes_below(update *u, octree_stats *stats, uint64_t *sum, const node *n, octree_address address,
                            bool whole)
{
    if (u->out_of_memory)
        return;
    if (!whole && (n->octants == 0 || n->count <= SUBTREE_POINTS)) {
        add_subtree(u, n, address);
        return;
    }
    count_node(stats, n, octree_address_depth(address));
    *sum += digest_node(n, address);
    if (n->octants == 0)
        return;
    add_inner_node(u, address);
    prefetch_below(n);
    const node *child = children_of(n);
    for (unsigned octant = 0; octant < 8; octant++)
        if (n->octants >> octant & 1)
            add_nodes_below(u, stats, sum, child++, address << 3 | octant, whole);
}

static void add_stats(octree_stats *to, const octree_stats *of)
{
    to->nodes += of->nodes;
    to->leaves += of->leaves;
    to->depth = of->depth > to->depth ? of->depth : to->depth;
    to->largest_leaf = of->largest_leaf > to->largest_leaf ? of->largest_leaf : to->largest_leaf;
    for (unsigned depth = 0; depth <= of->depth; depth++) {
        to->nodes_at_depth[depth] += of->nodes_at_depth[depth];
        to->leaves_at_depth[depth] += of->leaves_at_depth[depth];
    }
}

static void swap_and_clear_lists(list *now, list *before)
{
    const list kept = *before;
    *before = *now;
    *now = kept;
    now->count = 0;
}

bool tree_summary_update(tree_summary *s, arena *memory, const octree *tree)
{
    update u = {.to = s, .memory = memory};
    uint64_t sum = 0;
    swap_and_clear_lists(&s->subtrees, &s->subtrees_before);
    swap_and_clear_lists(&s->inner, &s->inner_before);
    if (!s->known || s->capacity != tree->def.leaf_capacity)
        s->subtrees_before.count = 0;
    list_sort(&s->touched, sizeof(uint64_t), compare_first_words);
    s->stats = (octree_stats){.points = tree->root.count, .memory = tree->store.memory.bytes};
    add_nodes_below(&u, &s->stats, &sum, &tree->root, OCTREE_ROOT, false);
    const subtree *subtrees = s->subtrees.items;
    for (size_t i = 0; i < s->subtrees.count; i++) {
        sum += subtrees[i].sum;
        add_stats(&s->stats, &subtrees[i].stats);
    }
    s->digest = digest_of_tree(tree, sum);
    s->known = !u.out_of_memory;
    s->version = tree->version;
    s->capacity = tree->def.leaf_capacity;
    s->touched.count = 0;
    return s->known;
}

/* Append to `out` the addresses in `a` that are not in `b`. Returns false if memory runs out. */
static bool append_missing_addresses(arena *memory, const list *a, const list *b, list *out)
{
    const octree_address *in_a = a->items, *in_b = b->items;
    for (size_t i = 0, j = 0; i < a->count; i++) {
        while (j < b->count && compare_addresses(&in_b[j], &in_a[i]) < 0)
            j++;
        if (j < b->count && in_b[j] == in_a[i])
            continue;
        if (!list_push(memory, out, &in_a[i], sizeof in_a[i]))
            return false;
    }
    return true;
}

bool tree_summary_list_splits_and_merges(const tree_summary *s, arena *memory, list *splits, list *merges)
{
    return append_missing_addresses(memory, &s->inner, &s->inner_before, splits) &&
           append_missing_addresses(memory, &s->inner_before, &s->inner, merges);
}
