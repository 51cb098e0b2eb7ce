/* lines.c - see lines.h: a hash table with open addressing, at most half full. */
#include "lines.h"

#include <stdlib.h>
#include <string.h>

#define FIRST_SIZE 1024

void lines_clear(line_set *set)
{
    set->count = set->idle = 0;
    if (set->size)
        memset(set->table, 0, set->size * sizeof *set->table);
}

void lines_release(line_set *set)
{
    free(set->items);
    free(set->changed);
    free(set->table);
    memset(set, 0, sizeof *set);
}

/* Planes of a tree have few bits, and those at the top: they are brought down before they are mixed. */
static uint64_t fold(double value)
{
    uint64_t bits;
    const double canonical = value + 0.0; /* of the two zeros one */
    memcpy(&bits, &canonical, sizeof bits);
    return bits ^ bits >> 32;
}

static size_t place_of(const line_set *set, const line_key *key)
{
    const uint64_t mixed = (fold(key->u) + key->kind) * UINT64_C(0x9e3779b97f4a7c15) ^
                           (fold(key->v) + key->kind) * UINT64_C(0xc2b2ae3d27d4eb4f);
    return (size_t)((mixed ^ mixed >> 32) * UINT64_C(0xd6e8feb86659fd93) >> 32) & (set->size - 1);
}

/* Twice the room, and every line in its new place. */
static bool grow(line_set *set)
{
    const size_t size = set->size ? 2 * set->size : FIRST_SIZE, room = size / 2;
    line *items = room <= UINT32_MAX / sizeof *items ? realloc(set->items, room * sizeof *items) : NULL;
    if (!items)
        return false;
    set->items = items;
    uint8_t *changed = realloc(set->changed, room);
    if (!changed)
        return false;
    set->changed = changed;
    uint32_t *table = calloc(size, sizeof *table);
    if (!table)
        return false;
    free(set->table);
    set->table = table;
    set->size = size;
    set->room = room;
    for (size_t i = 0; i < set->count; i++) {
        size_t at = place_of(set, &items[i].key);
        while (table[at])
            at = (at + 1) & (size - 1);
        table[at] = (uint32_t)(i + 1);
    }
    return true;
}

/* The place of a line, which may be new. */
static uint32_t find(line_set *set, const line_key *key)
{
    if (set->count == set->room && !grow(set))
        return LINE_NONE;
    size_t at = place_of(set, key);
    for (; set->table[at]; at = (at + 1) & (set->size - 1)) {
        const line_key *found = &set->items[set->table[at] - 1].key;
        if (found->u == key->u && found->v == key->v && found->kind == key->kind)
            return set->table[at] - 1;
    }
    set->items[set->count] = (line){.key = *key};
    set->table[at] = (uint32_t)(set->count + 1);
    set->idle++;
    return (uint32_t)set->count++;
}

uint32_t lines_use(line_set *set, const line_key *key)
{
    const uint32_t place = find(set, key);
    if (place == LINE_NONE)
        return LINE_NONE;
    set->idle -= set->items[place].users++ == 0;
    set->changed[place] = true;
    return place;
}

void lines_leave(line_set *set, uint32_t place)
{
    set->idle += --set->items[place].users == 0;
    set->changed[place] = true;
}
