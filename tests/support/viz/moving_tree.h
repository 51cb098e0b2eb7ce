/* SPDX-License-Identifier: MIT */
/* moving_tree.h - a program with its own tree, for tests of the recorder: it inserts, moves, swaps and removes points,
 * and has queries and shapes at every tick. */
#ifndef MOVING_TREE_H
#define MOVING_TREE_H

#include "octreel/recorder.h"

#define MOVING_TREE_MOST 40

typedef struct moving_tree {
    octree *tree;
    uint64_t random;
    octree_point points[MOVING_TREE_MOST]; /* unsorted */
    size_t count;
    octree_query queries[OCTREE_QUERY_KINDS];
    octree_shape shapes[OCTREE_SHAPE_KINDS];
    octree_foreign_node nodes[3]; /* of a foreign index: a root and two leaves */
    uint64_t listed[MOVING_TREE_MOST], met[3];
    octree_foreign_tree foreign;
    octree_pair found[2]; /* the pairs of a foreign index: the first three points, which rarely overlap */
    octree_foreign_pairs pairs;
    octreel_tick_info about;
} moving_tree;

/* Make a tree in [-8, 8]^3 with few points per leaf and few levels, so that leaves are often full. The same seed makes
 * the same tree. The structure must not be moved. */
void moving_tree_make(moving_tree *m, octree_full_leaf full_leaf, uint64_t seed);
void moving_tree_release(moving_tree *m);

/* Insert, remove, move and swap some points. */
void moving_tree_step(moving_tree *m);

/* A recorder of small frames for the tree. */
octreel_recorder_def small_recorder(const moving_tree *m, const char *folder);

/* Record a tick; the test fails with the error if the recorder refuses it. */
void assert_recorded(octreel_recorder *recorder, const moving_tree *m);

/* The edits since the last moving_edits_make(), on purpose more than necessary. A zeroed structure has no points. */
typedef struct moving_edits {
    octree_point before[MOVING_TREE_MOST];
    size_t before_count;
    octree_edit edits[4 * MOVING_TREE_MOST];
    size_t count;
} moving_edits;

void moving_edits_make(moving_edits *e, const moving_tree *m);

/* How a program hands its points to the recorder: its octree, a list, or changes. */
typedef enum moving_tree_source { MOVING_TREE, MOVING_LIST, MOVING_CHANGES } moving_tree_source;

/* Record a tick by handing over the tree, a list of its points, or the edits. */
octreel_status record_tick_from(octreel_recorder *recorder, const moving_tree *m, moving_tree_source source,
                                moving_edits *e);

/* Step and record this number of times. */
void record_steps(octreel_recorder *recorder, moving_tree *m, int ticks);

/* Open a recorder; the test fails with the error if that fails. */
octreel_recorder *open_recorder(const octreel_recorder_def *def);

/* Open a recorder of ticks without frames, with a ring of this size, in the world [-8, 8]^3. */
octreel_recorder *open_recorder_without_frames(const char *folder, size_t ring);

/* Close and destroy a recorder; the test fails with the error if that fails. */
void close_recorder(octreel_recorder *recorder);

#endif
