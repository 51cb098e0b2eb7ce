/* SPDX-License-Identifier: MIT */
/* test_bodies_searches.c - the contract of searches among bodies: bad input, options, costs, extreme values. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body_scenes.h"
#include "body_sets.h"

static bool stop_at_once(const octree_body *body, void *context)
{
    (void)body;
    ++*(size_t *)context;
    return false;
}

static void bad_regions_get_a_status(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    octree_half_space planes[OCTREE_MAX_HALF_SPACES + 1] = {{{0, 0, 0}, 1}};
    size_t count = 0;
    const struct {
        octree_region region;
        octree_status status;
    } bad[] = {
        {{.kind = OCTREE_REGION_KINDS}, OCTREE_BAD_OPTION},
        {{.kind = OCTREE_REGION_BOX, .box = {{NAN, 0, 0}, {1, 1, 1}}}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_REGION_BOX, .box = {{2, 0, 0}, {1, 1, 1}}}, OCTREE_BAD_RANGE},
        {{.kind = OCTREE_REGION_BALL, .center = {0, NAN, 0}}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_REGION_BALL, .radius = -1}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_HALF_SPACES}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_HALF_SPACES, .half_space_count = 1}, OCTREE_NULL_ARGUMENT},
        {{.kind = OCTREE_REGION_HALF_SPACES, .half_spaces = planes, .half_space_count = 1}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_HALF_SPACES, .half_spaces = planes, .half_space_count = 33}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_RAY, .length = 1}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_RAY, .direction = {1, 0, 0}, .length = NAN}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_REGION_RAY, .direction = {1, 0, 0}, .length = -1}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_RAY, .direction = {1, 0, HUGE_VAL}, .length = 1}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_REGION_SWEPT, .half = {-1, 0, 0}}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_REGION_SWEPT, .to = {0, 0, NAN}}, OCTREE_NOT_FINITE},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(octree_bodies_search(set, &bad[i].region, NULL, count_body, &count), bad[i].status);
    assert_int_equal(octree_bodies_search(set, NULL, NULL, count_body, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_search(set, &(octree_region){0}, NULL, NULL, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(count, 0);
    octree_bodies_destroy(set);
}

static void bad_searches_in_order_get_a_status(void **state)
{
    (void)state;
    octree_hit hit;
    size_t count = 9;
    const double origin[3] = {0, 0, 0}, bad[3] = {0, NAN, 0};
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_region box = {.kind = OCTREE_REGION_BOX};
    assert_int_equal(octree_bodies_nearest(set, bad, 1, HUGE_VAL, NULL, NULL, NULL, &hit, &count), OCTREE_NOT_FINITE);
    assert_int_equal(count, 0);
    assert_int_equal(octree_bodies_nearest(set, origin, 1, -1, NULL, NULL, NULL, &hit, &count), OCTREE_BAD_SIZE);
    assert_int_equal(octree_bodies_nearest(set, origin, 1, NAN, NULL, NULL, NULL, &hit, &count), OCTREE_NOT_FINITE);
    assert_int_equal(octree_bodies_nearest(set, origin, 1, 1, NULL, NULL, NULL, NULL, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_bodies_nearest(set, origin, 0, 1, NULL, NULL, NULL, NULL, &count), OCTREE_OK);
    assert_int_equal(octree_bodies_cast(set, &box, 1, NULL, NULL, NULL, &hit, &count), OCTREE_BAD_OPTION);
    assert_int_equal(octree_bodies_pairs(set, NULL, NULL, NULL), OCTREE_NULL_ARGUMENT);
    octree_bodies_destroy(set);
}

static bool has_even_id(const octree_body *body, void *context)
{
    (void)context;
    return body->id % 2 == 0;
}

static void searches_skip_ids_and_ask_the_caller(void **state)
{
    (void)state;
    octree_hit hits[8];
    size_t count;
    const double origin[3] = {0, 0, 0};
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_search skip = {.skip = OCTREE_SKIP_ID, .skip_id = 2};
    const octree_region ray = {.kind = OCTREE_REGION_RAY, .direction = {1, 0, 0}, .length = HUGE_VAL};
    for (uint64_t id = 1; id < 8; id++) {
        const octree_body body = body_at((double)id, 0, 0, 0.25, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    assert_int_equal(octree_bodies_nearest(set, origin, 2, HUGE_VAL, &skip, has_even_id, NULL, hits, &count),
                     OCTREE_OK);
    assert_true(count == 2 && hits[0].body.id == 4 && hits[1].body.id == 6 && hits[0].at == 3.75);
    assert_int_equal(octree_bodies_cast(set, &ray, 8, &skip, has_even_id, NULL, hits, &count), OCTREE_OK);
    assert_true(count == 2 && hits[0].body.id == 4 && hits[1].at == 5.75);
    size_t visited = 0;
    assert_int_equal(octree_bodies_search(set, &ray, &skip, count_body, &visited), OCTREE_OK);
    assert_int_equal(visited, 6);
    visited = 0;
    assert_int_equal(octree_bodies_search(set, &ray, NULL, stop_at_once, &visited), OCTREE_OK);
    assert_int_equal(visited, 1);
    octree_bodies_destroy(set);
}

/* The trace of a search: each level's trace begins with its root. */
typedef struct traced {
    struct {
        octree_address node;
        octree_trace_kind kind;
        unsigned root;
    } items[4000];
    size_t count;
    uint64_t kinds[OCTREE_TRACE_KINDS];
    unsigned roots;
} traced;

