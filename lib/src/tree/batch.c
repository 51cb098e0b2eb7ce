/* batch.c - see batch.h. */
#include "bulk.h"
#include "float_mode.h"

static void *take_array(octree *tree, size_t count, size_t size)
{
    return count <= SIZE_MAX / size ? arena_take(&tree->memory, (count ? count : 1) * size) : NULL;
}

static void give_array(octree *tree, void *array, size_t count, size_t size)
{
    arena_give(&tree->memory, array, (count ? count : 1) * size);
}

static bool sort_items(batch *b)
{
    morton_item *spare = take_array(b->tree, b->room, sizeof *spare);
    if (!spare)
        return false;
    const size_t loose = b->tree->root.count > 0 ? 0 : batch_loose(b->tree); /* its nodes part what leaves would hold */
    b->repeated = morton_sort(b->items, spare, b->count, 0, loose);
    give_array(b->tree, spare, b->room, sizeof *spare);
    return true;
}

static void collect(batch *b)
{
    const octree_box world = b->tree->def.world;
    for (size_t i = 0; i < b->point_count; i++) {
        const double *position = b->points[i].position;
        const octree_status status = box_contains(&world, position) ? OCTREE_OK : check_position(b->tree, position);
        if (status == OCTREE_OK)
            b->items[b->count++] = (morton_item){morton_code(b->tree->axes, position), (uint32_t)i, false};
        if (b->statuses)
            b->statuses[i] = status;
    }
}

octree_status batch_begin(batch *b, octree *tree, const octree_point *points, size_t count, octree_status *statuses)
{
    *b = (batch){.tree = tree, .points = points, .statuses = statuses, .point_count = count, .room = count};
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (count >= UINT32_MAX)
        return OCTREE_TOO_MANY;
    b->items = take_array(tree, count, sizeof *b->items);
    if (!b->items)
        return OCTREE_NO_MEMORY;
    collect(b);
    return sort_items(b) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

void batch_end(batch *b)
{
    give_array(b->tree, b->items, b->room, sizeof *b->items);
}

size_t batch_share(const morton_item *items, size_t count, unsigned depth)
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
