/* SPDX-License-Identifier: MIT */
/* lookup.c - finds the row of a body.
 *
 * A body that is stored is in the level of its half extents, in the leaf of its position. So the descent that a change
 * makes anyway finds it, and the half extents in the ids of points (few_bodies.h) exclude most others in the leaf. A
 * hash table would cost two cache misses and at least 10 bytes a body.
 *
 * It is needed where leaves are crowded: a million bodies may be at one place. The first change that meets such a leaf
 * hashes the rows of the set. Changes of many bodies use such a table for a while (change_many.c).
 *
 * Cost: O(depth), and O(n) once if a leaf is crowded.
 */
#include "lookup.h"
#include "boxes.h"
#include "few_bodies.h"

static bool is_crowded(const node *leaf)
{
    return leaf->count > POOL_MAX_UNITS;
}

/* Returns whether a point of a level is that of a body. */
static bool is_point_of_body(const octree_bodies *set, const level *l, const octree_point *point,
                             const octree_body *body)
{
    const uint32_t row = row_of_point(point);
    return is_same_position(point->position, body->position) && point->id == make_point_id(l, row, body->half) &&
           is_same_body(row_at(&set->rows, row), body);
}

/* Find a body among the points of its leaf. */
static void find_in_leaf(const octree_bodies *set, const level *l, const octree_body *body, found_body *found)
{
    const node *leaf = path_end(&found->at.path);
    for (uint32_t begin = 0; begin < leaf->count; begin += SCAN_POINTS) {
        const octree_point *points = leaf_points(leaf) + begin;
        uint64_t equal = mask_equal_x(points, count_scanned(leaf, begin), body->position[0]);
        for (; equal; equal &= equal - 1) {
            const unsigned i = bits_lowest(equal);
            if (is_point_of_body(set, l, &points[i], body)) {
                found->row = row_of_point(&points[i]);
                found->at.index = begin + i;
                return;
            }
        }
    }
}

/* Find a body by the hash table, then its point in the leaf. */
static void find_by_hash(const octree_bodies *set, const level *l, const octree_body *body, found_body *found)
{
    found->row = rows_find(&set->rows, body);
    if (found->row != ROW_NONE)
        found->at.index =
            leaf_find(path_end(&found->at.path), body->position, make_point_id(l, found->row, body->half));
}

/* Start to load the box of the leaf at the end of a path. A change reads it after the leaf's points. */
static void prefetch_box_of_leaf(const level *l, const path *p)
{
    if (p->depth == 0 || !has_boxes(&l->tree->store))
        return;
    const octree_box *box = box_on_path(p, p->depth);
    prefetch_memory(&box->min[0]);
    prefetch_memory(&box->max[2]);
}

/* Find a body, and hash the rows of the set `changed` before if the leaf is crowded. Null: the set is not changed. */
static inline bool find(const octree_bodies *set, const octree_body *body, octree_bodies *changed,
                        const found_body *near, found_body *found)
{
    found->level = find_level(set, body->half);
    found->row = ROW_NONE;
    const level *l = &set->levels[found->level];
    if (!l->tree)
        return false;
    found->code = morton_code(l->tree->axes, body->position);
    if (near && near->level == found->level)
        begin_path_beside(&found->at.path, found->code, &near->at.path, near->code);
    else
        begin_path(&found->at.path, l->tree);
    extend_path(&found->at.path, found->code);
    const node *end = path_end(&found->at.path);
    if (end->octants)
        return false;
    if (changed)
        prefetch_box_of_leaf(l, &found->at.path);
    if (changed && is_crowded(end) && !rows_are_hashed(&set->rows))
        rows_hash(&changed->rows, 0);
    (rows_are_hashed(&set->rows) ? find_by_hash : find_in_leaf)(set, l, body, found);
    return found->row != ROW_NONE;
}

bool find_body(const octree_bodies *set, const octree_body *body, found_body *found)
{
    return find(set, body, NULL, NULL, found);
}

bool find_body_for_change(octree_bodies *set, const octree_body *body, const found_body *near, found_body *found)
{
    return find(set, body, set, near, found);
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
