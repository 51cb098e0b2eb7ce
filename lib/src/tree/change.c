/* SPDX-License-Identifier: MIT */
/* change.c - single changes of a tree.
 *
 * Algorithm 1 (insert): a point descends to its leaf. A full leaf splits, refuses the point, or grows beyond its
 * capacity. Algorithm 2 (remove): after a removal, a node becomes a leaf if its remaining points fit into one leaf. A
 * move within a leaf overwrites the point; any other move is an insertion and a removal. Memory is allocated before
 * anything changes, so that a failure leaves the tree as it was.
 *
 * A function with a parameter `undo` stores in *undo how to revert its change (undo.h), and keeps the memory that the
 * node no longer needs; finish_move() frees this memory. If `undo` is null, the change is final, and the memory is
 * freed at once.
 */
#include "../exact/float_mode.h"
#include "undo.h"

#include <string.h>

/* Replace a node by another version, which shares no memory with the node. */
static void replace_node(octree *tree, node *at, const node *made, step *undo)
{
    if (undo)
        *undo = (step){.kind = STEP_REPLACED, .old = *at};
    else
        node_release(&tree->store, at);
    *at = *made;
}

/* ---- Inserting ---------------------------------------------------------------------------------------------- */

/* Add a leaf with this point as a child of an inner node that has no child in the point's octant. */
static octree_status add_child_leaf(octree *tree, node *parent, unsigned octant, const octree_point *point, step *undo)
{
    const unsigned children = bits_count8(parent->octants), index = child_index(parent, octant);
    node leaf = {0};
    if (!leaf_append(&tree->store, &leaf, point))
        return OCTREE_NO_MEMORY;
    node *group = group_copy_with_gap(&tree->store, parent->below, children, index);
    if (!group) {
        leaf_release(&tree->store, &leaf);
        return OCTREE_NO_MEMORY;
    }
    group[index] = leaf;
    if (undo)
        *undo = (step){.kind = STEP_REGROUPED, .old = *parent};
    else
        group_free(&tree->store, parent->below, children);
    parent->below = group;
    parent->octants |= (uint8_t)(1u << octant);
    return OCTREE_OK;
}

/* How the points of a full leaf and a new point are divided among the octants of a cell. */
typedef struct shares {
    double planes[3]; /* the splitting planes of the cell */
    uint32_t counts[8];
    uint8_t mask;
} shares;

/* Returns the octant of a position, by comparing the position with the planes. */
static unsigned find_octant(const shares *s, const double p[3])
{
    return (unsigned)(p[0] >= s->planes[0]) << 2 | (unsigned)(p[1] >= s->planes[1]) << 1 |
           (unsigned)(p[2] >= s->planes[2]);
}

static void add_to_octant_count(shares *s, const octree_point *point)
{
    const unsigned octant = find_octant(s, point->position);
    s->counts[octant]++;
    s->mask |= (uint8_t)(1u << octant);
}

static shares count_points_by_octant(const octree *tree, cell c, const node *full, const octree_point *point)
{
    shares s = {.mask = 0};
    for (int i = 0; i < 3; i++)
        s.planes[i] = plane_at(&tree->axes[i], c.low[i] + cell_size(c.depth + 1));
    for (uint32_t i = 0; i < full->count; i++)
        add_to_octant_count(&s, &leaf_points(full)[i]);
    add_to_octant_count(&s, point);
    return s;
}

/* Descend from the cell of a full leaf to the first cell whose octants separate the leaf's points and the new point. If
 * there is such a cell, returns true, and *c is the cell. Otherwise returns false, and *c is the indivisible cell that
 * holds all of these points. */
static bool find_splitting_cell(const octree *tree, const node *full, const octree_point *point, cell *c, shares *s)
{
    for (; can_split(tree, *c); *c = cell_child(*c, bits_lowest(s->mask))) {
        *s = count_points_by_octant(tree, *c, full, point);
        if (s->mask & (s->mask - 1))
            return true;
    }
    return false;
}

static bool create_leaves(octree *tree, node *group, const shares *s)
{
    for (unsigned octant = 0; octant < 8; octant++)
        if (s->counts[octant] && !leaf_create(&tree->store, group++, s->counts[octant]))
            return false;
    return true;
}

/* Make an inner node whose leaves hold the points of a full leaf and a new point. Returns false if memory runs out;
 * nothing stays allocated then. */
static bool make_split_node(octree *tree, node *made, const node *full, const octree_point *point, const shares *s)
{
    const unsigned children = bits_count8(s->mask);
    node *group = group_allocate(&tree->store, children);
    if (!group)
        return false;
    memset(group, 0, children * sizeof(node));
    *made = (node){.below = group, .count = full->count + 1, .octants = s->mask};
    if (!create_leaves(tree, group, s)) {
        node_release(&tree->store, made);
        return false;
    }
    for (uint32_t i = 0; i < full->count; i++)
        leaf_append_unchecked(child_at(made, find_octant(s, leaf_points(full)[i].position)), &leaf_points(full)[i]);
    leaf_append_unchecked(child_at(made, find_octant(s, point->position)), point);
    return true;
}

