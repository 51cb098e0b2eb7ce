/* SPDX-License-Identifier: MIT */
/* scene_digest.h - the parts of a scene's digest, for code that caches some of them.
 *
 * Two scenes have the same digest if they have the same picture size, camera and bitmap fonts, and the same elements in
 * the same order. Each element is hashed separately. The hashes h1 ... hn of an array are combined as a polynomial in B
 * = DIGEST_BASE modulo 2^64: h1 B^(n-1) + h2 B^(n-2) + ... + hn. So the order of elements matters.
 *
 * A chained hash would need every element again for each tick. A polynomial can be continued with a run of `count`
 * elements whose own polynomial `sum` is known: digest = digest * B^count + sum. kept_tree.h keeps such runs for
 * unchanged subtrees, so that a digest costs O(changed elements + runs). */
#ifndef SCENE_SCENE_DIGEST_H
#define SCENE_SCENE_DIGEST_H

#include "array.h"
#include "layer.h"
#include "scene.h"

/* Hashes of the names of layers and roles. Digests use names instead of numbers, so that adding a layer or role does
 * not change the digests of scenes that do not use it. */
typedef struct digest_names {
    uint64_t layers[LAYER_ALL], roles[ROLE_OWN + 1];
} digest_names;

digest_names make_digest_names(void);

uint64_t digest_box(const digest_names *n, const scene_box *box);
uint64_t digest_marker(const digest_names *n, const scene_marker *marker);

#define DIGEST_BASE UINT64_C(0x9e3779b97f4a7c15)

/* A run of elements of an array, from index `first` to before index `end`, with the polynomial of the elements'
 * hashes. */
typedef struct digest_run {
    size_t first, end;
    /* sum: the polynomial of the hashes; power: DIGEST_BASE to the power of the number of elements */
    uint64_t sum, power;
} digest_run;

typedef ARRAY(digest_run) digest_runs;

#endif
