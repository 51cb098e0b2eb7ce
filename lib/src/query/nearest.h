/* nearest.h - one search for the k nearest points, its arguments checked. Private. */
#ifndef OCTREE_NEAREST_H
#define OCTREE_NEAREST_H

#include "tree.h"

/* A negative radius is none; k >= 1. Returns how many were found. */
size_t nearest_search(const octree *tree, const double target[3], size_t k, double radius, const octree_search *how,
                      octree_neighbor *neighbors);

/* The keys of the place of the world that is nearest to a target. */
void nearest_keys(const octree *tree, const double target[3], uint32_t keys[3]);

#endif
