/* SPDX-License-Identifier: MIT */
/* lookup.c - finds the row of a body.
 *
 * A body that is stored is in the level of its half extents, in the leaf of its position. So the descent that a change
 * makes anyway finds it, and the half extents in the ids of points (two_bodies.h) exclude most others in the leaf. A
 * hash table would cost two cache misses and at least 10 bytes a body.
 *
 * It is needed where leaves are crowded: a million bodies may be at one place. The first change that meets such a leaf
 * hashes the rows of the set. Changes of many bodies hash them too, because the table finds the duplicates among these
 * bodies.
 *
 * Cost: O(depth), and O(n) once if a leaf is crowded.
 */
#include "lookup.h"
#include "two_bodies.h"

static bool is_crowded(const node *leaf)
{
    return leaf->count > POOL_MAX_UNITS;
}

/* Returns the leaf for a position. Null: the tree has none. */
static const node *find_leaf(const octree *tree, const double position[3])
{
    if (!tree)
        return NULL;
    const path p = find_path(tree, morton_code(tree->axes, position));
    return path_end(&p)->octants ? NULL : path_end(&p);
}

static uint32_t find_row_in_leaf(const octree_bodies *set, const level *l, const node *leaf, const octree_body *body)
{
    const uint64_t steps = make_point_id(l, 0, body->half);
    for (uint32_t i = 0; i < leaf->count; i++) {
        const octree_point *point = &leaf_points(leaf)[i];
        const uint32_t row = row_of_point(point);
        if (point->position[0] == body->position[0] && (uint64_t)row << ROW_SHIFT == point->id - steps &&
            is_same_body(row_at(&set->rows, row), body))
            return row;
    }
    return ROW_NONE;
}

uint32_t find_row(const octree_bodies *set, const octree_body *body)
{
    if (rows_are_hashed(&set->rows))
        return rows_find(&set->rows, body);
    const level *l = &set->levels[find_level(set, body->half)];
    const node *leaf = find_leaf(l->tree, body->position);
    return leaf ? find_row_in_leaf(set, l, leaf, body) : ROW_NONE;
}

uint32_t find_row_for_change(octree_bodies *set, const octree_body *body)
{
    if (rows_are_hashed(&set->rows))
        return rows_find(&set->rows, body);
    const level *l = &set->levels[find_level(set, body->half)];
    const node *leaf = find_leaf(l->tree, body->position);
    if (!leaf)
        return ROW_NONE;
    return is_crowded(leaf) && rows_hash(&set->rows, 0) ? rows_find(&set->rows, body)
                                                        : find_row_in_leaf(set, l, leaf, body);
}

static bool has_crowded_leaf_below(const node *n)
{
    bool found = n->octants == 0 && is_crowded(n);
    for (unsigned i = 0; !found && i < bits_count8(n->octants); i++)
        found = is_crowded(&children_of(n)[i]) && has_crowded_leaf_below(&children_of(n)[i]);
    return found;
}

bool has_crowded_leaf(const octree_bodies *set)
{
    bool found = false;
    for (unsigned i = 0; !found && i < OCTREE_BODY_LEVELS; i++)
        found = set->levels[i].tree && has_crowded_leaf_below(&set->levels[i].tree->root);
    return found;
}
