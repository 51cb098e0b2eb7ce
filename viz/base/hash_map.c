/* SPDX-License-Identifier: MIT */
#include "hash_map.h"

#include <stdlib.h>
#include <string.h>

enum { SMALLEST_TABLE = 32 };

static void enter(hash_map *map, const hash_map_keys *keys, const void *items, size_t place)
{
    size_t slot = (size_t)keys->hash((const char *)items + place * keys->item_size) & (map->size - 1);
    while (map->table[slot])
        slot = (slot + 1) & (map->size - 1);
    map->table[slot] = (uint32_t)(place + 1);
}

bool hash_map_reserve(hash_map *map, const hash_map_keys *keys, const void *items, size_t count)
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
        enter(map, keys, items, i);
    return true;
}

bool hash_map_add(hash_map *map, const hash_map_keys *keys, const void *items)
{
    if (!hash_map_reserve(map, keys, items, map->count + 1))
        return false;
    enter(map, keys, items, map->count++);
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
