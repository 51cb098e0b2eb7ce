/* SPDX-License-Identifier: MIT */
/* test_bodies.c - the contract of a set of bodies: changes, definitions, levels, points as bodies. */
#include "fixture.h"

#include <math.h>

#include "body_scenes.h"
#include "body_sets.h"
#include "octree/sample.h"

static void a_body_is_inserted_moved_resized_and_removed(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_body a = body_at(1, 2, 3, 1, 7), moved = body_at(-4, 2, 3, 1, 7), resized = body_at(-4, 2, 3, 5, 7);
    assert_int_equal(octree_bodies_insert(set, &a), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &a), OCTREE_DUPLICATE);
    assert_true(octree_bodies_contain(set, &a) && !octree_bodies_contain(set, &moved));
    assert_int_equal(octree_bodies_move(set, &a, &moved), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &a, &moved), OCTREE_NOT_FOUND);
    assert_int_equal(octree_bodies_move(set, &moved, &moved), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &moved, &resized), OCTREE_OK);
    assert_true(octree_bodies_contain(set, &resized) && octree_bodies_count(set) == 1);
    assert_null(octree_bodies_check(set));
    assert_int_equal(octree_bodies_remove(set, &moved), OCTREE_NOT_FOUND);
    assert_int_equal(octree_bodies_remove(set, &resized), OCTREE_OK);
    assert_int_equal(octree_bodies_count(set), 0);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
}

static void bodies_that_differ_in_one_member_are_different(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 1);
    octree_body same = body_at(1, 1, 1, 1, 1), other[3] = {same, same, same};
    other[0].id = 2;
    other[1].half[2] = 0.5;
    other[2].position[0] = 1.5;
    assert_int_equal(octree_bodies_insert(set, &same), OCTREE_OK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(octree_bodies_insert(set, &other[i]), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &other[0], &same), OCTREE_DUPLICATE);
    const octree_body small = body_at(1, 1, 1, 0.01, 1); /* in another level */
    assert_int_equal(octree_bodies_insert(set, &small), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &small, &same), OCTREE_DUPLICATE);
    assert_int_equal(octree_bodies_remove(set, &small), OCTREE_OK);
    assert_int_equal(octree_bodies_count(set), 4);
    same.position[1] = -0.0;
    other[0] = same;
    other[0].position[1] = 0.0;
    assert_int_equal(octree_bodies_insert(set, &same), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &other[0]), OCTREE_DUPLICATE); /* zeros are equal */
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
}

/* A body with one bad number, and the status that it gets. */
typedef struct bad_body {
    octree_body body;
    octree_status status;
} bad_body;

static void bad_bodies_get_a_status_and_change_nothing(void **state)
{
    (void)state;
    const bad_body bad[] = {
        {{{NAN, 0, 0}, {1, 1, 1}, 1}, OCTREE_NOT_FINITE},      {{{0, HUGE_VAL, 0}, {1, 1, 1}, 1}, OCTREE_NOT_FINITE},
        {{{0, 0, 9}, {1, 1, 1}, 1}, OCTREE_OUTSIDE},           {{{0, 0, 0}, {NAN, 1, 1}, 1}, OCTREE_NOT_FINITE},
        {{{0, 0, 0}, {1, HUGE_VAL, 1}, 1}, OCTREE_NOT_FINITE}, {{{0, 0, 0}, {1, 1, -1}, 1}, OCTREE_BAD_SIZE},
        {{{0, 0, 0}, {1, 1, -0x1p-1074}, 1}, OCTREE_BAD_SIZE},
    };
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_body good = body_at(1, 2, 3, 1, 7);
    assert_int_equal(octree_bodies_insert(set, &good), OCTREE_OK);
    const uint64_t digest = octree_bodies_digest(set);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        octree_status status;
        assert_int_equal(octree_bodies_insert(set, &bad[i].body), bad[i].status);
        assert_int_equal(octree_bodies_remove(set, &bad[i].body), bad[i].status);
        assert_int_equal(octree_bodies_move(set, &good, &bad[i].body), bad[i].status);
        assert_int_equal(octree_bodies_insert_many(set, &bad[i].body, 1, &status, NULL), OCTREE_OK);
        assert_int_equal(status, bad[i].status);
        assert_false(octree_bodies_contain(set, &bad[i].body));
    }
    assert_int_equal(octree_bodies_insert(set, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_insert(NULL, &good), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_insert_many(set, NULL, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_move_many(set, &good, NULL, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_true(octree_bodies_digest(set) == digest);
    octree_bodies_destroy(set);
}

static void bad_definitions_are_refused(void **state)
{
    (void)state;
    octree_bodies *set = (octree_bodies *)state;
    octree_def def = octree_bodies_def_default();
    assert_int_equal(octree_bodies_create(NULL, &set), OCTREE_NULL_ARGUMENT);
    assert_null(set);
    assert_int_equal(octree_bodies_create(&def, NULL), OCTREE_NULL_ARGUMENT);
    def.full_leaf = OCTREE_REFUSE;
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_BAD_OPTION);
    def = octree_bodies_def_default();
    def.world.max[0] = def.world.min[0];
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_BAD_WORLD);
    octree_bodies_destroy(NULL);
}

static void a_definition_is_returned_as_it_was_given(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 5);
    const octree_def def = octree_bodies_definition(set);
    assert_int_equal(def.leaf_capacity, 5);
    assert_true(def.world.max[2] == 8);
    octree_bodies_destroy(set);
}

