/* SPDX-License-Identifier: MIT */
/* body_scenes.h - random bodies and regions for tests, at every scale of doubles. */
#ifndef BODY_SCENES_H
#define BODY_SCENES_H

#include "octree/bodies.h"

/* How the numbers of a scene are drawn. */
typedef enum scene_numbers {
    NUMBERS_LATTICE, /* multiples of 1/2, so that faces, corners and distances coincide */
    NUMBERS_SMOOTH,  /* all doubles of a range */
    NUMBERS_FAR,     /* near 1e15, where few doubles are left */
    NUMBERS_TINY,    /* subnormal numbers */
    NUMBERS_HUGE,    /* up to DBL_MAX */
    NUMBERS_EXTREME, /* critical numbers of all scales in one scene */
    NUMBERS_KINDS
} scene_numbers;

/* The world of a scene. */
octree_box scene_world(scene_numbers numbers);

/* A random body of the world; about a fifth have a zero extent, and some are as large as the world. */
octree_body random_body(scene_numbers numbers, uint64_t *seed, uint64_t id);

/* A random region. The half-spaces are stored in `half_spaces`, which has room for OCTREE_MAX_HALF_SPACES. */
octree_region random_region(scene_numbers numbers, octree_region_kind kind, uint64_t *seed,
                            octree_half_space *half_spaces);

/* A random position for a target, inside or outside of the world. */
void random_target(scene_numbers numbers, uint64_t *seed, double target[3]);

/* An octree_pair_visitor that adds a pair to a uint64_t, which depends on the order of the pairs. */
bool add_pair_to_order(const octree_body *a, const octree_body *b, void *order);

#endif
