/* SPDX-License-Identifier: MIT */
/* digest.h - one 64-bit digest for trees, scenes and pixels: the same on every machine, not for cryptography.
 *
 * Start with OCTREE_DIGEST_START and feed words or bytes; the order counts.
 */
#ifndef OCTREE_DIGEST_H
#define OCTREE_DIGEST_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define OCTREE_DIGEST_START UINT64_C(0x6f637472656c0001)

/* Add one word: the finalizer of splitmix64 over the running state. */
static inline uint64_t octree_digest_word(uint64_t digest, uint64_t word)
{
    uint64_t x = (digest ^ word) + UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

/* Add a double by its value: -0.0 and +0.0 count as equal. */
static inline uint64_t octree_digest_double(uint64_t digest, double value)
{
    uint64_t bits; /* alone: arithmetic would follow the rules that the including program is built by */
    memcpy(&bits, &value, sizeof bits);
    return octree_digest_word(digest, bits << 1 ? bits : 0);
}

/* Add bytes, eight at a time as little-endian words; the last word is padded with zeros. */
static inline uint64_t octree_digest_words(uint64_t digest, const void *bytes, size_t size)
{
    const unsigned char *at = (const unsigned char *)bytes;
    for (; size >= 8; at += 8, size -= 8) { /* one load, where the machine has that order */
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

/* Add bytes as words, then their number. */
static inline uint64_t octree_digest_bytes(uint64_t digest, const void *bytes, size_t size)
{
    return octree_digest_word(octree_digest_words(digest, bytes, size), size);
}

#endif
