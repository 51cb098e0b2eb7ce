/* remove_many.c - many points at once: what a node becomes is made from what is left of it. */
#include "bulk.h"
#include "undo_log.h"
#include "leaf.h"

#include <string.h>

typedef struct removal {
    octree *tree;
    batch *batch;
    journal journal;
} removal;

/* A leaf of the points that are not marked. */
static bool make_rest(removal *r, const node *old, const bool *gone, uint32_t left, node *made)
{
    if (!journal_make_leaf(&r->journal, made, left))
        return false;
    for (uint32_t i = 0; i < old->count; i++)
        if (!gone[i])
            leaf_put(made, &leaf_points(old)[i]);
    return journal_replace(&r->journal, old);
}

static bool take_from_leaf(removal *r, const node *old, const morton_item *items, size_t count, node *made)
{
    bool *gone = arena_take(&r->tree->memory, old->count + 1);
    if (!gone)
        return false;
    memset(gone, 0, old->count + 1);
    uint32_t left = old->count;
    for (size_t i = 0; i < count; i++) {
        const octree_point *point = batch_point(r->batch, &items[i]);
        const uint32_t index = leaf_find(old, point->position, point->id);
        if (index == LEAF_NONE || gone[index]) {
            batch_set(r->batch, &items[i], OCTREE_NOT_FOUND);
        } else {
            gone[index] = true;
            left--;
        }
    }
    const bool ok = left == old->count || make_rest(r, old, gone, left, made);
    arena_give(&r->tree->memory, gone, old->count + 1);
    return ok;
}

/* What is left of an inner node's children: those that are not empty, in one leaf where they fit. */
static bool make_parent(removal *r, const node children[8], unsigned octants, uint32_t count, node *made)
{
    unsigned left = 0, mask = 0;
    for (unsigned octant = 0; octant < 8; octant++)
        if ((octants >> octant & 1) && children[octant].count > 0)
            mask |= 1u << octant;
    if (mask == 0)
        return journal_make_leaf(&r->journal, made, 0);
    node *group = journal_make_group(&r->journal, bits_count8(mask));
    if (!group)
        return false;
    for (unsigned octant = 0; octant < 8; octant++)
        if (mask >> octant & 1)
            group[left++] = children[octant];
    *made = (node){.below = group, .count = count, .octants = (uint8_t)mask};
    return !fits_leaf(r->tree, count) || journal_collapse(&r->journal, made);
}

/* What a node becomes; itself where nothing of it is removed. */
static bool take(removal *r, const node *old, cell c, const morton_item *items, size_t count, node *made)
{
    *made = *old;
    if (!old->octants)
        return count == 0 || take_from_leaf(r, old, items, count, made);
    node children[8];
    uint32_t left = old->count;
    for (unsigned octant = 0; octant < 8; octant++)
        if (old->octants >> octant & 1)
            children[octant] = *child_at(old, octant);
    for (size_t at = 0, share; at < count; at += share) {
        const unsigned octant = morton_octant(items[at].code, c.depth);
        share = batch_share(items + at, count - at, c.depth);
        const node *child = child_at(old, octant);
        for (size_t i = at; !child && i < at + share; i++)
            batch_set(r->batch, &items[i], OCTREE_NOT_FOUND);
        if (!child)
            continue;
        if (!take(r, child, cell_child(c, octant), items + at, share, &children[octant]))
            return false;
        left -= child->count - children[octant].count;
    }
    if (left == old->count)
        return true;
    return make_parent(r, children, old->octants, left, made) && journal_replace(&r->journal, old);
}

static octree_status remove_batch(octree *tree, batch *b)
{
    removal r = {.tree = tree, .batch = b, .journal = {.tree = tree}};
    node root;
    if (!take(&r, &tree->root, root_cell(), b->items, b->count, &root)) {
        journal_abandon(&r.journal);
        return OCTREE_NO_MEMORY;
    }
    if (root.count == tree->root.count)
        journal_abandon(&r.journal); /* nothing was found */
    else
        journal_commit(&r.journal, root);
    return OCTREE_OK;
}

octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed)
{
    if (!tree || (!points && count))
        return OCTREE_NULL_ARGUMENT;
    batch b;
    const uint32_t before = tree->root.count;
    octree_status status = batch_begin(&b, tree, points, count, statuses);
    if (status == OCTREE_OK)
        status = remove_batch(tree, &b);
    if (status == OCTREE_OK && removed)
        *removed = before - tree->root.count;
    batch_end(&b);
    return status;
}
