/* nearest_batch.c - the nearest points of many targets, asked in the order of the tree. */
#include "morton_sort.h"
#include "nearest.h"
#include "search.h"

static octree_status check_batch(const octree *tree, const double (*targets)[3], size_t count, const octree_search *how,
                                 const octree_neighbor *neighbors)
{
    if (!tree || ((!targets || !neighbors) && count))
        return OCTREE_NULL_ARGUMENT;
    if (count > UINT32_MAX)
        return OCTREE_TOO_MANY;
    octree_status status = check_search(how);
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = check_finite(targets[i]);
    return status;
}

#define AHEAD 4 /* the caller's arrays are read and written in the order of the tree: so many turns ahead */

static void ask_in_turn(const octree *tree, const double (*targets)[3], const morton_item *turns, size_t count,
                        const octree_search *how, octree_neighbor *neighbors, bool *found)
{
    for (size_t i = 0; i < count; i++) {
        octree_neighbor nearest;
        const uint32_t place = turns[i].place;
        if (i + AHEAD < count) {
            prefetch(&targets[turns[i + AHEAD].place]);
            prefetch(&neighbors[turns[i + AHEAD].place]);
        }
        const bool one = nearest_search(tree, targets[place], 1, -1, how, &nearest) == 1;
        if (one)
            neighbors[place] = nearest;
        if (found)
            found[place] = one;
    }
}

octree_status octree_nearest_batch(const octree *tree, const double (*targets)[3], size_t count,
                                   const octree_search *how, octree_neighbor *neighbors, bool *found)
{
    const octree_search search = search_or_default(how);
    const octree_status status = check_batch(tree, targets, count, &search, neighbors);
    if (status != OCTREE_OK || count == 0)
        return status;
    /* The tree's own allocator, but not its books: queries change nothing of the tree. */
    const octree_allocator *allocator = &tree->def.allocator;
    const size_t size = count <= SIZE_MAX / 2 / sizeof(morton_item) ? 2 * count * sizeof(morton_item) : SIZE_MAX;
    morton_item *turns = size < SIZE_MAX ? allocator->allocate(size, allocator->context) : NULL;
    if (!turns)
        return OCTREE_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        uint32_t keys[3];
        nearest_keys(tree, targets[i], keys);
        turns[i] = (morton_item){morton_interleave(keys), (uint32_t)i, false};
    }
    morton_sort(turns, turns + count, count, 0, 0);
    ask_in_turn(tree, targets, turns, count, &search, neighbors, found);
    allocator->release(turns, size, allocator->context);
    return OCTREE_OK;
}
