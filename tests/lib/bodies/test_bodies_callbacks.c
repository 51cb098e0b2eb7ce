/* SPDX-License-Identifier: MIT */
/* test_bodies_callbacks.c - callbacks and executors that try to change a set of bodies. */
#include "fixture.h"

#include <math.h>

#include "body_sets.h"

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
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
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

/* The trees of the levels are the set's. */
static bool change_inside_level(const octree_point *point, void *context)
{
    octree_bodies *set = context;
    octree_body body;
    octree_bodies_at(set, point, &body);
    const octree_body other = body_at(1, 1, 1, body.half[0], 99);
    assert_int_equal(octree_bodies_insert(set, &other), OCTREE_BUSY);
    assert_int_equal(octree_bodies_remove(set, &body), OCTREE_BUSY);
    assert_int_equal(octree_bodies_move(set, &body, &other), OCTREE_BUSY);
    const octree_body larger = body_at(1, 1, 1, 4, 99); /* in another level */
    assert_int_equal(octree_bodies_move(set, &body, &larger), OCTREE_BUSY);
    assert_int_equal(octree_bodies_remove_many(set, &body, 1, NULL, NULL), OCTREE_BUSY);
    assert_int_equal(octree_bodies_clear(set), OCTREE_BUSY);
    assert_int_equal(octree_bodies_compact(set), OCTREE_BUSY);
    assert_int_equal(octree_bodies_replace_all(set, &other, 1, NULL, NULL), OCTREE_BUSY);
    octree_bodies_destroy(set);
    return true;
}

static void visitors_of_a_level_cannot_change_the_set(void **state)
{
    (void)state;
    octree_bodies *set = make_body_set(cube(-8, 8), 2);
    const octree_body body = body_at(0, 0, 0, 0, 1);
    const octree_box all = cube(-8, 8);
    assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    const octree *level = octree_bodies_level(set, OCTREE_BODY_LEVELS - 1, NULL);
    assert_int_equal(octree_count(level), 1);
    assert_int_equal(octree_range(level, &all, change_inside_level, set), OCTREE_OK);
    assert_true(octree_bodies_contain(set, &body));
    assert_int_equal(octree_bodies_count(set), 1);
    assert_null(octree_bodies_check(set));
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(callbacks_cannot_change_the_set),
        cmocka_unit_test(visitors_of_a_level_cannot_change_the_set),
        cmocka_unit_test(executors_cannot_change_the_set),
        cmocka_unit_test(a_set_of_points_lives_inside_a_visit_of_its_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
