#include "leaf.h"
#include "point.h"

#include <string.h>

/* Room grows by about a quarter: 1, 2, 3, 4, 6, 8, 12, 16, 20, 24, 28, 32, 40 ... 64. */
static unsigned room_for(uint32_t count)
{
    const unsigned step = count <= 4 ? 1 : count <= 8 ? 2 : count <= 32 ? 4 : 8;
    return (count + step - 1) / step * step;
}

static bool is_hashed(const node *leaf)
{
    return leaf->room == LEAF_HASHED;
}

uint32_t leaf_find(const node *leaf, const double position[3], uint64_t id)
{
    const octree_point *points = leaf_points(leaf);
    if (is_hashed(leaf))
        return hashed_leaf_find(points, position, id);
    for (uint32_t i = 0; i < leaf->count; i++)
        if (points[i].id == id && same_position(points[i].position, position))
            return i;
    return LEAF_NONE;
}

bool leaf_create(store *s, node *leaf, uint32_t count)
{
    *leaf = (node){0};
    if (count == 0)
        return true;
    if (count > POOL_MAX_UNITS) {
        leaf->below = hashed_leaf_create(&s->memory, count);
        leaf->room = LEAF_HASHED;
    } else {
        leaf->room = (uint8_t)room_for(count);
        leaf->below = pool_take(&s->points, leaf->room);
    }
    return leaf->below != NULL;
}

void leaf_release(store *s, const node *leaf)
{
    if (!leaf->below)
        return;
    if (is_hashed(leaf))
        hashed_leaf_release(&s->memory, leaf->below);
    else
        pool_give(&s->points, leaf->below, leaf->room);
}

static uint32_t room_of(const node *leaf)
{
    return is_hashed(leaf) ? hashed_leaf_room(leaf->below) : leaf->room;
}

static void gather_leaf(node *leaf, const node *from, const octree_point *except)
{
    if (!except && !is_hashed(leaf) && from->count > 0) {
        memcpy(leaf_points(leaf) + leaf->count, leaf_points(from), from->count * sizeof(octree_point));
        leaf->count += from->count;
        return;
    }
    for (uint32_t i = 0; i < from->count; i++)
        if (&leaf_points(from)[i] != except)
            leaf_put(leaf, &leaf_points(from)[i]);
}

/* Move the points into a block with room for `count`. */
static bool change_room(store *s, node *leaf, uint32_t count)
{
    node moved;
    if (!leaf_create(s, &moved, count))
        return false;
    gather_leaf(&moved, leaf, NULL);
    leaf_release(s, leaf);
    *leaf = moved;
    return true;
}

bool leaf_append(store *s, node *leaf, const octree_point *point)
{
    if (leaf->count == room_of(leaf)) {
        /* A hashed leaf doubles, so that copying is linear in the number of insertions. */
        const uint32_t doubled = leaf->count > UINT32_MAX / 2 ? UINT32_MAX : 2 * leaf->count;
        if (!change_room(s, leaf, leaf->count < POOL_MAX_UNITS ? leaf->count + 1 : doubled))
            return false;
    }
    leaf_put(leaf, point);
    return true;
}

void leaf_remove(store *s, node *leaf, uint32_t index)
{
    if (is_hashed(leaf)) {
        hashed_leaf_remove(leaf->below, leaf->count, index);
        leaf->count--;
        if (leaf->count < hashed_leaf_room(leaf->below) / 4)
            change_room(s, leaf, leaf->count); /* without memory it keeps its room */
        return;
    }
    octree_point *points = leaf_points(leaf);
    leaf->count--;
    points[index] = points[leaf->count];
    const unsigned room = room_for(leaf->count);
    pool_give(&s->points, points + room, leaf->room - room);
    leaf->room = (uint8_t)room;
    if (room == 0)
        leaf->below = NULL;
}

void leaf_replace(node *leaf, uint32_t index, const octree_point *point)
{
    if (is_hashed(leaf))
        hashed_leaf_replace(leaf->below, index, point);
    else
        leaf_points(leaf)[index] = *point;
}

void node_gather(node *leaf, const node *from, const octree_point *except)
{
    const unsigned children = bits_count8(from->octants);
    for (unsigned i = children; i-- > 0;)
        node_gather(leaf, &children_of(from)[i], except);
    if (children == 0)
        gather_leaf(leaf, from, except);
}

octree_point *node_copy_points(const node *n, octree_point *to, const octree_point *end)
{
    const unsigned children = bits_count8(n->octants);
    for (unsigned i = 0; i < children; i++)
        to = node_copy_points(&children_of(n)[i], to, end);
    for (uint32_t i = 0; children == 0 && i < n->count && to < end; i++)
        *to++ = leaf_points(n)[i];
    return to;
}

void node_release_unshared(store *s, const node *n, const node *other)
{
    static const node none = {0};
    if (!n->below || n->below == other->below)
        return;
    const node *child = children_of(n);
    for (unsigned octant = 0; octant < 8; octant++) {
        if (!(n->octants >> octant & 1))
            continue;
        const node *counterpart = child_at(other, octant);
        node_release_unshared(s, child++, counterpart ? counterpart : &none);
    }
    if (n->octants)
        pool_give(&s->nodes, n->below, bits_count8(n->octants));
    else
        leaf_release(s, n);
}

void node_release(store *s, const node *n)
{
    node_release_unshared(s, n, &(node){0});
}
