/* SPDX-License-Identifier: MIT */
/* search.c - the bodies that match a region: octree_bodies_search().
 *
 * Each level is searched by itself. Nodes whose boxes cannot meet the region are pruned, and nodes whose boxes are
 * certainly in it are taken whole. The bodies of the remaining leaves are filtered, and those for which that is not
 * decisive are tested exactly.
 *
 * A level without boxes is searched by the traversal of region.h, with two tests. By integer keys: cells that do not
 * meet the box around the region, extended by the level's reach, are pruned. By the region's own bounds: octants whose
 * bodies cannot meet the region are pruned, and nodes whose bodies certainly match are taken whole. A body contains its
 * own position; so its node can be taken whole if the region contains its cell. If only contained bodies match, the
 * region must contain the box around all bodies of the cell instead.
 */
#include "../exact/exact.h"
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
    /* of the search of a level with boxes: */
    meter meter;
    leaf_queue leaves;
    /* of the search of a level without boxes: */
    box_shape around;
    octree_box box;                       /* the box of `around`: the bounds of the region, extended by the reach */
    bool by_keys;                         /* the keys alone decide about nodes */
    cell_halves halves[OCTREE_MAX_DEPTH]; /* of the current cell at each depth */
} body_search;

static bool is_match(const body_search *s, const octree_body *body)
{
    const shape_kind *kind = s->shape.kind;
    return s->contained ? kind->contains(&s->shape, body) : kind->meets(&s->shape, body);
}

/* ---- Bodies ------------------------------------------------------------------------------------------------- */

static uint64_t scan_bodies(const void *shape, const octree_point *points, unsigned count)
{
    const body_search *s = shape;
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
        if (!is_skipped(s->how, body, NULL) && !s->visit(body, s->context))
            s->stopped = true;
        if (s->stopped)
            return false;
    }
    return true;
}

/* ---- Nodes with boxes --------------------------------------------------------------------------------------- */

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

/* Visit the bodies of a node that meets the region; `inside`: its box is in the region. Returns false if the visitor
 * stopped the search. */
static bool visit_node(body_search *s, const node *n, octree_address address, bool inside)
{
    if (inside) {
        meter_record_taken(&s->meter, address);
        return visit_bodies_below(s, n);
    }
    meter_record_visited(&s->meter, address);
    if (n->octants == 0)
        return queue_leaf(s, n);
    const sibling_boxes boxes = boxes_of_children(n);
    const octant_masks masks = s->shape.kind->relate_siblings(&s->shape, &boxes);
    bool going = true;
    prefetch_children(n, masks.meets);
    meter_record_pruned_siblings(&s->meter, address, n, mask_of_siblings(&boxes) & ~masks.meets);
    for (unsigned left = masks.meets; going && left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        going = visit_node(s, &children_of(n)[i], address_of_sibling(&s->meter, address, n, i), masks.inside >> i & 1);
    }
    return going;
}

/* Search a level whose nodes have boxes. */
static void search_boxes(body_search *s)
{
    s->meter = (meter){.how = s->how};
    s->leaves.added = s->leaves.removed = 0;
    bool going = visit_node(s, &s->shape.level->tree->root, OCTREE_ROOT, false);
    while (going && s->leaves.removed < s->leaves.added)
        going = scan_leaf(s, leaf_queue_remove(&s->leaves));
    meter_add_to_cost(&s->meter);
}

/* ---- Nodes without boxes ------------------------------------------------------------------------------------ */

static octant_masks enter_cell(void *shape, const octree *tree, unsigned depth, unsigned octant)
{
    body_search *s = shape;
    const octant_masks masks = box_shape_enter(&s->around, tree, depth, octant);
    if (s->by_keys)
        return masks;
    const int32_t *low = s->around.low[depth];
    const cell c = {{(uint32_t)low[0], (uint32_t)low[1], (uint32_t)low[2]}, depth};
    if (depth == 0)
        divide_root_cell(s->shape.level, &s->halves[0]);
    else
        divide_octant(s->shape.level, &s->halves[depth - 1], octant, c, &s->halves[depth]);
    return s->shape.kind->relate_octants(&s->shape, &s->halves[depth], masks.meets, s->contained);
}

/* An octree_point_visitor. */
static bool visit_body(const octree_point *point, void *context)
{
    return visit_bodies(context, point, 1);
}

static octree_box extend_box(const octree_box *box, const double reach[3])
{
    octree_box extended;
    for (int i = 0; i < 3; i++) {
        extended.min[i] = box->min[i] >= -DBL_MAX ? exact_add_down(box->min[i], -reach[i]) : box->min[i];
        extended.max[i] = box->max[i] <= DBL_MAX ? exact_add_up(box->max[i], reach[i]) : box->max[i];
    }
    return extended;
}

/* Search a level whose nodes have no boxes. */
static void search_cells(body_search *s, const octree_box *bounds)
{
    const level *l = s->shape.level;
    region r = {l->tree, s, enter_cell, scan_bodies, visit_body, s, .meter.how = s->how};
    s->box = s->contained ? *bounds : extend_box(bounds, l->reach);
    s->by_keys = s->shape.region->kind == OCTREE_REGION_BOX && !s->contained;
    s->around = box_shape_make(l->tree, &s->box, s->by_keys ? bounds : &s->box);
    octant_masks root = box_shape_root(&s->around, l->tree);
    if (!s->by_keys)
        root.inside = 0;
    region_search(&r, root);
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

static void search_level(body_search *s, const level *l, const octree_box *bounds)
{
    s->shape.level = l;
    s->shape.kind->prepare(&s->shape);
    if (has_boxes(&l->tree->store))
        search_boxes(s);
    else
        search_cells(s, bounds);
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
    const octree_box bounds = s.shape.kind->bounds(&s.shape);
    const unsigned begun = begin_set_callbacks(bodies);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && !s.stopped; i++)
        if (count_in_level(&bodies->levels[i]) > 0)
            search_level(&s, &bodies->levels[i], &bounds);
    end_callbacks(begun);
    return OCTREE_OK;
}
