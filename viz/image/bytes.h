/* SPDX-License-Identifier: MIT */
/* bytes.h - compares and searches bytes eight at a time. The functions work for any alignment and on machines of any
 * byte order. */
#ifndef IMAGE_BYTES_H
#define IMAGE_BYTES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Load eight bytes as a little-endian word, on machines of any byte order. Compilers turn this into one load. */
static inline uint64_t bytes_load_word(const uint8_t *at)
{
    return (uint64_t)at[0] | (uint64_t)at[1] << 8 | (uint64_t)at[2] << 16 | (uint64_t)at[3] << 24 |
           (uint64_t)at[4] << 32 | (uint64_t)at[5] << 40 | (uint64_t)at[6] << 48 | (uint64_t)at[7] << 56;
}

static inline void bytes_store_word(uint8_t *to, uint64_t word)
{
    to[0] = (uint8_t)word;
    to[1] = (uint8_t)(word >> 8);
    to[2] = (uint8_t)(word >> 16);
    to[3] = (uint8_t)(word >> 24);
    to[4] = (uint8_t)(word >> 32);
    to[5] = (uint8_t)(word >> 40);
    to[6] = (uint8_t)(word >> 48);
    to[7] = (uint8_t)(word >> 56);
}

/* Returns the number of zero bytes at the start of a little-endian word, that is, the number of lowest bytes that are
 * 0. The word must not be 0. */
static inline size_t bytes_count_zeros_at_start(uint64_t word)
{
#ifdef __GNUC__
    return (size_t)__builtin_ctzll(word) / 8;
#else
    size_t count = 0;
    for (; (word & 0xff) == 0; word >>= 8)
        count++;
    return count;
#endif
}

/* Returns a word with the highest bit set in each byte that is zero in `word`. */
static inline uint64_t bytes_mark_zero_bytes(uint64_t word)
{
    const uint64_t low = UINT64_C(0x7f7f7f7f7f7f7f7f);
    return ~(((word & low) + low) | word | low);
}

/* Returns the length of the common prefix of a and b, which have `size` bytes each. */
static inline size_t bytes_common_prefix_length(const uint8_t *a, const uint8_t *b, size_t size)
{
    size_t at = 0;
    for (; at + 8 <= size; at += 8) {
        const uint64_t unlike = bytes_load_word(a + at) ^ bytes_load_word(b + at);
        if (unlike != 0)
            return at + bytes_count_zeros_at_start(unlike);
    }
    while (at < size && a[at] == b[at])
        at++;
    return at;
}

#endif
