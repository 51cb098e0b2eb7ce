/* SPDX-License-Identifier: MIT */
/* test_find.c - Algorithm 3: exact coordinates, the lowest id, the bits that were stored. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "brute.h"

static void find_refuses_what_cannot_be_there(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 5, OCTREE_REFUSE);
    uint64_t id = 42;
    assert_int_equal(octree_find(tree, (double[3]){0, 0, 0}, &id), OCTREE_NOT_FOUND);
    assert_int_equal(octree_find(tree, (double[3]){0, NAN, 0}, &id), OCTREE_NOT_FINITE);
    assert_int_equal(octree_find(tree, (double[3]){0, 0, INFINITY}, &id), OCTREE_NOT_FINITE);
    assert_int_equal(octree_find(tree, (double[3]){0, 0, next_up(1)}, &id), OCTREE_OUTSIDE);
    assert_false(octree_contains(tree, (double[3]){NAN, 0, 0}, 1));
    assert_false(octree_contains(tree, (double[3]){9, 0, 0}, 1));
    octree_destroy(tree);
}

static void find_gives_the_lowest_id(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    static const uint64_t ids[] = {900, UINT64_MAX, 17, 3, 500, 0};
    static const uint64_t lowest[] = {900, 900, 17, 3, 3, 0};
    const double at[3] = {0.5, -0.5, 0.5};
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(octree_insert(tree, at, ids[i]), OCTREE_OK);
        uint64_t id = 1;
        assert_int_equal(octree_find(tree, at, &id), OCTREE_OK);
        assert_true(id == lowest[i]);
    }
    assert_int_equal(octree_find(tree, at, NULL), OCTREE_OK);
    assert_int_equal(octree_remove(tree, at, 0), OCTREE_OK);
    uint64_t id = 1;
    assert_int_equal(octree_find(tree, at, &id), OCTREE_OK);
    assert_true(id == 3);
    octree_destroy(tree);
}

static void find_distinguishes_neighbouring_doubles(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 3, 21, OCTREE_GROW);
    double x = 0.3;
    for (uint64_t id = 0; id < 20; id++, x = next_up(x))
        assert_int_equal(octree_insert(tree, (double[3]){x, 0, 0}, id), OCTREE_OK);
    x = 0.3;
    for (uint64_t expected = 0; expected < 20; expected++, x = next_up(x)) {
        uint64_t id;
        assert_int_equal(octree_find(tree, (double[3]){x, -0.0, 0}, &id), OCTREE_OK);
        assert_true(id == expected);
    }
    assert_int_equal(octree_find(tree, (double[3]){x, 0, 0}, NULL), OCTREE_NOT_FOUND);
    octree_destroy(tree);
}

/* Sets *context when the point's x is -0.0. */
static bool see_sign(const octree_point *point, void *context)
{
    *(bool *)context = signbit(point->position[0]) != 0;
    return true;
}

static void minus_zero_is_found_as_zero_and_keeps_its_bits(void **state)
{
    (void)state;
    for (int stored = 0; stored < 2; stored++)
        for (int asked = 0; asked < 2; asked++) {
            octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
            double at[3] = {stored ? -0.0 : 0.0, 0.5, 0.5};
            double other[3] = {asked ? -0.0 : 0.0, 0.5, 0.5};
            assert_int_equal(octree_insert(tree, at, 5), OCTREE_OK);
            assert_int_equal(octree_find(tree, other, NULL), OCTREE_OK);
            assert_true(octree_contains(tree, other, 5));
            bool negative = false;
            octree_box all = cube(-1, 1);
            assert_int_equal(octree_range(tree, &all, see_sign, &negative), OCTREE_OK);
            assert_true(negative == (stored == 1));
            octree_destroy(tree);
        }
}

static void find_agrees_with_a_scan(void **state)
{
    (void)state;
    for (size_t capacity = 1; capacity <= 64; capacity *= 2) {
        uint64_t random = capacity;
        octree *tree = make_tree(cube(0, 12), capacity, 6, OCTREE_GROW);
        brute all = {0};
        for (uint64_t i = 0; i < 1500; i++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] = (double)random_below(&random, 13);
            uint64_t id = random_below(&random, 50);
            bool stored = brute_contains(&all, at, id);
            assert_true(octree_contains(tree, at, id) == stored);
            uint64_t lowest = 0, found = 0;
            bool any = brute_find(&all, at, &lowest);
            assert_int_equal(octree_find(tree, at, &found), any ? OCTREE_OK : OCTREE_NOT_FOUND);
            assert_true(!any || found == lowest);
            assert_int_equal(octree_insert(tree, at, id), stored ? OCTREE_DUPLICATE : OCTREE_OK);
            if (!stored)
                brute_insert(&all, at, id);
        }
        brute_free(&all);
        octree_destroy(tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(find_refuses_what_cannot_be_there),
        cmocka_unit_test(find_gives_the_lowest_id),
        cmocka_unit_test(find_distinguishes_neighbouring_doubles),
        cmocka_unit_test(minus_zero_is_found_as_zero_and_keeps_its_bits),
        cmocka_unit_test(find_agrees_with_a_scan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
