/* SPDX-License-Identifier: MIT */
/* workload.h - the scenes that knobs are measured on: points, targets, and the true neighbours of each target. */
#ifndef TRADEOFF_WORKLOAD_H
#define TRADEOFF_WORKLOAD_H

#include "cloud.h"
#include "octree/game.h"
#include "octree/sample.h"

enum { TRUE_NEIGHBORS = 8 };

typedef const octree_point *true_neighbors[TRUE_NEIGHBORS];

typedef struct workload {
    const char *name;
    octree_box world;
    octree_point *points; /* ids are places */
    size_t count;
    double (*targets)[3];
    size_t target_count;
    true_neighbors *truth; /* of each target, by a scan of all points; null until it is asked for */
    bool ordinary;         /* as people have it: what headlines speak of */
} workload;

/* The workloads of a run. */
enum { WORKLOADS_AT_MOST = 16 };

typedef struct workloads {
    workload of[WORKLOADS_AT_MOST];
    size_t count;
} workloads;

/* Every scene: at most `points` points and `targets` targets each. The session is played to its end: its points then,
 * and the places where the player and the points were before; null: one of moving clusters. `read`, a
 * cloud that was read from a file, may be null. */
void workloads_make(workloads *all, size_t points, size_t targets, const octree_session *session, const cloud *read);
void workloads_free(workloads *all);

/* Points of a distribution in a world, and targets of the same one. Free it with workload_free. */
workload workload_sample(const char *name, octree_sample_kind kind, octree_box world, size_t points, size_t targets);
void workload_free(workload *w);

/* The truth, found when it is first asked for: long doubles with a proven bound, whole numbers where those cannot tell.
 */
const true_neighbors *workload_truth(workload *w);

/* A tree of the points, under OCTREE_GROW. */
octree *workload_tree(const workload *w, size_t capacity, size_t depth);

#endif
