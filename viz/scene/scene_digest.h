/* SPDX-License-Identifier: MIT */
/* scene_digest.h - what the digest of a scene is made of, for those who know a part of it. */
#ifndef SCENE_SCENE_DIGEST_H
#define SCENE_SCENE_DIGEST_H

#include "layer.h"
#include "scene.h"

/* Layers and roles enter a digest as hashes of their names, so that adding one does not change the digests of scenes
 * without it. */
typedef struct digest_names {
    uint64_t layers[LAYER_ALL], roles[ROLE_OWN + 1];
} digest_names;

digest_names digest_names_make(void);

uint64_t digest_box(const digest_names *n, const scene_box *box);
uint64_t digest_marker(const digest_names *n, const scene_marker *marker);

/* The digests of the elements of an array are the coefficients of a polynomial, the last one's of power 0, so that
 * their order counts. */
#define DIGEST_BASE UINT64_C(0x9e3779b97f4a7c15)

/* The elements [first, end) of an array, whose polynomial is known. */
typedef struct digest_run {
    size_t first, end;
    uint64_t sum, power; /* DIGEST_BASE to the power of their number */
} digest_run;

typedef struct digest_runs {
    digest_run *items;
    size_t count, room;
} digest_runs;

#endif
