/* SPDX-License-Identifier: MIT */
/* huffman.h - builds the length-limited Huffman codes of deflate (RFC 1951, 3.2.2). */
#ifndef IMAGE_HUFFMAN_H
#define IMAGE_HUFFMAN_H

#include <stddef.h>
#include <stdint.h>

enum { HUFFMAN_MOST_SYMBOLS = 288, HUFFMAN_LONGEST = 15 };

typedef struct huffman_code {
    uint16_t bits[HUFFMAN_MOST_SYMBOLS];   /* code words; the bit that is sent first is the lowest */
    uint8_t lengths[HUFFMAN_MOST_SYMBOLS]; /* bits of each code word; 0: the symbol has none */
} huffman_code;

/* Build a short code for symbols that occur counts[i] times, without code words longer than `longest` bits; `longest`
 * must be enough for `count` symbols. The code is complete: if fewer than two symbols occur, two get code words all the
 * same. Equal counts give equal codes on every machine. */
void huffman_build(huffman_code *code, const uint32_t *counts, size_t count, int longest);

/* Compute the canonical code words of symbols whose lengths are set. */
void huffman_assign_bits(huffman_code *code, size_t count);

#endif
