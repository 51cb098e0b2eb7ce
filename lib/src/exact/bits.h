/* SPDX-License-Identifier: MIT */
/* bits.h - small integer tricks: counting bits, and Morton order. */
#ifndef OCTREE_BITS_H
#define OCTREE_BITS_H

#include <stdbool.h>
#include <stdint.h>

static inline unsigned bits_count8(unsigned mask)
{
    mask = mask - ((mask >> 1) & 0x55);
    mask = (mask & 0x33) + ((mask >> 2) & 0x33);
    return (mask + (mask >> 4)) & 0x0f;
}

/* Index of the lowest set bit; mask must not be 0. */
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

/* Index of the highest set bit; mask must not be 0. */
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

/* Spread the low 21 bits so that two zero bits follow each. */
static inline uint64_t bits_spread(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    x = (x | x << 2) & UINT64_C(0x1249249249249249);
    return x;
}

/* The mask, or none of it; without a branch. */
static inline unsigned bits_if(bool condition, unsigned mask)
{
    return condition ? mask : 0;
}

#endif
