/* SPDX-License-Identifier: MIT */
/* body_model.h - a list of bodies as the oracle of a set of bodies, and random changes of both. */
#ifndef BODY_MODEL_H
#define BODY_MODEL_H

#include "body_scenes.h"

enum { BODY_MODEL_ROOM = 400 };

typedef struct body_model {
    octree_body bodies[BODY_MODEL_ROOM];
    size_t count;
} body_model;

/* Make the same random change of the set and of the list, of one body or of many. The statuses must be those that the
 * list gives. */
void body_model_change_one(octree_bodies *set, body_model *m, scene_numbers numbers, uint64_t *seed);
void body_model_change_many(octree_bodies *set, body_model *m, scene_numbers numbers, uint64_t *seed);

/* Assert that the set is valid and holds the bodies of the list. */
void body_model_assert_same(const octree_bodies *set, const body_model *m);

/* Compact the set. It must then have the nodes of a set that is built from its bodies at once. */
void body_model_compact(octree_bodies *set, const body_model *m);

#endif
