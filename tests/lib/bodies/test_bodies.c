/* SPDX-License-Identifier: MIT */
/* test_bodies.c - the contract of a set of bodies: statuses, bad input, callbacks, levels, points as bodies. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body_scenes.h"
#include "counting_allocator.h"
#include "octree/sample.h"

static octree_bodies *make_set(octree_box world, size_t capacity)
{
    octree_bodies *set;
    const octree_def def = define(world, capacity, 21, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    return set;
}

static octree_body body_at(double x, double y, double z, double half, uint64_t id)
{
    return (octree_body){{x, y, z}, {half, half, half}, id};
}

static bool count_bodies(const octree_body *body, void *context)
{
    (void)body;
    ++*(size_t *)context;
    return true;
}

static bool stop_at_once(const octree_body *body, void *context)
{
    (void)body;
    ++*(size_t *)context;
    return false;
}

static bool count_pairs(const octree_body *a, const octree_body *b, void *context)
{
    (void)a;
    (void)b;
    ++*(size_t *)context;
    return true;
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

static void a_body_is_inserted_moved_resized_and_removed(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
    octree_bodies *set = make_set(cube(-8, 8), 1);
    octree_body same = body_at(1, 1, 1, 1, 1), other[3] = {same, same, same};
    other[0].id = 2;
    other[1].half[2] = 0.5;
    other[2].position[0] = 1.5;
    assert_int_equal(octree_bodies_insert(set, &same), OCTREE_OK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(octree_bodies_insert(set, &other[i]), OCTREE_OK);
    assert_int_equal(octree_bodies_move(set, &other[0], &same), OCTREE_DUPLICATE);
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
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
    octree_bodies *set = make_set(cube(-8, 8), 5);
    const octree_def def = octree_bodies_definition(set);
    assert_int_equal(def.leaf_capacity, 5);
    assert_true(def.world.max[2] == 8);
    octree_bodies_destroy(set);
}

/* ---- Levels ------------------------------------------------------------------------------------------------- */

static void bodies_of_similar_size_share_a_level(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-8, 8), 2);
    const double halves[] = {1e300, 8, 4, 1.5, 1e-9, 0}; /* a level spans a factor of 4: the first from 4 on */
    for (size_t i = 0; i < 6; i++) {
        const octree_body body = body_at(0, 0, 0, halves[i], i);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    size_t counts[OCTREE_BODY_LEVELS] = {0};
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++) {
        double reach[3];
        counts[i] = octree_count(octree_bodies_level(set, i, reach));
        assert_true(counts[i] == 0 ? reach[0] == 0 : reach[0] > 0);
    }
    assert_int_equal(counts[0], 3);
    assert_int_equal(counts[1], 1);
    assert_int_equal(counts[OCTREE_BODY_LEVELS - 1], 2);
    assert_null(octree_bodies_level(set, OCTREE_BODY_LEVELS, NULL));
    octree_bodies_destroy(set);
}