/* Make a leaf that is larger than the capacity. It holds the points of a full leaf and a new point. Returns false if
 * memory runs out. */
static bool make_grown_leaf(octree *tree, node *made, const node *full, const octree_point *point)
{
    if (!leaf_create(&tree->store, made, full->count + 1))
        return false;
    leaf_append_all(made, full, NULL);
    leaf_append_unchecked(made, point);
    return true;
}

/* Replace `bottom`, a node of depth `from`, by a chain of inner nodes with one child each. The chain starts at depth
 * `to`, and its last child is the old *bottom. Returns false if memory runs out. */
static bool make_parent_chain(octree *tree, node *bottom, uint64_t code, unsigned from, unsigned to)
{
    for (; from > to; from--) {
        node *only = group_allocate(&tree->store, 1);
        if (!only) {
            node_release(&tree->store, bottom);
            return false;
        }
        *only = *bottom;
        *bottom =
            (node){.below = only, .count = only->count, .octants = (uint8_t)(1u << morton_octant(code, from - 1))};
    }
    return true;
}

static octree_status append_to_leaf(octree *tree, node *leaf, const octree_point *point, step *undo)
{
    node larger;
    if (!undo)
        return leaf_append(&tree->store, leaf, point) ? OCTREE_OK : OCTREE_NO_MEMORY;
    if (!leaf_is_full(leaf)) {
        undo->kind = STEP_APPENDED;
        leaf_append_unchecked(leaf, point);
        return OCTREE_OK;
    }
    if (!leaf_copy_larger(&tree->store, leaf, &larger))
        return OCTREE_NO_MEMORY;
    leaf_append_unchecked(&larger, point);
    replace_node(tree, leaf, &larger, undo);
    return OCTREE_OK;
}

/* Add a point to a full leaf of this depth. The new node is complete before it replaces the leaf, so that a lack of
 * memory changes nothing. */
static octree_status split_or_grow_leaf(octree *tree, node *leaf, const octree_point *point, uint64_t code,
                                        unsigned depth, step *undo)
{
    cell bottom = morton_cell(code, depth);
    shares s;
    const bool splits = find_splitting_cell(tree, leaf, point, &bottom, &s);
    if (!splits && tree->def.full_leaf == OCTREE_REFUSE)
        return OCTREE_FULL;
    if (!splits && bottom.depth == depth)
        return append_to_leaf(tree, leaf, point, undo);
    node made;
    const bool enough =
        splits ? make_split_node(tree, &made, leaf, point, &s) : make_grown_leaf(tree, &made, leaf, point);
    if (!enough || !make_parent_chain(tree, &made, code, bottom.depth, depth))
        return OCTREE_NO_MEMORY;
    replace_node(tree, leaf, &made, undo);
    return OCTREE_OK;
}

static octree_status insert_into_leaf(octree *tree, node *leaf, const octree_point *point, uint64_t code,
                                      unsigned depth, bool may_split, step *undo)
{
    if (leaf->count >= tree->def.leaf_capacity && !may_split)
        return OCTREE_FULL;
    if (leaf->count >= tree->def.leaf_capacity)
        return split_or_grow_leaf(tree, leaf, point, code, depth, undo);
    return append_to_leaf(tree, leaf, point, undo);
}

/* Returns the index of a point in the leaf at the end of a path; LEAF_NONE if the point is not stored. */
static uint32_t find_at_end_of_path(const path *p, const octree_point *point)
{
    const node *end = path_end(p);
    return end->octants ? LEAF_NONE : leaf_find(end, point->position, point->id);
}

/* Insert a point that is not stored yet at the end of the path to its code: into the leaf there, or as a new leaf of
 * the inner node there. */
static octree_status insert_at_end_of_path(octree *tree, const path *p, const octree_point *point, uint64_t code,
                                           bool may_split, step *undo)
{
    if (tree->root.count == UINT32_MAX)
        return OCTREE_TOO_MANY;
    node *end = path_end(p);
    const bool is_leaf = end->octants == 0;
    const octree_status status = is_leaf ? insert_into_leaf(tree, end, point, code, p->depth, may_split, undo)
                                         : add_child_leaf(tree, end, morton_octant(code, p->depth), point, undo);
    if (status != OCTREE_OK)
        return status;
    if (undo)
        undo->depth = (uint8_t)p->depth;
    /* If the path's last node is a leaf, its count is not increased here: leaf_append() has already counted the
     * point. */
    const unsigned inner = is_leaf ? p->depth : p->depth + 1;
    for (unsigned i = 0; i < inner; i++)
        p->nodes[i]->count++;
    tree->version++;
    return OCTREE_OK;
}

