/* SPDX-License-Identifier: MIT */
/* search.c - the bodies that match a region: octree_bodies_search().
 *
 * Each level is searched by the traversal of region.h. Nodes whose boxes cannot meet the region are pruned, and nodes
 * whose boxes are certainly in it are taken whole. The bodies of the remaining leaves are filtered, and those for which
 * that is not decisive are tested exactly.
 *
 * A level without boxes has two tests instead. By integer keys: cells that do not meet the box around the region,
 * extended by the level's reach, are pruned. By the region's own bounds: octants whose bodies cannot meet the region
 * are pruned, and nodes whose bodies certainly match are taken whole. A body contains its own position; so its node can
 * be taken whole if the region contains its cell. If only contained bodies match, the region must contain the box
 * around all bodies of the cell instead.
 */
#include "../exact/exact.h"
#include "shape.h"
#include "visit.h"

typedef struct body_search {
    box_shape around;
    octree_box box; /* the box of `around`: the bounds of the region, extended by the reach */
    shape shape;
    const octree_bodies *set;
    bool contained;
    bool by_keys;                         /* the keys alone decide about nodes */
    cell_halves halves[OCTREE_MAX_DEPTH]; /* of the current cell at each depth */
    const octree_search *how;
    body_call call;
    bool stopped; /* the visitor stopped the search */
} body_search;

static bool is_match(const body_search *s, const octree_body *body)
{
    const shape_kind *kind = s->shape.kind;
    return s->contained ? kind->contains(&s->shape, body) : kind->meets(&s->shape, body);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

static octant_masks enter_node(void *shape, const octree *tree, const node *n, unsigned depth, unsigned octant)
{
    const body_search *s = shape;
    const sibling_boxes boxes = boxes_of_children(n);
    const octant_masks masks = s->shape.kind->relate_siblings(&s->shape, &boxes);
    (void)tree, (void)depth, (void)octant;
    return (octant_masks){(uint8_t)spread_mask(n, masks.meets), (uint8_t)spread_mask(n, masks.inside)};
}

static octant_masks enter_cell(void *shape, const octree *tree, const node *n, unsigned depth, unsigned octant)
{
    body_search *s = shape;
    const octant_masks masks = box_shape_enter(&s->around, tree, n, depth, octant);
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

/* ---- Leaves ------------------------------------------------------------------------------------------------- */

static uint64_t scan_bodies(const void *shape, const octree_point *points, unsigned count)
{
    const body_search *s = shape;
    const body_masks masks = s->shape.kind->filter(&s->shape, points, count);
    uint64_t found = s->contained ? 0 : masks.sure;
    for (uint64_t left = s->set->points ? 0 : masks.near; left; left &= left - 1)
        prefetch_memory(row_at(&s->set->rows, row_of_point(&points[bits_lowest(left)])));
    for (uint64_t left = masks.near & ~found; left; left &= left - 1) {
        const unsigned i = bits_lowest(left);
        octree_body scratch;
        found |= (uint64_t)is_match(s, load_body(s->set, &points[i], &scratch)) << i;
    }
    return found;
}

/* An octree_point_visitor. */
static bool visit_body(const octree_point *point, void *context)
{
    body_search *s = context;
    octree_body scratch;
    const octree_body *body = load_body(s->set, point, &scratch);
    s->stopped = !is_skipped(s->how, body, NULL) && !call_with_body(&s->call, body);
    return !s->stopped;
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

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
static void search_cells(body_search *s, region *r, const octree_box *bounds)
{
    const level *l = s->shape.level;
    s->box = s->contained ? *bounds : extend_box(bounds, l->reach);
    s->by_keys = s->shape.region->kind == OCTREE_REGION_BOX && !s->contained;
    s->around = box_shape_make(l->tree, &s->box, s->by_keys ? bounds : &s->box);
    octant_masks root = box_shape_root(&s->around, l->tree);
    if (!s->by_keys)
        root.inside = 0;
    r->enter = enter_cell;
    region_search(r, root);
}

static void search_level(body_search *s, const level *l, const octree_box *bounds)
{
    region r = {l->tree, s, NULL, scan_bodies, visit_body, s, .meter.how = s->how};
    s->shape.level = l;
    s->shape.kind->prepare(&s->shape);
    if (has_boxes(&l->tree->store)) {
        r.enter = enter_node;
        region_search(&r, (octant_masks){1, 0});
    } else {
        search_cells(s, &r, bounds);
    }
}

octree_status octree_bodies_search(const octree_bodies *bodies, const octree_region *region, const octree_search *how,
                                   octree_body_visitor visit, void *context)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_search, bodies, region, CALLER_SEARCH(how), visit, context);
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
    s.call = (body_call){visit, context};
    s.stopped = false;
    const octree_box bounds = s.shape.kind->bounds(&s.shape);
    const unsigned begun = begin_set_callbacks(bodies);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && !s.stopped; i++)
        if (octree_count(bodies->levels[i].tree) > 0)
            search_level(&s, &bodies->levels[i], &bounds);
    end_callbacks(begun);
    return OCTREE_OK;
}
