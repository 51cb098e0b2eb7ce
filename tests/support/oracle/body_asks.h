/* SPDX-License-Identifier: MIT */
/* body_asks.h - random queries of a set of bodies against rational numbers. A test fails if an answer is wrong. */
#ifndef BODY_ASKS_H
#define BODY_ASKS_H

#include "body_scenes.h"

/* A set of at most 400 bodies, and the same bodies as a list. */
typedef struct body_scene {
    scene_numbers numbers;
    uint64_t seed;
    octree_body *bodies;
    size_t count;
    octree_bodies *set;
} body_scene;

/* Search `count` regions of each kind. */
void body_scene_assert_regions(body_scene *s, int count);

/* Find the nearest bodies to a target, and the first bodies on a way: a region of kind RAY or SWEPT. */
void body_scene_assert_nearest(body_scene *s);
void body_scene_assert_cast(body_scene *s, octree_region_kind kind);

/* Find all pairs within a set, and between two sets. */
void body_scene_assert_pairs(const body_scene *s);
void body_scene_assert_pairs_between(const body_scene *s, const body_scene *other);

#endif
