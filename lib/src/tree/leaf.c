/* SPDX-License-Identifier: MIT */
/* leaf.c - the leaves of a tree, and operations on whole subtrees. A leaf of up to 64 points is a block of a pool; a
 * larger leaf has a hash table. */
#include "leaf.h"
#include "octree/digest.h"

#include <string.h>

/* ---- Hashed leaves: open addressing with linear probing. A slot holds a point's index + 1, or 0 if empty ------ */

#define HASHED_MAX_ROOM (UINT32_C(1) << 31)

typedef struct hashed_header {
    uint32_t room;
    /* the number of slots minus 1; the number of slots is a power of two, at least twice the leaf's room */
    uint32_t mask;
    uint64_t size; /* the size in bytes of the whole block of memory */
} hashed_header;

static hashed_header *hashed_header_of(const octree_point *points)
{
    return (hashed_header *)(uintptr_t)points - 1;
}

static uint32_t *hash_slots_of(const octree_point *points)
{
    return (uint32_t *)(uintptr_t)(points + hashed_header_of(points)->room);
}

static uint32_t find_home_slot(const octree_point *points, const double position[3], uint64_t id)
{
    uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
    for (int i = 0; i < 3; i++)
        digest = octree_digest_double(digest, position[i]);
    return (uint32_t)digest & hashed_header_of(points)->mask;
}

static octree_point *create_hashed_block(arena *memory, uint32_t room)
{
    if (room > HASHED_MAX_ROOM)
        return NULL;
    uint64_t slots = 64;
    while (slots < 2 * (uint64_t)room)
        slots *= 2;
    const uint64_t size = sizeof(hashed_header) + room * (uint64_t)sizeof(octree_point) + slots * sizeof(uint32_t);
    if (size > SIZE_MAX)
        return NULL;
    hashed_header *header = arena_allocate(memory, (size_t)size);
    if (!header)
        return NULL;
    *header = (hashed_header){.room = room, .mask = (uint32_t)(slots - 1), .size = size};
    octree_point *points = (octree_point *)(header + 1);
    memset(hash_slots_of(points), 0, (size_t)slots * sizeof(uint32_t));
    return points;
}

static void release_hashed_block(arena *memory, octree_point *points)
{
    arena_free(memory, hashed_header_of(points), (size_t)hashed_header_of(points)->size);
}

/* Returns the slot of a pair (position, id). If the pair is missing, returns the empty slot at which the search
 * ends. */
static uint32_t find_hash_slot(const octree_point *points, const double position[3], uint64_t id)
{
    const uint32_t *slots = hash_slots_of(points);
    const uint32_t mask = hashed_header_of(points)->mask;
    uint32_t slot = find_home_slot(points, position, id);
    for (; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &points[slots[slot] - 1];
        if (point->id == id && is_same_position(point->position, position))
            break;
    }
    return slot;
}

uint32_t leaf_find_hashed(const node *leaf, const double position[3], uint64_t id)
{
    const octree_point *points = leaf_points(leaf);
    return hash_slots_of(points)[find_hash_slot(points, position, id)] - 1;
}

/* Empty a slot of the hash table and close the gap. Each entry after the gap moves into the gap, unless the gap lies
 * before the slot to which the entry's hash value points. */
static void clear_slot(octree_point *points, uint32_t gap)
{
    uint32_t *slots = hash_slots_of(points);
    const uint32_t mask = hashed_header_of(points)->mask;
    for (uint32_t slot = (gap + 1) & mask; slots[slot]; slot = (slot + 1) & mask) {
        const octree_point *point = &points[slots[slot] - 1];
        const uint32_t home = find_home_slot(points, point->position, point->id);
        if (((slot - home) & mask) >= ((slot - gap) & mask)) {
            slots[gap] = slots[slot];
            gap = slot;
        }
    }
    slots[gap] = 0;
}

static void remove_from_hashed_leaf(octree_point *points, uint32_t count, uint32_t index)
{
    clear_slot(points, find_hash_slot(points, points[index].position, points[index].id));
    const uint32_t last = count - 1;
    if (index == last)
        return;
    const uint32_t slot = find_hash_slot(points, points[last].position, points[last].id);
    points[index] = points[last];
    hash_slots_of(points)[slot] = index + 1;
}

/* ---- Groups of nodes ---------------------------------------------------------------------------------------- */