/* The reach on each axis is above the largest half extent by a factor of at most 1.25, and follows removals. */
static void the_reach_follows_the_half_extents_on_each_axis(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-8, 8), 2);
    const octree_body plate = {{0, 0, 0}, {1, 1, 0.09}, 1}, cube_body = body_at(0, 0, 0, 1.2, 2);
    double reach[3];
    unsigned level = 0;
    assert_int_equal(octree_bodies_insert(set, &plate), OCTREE_OK);
    while (octree_count(octree_bodies_level(set, level, reach)) == 0)
        level++;
    assert_true(reach[0] >= 1 && reach[0] <= 1.25 && reach[2] >= 0.09 && reach[2] <= 0.1125 * 1.25);
    assert_int_equal(octree_bodies_insert(set, &cube_body), OCTREE_OK);
    octree_bodies_level(set, level, reach);
    assert_true(reach[2] >= 1.2 && reach[2] <= 1.5);
    assert_int_equal(octree_bodies_remove(set, &cube_body), OCTREE_OK);
    octree_bodies_level(set, level, reach);
    assert_true(reach[0] <= 1.25 && reach[2] <= 0.1125 * 1.25);
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
    octree_bodies *set = make_set(scene_world(NUMBERS_SMOOTH), 2);
    for (uint64_t id = 0; id < 100; id++) {
        const octree_body body = random_body(NUMBERS_SMOOTH, &seed, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        if (octree_bodies_level(set, i, NULL))
            octree_walk(octree_bodies_level(set, i, NULL), compare_points_with_bodies, set);
    octree_bodies_destroy(set);
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

static void bad_regions_get_a_status(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
        assert_int_equal(octree_bodies_search(set, &bad[i].region, NULL, count_bodies, &count), bad[i].status);
    assert_int_equal(octree_bodies_search(set, NULL, NULL, count_bodies, &count), OCTREE_NULL_ARGUMENT);
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
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
    assert_int_equal(octree_bodies_search(set, &ray, &skip, count_bodies, &visited), OCTREE_OK);
    assert_int_equal(visited, 6);
    visited = 0;
    assert_int_equal(octree_bodies_search(set, &ray, NULL, stop_at_once, &visited), OCTREE_OK);
    assert_int_equal(visited, 1);
    octree_bodies_destroy(set);
}

/* The trace of a search: its counts equal the cost, and each level's trace begins with its root. */
typedef struct traced {
    uint64_t kinds[OCTREE_TRACE_KINDS];
    unsigned roots;
} traced;

static void count_trace(octree_address node, octree_trace_kind kind, void *context)
{
    traced *t = context;
    assert_true(t->roots > 0 || node == OCTREE_ROOT);
    t->kinds[kind]++;
    t->roots += node == OCTREE_ROOT;
}

static void traces_agree_with_costs(void **state)
{
    (void)state;
    uint64_t seed = 5;
    octree_half_space planes[OCTREE_MAX_HALF_SPACES];
    octree_bodies *set = make_set(scene_world(NUMBERS_SMOOTH), 2);
    unsigned levels = 0;
    for (uint64_t id = 0; id < 300; id++) {
        const octree_body body = random_body(NUMBERS_SMOOTH, &seed, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        levels += octree_count(octree_bodies_level(set, i, NULL)) > 0;
    for (int i = 0; i < 50; i++) {
        traced t = {0};
        octree_cost cost = {0};
        octree_hit hit;
        size_t count = 0;
        const octree_search how = {.cost = &cost, .trace = count_trace, .trace_context = &t};
        const octree_region region = random_region(NUMBERS_SMOOTH, (octree_region_kind)(i % 5), &seed, planes);
        if (i % 2 == 0 || region.kind < OCTREE_REGION_SWEPT)
            assert_int_equal(octree_bodies_search(set, &region, &how, count_bodies, &count), OCTREE_OK);
        else
            assert_int_equal(octree_bodies_cast(set, &region, 1, &how, NULL, NULL, &hit, &count), OCTREE_OK);
        assert_int_equal(t.roots, levels);
        assert_true(t.kinds[OCTREE_TRACE_VISITED] == cost.nodes && t.kinds[OCTREE_TRACE_PRUNED] == cost.pruned &&
                    t.kinds[OCTREE_TRACE_TAKEN] == cost.taken);
    }
    octree_bodies_destroy(set);
}

static void epsilon_bounds_the_distance_of_neighbours(void **state)
{
    (void)state;
    uint64_t seed = 3;
    octree_bodies *set = make_set(scene_world(NUMBERS_SMOOTH), 2);
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

/* ---- Callbacks, points as bodies ---------------------------------------------------------------------------- */

static bool change_inside(const octree_body *body, void *context)
{
    octree_bodies *set = context;
    const octree_body other = body_at(1, 1, 1, 1, 99);
    assert_int_equal(octree_bodies_insert(set, &other), OCTREE_BUSY);
    assert_int_equal(octree_bodies_remove(set, body), OCTREE_BUSY);
    assert_int_equal(octree_bodies_move(set, body, &other), OCTREE_BUSY);
    assert_int_equal(octree_bodies_clear(set), OCTREE_BUSY);
    assert_int_equal(octree_bodies_compact(set), OCTREE_BUSY);
    assert_int_equal(octree_bodies_replace_all(set, NULL, 0, NULL, NULL), OCTREE_BUSY);
    octree_bodies_destroy(set);
    return true;
}

static bool change_inside_pairs(const octree_body *a, const octree_body *b, void *context)
{
    (void)b;
    return change_inside(a, context);
}

static void callbacks_cannot_change_the_set(void **state)
{
    (void)state;
    octree_hit hit;
    size_t count;
    const double origin[3] = {0, 0, 0};
    octree_bodies *set = make_set(cube(-8, 8), 2);
    const octree_region all = {.kind = OCTREE_REGION_BOX, .box = cube(-8, 8)};
    for (uint64_t id = 0; id < 3; id++) {
        const octree_body body = body_at(0, 0, 0, (double)id, id);
        assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    }
    const uint64_t digest = octree_bodies_digest(set);
    assert_int_equal(octree_bodies_search(set, &all, NULL, change_inside, set), OCTREE_OK);
    assert_int_equal(octree_bodies_nearest(set, origin, 1, HUGE_VAL, NULL, change_inside, set, &hit, &count),
                     OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(set, NULL, change_inside_pairs, set), OCTREE_OK);
    assert_true(octree_bodies_digest(set) == digest);
    octree_bodies_destroy(set);
}

/* An executor that tries to change the set whose bulk change it runs. */
static octree_bodies *set_in_change;
static size_t runs;

static void change_in_executor(octree_task *task, size_t count, void *task_context, void *context)
{
    (void)context;
    const octree_body body = body_at(1, 1, 1, 4, 1000000);
    for (size_t i = 0; i < count; i++)
        task(i, task_context);
    if (!set_in_change)
        return;
    runs++;
    assert_int_equal(octree_bodies_insert(set_in_change, &body), OCTREE_BUSY);
    assert_int_equal(octree_bodies_clear(set_in_change), OCTREE_BUSY);
    octree_bodies_destroy(set_in_change);
}

static void executors_cannot_change_the_set(void **state)
{
    (void)state;
    enum { MANY = 40000 };
    static octree_body bodies[MANY];
    uint64_t seed = 1;
    octree_bodies *set;
    octree_def def = define(cube(-8, 8), 8, 21, OCTREE_GROW);
    def.executor = (octree_executor){change_in_executor, NULL};
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    for (size_t i = 0; i < MANY; i++) {
        bodies[i] = body_at(0, 0, 0, i % 2 ? 0.01 : 0, i);
        for (int axis = 0; axis < 3; axis++)
            bodies[i].position[axis] = random_between(&seed, -8, 8);
    }
    set_in_change = set;
    assert_int_equal(octree_bodies_insert_many(set, bodies, MANY, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_bodies_remove_many(set, bodies, MANY / 2, NULL, NULL), OCTREE_OK);
    set_in_change = NULL;
    assert_true(runs > 0);
    assert_int_equal(octree_bodies_count(set), MANY / 2);
    assert_null(octree_bodies_check(set));
    octree_bodies_destroy(set);
}

/* A set that shows points is made and destroyed inside a callback of their tree, which it does not change. */
static bool make_set_of_points(const octree_point *point, void *context)
{
    const double half[3] = {1, 1, 1};
    octree_bodies *set;
    (void)point;
    assert_int_equal(octree_bodies_of_points(context, half, &set), OCTREE_OK);
    octree_bodies_destroy(set); /* frees it: the leak detector would report it */
    return true;
}

static void a_set_of_points_lives_inside_a_visit_of_its_tree(void **state)
{
    (void)state;
    const double position[1][3] = {{1, 2, 3}};
    const octree_box all = cube(-8, 8);
    octree *tree = make_tree(all, 2, 21, OCTREE_GROW);
    insert_all(tree, position, 1);
    assert_int_equal(octree_range(tree, &all, make_set_of_points, tree), OCTREE_OK);
    octree_destroy(tree);
}

/* Squares of large distances overflow. */
static void balls_and_distances_beyond_the_squares_of_doubles_are_right(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(0, 1), 1);
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
    assert_int_equal(octree_bodies_search(set, &ball, NULL, count_bodies, &count), OCTREE_OK);
    assert_int_equal(count, 0); /* GMP: the nearest corner of the world is farther than the radius */
    octree_bodies_destroy(set);

    const octree_body large = {{0x1.22b544f35a538p+512, 0x1.f71e099e9b892p+511, 0x1.4d17ce41f888bp+510},
                               {0x1.3e54ec8b01b85p+510, 0x1.afc8e2805f0a9p+510, 0x1.03984722ae08bp+510},
                               1};
    const octree_region other = {.kind = OCTREE_REGION_BALL, .radius = 0x1p512 * (1 - 0x1p-53)};
    set = make_set(cube(-0x1p600, 0x1p600), 1);
    assert_int_equal(octree_bodies_insert(set, &large), OCTREE_OK);
    assert_int_equal(octree_bodies_search(set, &other, NULL, count_bodies, &count), OCTREE_OK);
    assert_int_equal(count, 1);
    octree_bodies_destroy(set);
}

static void a_time_beyond_the_doubles_is_infinite(void **state)
{
    (void)state;
    octree_hit hit;
    size_t count;
    octree_bodies *set = make_set(cube(-8, 8), 2);
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
    octree_bodies *set = make_set(cube(-8, 8), 8);
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
    assert_int_equal(octree_bodies_pairs(set, NULL, count_pairs, &pairs), OCTREE_OK);
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
    octree_bodies *left = make_set(cube(-8, -1), 4), *right = make_set(cube(1, 8), 4);
    size_t pairs = 0;
    const octree_body a = body_at(-2, -2, -2, 3, 1), b = body_at(2, 2, 2, 1, 2), c = body_at(5, 5, 5, 1, 3);
    assert_int_equal(octree_bodies_insert(left, &a), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(right, &b), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(right, &c), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(left, right, count_pairs, &pairs), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(right, left, count_pairs, &pairs), OCTREE_OK);
    assert_int_equal(pairs, 2);
    octree_bodies_destroy(left);
    octree_bodies_destroy(right);
}

/* A world of subnormal numbers, whose extent has no inverse. */
static void bodies_of_a_subnormal_world_meet(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-1e-310, 1e-310), 4);
    size_t pairs = 0;
    const octree_body middle = body_at(0, 0, 0, 0, 1), around = body_at(1e-311, 0, 0, 1e-311, 2),
                      beside = body_at(-1e-311, 0, 0, 0, 3);
    assert_int_equal(octree_bodies_insert(set, &middle), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &around), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &beside), OCTREE_OK);
    assert_int_equal(octree_bodies_pairs(set, NULL, count_pairs, &pairs), OCTREE_OK);
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

static bool count_body(const octree_body *body, void *count)
{
    (void)body;
    ++*(size_t *)count;
    return true;
}

/* The parameter of the hit is infinite as a double, but the ray hits the body. */
static void a_ray_finds_a_body_whose_parameter_overflows(void **state)
{
    (void)state;
    octree_bodies *set = make_set(cube(-DBL_MAX, DBL_MAX), 2);
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
        cmocka_unit_test(a_ray_finds_a_body_whose_parameter_overflows),
        cmocka_unit_test(a_body_is_inserted_moved_resized_and_removed),
        cmocka_unit_test(bodies_that_differ_in_one_member_are_different),
        cmocka_unit_test(bad_bodies_get_a_status_and_change_nothing),
        cmocka_unit_test(bad_definitions_are_refused),
        cmocka_unit_test(a_definition_is_returned_as_it_was_given),
        cmocka_unit_test(bodies_of_similar_size_share_a_level),
        cmocka_unit_test(the_reach_follows_the_half_extents_on_each_axis),
        cmocka_unit_test(the_nodes_of_a_level_lead_to_the_bodies),
        cmocka_unit_test(bad_regions_get_a_status),
        cmocka_unit_test(bad_searches_in_order_get_a_status),
        cmocka_unit_test(searches_skip_ids_and_ask_the_caller),
        cmocka_unit_test(traces_agree_with_costs),
        cmocka_unit_test(epsilon_bounds_the_distance_of_neighbours),
        cmocka_unit_test(callbacks_cannot_change_the_set),
        cmocka_unit_test(executors_cannot_change_the_set),
        cmocka_unit_test(a_set_of_points_lives_inside_a_visit_of_its_tree),
        cmocka_unit_test(balls_and_distances_beyond_the_squares_of_doubles_are_right),
        cmocka_unit_test(a_time_beyond_the_doubles_is_infinite),
        cmocka_unit_test(a_radius_limits_the_search_for_neighbours),
        cmocka_unit_test(points_of_a_tree_are_bodies_of_one_size),
        cmocka_unit_test(bodies_of_separate_worlds_meet),
        cmocka_unit_test(bodies_of_a_subnormal_world_meet),
        cmocka_unit_test(set_that_shows_points_follows_the_tree),
        cmocka_unit_test(null_is_an_empty_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
