/* SPDX-License-Identifier: MIT */
/* test_exact_bodies.c - every query of bodies against rational numbers: touching faces, grazing rays, equal distances,
 * and every scale of doubles. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_asks.h"
#include "body_scenes.h"

enum { BODIES = 48, SCENES = 10, QUERIES = 12 };

static body_scene make_scene(scene_numbers numbers, uint64_t seed)
{
    body_scene s = {.numbers = numbers, .seed = seed, .bodies = calloc(BODIES, sizeof *s.bodies)};
    assert_non_null(s.bodies);
    octree_def def = define(scene_world(numbers), 1 + seed % 4, 21, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &s.set), OCTREE_OK);
    while (s.count < BODIES) {
        octree_body body = random_body(numbers, &s.seed, random_below(&s.seed, 20));
        const octree_status status = octree_bodies_insert(s.set, &body);
        if (status == OCTREE_OK)
            s.bodies[s.count++] = body;
        else
            assert_int_equal(status, OCTREE_DUPLICATE);
    }
    assert_null(octree_bodies_check(s.set));
    return s;
}

static void destroy_scene(body_scene *s)
{
    octree_bodies_destroy(s->set);
    free(s->bodies);
}

/* ---- Pairs -------------------------------------------------------------------------------------------------- */

/* The same bodies, inserted in reverse order and after a detour, give the same pairs in the same order. */
static void assert_order_of_pairs(const body_scene *s)
{
    uint64_t order = 0, again = 0;
    octree_bodies *other;
    const octree_def def = octree_bodies_definition(s->set);
    assert_int_equal(octree_bodies_create(&def, &other), OCTREE_OK);
    for (size_t i = s->count; i-- > 0;)
        assert_int_equal(octree_bodies_insert(other, &s->bodies[i]), OCTREE_OK);
    for (size_t i = 0; i < s->count; i += 3)
        assert_int_equal(octree_bodies_remove(other, &s->bodies[i]), OCTREE_OK);
    for (size_t i = 0; i < s->count; i += 3)
        assert_int_equal(octree_bodies_insert(other, &s->bodies[i]), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(s->set, NULL, add_pair_to_order, &order), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(other, NULL, add_pair_to_order, &again), OCTREE_OK);
    assert_int_equal(order, again);
    assert_true(octree_bodies_digest(s->set) == octree_bodies_digest(other));
    octree_bodies_destroy(other);
}

/* ---- Tests -------------------------------------------------------------------------------------------------- */

typedef void scene_check(body_scene *s);

static void check_scenes(scene_check *check)
{
    for (int numbers = 0; numbers < NUMBERS_KINDS; numbers++)
        for (uint64_t seed = 1; seed <= SCENES; seed++) {
            body_scene s = make_scene((scene_numbers)numbers, seed);
            check(&s);
            destroy_scene(&s);
        }
}

static void check_regions(body_scene *s)
{
    body_scene_assert_regions(s, QUERIES);
}

static void check_order(body_scene *s)
{
    for (int i = 0; i < QUERIES / 2; i++) {
        body_scene_assert_nearest(s);
        body_scene_assert_cast(s, OCTREE_REGION_RAY);
        body_scene_assert_cast(s, OCTREE_REGION_SWEPT);
    }
}

static void check_pairs(body_scene *s)
{
    body_scene other = make_scene(s->numbers, s->seed | 1);
    body_scene in_another_world = make_scene((scene_numbers)((s->numbers + 1) % NUMBERS_KINDS), s->seed | 1);
    body_scene_assert_pairs(s);
    body_scene_assert_pairs_between(s, &other);
    body_scene_assert_pairs_between(s, &in_another_world);
    body_scene_assert_pairs_between(&in_another_world, s);
    assert_order_of_pairs(s);
    destroy_scene(&in_another_world);
    destroy_scene(&other);
}

static void regions_find_the_bodies_that_real_numbers_find(void **state)
{
    (void)state;
    check_scenes(check_regions);
}

static void neighbours_and_hits_have_the_order_of_real_numbers(void **state)
{
    (void)state;
    check_scenes(check_order);
}

static void pairs_are_those_of_real_numbers_each_once_in_one_order(void **state)
{
    (void)state;
    check_scenes(check_pairs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_find_the_bodies_that_real_numbers_find),
        cmocka_unit_test(neighbours_and_hits_have_the_order_of_real_numbers),
        cmocka_unit_test(pairs_are_those_of_real_numbers_each_once_in_one_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
