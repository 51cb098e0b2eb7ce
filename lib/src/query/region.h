/* region.h - the way through the nodes that a region of space meets: a box or a ball. Private.
 *
 * What a region is, is told by three functions of its `shape`. The way is depth first; a shape keeps what it knows of
 * the cell at each depth, so that a child's cell is made from its parent's and nothing is worked out twice.
 */
#ifndef OCTREE_REGION_H
#define OCTREE_REGION_H

#include "meter.h"
#include "tree.h"

/* How a region lies to the octants of a cell: a bit an octant. */
typedef struct octant_masks {
    uint8_t meets;  /* some of it may lie there */
    uint8_t inside; /* all that lies there is in it */
} octant_masks;

/* Of the two halves of a cell on an axis: the octants in the lower one, and in the upper. */
static const uint8_t octants_beside[3][2] = {{0x0f, 0xf0}, {0x33, 0xcc}, {0x55, 0xaa}};

typedef struct region region;

struct region {
    const octree *tree;
    void *shape;
    /* The masks of a cell at a depth; it is the octant of the cell that was entered last at the depth above. */
    octant_masks (*enter)(void *shape, const octree *tree, unsigned depth, unsigned octant);
    /* Fill `hits` with the indices of those of the points that are in the region; 1 <= count <= REGION_SCAN. */
    unsigned (*scan)(const void *shape, const octree_point *points, unsigned count, uint8_t hits[]);
    octree_point_visitor visit; /* null: points are counted */
    void *context;
    size_t count;
    meter meter;
};

#define REGION_SCAN 64

/* Visit or count the points in a region. The masks tell of the root: its bit is the lowest. */
void region_descend(region *r, octant_masks root);

#endif
