/* SPDX-License-Identifier: MIT */
/* test_bodies_boxes.c - the boxes of nodes: they follow every change, depend on the bodies alone, and keep searches
 * away from leaves without answers. octree_bodies_check() compares all boxes with the bodies. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "body_scenes.h"
#include "body_sets.h"
#include "octree/sample.h"

enum { BODIES = 1500, QUERIES = 100 };

static octree_cost cost_of_queries(const octree_bodies *set)
{
    uint64_t seed = 8;
    octree_cost cost = {0};
    const octree_search how = {.cost = &cost};
    for (int i = 0; i < QUERIES; i++) {
        octree_half_space half_spaces[OCTREE_MAX_HALF_SPACES];
        octree_hit hits[3];
        size_t count = 0;
        double target[3];
        const octree_region_kind kind = (octree_region_kind)(i % OCTREE_REGION_KINDS);
        const octree_region region = random_region(NUMBERS_SMOOTH, kind, &seed, half_spaces);
        assert_int_equal(octree_bodies_search(set, &region, &how, count_body, &count), OCTREE_OK);
        random_target(NUMBERS_SMOOTH, &seed, target);
        const octree_body near = small_body(0.2, &seed, 0);
        const octree_region ball = {.kind = OCTREE_REGION_BALL,
                                    .center = {near.position[0], near.position[1], near.position[2]},
                                    .radius = 0.2};
        assert_int_equal(octree_bodies_search(set, &ball, &how, count_body, &count), OCTREE_OK);
        assert_int_equal(octree_bodies_nearest(set, target, 3, 2, &how, NULL, NULL, hits, &count), OCTREE_OK);
    }
    return cost;
}

static void assert_same_cost(const octree_bodies *one, const octree_bodies *other)
{
    const octree_cost a = cost_of_queries(one), b = cost_of_queries(other);
    assert_true(a.leaves > 0 && a.pruned > 0);
    assert_int_equal(a.nodes, b.nodes);
    assert_int_equal(a.leaves, b.leaves);
    assert_int_equal(a.points, b.points);
    assert_int_equal(a.pruned, b.pruned);
    assert_int_equal(a.taken, b.taken);
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

/* Few bodies beside those of the set, which are changed one by one, and half of them, for which it is filled anew. */
static void boxes_follow_bulk_changes_of_all_sizes(void **state)
{
    (void)state;
    static octree_body bodies[BODIES], moved[BODIES];
    uint64_t seed = 3;
    for (uint32_t capacity = 1; capacity <= 16; capacity += 5) {
        octree_bodies *set = make_body_set(cube(-8, 8), capacity);
        for (size_t i = 0; i < BODIES; i++)
            bodies[i] = small_body(0.2, &seed, i);
        assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
        for (size_t round = 0; round < 150; round++) {
            const size_t count = round < 5 ? BODIES / 2 - round : 1 + round % 12;
            for (size_t i = 0; i < count; i++) {
                moved[i] = small_body(0.2, &seed, i);
                if (i % 4) /* others change their size, too */
                    memcpy(moved[i].half, bodies[i].half, sizeof moved[i].half);
            }
            assert_int_equal(octree_bodies_move_many(set, bodies, moved, count, NULL, NULL), OCTREE_OK);
            memcpy(bodies, moved, count * sizeof *bodies);
            assert_null(octree_bodies_check(set));
            assert_int_equal(octree_bodies_remove_many(set, bodies + 100, count, NULL, NULL), OCTREE_OK);
            assert_null(octree_bodies_check(set));
            assert_int_equal(octree_bodies_insert_many(set, bodies + 100, count, NULL, NULL), OCTREE_OK);
            assert_null(octree_bodies_check(set));
        }
        octree_bodies *made_anew = make_body_set(cube(-8, 8), capacity);
        assert_int_equal(octree_bodies_insert_many(made_anew, bodies, BODIES, NULL, NULL), OCTREE_OK);
        assert_same_cost(set, made_anew);
        octree_bodies_destroy(set);
        octree_bodies_destroy(made_anew);
    }
}

/* Bodies that were removed or moved leave no trace. */
static void assert_cost_of_detour(uint32_t capacity)
{
    static octree_body bodies[BODIES];
    uint64_t seed = 5;
    octree_bodies *direct = make_body_set(cube(-8, 8), capacity), *detour = make_body_set(cube(-8, 8), capacity);
    for (size_t i = 0; i < BODIES; i++)
        bodies[i] = small_body(0.2, &seed, i);
    for (size_t i = 0; i < BODIES / 2; i++)
        assert_int_equal(octree_bodies_insert(direct, &bodies[i]), OCTREE_OK);
    for (size_t i = BODIES; i-- > 0;)
        assert_int_equal(octree_bodies_insert(detour, &bodies[i]), OCTREE_OK);
    for (size_t i = BODIES / 2; i < BODIES; i++)
        assert_int_equal(octree_bodies_remove(detour, &bodies[i]), OCTREE_OK);
    for (size_t i = 0; i < BODIES / 2; i += 3) {
        const octree_body elsewhere = small_body(0.2, &seed, i);
        assert_int_equal(octree_bodies_move(detour, &bodies[i], &elsewhere), OCTREE_OK);
        assert_int_equal(octree_bodies_move(detour, &elsewhere, &bodies[i]), OCTREE_OK);
    }
    assert_same_cost(direct, detour);
    octree_bodies_destroy(direct);
    octree_bodies_destroy(detour);
}

