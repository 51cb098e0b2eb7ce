/* SPDX-License-Identifier: MIT */
/* cell.h - boxes around the bodies of the eight octants of a cell. Private. */
#ifndef OCTREE_BODY_CELL_H
#define OCTREE_BODY_CELL_H

#include "set.h"

/* A cell, and on each axis its lower and its upper half (index 0 and 1). The octant with the number o has the half
 * `o >> (2 - i) & 1` on axis i. All half extents are rounded up. They are infinite in worlds near the range of doubles,
 * where nothing can be excluded. */
typedef struct cell_halves {
    double low[3], middle[3], high[3]; /* the cell's faces, and the planes that divide it */
    double center[3][2];
    double inner[3][2]; /* center +- inner contains the positions of the half */
    double outer[3][2]; /* center +- outer contains the boxes of all bodies of the half */
} cell_halves;

/* Compute the halves of the root cell of a level, and of an octant of a cell whose halves are known. `c` is the cell
 * that is divided. */
void divide_root_cell(const level *l, cell_halves *h);
void divide_octant(const level *l, const cell_halves *parent, unsigned octant, cell c, cell_halves *h);

/* Returns the half of an octant on an axis. */
static inline unsigned half_of_octant(unsigned octant, int axis)
{
    return octant >> (2 - axis) & 1;
}

#endif
