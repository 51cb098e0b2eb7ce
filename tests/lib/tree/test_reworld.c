/* SPDX-License-Identifier: MIT */
/* test_reworld.c - octree_reworld() equals a new tree in that world, or changes nothing. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "counting_allocator.h"

static bool same_box(const octree_box *a, const octree_box *b)
{
    return same_position(a->min, b->min) && same_position(a->max, b->max);
}

/* The test fails unless giving this world to the tree is refused with this status and leaves the tree as it was. */
static void assert_stays(octree *tree, const octree_box *world, octree_status expected)
{
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    const octree_box before = octree_definition(tree).world;
    const size_t count = octree_count(tree);
    assert_int_equal(octree_reworld(tree, world), expected);
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    const octree_box after = octree_definition(tree).world;
    assert_memory_equal(&after, &before, sizeof before);
    assert_int_equal(octree_count(tree), count);
    assert_valid(tree);
}

/* A tree with the options of another, in another world, with these points inserted one by one. Tells whether any was
 * outside or refused. */
static octree *built_there(const octree *tree, octree_box world, const brute *all, bool *outside, bool *full)
{
    const octree_def def = octree_definition(tree);
    octree *other = make_tree(world, def.leaf_capacity, def.max_depth, def.full_leaf);
    *outside = *full = false;
    for (size_t i = 0; i < all->count; i++) {
        const octree_status status = octree_insert(other, all->points[i].position, all->points[i].id);
        *outside |= status == OCTREE_OUTSIDE;
        *full |= status == OCTREE_FULL;
    }
    return other;
}

static brute contents_of(const octree *tree)
{
    const octree_box everywhere = cube(-INFINITY, INFINITY);
    brute all = {0};
    assert_int_equal(octree_range(tree, &everywhere, brute_collect, &all), OCTREE_OK);
    return all;
}

/* Give the tree a world; the test fails unless it becomes what one built there is, or stays with the right status. */
static octree_status reworld(octree *tree, octree_box world)
{
    brute all = contents_of(tree);
    bool outside, full;
    octree *expected = built_there(tree, world, &all, &outside, &full);
    octree_status status = OCTREE_OK;
    if (outside || full) {
        status = outside ? OCTREE_OUTSIDE : OCTREE_FULL;
        assert_stays(tree, &world, status);
    } else {
        const octree_def before = octree_definition(tree);
        const uint64_t version = octree_version(tree);
        assert_int_equal(octree_reworld(tree, &world), OCTREE_OK);
        assert_true(octree_digest(tree) == octree_digest(expected));
        assert_int_equal(node_count(tree), node_count(expected));
        assert_true(same_box(&world, &before.world) || octree_version(tree) != version);
        const octree_def after = octree_definition(tree);
        assert_memory_equal(&after.world, &world, sizeof world);
        assert_true(after.leaf_capacity == before.leaf_capacity && after.max_depth == before.max_depth &&
                    after.full_leaf == before.full_leaf);
        brute left = contents_of(tree);
        assert_true(brute_equal(&left, &all));
        brute_free(&left);
    }
    assert_valid(tree);
    octree_destroy(expected);
    brute_free(&all);
    return status;
}

static void a_world_grows_and_shrinks(void **state)
{
    (void)state;
    static const double at[][3] = {{0.5, 0.5, 0.5}, {-1, -1, -1}, {1, 1, 1}, {-0.0, 0.25, 0}, {0.51, 0.5, 0.5}};
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    insert_all(tree, at, 5);
    const uint64_t digest = octree_digest(tree);
    assert_int_equal(reworld(tree, cube(-1000, 500)), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){-1000, 500, 2}, 9), OCTREE_OK);
    assert_int_equal(reworld(tree, cube(-1, 1)), OCTREE_OUTSIDE);
    assert_int_equal(octree_remove(tree, (double[3]){-1000, 500, 2}, 9), OCTREE_OK);
    assert_int_equal(reworld(tree, (octree_box){{-1, -1, -1}, {1, 1, 2}}), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 2.5}, 9), OCTREE_OUTSIDE);
    assert_int_equal(reworld(tree, cube(-1, 1)), OCTREE_OK);
    assert_true(octree_digest(tree) == digest);
    octree_destroy(tree);
}

static void points_on_the_new_faces_are_inside_and_an_ulp_beyond_is_not(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 21, OCTREE_REFUSE);
    for (uint64_t i = 0; i < 27; i++)
        assert_int_equal(
            octree_insert(tree, (double[3]){(double)(i % 3) - 1, (double)(i / 3 % 3) - 1, (double)(i / 9) - 1}, i),
            OCTREE_OK);
    for (int face = 0; face < 6; face++) {
        octree_box tight = cube(-1, 1);
        double *side = face < 3 ? &tight.min[face] : &tight.max[face - 3];
        *side = face < 3 ? next_up(-1) : next_down(1);
        assert_int_equal(reworld(tree, tight), OCTREE_OUTSIDE);
    }
    assert_int_equal(reworld(tree, cube(-1, 1)), OCTREE_OK);
    octree_destroy(tree);
}

