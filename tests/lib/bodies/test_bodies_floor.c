/* SPDX-License-Identifier: MIT */
/* test_bodies_floor.c - which sizes of bodies share a level, and that the answers do not depend on it. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_scenes.h"
#include "counting_allocator.h"
#include "octree/digest.h"
#include "octree/sample.h"

enum { BODIES = 600, QUERIES = 60 };

/* Bodies whose sizes span three decades, in cube(-8, 8). */
static void make_decades(octree_body *bodies, size_t count, uint64_t seed)
{
    for (size_t i = 0; i < count; i++) {
        const double size = 4 * pow(1000, -octree_random_unit(&seed));
        bodies[i] = (octree_body){.id = i};
        for (int k = 0; k < 3; k++) {
            bodies[i].position[k] = 16 * octree_random_unit(&seed) - 8;
            bodies[i].half[k] = size * (0.75 + octree_random_unit(&seed) / 2);
        }
    }
}

static octree_bodies *make_set(octree_box world, const octree_allocator *allocator)
{
    octree_bodies *set;
    octree_def def = define(world, 4, 21, OCTREE_GROW);
    if (allocator)
        def.allocator = *allocator;
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    return set;
}

static void insert_one_by_one(octree_bodies *set, const octree_body *bodies, size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_int_equal(octree_bodies_insert(set, &bodies[i]), OCTREE_OK);
}

/* Returns the number of levels that have bodies. */
static unsigned count_levels(const octree_bodies *set)
{
    unsigned count = 0;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        count += octree_count(octree_bodies_level(set, i, NULL)) > 0;
    return count;
}

/* ---- Answers ------------------------------------------------------------------------------------------------ */

/* A sum that does not depend on the order of its terms. */
static bool add_body(const octree_body *body, void *context)
{
    *(uint64_t *)context += octree_digest_word(OCTREE_DIGEST_START, body->id);
    return true;
}

static bool add_pair(const octree_body *a, const octree_body *b, void *context)
{
    *(uint64_t *)context += octree_digest_word(octree_digest_word(OCTREE_DIGEST_START, a->id), b->id);
    return true;
}

static uint64_t digest_hits(const octree_hit *hits, size_t count)
{
    uint64_t digest = OCTREE_DIGEST_START;
    for (size_t i = 0; i < count; i++)
        digest = octree_digest_double(octree_digest_word(digest, hits[i].body.id), hits[i].at);
    return digest;
}

/* Returns a digest of the answers to queries of all kinds. */
static uint64_t digest_answers(const octree_bodies *set, scene_numbers numbers)
{
    uint64_t seed = 5, sum = 0, digest = OCTREE_DIGEST_START;
    for (int i = 0; i < QUERIES; i++) {
        octree_half_space half_spaces[OCTREE_MAX_HALF_SPACES];
        octree_hit hits[4];
        size_t count;
        double target[3];
        const octree_region_kind kind = (octree_region_kind)(i % OCTREE_REGION_KINDS);
        const octree_region region = random_region(numbers, kind, &seed, half_spaces);
        assert_int_equal(octree_bodies_search(set, &region, NULL, add_body, &sum), OCTREE_OK);
        if (kind == OCTREE_REGION_RAY || kind == OCTREE_REGION_SWEPT) {
            assert_int_equal(octree_bodies_cast(set, &region, 4, NULL, NULL, NULL, hits, &count), OCTREE_OK);
            digest = octree_digest_word(digest, digest_hits(hits, count));
        }
        random_target(numbers, &seed, target);
        assert_int_equal(octree_bodies_nearest(set, target, 4, HUGE_VAL, NULL, NULL, NULL, hits, &count), OCTREE_OK);
        digest = octree_digest_word(digest, digest_hits(hits, count));
    }
    assert_int_equal(octree_bodies_pairs(set, NULL, add_pair, &sum), OCTREE_OK);
    return octree_digest_word(digest, sum);
}

