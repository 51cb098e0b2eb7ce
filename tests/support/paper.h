/* SPDX-License-Identifier: MIT */
/* paper.h - Algorithms 1 to 7 of "3D Spatial Partitioning and Collision Detection using Octrees", as printed.
 *
 * The code is recursive, has eight child pointers for each node, and uses the paper's names. Printing is left out. Each
 * point also has an id, so that a test can identify the point; as in the paper, no algorithm compares ids. */
#ifndef PAPER_H
#define PAPER_H

#include "brute.h"

/* The largest MAX_POINTS that a tree can be given. */
#define PAPER_POINTS 8

typedef struct paper_node {
    octree_box bounds;
    octree_point points[PAPER_POINTS];
    size_t count;
    size_t depth;
    bool leaf;
    struct paper_node *children[8];
} paper_node;

typedef struct paper_octree {
    paper_node *root;
    size_t max_points; /* MAX_POINTS */
    size_t max_depth;  /* MAX_DEPTH */
} paper_octree;

paper_octree createOctree(octree_box world, size_t max_points, size_t max_depth);
void freeOctree(paper_octree *octree);

/* Algorithm 1. */
bool insertPoint(const paper_octree *octree, paper_node *node, const octree_point *point);

/* Algorithm 2. True when a point was deleted. */
bool deletePoint(const paper_octree *octree, paper_node *node, const octree_point *point);

/* Algorithm 3. The leaf that holds a point with these coordinates, or null. */
const paper_node *searchPoint(const paper_node *node, const octree_point *point);

/* Algorithm 4. Adds the points to `fp`, and their number to *count. */
void rangeQuery(const paper_node *node, const double min[3], const double max[3], size_t *count, brute *fp);

/* Algorithm 5. */
bool detect_collision(const paper_octree *octree, const octree_point *moving_point, double box_size);

/* Algorithm 6. */
bool findNearestNeighbor(const paper_octree *octree, const double target[3], octree_point *nearest, double *minDist);

#endif
