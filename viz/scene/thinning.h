/* thinning.h - which of too many points are left out: by the id alone, so that a point that moves does not come and go,
 * and so that its velocity is left out with it. Private.
 */
#ifndef SCENE_THINNING_H
#define SCENE_THINNING_H

#include "octree/digest.h"

#include <stdbool.h>
#include <stdint.h>

/* A sieve with n of its lowest bits set leaves about one id in 2^n, of which a finer one leaves a part. */
static inline bool thinning_drops(uint64_t sieve, uint64_t id)
{
    return octree_digest_word(OCTREE_DIGEST_START, id) & sieve;
}

static inline uint64_t thinning_finer(uint64_t sieve)
{
    return sieve << 1 | 1;
}

#endif
