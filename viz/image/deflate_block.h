/* SPDX-License-Identifier: MIT */
/* deflate_block.h - tokens to blocks of a deflate stream, each in the code that is shortest for it. */
#ifndef IMAGE_DEFLATE_BLOCK_H
#define IMAGE_DEFLATE_BLOCK_H

#include "deflate.h"
#include "huffman.h"

enum {
    DEFLATE_SHORTEST = 3,
    DEFLATE_LONGEST = 258,
    DEFLATE_FARTHEST = 32768,
    DEFLATE_LITERALS = 288, /* symbols of bytes, of the end and of lengths, two of which are never used */
    DEFLATE_DISTANCES = 30,
    DEFLATE_END = 256,
    BLOCK_TOKENS = 4096, /* make a block full, */
    BLOCK_SPARE = 16,    /* and so many more fit */
    DEFLATE_GROUP = 6,
};

/* What is sent: a byte, or DEFLATE_REPEAT and how much longer a repeat is than the shortest; then, from these bits on,
 * the symbol of the distance and what is added to its least. A byte's is a symbol that takes no bits. */
typedef uint32_t deflate_token;
enum { DEFLATE_REPEAT = 256, TOKEN_KINDS = 512, DISTANCE_AT = 9, DISTANCE_EXTRA_AT = 14 };

typedef struct deflate_blocks {
    deflate_sink *sink;
    void *context;
    uint64_t bits; /* not yet in the output, the first of them lowest */
    int bit_count; /* below 8 between tokens */
    size_t size;   /* of the output */
    size_t count;  /* of the tokens */
    uint32_t literal_counts[DEFLATE_LITERALS], distance_counts[DEFLATE_DISTANCES + 1]; /* of its tokens */
    huffman_code literals, distances;
    uint8_t length_symbols[TOKEN_KINDS - DEFLATE_REPEAT]; /* less 257, of a repeat's length from the shortest on */
    uint8_t distance_symbols[512];                        /* of distances up to 256, and then of each 128 more */
    deflate_token tokens[BLOCK_TOKENS + BLOCK_SPARE];
    uint8_t output[1 << 16];
} deflate_blocks;

/* Begin in zeroed memory. */
void deflate_blocks_begin(deflate_blocks *b, deflate_sink *sink, void *context);

static inline bool deflate_is_full(const deflate_blocks *b)
{
    return b->count >= BLOCK_TOKENS;
}

/* Up to DEFLATE_GROUP bytes; so many are read in any case. */
static inline void deflate_add_bytes(deflate_blocks *b, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < DEFLATE_GROUP; i++)
        b->tokens[b->count + i] = bytes[i] | (deflate_token)DEFLATE_DISTANCES << DISTANCE_AT;
    b->count += count;
}

void deflate_add_repeat(deflate_blocks *b, size_t length, size_t distance);

/* Write the tokens since the last block as one, with the code that is shortest. `bytes` are those that they stand for,
 * to be written as they are where nothing is shorter; null where they are not at hand. */
void deflate_write_block(deflate_blocks *b, const uint8_t *bytes, size_t size, bool last);

/* Write bytes that are in no block; they begin at a whole byte. */
void deflate_write_bytes(deflate_blocks *b, const uint8_t *bytes, size_t size);

/* Hand the rest of the output to the sink. */
void deflate_flush(deflate_blocks *b);

#endif