static void small_bodies_share_a_level_after_a_bulk_insertion(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    octree_bodies *bulk = make_set(cube(-8, 8), NULL), *single = make_set(cube(-8, 8), NULL);
    make_decades(bodies, BODIES, 3);
    assert_int_equal(octree_bodies_insert_many(bulk, bodies, BODIES, NULL, NULL), OCTREE_OK);
    insert_one_by_one(single, bodies, BODIES);
    assert_int_equal(count_levels(single), 6);
    assert_int_equal(count_levels(bulk), 3);
    assert_true(digest_answers(bulk, NUMBERS_SMOOTH) == digest_answers(single, NUMBERS_SMOOTH));
    assert_int_equal(octree_bodies_compact(single), OCTREE_OK);
    assert_int_equal(count_levels(single), 3);
    octree_bodies_destroy(bulk);
    octree_bodies_destroy(single);
}

/* Insert BODIES bodies into an empty set, count the levels that have bodies, and destroy the set. */
static void assert_levels(octree_bodies *set, const octree_body *bodies, unsigned expected)
{
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    assert_int_equal(count_levels(set), expected);
    octree_bodies_destroy(set);
}

/* The leaves of a dense cluster are small beside the grid whose counts are known. */
static void dense_cluster_has_a_small_floor(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    make_decades(bodies, BODIES, 3);
    for (size_t i = 0; i < BODIES; i++)
        for (int k = 0; k < 3; k++)
            bodies[i].position[k] /= 1024;
    assert_levels(make_set(cube(-8, 8), NULL), bodies, 6);
}

/* Whole numbers are on planes of the grid, where the computed key of a coordinate is not certain. */
static void bodies_on_planes_of_the_grid_count(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    make_decades(bodies, BODIES, 3);
    for (size_t i = 0; i < BODIES; i++)
        for (int k = 0; k < 3; k++)
            bodies[i].position[k] = floor(bodies[i].position[k]);
    assert_levels(make_set(cube(-8, 8), NULL), bodies, 3);
}

/* One body in twenty is in a dense cluster: the leaves of the others decide. */
static void few_crowded_bodies_do_not_change_the_floor(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    make_decades(bodies, BODIES, 3);
    for (size_t i = 0; i < BODIES; i += 20)
        for (int k = 0; k < 3; k++)
            bodies[i].position[k] /= 1024;
    assert_levels(make_set(cube(-8, 8), NULL), bodies, 3);
}

/* At most 21 levels, or as many as the definition says, divide crowds. */
static void floor_is_that_of_the_deepest_leaves(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    octree_bodies *set;
    const octree_def def = define(cube(-8, 8), 4, 2, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    make_decades(bodies, BODIES, 3);
    for (size_t i = 0; i < BODIES; i++)
        for (int k = 0; k < 3; k++)
            bodies[i].half[k] = fmin(bodies[i].half[k], 5.9);
    assert_levels(set, bodies, 1);
}

static void refused_bodies_do_not_count(void **state)
{
    (void)state;
    static octree_body bodies[BODIES + BODIES / 2];
    size_t changed;
    octree_bodies *set = make_set(cube(-8, 8), NULL);
    make_decades(bodies, BODIES, 3);
    for (size_t i = 0; i < BODIES / 2; i++)
        bodies[BODIES + i].position[0] = i % 3 == 0 ? NAN : i % 3 == 1 ? 9 : -9;
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES + BODIES / 2, NULL, &changed), OCTREE_OK);
    assert_int_equal(changed, BODIES);
    assert_int_equal(count_levels(set), 3);
    octree_bodies_destroy(set);
}

