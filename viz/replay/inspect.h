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
    size_t points;           /* number of points in the cloud: all points of the file except the skipped ones */
    size_t skipped;          /* number of points in the file that are not in the cloud */
    const char *why_skipped; /* the reason why points were skipped; a constant string of the cloud reader (cloud.h) */
    size_t refused;          /* number of points that a full leaf refused, under OCTREE_REFUSE */
    size_t outside;          /* number of points that were not inserted because they are outside the world */
    point_values values;     /* colours, intensities and classes, indexed by point id */
    size_t *classes;         /* classes[c]: number of points with class c; null if no point has a class */
    unsigned color_full;     /* the largest value of a colour channel: 1, 255 or 65535; 0 if no point has a colour */
    char column_note[CLOUD_COLUMN_NOTE]; /* copies of the members of the cloud (cloud.h) */
    size_t out_of_range[POINT_VALUE_KINDS];
} inspection;

/* Insert every point of a cloud into a new tree. The values of the cloud are moved into the result, and the positions
 * of the cloud are freed. `watch` may be null. progress() of the watcher is called after each portion of points with
 * the number of points inserted so far. Cost: O(count). Memory in addition to the positions and the tree: about 12
 * bytes per point, or 40 bytes under OCTREE_REFUSE. */
bool inspect_build(cloud *c, const octree_def *def, const watcher *watch, inspection *result, octreel_error *error);
void inspect_release(inspection *i);

/* Print the statistics as text, or as one JSON object on one line. `name` is printed as the name of the cloud. */
void inspect_print(const inspection *i, const char *name, bool json, FILE *out);

/* Find the node at an address that the user typed, such as 0/3/7 or root. Returns false with an error if the tree has
 * no such node. */
bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error);

/* Print one node: its box and, if it is a leaf, its points. The text form lists only the first LIST_LINES points. */
void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out);

/* Functions that print one item each. inspect_print_name() prints the name of the cloud on a separate line.
 * inspect_print_numbers() prints numbers with a space before each. The last two functions print a point, on a line or
 * as a JSON object. `name` is the word before the distance, or its key; `distance` may be null. */
void inspect_print_name(const char *name, FILE *out);
void inspect_print_numbers(const double *values, size_t count, FILE *out);
void inspect_print_point(const octree_point *point, const char *name, const double *distance, FILE *out);
void inspect_write_point(json_writer *w, const octree_point *point, const char *name, const double *distance);

/* Count the points of each class into i->classes. Returns false if memory runs out. */
bool inspect_count_classes(inspection *i);

/* Print how many points have colours, intensities and classes, as text or as a JSON member. Print nothing if no point
 * has such a value. */
void inspect_print_values(const inspection *i, FILE *out);
void inspect_write_values(const inspection *i, json_writer *w);

/* Write all nodes to a CSV file with the columns address, depth, leaf, count, min_x ... max_z. */
bool inspect_write_nodes(const inspection *i, const char *path, octreel_error *error);

#endif
