/* SPDX-License-Identifier: MIT */
/* hash_map.c - finds array items by key in constant time.
 *
 * The items stay in the caller's array; the map is only a table of their indices, 4 bytes each. The hash of a key
 * selects a slot. If another item occupies this slot, the slots after it are tried in turn (open addressing with linear
 * probing). Linear probing reads memory in order and needs no lists. An empty slot ends a search. Removing a single
 * item would leave an empty slot that ends the search for another item too early, so single items cannot be removed.
 *
 * The table is at most half full. A search then takes about 1.5 probes for a present key and 2.5 for an absent key
 * (Knuth, The Art of Computer Programming 3, 6.4). The table has 2^n slots, so that a mask selects the slot instead of
 * a division. When the table is half full, it is doubled and refilled; adding an item therefore costs O(1), amortized.
 */
#include "hash_map.h"

#include <stdlib.h>
#include <string.h>

enum { SMALLEST_TABLE = 32 };

static void fill_slot(hash_map *map, const hash_map_item_type *type, const void *items, size_t index)
{
    size_t slot = (size_t)type->hash((const char *)items + index * type->item_size) & (map->size - 1);
    while (map->table[slot])
        slot = (slot + 1) & (map->size - 1);
    map->table[slot] = (uint32_t)(index + 1);
}

bool hash_map_reserve(hash_map *map, const hash_map_item_type *type, const void *items, size_t count)
{
    size_t size = map->size ? map->size : SMALLEST_TABLE;
    if (2 * count <= map->size)
        return true;
    while (size < 2 * count)
        size *= 2;
    uint32_t *table = count < HASH_MAP_NONE ? calloc(size, sizeof *table) : NULL;
    if (!table)
        return false;
    free(map->table);
    map->table = table;
    map->size = size;
    for (size_t i = 0; i < map->count; i++)
        fill_slot(map, type, items, i);
    return true;
}

bool hash_map_add(hash_map *map, const hash_map_item_type *type, const void *items)
{
    if (!hash_map_reserve(map, type, items, map->count + 1))
        return false;
    fill_slot(map, type, items, map->count++);
    return true;
}

void hash_map_clear(hash_map *map)
{
    map->count = 0;
    if (map->size)
        memset(map->table, 0, map->size * sizeof *map->table);
}

void hash_map_release(hash_map *map)
{
    free(map->table);
    *map = (hash_map){0};
}
