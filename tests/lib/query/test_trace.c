/* SPDX-License-Identifier: MIT */
/* test_trace.c - the trace of a query names each visited, pruned or taken node once. */
#include "fixture.h"

#include <math.h>

#include "brute.h"

static bool box_contains(const octree_box *box, const double p[3])
{
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside &= box->min[i] <= p[i] && p[i] <= box->max[i];
    return inside;
}

typedef struct touched {
    octree_address node;
    octree_trace_kind touch;
} touched;

typedef struct trace {
    touched items[20000];
    size_t count;
} trace;

static void note(octree_address node, octree_trace_kind touch, void *context)
{
    trace *t = context;
    assert_true(t->count < sizeof t->items / sizeof t->items[0]);
    t->items[t->count++] = (touched){node, touch};
}

static bool ignore(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

static size_t count_of(const trace *t, octree_trace_kind touch)
{
    size_t count = 0;
    for (size_t i = 0; i < t->count; i++)
        count += t->items[i].touch == touch;
    return count;
}

/* How a query met a node, or below which node it stopped: -1 where it never came near. */
static int touch_of(const trace *t, octree_address address)
{
    for (; address; address >>= 3)
        for (size_t i = 0; i < t->count; i++)
            if (t->items[i].node == address)
                return (int)t->items[i].touch;
    return -1;
}

static void assert_nodes_exist_and_differ(const octree *tree, const trace *t)
{
    octree_node node;
    for (size_t i = 0; i < t->count; i++) {
        assert_int_equal(octree_node_at(tree, t->items[i].node, &node), OCTREE_OK);
        for (size_t j = 0; j < i; j++)
            assert_true(t->items[i].node != t->items[j].node);
    }
}

/* Where the leaf of an answer is, the query has looked or has taken the whole; elsewhere it may have. */
static void assert_answer_was_met(const octree *tree, const trace *t, const double position[3])
{
    octree_node leaf;
    assert_int_equal(octree_locate(tree, position, &leaf), OCTREE_OK);
    const int touch = touch_of(t, leaf.address);
    assert_true(touch == OCTREE_TRACE_VISITED || touch == OCTREE_TRACE_TAKEN);
}

static octree *sampled_tree(brute *all, octree_sample_kind kind)
{
    const octree_box world = cube(-1, 1);
    brute_sample(all, kind, 4, &world, 600);
    return brute_tree(all, world, 6, 21);
}

/* What lies within the box is taken whole, closed faces and all, and nothing else is. */
static void assert_taken_where_within(const octree *tree, const trace *t, const octree_box *box)
{
    for (size_t i = 0; i < t->count; i++) {
        octree_node node;
        octree_node_at(tree, t->items[i].node, &node);
        const bool within = box_contains(box, node.box.min) && box_contains(box, node.box.max);
        assert_int_equal(t->items[i].touch == OCTREE_TRACE_TAKEN, within);
    }
}

static void assert_counts_are_traced(const trace *t, const octree_cost *cost)
{
    assert_int_equal(count_of(t, OCTREE_TRACE_VISITED), cost->nodes);
    assert_int_equal(count_of(t, OCTREE_TRACE_TAKEN), cost->taken);
    assert_int_equal(count_of(t, OCTREE_TRACE_PRUNED), cost->pruned);
}

/* The box around two cells of depth 3. */
static octree_box box_of_cells(const octree_box *world, uint64_t *random)
{
    const octree_box a = octree_cell_box(world, 512 + random_below(random, 512));
    const octree_box b = octree_cell_box(world, 512 + random_below(random, 512));
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = fmin(a.min[i], b.min[i]);
        box.max[i] = fmax(a.max[i], b.max[i]);
    }
    return box;
}