static void a_bad_world_is_refused(void **state)
{
    (void)state;
    static const double pairs[][2] = {{NAN, 1}, {-1, NAN}, {-INFINITY, 1}, {-1, INFINITY},      {INFINITY, 1},
                                      {1, 1},   {2, 1},    {0.0, -0.0},    {DBL_MAX, -DBL_MAX}, {INFINITY, INFINITY}};
    octree *trees[] = {make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE), make_tree(cube(-1, 1), 1, 21, OCTREE_GROW)};
    insert_all(trees[1], (const double[][3]){{0, 0, 0}, {1, 1, 1}}, 2);
    for (int t = 0; t < 2; t++) {
        for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++)
            for (int axis = 0; axis < 3; axis++) {
                octree_box world = cube(-1, 1);
                world.min[axis] = pairs[i][0];
                world.max[axis] = pairs[i][1];
                assert_stays(trees[t], &world, OCTREE_BAD_WORLD);
            }
        assert_stays(trees[t], NULL, OCTREE_NULL_ARGUMENT);
        octree_destroy(trees[t]);
    }
    const octree_box world = cube(0, 1);
    assert_int_equal(octree_reworld(NULL, &world), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_reworld(NULL, NULL), OCTREE_NULL_ARGUMENT);
}

static void a_world_whose_leaves_would_refuse_is_full(void **state)
{
    (void)state;
    /* At depth 3 the points part in [0, 8] and share a cell of [0, 800]. */
    for (int grow = 0; grow < 2; grow++) {
        octree *tree = make_tree(cube(0, 8), 1, 3, grow ? OCTREE_GROW : OCTREE_REFUSE);
        insert_all(tree, (const double[][3]){{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {2.5, 7.5, 0.5}}, 3);
        assert_int_equal(reworld(tree, cube(0, 800)), grow ? OCTREE_OK : OCTREE_FULL);
        octree_destroy(tree);
    }
}

static void an_empty_tree_takes_any_world(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    const uint64_t version = octree_version(tree);
    assert_int_equal(reworld(tree, cube(5, 6)), OCTREE_OK);
    assert_true(octree_version(tree) != version);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OUTSIDE);
    assert_int_equal(octree_insert(tree, (double[3]){5.5, 6, 5}, 1), OCTREE_OK);
    assert_valid(tree);
    octree_destroy(tree);
}

static void the_bits_of_a_point_are_kept(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, (double[3]){-0.0, 0.0, -0.0}, UINT64_MAX), OCTREE_OK);
    assert_int_equal(reworld(tree, cube(-0.0, 7)), OCTREE_OK);
    octree_node root;
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &root), OCTREE_OK);
    assert_true(root.points[0].id == UINT64_MAX);
    assert_true(signbit(root.points[0].position[0]) && !signbit(root.points[0].position[1]) &&
                signbit(root.points[0].position[2]));
    octree_destroy(tree);
}

