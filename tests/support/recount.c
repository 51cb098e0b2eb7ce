/* SPDX-License-Identifier: MIT */
#include "recount.h"
#include "octree/bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "fixture.h"

void recount_free(recount *all)
{
    free(all->visits);
    free(all->leaves);
    *all = (recount){0};
}

static void add_visit(octree_address node, octree_trace_kind touch, void *context)
{
    recount *all = context;
    if (all->count == all->room) {
        all->room = all->room ? 2 * all->room : 64;
        all->visits = realloc(all->visits, all->room * sizeof *all->visits);
        assert_non_null(all->visits);
    }
    all->visits[all->count++] = (octree_visit){node, touch, touch == OCTREE_TRACE_TAKEN};
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

typedef enum relation { APART, MEETS, INSIDE } relation;

typedef struct region {
    recount *all;
    octree_box world;
    const octree_box *box;
    const double *center; /* of a ball, which has no box */
    double radius;
    const double *reach; /* the largest half extents of the bodies; null: all bodies are points */
    /* only for a step among bodies: the search takes no node whole, and rounds the end of the step outwards */
    const double *step;
    octree_cost cost;
} region;

/* A cell of points has its lower faces; its upper ones are its neighbour's, but for the world's. Bodies reach out of
 * their cells, whose boxes have all faces. */
static relation to_box(const region *r, const octree_box *box, const octree_box *cell)
{
    relation found = INSIDE;
    for (int i = 0; i < 3; i++) {
        const double reach = r->reach ? r->reach[i] : 0;
        const double step = r->step ? r->step[i] : 0, rounding = 0x1p-40;
        const bool has_upper_face = r->reach || cell->max[i] == r->world.max[i];
        const double low = box->min[i] - (step < 0 ? rounding : 0), high = box->max[i] + (step > 0 ? rounding : 0);
        if (high < cell->min[i] - reach || low > cell->max[i] + reach || (low == cell->max[i] && !has_upper_face))
            return APART;
        if (box->max[i] < cell->max[i] + reach || box->min[i] > cell->min[i] - reach)
            found = MEETS;
    }
    return found;
}

static relation to_ball(const region *r, const octree_box *cell)
{
    double near = 0, far = 0;
    for (int i = 0; i < 3; i++) {
        const double reach = r->reach ? r->reach[i] : 0;
        const double below = cell->min[i] - r->center[i], above = r->center[i] - cell->max[i];
        const double gap = fmax(fmax(below, above) - reach, 0), farther = fmax(-below, -above) + reach;
        near += gap * gap;
        far += farther * farther;
    }
    const double square = r->radius * r->radius;
    return near > square ? APART : far < square ? INSIDE : MEETS;
}

static relation relate(const region *r, const octree_node *node)
{
    const relation is = r->box ? to_box(r, r->box, &node->box) : to_ball(r, &node->box);
    return is == INSIDE && r->step ? MEETS : is;
}

static octree_walk_order look_at(const octree_node *node, void *context)
{
    region *r = context;
    const relation is = relate(r, node);
    if (is == APART) {
        r->cost.pruned++;
        add_visit(node->address, OCTREE_TRACE_PRUNED, r->all);
        return OCTREE_WALK_SKIP;
    }
    if (is == INSIDE) {
        r->cost.taken++;
        add_visit(node->address, OCTREE_TRACE_TAKEN, r->all);
        return OCTREE_WALK_SKIP;
    }
    r->cost.nodes++;
    r->cost.leaves += node->leaf;
    r->cost.points += node->leaf ? node->count : 0;
    add_visit(node->address, OCTREE_TRACE_VISITED, r->all);
    return OCTREE_WALK_ON;
}

static octree_cost walk_region(region r, const octree *tree)
{
    r.world = octree_definition(tree).world;
    assert_int_equal(octree_walk(tree, look_at, &r), OCTREE_OK);
    return r.cost;
}

octree_cost recount_box(recount *all, const octree *tree, const octree_box *box)
{
    return walk_region((region){.all = all, .box = box}, tree);
}

octree_cost recount_ball(recount *all, const octree *tree, const double center[3], double radius)
{
    return walk_region((region){.all = all, .center = center, .radius = radius}, tree);
}

octree_cost recount_neighbors(recount *all, const octree *tree, const double target[3], size_t k,
                              const octree_search *how)
{
    octree_cost cost = {0};
    octree_search traced = *how;
    size_t count;
    k = k < octree_count(tree) ? k : octree_count(tree);
    octree_neighbor *neighbors = malloc((k + 1) * sizeof *neighbors);
    assert_non_null(neighbors);
    traced.cost = &cost;
    traced.trace = add_visit;
    traced.trace_context = all;
    assert_int_equal(octree_nearest_k(tree, target, k, &traced, neighbors, &count), OCTREE_OK);
    free(neighbors);
    return cost;
}

/* The same among the bodies of a game. */
static octree_cost recount_nearest_bodies(recount *all, const octree_game *game, const octree_answer *answer,
                                          const octree_search *how)
{
    octree_cost cost = {0};
    octree_search traced = *how;
    size_t count;
    octree_hit *hits = malloc((answer->k + 1) * sizeof *hits);
    assert_non_null(hits);
    traced.cost = &cost;
    traced.trace = add_visit;
    traced.trace_context = all;
    assert_int_equal(octree_bodies_nearest(octree_game_bodies(game), answer->target, answer->k, HUGE_VAL, &traced, NULL,
                                           NULL, hits, &count),
                     OCTREE_OK);
    free(hits);
    return cost;
}

octree_cost recount_ray(recount *all, const octree_bodies *bodies, const octree_answer *ray, const octree_search *how)
{
    octree_cost cost = {0};
    octree_search traced = *how;
    octree_region region = {.kind = ray->kind == OCTREE_QUERY_SWEEP ? OCTREE_REGION_SWEPT : OCTREE_REGION_RAY,
                            .length = ray->length > 0 ? ray->length : HUGE_VAL};
    const size_t k = ray->k < octree_bodies_count(bodies) ? ray->k : octree_bodies_count(bodies);
    octree_hit *hits = malloc((k + 1) * sizeof *hits);
    size_t count;
    assert_non_null(hits);
    memcpy(region.origin, ray->target, sizeof region.origin);
    memcpy(region.direction, ray->direction, sizeof region.direction);
    for (int axis = 0; axis < 3; axis++)
        region.half[axis] = ray->kind == OCTREE_QUERY_SWEEP ? ray->half[axis] : ray->thickness;
    memcpy(region.from, ray->target, sizeof region.from);
    memcpy(region.to, ray->to, sizeof region.to);
    traced.cost = &cost;
    traced.trace = add_visit;
    traced.trace_context = all;
    assert_int_equal(octree_bodies_cast(bodies, &region, k, &traced, NULL, NULL, hits, &count), OCTREE_OK);
    assert_int_equal(count, ray->count);
    for (size_t i = 0; i < count; i++)
        assert_true(hits[i].body.id == ray->neighbors[i].point.id && hits[i].at == ray->neighbors[i].distance);
    free(hits);
    return cost;
}

static bool count_body(const octree_body *body, void *count)
{
    (void)body;
    ++*(size_t *)count;
    return true;
}

static octree_cost recount_frustum(recount *all, const octree_bodies *bodies, const octree_answer *frustum)
{
    octree_cost cost = {0};
    size_t count = 0;
    const octree_search traced = {.cost = &cost, .trace = add_visit, .trace_context = all};
    const octree_region region = {.kind = OCTREE_REGION_HALF_SPACES,
                                  .half_spaces = frustum->frustum.half_spaces,
                                  .half_space_count = frustum->frustum.count};
    assert_int_equal(octree_bodies_search(bodies, &region, &traced, count_body, &count), OCTREE_OK);
    assert_int_equal(count, frustum->count);
    return cost;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

static octree_walk_order collect_points(const octree_node *node, void *context)
{
    for (size_t i = 0; node->leaf && i < node->count; i++)
        brute_collect(&node->points[i], context);
    return OCTREE_WALK_ON;
}

/* The largest half extents of the game's bodies. Returns null if all are points. */
static const double *find_reach(const octree_game *game, double reach[3])
{
    brute points = {0};
    assert_int_equal(octree_walk(octree_game_tree(game), collect_points, &points), OCTREE_OK);
    memset(reach, 0, sizeof(double[3]));
    for (size_t i = 0; i < points.count; i++) {
        octree_body body;
        assert_true(octree_game_find_body(game, points.points[i].id, &body));
        for (int axis = 0; axis < 3; axis++)
            reach[axis] = fmax(reach[axis], body.half[axis]);
    }
    brute_free(&points);
    return reach[0] > 0 || reach[1] > 0 || reach[2] > 0 ? reach : NULL;
}

/* The tree that the collision test asked: that of the tick's end, with the player still where it was. */
static octree *tree_before_step(const octree_game *game, const double before[3])
{
    const octree *tree = octree_game_tree(game);
    const octree_tick *tick = octree_game_tick(game);
    const octree_def def = octree_definition(tree);
    brute points = {0};
    assert_int_equal(octree_walk(tree, collect_points, &points), OCTREE_OK);
    if (tick->events & OCTREE_EVENT_MOVED) {
        const uint64_t player = octree_game_session(game)->player.id;
        assert_true(brute_remove(&points, tick->player, player));
        brute_insert(&points, before, player);
    }
    octree *made = brute_tree(&points, def.world, def.leaf_capacity, def.max_depth);
    brute_free(&points);
    return made;
}

/* Swept, the box around the whole way. */
static octree_box tested_box(const octree_tick *tick, double size)
{
    octree_box box, start;
    assert_int_equal(octree_collision_box(tick->attempt, size, &box), OCTREE_OK);
    assert_int_equal(octree_collision_box(tick->from, size, &start), OCTREE_OK);
    for (int i = 0; tick->swept && i < 3; i++) {
        box.min[i] = start.min[i] < box.min[i] ? start.min[i] : box.min[i];
        box.max[i] = start.max[i] > box.max[i] ? start.max[i] : box.max[i];
    }
    return box;
}

static void assert_cost(const octree_cost *told, const octree_cost *counted)
{
    assert_int_equal(told->nodes, counted->nodes);
    assert_int_equal(told->leaves, counted->leaves);
    assert_int_equal(told->points, counted->points);
    assert_int_equal(told->pruned, counted->pruned);
}

static void recount_collision(recount *all, const octree_game *game, const double before[3])
{
    const octree_tick *tick = octree_game_tick(game);
    octree *tree = tree_before_step(game, before);
    const octree_box box = tested_box(tick, octree_game_session(game)->player.box_size);
    double reach[3], step[3];
    region r = {.all = all, .box = &box, .reach = find_reach(game, reach)};
    for (int i = 0; i < 3; i++)
        step[i] = tick->swept ? tick->attempt[i] - tick->from[i] : 0;
    r.step = r.reach ? step : NULL;
    octree_cost cost = walk_region(r, tree);
    assert_true(tick->hit_cost.points >= cost.points);
    if (tick->swept)
        cost.points = tick->hit_cost.points; /* bodies that moved are compared too */
    assert_cost(&tick->hit_cost, &cost);
    octree_destroy(tree);
}

static octree_cost recount_answer(recount *all, const octree_game *game, const octree_answer *answer)
{
    const octree *tree = octree_game_tree(game);
    octree_search how = {.skip_id = octree_game_session(game)->player.id};
    double reach[3];
    region r = {.all = all, .radius = answer->radius, .reach = find_reach(game, reach)};
    r.box = answer->kind == OCTREE_QUERY_RANGE ? &answer->box : NULL;
    r.center = answer->target;
    if (answer->kind == OCTREE_QUERY_FRUSTUM)
        return recount_frustum(all, octree_game_bodies(game), answer);
    if (!octree_query_about(answer->kind)->neighbors)
        return walk_region(r, tree);
    how.skip = same_position(answer->target, octree_game_tick(game)->player) ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    if (answer->kind == OCTREE_QUERY_RAY || answer->kind == OCTREE_QUERY_SWEEP)
        return recount_ray(all, octree_game_bodies(game), answer, &how);
    if (r.reach)
        return recount_nearest_bodies(all, game, answer, &how);
    return recount_neighbors(all, tree, answer->target, answer->k, &how);
}

/* What a walk looks for: the leaf that stores a point. */
typedef struct holder {
    const octree_point *point;
    octree_address leaf;
} holder;

static octree_walk_order find_holder(const octree_node *node, void *context)
{
    holder *h = context;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        if (node->points[i].id == h->point->id && same_position(node->points[i].position, h->point->position))
            h->leaf = node->address;
    return h->leaf ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

static void add_leaf(recount *all, const octree *tree, const octree_point *point)
{
    holder h = {.point = point};
    assert_int_equal(octree_walk(tree, find_holder, &h), OCTREE_OK);
    assert_true(h.leaf != 0);
    if (all->leaf_count == all->leaf_room) {
        all->leaf_room = all->leaf_room ? 2 * all->leaf_room : 64;
        all->leaves = realloc(all->leaves, all->leaf_room * sizeof *all->leaves);
        assert_non_null(all->leaves);
    }
    all->leaves[all->leaf_count++] = h.leaf;
}

static void add_leaves(recount *all, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    for (size_t i = 0; i < tick->hit_count; i++)
        add_leaf(all, tree, &tick->hits[i]);
    for (size_t a = 0; a < tick->answer_count; a++) {
        const octree_answer *answer = &tick->answers[a];
        const bool points = !octree_query_about(answer->kind)->neighbors;
        for (size_t i = 0; i < answer->count; i++)
            add_leaf(all, tree, points ? &answer->points[i] : &answer->neighbors[i].point);
    }
}

/* Pre-order is the order of the texts "root" and "0/3/7", but that the root is first. */
static int compare_texts(octree_address a, octree_address b)
{
    char texts[2][OCTREE_ADDRESS_TEXT];
    if (a == OCTREE_ROOT || b == OCTREE_ROOT)
        return (a != OCTREE_ROOT) - (b != OCTREE_ROOT);
    return strcmp(octree_address_format(a, texts[0]), octree_address_format(b, texts[1]));
}

static int compare_visits(const void *a, const void *b)
{
    return compare_texts(((const octree_visit *)a)->node, ((const octree_visit *)b)->node);
}

static int compare_leaves(const void *a, const void *b)
{
    return compare_texts(*(const octree_address *)a, *(const octree_address *)b);
}

static octree_trace_kind stronger(octree_trace_kind a, octree_trace_kind b)
{
    if (a == OCTREE_TRACE_VISITED || b == OCTREE_TRACE_VISITED)
        return OCTREE_TRACE_VISITED;
    return a == OCTREE_TRACE_TAKEN || b == OCTREE_TRACE_TAKEN ? OCTREE_TRACE_TAKEN : OCTREE_TRACE_PRUNED;
}

static void merge(recount *all)
{
    size_t kept = 0;
    qsort(all->visits, all->count, sizeof *all->visits, compare_visits);
    for (size_t i = 0; i < all->count; i++) {
        octree_visit *last = kept ? &all->visits[kept - 1] : NULL;
        if (last && last->node == all->visits[i].node) {
            last->touch = stronger(last->touch, all->visits[i].touch);
            last->taken = last->taken || all->visits[i].taken;
        } else {
            all->visits[kept++] = all->visits[i];
        }
    }
    all->count = kept;
    for (size_t i = 0; i < kept; i++)
        all->touched[all->visits[i].touch]++;
    kept = 0;
    if (all->leaf_count)
        qsort(all->leaves, all->leaf_count, sizeof *all->leaves, compare_leaves);
    for (size_t i = 0; i < all->leaf_count; i++)
        if (kept == 0 || all->leaves[kept - 1] != all->leaves[i])
            all->leaves[kept++] = all->leaves[i];
    all->leaf_count = kept;
}

void recount_tick(recount *all, const octree_game *game, const double before[3])
{
    const octree_tick *tick = octree_game_tick(game);
    all->count = all->leaf_count = 0;
    memset(all->touched, 0, sizeof all->touched);
    recount_collision(all, game, before);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_cost cost = recount_answer(all, game, &tick->answers[i]);
        assert_cost(&tick->answers[i].cost, &cost);
    }
    add_leaves(all, game);
    merge(all);
}

void assert_recount(const recount *all, const octree_tick *tick)
{
    assert_int_equal(tick->visit_count, all->count);
    for (size_t i = 0; i < all->count; i++) {
        assert_int_equal(tick->visits[i].node, all->visits[i].node);
        assert_int_equal(tick->visits[i].touch, all->visits[i].touch);
        assert_int_equal(tick->visits[i].taken, all->visits[i].taken);
    }
    for (int touch = 0; touch < OCTREE_TRACE_KINDS; touch++)
        assert_int_equal(tick->touched[touch], all->touched[touch]);
    assert_int_equal(tick->hit_leaf_count, all->leaf_count);
    for (size_t i = 0; i < all->leaf_count; i++)
        assert_int_equal(tick->hit_leaves[i], all->leaves[i]);
}
