/* SPDX-License-Identifier: MIT */
/* hash_map.h - finds the items of an array by their keys. Each item begins with its key. The map stores only the
 * indices of the items, which stay in the caller's array. Single items cannot be removed.
 *
 * With `struct cell { uint64_t node; ... } *cells`:
 *
 *     static const hash_map_item_type by_node = {sizeof(struct cell), hash_map_hash_id, hash_map_ids_equal};
 *     uint32_t place = hash_map_find(&map, &by_node, cells, &node);
 *     if (place == HASH_MAP_NONE) {
 *         ... append it to cells ...;
 *         hash_map_add(&map, &by_node, cells);
 *     }
 */
#ifndef BASE_HASH_MAP_H
#define BASE_HASH_MAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HASH_MAP_NONE UINT32_MAX

/* A zeroed hash_map is empty. */
typedef struct hash_map {
    size_t count;    /* number of items in the map: the first `count` items of the array are in the map */
    size_t size;     /* the number of slots in the table: a power of two, or 0 */
    uint32_t *table; /* for each slot, 1 + the index of its item; 0: the slot is free */
} hash_map;

/* Describes the items of an array: their size, and how their keys are hashed and compared. An item begins with its key,
 * so a pointer to an item is also a pointer to its key. */
typedef struct hash_map_item_type {
    size_t item_size;
    uint64_t (*hash)(const void *key); /* returns a hash whose low bits select the slot */
    bool (*same)(const void *a, const void *b);
} hash_map_item_type;

/* Hash and comparison functions for items whose keys are uint64_t. */
static inline uint64_t hash_map_hash_id(const void *key)
{
    const uint64_t mixed = *(const uint64_t *)key * UINT64_C(0x9e3779b97f4a7c15);
    return mixed ^ mixed >> 32;
}

static inline bool hash_map_ids_equal(const void *a, const void *b)
{
    return *(const uint64_t *)a == *(const uint64_t *)b;
}

/* Returns the index of the item with this key, or HASH_MAP_NONE. The function is inline, so that the compiler replaces
 * indirect calls if `type` is a constant. */
static inline uint32_t hash_map_find(const hash_map *map, const hash_map_item_type *type, const void *items,
                                     const void *key)
{
    if (map->size == 0)
        return HASH_MAP_NONE;
    size_t slot = (size_t)type->hash(key) & (map->size - 1);
    for (; map->table[slot]; slot = (slot + 1) & (map->size - 1)) {
        const size_t place = map->table[slot] - 1;
        if (type->same((const char *)items + place * type->item_size, key))
            return (uint32_t)place;
    }
    return HASH_MAP_NONE;
}

/* Adds the item with the index map->count. The map must not contain the item's key yet. Returns false and leaves the
 * map unchanged if memory runs out. */
bool hash_map_add(hash_map *map, const hash_map_item_type *type, const void *items);

/* Makes capacity for `count` items. Returns false and leaves the map unchanged if memory runs out. */
bool hash_map_reserve(hash_map *map, const hash_map_item_type *type, const void *items, size_t count);

/* Removes all items, but keeps the memory. */
void hash_map_clear(hash_map *map);

void hash_map_release(hash_map *map);

#endif