static const octree_box worlds[] = {
    {{-1, -1, -1}, {1, 1, 1}},
    {{0, 0, 0}, {1, 1, 1}},
    {{0, -1, -3}, {1, 7, 1}},
    {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
    {{-1e15, -1, -1e-3}, {1, 1e200, 2}},
    {{-5e-324, -1, 0}, {1, 1, DBL_MAX}},
    {{0.25, 0.25, 0.25}, {0.5, 0.75, 1}},
    {{-1, -1, -1}, {0.25, 0.25, 0.25}},
};

/* A point of a coarse grid of one of the worlds' common parts, seldom far away. */
static octree_point random_point(uint64_t *random)
{
    static const double far[] = {1e15, -1e200, DBL_MAX, 5e-324, 0x1p-30};
    octree_point point = {.id = random_below(random, 3)};
    for (int axis = 0; axis < 3; axis++)
        point.position[axis] =
            random_below(random, 200) == 0 ? far[random_below(random, 5)] : 0.25 * (double)random_below(random, 5);
    return point;
}

/* Some changes, each of which may be refused. */
static void change(octree *tree, uint64_t *random)
{
    octree_point batch[30];
    for (int i = 0; i < 30; i++)
        batch[i] = random_point(random);
    assert_int_equal(octree_insert_many(tree, batch, 20, NULL, NULL), OCTREE_OK);
    for (int i = 20; i < 30; i++)
        octree_move(tree, batch[i - 20].position, batch[i - 20].id, batch[i].position);
    assert_int_equal(octree_remove_many(tree, batch + 10, 12, NULL, NULL), OCTREE_OK);
    octree_insert(tree, batch[29].position, batch[29].id);
}

static void a_tree_of_any_history_is_what_one_built_there_is(void **state)
{
    (void)state;
    size_t seen[OCTREE_STATUS_COUNT] = {0};
    for (uint64_t seed = 0; seed < 600; seed++) {
        uint64_t random = seed;
        const octree_full_leaf full_leaf = seed % 2 ? OCTREE_GROW : OCTREE_REFUSE;
        octree *tree = make_tree(worlds[seed % 3], 1 + seed % 5, seed % 22, full_leaf);
        for (int i = 0; i < 6; i++) {
            change(tree, &random);
            seen[reworld(tree, worlds[random_below(&random, sizeof worlds / sizeof worlds[0])])]++;
        }
        octree_destroy(tree);
    }
    assert_true(seen[OCTREE_OK] > 300 && seen[OCTREE_OUTSIDE] > 300 && seen[OCTREE_FULL] > 100);
}

static void a_world_and_back_is_the_same_tree(void **state)
{
    (void)state;
    static const octree_box there[] = {
        {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
        {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}},
        {{1e15, -1e-300, 0}, {DBL_MAX, 1000, 2000}},
    };
    const octree_box home = {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}};
    uint64_t random = 3;
    octree *tree = make_tree(home, 2, 21, OCTREE_GROW);
    for (uint64_t id = 0; id < 500; id++) {
        const double at[3] = {1e15 + 0.125 * (double)random_below(&random, 9), (double)random_below(&random, 1001),
                              (double)random_below(&random, 1001)};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    }
    const uint64_t digest = octree_digest(tree);
    for (size_t i = 0; i < sizeof there / sizeof there[0]; i++) {
        assert_int_equal(reworld(tree, there[i]), OCTREE_OK);
        assert_int_equal(reworld(tree, home), OCTREE_OK);
        assert_true(octree_digest(tree) == digest);
    }
    octree_destroy(tree);
}

static void queries_are_right_in_the_new_world(void **state)
{
    (void)state;
    uint64_t random = 11;
    brute all = {0};
    brute_scatter(&all, &random, 500, 10, 1000);
    octree *tree = brute_tree(&all, cube(-10, 10), 3, 21);
    assert_int_equal(reworld(tree, (octree_box){{-1e6, -10, -77}, {11, 1e15, 12}}), OCTREE_OK);
    for (int i = 0; i < 200; i++) {
        double target[3];
        for (int axis = 0; axis < 3; axis++)
            target[axis] = (double)random_below(&random, 31) - 15;
        octree_neighbor nearest, best;
        assert_int_equal(octree_nearest(tree, target, OCTREE_SKIP_COINCIDENT, 0, &nearest), OCTREE_OK);
        assert_true(brute_nearest(&all, target, OCTREE_SKIP_COINCIDENT, 0, &best));
        assert_true(nearest.point.id == best.point.id && nearest.distance == best.distance);
        brute found = {0}, truth = {0};
        assert_int_equal(octree_radius(tree, target, 5, NULL, brute_collect, &found), OCTREE_OK);
        brute_radius(&all, target, 5, &truth);
        assert_true(brute_equal(&found, &truth));
        brute_free(&found);
        brute_free(&truth);
    }
    octree_destroy(tree);
    brute_free(&all);
}

static void assert_balanced(const octree *tree, const counting_allocator *counts)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.memory, counts->bytes);
}

static void a_custom_allocator_keeps_its_balance(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(0, 1), 2, 21, OCTREE_GROW);
    uint64_t random = 4;
    for (int i = 0; i < 200; i++) {
        change(tree, &random);
        for (uint64_t id = 100; i % 50 == 0 && id < 200; id++) /* a hashed leaf */
            octree_insert(tree, (double[3]){0.25, 0.25, 0.25}, id);
        assert_balanced(tree, &counts);
        octree_reworld(tree, &worlds[i % (sizeof worlds / sizeof worlds[0])]);
        assert_balanced(tree, &counts);
        assert_true(octree_definition(tree).allocator.context == &counts);
    }
    assert_valid(tree);
    assert_int_equal(octree_clear(tree), OCTREE_OK);
    assert_balanced(tree, &counts);
    assert_int_equal(octree_reworld(tree, &worlds[2]), OCTREE_OK);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_world_grows_and_shrinks),
        cmocka_unit_test(points_on_the_new_faces_are_inside_and_an_ulp_beyond_is_not),
        cmocka_unit_test(a_bad_world_is_refused),
        cmocka_unit_test(a_world_whose_leaves_would_refuse_is_full),
        cmocka_unit_test(an_empty_tree_takes_any_world),
        cmocka_unit_test(the_bits_of_a_point_are_kept),
        cmocka_unit_test(a_tree_of_any_history_is_what_one_built_there_is),
        cmocka_unit_test(a_world_and_back_is_the_same_tree),
        cmocka_unit_test(queries_are_right_in_the_new_world),
        cmocka_unit_test(a_custom_allocator_keeps_its_balance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
