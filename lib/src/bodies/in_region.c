/* SPDX-License-Identifier: MIT */
/* in_region.c - the bodies that match a region: octree_bodies_search().
 *
 * Each level is searched by itself. Nodes whose boxes cannot meet the region are pruned, and nodes whose boxes are
 * certainly in it are taken whole. The bodies of the remaining leaves are filtered, and those for which that is not
 * decisive are tested exactly.
 */
#include "shape.h"
#include "visit.h"

typedef struct body_search {
    shape shape;
    const octree_bodies *set;
    bool contained;
    const octree_search *how;
    octree_body_visitor visit;
    void *context;
    bool stopped; /* the visitor stopped the search */
    meter meter;
    leaf_queue leaves;
} body_search;

static bool is_match(const body_search *s, const octree_body *body)
{
    const shape_kind *kind = s->shape.kind;
    return s->contained ? kind->contains(&s->shape, body) : kind->meets(&s->shape, body);
}

/* ---- Bodies ------------------------------------------------------------------------------------------------- */

/* Returns a bit mask of the bodies that match, of at most SCAN_POINTS points. */
static uint64_t scan_bodies(const body_search *s, const octree_point *points, unsigned count)
{
    const body_masks masks = s->shape.kind->filter(&s->shape, points, count);
    uint64_t found = s->contained ? 0 : masks.sure;
    prefetch_bodies(s->set, points, masks.near);
    for (uint64_t left = masks.near & ~found; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        octree_body scratch;
        found |= (uint64_t)is_match(s, load_body(s->set, &points[i], &scratch)) << i;
    }
    return found;
}

/* Visit the bodies of some of 64 points, given as a bit mask. Returns false if the visitor stopped the search. */
static bool visit_bodies(body_search *s, const octree_point *points, uint64_t found)
{
    for (; found; found &= found - 1) {
        octree_body scratch;
        const octree_body *body = load_body(s->set, &points[bits_lowest(found)], &scratch);
        if (!is_skipped(s->how, body, NULL) && !s->visit(body, s->context)) {
            s->stopped = true;
            return false;
        }
    }
    return true;
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

static bool scan_leaf(body_search *s, const node *leaf)
{
    s->meter.count.leaves++;
    s->meter.count.points += leaf->count;
    for (uint32_t i = 0; i < leaf->count; i += SCAN_POINTS) {
        const octree_point *points = leaf_points(leaf) + i;
        if (!visit_bodies(s, points, scan_bodies(s, points, count_scanned(leaf, i))))
            return false;
    }
    return true;
}

static bool queue_leaf(body_search *s, const node *leaf)
{
    const bool going = !leaf_queue_is_full(&s->leaves) || scan_leaf(s, leaf_queue_remove(&s->leaves));
    leaf_queue_add(&s->leaves, leaf);
    return going;
}

static bool visit_bodies_below(body_search *s, const node *n)
{
    const unsigned children = bits_look_up_count8(n->octants);
    bool going = true;
    prefetch_children(n, (1u << children) - 1);
    for (unsigned i = 0; going && i < children; i++)
        going = visit_bodies_below(s, &children_of(n)[i]);
    for (uint32_t i = 0; going && children == 0 && i < n->count; i += SCAN_POINTS)
        going = visit_bodies(s, leaf_points(n) + i, UINT64_MAX >> (SCAN_POINTS - count_scanned(n, i)));
    return going;
}

/* Visit the bodies of a node that meets the region; `inside`: its box is in the region. `c` is the cell of an inner
 * node if nodes have no boxes, else null. Returns false if the visitor stopped the search. */
static bool visit_node(body_search *s, const node *n, octree_address address, bool inside, const divided_cell *c)
{
    octree_box made[8];
    divided_cell below;
    if (inside) {
        meter_record_taken(&s->meter, address);
        return visit_bodies_below(s, n);
    }
    meter_record_visited(&s->meter, address);
    if (n->octants == 0)
        return queue_leaf(s, n);
    const sibling_boxes boxes = boxes_of_children(n, c, made);
    const octant_masks masks = s->shape.kind->relate_siblings(&s->shape, &boxes);
    bool going = true;
    prefetch_children(n, masks.meets);
    meter_record_pruned_siblings(&s->meter, address, n, mask_of_siblings(&boxes) & ~masks.meets);
    for (unsigned left = masks.meets; going && left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        going = visit_node(s, &children_of(n)[i], address_of_sibling(&s->meter, address, n, i), masks.inside >> i & 1,
                           cell_of_child(s->shape.level, n, c, i, &below));
    }
    return going;
}

/* Relate the region to the whole level. `c` is the root cell if nodes have no boxes, else null: then the level is
 * searched. */
static octant_masks relate_root(const body_search *s, const divided_cell *c)
{
    if (!c)
        return (octant_masks){1, 0};
    const octree_box box = box_of_cell(c);
    const sibling_boxes alone = {&box, 1};
    return s->shape.kind->relate_siblings(&s->shape, &alone);
}

static void search_level(body_search *s, const level *l)
{
    divided_cell root;
    s->shape.level = l;
    s->shape.kind->prepare(&s->shape);
    s->meter = (meter){.how = s->how};
    s->leaves.added = s->leaves.removed = 0;
    const divided_cell *c = cell_of_root(l, &root);
    const octant_masks whole = relate_root(s, c);
    bool going = whole.meets && visit_node(s, &l->tree->root, OCTREE_ROOT, whole.inside & 1, c);
    while (going && s->leaves.removed < s->leaves.added)
        going = scan_leaf(s, leaf_queue_remove(&s->leaves));
    if (!whole.meets)
        meter_record_pruned_root(&s->meter);
    meter_add_to_cost(&s->meter);
}

octree_status octree_bodies_search(const octree_bodies *bodies, const octree_region *region, const octree_search *how,
                                   octree_body_visitor visit, void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_search, bodies, region, CALLER_SEARCH(how),
                           CALLER_BODY_VISITOR(visit, context));
    if (!bodies || !visit)
        return OCTREE_NULL_ARGUMENT;
    const octree_search search = search_or_default(how);
    octree_status status = octree_region_check(region);
    if (status == OCTREE_OK)
        status = check_search_options(&search);
    if (status != OCTREE_OK)
        return status;
    body_search s;
    s.set = bodies;
    shape_make(&s.shape, region);
    s.contained = region->contained && s.shape.kind->contains;
    s.how = &search;
    s.visit = visit;
    s.context = context;
    s.stopped = false;
    const unsigned begun = begin_set_callbacks(bodies);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && !s.stopped; i++)
        if (count_in_level(&bodies->levels[i]) > 0)
            search_level(&s, &bodies->levels[i]);
    end_callbacks(begun);
    return OCTREE_OK;
}
