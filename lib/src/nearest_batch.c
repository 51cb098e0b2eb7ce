/* nearest_batch.c - the nearest points of many targets, asked in the order of the tree. */
#include "search.h"

#include <stdlib.h>

/* A target, by where it lies in the world, or by the nearest place of the world to it. */
typedef struct turn {
    uint64_t code;
    uint32_t place;
} turn;

static int by_code(const void *a, const void *b)
{
    const turn *p = a, *q = b;
    return p->code != q->code ? (p->code > q->code) - (p->code < q->code)
                              : (p->place > q->place) - (p->place < q->place);
}

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

static void ask_in_turn(const octree *tree, const double (*targets)[3], const turn *turns, size_t count,
                        const octree_search *how, octree_neighbor *neighbors, bool *found)
{
    for (size_t i = 0; i < count; i++) {
        size_t one;
        octree_neighbor nearest;
        octree_nearest_k(tree, targets[turns[i].place], 1, how, &nearest, &one);
        if (one)
            neighbors[turns[i].place] = nearest;
        if (found)
            found[turns[i].place] = one;
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
    turn *turns =
        count <= SIZE_MAX / sizeof *turns ? allocator->allocate(count * sizeof *turns, allocator->context) : NULL;
    if (!turns)
        return OCTREE_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        turns[i] = (turn){code_near(tree, targets[i]), (uint32_t)i};
    qsort(turns, count, sizeof *turns, by_code);
    ask_in_turn(tree, targets, turns, count, &search, neighbors, found);
    allocator->release(turns, count * sizeof *turns, allocator->context);
    return OCTREE_OK;
}
