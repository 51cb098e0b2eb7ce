/* SPDX-License-Identifier: MIT */
/* test_bodies_pairs.c - each pair of overlapping bodies is visited once, in crowds and among many neighbours, too. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "body_sets.h"
#include "brute_bodies.h"

enum { MOST = 700, CROWD = 200 };

/* How often each pair was visited, by the ids of its bodies, which are their indices. */
typedef struct visited {
    unsigned char times[MOST][MOST];
    size_t count, stop_at;
} visited;

static visited seen;

static bool record_pair(const octree_body *a, const octree_body *b, void *context)
{
    (void)context;
    seen.times[a->id][b->id]++;
    return ++seen.count != seen.stop_at;
}

/* Returns a random multiple of 2^-8: so brute_bodies_overlap() is exact. */
static double random_step(uint64_t *seed, double least, double most)
{
    return ldexp(floor(ldexp(random_between(seed, least, most), 8)), -8);
}

/* Make bodies with half extents up to `most`; those below `crowd` are at one place. */
static void make_bodies(octree_body *bodies, size_t count, size_t crowd, double most, uint64_t seed)
{
    for (uint64_t i = 0; i < count; i++) {
        bodies[i] = (octree_body){.id = i};
        for (int k = 0; k < 3; k++) {
            bodies[i].position[k] = i < crowd ? 1 : random_step(&seed, -8, 8);
            bodies[i].half[k] = random_step(&seed, 0, i % 8 ? most / 16 : most);
        }
    }
}

static octree_bodies *make_set(const octree_body *bodies, size_t count, bool in_bulk)
{
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    if (in_bulk)
        assert_int_equal(octree_bodies_insert_many(set, bodies, count, NULL, NULL), OCTREE_OK);
    for (size_t i = 0; !in_bulk && i < count; i++)
        assert_int_equal(octree_bodies_insert(set, &bodies[i]), OCTREE_OK);
    return set;
}

static void assert_pairs_within(const octree_body *bodies, size_t count, bool in_bulk)
{
    octree_bodies *set = make_set(bodies, count, in_bulk);
    memset(&seen, 0, sizeof seen);
    assert_int_equal(octree_bodies_pairs(set, NULL, record_pair, NULL), OCTREE_OK);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < count; k++)
            assert_int_equal(seen.times[i][k], i < k && brute_bodies_overlap(&bodies[i], &bodies[k]));
    octree_bodies_destroy(set);
}

static void assert_pairs_between(const octree_body *a, size_t a_count, const octree_body *b, size_t b_count)
{
    octree_bodies *one = make_set(a, a_count, true), *other = make_set(b, b_count, false);
    memset(&seen, 0, sizeof seen);
    assert_int_equal(octree_bodies_pairs(one, other, record_pair, NULL), OCTREE_OK);
    for (size_t i = 0; i < a_count; i++)
        for (size_t k = 0; k < b_count; k++)
            assert_int_equal(seen.times[i][k], brute_bodies_overlap(&a[i], &b[k]));
    octree_bodies_destroy(one);
    octree_bodies_destroy(other);
}

static void pairs_of_few_and_many_neighbours_are_visited_once(void **state)
{
    (void)state;
    octree_body bodies[MOST];
    const double sizes[] = {0.5, 2, 16};
    for (size_t i = 0; i < 3; i++) {
        make_bodies(bodies, MOST, 0, sizes[i], i);
        assert_pairs_within(bodies, MOST, true);
        assert_pairs_within(bodies, MOST, false); /* in more levels */
    }
}

static void pairs_of_bodies_that_fill_the_world_are_visited_once(void **state)
{
    (void)state;
    octree_body bodies[MOST];
    make_bodies(bodies, MOST, 0, 1, 9);
    for (size_t i = 0; i < MOST; i++)
        for (int k = 0; k < 3; k++)
            bodies[i].half[k] += 5;
    assert_pairs_within(bodies, MOST, true);
}

static void pairs_of_a_crowd_are_visited_once(void **state)
{
    (void)state;
    octree_body bodies[MOST];
    make_bodies(bodies, MOST, CROWD, 1, 4);
    assert_pairs_within(bodies, MOST, true);
    assert_pairs_within(bodies, MOST, false);
    assert_pairs_within(bodies, CROWD, true);
}

static void pairs_of_two_sets_are_visited_once(void **state)
{
    (void)state;
    octree_body few[20], bodies[MOST], crowd[MOST];
    make_bodies(few, 20, 0, 8, 5);
    make_bodies(bodies, MOST, 0, 2, 6);
    make_bodies(crowd, MOST, CROWD, 1, 7);
    assert_pairs_between(few, 20, bodies, MOST);
    assert_pairs_between(bodies, MOST, few, 20);
    assert_pairs_between(bodies, MOST, crowd, MOST);
    assert_pairs_between(crowd, MOST, bodies, MOST);
}

static void a_visitor_stops_after_any_pair(void **state)
{
    (void)state;
    octree_body bodies[MOST];
    make_bodies(bodies, MOST, CROWD, 1, 8);
    octree_bodies *set = make_set(bodies, MOST, true);
    memset(&seen, 0, sizeof seen);
    assert_int_equal(octree_bodies_pairs(set, NULL, record_pair, NULL), OCTREE_OK);
    const size_t all = seen.count;
    for (size_t stop_at = 1; stop_at < all; stop_at += all / 50) {
        memset(&seen, 0, sizeof seen);
        seen.stop_at = stop_at;
        assert_int_equal(octree_bodies_pairs(set, NULL, record_pair, NULL), OCTREE_OK);
        assert_int_equal(seen.count, stop_at);
    }
    octree_bodies_destroy(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_of_few_and_many_neighbours_are_visited_once),
        cmocka_unit_test(pairs_of_bodies_that_fill_the_world_are_visited_once),
        cmocka_unit_test(pairs_of_a_crowd_are_visited_once),
        cmocka_unit_test(pairs_of_two_sets_are_visited_once),
        cmocka_unit_test(a_visitor_stops_after_any_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