static void note_trace(octree_address node, octree_trace_kind kind, void *context)
{
    traced *t = context;
    t->roots += node == OCTREE_ROOT;
    assert_true(t->roots > 0 && t->count < sizeof t->items / sizeof t->items[0]);
    t->items[t->count].node = node;
    t->items[t->count].kind = kind;
    t->items[t->count++].root = t->roots - 1;
    t->kinds[kind]++;
}

static size_t count_octants(unsigned mask)
{
    size_t count = 0;
    for (; mask; mask &= mask - 1)
        count++;
    return count;
}

/* The traced nodes are different nodes of their level, and as many as the children of the visited nodes. */
static void assert_trace_is_complete(const traced *t, const octree *const levels[OCTREE_BODY_LEVELS])
{
    size_t expected = t->roots;
    for (size_t i = 0; i < t->count; i++) {
        octree_node node;
        assert_int_equal(octree_node_at(levels[t->items[i].root], t->items[i].node, &node), OCTREE_OK);
        expected += t->items[i].kind == OCTREE_TRACE_VISITED ? count_octants(node.octants) : 0;
        for (size_t j = 0; j < i; j++)
            assert_false(t->items[j].node == t->items[i].node && t->items[j].root == t->items[i].root);
    }
    assert_int_equal(t->count, expected);
}

/* Search a set in the way that a number stands for. Large regions take nodes whole. */
static void search_in_some_way(const octree_bodies *set, uint64_t *seed, int way, const octree_search *how)
{
    octree_half_space planes[OCTREE_MAX_HALF_SPACES];
    octree_region region = random_region(NUMBERS_SMOOTH, (octree_region_kind)(way % 5), seed, planes);
    octree_hit hits[3];
    size_t count = 0;
    for (int i = 0; way % 4 == 1 && i < 3; i++) {
        region.box.min[i] -= 4;
        region.box.max[i] += 4;
    }
    if (way % 3 == 0)
        assert_int_equal(octree_bodies_nearest(set, region.center, 3, HUGE_VAL, how, NULL, NULL, hits, &count),
                         OCTREE_OK);
    else if (way % 2 == 0 || region.kind < OCTREE_REGION_SWEPT)
        assert_int_equal(octree_bodies_search(set, &region, how, count_body, &count), OCTREE_OK);
    else
        assert_int_equal(octree_bodies_cast(set, &region, 1, how, NULL, NULL, hits, &count), OCTREE_OK);
}

