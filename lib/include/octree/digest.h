/* SPDX-License-Identifier: MIT */
/* digest.h - computes 64-bit digests, for example of trees, scenes and pixels. Equal data gives equal digests on every
 * machine. The digest is not cryptographic.
 *
 * Start with OCTREE_DIGEST_START, and add words or bytes. The order of words and bytes matters. Example:
 *
 *     uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
 */
#ifndef OCTREE_DIGEST_H
#define OCTREE_DIGEST_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define OCTREE_DIGEST_START UINT64_C(0x6f637472656c0001)

/* Add one word, by the finalizer of splitmix64 (Steele, Lea and Flood 2014). Returns the new digest. */
static inline uint64_t octree_digest_word(uint64_t digest, uint64_t word)
{
    uint64_t x = (digest ^ word) + UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

/* Add a double by its value: -0.0 and +0.0 give the same digest. Returns the new digest. */
static inline uint64_t octree_digest_double(uint64_t digest, double value)
{
    /* Recognize 0.0 and -0.0 by their bits, because the compiler flags of the including program may change comparisons
     * of doubles. */
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return octree_digest_word(digest, bits << 1 ? bits : 0);
}

/* Add bytes, eight at a time as little-endian words; the last word is padded with zeros. Returns the new digest. */
static inline uint64_t octree_digest_words(uint64_t digest, const void *bytes, size_t size)
{
    const unsigned char *at = (const unsigned char *)bytes;
    /* compilers turn this expression into one load instruction on little-endian machines */
    for (; size >= 8; at += 8, size -= 8) {
        const uint64_t word = (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 | (uint64_t)at[3] << 24 |
                              (uint64_t)at[4] << 32 | (uint64_t)at[5] << 40 | (uint64_t)at[6] << 48 |
                              (uint64_t)at[7] << 56;
        digest = octree_digest_word(digest, word);
    }
    uint64_t rest = 0;
    for (size_t i = 0; i < size; i++)
        rest |= (uint64_t)at[i] << (8 * i);
    return size > 0 ? octree_digest_word(digest, rest) : digest;
}

/* Add bytes as octree_digest_words() does, then add the number of bytes as one word. Returns the new digest. */
static inline uint64_t octree_digest_bytes(uint64_t digest, const void *bytes, size_t size)
{
    return octree_digest_word(octree_digest_words(digest, bytes, size), size);
}

#endif
