/* leaf.c - see leaf.h. */
#include "leaf.h"

#include <string.h>

/* Rooms grow by about a quarter: 1, 2, 3, 4, 6, 8, 12, 16, 20, 24, 28, 32, 40 ... 64. */
static unsigned room_for(uint32_t count)
{
    const unsigned step = count <= 4 ? 1 : count <= 8 ? 2 : count <= 32 ? 4 : 8;
    return (count + step - 1) / step * step;
}

static bool is_crowd(const node *leaf)
{
    return leaf->room == LEAF_CROWD;
}

uint32_t leaf_find(const node *leaf, const double position[3], uint64_t id)
{
    const octree_point *points = leaf_points(leaf);
    if (is_crowd(leaf))
        return crowd_find(points, position, id);
    for (uint32_t i = 0; i < leaf->count; i++)
        if (points[i].id == id && same_position(points[i].position, position))
            return i;
    return LEAF_NONE;
}

bool leaf_create(octree *tree, node *leaf, uint32_t count)
{
    *leaf = (node){0};
    if (count == 0)
        return true;
    if (count > POOL_MAX_UNITS) {
        leaf->below = crowd_create(&tree->memory, count);
        leaf->room = LEAF_CROWD;
    } else {
        leaf->room = (uint8_t)room_for(count);
        leaf->below = pool_take(&tree->points, leaf->room);
    }
    return leaf->below != NULL;
}

void leaf_release(octree *tree, node *leaf)
{
    if (!leaf->below)
        return;
    if (is_crowd(leaf))
        crowd_release(&tree->memory, leaf->below);
    else
        pool_give(&tree->points, leaf->below, leaf->room);
    leaf->below = NULL;
}

static uint32_t room_of(const node *leaf)
{
    return is_crowd(leaf) ? crowd_room(leaf->below) : leaf->room;
}

/* Move the points into a block with room for `count`. */
static bool change_room(octree *tree, node *leaf, uint32_t count)
{
    node moved;
    if (!leaf_create(tree, &moved, count))
        return false;
    if (is_crowd(&moved)) {
        for (uint32_t i = 0; i < leaf->count; i++)
            leaf_put(&moved, &leaf_points(leaf)[i]);
    } else {
        memcpy(moved.below, leaf->below, leaf->count * sizeof(octree_point));
        moved.count = leaf->count;
    }
    leaf_release(tree, leaf);
    *leaf = moved;
    return true;
}

bool leaf_append(octree *tree, node *leaf, const octree_point *point)
{
    if (leaf->count == 0 && !leaf->below) {
        if (!leaf_create(tree, leaf, 1)) {
            *leaf = (node){0};
            return false;
        }
    } else if (leaf->count == room_of(leaf)) {
        /* A crowd doubles: what it copies is then linear in what was inserted. */
        const uint32_t doubled = leaf->count > UINT32_MAX / 2 ? UINT32_MAX : 2 * leaf->count;
        if (!change_room(tree, leaf, leaf->count < POOL_MAX_UNITS ? leaf->count + 1 : doubled))
            return false;
    }
    leaf_put(leaf, point);
    return true;
}

void leaf_take(octree *tree, node *leaf, uint32_t index)
{
    if (is_crowd(leaf)) {
        crowd_take(leaf->below, leaf->count, index);
        leaf->count--;
        if (leaf->count < crowd_room(leaf->below) / 4)
            change_room(tree, leaf, leaf->count); /* without memory it stays roomy */
        return;
    }
    octree_point *points = leaf_points(leaf);
    leaf->count--;
    points[index] = points[leaf->count];
    const unsigned room = room_for(leaf->count);
    pool_give(&tree->points, points + room, leaf->room - room);
    leaf->room = (uint8_t)room;
    if (room == 0)
        leaf->below = NULL;
}

void leaf_replace(node *leaf, uint32_t index, const octree_point *point)
{
    if (is_crowd(leaf))
        crowd_replace(leaf->below, index, point);
    else
        leaf_points(leaf)[index] = *point;
}

void leaf_gather(node *leaf, const node *from, const octree_point *left_out)
{
    const node *pending[STACK_ROOM];
    size_t size = 0;
    pending[size++] = from;
    while (size > 0) {
        const node *next = pending[--size];
        const unsigned children = bits_count8(next->octants);
        for (unsigned i = 0; i < children; i++)
            pending[size++] = &children_of(next)[i];
        for (uint32_t i = 0; children == 0 && i < next->count; i++)
            if (&leaf_points(next)[i] != left_out)
                leaf_put(leaf, &leaf_points(next)[i]);
    }
}
