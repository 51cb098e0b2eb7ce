/* SPDX-License-Identifier: MIT */
/* motion.h - where a body is at a tick. Private. */
#ifndef OCTREE_MOTION_H
#define OCTREE_MOTION_H

#include "game_bodies.h"

static inline bool is_moving(const double velocity[3])
{
    return velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
}

static inline bool has_extent(const double half[3])
{
    return half[0] > 0 || half[1] > 0 || half[2] > 0;
}

/* Record that the tree stores a body at a new position from this tick on. */
void store_body_position(moving_body *body, const double to[3], uint64_t tick);

/* Compute the position and velocity of a body at a tick. */
octree_game_body body_at_tick(const moving_body *body, const octree_box *world, uint64_t tick);

/* Restart the motion of a body at the position `place`. The body keeps the velocity that it has at this tick. */
void restart_motion(moving_body *body, const octree_box *world, const double place[3], uint64_t tick);

#endif