octree_status insert_along_path(octree *tree, const path *p, const octree_point *point, uint64_t code)
{
    return insert_at_end_of_path(tree, p, point, code, true, NULL);
}

octree_status insert_point(octree *tree, const octree_point *point, uint64_t code, bool may_split)
{
    const path p = find_path(tree, code);
    return find_at_end_of_path(&p, point) == LEAF_NONE ? insert_at_end_of_path(tree, &p, point, code, may_split, NULL)
                                                       : OCTREE_DUPLICATE;
}

octree_status octree_insert(octree *tree, const double position[3], uint64_t id)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_insert, tree, position, id);
    octree_status status = check_position_for_change(tree, position);
    if (status != OCTREE_OK)
        return status;
    const octree_point point = {{position[0], position[1], position[2]}, id};
    status = insert_point(tree, &point, morton_code(tree->axes, position), true);
    if (status == OCTREE_OK && change_log_is_on(&tree->changes))
        change_log_append(tree, OCTREE_INSERTED, &point, point.position);
    tune_if_due(tree);
    return status;
}

/* ---- Removing: memory is allocated first, so that a move can allocate before it changes anything ------------ */

/* Returns the depth of the highest node on the path whose points fit into one leaf after one point is removed. If there
 * is no such node, returns the depth of the path's leaf. */
static unsigned find_merge_depth(const octree *tree, const path *p)
{
    unsigned depth = p->depth;
    while (depth > 0 && fits_leaf(tree, p->nodes[depth - 1]->count - 1))
        depth--;
    return depth;
}

/* Allocate the leaf that replaces the merged nodes when this point is removed. If no nodes merge, *spare stays an empty
 * leaf. Returns false if memory runs out. */
static bool allocate_merged_leaf(octree *tree, const found_point *found, node *spare)
{
    const unsigned depth = find_merge_depth(tree, &found->path);
    *spare = (node){.below = NULL};
    return depth == found->path.depth || leaf_create(&tree->store, spare, found->path.nodes[depth]->count - 1);
}

void remove_empty_child(octree *tree, node *parent, node *child)
{
    node *group = children_of(parent);
    const unsigned children = bits_count8(parent->octants), index = (unsigned)(child - group);
    leaf_release(&tree->store, child);
    group_remove(&tree->store, group, children, index);
    unsigned octant = 0;
    while (!(parent->octants >> octant & 1) || child_index(parent, octant) != index)
        octant++;
    parent->octants &= (uint8_t) ~(1u << octant);
}

/* Remove a point from its leaf, and an empty leaf from its parent. With `undo`, the empty leaf stays. */
static void remove_from_leaf(octree *tree, const found_point *found, step *undo)
{
    const path *p = &found->path;
    node *leaf = path_end(p);
    if (undo) {
        *undo = (step){.kind = STEP_REMOVED, .old = *leaf, .index = found->index};
        leaf_remove_keeping_block(leaf, found->index);
        return;
    }
    leaf_remove(&tree->store, leaf, found->index);
    if (leaf->count == 0 && p->depth > 0)
        remove_empty_child(tree, p->nodes[p->depth - 1], leaf);
}

/* Remove a point that was found. Cannot fail. `spare` is the leaf from allocate_merged_leaf(); it is used or freed
 * here. */
static void remove_found_point(octree *tree, const found_point *found, node *spare, step *undo)
{
    const path *p = &found->path;
    node *leaf = path_end(p);
    const unsigned depth = find_merge_depth(tree, p);
    if (depth < p->depth) {
        leaf_append_all(spare, p->nodes[depth], &leaf_points(leaf)[found->index]);
        replace_node(tree, p->nodes[depth], spare, undo);
    } else {
        leaf_release(&tree->store, spare);
        remove_from_leaf(tree, found, undo);
    }
    if (undo)
        undo->depth = (uint8_t)depth;
    for (unsigned i = 0; i < depth; i++)
        p->nodes[i]->count--;
    tree->version++;
}

/* Shorten a path to the nodes that still exist after a removal. */
static void shorten_path(path *p, uint64_t code)
{
    const unsigned depth = p->depth;
    p->depth = 0;
    while (p->depth < depth && path_end(p)->octants >> morton_octant(code, p->depth) & 1)
        p->depth++;
}

/* Remove a point that was found. Returns OK or NO_MEMORY. */
static octree_status allocate_and_remove(octree *tree, const found_point *found)
{
    node spare;
    if (!allocate_merged_leaf(tree, found, &spare))
        return OCTREE_NO_MEMORY;
    remove_found_point(tree, found, &spare, NULL);
    return OCTREE_OK;
}

