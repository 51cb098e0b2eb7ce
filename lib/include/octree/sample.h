/* SPDX-License-Identifier: MIT */
/* sample.h - seeded point distributions for sessions, tests and benchmarks.
 *
 * The same kind, seed, box and index give the same point on every machine: only integers, additions, products and
 * square roots are used.
 */
#ifndef OCTREE_SAMPLE_H
#define OCTREE_SAMPLE_H

#include "octree/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum octree_sample_kind {
    OCTREE_SAMPLE_UNIFORM, /* points that are independent of one another, uniform in the box */
    /* points around the centre of the box. Each coordinate is a sum of twelve uniform random numbers, with a sigma of a
     * sixth of the box's extent */
    OCTREE_SAMPLE_GAUSSIAN,
    /* sixteen small gaussian clusters of different sizes; the centres of the clusters are uniform in the box */
    OCTREE_SAMPLE_CLUSTERED,
    OCTREE_SAMPLE_SURFACE, /* points on the surface of an ellipsoid whose axes are nine tenths of the box */
    OCTREE_SAMPLE_LATTICE, /* the cell centres of a cubic grid; x varies slowest, and the seed is ignored */
    OCTREE_SAMPLE_KINDS
} octree_sample_kind;

/* Returns the name of a kind of distribution, such as "uniform" or "gaussian". Returns null for an unknown kind. */
const char *octree_sample_name(octree_sample_kind kind);

/* Store in *kind the kind of distribution that has this name. Returns false if no kind has the name. */
bool octree_sample_parse(const char *name, octree_sample_kind *kind);

/* Write `count` positions within `box` to `positions`. Each position is a row of three doubles. Errors: NULL_ARGUMENT,
 * BAD_WORLD and BAD_BUILD (as for octree_create), BAD_OPTION. Cost: O(count). */
octree_status octree_sample(octree_sample_kind kind, uint64_t seed, const octree_box *box, size_t count,
                            double (*positions)[3]);

/* Advance the state of a random generator, and return the next 64 random bits, by splitmix64 (Steele, Lea and Flood
 * 2014). */
uint64_t octree_random(uint64_t *state);

/* Advance the state of a random generator, and return the next uniform double in [0, 1), made from 53 random bits. */
double octree_random_unit(uint64_t *state);

#ifdef __cplusplus
}
#endif

#endif
