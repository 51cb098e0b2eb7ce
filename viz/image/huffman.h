/* SPDX-License-Identifier: MIT */
/* huffman.h - prefix codes of deflate (RFC 1951, 3.2.2). */
#ifndef IMAGE_HUFFMAN_H
#define IMAGE_HUFFMAN_H

#include <stddef.h>
#include <stdint.h>

enum { HUFFMAN_MOST_SYMBOLS = 288, HUFFMAN_LONGEST = 15 };

typedef struct huffman_code {
    uint16_t bits[HUFFMAN_MOST_SYMBOLS];   /* in the order in which they are sent: the first is the lowest */
    uint8_t lengths[HUFFMAN_MOST_SYMBOLS]; /* 0: the symbol has no code */
} huffman_code;

/* The shortest code for symbols of these counts in which none is longer than `longest` bits, which must suffice for as
 * many symbols. It is complete: two symbols have codes even where fewer are counted. Equal counts make equal codes. */
void huffman_build(huffman_code *code, const uint32_t *counts, size_t count, int longest);

/* The bits of symbols whose lengths are set. */
void huffman_number(huffman_code *code, size_t count);

#endif
