/* box_shape.c - see box_shape.h. */
#include "box_shape.h"

#include <math.h>

static key_box box_keys(const octree *tree, const octree_box *box)
{
    key_box keys;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys.min[i] = box->min[i] > a->min ? (int32_t)plane_key(a, fmin(box->min[i], a->max)) : -1;
        keys.max[i] = box->max[i] < a->max ? (int32_t)plane_key(a, fmax(box->max[i], a->min)) : (int32_t)PLANE_GRID;
    }
    return keys;
}

box_shape box_shape_make(const octree *tree, const octree_box *box, const octree_box *whole)
{
    box_shape s;
    s.box = box;
    s.near = box_keys(tree, box);
    s.whole = whole == box ? s.near : box_keys(tree, whole);
    return s;
}

static bool misses_world(const octree *tree, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < tree->axes[i].min || box->min[i] > tree->axes[i].max)
            return true;
    return false;
}

octant_masks box_shape_root(const box_shape *s, const octree *tree)
{
    octant_masks root = {1, 1};
    if (misses_world(tree, s->box))
        return (octant_masks){0, 0};
    for (int i = 0; i < 3; i++)
        if (s->whole.min[i] >= 0 || s->whole.max[i] < (int32_t)PLANE_GRID)
            root.inside = 0;
    return root;
}

octant_masks box_shape_enter(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    (void)tree;
    box_shape *s = shape;
    const int32_t size = (int32_t)cell_size(depth), half = size / 2;
    unsigned meets = 0xff, inside = 0xff;
    for (int i = 0; i < 3; i++) {
        const int32_t low = depth == 0 ? 0 : s->low[depth - 1][i] + (octant & (4u >> i) ? size : 0);
        const int32_t middle = low + half, high = low + size;
        const uint8_t below = octants_beside[i][0], above = octants_beside[i][1];
        s->low[depth][i] = low;
        meets &= bits_if(s->near.min[i] < middle && low <= s->near.max[i], below) |
                 bits_if(s->near.min[i] < high && middle <= s->near.max[i], above);
        inside &= bits_if(s->whole.min[i] < low && middle <= s->whole.max[i], below) |
                  bits_if(s->whole.min[i] < middle && high <= s->whole.max[i], above);
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

unsigned box_shape_scan(const void *shape, const octree_point *points, unsigned count, uint8_t hits[])
{
    const octree_box box = *((const box_shape *)shape)->box;
    unsigned found = 0;
    for (unsigned i = 0; i < count; i++) {
        hits[found] = (uint8_t)i;
        found += box_contains(&box, points[i].position);
    }
    return found;
}
