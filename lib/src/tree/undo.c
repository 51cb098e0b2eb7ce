/* SPDX-License-Identifier: MIT */
/* undo.c - reverts single moves, or frees the memory that they kept. See undo.h. */
#include "undo.h"

/* ---- Reverting ---------------------------------------------------------------------------------------------- */

/* Revert the removal of a point. In a hashed leaf the point is appended: the hash table finds points by the pair
 * (position, id), so their order does not matter. */
static void restore_removed_point(node *leaf, const step *s, const octree_point *point)
{
    if (leaf->room == LEAF_HASHED) {
        leaf_append_unchecked(leaf, point);
        return;
    }
    *leaf = s->old;
    octree_point *points = leaf_points(leaf);
    points[leaf->count - 1] = points[s->index];
    points[s->index] = *point;
}

/* Give a node its old group of children back. Free the new group, and the leaf that was added with it. */
static void restore_child_group(octree *tree, node *at, const node *old)
{
    leaf_release(&tree->store, child_at(at, bits_lowest(at->octants & ~old->octants)));
    group_free(&tree->store, at->below, bits_count8(at->octants));
    *at = *old;
}

static void add_to_counts_above(const path *p, unsigned depth, uint32_t change)
{
    for (unsigned i = 0; i < depth; i++)
        p->nodes[i]->count += change;
}

/* Revert a step that changed a node on the path to `code`, the Morton code of `point`. `added` is the number of points
 * that the step added to the tree, modulo 2^32. */
static void revert_step(octree *tree, const step *s, uint64_t code, const octree_point *point, uint32_t added)
{
    const path p = find_path(tree, code);
    node *at = p.nodes[s->depth];
    switch ((step_kind)s->kind) {
    case STEP_APPENDED:
        leaf_remove_keeping_block(at, leaf_find(at, point->position, point->id));
        break;
    case STEP_REMOVED:
        restore_removed_point(at, s, point);
        break;
    case STEP_REPLACED:
        node_release(&tree->store, at);
        *at = s->old;
        break;
    case STEP_REGROUPED:
        restore_child_group(tree, at, &s->old);
        break;
    case STEP_NONE:
    case STEP_OVERWRITTEN:
        break;
    }
    add_to_counts_above(&p, s->depth, 0 - added);
}

void revert_move(octree *tree, const single_move *m, const step undo[2])
{
    if (undo[0].kind == STEP_OVERWRITTEN) {
        const path p = find_path(tree, m->to);
        leaf_replace(path_end(&p), leaf_find(path_end(&p), m->moved.position, m->moved.id), &m->old);
    } else if (undo[0].kind != STEP_NONE) {
        revert_step(tree, &undo[1], m->from, &m->old, UINT32_MAX);
        revert_step(tree, &undo[0], m->to, &m->moved, 1);
    }
}

/* ---- Finishing ---------------------------------------------------------------------------------------------- */

/* Remove the leaf at a position if it is empty. If it is hashed, shrink its block. */
static void remove_or_shrink_leaf_at(octree *tree, const double position[3])
{
    const path p = find_path(tree, morton_code(tree->axes, position));
    node *leaf = path_end(&p);
    if (leaf->octants)
        return;
    leaf_shrink_hash_table(&tree->store, leaf);
    if (leaf->count == 0 && p.depth > 0)
        remove_empty_child(tree, p.nodes[p.depth - 1], leaf);
}

static void finish_removal(octree *tree, const step *s, const octree_point *removed)
{
    leaf_free_end(&tree->store, &s->old);
    if (s->old.count == 1 || s->old.room == LEAF_HASHED)
        remove_or_shrink_leaf_at(tree, removed->position);
}

void finish_move(octree *tree, const octree_point *old, const step undo[2])
{
    for (int i = 0; i < 2; i++) {
        const step *s = &undo[i];
        if (s->kind == STEP_REPLACED)
            node_release(&tree->store, &s->old);
        else if (s->kind == STEP_REGROUPED)
            group_free(&tree->store, s->old.below, bits_count8(s->old.octants));
        else if (s->kind == STEP_REMOVED)
            finish_removal(tree, s, old);
    }
}
