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

static bool grow(hash_map *map, const hash_map_keys *keys, const void *items)
{
    const size_t size = map->size ? 2 * map->size : SMALLEST_TABLE;
    uint32_t *table = map->count < HASH_MAP_NONE - 1 ? calloc(size, sizeof *table) : NULL;
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
    if (2 * map->count >= map->size && !grow(map, keys, items))
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
