/* crowd.c - see crowd.h. Open addressing with linear probing; a slot holds an index + 1, or 0. */
#include "hashed_leaf.h"
#include "octree/digest.h"
#include "point.h"

#define CROWD_MAX_ROOM (UINT32_C(1) << 31)

typedef struct crowd_header {
    uint32_t room;
    uint32_t mask; /* slots - 1; slots are a power of two, at least twice the room */
    uint64_t size; /* of the whole block */
} crowd_header;

static crowd_header *header_of(const octree_point *crowd)
{
    return (crowd_header *)(uintptr_t)crowd - 1;
}

static uint32_t *slots_of(const octree_point *crowd)
{
    return (uint32_t *)(uintptr_t)(crowd + header_of(crowd)->room);
}

static uint32_t home_slot(const octree_point *crowd, const double position[3], uint64_t id)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, position[i]);
    return (uint32_t)digest & header_of(crowd)->mask;
}

octree_point *crowd_create(arena *memory, uint32_t room)
{
    if (room > CROWD_MAX_ROOM)
        return NULL;
    uint64_t slots = 64;
    while (slots < 2 * (uint64_t)room)
        slots *= 2;
    const uint64_t size = sizeof(crowd_header) + room * (uint64_t)sizeof(octree_point) + slots * sizeof(uint32_t);
    if (size > SIZE_MAX)
        return NULL;
    crowd_header *header = arena_take(memory, (size_t)size);
    if (!header)
        return NULL;
    *header = (crowd_header){.room = room, .mask = (uint32_t)(slots - 1), .size = size};
    octree_point *crowd = (octree_point *)(header + 1);
    memset(slots_of(crowd), 0, (size_t)slots * sizeof(uint32_t));
    return crowd;
}

void crowd_release(arena *memory, octree_point *crowd)
{
    arena_give(memory, header_of(crowd), (size_t)header_of(crowd)->size);
}

uint32_t crowd_room(const octree_point *crowd)
{
    return header_of(crowd)->room;
}

/* The slot of a pair, or the empty one where the search ends. */
static uint32_t slot_of(const octree_point *crowd, const double position[3], uint64_t id)
{
    const uint32_t *slots = slots_of(crowd);
    const uint32_t mask = header_of(crowd)->mask;
    uint32_t slot = home_slot(crowd, position, id);
    for (; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &crowd[slots[slot] - 1];
        if (point->id == id && same_position(point->position, position))
            break;
    }
    return slot;
}

uint32_t crowd_find(const octree_point *crowd, const double position[3], uint64_t id)
{
    return slots_of(crowd)[slot_of(crowd, position, id)] - 1;
}

void crowd_append(octree_point *crowd, uint32_t count, const octree_point *point)
{
    crowd[count] = *point;
    slots_of(crowd)[slot_of(crowd, point->position, point->id)] = count + 1;
}

/* Empty a slot and close the gap: entries behind it move up unless that would take them before their home. */
static void clear_slot(octree_point *crowd, uint32_t gap)
{
    uint32_t *slots = slots_of(crowd);
    const uint32_t mask = header_of(crowd)->mask;
    for (uint32_t slot = (gap + 1) & mask; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &crowd[slots[slot] - 1];
        const uint32_t home = home_slot(crowd, point->position, point->id);
        if (((slot - home) & mask) >= ((slot - gap) & mask)) {
            slots[gap] = slots[slot];
            gap = slot;
        }
    }
    slots[gap] = 0;
}

void crowd_take(octree_point *crowd, uint32_t count, uint32_t index)
{
    clear_slot(crowd, slot_of(crowd, crowd[index].position, crowd[index].id));
    const uint32_t last = count - 1;
    if (index == last)
        return;
    const uint32_t slot = slot_of(crowd, crowd[last].position, crowd[last].id);
    crowd[index] = crowd[last];
    slots_of(crowd)[slot] = index + 1;
}

void crowd_replace(octree_point *crowd, uint32_t index, const octree_point *point)
{
    clear_slot(crowd, slot_of(crowd, crowd[index].position, crowd[index].id));
    crowd[index] = *point;
    slots_of(crowd)[slot_of(crowd, point->position, point->id)] = index + 1;
}
