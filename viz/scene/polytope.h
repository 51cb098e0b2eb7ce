/* SPDX-License-Identifier: MIT */
/* polytope.h - the edges of a convex region that half-spaces cut out of a box. */
#ifndef SCENE_POLYTOPE_H
#define SCENE_POLYTOPE_H

#include "octree/query.h"

enum { POLYTOPE_PLANES = 6 + OCTREE_FRUSTUM_HALF_SPACES, POLYTOPE_EDGES = POLYTOPE_PLANES * (POLYTOPE_PLANES - 1) / 2 };

/* An edge, which lies in two planes: 0 to 5 are the faces of the box, and 6 + i is the half-space i. */
typedef struct polytope_edge {
    double ends[2][3];
    unsigned planes[2];
} polytope_edge;

/* Find the edges of the region that is in a box and in all half-spaces of a frustum, without the edges of the box.
 * Returns their number. The positions are rounded, to about 1e-12 of the box. */
size_t polytope_find_edges(const octree_box *box, const octree_frustum *frustum, polytope_edge edges[POLYTOPE_EDGES]);

#endif