octree_status remove_along_path(octree *tree, found_point *found, uint64_t code)
{
    const octree_status status = allocate_and_remove(tree, found);
    if (status == OCTREE_OK)
        shorten_path(&found->path, code);
    return status;
}

octree_status prepare_removal(octree *tree, const double position[3], uint64_t id, prepared_removal *r)
{
    if (!find_point(tree, position, id, &r->found))
        return OCTREE_NOT_FOUND;
    return allocate_merged_leaf(tree, &r->found, &r->spare) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

void make_removal(octree *tree, prepared_removal *r)
{
    const octree_point removed = stored_point(&r->found);
    remove_found_point(tree, &r->found, &r->spare, NULL);
    if (change_log_is_on(&tree->changes))
        change_log_append(tree, OCTREE_REMOVED, &removed, NULL);
}

void cancel_removal(octree *tree, prepared_removal *r)
{
    leaf_release(&tree->store, &r->spare);
}

octree_status remove_point(octree *tree, octree_point *point)
{
    found_point found;
    if (!find_point(tree, point->position, point->id, &found))
        return OCTREE_NOT_FOUND;
    *point = stored_point(&found);
    return allocate_and_remove(tree, &found);
}

octree_status octree_remove(octree *tree, const double position[3], uint64_t id)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_remove, tree, position, id);
    octree_status status = check_position_for_change(tree, position);
    if (status != OCTREE_OK)
        return status;
    /* `position` may point into the leaf, so it is copied first */
    octree_point removed = {{position[0], position[1], position[2]}, id};
    status = remove_point(tree, &removed);
    if (status == OCTREE_OK && change_log_is_on(&tree->changes))
        change_log_append(tree, OCTREE_REMOVED, &removed, NULL);
    return status;
}

/* ---- Moving ------------------------------------------------------------------------------------------------- */

/* Move a point to another leaf. Only the insertion can be refused, so it comes first. The memory for the removal is
 * allocated before the insertion. This memory is enough: the insertion only adds points, so it cannot cause more nodes
 * to merge. */
static octree_status move_to_other_leaf(octree *tree, found_point *found, const single_move *m, const path *to,
                                        step *undo)
{
    node spare;
    if (!allocate_merged_leaf(tree, found, &spare))
        return OCTREE_NO_MEMORY;
    /* the insertion adds a node to a group of siblings, whose nodes may then move in memory */
    const bool moves_nodes = path_end(to)->octants != 0;
    const octree_status status = insert_at_end_of_path(tree, to, &m->moved, m->to, true, undo);
    if (status != OCTREE_OK) {
        leaf_release(&tree->store, &spare);
        return status;
    }
    if (moves_nodes)
        found->path = find_path(tree, m->from);
    remove_found_point(tree, found, &spare, undo ? undo + 1 : NULL);
    return OCTREE_OK;
}

octree_status move_found_point(octree *tree, const single_move *m, found_point *found, const path *to, step *undo)
{
    node *leaf = path_end(to);
    if (leaf != path_end(&found->path))
        return move_to_other_leaf(tree, found, m, to, undo);
    leaf_replace(leaf, found->index, &m->moved);
    if (undo)
        *undo = (step){.kind = STEP_OVERWRITTEN, .depth = (uint8_t)to->depth};
    tree->version++;
    return OCTREE_OK;
}

octree_status move_along_paths(octree *tree, single_move *m, found_point *found, const path *to, step *undo)
{
    found->index = find_at_end_of_path(&found->path, &m->old);
    if (found->index == LEAF_NONE)
        return OCTREE_NOT_FOUND;
    m->old = stored_point(found);
    const uint32_t taken = find_at_end_of_path(to, &m->moved);
    const bool is_itself = taken == found->index && path_end(to) == path_end(&found->path);
    return taken == LEAF_NONE || is_itself ? move_found_point(tree, m, found, to, undo) : OCTREE_DUPLICATE;
}

octree_status octree_move(octree *tree, const double from[3], uint64_t id, const double to[3])
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_move, tree, from, id, to);
    octree_status status = check_position_for_change(tree, from);
    if (status == OCTREE_OK)
        status = check_position(tree, to);
    if (status != OCTREE_OK)
        return status;
    single_move m = {.old = {{from[0], from[1], from[2]}, id}, .moved = {{to[0], to[1], to[2]}, id}};
    m.from = morton_code(tree->axes, from);
    m.to = morton_code(tree->axes, to);
    found_point found = {.path = find_path(tree, m.from)};
    path end;
    begin_path_beside(&end, m.to, &found.path, m.from);
    extend_path(&end, m.to);
    status = move_along_paths(tree, &m, &found, &end, NULL);
    if (status == OCTREE_OK && change_log_is_on(&tree->changes))
        change_log_append(tree, OCTREE_MOVED, &m.old, m.moved.position);
    return status;
}
