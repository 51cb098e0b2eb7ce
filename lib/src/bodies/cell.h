/* SPDX-License-Identifier: MIT */
/* cell.h - the boxes of nodes that store none. Private. */
#ifndef OCTREE_BODY_CELL_H
#define OCTREE_BODY_CELL_H

#include "set.h"

/* The cell of an inner node. */
typedef struct divided_cell {
    cell cell;
    double planes[3][3]; /* on each axis: the lower face, the plane that divides the cell, and the upper face */
    double reach[3];     /* the level's reach, and more than all rounding errors */
} divided_cell;

void divide_root_cell(const level *l, divided_cell *root);

/* Divide the cell of a child of a node, given by its index, whose own cell is `parent`. */
void divide_child(const level *l, const node *n, const divided_cell *parent, unsigned index, divided_cell *child);

/* Returns a box around all bodies of a cell. */
octree_box box_of_cell(const divided_cell *c);

/* Make boxes around all bodies of the children of a node: their cells, extended by the reach. */
void make_boxes_of_children(const node *n, const divided_cell *c, octree_box boxes[8]);

#endif