/* Leaves with more than 64 points are stored in another way. */
static void cost_depends_on_the_bodies_alone(void **state)
{
    (void)state;
    assert_cost_of_detour(6);
    assert_cost_of_detour(150);
}

static void body_that_moves_twice_in_a_call_leaves_no_trace(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    uint64_t seed = 6;
    octree_bodies *direct = make_body_set(cube(-8, 8), 6), *detour = make_body_set(cube(-8, 8), 6);
    for (size_t i = 0; i < BODIES; i++)
        bodies[i] = small_body(0.2, &seed, i);
    assert_int_equal(octree_bodies_insert_many(detour, bodies, BODIES, NULL, NULL), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        octree_body way[3] = {bodies[i], small_body(0.2, &seed, i), small_body(0.2, &seed, i)};
        for (int k = 1; k < 3; k++)
            memcpy(way[k].half, way[0].half, sizeof way[k].half);
        assert_int_equal(octree_bodies_move_many(detour, way, way + 1, 2, NULL, NULL), OCTREE_OK);
        bodies[i] = way[2];
    }
    assert_int_equal(octree_bodies_insert_many(direct, bodies, BODIES, NULL, NULL), OCTREE_OK);
    assert_same_cost(direct, detour);
    octree_bodies_destroy(direct);
    octree_bodies_destroy(detour);
}

/* Returns how many leaves a search above flat bodies reads: its box is in the same cells, but meets no body. */
static size_t count_leaves_above(const octree_bodies *set)
{
    octree_cost cost = {0};
    const octree_search how = {.cost = &cost};
    const octree_region above = {.kind = OCTREE_REGION_BOX, .box = {{-8, -8, 0.3}, {8, 8, 0.4}}};
    size_t count = 0;
    assert_int_equal(octree_bodies_search(set, &above, &how, count_body, &count), OCTREE_OK);
    return cost.leaves;
}

static void flat_bodies_have_flat_boxes(void **state)
{
    (void)state;
    uint64_t seed = 7;
    octree_bodies *set = make_body_set(cube(-8, 8), 8);
    for (uint64_t id = 0; id < 400; id++) {
        octree_body plate = small_body(0.2, &seed, id);
        plate.position[2] = 0.1;
        plate.half[0] = plate.half[1] = 0.2; /* all in one level, whose root is no leaf */
        plate.half[2] = 0.01;
        assert_int_equal(octree_bodies_insert(set, &plate), OCTREE_OK);
    }
    assert_int_equal(count_leaves_above(set), 0);
    const octree_body post = {{1, 1, 0.1}, {0.2, 0.2, 0.24}, 400};
    octree_body low = post;
    low.half[2] = 0.05;
    assert_int_equal(octree_bodies_insert(set, &post), OCTREE_OK);
    assert_int_equal(count_leaves_above(set), 1);
    assert_int_equal(octree_bodies_move(set, &post, &low), OCTREE_OK);
    assert_int_equal(count_leaves_above(set), 0);
    octree_bodies_destroy(set);
}

/* A leaf of many bodies keeps its box when the largest of them are removed: answers stay right. */
static void crowded_leaf_keeps_its_box(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 4);
    octree_hit hit;
    size_t count;
    for (uint64_t id = 0; id < 300; id++) {
        const double half = id % 3 == 0 ? 0.5 : 0.4;
        const octree_body crowd = {{1, 1, 1}, {half, half, half}, id},
                          other = {{-7, -7, -7 + id / 50.0}, {0.5, 0.5, 0.5}, id};
        assert_int_equal(octree_bodies_insert(set, &crowd), OCTREE_OK);
        assert_int_equal(octree_bodies_insert(set, &other), OCTREE_OK);
    }
    for (uint64_t id = 0; id < 300; id += 3) {
        const octree_body crowd = {{1, 1, 1}, {0.5, 0.5, 0.5}, id};
        assert_int_equal(octree_bodies_remove(set, &crowd), OCTREE_OK);
        assert_null(octree_bodies_check(set));
    }
    assert_int_equal(octree_bodies_nearest(set, (double[]){1, 1, 2}, 1, HUGE_VAL, NULL, NULL, NULL, &hit, &count),
                     OCTREE_OK);
    assert_int_equal(hit.body.id, 1);
    assert_true(fabs(hit.at - 0.6) < 1e-15);
    octree_bodies_destroy(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_follow_bulk_changes_of_all_sizes),
        cmocka_unit_test(cost_depends_on_the_bodies_alone),
        cmocka_unit_test(body_that_moves_twice_in_a_call_leaves_no_trace),
        cmocka_unit_test(flat_bodies_have_flat_boxes),
        cmocka_unit_test(crowded_leaf_keeps_its_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