static void answers_are_the_same_with_and_without_a_floor(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    for (int numbers = 0; numbers < NUMBERS_KINDS; numbers++) {
        uint64_t seed = 31 + (uint64_t)numbers;
        const octree_box world = scene_world((scene_numbers)numbers);
        octree_bodies *bulk = make_set(world, NULL), *single = make_set(world, NULL);
        for (size_t i = 0; i < BODIES; i++)
            bodies[i] = random_body((scene_numbers)numbers, &seed, i);
        assert_int_equal(octree_bodies_insert_many(bulk, bodies, BODIES, NULL, NULL), OCTREE_OK);
        insert_one_by_one(single, bodies, BODIES);
        assert_null(octree_bodies_check(bulk));
        assert_true(digest_answers(bulk, (scene_numbers)numbers) == digest_answers(single, (scene_numbers)numbers));
        octree_bodies_destroy(bulk);
        octree_bodies_destroy(single);
    }
}

/* ---- Growth ------------------------------------------------------------------------------------------------- */

/* Two bodies are one leaf, which makes the floor large. With many more, large bodies must leave the last level. */
static void set_that_has_grown_chooses_again(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    octree_bodies *set = make_set(cube(-8, 8), NULL);
    make_decades(bodies, BODIES, 4);
    assert_int_equal(octree_bodies_insert_many(set, bodies, 2, NULL, NULL), OCTREE_OK);
    insert_one_by_one(set, bodies + 2, 5);
    assert_int_equal(count_levels(set), 1);
    insert_one_by_one(set, bodies + 7, BODIES - 7);
    assert_int_equal(count_levels(set), 3);
    assert_null(octree_bodies_check(set));

    assert_int_equal(octree_bodies_clear(set), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(set, bodies, 2, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(set, bodies + 2, BODIES - 2, NULL, NULL), OCTREE_OK);
    assert_int_equal(count_levels(set), 3);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
}

static void cleared_set_has_no_floor(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    octree_bodies *set = make_set(cube(-8, 8), NULL);
    make_decades(bodies, BODIES, 3);
    assert_int_equal(octree_bodies_insert_many(set, bodies, BODIES, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_clear(set), OCTREE_OK);
    insert_one_by_one(set, bodies, BODIES);
    assert_int_equal(count_levels(set), 6);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
}

/* An insertion that has no memory to rebuild the set succeeds nevertheless, and later ones do not try it each time. */
static void rebuilding_without_memory_changes_nothing(void **state)
{
    (void)state;
    static octree_body bodies[16];
    size_t failures = 0;
    make_decades(bodies, 16, 4);
    for (size_t n = 0; n < 40; n++) {
        counting_allocator counts = {0};
        const octree_allocator allocator = counting_allocator_use(&counts);
        octree_bodies *set = make_set(cube(-8, 8), &allocator);
        assert_int_equal(octree_bodies_insert_many(set, bodies, 3, NULL, NULL), OCTREE_OK);
        insert_one_by_one(set, bodies + 3, 8);
        counting_allocator_fail_at(&counts, n);
        counts.fail_until = SIZE_MAX;
        const octree_status status = octree_bodies_insert(set, &bodies[11]);
        failures += counts.calls > counts.fail_from && status == OCTREE_OK;
        counting_allocator_stop_failing(&counts);
        assert_null(octree_bodies_check(set));
        assert_true(octree_bodies_contain(set, &bodies[11]) == (status == OCTREE_OK));
        const size_t calls = counts.calls;
        assert_true(status != OCTREE_OK || octree_bodies_insert(set, &bodies[12]) == OCTREE_OK);
        assert_true(counts.calls - calls < 4);
        octree_bodies_destroy(set);
        assert_all_returned(&counts);
    }
    assert_true(failures > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_bodies_share_a_level_after_a_bulk_insertion),
        cmocka_unit_test(dense_cluster_has_a_small_floor),
        cmocka_unit_test(bodies_on_planes_of_the_grid_count),
        cmocka_unit_test(few_crowded_bodies_do_not_change_the_floor),
        cmocka_unit_test(floor_is_that_of_the_deepest_leaves),
        cmocka_unit_test(refused_bodies_do_not_count),
        cmocka_unit_test(answers_are_the_same_with_and_without_a_floor),
        cmocka_unit_test(set_that_has_grown_chooses_again),
        cmocka_unit_test(cleared_set_has_no_floor),
        cmocka_unit_test(rebuilding_without_memory_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
