/* SPDX-License-Identifier: MIT */
/* deflate_block.h - collects literals and repeats as tokens, and writes them as deflate blocks, each in its shortest
 * form. */
#ifndef IMAGE_DEFLATE_BLOCK_H
#define IMAGE_DEFLATE_BLOCK_H

#include "deflate.h"

/* ---- Huffman codes: huffman.c -------------------------------------------------------------------------------- */

enum { HUFFMAN_MOST_SYMBOLS = 288, HUFFMAN_LONGEST = 15 };

typedef struct huffman_code {
    uint16_t bits[HUFFMAN_MOST_SYMBOLS];   /* code word of each symbol; its lowest bit is written first */
    uint8_t lengths[HUFFMAN_MOST_SYMBOLS]; /* length of each code word in bits; 0: the symbol has no code word */
} huffman_code;

/* Build a Huffman code for `count` symbols; symbol i occurs counts[i] times. Code words have at most `longest` bits,
 * which must be enough for `count` symbols. The code is always complete: if fewer than two symbols occur, two symbols
 * still get code words. Equal counts give equal codes on every machine. */
void huffman_build_code(huffman_code *code, const uint32_t *counts, size_t count, int longest);

/* Compute the canonical code words from the lengths in code->lengths. */
void huffman_assign_code_words(huffman_code *code, size_t count);

/* ---- Blocks: deflate_block.c ---------------------------------------------------------------------------------- */

enum {
    DEFLATE_SHORTEST = 3,     /* length of the shortest repeat */
    DEFLATE_LONGEST = 258,    /* length of the longest repeat */
    DEFLATE_FARTHEST = 32768, /* largest distance of a repeat */
    DEFLATE_LITERALS = 288,   /* number of symbols for bytes, the block's end, and lengths; the last two are unused */
    DEFLATE_DISTANCES = 30,   /* number of symbols for distances */
    DEFLATE_END = 256,        /* the symbol that ends a block */
    BLOCK_TOKENS = 12288,     /* the largest number of tokens with which a block is full */
    INDEXED_BLOCK_TOKENS = 4096, /* the number for palette indices, whose codes change more from row to row */
    BLOCK_SPARE = 16,            /* number of tokens that may be added to a block after it is full */
    DEFLATE_GROUP = 6,           /* maximum number of literals that one call adds */
};

/* A literal or a repeat, packed. The lowest 9 bits hold the byte, or DEFLATE_REPEAT + (length - DEFLATE_SHORTEST). The
 * bits from DISTANCE_AT on hold the symbol of the distance. The bits from DISTANCE_EXTRA_AT on hold the extra bits of
 * the distance.
 *
 * A literal has the distance symbol DEFLATE_DISTANCES, whose code word has no bits, so that append_token() needs no
 * branch for it.
 *
 * A token with the bit DEFLATE_PIXEL holds the three literals of an RGB pixel in its lowest 24 bits. */
typedef uint32_t deflate_token;
enum { DEFLATE_REPEAT = 256, TOKEN_KINDS = 512, DISTANCE_AT = 9, DISTANCE_EXTRA_AT = 14 };
#define DEFLATE_PIXEL (UINT32_C(1) << 31)

typedef struct bit_writer {
    uint64_t bits; /* bits that are not in the output yet; the lowest bit is written first */
    int count;     /* number of bits in `bits`; below 8 between two tokens */
    uint8_t *to;   /* address of the next output byte */
} bit_writer;

typedef struct deflate_blocks {
    deflate_sink *sink;
    void *context;
    bit_writer writer; /* writes into the buffer `output` */
    size_t count;      /* number of tokens in `tokens` */
    size_t most;       /* a block with this many tokens is full */
    /* number of times that each symbol occurs in the tokens; literal_counts is computed when the block is written */
    uint32_t literal_counts[DEFLATE_LITERALS], distance_counts[DEFLATE_DISTANCES + 1];
    huffman_code literals, distances;
    /* index: length - DEFLATE_SHORTEST; value: the symbol of this length, minus 257 */
    uint8_t length_symbols[TOKEN_KINDS - DEFLATE_REPEAT];
    /* index: distance - 1 for the first 256 distances, else 256 + (distance - 1) / 128; value: the symbol of the
     * distance */
    uint8_t distance_symbols[512];
    deflate_token tokens[BLOCK_TOKENS + BLOCK_SPARE];
    uint8_t output[1 << 16];
} deflate_blocks;

/* Initialize a zeroed struct. A block with `most` tokens, at most BLOCK_TOKENS, is full. */
void deflate_begin_blocks(deflate_blocks *b, size_t most, deflate_sink *sink, void *context);

static inline bool deflate_is_block_full(const deflate_blocks *b)
{
    return b->count >= b->most;
}

/* Add `count` literals, at most DEFLATE_GROUP. Reads DEFLATE_GROUP bytes even if `count` is smaller. */
static inline void deflate_add_literals(deflate_blocks *b, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < DEFLATE_GROUP; i++)
        b->tokens[b->count + i] = bytes[i] | (deflate_token)DEFLATE_DISTANCES << DISTANCE_AT;
    b->count += count;
}

/* Add the three literals of an RGB pixel. */
static inline void deflate_add_pixel(deflate_blocks *b, const uint8_t *bytes)
{
    b->tokens[b->count++] =
        DEFLATE_PIXEL | (deflate_token)bytes[2] << 16 | (deflate_token)bytes[1] << 8 | (deflate_token)bytes[0];
}

void deflate_add_repeat(deflate_blocks *b, size_t length, size_t distance);

/* Write the collected tokens as one block in its shortest form: with its own Huffman codes, with deflate's fixed codes,
 * or stored. `bytes` are the `size` bytes that the tokens encode. If these bytes are no longer available, `bytes` is
 * null, and the block is not stored. */
void deflate_write_block(deflate_blocks *b, const uint8_t *bytes, size_t size, bool last);

/* Pad the stream to a whole byte, and write `size` bytes that are not part of a block, such as a header. */
void deflate_write_bytes(deflate_blocks *b, const uint8_t *bytes, size_t size);

/* Pass the buffered output to the sink. */
void deflate_flush_output(deflate_blocks *b);

#endif
