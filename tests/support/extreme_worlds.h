/* SPDX-License-Identifier: MIT */
/* extreme_worlds.h - worlds at the edges of doubles, and the boxes of cells in them. */
#ifndef EXTREME_WORLDS_H
#define EXTREME_WORLDS_H

#include "fixture.h"

#include <float.h>
#include <math.h>

/* The bounds of each world, the same on every axis: simple worlds, worlds at the limits of doubles, and worlds whose
 * splitting planes must be rounded. */
static const double world_axes[][2] = {
    {-1000, 1000},      {0, 1},           {-DBL_MAX, DBL_MAX},  {-1e200, 1e200},   {5e-324, 1e-310},
    {1e15, 1e15 + 1},   {0.1, 0.3},       {-0.1, 1e15},         {-5e-324, 5e-324}, {0, 5e-324},
    {-DBL_MAX, -1e308}, {1e308, DBL_MAX}, {-1, 1e-300},         {1, 1 + 0x1p-52},  {-0x1p-1022, 0x1p-1021},
    {-DBL_MAX, 5e-324}, {-1.0 / 3, 1e5},  {0x1p-1074, DBL_MAX}, {-3, 7},           {0.1, 0x1.999999999999cp-4},
    {-0.1, 0.1},        {-1, 0x1p53},     {-1e-308, 1e-308},    {0, 0x1p-1023},    {-7e-310, 3e-308},
};
enum { world_count = sizeof world_axes / sizeof world_axes[0] };

static inline octree_box world_of(size_t row)
{
    return cube(world_axes[row][0], world_axes[row][1]);
}

/* The address of the cell with these integer coordinates at a depth. */
static inline octree_address address_of(uint32_t x, uint32_t y, uint32_t z, unsigned depth)
{
    octree_address address = OCTREE_ROOT;
    for (unsigned level = depth; level-- > 0;)
        address = address << 3 | (x >> level & 1) << 2 | (y >> level & 1) << 1 | (z >> level & 1);
    return address;
}

/* The box of the cell with the integer coordinates (k, k, k) at a depth, in a world of world_axes. */
static inline octree_box cell(size_t row, uint32_t k, unsigned depth)
{
    octree_box world = world_of(row);
    return octree_cell_box(&world, address_of(k, k, k, depth));
}

#endif