/* In the first world many points lie on planes; in the third no plane is a round number. */
static void a_range_whose_faces_are_planes_takes_all_nodes_within(void **state)
{
    (void)state;
    static const double worlds[][2] = {{-4, 4}, {-512, 512}, {0.1, 0.7}, {-1e300, 3e299}};
    uint64_t random = 9;
    for (size_t w = 0; w < sizeof worlds / sizeof worlds[0]; w++) {
        const octree_box world = cube(worlds[w][0], worlds[w][1]);
        brute all = {0};
        if (w == 0)
            brute_scatter(&all, &random, 1500, 4, 1000);
        else
            brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 4, &world, 1500);
        octree *tree = brute_tree(&all, world, 4, 21);
        for (int i = 0; i < 60; i++) {
            static trace t;
            t.count = 0;
            octree_cost cost = {0};
            size_t count;
            brute expected = {0};
            const octree_box box = box_of_cells(&world, &random);
            const octree_search how = {.cost = &cost, .trace = note, .trace_context = &t};
            assert_int_equal(octree_range_collect(tree, &box, &how, NULL, 0, &count), OCTREE_OK);
            brute_range(&all, &box, &expected);
            assert_int_equal(count, expected.count);
            assert_true(cost.taken > 0);
            assert_counts_are_traced(&t, &cost);
            assert_taken_where_within(tree, &t, &box);
            brute_free(&expected);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void a_range_traces_visited_taken_and_pruned_nodes(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        brute all = {0};
        octree *tree = sampled_tree(&all, (octree_sample_kind)kind);
        for (int i = 0; i < 30; i++) {
            const double at = random_between(&random, -1.2, 1.2), reach = random_between(&random, 0, 0.8);
            static trace t;
            t.count = 0;
            octree_cost cost = {0};
            const octree_search how = {.cost = &cost, .trace = note, .trace_context = &t};
            const octree_box box = cube(at - reach, at + reach);
            assert_int_equal(octree_range_search(tree, &box, &how, ignore, NULL), OCTREE_OK);
            assert_nodes_exist_and_differ(tree, &t);
            assert_counts_are_traced(&t, &cost);
            assert_taken_where_within(tree, &t, &box);
            for (size_t j = 0; j < all.count; j++)
                if (box_contains(&box, all.points[j].position))
                    assert_answer_was_met(tree, &t, all.points[j].position);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void balls_and_neighbors_trace_every_counted_node(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        brute all = {0};
        octree *tree = sampled_tree(&all, (octree_sample_kind)kind);
        for (int i = 0; i < 30; i++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = random_between(&random, -1.2, 1.2);
            static trace t;
            octree_cost cost = {0};
            const octree_search how = {.cost = &cost, .trace = note, .trace_context = &t};
            t.count = 0;
            assert_int_equal(octree_radius(tree, at, random_between(&random, 0, 0.8), &how, ignore, NULL), OCTREE_OK);
            assert_nodes_exist_and_differ(tree, &t);
            assert_counts_are_traced(&t, &cost);
            octree_neighbor found[5];
            size_t count;
            cost = (octree_cost){0};
            t.count = 0;
            assert_int_equal(octree_nearest_k(tree, at, 5, &how, found, &count), OCTREE_OK);
            assert_nodes_exist_and_differ(tree, &t);
            assert_counts_are_traced(&t, &cost);
            for (size_t j = 0; j < count; j++)
                assert_answer_was_met(tree, &t, found[j].point.position);
        }
        octree_destroy(tree);
        brute_free(&all);
    }
}

static void a_range_outside_the_world_prunes_the_root(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0.5, 0.5, 0.5}, {-0.5, 0.5, 0.5}}, 2);
    static trace t;
    t.count = 0;
    octree_neighbor found;
    octree_cost cost = {0};
    const octree_search how = {.cost = &cost, .trace = note, .trace_context = &t};
    const double far_off[3] = {9, 9, 9};
    const octree_box box = cube(8, 9);
    assert_int_equal(octree_range_search(tree, &box, &how, ignore, NULL), OCTREE_OK);
    assert_int_equal(octree_radius(tree, far_off, 1, &how, ignore, NULL), OCTREE_OK);
    assert_int_equal(octree_nearest_within(tree, far_off, 1, &how, &found), OCTREE_NOT_FOUND);
    assert_int_equal(t.count, 3);
    for (size_t i = 0; i < t.count; i++)
        assert_true(t.items[i].node == OCTREE_ROOT && t.items[i].touch == OCTREE_TRACE_PRUNED);
    assert_true(cost.nodes == 0 && cost.pruned == 3);
    octree_destroy(tree);
}

static void assert_same_traces(const trace *a, octree_cost cost_a, const trace *b, octree_cost cost_b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++)
        assert_true(a->items[i].node == b->items[i].node && a->items[i].touch == b->items[i].touch);
    assert_true(cost_a.nodes == cost_b.nodes && cost_a.leaves == cost_b.leaves && cost_a.points == cost_b.points &&
                cost_a.pruned == cost_b.pruned && cost_a.taken == cost_b.taken);
}

/* A collision asks for its box, and on its way along an axis for the box around the whole step. */
static void collisions_are_traced_like_their_boxes(void **state)
{
    (void)state;
    static trace of_collision, of_box;
    uint64_t random = 8;
    brute all = {0};
    octree *tree = sampled_tree(&all, OCTREE_SAMPLE_CLUSTERED);
    for (int i = 0; i < 60; i++) {
        double from[3], to[3];
        const double size = random_between(&random, 0, 0.3);
        for (int axis = 0; axis < 3; axis++) {
            from[axis] = random_between(&random, -1, 1);
            to[axis] = i % 6 == 2 * axis + 1 ? random_between(&random, -1, 1) : from[axis];
        }
        octree_cost collision_cost = {0}, box_cost = {0};
        const octree_search collide = {.cost = &collision_cost, .trace = note, .trace_context = &of_collision};
        const octree_search range = {.cost = &box_cost, .trace = note, .trace_context = &of_box};
        octree_box box, end;
        octree_collision_box(from, size, &box);
        octree_collision_box(to, size, &end);
        for (int axis = 0; axis < 3; axis++) {
            box.min[axis] = fmin(box.min[axis], end.min[axis]);
            box.max[axis] = fmax(box.max[axis], end.max[axis]);
        }
        of_collision.count = of_box.count = 0;
        assert_int_equal(octree_range_search(tree, &box, &range, ignore, NULL), OCTREE_OK);
        assert_int_equal(i % 2 ? octree_collide_swept(tree, from, to, size, NULL, &collide, ignore, NULL)
                               : octree_collide_search(tree, from, size, NULL, &collide, ignore, NULL),
                         OCTREE_OK);
        assert_true(of_box.count > 0);
        assert_same_traces(&of_collision, collision_cost, &of_box, box_cost);
    }
    octree_destroy(tree);
    brute_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_range_whose_faces_are_planes_takes_all_nodes_within),
        cmocka_unit_test(a_range_traces_visited_taken_and_pruned_nodes),
        cmocka_unit_test(balls_and_neighbors_trace_every_counted_node),
        cmocka_unit_test(a_range_outside_the_world_prunes_the_root),
        cmocka_unit_test(collisions_are_traced_like_their_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
