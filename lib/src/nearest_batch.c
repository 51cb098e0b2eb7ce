/* nearest_batch.c - the nearest points of many targets, asked in the order of the tree. */
#include "leaf.h"
#include "morton_sort.h"
#include "nearest.h"
#include "search.h"

static uint64_t code_near(const octree *tree, const double target[3])
{
    double inside[3];
    for (int i = 0; i < 3; i++)
        inside[i] = fmin(fmax(target[i], tree->axes[i].min), tree->axes[i].max);
    return morton_code(tree->axes, inside);
}

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

#define GROUP 16

/* Ask for the memory of the leaves that a few targets lie in, all at once and level by level: what one search after the
 * other would wait for is on its way for all of them. */
static void prefetch_leaves(const octree *tree, const morton_item *turns, size_t count)
{
    const node *at[GROUP];
    for (size_t i = 0; i < count; i++)
        at[i] = &tree->root;
    bool deeper = true;
    for (unsigned depth = 0; deeper; depth++) {
        deeper = false;
        for (size_t i = 0; i < count; i++) {
            const node *child = at[i]->octants ? child_at(at[i], morton_octant(turns[i].code, depth)) : NULL;
            if (!child)
                continue;
            at[i] = child;
            prefetch(child->below);
            deeper = true;
        }
    }
    for (size_t i = 0; i < count; i++)
        for (uint32_t next = 2; at[i]->octants == 0 && next < at[i]->count && next < POOL_MAX_UNITS; next += 2)
            prefetch(&leaf_points(at[i])[next]);
}

static void ask_in_turn(const octree *tree, const double (*targets)[3], const morton_item *turns, size_t count,
                        const octree_search *how, octree_neighbor *neighbors, bool *found)
{
    for (size_t i = 0; i < count; i++) {
        if (i % GROUP == 0)
            prefetch_leaves(tree, turns + i, count - i < GROUP ? count - i : GROUP);
        octree_neighbor nearest;
        const uint32_t place = turns[i].place;
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
    for (size_t i = 0; i < count; i++)
        turns[i] = (morton_item){code_near(tree, targets[i]), (uint32_t)i, false};
    morton_sort(turns, turns + count, count);
    ask_in_turn(tree, targets, turns, count, &search, neighbors, found);
    allocator->release(turns, size, allocator->context);
    return OCTREE_OK;
}
