/* SPDX-License-Identifier: MIT */
/* bits.h - bit operations on integers: counting, searching, and spreading bits for Morton codes. */
#ifndef OCTREE_BITS_H
#define OCTREE_BITS_H

#include <stdbool.h>
#include <stdint.h>

/* A table of 16 entries of four bits each. Entry i, counted from the lowest bits, is the number of set bits in i. */
#define BITS_COUNTS UINT64_C(0x4332322132212110)

static inline unsigned bits_count8(unsigned mask)
{
    return (unsigned)((BITS_COUNTS >> 4 * (mask & 15) & 15) + (BITS_COUNTS >> 4 * (mask >> 4) & 15));
}

/* bits_look_up_count8() returns the same number as bits_count8(), but reads the number from a table in memory. Queries
 * call bits_look_up_count8(), which takes fewer instructions. Changes of the tree call bits_count8(): in a measurement,
 * the table in memory made single insertions 8 % slower. */
#define BITS_ROW(n) n, n + 1, n + 1, n + 2
#define BITS_ROWS(n) BITS_ROW(n), BITS_ROW(n + 1), BITS_ROW(n + 1), BITS_ROW(n + 2)
#define BITS_BLOCK(n) BITS_ROWS(n), BITS_ROWS(n + 1), BITS_ROWS(n + 1), BITS_ROWS(n + 2)

static inline unsigned bits_look_up_count8(unsigned mask)
{
    static const uint8_t counts[256] = {BITS_BLOCK(0), BITS_BLOCK(1), BITS_BLOCK(1), BITS_BLOCK(2)};
    return counts[mask];
}

/* Returns the number of set bits. Partial sums are taken over 2, 4 and 8 bits; a multiplication then adds all bytes
 * into the highest byte. */
static inline unsigned bits_count(uint64_t mask)
{
    mask -= mask >> 1 & UINT64_C(0x5555555555555555);
    mask = (mask & UINT64_C(0x3333333333333333)) + (mask >> 2 & UINT64_C(0x3333333333333333));
    mask = (mask + (mask >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    return (unsigned)(mask * UINT64_C(0x0101010101010101) >> 56);
}

/* Returns the index of the lowest set bit, 0..63. `mask` must not be 0. */
static inline unsigned bits_lowest(uint64_t mask)
{
#if defined(__GNUC__)
    return (unsigned)__builtin_ctzll(mask);
#else
    unsigned index = 0;
    for (; !(mask & 1); mask >>= 1)
        index++;
    return index;
#endif
}

/* Returns the index of the highest set bit, 0..63. `mask` must not be 0. */
static inline unsigned bits_highest(uint64_t mask)
{
#if defined(__GNUC__)
    return 63 - (unsigned)__builtin_clzll(mask);
#else
    unsigned index = 0;
    while (mask >>= 1)
        index++;
    return index;
#endif
}

/* Insert two zero bits before each of the low 21 bits. The results for three numbers, shifted by 0, 1 and 2 bits,
 * combine to a Morton code. */
static inline uint64_t bits_spread(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    x = (x | x << 2) & UINT64_C(0x1249249249249249);
    return x;
}

/* Returns `mask` if the condition holds, else 0. The function has no branch. */
static inline unsigned mask_if(bool condition, unsigned mask)
{
    return (0u - condition) & mask;
}

#endif
