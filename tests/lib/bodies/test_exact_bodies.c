/* SPDX-License-Identifier: MIT */
/* test_exact_bodies.c - every query of bodies against rational numbers: touching faces, grazing rays, equal distances,
 * and every scale of doubles. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_oracle.h"
#include "body_scenes.h"

enum { BODIES = 48, SCENES = 10, QUERIES = 12 };

/* A scene: the bodies as a list, and as a set. */
typedef struct scene {
    scene_numbers numbers;
    uint64_t seed;
    octree_body bodies[BODIES];
    size_t count;
    octree_bodies *set;
} scene;

static scene make_scene(scene_numbers numbers, uint64_t seed)
{
    scene s = {.numbers = numbers, .seed = seed};
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

static bool is_same(const octree_body *a, const octree_body *b)
{
    return octree_compare_bodies(a, b) == 0;
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

typedef struct found {
    octree_body bodies[2 * BODIES];
    size_t count;
} found;

static bool collect(const octree_body *body, void *context)
{
    found *f = context;
    assert_true(f->count < 2 * BODIES);
    f->bodies[f->count++] = *body;
    return true;
}

static void assert_region(const scene *s, const octree_region *region)
{
    found expected = {.count = 0}, actual = {.count = 0};
    octree_cost cost = {0};
    for (size_t i = 0; i < s->count; i++)
        if (oracle_matches(region, &s->bodies[i]))
            collect(&s->bodies[i], &expected);
    assert_int_equal(octree_bodies_search(s->set, region, &(octree_search){.cost = &cost}, collect, &actual),
                     OCTREE_OK);
    assert_true(cost.nodes + cost.pruned + cost.taken > 0);
    qsort(expected.bodies, expected.count, sizeof *expected.bodies, octree_compare_bodies);
    qsort(actual.bodies, actual.count, sizeof *actual.bodies, octree_compare_bodies);
    if (expected.count != actual.count)
        fail_msg("numbers %d, kind %d: %zu bodies instead of %zu", (int)s->numbers, (int)region->kind, actual.count,
                 expected.count);
    for (size_t i = 0; i < expected.count; i++)
        assert_true(is_same(&expected.bodies[i], &actual.bodies[i]));
}

static void assert_regions(scene *s)
{
    octree_half_space half_spaces[OCTREE_MAX_HALF_SPACES];
    for (int kind = 0; kind < OCTREE_REGION_KINDS; kind++)
        for (int i = 0; i < QUERIES; i++) {
            const octree_region region = random_region(s->numbers, (octree_region_kind)kind, &s->seed, half_spaces);
            assert_region(s, &region);
        }
}

/* ---- Order -------------------------------------------------------------------------------------------------- */

/* Sort bodies by insertion. `region` is null for distances from `target`. */
static int compare_in_order(const octree_region *ray, const double *target, const octree_body *a, const octree_body *b)
{
    const int order = ray ? oracle_compare_times(ray, a, b) : oracle_compare_distances(target, a, b);
    return order ? order : octree_compare_bodies(a, b);
}

static void insert_in_order(found *f, const octree_body *body, const octree_region *ray, const double *target)
{
    size_t at = f->count++;
    for (; at > 0 && compare_in_order(ray, target, body, &f->bodies[at - 1]) < 0; at--)
        f->bodies[at] = f->bodies[at - 1];
    f->bodies[at] = *body;
}

static void assert_nearest(scene *s)
{
    double target[3];
    octree_hit hits[BODIES];
    size_t count;
    found expected = {.count = 0};
    octree_region ball = {.kind = OCTREE_REGION_BALL};
    octree_half_space unused[OCTREE_MAX_HALF_SPACES];
    random_target(s->numbers, &s->seed, target);
    memcpy(ball.center, target, sizeof target);
    const bool within = random_below(&s->seed, 2);
    ball.radius = random_region(s->numbers, OCTREE_REGION_BALL, &s->seed, unused).radius;
    for (size_t i = 0; i < s->count; i++)
        if (!within || oracle_matches(&ball, &s->bodies[i]))
            insert_in_order(&expected, &s->bodies[i], NULL, target);
    const size_t k = random_below(&s->seed, BODIES + 1);
    assert_int_equal(
        octree_bodies_nearest(s->set, target, k, within ? ball.radius : HUGE_VAL, NULL, NULL, NULL, hits, &count),
        OCTREE_OK);
    assert_int_equal(count, k < expected.count ? k : expected.count);
    for (size_t i = 0; i < count; i++) {
        assert_true(is_same(&hits[i].body, &expected.bodies[i]));
        assert_true(oracle_distance_is(hits[i].at, 4, target, &hits[i].body));
    }
}

static void assert_cast(scene *s, octree_region_kind kind)
{
    octree_hit hits[BODIES];
    size_t count;
    found expected = {.count = 0};
    octree_half_space unused[OCTREE_MAX_HALF_SPACES];
    const octree_region ray = random_region(s->numbers, kind, &s->seed, unused);
    for (size_t i = 0; i < s->count; i++)
        if (oracle_matches(&ray, &s->bodies[i]))
            insert_in_order(&expected, &s->bodies[i], &ray, NULL);
    const size_t k = random_below(&s->seed, 2) ? 1 : random_below(&s->seed, BODIES + 1);
    assert_int_equal(octree_bodies_cast(s->set, &ray, k, NULL, NULL, NULL, hits, &count), OCTREE_OK);
    assert_int_equal(count, k < expected.count ? k : expected.count);
    for (size_t i = 0; i < count; i++) {
        assert_true(is_same(&hits[i].body, &expected.bodies[i]));
        if (!oracle_time_is(hits[i].at, 4, &ray, &hits[i].body))
            fail_msg("numbers %d: the time %a is off", (int)s->numbers, hits[i].at);
    }
}

/* ---- Pairs -------------------------------------------------------------------------------------------------- */

typedef struct counted_pairs {
    size_t count;
    uint64_t order; /* depends on the order of the pairs */
} counted_pairs;

static bool count_pair(const octree_body *a, const octree_body *b, void *context)
{
    counted_pairs *p = context;
    assert_true(oracle_overlap(a, b));
    p->count++;
    p->order = p->order * 31 + a->id * 3 + b->id;
    return true;
}

/* Each pair that is visited overlaps, no pair is visited twice, and there are as many pairs as there should be. */
typedef struct pair_list {
    octree_body pairs[2 * BODIES * BODIES][2];
    size_t count;
} pair_list;

static bool collect_pair(const octree_body *a, const octree_body *b, void *context)
{
    pair_list *list = context;
    assert_true(list->count < 2 * BODIES * BODIES);
    list->pairs[list->count][0] = *a;
    list->pairs[list->count++][1] = *b;
    return true;
}

static int compare_listed_pairs(const void *a, const void *b)
{
    const octree_body *x = a, *y = b;
    const int order = octree_compare_bodies(&x[0], &y[0]);
    return order ? order : octree_compare_bodies(&x[1], &y[1]);
}

static void assert_pairs_within(const scene *s)
{
    static pair_list list;
    size_t expected = 0;
    for (size_t i = 0; i < s->count; i++)
        for (size_t j = i + 1; j < s->count; j++)
            expected += oracle_overlap(&s->bodies[i], &s->bodies[j]);
    list.count = 0;
    assert_int_equal(octree_bodies_pairs(s->set, NULL, collect_pair, &list), OCTREE_OK);
    assert_int_equal(list.count, expected);
    qsort(list.pairs, list.count, sizeof list.pairs[0], compare_listed_pairs);
    for (size_t i = 0; i < list.count; i++) {
        assert_true(oracle_overlap(&list.pairs[i][0], &list.pairs[i][1]));
        assert_true(octree_compare_bodies(&list.pairs[i][0], &list.pairs[i][1]) < 0);
        assert_true(i == 0 || compare_listed_pairs(list.pairs[i - 1], list.pairs[i]) != 0);
    }
}

static void assert_pairs_between(const scene *s, const scene *other)
{
    counted_pairs pairs = {0};
    size_t expected = 0;
    for (size_t i = 0; i < s->count; i++)
        for (size_t j = 0; j < other->count; j++)
            expected += oracle_overlap(&s->bodies[i], &other->bodies[j]);
    assert_int_equal(octree_bodies_pairs(s->set, other->set, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(pairs.count, expected);
}

/* The same bodies, inserted in reverse order and after a detour, give the same pairs in the same order. */
static void assert_order_of_pairs(const scene *s)
{
    counted_pairs pairs = {0}, again = {0};
    octree_bodies *other;
    const octree_def def = octree_bodies_definition(s->set);
    assert_int_equal(octree_bodies_create(&def, &other), OCTREE_OK);
    for (size_t i = s->count; i-- > 0;)
        assert_int_equal(octree_bodies_insert(other, &s->bodies[i]), OCTREE_OK);
    for (size_t i = 0; i < s->count; i += 3)
        assert_int_equal(octree_bodies_remove(other, &s->bodies[i]), OCTREE_OK);
    for (size_t i = 0; i < s->count; i += 3)
        assert_int_equal(octree_bodies_insert(other, &s->bodies[i]), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(s->set, NULL, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(other, NULL, count_pair, &again), OCTREE_OK);
    assert_int_equal(pairs.order, again.order);
    assert_true(octree_bodies_digest(s->set) == octree_bodies_digest(other));
    octree_bodies_destroy(other);
}

/* ---- Tests -------------------------------------------------------------------------------------------------- */

typedef void scene_check(scene *s);

static void check_scenes(scene_check *check)
{
    for (int numbers = 0; numbers < NUMBERS_KINDS; numbers++)
        for (uint64_t seed = 1; seed <= SCENES; seed++) {
            scene s = make_scene((scene_numbers)numbers, seed);
            check(&s);
            octree_bodies_destroy(s.set);
        }
}

static void check_order(scene *s)
{
    for (int i = 0; i < QUERIES / 2; i++) {
        assert_nearest(s);
        assert_cast(s, OCTREE_REGION_RAY);
        assert_cast(s, OCTREE_REGION_SWEPT);
    }
}

static void check_pairs(scene *s)
{
    scene other = make_scene(s->numbers, s->seed | 1);
    assert_pairs_within(s);
    assert_pairs_between(s, &other);
    assert_order_of_pairs(s);
    octree_bodies_destroy(other.set);
}

static void regions_find_the_bodies_that_real_numbers_find(void **state)
{
    (void)state;
    check_scenes(assert_regions);
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
