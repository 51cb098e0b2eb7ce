/* SPDX-License-Identifier: MIT */
/* boxes.c - the boxes of the nodes of a level, which contain the boxes of all bodies in and below a node.
 *
 * Problem: the cell of a node, extended by the largest half extents of the level, is several times as large as the box
 * of the node's bodies: most bodies are smaller than the largest, and the bodies of a street fill no cubes.
 *
 * Idea: each node has the box of its bodies, as in a bounding volume hierarchy. The tree stores the boxes of siblings
 * side by side (leaf.h), so that a search tests some of the children of a node at once, and reads only those that it
 * visits. The box of a leaf is computed from its points alone, with the bounds of the half extents in their ids
 * (few_bodies.h); that of an inner node is the union of its children's. So boxes are a function of the bodies. Level 0
 * has no boxes, because its half extents have no bound; its searches use the cells (cell.h).
 *
 * A change updates the boxes on the path to its leaf. Where the tree has made a new group of siblings, their boxes are
 * unknown, and are computed.
 *
 * Cost: 48 bytes a node, some 3 to 4 bytes a body. A change updates a few nodes; most changes do not touch the faces of
 * the boxes higher up. Measured in 1e5 bodies whose sizes span three decades: without boxes, the search for the first
 * body on a ray read 14 leaves; with boxes, and the larger floor that they allow (order.c), 4.
 */
#include "box_faces.h"
#include "boxes.h"
#include "few_bodies.h"

/* ---- Compute a box ------------------------------------------------------------------------------------------ */

