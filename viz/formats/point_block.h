/* SPDX-License-Identifier: MIT */
/* point_block.h - the points of a cloud or of a session as a block of bytes, for a page that shows them. */
#ifndef FORMATS_POINT_BLOCK_H
#define FORMATS_POINT_BLOCK_H

#include "error.h"
#include "octree/game.h"
#include "point_values.h"

#include <stdio.h>

/* The largest number of points of a block. A page that shows a cloud needs 32-bit WebAssembly, whose memory ends at 4
 * GiB. A point takes about 420 bytes of this memory while the page opens. */
#define POINT_BLOCK_MOST 8000000

#define POINT_BLOCK_TITLE 256

typedef struct point_block {
    char title[POINT_BLOCK_TITLE]; /* the name of the cloud */
    octree_address node;           /* the node that is marked in the picture; 0: no node */
    octree_game_body *bodies;      /* `count` points in ascending order of their ids; owned */
    size_t count;
    bool moving;         /* true: the block has velocities; false: all velocities are zero */
    point_values values; /* colours, intensities and classes of the points; owned */
} point_block;

/* Writes a block. The block is not compressed, but compresses well, because equal bytes lie together. Returns false if
 * memory runs out. Cost: O(count); memory: 9 bytes for each point. */
bool point_block_write(const point_block *b, FILE *out);

/* Reads a block. All numbers have the bits that were written. Returns false with an error, and an empty *b, if the
 * block is cut off or damaged. */
bool point_block_read(const char *bytes, size_t size, point_block *b, octreel_error *error);

void point_block_release(point_block *b);

#endif
