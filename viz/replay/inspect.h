/* inspect.h - a tree of a point cloud, and what there is to say about it. */
#ifndef RECORD_INSPECT_H
#define RECORD_INSPECT_H

#include "cloud.h"
#include "folder.h"
#include "octree/octree.h"

#include <stdio.h>

/* The smallest cube, about the points' middle, whose rounded faces contain every point. Its side is the largest extent,
 * but at least 4 ulp of the largest coordinate, and 1 where all points are equal. */
octree_box inspect_world(const cloud *c);

typedef struct inspection {
    octree *tree;   /* ids are the places in the cloud, from 0 */
    size_t points;  /* in the cloud */
    size_t skipped; /* in the file, without finite coordinates */
    size_t refused; /* by a full leaf, under OCTREE_REFUSE */
    size_t outside; /* of the world that was given */
} inspection;

/* Insert every point of a cloud into a new tree. */
bool inspect_build(const cloud *c, const octree_def *def, inspection *result, octreel_error *error);
void inspect_release(inspection *i);

/* The statistics, for people. */
void inspect_print(const inspection *i, const char *name, FILE *out);

/* The same as one JSON object on one line. */
void inspect_print_json(const inspection *i, const char *name, FILE *out);

/* The node at an address as it is typed, such as 0/3/7 or root. False, with a sentence, when there is none. */
bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error);

/* One node of the cloud `name`: its box and, for a leaf, its points; for people or as JSON. */
void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out);

/* All nodes as CSV: address, depth, leaf, count, min_x ... max_z. */
bool inspect_write_nodes(const inspection *i, const char *path, octreel_error *error);

#endif
