/* SPDX-License-Identifier: MIT */
/* inspect.h - the tree of a point cloud, its statistics and its nodes. */
#ifndef REPLAY_INSPECT_H
#define REPLAY_INSPECT_H

#include "cloud.h"
#include "json_write.h"
#include "octree/types.h"

#include <stdio.h>

typedef struct inspection {
    octree *tree;            /* a point's id is its row of the cloud */
    size_t points;           /* of the cloud: of the file but those skipped */
    size_t skipped;          /* points of the file that are left out */
    const char *why_skipped; /* what they are, as in cloud.h */
    size_t refused;          /* points refused by a full leaf, under OCTREE_REFUSE */
    size_t outside;          /* points outside the world */
    point_values values;     /* of the cloud, by the ids of the tree */
    size_t *classes;         /* points of each class that there can be; null: none has one */
    unsigned color_full;     /* as in cloud.h */
    const char *column_note;
    size_t out_of_range[POINT_VALUE_KINDS];
} inspection;

/* Insert every point of a cloud into a new tree, and take over the cloud's values; its positions are freed. `progress`,
 * which may be null, is told after each portion how many of all points were inserted. Cost: O(count); on top of the
 * positions and the tree some 12 bytes a point while it runs, and 40 under OCTREE_REFUSE. */
typedef void inspect_progress(uint64_t done, uint64_t total, void *context);
bool inspect_build(cloud *c, const octree_def *def, inspect_progress *progress, void *context, inspection *result,
                   octreel_error *error);
void inspect_release(inspection *i);

/* Print the statistics: for people, or as one JSON object on one line. `name` is what the cloud is called there. */
void inspect_print(const inspection *i, const char *name, bool json, FILE *out);

/* Find the node at an address as it is typed, such as 0/3/7 or root. False with an error where there is none. */
bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error);

/* Print one node: its box and, of a leaf, its points, for people the first LIST_LINES. */
void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out);

/* Print the cloud's name on a line; numbers, each after a space; a point on a line; and a point as an object. The
 * distance may be null. */
void inspect_print_name(const char *name, FILE *out);
void inspect_print_numbers(const double *values, size_t count, FILE *out);
void inspect_print_point(const octree_point *point, const double *distance, FILE *out);
void inspect_write_point(json_writer *w, const octree_point *point, const double *distance);

/* Count the points of each class. False when there is no memory. */
bool inspect_count_classes(inspection *i);

/* What the points have beside their positions: a line or two; and as a member of an object. Nothing where they have
 * nothing. */
void inspect_print_values(const inspection *i, FILE *out);
void inspect_write_values(const inspection *i, json_writer *w);

/* Write all nodes as CSV: address, depth, leaf, count, min_x ... max_z. */
bool inspect_write_nodes(const inspection *i, const char *path, octreel_error *error);

#endif
