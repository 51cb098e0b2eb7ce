/* SPDX-License-Identifier: MIT */
/* region.c - the traversal that visits the points of a region, and the shape of a closed box. */
#include "region.h"
#include "../tree/leaf.h"

/* An inner node on the path of the current descent. */
typedef struct frame {
    const node *node;
    octree_address address;
    uint8_t pending; /* bit mask of the octants whose children are not visited yet */
    uint8_t inside;  /* bit mask of the octants that lie within the region */
} frame;

typedef struct descent {
    region *region;
    unsigned depth;
    frame frames[OCTREE_MAX_DEPTH + 1];
    leaf_queue leaves;
} descent;

/* Visit every point in and below a node. Returns false if the visitor stopped the search. */
static bool visit_points_below(region *r, const node *n)
{
    const unsigned children = bits_count8(n->octants);
    const node *child = children_of(n);
    for (unsigned i = 0; i < children; i++)
        prefetch_memory(child[i].below);
    for (unsigned i = 0; i < children; i++)
        if (!visit_points_below(r, &child[i]))
            return false;
    for (uint32_t i = 0; children == 0 && i < n->count; i++)
        if (!r->visit(&leaf_points(n)[i], r->context))
            return false;
    return true;
}

static bool visit_whole_node(region *r, const node *n, octree_address address)
{
    meter_record_taken(&r->meter, address);
    if (r->visit)
        return visit_points_below(r, n);
    r->count += n->count;
    return true;
}

static bool scan_leaf(region *r, const node *leaf)
{
    r->meter.count.leaves++;
    r->meter.count.points += leaf->count;
    for (uint32_t start = 0; start < leaf->count; start += SCAN_POINTS) {
        const octree_point *points = leaf_points(leaf) + start;
        uint64_t found = r->scan(r->shape, points, count_scanned(leaf, start));
        if (!r->visit)
            r->count += bits_count(found);
        for (; r->visit && found; found &= found - 1)
            if (!r->visit(&points[bits_lowest(found)], r->context))
                return false;
    }
    return true;
}

static bool queue_leaf(descent *d, const node *leaf)
{
    const bool going = !leaf_queue_is_full(&d->leaves) || scan_leaf(d->region, leaf_queue_remove(&d->leaves));
    leaf_queue_add(&d->leaves, leaf);
    return going;
}

static void prefetch_children(const frame *f)
{
    for (unsigned pending = f->pending; pending; pending &= pending - 1)
        prefetch_memory(child_at(f->node, bits_lowest(pending))->below);
}

static void enter_inner_node(descent *d, const node *n, octree_address address, unsigned octant)
{
    region *r = d->region;
    const octant_masks masks = r->enter(r->shape, r->tree, d->depth, octant);
    frame *f = &d->frames[++d->depth];
    *f = (frame){n, address, masks.meets & n->octants, masks.inside};
    prefetch_children(f);
    meter_record_pruned(&r->meter, address, n->octants & ~masks.meets);
}

/* Visit a node that meets the region. Returns false if the visitor stopped the search. */
static bool visit_node(descent *d, const node *n, octree_address address, unsigned octant, bool inside)
{
    if (inside)
        return visit_whole_node(d->region, n, address);
    meter_record_visited(&d->region->meter, address);
    if (n->octants == 0)
        return queue_leaf(d, n);
    enter_inner_node(d, n, address, octant);
    return true;
}

static void descend_from_root(region *r, octant_masks root)
{
    descent d;
    d.region = r;
    d.depth = d.leaves.added = d.leaves.removed = 0;
    bool going = visit_node(&d, &r->tree->root, OCTREE_ROOT, 0, root.inside & 1);
    while (going && d.depth > 0) {
        frame *f = &d.frames[d.depth];
        if (!f->pending) {
            d.depth--;
            continue;
        }
        const unsigned octant = bits_lowest(f->pending);
        f->pending &= (uint8_t)(f->pending - 1);
        going = visit_node(&d, child_at(f->node, octant), f->address << 3 | octant, octant, f->inside >> octant & 1);
    }
    while (going && d.leaves.removed < d.leaves.added)
        going = scan_leaf(r, leaf_queue_remove(&d.leaves));
}

void region_search(region *r, octant_masks root)
{
    const unsigned begun = begin_callbacks(r->tree);
    if (root.meets & 1)
        descend_from_root(r, root);
    else
        meter_record_pruned_root(&r->meter);
    end_callbacks(begun);
    meter_add_to_cost(&r->meter);
}

