/* SPDX-License-Identifier: MIT */
/* rows.c - the storage of the bodies of a set: an array of rows, and perhaps a hash table of them.
 *
 * Problem: a leaf of a tree holds positions and ids, 32 bytes a point. Half extents need 24 bytes more. Wider leaves
 * would make trees of points larger and slower.
 *
 * Idea: each body is a row of an array, and the leaf holds the index of the row. The tree finds the row of a body that
 * is to be removed or moved (lookup.c). Where it cannot, a hash table does, so that even a million bodies at one place
 * are found in constant time.
 *
 * A slot of the table also holds the hash of its body, so that probing and removing read no rows. The table grows by a
 * half, which wastes less memory than doubling. A free row has a negative half extent.
 *
 * Cost: 56 bytes a body for the row, 10 to 15 bytes for the hash table.
 */
#include "rows.h"
#include "../exact/point.h"
#include "octree/digest.h"

enum { LEAST_SLOTS = 64 };

typedef struct row_slot {
    uint32_t hash;
    uint32_t row; /* the index of the row + 1; 0: the slot is empty */
} row_slot;

void rows_init(rows *r, arena *memory)
{
    *r = (rows){.memory = memory, .free = ROW_NONE};
}

void rows_drop_hash(rows *r)
{
    arena_free(r->memory, r->slots, r->slot_count * sizeof *r->slots);
    r->slots = NULL;
    r->slot_count = 0;
}

void rows_release(rows *r)
{
    for (size_t i = 0; i < r->chunks.count; i++)
        arena_free(r->memory, ((octree_body **)r->chunks.items)[i], ROWS_IN_CHUNK * sizeof(octree_body));
    list_release(r->memory, &r->chunks, sizeof(octree_body *));
    rows_drop_hash(r);
    rows_init(r, r->memory);
}

uint64_t digest_body(const octree_body *body)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, body->id);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, body->position[i]);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, body->half[i]);
    return digest;
}

bool is_same_body(const octree_body *a, const octree_body *b)
{
    return a->id == b->id && is_same_position(a->position, b->position) && is_same_position(a->half, b->half);
}

/* ---- The hash table ----------------------------------------------------------------------------------------- */

/* Returns a hash of position and id. Bodies that differ only in their half extents are rare. */
static uint32_t hash_body(const octree_body *body)
{
    uint64_t hash = body->id;
    for (int i = 0; i < 3; i++) {
        uint64_t bits;
        const double value = body->position[i] + 0.0; /* -0.0 becomes +0.0 */
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 32;
    }
    return (uint32_t)(hash * UINT64_C(0xd6e8feb86659fd93) >> 32);
}

static uint32_t home_of_hash(const rows *r, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash * r->slot_count >> 32);
}

static uint32_t next_slot(const rows *r, uint32_t slot)
{
    return slot + 1 < r->slot_count ? slot + 1 : 0;
}

/* Returns the slot of a body, or the empty slot at which the search for it ends. */
static uint32_t find_slot(const rows *r, const octree_body *body, uint32_t hash)
{
    uint32_t slot = home_of_hash(r, hash);
    for (; r->slots[slot].row; slot = next_slot(r, slot))
        if (r->slots[slot].hash == hash && is_same_body(row_at(r, r->slots[slot].row - 1), body))
            break;
    return slot;
}

/* Returns the slot of a stored row. */
static uint32_t find_slot_of_row(const rows *r, uint32_t index)
{
    uint32_t slot = home_of_hash(r, hash_body(row_at(r, index)));
    while (r->slots[slot].row != index + 1)
        slot = next_slot(r, slot);
    return slot;
}

static void fill_slot(rows *r, uint32_t hash, uint32_t index)
{
    uint32_t slot = home_of_hash(r, hash);
    while (r->slots[slot].row)
        slot = next_slot(r, slot);
    r->slots[slot] = (row_slot){hash, index + 1};
}

/* Returns the number of steps from one slot forward to another. */
static uint32_t count_steps(const rows *r, uint32_t from, uint32_t to)
{
    return to >= from ? to - from : to + (r->slot_count - from);
}

/* Empty a slot, and move later entries into the gap unless the gap lies before their home slot. */
static void clear_slot(rows *r, uint32_t gap)
{
    for (uint32_t slot = next_slot(r, gap); r->slots[slot].row; slot = next_slot(r, slot))
        if (count_steps(r, home_of_hash(r, r->slots[slot].hash), slot) >= count_steps(r, gap, slot)) {
            r->slots[gap] = r->slots[slot];
            gap = slot;
        }
    r->slots[gap] = (row_slot){0};
}