static void bodies_of_similar_size_share_a_level(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const double halves[] = {1e300, 8, 4, 1.5, 1e-9, 0}; /* a level spans a factor of 4: the first from 4 on */
    for (size_t i = 0; i < 6; i++) {
        const octree_body body = body_at(0, 0, 0, halves[i], i);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    size_t counts[OCTREE_BODY_LEVELS] = {0};
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++) {
        double reach[3];
        counts[i] = octree_count(octree_bodies_level(set, i, reach));
        assert_true(i == 0 ? reach[0] >= 1e300 : reach[0] == ldexp(16, -2 * (int)i));
    }
    assert_int_equal(counts[0], 3);
    assert_int_equal(counts[1], 1);
    assert_int_equal(counts[OCTREE_BODY_LEVELS - 1], 2);
    assert_null(octree_bodies_level(set, OCTREE_BODY_LEVELS, NULL));
    octree_bodies_destroy(set);
}

/* The reach on each axis is above the largest half extent by a factor of at most 1.25, and follows removals. */
static void the_reach_of_level_0_follows_the_half_extents_on_each_axis(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_body plate = {{0, 0, 0}, {8, 8, 0.09}, 1}, cube_body = body_at(0, 0, 0, 9.6, 2);
    double reach[3];
    assert_int_equal(octree_bodies_insert(set, &plate), OCTREE_OK);
    assert_int_equal(octree_count(octree_bodies_level(set, 0, reach)), 1);
    assert_true(reach[0] >= 8 && reach[0] <= 10 && reach[2] >= 0.09 && reach[2] <= 0.09 * 1.25);
    assert_int_equal(octree_bodies_insert(set, &cube_body), OCTREE_OK);
    octree_bodies_level(set, 0, reach);
    assert_true(reach[2] >= 9.6 && reach[2] <= 12);
    assert_int_equal(octree_bodies_remove(set, &cube_body), OCTREE_OK);
    octree_bodies_level(set, 0, reach);
    assert_true(reach[0] <= 10 && reach[2] <= 0.09 * 1.25);
    octree_bodies_destroy(set);
}

static octree_walk_order compare_points_with_bodies(const octree_node *node, void *context)
{
    const octree_bodies *set = context;
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        octree_body body;
        octree_bodies_at(set, &node->points[i], &body);
        assert_true(same_position(body.position, node->points[i].position) && octree_bodies_contain(set, &body));
    }
    return OCTREE_WALK_ON;
}

