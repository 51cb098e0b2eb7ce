/* region.c - see region.h. */
#include "region.h"
#include "leaf.h"
#include "search.h"

/* A node on the way, and the octants of its children that are still to come. */
typedef struct frame {
    const node *node;
    octree_address address;
    uint8_t coming, inside;
} frame;

/* Leaves wait until their points have come from memory; the way to the next ones is found meanwhile. */
#define WAITING 16

typedef struct descent {
    region *region;
    unsigned depth;
    frame frames[OCTREE_MAX_DEPTH + 1];
    unsigned came, went; /* leaves that began to wait, and that were scanned */
    const node *waiting[WAITING];
} descent;

static bool take_whole(region *r, const node *n, octree_address address)
{
    meter_trace(&r->meter, address, OCTREE_TOUCH_TAKEN);
    if (r->visit)
        return visit_all_below(n, &r->meter, r->visit, r->context);
    r->meter.count.nodes++;
    r->count += n->count;
    return true;
}

static bool scan_leaf(region *r, const node *leaf)
{
    uint8_t hits[REGION_SCAN];
    r->meter.count.leaves++;
    r->meter.count.points += leaf->count;
    for (uint32_t start = 0; start < leaf->count; start += REGION_SCAN) {
        const octree_point *points = leaf_points(leaf) + start;
        const uint32_t left = leaf->count - start;
        const unsigned found = r->scan(r->shape, points, left < REGION_SCAN ? left : REGION_SCAN, hits);
        r->count += found;
        for (unsigned i = 0; r->visit && i < found; i++)
            if (!r->visit(&points[hits[i]], r->context))
                return false;
    }
    return true;
}

static bool scan_next(descent *d)
{
    return scan_leaf(d->region, d->waiting[d->went++ % WAITING]);
}

static bool let_wait(descent *d, const node *leaf)
{
    const bool go_on = d->came - d->went < WAITING || scan_next(d);
    leaf_prefetch(leaf);
    d->waiting[d->came++ % WAITING] = leaf;
    return go_on;
}

/* The memory of all children is asked for at once. */
static void prefetch_children(const frame *f)
{
    for (unsigned coming = f->coming; coming; coming &= coming - 1)
        prefetch(child_at(f->node, bits_lowest(coming))->below);
}

static void open_node(descent *d, const node *n, octree_address address, unsigned octant)
{
    region *r = d->region;
    const octant_masks masks = r->enter(r->shape, r->tree, d->depth, octant);
    frame *f = &d->frames[++d->depth];
    *f = (frame){n, address, masks.meets & n->octants, masks.inside};
    prefetch_children(f);
    meter_prune(&r->meter, address, n->octants & ~masks.meets);
}

/* A node that the region meets. */
static bool look_at(descent *d, const node *n, octree_address address, unsigned octant, bool inside)
{
    if (inside)
        return take_whole(d->region, n, address);
    meter_visit(&d->region->meter, address);
    if (n->octants == 0)
        return let_wait(d, n);
    open_node(d, n, address, octant);
    return true;
}

void region_descend(region *r, octant_masks root)
{
    descent d;
    d.region = r;
    d.depth = d.came = d.went = 0;
    if (!(root.meets & 1)) {
        r->meter.count.pruned++;
        meter_trace(&r->meter, OCTREE_ROOT, OCTREE_TOUCH_PRUNED);
        return;
    }
    bool go_on = look_at(&d, &r->tree->root, OCTREE_ROOT, 0, root.inside & 1);
    while (go_on && d.depth > 0) {
        frame *f = &d.frames[d.depth];
        if (!f->coming) {
            d.depth--;
            continue;
        }
        const unsigned octant = bits_lowest(f->coming);
        f->coming &= (uint8_t)(f->coming - 1);
        go_on = look_at(&d, child_at(f->node, octant), f->address << 3 | octant, octant, f->inside >> octant & 1);
    }
    while (go_on && d.went < d.came)
        go_on = scan_next(&d);
}
