/* SPDX-License-Identifier: MIT */
/* peers.c - the trees of this build. */
#include "peers.h"

const peer *const all_peers[] = {
    &peer_octree,
#ifdef BENCH_NANOFLANN
    &peer_nanoflann,
    &peer_nanoflann_float,
#endif
#ifdef BENCH_BOOST
    &peer_boost_packed,
    &peer_boost_quadratic,
    &peer_boost_rstar,
#endif
#define BENCH_PEER(name) &peer_##name,
    BENCH_MORE_PEERS(BENCH_PEER) 0,
};
