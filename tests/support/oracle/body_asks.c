/* SPDX-License-Identifier: MIT */
/* body_asks.c - random queries of a set of bodies against rational numbers. */
#include "body_asks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_oracle.h"
#include "fixture.h"

enum { MOST = 400, PAIRS = 40000 };

static bool is_same(const octree_body *a, const octree_body *b)
{
    return octree_compare_bodies(a, b) == 0;
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

typedef struct found {
    octree_body bodies[MOST];
    size_t count;
} found;

static bool collect(const octree_body *body, void *context)
{
    found *f = context;
    assert_true(f->count < MOST);
    f->bodies[f->count++] = *body;
    return true;
}

static void assert_region(const body_scene *s, const octree_region *region)
{
    found expected = {.count = 0}, actual = {.count = 0};
    octree_cost cost = {0};
    for (size_t i = 0; i < s->count; i++)
        if (oracle_matches(region, &s->bodies[i]))
            collect(&s->bodies[i], &expected);
    assert_int_equal(octree_bodies_search(s->set, region, &(octree_search){.cost = &cost}, collect, &actual),
                     OCTREE_OK);
    assert_true(s->count == 0 || cost.nodes + cost.pruned + cost.taken > 0);
    qsort(expected.bodies, expected.count, sizeof *expected.bodies, octree_compare_bodies);
    qsort(actual.bodies, actual.count, sizeof *actual.bodies, octree_compare_bodies);
    if (expected.count != actual.count)
        fail_msg("numbers %d, kind %d: %zu bodies instead of %zu", (int)s->numbers, (int)region->kind, actual.count,
                 expected.count);
    for (size_t i = 0; i < expected.count; i++)
        assert_true(is_same(&expected.bodies[i], &actual.bodies[i]));
}

void body_scene_assert_regions(body_scene *s, int count)
{
    octree_half_space half_spaces[OCTREE_MAX_HALF_SPACES];
    for (int kind = 0; kind < OCTREE_REGION_KINDS; kind++)
        for (int i = 0; i < count; i++) {
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

void body_scene_assert_nearest(body_scene *s)
{
    double target[3];
    octree_hit hits[MOST];
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
    const size_t k = random_below(&s->seed, s->count + 1);
    assert_int_equal(
        octree_bodies_nearest(s->set, target, k, within ? ball.radius : HUGE_VAL, NULL, NULL, NULL, hits, &count),
        OCTREE_OK);
    assert_int_equal(count, k < expected.count ? k : expected.count);
    for (size_t i = 0; i < count; i++) {
        assert_true(is_same(&hits[i].body, &expected.bodies[i]));
        assert_true(oracle_distance_is(hits[i].at, 4, target, &hits[i].body));
    }
}

void body_scene_assert_cast(body_scene *s, octree_region_kind kind)
{
    octree_hit hits[MOST];
    size_t count;
    found expected = {.count = 0};
    octree_half_space unused[OCTREE_MAX_HALF_SPACES];
    const octree_region ray = random_region(s->numbers, kind, &s->seed, unused);
    for (size_t i = 0; i < s->count; i++)
        if (oracle_matches(&ray, &s->bodies[i]))
            insert_in_order(&expected, &s->bodies[i], &ray, NULL);
    const size_t k = random_below(&s->seed, 2) ? 1 : random_below(&s->seed, s->count + 1);
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
    octree_body pairs[PAIRS][2];
    size_t count;
} pair_list;

static bool collect_pair(const octree_body *a, const octree_body *b, void *context)
{
    pair_list *list = context;
    assert_true(list->count < PAIRS);
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

void body_scene_assert_pairs(const body_scene *s)
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

void body_scene_assert_pairs_between(const body_scene *s, const body_scene *other)
{
    counted_pairs pairs = {0};
    size_t expected = 0;
    for (size_t i = 0; i < s->count; i++)
        for (size_t j = 0; j < other->count; j++)
            expected += oracle_overlap(&s->bodies[i], &other->bodies[j]);
    assert_int_equal(octree_bodies_pairs(s->set, other->set, count_pair, &pairs), OCTREE_OK);
    assert_int_equal(pairs.count, expected);
}
