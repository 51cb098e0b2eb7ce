/* batch.c - see batch.h. */
#include "batch.h"
#include "float_mode.h"

#include <string.h>

#define DIGIT_BITS 11
#define DIGITS (1u << DIGIT_BITS)
#define PASSES 6 /* 63 bits */

static void *take_array(octree *tree, size_t count, size_t size)
{
    return count <= SIZE_MAX / size ? arena_take(&tree->memory, (count ? count : 1) * size) : NULL;
}

static void give_array(octree *tree, void *array, size_t count, size_t size)
{
    arena_give(&tree->memory, array, (count ? count : 1) * size);
}

/* One pass of a radix sort, least digit first: stable. False when all items have the same digit. */
static bool sort_pass(const batch_item *from, batch_item *to, size_t count, unsigned shift)
{
    size_t starts[DIGITS] = {0};
    for (size_t i = 0; i < count; i++)
        starts[from[i].code >> shift & (DIGITS - 1)]++;
    if (count == 0 || starts[from[0].code >> shift & (DIGITS - 1)] == count)
        return false;
    size_t next = 0;
    for (size_t digit = 0; digit < DIGITS; digit++) {
        const size_t here = starts[digit];
        starts[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[starts[from[i].code >> shift & (DIGITS - 1)]++] = from[i];
    return true;
}

static bool sort_items(batch *b)
{
    batch_item *other = take_array(b->tree, b->room, sizeof *other);
    if (!other)
        return false;
    for (unsigned pass = 0; pass < PASSES; pass++) {
        if (sort_pass(b->items, other, b->count, pass * DIGIT_BITS)) {
            batch_item *sorted = other;
            other = b->items;
            b->items = sorted;
        }
    }
    give_array(b->tree, other, b->room, sizeof *other);
    return true;
}

static void collect(batch *b)
{
    for (size_t i = 0; i < b->point_count; i++) {
        b->statuses[i] = check_position(b->tree, b->points[i].position);
        if (b->statuses[i] == OCTREE_OK)
            b->items[b->count++] =
                (batch_item){morton_code(b->tree->axes, b->points[i].position), &b->points[i], (uint32_t)i};
    }
}

octree_status batch_begin(batch *b, octree *tree, const octree_point *points, size_t count, octree_status *statuses)
{
    *b = (batch){.tree = tree, .points = points, .statuses = statuses, .point_count = count, .room = count};
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (count >= BATCH_STORED)
        return OCTREE_TOO_MANY;
    b->items = take_array(tree, count, sizeof *b->items);
    if (!statuses) {
        b->owns_statuses = true;
        b->statuses = take_array(tree, count, sizeof *b->statuses);
    }
    if (!b->items || !b->statuses)
        return OCTREE_NO_MEMORY;
    collect(b);
    return sort_items(b) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

void batch_end(batch *b)
{
    give_array(b->tree, b->items, b->room, sizeof *b->items);
    if (b->owns_statuses)
        give_array(b->tree, b->statuses, b->point_count, sizeof *b->statuses);
}

size_t batch_done(const batch *b)
{
    size_t done = 0;
    for (size_t i = 0; i < b->point_count; i++)
        done += b->statuses[i] == OCTREE_OK;
    return done;
}

size_t batch_share(const batch_item *items, size_t count, unsigned depth)
{
    const unsigned octant = morton_octant(items[0].code, depth);
    size_t low = 1, high = count; /* the first that lies elsewhere is in [low, high] */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (morton_octant(items[middle].code, depth) == octant)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}