/* Give the hash table at least 5/4 slots for each of `count` bodies. Returns false if memory runs out. */
static bool reserve_slots(rows *r, uint64_t count)
{
    const uint64_t needed = count * 5 / 4 + 1, grown = r->slot_count + (uint64_t)r->slot_count / 2;
    uint64_t slots = needed > grown ? needed : grown;
    if (needed <= r->slot_count)
        return true;
    slots = slots < LEAST_SLOTS ? LEAST_SLOTS : slots > UINT32_MAX ? UINT32_MAX : slots;
    const rows old = *r;
    row_slot *made = slots <= SIZE_MAX / sizeof *made ? arena_allocate(r->memory, (size_t)slots * sizeof *made) : NULL;
    if (!made)
        return false;
    memset(made, 0, (size_t)slots * sizeof *made);
    r->slots = made;
    r->slot_count = (uint32_t)slots;
    for (uint32_t i = 0; i < old.slot_count; i++)
        if (old.slots[i].row)
            fill_slot(r, old.slots[i].hash, old.slots[i].row - 1);
    arena_free(r->memory, old.slots, old.slot_count * sizeof *made);
    return true;
}

/* ---- Rows --------------------------------------------------------------------------------------------------- */

/* Returns null if memory runs out. */
static octree_body *add_chunk(rows *r)
{
    octree_body *chunk = arena_allocate(r->memory, ROWS_IN_CHUNK * sizeof *chunk);
    if (chunk && list_push(r->memory, &r->chunks, &chunk, sizeof chunk))
        return chunk;
    arena_free(r->memory, chunk, chunk ? ROWS_IN_CHUNK * sizeof *chunk : 0);
    return NULL;
}

octree_status rows_reserve(rows *r, size_t count)
{
    const uint64_t total = (uint64_t)r->count + count;
    if (count > ROWS_AT_MOST || total > ROWS_AT_MOST)
        return OCTREE_TOO_MANY;
    if (rows_are_hashed(r) && !reserve_slots(r, total))
        return OCTREE_NO_MEMORY;
    while ((uint64_t)r->chunks.count * ROWS_IN_CHUNK < total)
        if (!add_chunk(r))
            return OCTREE_NO_MEMORY;
    return OCTREE_OK;
}

bool rows_copy(rows *copy, const rows *r)
{
    for (uint32_t first = 0; first < r->end; first += ROWS_IN_CHUNK) {
        octree_body *chunk = add_chunk(copy);
        if (!chunk)
            return false;
        const uint32_t left = r->end - first;
        memcpy(chunk, row_at(r, first), (left < ROWS_IN_CHUNK ? left : ROWS_IN_CHUNK) * sizeof *chunk);
    }
    copy->end = r->end;
    copy->free = r->free;
    copy->count = r->count;
    return true;
}

static bool is_row_free(const octree_body *row)
{
    return row->half[0] < 0;
}

size_t rows_list(const rows *r, octree_body *to)
{
    size_t count = 0;
    for (uint32_t i = 0; i < r->end; i++)
        if (!is_row_free(row_at(r, i)))
            to[count++] = *row_at(r, i);
    return count;
}

bool rows_hash(rows *r, size_t count)
{
    const bool hashed = rows_are_hashed(r);
    if (!reserve_slots(r, (uint64_t)r->count + count))
        return false;
    for (uint32_t i = 0; !hashed && i < r->end; i++)
        if (!is_row_free(row_at(r, i)))
            fill_slot(r, hash_body(row_at(r, i)), i);
    return true;
}

uint32_t rows_find(const rows *r, const octree_body *body)
{
    return r->slots[find_slot(r, body, hash_body(body))].row - 1;
}

/* Returns the index of a row that was free and now has this body. */
static uint32_t take_row(rows *r, const octree_body *body)
{
    uint32_t index = r->free;
    if (index == ROW_NONE)
        index = r->end++;
    else
        r->free = (uint32_t)row_at(r, index)->id;
    *row_at(r, index) = *body;
    r->count++;
    return index;
}

/* Add a row to the hash table, if there is one. */
static void show_row(rows *r, uint32_t index)
{
    if (rows_are_hashed(r))
        fill_slot(r, hash_body(row_at(r, index)), index);
}

uint32_t rows_add(rows *r, const octree_body *body)
{
    const uint32_t index = take_row(r, body);
    show_row(r, index);
    return index;
}

uint32_t rows_add_if_new(rows *r, const octree_body *body, uint32_t hash)
{
    const uint32_t slot = find_slot(r, body, hash);
    if (r->slots[slot].row)
        return ROW_NONE;
    const uint32_t index = take_row(r, body);
    r->slots[slot] = (row_slot){hash, index + 1};
    return index;
}

static void hide_row(rows *r, uint32_t index)
{
    if (rows_are_hashed(r))
        clear_slot(r, find_slot_of_row(r, index));
}

void rows_remove(rows *r, uint32_t index)
{
    hide_row(r, index);
    row_at(r, index)->id = r->free;
    row_at(r, index)->half[0] = -1;
    r->free = index;
    r->count--;
}

void rows_replace(rows *r, uint32_t index, const octree_body *body)
{
    hide_row(r, index);
    *row_at(r, index) = *body;
    show_row(r, index);
}

uint32_t rows_prefetch(const rows *r, const octree_body *body)
{
    const uint32_t hash = hash_body(body);
    if (rows_are_hashed(r))
        prefetch_memory(&r->slots[home_of_hash(r, hash)]);
    return hash;
}