static void traces_are_complete_and_agree_with_costs(void **state)
{
    (void)state;
    static traced t;
    uint64_t seed = 5, taken = 0;
    octree_bodies *set = make_body_set(scene_world(NUMBERS_SMOOTH), 2);
    const octree *levels[OCTREE_BODY_LEVELS];
    unsigned used = 0;
    for (uint64_t id = 0; id < 300; id++) {
        const octree_body body = random_body(NUMBERS_SMOOTH, &seed, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        if (octree_count(octree_bodies_level(set, i, NULL)) > 0)
            levels[used++] = octree_bodies_level(set, i, NULL);
    for (int i = 0; i < 100; i++) {
        octree_cost cost = {0};
        t = (traced){.count = 0};
        search_in_some_way(set, &seed, i, &(octree_search){.cost = &cost, .trace = note_trace, .trace_context = &t});
        assert_int_equal(t.roots, used);
        assert_trace_is_complete(&t, levels);
        assert_true(t.kinds[OCTREE_TRACE_VISITED] == cost.nodes && t.kinds[OCTREE_TRACE_PRUNED] == cost.pruned &&
                    t.kinds[OCTREE_TRACE_TAKEN] == cost.taken);
        taken += cost.taken;
    }
    assert_true(taken > 100);
    octree_bodies_destroy(set);
}

static void epsilon_bounds_the_distance_of_neighbours(void **state)
{
    (void)state;
    uint64_t seed = 3;
    octree_bodies *set = make_body_set(scene_world(NUMBERS_SMOOTH), 2);
    for (uint64_t id = 0; id < 500; id++) {
        octree_body body = random_body(NUMBERS_SMOOTH, &seed, id);
        memset(body.half, 0, sizeof body.half);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    octree_cost cost = {0}, exact_cost = {0};
    for (int i = 0; i < 100; i++) {
        double target[3];
        octree_hit exact[4], found[4];
        size_t count, found_count;
        random_target(NUMBERS_SMOOTH, &seed, target);
        octree_bodies_nearest(set, target, 4, HUGE_VAL, &(octree_search){.cost = &exact_cost}, NULL, NULL, exact,
                              &count);
        octree_bodies_nearest(set, target, 4, HUGE_VAL, &(octree_search){.epsilon = 1, .cost = &cost}, NULL, NULL,
                              found, &found_count);
        assert_int_equal(count, found_count);
        for (size_t k = 0; k < count; k++)
            assert_true(found[k].at <= 2 * exact[k].at * (1 + 0x1p-48));
    }
    assert_true(cost.points < exact_cost.points); /* it saves work */
    octree_bodies_destroy(set);
}

/* Squares of large distances overflow. */
static void balls_and_distances_beyond_the_squares_of_doubles_are_right(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(0, 1), 1);
    const octree_region ball = {
        .kind = OCTREE_REGION_BALL,
        .center = {-0x1.30c7ea60e2fe4p+511, -0x1.11a5b8b08c836p+511, -0x1.333250f369455p+511},
        .radius = 0x1p512,
    };
    size_t count = 0;
    for (uint64_t id = 0; id < 8; id++) {
        const octree_body body = {{id & 1 ? 0.75 : 0.25, id & 2 ? 0.75 : 0.25, id & 4 ? 0.75 : 0.25}, {0}, id};
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    assert_int_equal(octree_bodies_search(set, &ball, NULL, count_body, &count), OCTREE_OK);
    assert_int_equal(count, 0); /* GMP: the nearest corner of the world is farther than the radius */
    octree_bodies_destroy(set);

    const octree_body large = {{0x1.22b544f35a538p+512, 0x1.f71e099e9b892p+511, 0x1.4d17ce41f888bp+510},
                               {0x1.3e54ec8b01b85p+510, 0x1.afc8e2805f0a9p+510, 0x1.03984722ae08bp+510},
                               1};
    const octree_region other = {.kind = OCTREE_REGION_BALL, .radius = 0x1p512 * (1 - 0x1p-53)};
    set = make_body_set(cube(-0x1p600, 0x1p600), 1);
    assert_int_equal(octree_bodies_insert(set, &large), OCTREE_OK);
    assert_int_equal(octree_bodies_search(set, &other, NULL, count_body, &count), OCTREE_OK);
    assert_int_equal(count, 1);
    octree_bodies_destroy(set);
}

static void a_time_beyond_the_doubles_is_infinite(void **state)
{
    (void)state;
    octree_hit hit;
    size_t count;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_body body = {{6 * 0x1p-50, 0, 0}, {0}, 1};
    const octree_region ray = {.kind = OCTREE_REGION_RAY, .direction = {5 * 0x1p-1074, 0, 0}, .length = HUGE_VAL};
    assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    assert_int_equal(octree_bodies_cast(set, &ray, 1, NULL, NULL, NULL, &hit, &count), OCTREE_OK);
    assert_true(count == 1 && hit.at > DBL_MAX);
    octree_bodies_destroy(set);
}

static void a_radius_limits_the_search_for_neighbours(void **state)
{
    (void)state;
    uint64_t seed = 9;
    octree_hit hits[10];
    size_t count;
    octree_cost cost = {0};
    const double target[3] = {0, 0, 0};
    octree_bodies *set = make_body_set(cube(-8, 8), 8);
    for (uint64_t id = 0; id < 4000; id++) {
        octree_body body = {.id = id};
        for (int axis = 0; axis < 3; axis++)
            body.position[axis] = random_between(&seed, -8, 8);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    assert_int_equal(
        octree_bodies_nearest(set, target, 10, 0.5, &(octree_search){.cost = &cost}, NULL, NULL, hits, &count),
        OCTREE_OK);
    assert_true(count < 10 && cost.points < 200);
    octree_bodies_destroy(set);
}

/* The parameter of the hit is infinite as a double, but the ray hits the body. */
static void a_ray_finds_a_body_whose_parameter_overflows(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-DBL_MAX, DBL_MAX), 2);
    const octree_body body = body_at(0, 0, 0x1p1022, 1, 1);
    const octree_region ray = {.kind = OCTREE_REGION_RAY, .direction = {0, 0x1p-1074, 0.1}, .length = HUGE_VAL};
    octree_hit hit;
    size_t found = 0, count = 0;
    assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    assert_int_equal(octree_bodies_search(set, &ray, NULL, count_body, &found), OCTREE_OK);
    assert_int_equal(octree_bodies_cast(set, &ray, 1, NULL, NULL, NULL, &hit, &count), OCTREE_OK);
    assert_int_equal(found, 1);
    assert_int_equal(count, 1);
    assert_true(isinf(hit.at));
    octree_bodies_destroy(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_regions_get_a_status),
        cmocka_unit_test(bad_searches_in_order_get_a_status),
        cmocka_unit_test(searches_skip_ids_and_ask_the_caller),
        cmocka_unit_test(traces_are_complete_and_agree_with_costs),
        cmocka_unit_test(epsilon_bounds_the_distance_of_neighbours),
        cmocka_unit_test(balls_and_distances_beyond_the_squares_of_doubles_are_right),
        cmocka_unit_test(a_time_beyond_the_doubles_is_infinite),
        cmocka_unit_test(a_radius_limits_the_search_for_neighbours),
        cmocka_unit_test(a_ray_finds_a_body_whose_parameter_overflows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
