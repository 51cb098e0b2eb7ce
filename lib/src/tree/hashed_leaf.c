/* Open addressing with linear probing; a slot holds an index + 1, or 0. */
#include "hashed_leaf.h"
#include "octree/digest.h"
#include "point.h"

#define HASHED_MAX_ROOM (UINT32_C(1) << 31)

typedef struct hashed_header {
    uint32_t room;
    uint32_t mask; /* slots - 1; slots are a power of two, at least twice the room */
    uint64_t size; /* of the whole block, in bytes */
} hashed_header;

static hashed_header *header_of(const octree_point *points)
{
    return (hashed_header *)(uintptr_t)points - 1;
}

static uint32_t *slots_of(const octree_point *points)
{
    return (uint32_t *)(uintptr_t)(points + header_of(points)->room);
}

static uint32_t home_slot(const octree_point *points, const double position[3], uint64_t id)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, position[i]);
    return (uint32_t)digest & header_of(points)->mask;
}

octree_point *hashed_leaf_create(arena *memory, uint32_t room)
{
    if (room > HASHED_MAX_ROOM)
        return NULL;
    uint64_t slots = 4;
    while (slots < 2 * (uint64_t)room)
        slots *= 2;
    const uint64_t size = sizeof(hashed_header) + room * (uint64_t)sizeof(octree_point) + slots * sizeof(uint32_t);
    if (size > SIZE_MAX)
        return NULL;
    hashed_header *header = arena_take(memory, (size_t)size);
    if (!header)
        return NULL;
    *header = (hashed_header){.room = room, .mask = (uint32_t)(slots - 1), .size = size};
    octree_point *points = (octree_point *)(header + 1);
    memset(slots_of(points), 0, (size_t)slots * sizeof(uint32_t));
    return points;
}

void hashed_leaf_release(arena *memory, octree_point *points)
{
    arena_give(memory, header_of(points), (size_t)header_of(points)->size);
}

uint32_t hashed_leaf_room(const octree_point *points)
{
    return header_of(points)->room;
}

/* The slot of a pair, or the empty one where the search ends. */
static uint32_t slot_of(const octree_point *points, const double position[3], uint64_t id)
{
    const uint32_t *slots = slots_of(points);
    const uint32_t mask = header_of(points)->mask;
    uint32_t slot = home_slot(points, position, id);
    for (; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &points[slots[slot] - 1];
        if (point->id == id && same_position(point->position, position))
            break;
    }
    return slot;
}

uint32_t hashed_leaf_find(const octree_point *points, const double position[3], uint64_t id)
{
    return slots_of(points)[slot_of(points, position, id)] - 1;
}

uint32_t hashed_leaf_append(octree_point *points, uint32_t count, const octree_point *point)
{
    uint32_t *slot = &slots_of(points)[slot_of(points, point->position, point->id)];
    if (*slot)
        return *slot - 1;
    points[count] = *point;
    *slot = count + 1;
    return count;
}

/* Empty a slot and close the gap: later entries of the run move up unless that would put them before their home. */
static void clear_slot(octree_point *points, uint32_t gap)
{
    uint32_t *slots = slots_of(points);
    const uint32_t mask = header_of(points)->mask;
    for (uint32_t slot = (gap + 1) & mask; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &points[slots[slot] - 1];
        const uint32_t home = home_slot(points, point->position, point->id);
        if (((slot - home) & mask) >= ((slot - gap) & mask)) {
            slots[gap] = slots[slot];
            gap = slot;
        }
    }
    slots[gap] = 0;
}

void hashed_leaf_remove(octree_point *points, uint32_t count, uint32_t index)
{
    clear_slot(points, slot_of(points, points[index].position, points[index].id));
    const uint32_t last = count - 1;
    if (index == last)
        return;
    const uint32_t slot = slot_of(points, points[last].position, points[last].id);
    points[index] = points[last];
    slots_of(points)[slot] = index + 1;
}

void hashed_leaf_replace(octree_point *points, uint32_t index, const octree_point *point)
{
    clear_slot(points, slot_of(points, points[index].position, points[index].id));
    points[index] = *point;
    slots_of(points)[slot_of(points, point->position, point->id)] = index + 1;
}