static void forget_boxes(const store *s, const node *group, unsigned siblings)
{
    static const octree_box unknown = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    for (unsigned i = 0; has_boxes(s) && i < siblings; i++)
        boxes_of_group(group, siblings)[i] = unknown;
}

node *group_allocate(store *s, unsigned siblings)
{
    node *group = pool_allocate(&s->nodes, siblings);
    if (group)
        forget_boxes(s, group, siblings);
    return group;
}

void group_free(store *s, node *group, unsigned siblings)
{
    pool_free(&s->nodes, group, siblings);
}

node *group_copy_with_gap(store *s, const node *group, unsigned siblings, unsigned index)
{
    node *copy = group_allocate(s, siblings + 1);
    if (!copy)
        return NULL;
    memcpy(copy, group, index * sizeof(node));
    memcpy(copy + index + 1, group + index, (siblings - index) * sizeof(node));
    if (has_boxes(s)) {
        const octree_box *from = boxes_of_group(group, siblings);
        octree_box *to = boxes_of_group(copy, siblings + 1);
        memcpy(to, from, index * sizeof *to);
        memcpy(to + index + 1, from + index, (siblings - index) * sizeof *to);
    }
    return copy;
}

void group_remove(store *s, node *group, unsigned siblings, unsigned index)
{
    const octree_box *from = boxes_of_group(group, siblings);
    octree_box *to = boxes_of_group(group, siblings - 1);
    memmove(group + index, group + index + 1, (siblings - index - 1) * sizeof(node));
    if (has_boxes(s)) {
        memmove(to, from, index * sizeof *to);
        memmove(to + index, from + index + 1, (siblings - index - 1) * sizeof *to);
    }
    pool_free(&s->nodes, (char *)group + (siblings - 1) * s->nodes.unit, 1);
}

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

/* Returns the size, in points, of the block for `count` points. Sizes grow by about a quarter: 1 to 4, 6, 8, 12, 16 ...
 * 32, 40 ... 64. */
unsigned leaf_block_room(uint32_t count)
{
    const unsigned step = count <= 4 ? 1 : count <= 8 ? 2 : count <= 32 ? 4 : 8;
    return (count + step - 1) / step * step;
}

static bool is_hashed(const node *leaf)
{
    return leaf->room == LEAF_HASHED;
}

bool leaf_create(store *s, node *leaf, uint32_t count)
{
    *leaf = (node){0};
    if (count == 0)
        return true;
    if (count > POOL_MAX_UNITS) {
        leaf->below = create_hashed_block(&s->memory, count);
        leaf->room = LEAF_HASHED;
    } else {
        leaf->room = (uint8_t)leaf_block_room(count);
        leaf->below = pool_allocate(&s->points, leaf->room);
    }
    return leaf->below != NULL;
}

void leaf_release(store *s, const node *leaf)
{
    if (!leaf->below)
        return;
    if (is_hashed(leaf))
        release_hashed_block(&s->memory, leaf->below);
    else
        pool_free(&s->points, leaf->below, leaf->room);
}

static uint32_t current_block_room(const node *leaf)
{
    return is_hashed(leaf) ? hashed_header_of(leaf->below)->room : leaf->room;
}

static void append_points_of_leaf(node *leaf, const node *from, const octree_point *except)
{
    if (!except && !is_hashed(leaf) && from->count > 0) {
        memcpy(leaf_points(leaf) + leaf->count, leaf_points(from), from->count * sizeof(octree_point));
        leaf->count += from->count;
        return;
    }
    for (uint32_t i = 0; i < from->count; i++)
        if (&leaf_points(from)[i] != except)
            leaf_append_unchecked(leaf, &leaf_points(from)[i]);
}

void leaf_append_hashed(node *leaf, const octree_point *point)
{
    octree_point *points = leaf_points(leaf);
    points[leaf->count] = *point;
    hash_slots_of(points)[find_hash_slot(points, point->position, point->id)] = ++leaf->count;
}

/* Copy a leaf into a new block with room for `count` points. Returns false if memory runs out. */
static bool copy_leaf(store *s, const node *leaf, node *copy, uint32_t count)
{
    if (!leaf_create(s, copy, count))
        return false;
    append_points_of_leaf(copy, leaf, NULL);
    return true;
}

bool leaf_is_full(const node *leaf)
{
    return leaf->count == current_block_room(leaf);
}

