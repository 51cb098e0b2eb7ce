/* SPDX-License-Identifier: MIT */
/* peer.h - one interface for every tree that the bench measures: the octree and its peers.
 *
 * Each function takes a whole array, so that the tree is timed and not the call. A null function is an operation that
 * the tree does not have. The peers in C++ end the program when memory runs out.
 *
 * To measure another index, write a file peer_NAME.cpp or peer_NAME.c that defines `const peer peer_NAME`; in C++, the
 * header declares it as extern "C". peer_nanoflann.cpp is a short example. Then configure with
 *     cmake -DOCTREEL_BENCH_PEERS="/path/peer_NAME.cpp" -DOCTREEL_BENCH_INCLUDES="/path/of/its/headers"
 * Both options are lists, separated by semicolons. The bench compares every answer with the octree's. */
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include "more_peers.h" /* BENCH_MORE_PEERS, which CMake writes */
#include "octree/octree.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct peer_query {
    double at[3];
    double size; /* half the side of a box, or a radius */
} peer_query;

/* What an answer is compared by. Neighbours are compared by distance: peers decide ties by rounded numbers. */
typedef struct peer_answer {
    size_t count;    /* points found */
    uint64_t ids;    /* their sum; 0 for neighbours */
    double distance; /* the sum of the neighbours' distances, else 0 */
} peer_answer;

enum { PEER_NEIGHBORS = 8, PEER_BATCH = 1000 };

typedef enum peer_change_kind { PEER_BUILD, PEER_INSERT, PEER_REMOVE, PEER_MOVE, PEER_CHANGES } peer_change_kind;

typedef enum peer_ask_kind {
    PEER_FIND,
    PEER_BOX,
    PEER_RADIUS,
    PEER_NEAREST,
    PEER_NEAREST_FAST,  /* decided by doubles alone */
    PEER_NEAREST_BATCH, /* PEER_BATCH targets a call */
    PEER_NEAREST_ALL,   /* all targets in one call */
    PEER_KNN,           /* the PEER_NEIGHBORS nearest */
    PEER_COLLIDE,
    PEER_MIXED, /* a place, the nearest point and a box, all three a query */
    PEER_ASKS
} peer_ask_kind;

/* Change the tree by `count` points; `to` is read by a move alone and has the same ids. The points of PEER_BUILD
 * outlive the tree. Returns how many of the changes were made. */
typedef size_t (*peer_change)(void *self, const octree_point *points, const octree_point *to, size_t count);

typedef void (*peer_ask)(const void *self, const peer_query *queries, size_t count, peer_answer *answers);

typedef struct peer {
    const char *name;
    void *(*create)(const octree_box *world); /* null: no memory */
    void (*destroy)(void *self);
    size_t (*memory)(const void *self); /* bytes, coordinates and ids included */
    double error; /* the greatest error of a distance, for trees that compute in floats; 0: errors of doubles */
    peer_change change[PEER_CHANGES];
    peer_ask ask[PEER_ASKS];
} peer;

extern const peer peer_octree;

/* An octree of this leaf capacity for peer_octree; null: no memory. */
void *make_octree(const octree_box *world, size_t capacity);

/* A uniform grid that is built anew: for the frames alone. */
extern const peer peer_grid;

extern const peer peer_nanoflann;
extern const peer peer_nanoflann_float;
extern const peer peer_boost_packed;
extern const peer peer_boost_quadratic;
extern const peer peer_boost_rstar;

/* The peers of OCTREEL_BENCH_PEERS. */
#define BENCH_DECLARE_PEER(name) extern const peer peer_##name;
BENCH_MORE_PEERS(BENCH_DECLARE_PEER)

#ifdef __cplusplus
}
#endif

#endif