/* ---- A closed box ------------------------------------------------------------------------------------------- */

static key_box find_box_keys(const octree *tree, const octree_box *box)
{
    key_box keys;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        keys.min[i] = box->min[i] > a->min ? (int32_t)plane_key(a, fmin(box->min[i], a->max)) : -1;
        keys.max[i] = box->max[i] < a->max ? (int32_t)plane_key(a, fmax(box->max[i], a->min)) : (int32_t)PLANE_GRID;
    }
    return keys;
}

/* Returns the keys of `box`, adjusted for cells: a cell lies inside `box` if all keys of the cell are strictly between
 * the adjusted keys. On an axis where the lower face of `box` is a grid plane, the cell that begins at this plane is
 * inside, so the key is lowered by 1. */
static key_box find_enclosing_keys(const octree *tree, const octree_box *box, key_box keys)
{
    for (int i = 0; i < 3; i++)
        keys.min[i] -= keys.min[i] >= 0 && plane_at(&tree->axes[i], (uint32_t)keys.min[i]) == box->min[i];
    return keys;
}

box_shape box_shape_make(const octree *tree, const octree_box *box, const octree_box *whole)
{
    box_shape s;
    s.box = box;
    s.near = find_box_keys(tree, box);
    s.whole = find_enclosing_keys(tree, whole, whole == box ? s.near : find_box_keys(tree, whole));
    return s;
}

static bool is_outside_world(const octree *tree, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < tree->axes[i].min || box->min[i] > tree->axes[i].max)
            return true;
    return false;
}

octant_masks box_shape_root(const box_shape *s, const octree *tree)
{
    octant_masks root = {1, 1};
    if (is_outside_world(tree, s->box))
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
        /* The node's cell meets the box, so only the cell's middle plane decides which octants meet the box. */
        meets &= mask_if(s->near.min[i] < middle, below) | mask_if(middle <= s->near.max[i], above);
        inside &= (mask_if(s->whole.min[i] < low, below) & mask_if(middle <= s->whole.max[i], below)) |
                  (mask_if(s->whole.min[i] < middle, above) & mask_if(high <= s->whole.max[i], above));
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

#ifdef OCTREE_SSE2
/* A box with each bound stored twice, to compare two points at once. */
typedef struct twin_box {
    __m128d min[3], max[3];
} twin_box;

/* Returns a mask of two bits, one for each point: the bit is set if the point is in the box. */
static inline uint64_t scan_point_pair(const twin_box *box, const double a[3], const double b[3])
{
    const __m128d xy_a = _mm_loadu_pd(a), xy_b = _mm_loadu_pd(b);
    const __m128d at[3] = {_mm_unpacklo_pd(xy_a, xy_b), _mm_unpackhi_pd(xy_a, xy_b),
                           _mm_loadh_pd(_mm_load_sd(&a[2]), &b[2])};
    __m128d inside = _mm_cmple_pd(box->min[0], at[0]);
    for (int i = 0; i < 3; i++) {
        inside = _mm_and_pd(inside, _mm_cmple_pd(box->min[i], at[i]));
        inside = _mm_and_pd(inside, _mm_cmple_pd(at[i], box->max[i]));
    }
    return (uint64_t)_mm_movemask_pd(inside);
}

/* Returns a bit mask of the points in the box. Points are compared in pairs; if the count is odd, the last pair
 * overlaps the previous pair, so that no branch depends on the parity. */
static uint64_t scan_points_in_pairs(const octree_box *box, const octree_point *points, unsigned count)
{
    twin_box twin;
    uint64_t found = 0;
    for (int i = 0; i < 3; i++) {
        twin.min[i] = _mm_set1_pd(box->min[i]);
        twin.max[i] = _mm_set1_pd(box->max[i]);
    }
    for (unsigned i = 0; i < count - 2; i += 2)
        found |= scan_point_pair(&twin, points[i].position, points[i + 1].position) << i;
    return found | scan_point_pair(&twin, points[count - 2].position, points[count - 1].position) << (count - 2);
}
#endif

uint64_t box_shape_scan(const void *shape, const octree_point *points, unsigned count)
{
    const octree_box *box = ((const box_shape *)shape)->box;
    uint64_t found = 0;
#ifdef OCTREE_SSE2
    if (count > 1)
        return scan_points_in_pairs(box, points, count);
#endif
    for (unsigned i = 0; i < count; i++)
        found |= (uint64_t)box_contains(box, points[i].position) << i;
    return found;
}
