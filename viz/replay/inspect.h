/* SPDX-License-Identifier: MIT */
/* inspect.h - builds the tree of a point cloud and prints its statistics and nodes. */
#ifndef REPLAY_INSPECT_H
#define REPLAY_INSPECT_H

#include "cloud.h"
#include "json_write.h"
#include "octree/types.h"
#include "watcher.h"

#include <stdio.h>

typedef struct inspection {
    octree *tree;            /* a point's id is its row in the cloud */
    size_t points;           /* points of the cloud: points of the file without the skipped ones */
    size_t skipped;          /* points of the file that are not in the cloud */
    const char *why_skipped; /* the reason, as in cloud.h */
    size_t refused;          /* points refused by a full leaf, under OCTREE_REFUSE */
    size_t outside;          /* points outside the world */
    point_values values;     /* colours, intensities and classes, indexed by point id */
    size_t *classes;         /* number of points of each possible class, or null if no point has a class */
    unsigned color_full;     /* as in cloud.h */
    const char *column_note;
    size_t out_of_range[POINT_VALUE_KINDS];
} inspection;

/* Insert every point of a cloud into a new tree. Moves the cloud's values into the result and frees its positions.
 * `watch` may be null; its progress() is called after each portion with the number of inserted points. Cost: O(count).
 * Memory in addition to the positions and the tree: about 12 bytes per point, and 40 under OCTREE_REFUSE. */
bool inspect_build(cloud *c, const octree_def *def, const watcher *watch, inspection *result, octreel_error *error);
void inspect_release(inspection *i);

/* Print the statistics as text, or as one JSON object on one line. `name` is the name of the cloud in the output. */
void inspect_print(const inspection *i, const char *name, bool json, FILE *out);

/* Find the node at a typed address such as 0/3/7 or root. False, with an error, if there is none. */
bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error);

/* Print one node: its box and, for a leaf, its points. Text lists only the first LIST_LINES points. */
void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out);

/* Print the cloud's name on a line; numbers, each after a space; a point on a line; a point as a JSON object.
 * `distance` may be null. */
void inspect_print_name(const char *name, FILE *out);
void inspect_print_numbers(const double *values, size_t count, FILE *out);
void inspect_print_point(const octree_point *point, const double *distance, FILE *out);
void inspect_write_point(json_writer *w, const octree_point *point, const double *distance);

/* Count the points of each class. False: out of memory. */
bool inspect_count_classes(inspection *i);

/* Print which colours, intensities and classes the points have, as text or as a JSON member. Nothing if they have none.
 */
void inspect_print_values(const inspection *i, FILE *out);
void inspect_write_values(const inspection *i, json_writer *w);

/* Write all nodes as CSV: address, depth, leaf, count, min_x ... max_z. */
bool inspect_write_nodes(const inspection *i, const char *path, octreel_error *error);

#endif