bool leaf_copy_larger(store *s, const node *leaf, node *copy)
{
    /* A hashed leaf doubles its room, so that the cost of copying is O(1) per insertion, amortized. */
    /* unreachable: a test would need 2^31 points in one leaf, 64 GiB */
    const uint32_t doubled = leaf->count > UINT32_MAX / 2 ? UINT32_MAX : 2 * leaf->count;
    return copy_leaf(s, leaf, copy, leaf->count < POOL_MAX_UNITS ? leaf->count + 1 : doubled);
}

bool leaf_append(store *s, node *leaf, const octree_point *point)
{
    if (leaf_is_full(leaf)) {
        node larger;
        if (!leaf_copy_larger(s, leaf, &larger))
            return false;
        leaf_release(s, leaf);
        *leaf = larger;
    }
    leaf_append_unchecked(leaf, point);
    return true;
}

void leaf_remove_keeping_block(node *leaf, uint32_t index)
{
    if (is_hashed(leaf)) {
        remove_from_hashed_leaf(leaf->below, leaf->count--, index);
        return;
    }
    leaf_points(leaf)[index] = leaf_points(leaf)[--leaf->count];
    leaf->room = (uint8_t)leaf_block_room(leaf->count);
    if (leaf->room == 0)
        leaf->below = NULL;
}

void leaf_free_end(store *s, const node *old)
{
    const unsigned room = is_hashed(old) ? old->room : leaf_block_room(old->count - 1);
    if (room < old->room)
        pool_free(&s->points, leaf_points(old) + room, old->room - room);
}

void leaf_shrink_hash_table(store *s, node *leaf)
{
    node smaller;
    if (!is_hashed(leaf) || leaf->count >= hashed_header_of(leaf->below)->room / 4 ||
        !copy_leaf(s, leaf, &smaller, leaf->count))
        return;
    leaf_release(s, leaf);
    *leaf = smaller;
}

void leaf_remove(store *s, node *leaf, uint32_t index)
{
    const node old = *leaf;
    leaf_remove_keeping_block(leaf, index);
    leaf_free_end(s, &old);
    leaf_shrink_hash_table(s, leaf);
}

void leaf_replace(node *leaf, uint32_t index, const octree_point *point)
{
    if (!is_hashed(leaf)) {
        leaf_points(leaf)[index] = *point;
        return;
    }
    remove_from_hashed_leaf(leaf->below, leaf->count--, index);
    leaf_append_hashed(leaf, point);
}

void leaf_append_all(node *leaf, const node *from, const octree_point *except)
{
    const unsigned children = bits_count8(from->octants);
    for (unsigned i = children; i-- > 0;)
        leaf_append_all(leaf, &children_of(from)[i], except);
    if (children == 0)
        append_points_of_leaf(leaf, from, except);
}

octree_point *node_copy_points(const node *n, octree_point *to)
{
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++)
        to = node_copy_points(&children_of(n)[i], to);
    for (uint32_t i = 0; children == 0 && i < n->count; i++)
        *to++ = leaf_points(n)[i];
    return to;
}

void node_release_unshared(store *s, const node *n, const node *other)
{
    static const node none = {0};
    if (!n->below || n->below == other->below)
        return;
    if (n->octants == 0) {
        leaf_release(s, n);
        return;
    }
    const node *child = children_of(n);
    for (unsigned left = n->octants; left; left &= left - 1) {
        const unsigned octant = bits_lowest(left);
        const node *counterpart = child_at(other, octant);
        node_release_unshared(s, child++, counterpart ? counterpart : &none);
    }
    group_free(s, n->below, bits_count8(n->octants));
}

void node_release(store *s, const node *n)
{
    node_release_unshared(s, n, &(node){0});
}

void store_init(store *s, size_t node_size)
{
    pool_init(&s->nodes, &s->memory, node_size);
    pool_init(&s->points, &s->memory, sizeof(octree_point));
}

void store_expect_points(store *s, size_t count)
{
    /* a twelfth more, because most leaves have blocks with room for more points than they hold */
    s->points.expected = count + count / 12;
    s->nodes.expected = count / 16;
}

/* Free the hashed leaves below a node, which are not in the pools. */
static void release_hashed_leaves(store *s, const node *n)
{
    for (unsigned i = 0; n->below && i < bits_count8(n->octants); i++)
        release_hashed_leaves(s, &children_of(n)[i]);
    if (is_hashed(n))
        leaf_release(s, n);
}

/* The pools free whole slabs, so the points of leaves are not read. */
void store_release(store *s, const node *root)
{
    release_hashed_leaves(s, root);
    pool_release(&s->nodes);
    pool_release(&s->points);
}
