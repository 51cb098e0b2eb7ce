/* rebuild.c - the same points in another world, or with another capacity. */
#include "rebuild.h"
#include "leaf.h"

#include <string.h>

/* Copy every point, leaf by leaf. Children are pushed so that leaves come in the order of their addresses. */
static void copy_all(const octree *tree, octree_point *points)
{
    const node *pending[STACK_ROOM];
    size_t size = 0;
    pending[size++] = &tree->root;
    while (size > 0) {
        const node *next = pending[--size];
        for (unsigned i = bits_count8(next->octants); i-- > 0;)
            pending[size++] = &children_of(next)[i];
        if (next->octants || next->count == 0)
            continue;
        memcpy(points, leaf_points(next), next->count * sizeof *points);
        points += next->count;
    }
}

/* Insert all into an empty tree, or say why one of them does not fit. */
static octree_status fill(octree *tree, const octree_point *points, size_t count)
{
    size_t inserted;
    for (size_t i = 0; i < count; i++)
        if (check_position(tree, points[i].position) != OCTREE_OK)
            return OCTREE_OUTSIDE;
    const octree_status status = octree_insert_many(tree, points, count, NULL, &inserted);
    return status == OCTREE_OK && inserted < count ? OCTREE_FULL : status;
}

/* Let two trees of one allocator change places; their pools point back to them. */
static void exchange(octree *a, octree *b)
{
    const octree kept = *a;
    *a = *b;
    *b = kept;
    a->nodes.memory = a->points.memory = &a->memory;
    b->nodes.memory = b->points.memory = &b->memory;
}

octree_status rebuild(octree *tree, const octree_def *def)
{
    octree *other;
    octree_status status = octree_create(def, &other);
    if (status != OCTREE_OK)
        return status;
    const size_t size = (octree_count(tree) + 1) * sizeof(octree_point);
    octree_point *points = arena_take(&other->memory, size);
    status = OCTREE_NO_MEMORY;
    if (points) {
        copy_all(tree, points);
        status = fill(other, points, octree_count(tree));
    }
    arena_give(&other->memory, points, size);
    if (status == OCTREE_OK) {
        exchange(tree, other);
        tree->version = other->version + 1;
        tree->tuning = other->tuning;
    }
    octree_destroy(other);
    return status;
}

octree_status octree_reworld(octree *tree, const octree_box *world)
{
    if (!tree || !world)
        return OCTREE_NULL_ARGUMENT;
    octree_def def = tree->def;
    def.world = *world;
    return rebuild(tree, &def);
}

octree_status octree_compact(octree *tree)
{
    return tree ? rebuild(tree, &tree->def) : OCTREE_NULL_ARGUMENT;
}
