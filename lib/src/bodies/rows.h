/* SPDX-License-Identifier: MIT */
/* rows.h - the storage of the bodies of a set: an array of rows, and perhaps a hash table of them. Private.
 *
 * A body keeps the index of its row until it is removed. The trees of the levels hold this index in the id of a point
 * (few_bodies.h).
 */
#ifndef OCTREE_ROWS_H
#define OCTREE_ROWS_H

#include "../tree/leaf.h"
#include "octree/bodies.h"

#define ROWS_IN_CHUNK 1024
#define ROW_NONE UINT32_MAX
#define ROWS_AT_MOST (UINT32_C(5) << 29) /* so that the hash table has fewer than 2^32 slots */

typedef struct rows {
    arena *memory;
    list chunks;    /* octree_body *: arrays of ROWS_IN_CHUNK bodies, which never move */
    uint32_t end;   /* all rows in use have an index below this number */
    uint32_t free;  /* the first free row, whose id is the index of the next free row; or ROW_NONE */
    uint32_t count; /* the number of bodies */
    /* the hash table, with linear probing; null: there is none */
    struct row_slot *slots;
    uint32_t slot_count;
} rows;

void rows_init(rows *r, arena *memory);
void rows_release(rows *r);

/* Copy all rows, but no hash table, to an empty list of rows. Returns false if memory runs out; the copy must then be
 * released. */
bool rows_copy(rows *copy, const rows *r);

/* Copy all bodies to an array. Returns their number. */
size_t rows_list(const rows *r, octree_body *to);

static inline octree_body *row_at(const rows *r, size_t index)
{
    return ((octree_body **)r->chunks.items)[index / ROWS_IN_CHUNK] + index % ROWS_IN_CHUNK;
}

/* Start to load a body, which may lie on two cache lines. */
static inline void prefetch_body(const octree_body *body)
{
    prefetch_memory(body);
    prefetch_memory(&body->id);
}

/* Make room for `count` more bodies, so that as many additions cannot fail. Returns NO_MEMORY or TOO_MANY. */
octree_status rows_reserve(rows *r, size_t count);

/* Make the hash table if there is none, with room for `count` more bodies. Returns false if memory runs out. */
bool rows_hash(rows *r, size_t count);
void rows_drop_hash(rows *r);

static inline bool rows_are_hashed(const rows *r)
{
    return r->slots != NULL;
}

/* Returns the index of the row of a body, or ROW_NONE. The rows must be hashed. */
uint32_t rows_find(const rows *r, const octree_body *body);

/* Start loading the slot of the hash table that is read first to find a body. Returns the body's hash. */
uint32_t rows_prefetch(const rows *r, const octree_body *body);

/* Add a body that is not stored; there must be room. Returns the index of its row. */
uint32_t rows_add(rows *r, const octree_body *body);

/* Add a body with its hash; there must be room, and the rows must be hashed. Returns the index of its row, or ROW_NONE
 * if the body is stored already. */
uint32_t rows_add_if_new(rows *r, const octree_body *body, uint32_t hash);

void rows_remove(rows *r, uint32_t index);

/* Replace the body of a row by a body that is not stored yet. */
void rows_replace(rows *r, uint32_t index, const octree_body *body);

/* Returns a digest of a body. -0.0 and +0.0 give the same digest. */
uint64_t digest_body(const octree_body *body);

/* Returns whether two bodies have the same position, half extents and id. */
bool is_same_body(const octree_body *a, const octree_body *b);

#endif