static octree_box make_empty_box(void)
{
    return (octree_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static octree_box box_of_points(const level *l, const octree_point *points, uint32_t count)
{
    octree_box box;
    lanes low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = lanes_all(HUGE_VAL);
        high[k] = lanes_all(-HUGE_VAL);
    }
    for (uint32_t i = 0; i < count; i += LANES) {
        const few_bodies few = load_few_bodies(points, count, begin_of_group(count, i));
        for (int k = 0; k < 3; k++) {
            const lanes half = lanes_add(lanes_multiply(few.steps[k], lanes_all(step_of_half_extents(l, k))),
                                         lanes_all(l->box_rest[k]));
            low[k] = lanes_smaller(lanes_subtract(few.position[k], half), low[k]);
            high[k] = lanes_larger(lanes_add(few.position[k], half), high[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        box.min[k] = lanes_least(low[k]);
        box.max[k] = lanes_greatest(high[k]);
    }
    return box;
}

/* Returns box_of_points() of a single point. */
static octree_box box_of_point(const level *l, const octree_point *point)
{
    octree_box box;
    for (int k = 0; k < 3; k++) {
        const double steps = (double)(int64_t)(point->id & (uint64_t)MAX_STEPS << STEP_BITS * k);
        const double half = steps * step_of_half_extents(l, k) + l->box_rest[k];
        box.min[k] = point->position[k] - half;
        box.max[k] = point->position[k] + half;
    }
    return box;
}

static unsigned count_children(const node *n)
{
    return bits_count8(n->octants);
}

static octree_box *box_of_child(const node *n, unsigned index)
{
    return boxes_of_group(children_of(n), count_children(n)) + index;
}

/* Returns the box of a node whose children have known boxes. */
static octree_box box_of_node(const level *l, const node *n)
{
    if (n->octants == 0)
        return box_of_points(l, leaf_points(n), n->count);
    octree_box box = make_empty_box();
    for (unsigned i = 0; i < count_children(n); i++)
        include_box(&box, box_of_child(n, i));
    return box;
}

/* ---- Boxes in the tree -------------------------------------------------------------------------------------- */

static unsigned mask_of_children(const node *n)
{
    return (1u << count_children(n)) - 1;
}

static bool is_unknown(const octree_box *box)
{
    return box->min[0] == -HUGE_VAL;
}

/* Returns a bit mask of the children whose boxes are unknown. Below a child with a known box, all boxes are known, but
 * for those that the current change has made. */
static unsigned find_unknown_boxes(const node *n)
{
    unsigned unknown = 0;
    for (unsigned i = 0; i < count_children(n); i++)
        unknown |= (unsigned)is_unknown(box_of_child(n, i)) << i;
    return unknown;
}

/* Compute the boxes of some children of an inner node, and those below: all, or only the unknown ones. */
static void fit_children(const level *l, const node *n, unsigned children, bool all)
{
    for (; children; children &= children - 1) {
        const unsigned i = bits_lowest(children);
        const node *child = &children_of(n)[i];
        if (child->octants)
            fit_children(l, child, all ? mask_of_children(child) : find_unknown_boxes(child), all);
        *box_of_child(n, i) = box_of_node(l, child);
    }
}

void fit_all(const level *l)
{
    if (has_boxes(&l->tree->store))
        fit_children(l, &l->tree->root, mask_of_children(&l->tree->root), true);
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

/* Returns whether a box may determine a face of a box around it. */
static bool touches_face(const octree_box *around, const octree_box *box)
{
    return find_faces_beyond(around, box) != ALL_FACES;
}

/* The boxes of the bodies that left and entered a leaf, or the box of a child before and after a change. At a leaf,
 * one of them may be null. */
typedef struct box_change {
    const octree_box *removed, *added;
} box_change;

/* Returns whether the box of a leaf certainly stays the same. */
static bool keeps_box(const octree_box *box, const box_change *change)
{
    return (!change->added || contains_box(box, change->added)) &&
           (!change->removed || !touches_face(box, change->removed));
}

/* A leaf beyond its capacity, perhaps of a million bodies at one place, keeps its box when a body is removed, because
 * computing the box again would read them all. */
static octree_box change_box_of_leaf(const level *l, const node *leaf, const octree_box *old, const box_change *change)
{
    octree_box box = *old;
    if (change->removed && fits_leaf(l->tree, leaf->count) && touches_face(old, change->removed))
        return box_of_node(l, leaf);
    if (change->added)
        include_box(&box, change->added);
    return box;
}

/* Returns the box of an inner node after the box of a child has changed. It is computed from all children only if the
 * child touched a face of the node's box and no longer does. */
static octree_box change_box_of_node(const level *l, const node *n, const octree_box *old, const box_change *child)
{
    octree_box box = *old;
    if (find_faces_beyond(child->removed, child->added) & ~find_faces_beyond(old, child->removed))
        return box_of_node(l, n);
    include_box(&box, child->added);
    return box;
}

/* Update the boxes on a path from its end towards the root, up to the first box that stays the same. A new node is on
 * the path of a change, or a sibling of such a node. Its box is unknown, so that the way up does not end below it. */
static void fit_boxes_on_path(const level *l, const path *p, box_change change)
{
    octree_box before; /* the box of a child */
    fit_children(l, path_end(p), find_unknown_boxes(path_end(p)), false);
    for (unsigned depth = p->depth; depth > 0; depth--) {
        const node *n = p->nodes[depth], *parent = p->nodes[depth - 1];
        octree_box *box = box_on_path(p, depth);
        const octree_box old = *box;
        if (is_unknown(&old))
            fit_children(l, parent, find_unknown_boxes(parent), false);
        else if (n->octants == 0)
            *box = change_box_of_leaf(l, n, &old, &change);
        else
            *box = depth == p->depth ? box_of_node(l, n) : change_box_of_node(l, n, &old, &change);
        if (is_same_box(&old, box))
            return;
        before = old;
        change = (box_change){&before, box};
    }
}

static void fit_points(const level *l, const path *p, const octree_point *removed, const octree_point *added)
{
    octree_box boxes[2];
    box_change change = {NULL, NULL};
    if (removed) {
        boxes[0] = box_of_point(l, removed);
        change.removed = &boxes[0];
    }
    if (added) {
        boxes[1] = box_of_point(l, added);
        change.added = &boxes[1];
    }
    if (path_end(p)->octants == 0 && p->depth > 0) { /* most changes end here */
        const octree_box *box = box_on_path(p, p->depth);
        if (!is_unknown(box) && keeps_box(box, &change))
            return;
    }
    fit_boxes_on_path(l, p, change);
}

void fit_path(const level *l, const path *p, const octree_point *removed, const octree_point *added)
{
    if (has_boxes(&l->tree->store))
        fit_points(l, p, removed, added);
}

void fit_point(const level *l, const octree_point *point, bool added)
{
    if (!has_boxes(&l->tree->store))
        return;
    const path p = find_path(l->tree, morton_code(l->tree->axes, point->position));
    fit_points(l, &p, added ? NULL : point, added ? point : NULL);
}

/* ---- Check -------------------------------------------------------------------------------------------------- */

/* A leaf that is or was beyond its capacity may have a larger box. */
static bool is_right_box(const octree_box *stored, const octree_box *computed, const node *n)
{
    return n->octants ? is_same_box(stored, computed) : contains_box(stored, computed);
}

static bool are_child_boxes_right(const level *l, const node *n)
{
    bool right = true;
    for (unsigned i = 0; right && i < count_children(n); i++) {
        const node *child = &children_of(n)[i];
        const octree_box computed = box_of_node(l, child);
        right = is_right_box(box_of_child(n, i), &computed, child) && are_child_boxes_right(l, child);
    }
    return right;
}

bool are_boxes_right(const level *l)
{
    return !has_boxes(&l->tree->store) || are_child_boxes_right(l, &l->tree->root);
}
