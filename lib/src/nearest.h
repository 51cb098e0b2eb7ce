/* nearest.h - one search for the k nearest points, its arguments checked. Private. */
#ifndef OCTREE_NEAREST_H
#define OCTREE_NEAREST_H

#include "tree.h"

/* A negative radius is none; k >= 1. Returns how many were found. */
size_t nearest_search(const octree *tree, const double target[3], size_t k, double radius, const octree_search *how,
                      octree_neighbor *neighbors);

/* The keys of the place of the world that is nearest to a target. */
void nearest_keys(const octree *tree, const double target[3], uint32_t keys[3]);

/* The codes of the cells beside that of this depth that a target is so close to that a search for k points is likely
 * to go there: for one, within a quarter of the cell. Returns their number. */
unsigned nearest_codes_beside(const uint32_t keys[3], unsigned depth, size_t k, uint64_t codes[3]);

#endif
