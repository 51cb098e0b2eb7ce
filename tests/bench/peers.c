/* SPDX-License-Identifier: MIT */
/* peers.c - the trees of this build. */
#include "peers.h"

const peer *const all_peers[] = {
    &peer_octree,
#ifdef BENCH_NANOFLANN
    &peer_nanoflann,
#endif
#ifdef BENCH_BOOST
    &peer_boost_packed,
    &peer_boost_quadratic,
    &peer_boost_rstar,
#endif
    0,
};
