/* SPDX-License-Identifier: MIT */
/* peers.h - the trees of this build. */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "peer.h"

/* Ends with null; the octree is first. */
extern const peer *const all_peers[];

#endif
