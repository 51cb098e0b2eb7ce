/* SPDX-License-Identifier: MIT */
/* body_peer.h - one interface for every index of boxes that octree-bodies-bench measures.
 *
 * Each function takes a whole array, so that the index is timed and not the call. A null function is an operation that
 * the index does not have. To measure another index, write a file body_peer_NAME.cpp that defines `const body_peer
 * body_peer_NAME`, and configure with
 *     cmake -DOCTREEL_BENCH_BODY_PEERS="/path/body_peer_NAME.cpp" -DOCTREEL_BENCH_INCLUDES="/path/of/its/headers"
 * body_peer_boost.cpp is a short example. The bench compares every answer with the octree's. */
#ifndef BENCH_BODY_PEER_H
#define BENCH_BODY_PEER_H

#include "more_body_peers.h" /* BENCH_MORE_BODY_PEERS, which CMake writes */
#include "octree/bodies.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The answer to a query, or the sum of all answers: the number of bodies and the sum of their ids; of the first hit and
 * of the nearest body only octree_hit.at, because indexes decide ties by rounded numbers. */
typedef struct body_answer {
    size_t count;
    uint64_t ids;
    double at;
} body_answer;

typedef enum body_change { BODY_BUILD, BODY_INSERT, BODY_REMOVE, BODY_MOVE, BODY_MOVE_ALL, BODY_CHANGES } body_change;
typedef enum body_ask { BODY_BOX, BODY_BALL, BODY_FRUSTUM, BODY_RAY, BODY_NEAREST, BODY_PAIRS, BODY_ASKS } body_ask;

typedef struct body_peer {
    const char *name;
    void *(*create)(const octree_box *world); /* null: no memory */
    void (*destroy)(void *self);
    size_t (*memory)(const void *self); /* bytes, boxes and ids included; null: unknown */
    double error;                       /* the greatest relative error of `at`, for indexes of floats */
    /* Change the index; `to` is read by moves only. BODY_BUILD and BODY_MOVE_ALL may use bulk functions. */
    void (*change[BODY_CHANGES])(void *self, const octree_body *bodies, const octree_body *to, size_t count);
    /* Answer queries. The regions of BODY_NEAREST are balls whose centres are the targets. BODY_PAIRS reads no region,
     * and has one answer: the number of pairs, and the sum of both ids of each. */
    void (*ask[BODY_ASKS])(const void *self, const octree_region *regions, size_t count, body_answer *answers);
} body_peer;

extern const body_peer body_peer_octree;
extern const body_peer body_peer_points; /* a tree of the bodies' positions: what a change of a point costs */
extern const body_peer body_peer_boost;
extern const body_peer body_peer_embree;

#define BENCH_DECLARE_BODY_PEER(name) extern const body_peer body_peer_##name;
BENCH_MORE_BODY_PEERS(BENCH_DECLARE_BODY_PEER)

#ifdef __cplusplus
}
#endif

#endif