static void the_nodes_of_a_level_lead_to_the_bodies(void **state)
{
    (void)state;
    uint64_t seed = 1;
    octree_bodies *set = make_body_set(scene_world(NUMBERS_SMOOTH), 2);
    for (uint64_t id = 0; id < 100; id++) {
        const octree_body body = random_body(NUMBERS_SMOOTH, &seed, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        if (octree_bodies_level(set, i, NULL))
            octree_walk(octree_bodies_level(set, i, NULL), compare_points_with_bodies, set);
    octree_bodies_destroy(set);
}

static void points_of_a_tree_are_bodies_of_one_size(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 2, 21, OCTREE_GROW);
    octree_bodies *set = (octree_bodies *)state;
    const double half[3] = {0.5, 0.5, 0}, bad[3] = {0, -1, 0}, positions[3][3] = {{0, 0, 0}, {1, 1, 0}, {2.25, 1, 0}};
    insert_all(tree, positions, 3);
    assert_int_equal(octree_bodies_of_points(tree, bad, &set), OCTREE_BAD_SIZE);
    assert_null(set);
    assert_int_equal(octree_bodies_of_points(NULL, half, &set), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_of_points(tree, half, &set), OCTREE_OK);
    assert_int_equal(octree_bodies_count(set), 3);
    size_t pairs = 0;
    assert_int_equal(octree_bodies_pairs(set, NULL, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(pairs, 1); /* the first two touch at an edge */
    octree_hit hit;
    size_t count;
    const octree_region ray = {
        .kind = OCTREE_REGION_RAY, .origin = {-4, 0.5, 0}, .direction = {2, 0, 0}, .length = HUGE_VAL};
    assert_int_equal(octree_bodies_cast(set, &ray, 1, NULL, NULL, NULL, &hit, &count), OCTREE_OK);
    assert_true(count == 1 && hit.body.id == 1 && hit.at == 1.75);
    const octree_body body = {{1, 1, 0}, {0.5, 0.5, 0}, 2};
    assert_true(octree_bodies_contain(set, &body));
    assert_int_equal(octree_bodies_insert(set, &body), OCTREE_BAD_OPTION);
    assert_int_equal(octree_bodies_clear(set), OCTREE_BAD_OPTION);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
    assert_int_equal(octree_count(tree), 3);
    octree_destroy(tree);
}

/* Two worlds that have nothing in common, but bodies that reach from one into the other. */
static void bodies_of_separate_worlds_meet(void **state)
{
    (void)state;
    octree_bodies *left = make_body_set(cube(-8, -1), 4), *right = make_body_set(cube(1, 8), 4);
    size_t pairs = 0;
    const octree_body a = body_at(-2, -2, -2, 3, 1), b = body_at(2, 2, 2, 1, 2), c = body_at(5, 5, 5, 1, 3);
    assert_int_equal(octree_bodies_insert(left, &a), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(right, &b), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(right, &c), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(left, right, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(right, left, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(pairs, 2);
    octree_bodies_destroy(left);
    octree_bodies_destroy(right);
}

/* A world of subnormal numbers, whose extent has no inverse. */
static void bodies_of_a_subnormal_world_meet(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-1e-310, 1e-310), 4);
    size_t pairs = 0;
    const octree_body middle = body_at(0, 0, 0, 0, 1), around = body_at(1e-311, 0, 0, 1e-311, 2),
                      beside = body_at(-1e-311, 0, 0, 0, 3);
    assert_int_equal(octree_bodies_insert(set, &middle), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &around), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &beside), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(set, NULL, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(pairs, 1);
    octree_bodies_destroy(set);
}

/* A set that shows the points of a tree does as one that is made after the tree has changed its capacity and world. */
static void set_that_shows_points_follows_the_tree(void **state)
{
    (void)state;
    octree_bodies *before, *after;
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_GROW);
    const octree_mix changes = {.changes = 1};
    const double half[3] = {0.5, 0.5, 0.5};
    uint64_t seed = 4, order = 0, order_after = 0;
    for (uint64_t i = 0; i < 1000; i++) {
        double position[3];
        for (int k = 0; k < 3; k++)
            position[k] = 16 * octree_random_unit(&seed) - 8;
        assert_int_equal(octree_insert(tree, position, i), OCTREE_OK);
    }
    assert_int_equal(octree_bodies_of_points(tree, half, &before), OCTREE_OK);
    assert_int_equal(octree_tune(tree, &changes), OCTREE_OK);
    const octree_box world = cube(-9, 8);
    assert_int_equal(octree_reworld(tree, &world), OCTREE_OK);
    assert_int_equal(octree_bodies_of_points(tree, half, &after), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(before, NULL, add_pair_to_order, &order), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(after, NULL, add_pair_to_order, &order_after), OCTREE_OK);
    assert_int_equal(order, order_after);
    octree_bodies_destroy(before);
    octree_bodies_destroy(after);
    octree_destroy(tree);
}

static void null_is_an_empty_set(void **state)
{
    (void)state;
    assert_int_equal(octree_bodies_count(NULL), 0);
    assert_true(octree_bodies_digest(NULL) == 0);
    assert_int_equal(octree_bodies_memory(NULL), 0);
    assert_null(octree_bodies_check(NULL));
    assert_null(octree_bodies_level(NULL, 0, NULL));
    assert_int_equal(octree_bodies_clear(NULL), OCTREE_NULL_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_is_inserted_moved_resized_and_removed),
        cmocka_unit_test(bodies_that_differ_in_one_member_are_different),
        cmocka_unit_test(bad_bodies_get_a_status_and_change_nothing),
        cmocka_unit_test(bad_definitions_are_refused),
        cmocka_unit_test(a_definition_is_returned_as_it_was_given),
        cmocka_unit_test(bodies_of_similar_size_share_a_level),
        cmocka_unit_test(the_reach_of_level_0_follows_the_half_extents_on_each_axis),
        cmocka_unit_test(the_nodes_of_a_level_lead_to_the_bodies),
        cmocka_unit_test(points_of_a_tree_are_bodies_of_one_size),
        cmocka_unit_test(bodies_of_separate_worlds_meet),
        cmocka_unit_test(bodies_of_a_subnormal_world_meet),
        cmocka_unit_test(set_that_shows_points_follows_the_tree),
        cmocka_unit_test(null_is_an_empty_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
