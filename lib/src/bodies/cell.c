/* SPDX-License-Identifier: MIT */
/* cell.c - the boxes of nodes that store none: those of level 0, and of sets that show the points of a tree.
 *
 * A search makes them while it descends: the cell of a node, extended by the reach of the level, contains all of the
 * node's bodies. So all searches know boxes only.
 */
#include "cell.h"
#include "boxes.h"

/* The reach covers the rounding of a face that is extended by it: at most 2^-53 of the sum of both. A reach of 0 is
 * exact. */
void divide_root_cell(const level *l, divided_cell *root)
{
    root->cell = root_cell();
    for (int k = 0; k < 3; k++) {
        const axis *a = &l->tree->axes[k];
        const double error = (find_farthest(l, k, 0) + l->reach[k]) * 0x1p-50 + 0x1p-1070;
        root->planes[k][0] = a->min;
        root->planes[k][1] = plane_at(a, PLANE_GRID / 2);
        root->planes[k][2] = a->max;
        root->reach[k] = l->reach[k] > 0 ? l->reach[k] + error : 0;
    }
}

void divide_child(const level *l, const node *n, const divided_cell *parent, unsigned index, divided_cell *child)
{
    const unsigned octant = bits_lowest(spread_mask(n, 1u << index));
    child->cell = cell_child(parent->cell, octant);
    for (int k = 0; k < 3; k++) {
        const unsigned upper = octant >> (2 - k) & 1;
        child->planes[k][0] = parent->planes[k][upper];
        child->planes[k][1] = plane_at(&l->tree->axes[k], child->cell.low[k] + cell_size(child->cell.depth) / 2);
        child->planes[k][2] = parent->planes[k][upper + 1];
        child->reach[k] = parent->reach[k];
    }
}

octree_box box_of_cell(const divided_cell *c)
{
    octree_box box;
    for (int k = 0; k < 3; k++) {
        box.min[k] = c->planes[k][0] - c->reach[k];
        box.max[k] = c->planes[k][2] + c->reach[k];
    }
    return box;
}

void make_boxes_of_children(const node *n, const divided_cell *c, octree_box boxes[8])
{
    double min[3][2], max[3][2];
    for (int k = 0; k < 3; k++)
        for (int upper = 0; upper < 2; upper++) {
            min[k][upper] = c->planes[k][upper] - c->reach[k];
            max[k][upper] = c->planes[k][upper + 1] + c->reach[k];
        }
    for (unsigned left = n->octants; left; left &= left - 1, boxes++)
        for (int k = 0; k < 3; k++) {
            const unsigned upper = bits_lowest(left) >> (2 - k) & 1;
            boxes->min[k] = min[k][upper];
            boxes->max[k] = max[k][upper];
        }
}
