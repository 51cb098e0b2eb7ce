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
#include "boxes.h"
#include "few_bodies.h"

/* The half extents of a level's bodies. The rest has a bound of the rounding errors of the boxes. */
typedef struct fitting {
    half_steps half[3];
    size_t leaf_capacity;
} fitting;

static fitting make_fitting(const level *l)
{
    fitting f = {.leaf_capacity = l->tree->def.leaf_capacity};
    for (int i = 0; i < 3; i++) {
        const double largest = find_farthest(l, i, 0) + l->unit * (MAX_STEPS + 1);
        f.half[i] = (half_steps){l->unit / (double)(1 << STEP_BITS * i), l->unit + largest * 0x1p-51};
    }
    return f;
}

/* ---- Compute a box ------------------------------------------------------------------------------------------ */

static octree_box make_empty_box(void)
{
    return (octree_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static void include_box(octree_box *around, const octree_box *box)
{
    for (int k = 0; k < 3; k++) {
        around->min[k] = box->min[k] < around->min[k] ? box->min[k] : around->min[k];
        around->max[k] = larger(box->max[k], around->max[k]);
    }
}

static octree_box box_of_points(const fitting *f, const octree_point *points, uint32_t count)
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
            const lanes half =
                lanes_add(lanes_multiply(few.steps[k], lanes_all(f->half[k].step)), lanes_all(f->half[k].rest));
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

static unsigned count_children(const node *n)
{
    return bits_count8(n->octants);
}

static octree_box *box_of_child(const node *n, unsigned index)
{
    return boxes_of_group(children_of(n), count_children(n)) + index;
}

/* Returns the box of a node whose children have known boxes. */
static octree_box box_of_node(const fitting *f, const node *n)
{
    if (n->octants == 0)
        return box_of_points(f, leaf_points(n), n->count);
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
static void fit_children(const fitting *f, const node *n, unsigned children, bool all)
{
    for (; children; children &= children - 1) {
        const unsigned i = bits_lowest(children);
        const node *child = &children_of(n)[i];
        if (child->octants)
            fit_children(f, child, all ? mask_of_children(child) : find_unknown_boxes(child), all);
        *box_of_child(n, i) = box_of_node(f, child);
    }
}

void fit_all(const level *l)
{
    const fitting f = make_fitting(l);
    if (has_boxes(&l->tree->store))
        fit_children(&f, &l->tree->root, mask_of_children(&l->tree->root), true);
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

static bool is_same_box(const octree_box *a, const octree_box *b)
{
    bool same = true;
    for (int i = 0; i < 3; i++)
        same &= (a->min[i] == b->min[i]) & (a->max[i] == b->max[i]);
    return same;
}

/* Returns whether a box may determine a face of a box around it. */
static bool touches_face(const octree_box *around, const octree_box *box)
{
    bool touches = false;
    for (int i = 0; i < 3; i++)
        touches |= (box->min[i] <= around->min[i]) | (box->max[i] >= around->max[i]);
    return touches;
}

typedef struct box_change {
    octree_box box; /* of the body that was added or removed */
    bool adds;
} box_change;

/* A leaf beyond its capacity, perhaps of a million bodies at one place, keeps its box when a body is removed, because
 * computing the box again would read them all. */
static octree_box change_box_of_leaf(const fitting *f, const node *leaf, const octree_box *old,
                                     const box_change *change)
{
    octree_box box = *old;
    if (change->adds)
        include_box(&box, &change->box);
    else if (leaf->count <= f->leaf_capacity && touches_face(old, &change->box))
        box = box_of_node(f, leaf);
    return box;
}

/* Update the box of a child whose contents changed. Returns whether the box has changed. */
static bool update_box(const fitting *f, const node *parent, const node *child, const box_change *change)
{
    octree_box *box = box_of_child(parent, (unsigned)(child - children_of(parent)));
    const octree_box old = *box;
    *box = child->octants ? box_of_node(f, child) : change_box_of_leaf(f, child, &old, change);
    return !is_same_box(&old, box);
}

/* Returns whether a path ends at a leaf whose box is known and stays the same. Most changes need no more than this. */
static bool keeps_known_box(const path *p, const box_change *change)
{
    if (p->depth == 0 || path_end(p)->octants)
        return false;
    const node *parent = p->nodes[p->depth - 1];
    const octree_box *box = box_of_child(parent, (unsigned)(path_end(p) - children_of(parent)));
    return !is_unknown(box) && (change->adds ? contains_box(box, &change->box) : !touches_face(box, &change->box));
}

/* Update the boxes on a path from its end towards the root, up to the first box that stays the same. So each new node
 * is reached: it is on the path of a change, or a sibling of such a node. */
static void fit_boxes_on_path(const fitting *f, const path *p, const box_change *change)
{
    bool changed = !keeps_known_box(p, change);
    for (unsigned depth = p->depth + 1; changed && depth-- > 0;) {
        const node *n = p->nodes[depth];
        const unsigned unknown = find_unknown_boxes(n);
        fit_children(f, n, unknown, false);
        if (depth < p->depth)
            changed = update_box(f, n, p->nodes[depth + 1], change) || unknown != 0;
    }
}

static void fit_point(const fitting *f, const path *p, const octree_point *point, bool adds)
{
    const box_change change = {box_of_points(f, point, 1), adds};
    fit_boxes_on_path(f, p, &change);
}

void fit_path(const level *l, const path *p, const octree_point *point, bool adds)
{
    const fitting f = make_fitting(l);
    if (has_boxes(&l->tree->store))
        fit_point(&f, p, point, adds);
}

static void find_and_fit_point(const fitting *f, const level *l, const octree_point *point, bool adds)
{
    const path p = find_path(l->tree, morton_code(l->tree->axes, point->position));
    fit_point(f, &p, point, adds);
}

/* If a larger share of the bodies has changed, all boxes are computed again. */
enum { BODIES_FOR_A_CHANGE = 64 };

static bool fits_each(const level *l, size_t count)
{
    return count <= l->tree->root.count / BODIES_FOR_A_CHANGE + 1;
}

void fit_changes(const level *l, const octree_point *points, size_t count, bool adds)
{
    if (!fits_each(l, count))
        fit_all(l);
    else if (has_boxes(&l->tree->store)) {
        const fitting f = make_fitting(l);
        for (size_t i = 0; i < count; i++)
            find_and_fit_point(&f, l, &points[i], adds);
    }
}

void fit_moves(const level *l, const octree_point *points, const double (*to)[3], size_t count)
{
    if (!fits_each(l, 2 * count))
        fit_all(l);
    else if (has_boxes(&l->tree->store)) {
        const fitting f = make_fitting(l);
        for (size_t i = 0; i < count; i++) {
            octree_point moved = points[i];
            memcpy(moved.position, to[i], sizeof moved.position);
            find_and_fit_point(&f, l, &moved, true);
        }
        for (size_t i = 0; i < count; i++) /* last: a body that was moved twice has left its first new place */
            find_and_fit_point(&f, l, &points[i], false);
    }
}

/* ---- Check -------------------------------------------------------------------------------------------------- */

/* A leaf that is or was beyond its capacity may have a larger box. */
static bool is_right_box(const octree_box *stored, const octree_box *computed, const node *n)
{
    return is_unknown(stored) || (n->octants ? is_same_box(stored, computed) : contains_box(stored, computed));
}

static bool are_child_boxes_right(const fitting *f, const node *n)
{
    bool right = true;
    for (unsigned i = 0; right && i < count_children(n); i++) {
        const node *child = &children_of(n)[i];
        const octree_box computed = box_of_node(f, child);
        right = is_right_box(box_of_child(n, i), &computed, child) && are_child_boxes_right(f, child);
    }
    return right;
}

bool are_boxes_right(const level *l)
{
    const fitting f = make_fitting(l);
    return !has_boxes(&l->tree->store) || are_child_boxes_right(&f, &l->tree->root);
}
