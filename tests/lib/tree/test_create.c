/* SPDX-License-Identifier: MIT */
/* test_create.c - definitions of trees, and null for every required pointer of a public function. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "counting_allocator.h"
#include "octree/game.h"
#include "octree/sample.h"

static void default_definition_is_the_documented_one(void **state)
{
    (void)state;
    octree_def def = octree_def_default();
    for (int axis = 0; axis < 3; axis++) {
        assert_true(def.world.min[axis] == -1000);
        assert_true(def.world.max[axis] == 1000);
    }
    assert_int_equal(def.leaf_capacity, 64);
    assert_int_equal(def.max_depth, 21);
    assert_int_equal(def.full_leaf, OCTREE_GROW);
    assert_null(def.allocator.allocate);
    assert_null(def.allocator.release);
    assert_int_equal(octree_session_default().tree.full_leaf, OCTREE_REFUSE); /* the paper's rule */
}

static void default_tree_keeps_all_coincident_points(void **state)
{
    (void)state;
    octree *tree;
    const octree_def def = octree_def_default();
    const double at[3] = {1, 2, 3};
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (uint64_t id = 0; id < 200; id++)
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    assert_int_equal(octree_count(tree), 200);
    octree_destroy(tree);
}

/* The status of creating with one axis of the world set to [low, high]. */
static octree_status status_of_axis(int axis, double low, double high)
{
    octree_def def = octree_def_default();
    def.world.min[axis] = low;
    def.world.max[axis] = high;
    octree *tree = (octree *)&def; /* anything but null, to see that it is set */
    octree_status status = octree_create(&def, &tree);
    assert_true((tree == NULL) == (status != OCTREE_OK));
    octree_destroy(tree);
    return status;
}

static void create_refuses_worlds_that_are_empty_or_not_finite(void **state)
{
    (void)state;
    static const double bad[][2] = {
        {1, 1},
        {1, 0},
        {0, 0},
        {-0.0, 0.0},
        {0.0, -0.0},
        {NAN, 1},
        {0, NAN},
        {NAN, NAN},
        {-INFINITY, 0},
        {0, INFINITY},
        {INFINITY, 0},
        {0, -INFINITY},
        {DBL_MAX, -DBL_MAX},
        {INFINITY, INFINITY},
        {-INFINITY, INFINITY},
    };
    for (int axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
            assert_int_equal(status_of_axis(axis, bad[i][0], bad[i][1]), OCTREE_BAD_WORLD);
}

static void create_accepts_any_finite_world(void **state)
{
    (void)state;
    static const double good[][2] = {
        {-DBL_MAX, DBL_MAX},    {0, 5e-324},        {-5e-324, 5e-324},
        {5e-324, 1e-310},       {1e15, 1e15 + 1},   {-1e200, 1e200},
        {1, 1.0 + DBL_EPSILON}, {-DBL_MAX, -1e308}, {-0.0, 1},
        {DBL_MAX / 2, DBL_MAX},
    };
    for (int axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
            assert_int_equal(status_of_axis(axis, good[i][0], good[i][1]), OCTREE_OK);
}

static octree_def definition_in_force(size_t capacity, size_t depth)
{
    octree *tree = make_tree(cube(-1, 1), capacity, depth, OCTREE_GROW);
    octree_def def = octree_definition(tree);
    octree_destroy(tree);
    return def;
}

static void create_clamps_and_reports_capacity_and_depth(void **state)
{
    (void)state;
    static const struct {
        size_t asked, effective;
    } depths[] = {{0, 0}, {1, 1}, {21, 21}, {22, 21}, {64, 21}, {SIZE_MAX, 21}};
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++)
        assert_int_equal(definition_in_force(2, depths[i].asked).max_depth, depths[i].effective);
    assert_int_equal(definition_in_force(1, 5).leaf_capacity, 1);
    assert_int_equal(definition_in_force(UINT32_MAX, 5).leaf_capacity, UINT32_MAX);
    assert_int_equal(definition_in_force((size_t)UINT32_MAX + 1, 5).leaf_capacity, UINT32_MAX);
    assert_int_equal(definition_in_force(SIZE_MAX, 5).leaf_capacity, UINT32_MAX);
    assert_int_equal(definition_in_force(2, 5).full_leaf, OCTREE_GROW);
}

static void a_capacity_that_is_clamped_still_works(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 1), SIZE_MAX, SIZE_MAX, OCTREE_REFUSE);
    for (uint64_t id = 0; id < 1000; id++)
        assert_int_equal(octree_insert(tree, (double[3]){0.5, 0.25, (double)id / 1000}, id), OCTREE_OK);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.nodes, 1);
    assert_int_equal(stats.largest_leaf, 1000);
    assert_valid(tree);
    octree_destroy(tree);
}

static void create_refuses_capacity_zero_and_unlisted_options(void **state)
{
    (void)state;
    octree_def def = define(cube(0, 1), 0, 5, OCTREE_REFUSE);
    octree *tree = (octree *)&def;
    assert_int_equal(octree_create(&def, &tree), OCTREE_BAD_CAPACITY);
    assert_null(tree);
    def = define(cube(0, 1), 1, 5, (octree_full_leaf)2);
    tree = (octree *)&def;
    assert_int_equal(octree_create(&def, &tree), OCTREE_BAD_OPTION);
    assert_null(tree);
    def = define(cube(0, 1), 1, 5, OCTREE_REFUSE);
    def.allocator.release = counting_allocator_use(&(counting_allocator){0}).release;
    assert_int_equal(octree_create(&def, &tree), OCTREE_BAD_OPTION);
    assert_non_null(strstr(octree_status_text(OCTREE_BAD_OPTION), "unknown value"));
    assert_non_null(strstr(octree_status_text(OCTREE_BAD_OPTION), "allocator"));
}

static void an_empty_tree_is_one_leaf(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_REFUSE);
    octree_node root;
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &root), OCTREE_OK);
    assert_true(root.leaf);
    assert_int_equal(root.count, 0);
    assert_int_equal(octree_count(tree), 0);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(stats.nodes, 1);
    assert_int_equal(stats.leaves, 1);
    assert_int_equal(stats.depth, 0);
    assert_valid(tree);
    octree_destroy(tree);
}

static void clear_makes_a_tree_like_a_new_one(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 21, OCTREE_GROW);
    uint64_t digest = octree_digest(tree);
    uint64_t random = 1;
    for (uint64_t id = 0; id < 500; id++) {
        double at[3] = {random_between(&random, -1, 1), random_between(&random, -1, 1), 0};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    }
    uint64_t version = octree_version(tree);
    assert_int_equal(octree_clear(tree), OCTREE_OK);
    assert_int_equal(octree_count(tree), 0);
    assert_true(octree_digest(tree) == digest);
    assert_true(octree_version(tree) != version);
    assert_valid(tree);
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OK);
    octree_destroy(tree);
}

static bool visit_point(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

static octree_walk_order visit_node(const octree_node *node, void *context)
{
    (void)node;
    (void)context;
    return OCTREE_WALK_ON;
}

static void functions_that_change_a_tree_refuse_null(void **state)
{
    (void)state;
    const double at[3] = {0};
    octree_def def = octree_def_default();
    octree *tree = NULL;
    assert_int_equal(octree_create(NULL, &tree), OCTREE_NULL_ARGUMENT);
    assert_null(tree);
    assert_int_equal(octree_create(&def, NULL), OCTREE_NULL_ARGUMENT);
    tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    uint64_t version = octree_version(tree);
    assert_int_equal(octree_clear(NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_insert(NULL, at, 0), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_insert(tree, NULL, 0), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_remove(NULL, at, 0), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_remove(tree, NULL, 0), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move(NULL, at, 0, at), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move(tree, NULL, 0, at), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move(tree, at, 0, NULL), OCTREE_NULL_ARGUMENT);
    assert_true(octree_version(tree) == version);
    octree_destroy(tree);
    octree_destroy(NULL);
}

static void functions_that_query_a_tree_refuse_null(void **state)
{
    (void)state;
    const double at[3] = {0};
    octree_box box = cube(-1, 1);
    size_t count;
    octree_neighbor nearest;
    octree *tree = make_tree(box, 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_find(NULL, at, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_find(tree, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_false(octree_contains(NULL, at, 0));
    assert_false(octree_contains(tree, NULL, 0));
    assert_int_equal(octree_range(NULL, &box, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range(tree, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range(tree, &box, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range_count(NULL, &box, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range_count(tree, NULL, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range_count(tree, &box, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide(NULL, at, 1, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide(tree, NULL, 1, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collide(tree, at, 1, NULL, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collision_box(NULL, 1, &box), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_collision_box(at, 1, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest(NULL, at, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest(tree, NULL, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest(tree, at, OCTREE_SKIP_NONE, 0, NULL), OCTREE_NULL_ARGUMENT);
    octree_destroy(tree);
}

static void functions_that_search_a_tree_refuse_null(void **state)
{
    (void)state;
    const double at[3] = {0};
    octree_box box = cube(-1, 1);
    octree_neighbor nearest;
    size_t count;
    octree *tree = make_tree(box, 1, 5, OCTREE_REFUSE);
    insert_all(tree, &at, 1);
    uint64_t version = octree_version(tree);
    assert_int_equal(octree_range_search(NULL, &box, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range_search(tree, NULL, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_range_search(tree, &box, NULL, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_radius(NULL, at, 1, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_radius(tree, NULL, 1, NULL, visit_point, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_radius(tree, at, 1, NULL, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_k(NULL, at, 1, NULL, &nearest, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_k(tree, NULL, 1, NULL, &nearest, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_k(tree, at, 1, NULL, NULL, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_k(tree, at, 1, NULL, &nearest, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_k(NULL, at, 0, NULL, &nearest, &count), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_within(NULL, at, 1, NULL, &nearest), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_within(tree, NULL, 1, NULL, &nearest), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_nearest_within(tree, at, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    /* Null stands for the default here. */
    assert_int_equal(octree_range_search(tree, &box, NULL, visit_point, NULL), OCTREE_OK);
    assert_int_equal(octree_radius(tree, at, 1, NULL, visit_point, NULL), OCTREE_OK);
    assert_int_equal(octree_nearest_k(tree, at, 1, NULL, &nearest, &count), OCTREE_OK);
    assert_int_equal(octree_nearest_within(tree, at, 1, NULL, &nearest), OCTREE_OK);
    assert_true(octree_version(tree) == version);
    octree_destroy(tree);
}

static bool must_not_be_called(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    fail_msg("a query that is refused visits nothing");
    return false;
}

/* Every query that takes a search refuses this one, and tells why. */
static void assert_refused(const octree *tree, const octree_search *how, octree_status status)
{
    const double at[3] = {0};
    octree_box box = cube(-1, 1);
    octree_neighbor nearest;
    size_t count;
    assert_int_equal(octree_range_search(tree, &box, how, must_not_be_called, NULL), status);
    assert_int_equal(octree_radius(tree, at, 1, how, must_not_be_called, NULL), status);
    assert_int_equal(octree_nearest_k(tree, at, 1, how, &nearest, &count), status);
    assert_int_equal(octree_nearest_within(tree, at, 1, how, &nearest), status);
}

static void functions_that_search_a_tree_refuse_bad_numbers(void **state)
{
    (void)state;
    static const struct {
        double number; /* as epsilon and as radius */
        octree_status status;
    } bad[] = {
        {NAN, OCTREE_NOT_FINITE},   {INFINITY, OCTREE_NOT_FINITE}, {-INFINITY, OCTREE_NOT_FINITE},
        {-5e-324, OCTREE_BAD_SIZE}, {-1, OCTREE_BAD_SIZE},         {-DBL_MAX, OCTREE_BAD_SIZE},
    };
    const double at[3] = {0};
    octree_neighbor nearest;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    insert_all(tree, &at, 1);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_refused(tree, &(octree_search){.epsilon = bad[i].number}, bad[i].status);
        assert_int_equal(octree_radius(tree, at, bad[i].number, NULL, must_not_be_called, NULL), bad[i].status);
        assert_int_equal(octree_nearest_within(tree, at, bad[i].number, NULL, &nearest), bad[i].status);
    }
    assert_refused(tree, &(octree_search){.skip = (octree_skip)3}, OCTREE_BAD_OPTION);
    assert_refused(tree, &(octree_search){.mode = (octree_mode)2}, OCTREE_BAD_OPTION);
    for (int axis = 0; axis < 6; axis++) {
        octree_box box = cube(-1, 1);
        (axis < 3 ? box.min : box.max)[axis % 3] = NAN;
        assert_int_equal(octree_range_search(tree, &box, NULL, must_not_be_called, NULL), OCTREE_NOT_FINITE);
        (axis < 3 ? box.min : box.max)[axis % 3] = axis < 3 ? 2 : -2;
        assert_int_equal(octree_range_search(tree, &box, NULL, must_not_be_called, NULL), OCTREE_BAD_RANGE);
    }
    octree_destroy(tree);
}

static void points_are_ordered_by_id_then_position(void **state)
{
    (void)state;
    static const octree_point sorted[] = {
        {{9, 9, 9}, 0},    {{-1, 5, 5}, 1},       {{-0.0, -1, 7}, 1},
        {{0.0, 1, -7}, 1}, {{0.0, 1, 5e-324}, 1}, {{0, 0, 0}, UINT64_MAX},
    };
    enum { n = sizeof sorted / sizeof sorted[0] };
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            int order = octree_compare_points(&sorted[i], &sorted[j]);
            assert_int_equal((order > 0) - (order < 0), (i > j) - (i < j));
        }
    const octree_point zero = {{0.0, -0.0, 0}, 4}, also_zero = {{-0.0, 0.0, -0.0}, 4};
    assert_int_equal(octree_compare_points(&zero, &also_zero), 0);
}

static void functions_that_inspect_a_tree_refuse_null(void **state)
{
    (void)state;
    const double at[3] = {0};
    octree_node node;
    octree_stats stats;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_walk(NULL, visit_node, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_walk(tree, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_node_at(NULL, OCTREE_ROOT, &node), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_locate(NULL, at, &node), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_locate(tree, NULL, &node), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_locate(tree, at, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_statistics(NULL, &stats), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_statistics(tree, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_count(NULL), 0);
    assert_true(octree_version(NULL) == 0);
    assert_true(octree_digest(NULL) == 0);
    assert_string_equal(octree_check(NULL, NULL), "there is no tree");
    const octree_def none = octree_definition(NULL), def = octree_def_default();
    assert_true(none.leaf_capacity == def.leaf_capacity && none.max_depth == def.max_depth);
    octree_destroy(tree);
}

static void null_is_refused_by_games_and_samples(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    octree_game *game = NULL;
    octree_box box = cube(0, 1);
    double position[1][3];
    assert_int_equal(octree_game_create(NULL, &game), OCTREE_NULL_ARGUMENT);
    assert_null(game);
    assert_int_equal(octree_game_create(&session, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_step(NULL, '.'), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_advance(NULL), OCTREE_NULL_ARGUMENT);
    octree_game_destroy(NULL);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, NULL, 1, position), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &box, 1, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &box, 0, NULL), OCTREE_OK);
    octree_sample_kind kind;
    assert_false(octree_sample_parse(NULL, &kind));
    assert_false(octree_sample_parse("uniform", NULL));
}

static void null_has_nothing_that_could_be_asked_of_a_game(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game;
    octree_point point;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    assert_false(octree_game_find(NULL, 1, &point));
    assert_false(octree_game_find(game, 1, NULL));
    assert_true(octree_game_over(NULL));
    assert_null(octree_game_tick(NULL));
    assert_null(octree_game_tree(NULL));
    assert_null(octree_game_session(NULL));
    assert_true(octree_session_length(NULL) == 0);
    assert_null(octree_session_gap(NULL, 0));
    assert_int_equal(octree_input_check(NULL), OCTREE_NULL_ARGUMENT);
    octree_answer answer = {.count = 3};
    octree_answer_release(NULL, &answer);
    octree_answer_release(octree_game_tree(game), NULL);
    assert_int_equal(answer.count, 3);
    octree_game_destroy(game);
}

static void each_status_has_its_own_name_and_sentence(void **state)
{
    (void)state;
    for (int i = 0; i < OCTREE_STATUS_COUNT; i++) {
        const char *text = octree_status_text((octree_status)i);
        const char *name = octree_status_name((octree_status)i);
        size_t length = strlen(text);
        assert_true(length > 3);
        assert_true(text[length - 1] != '.' || text[length - 2] == ' '); /* no final stop; " ." names a key */
        assert_int_equal(strspn(name, "abcdefghijklmnopqrstuvwxyz_"), strlen(name));
        for (int j = 0; j < i; j++) {
            assert_string_not_equal(text, octree_status_text((octree_status)j));
            assert_string_not_equal(name, octree_status_name((octree_status)j));
        }
    }
    assert_string_equal(octree_status_name(OCTREE_NOT_FOUND), "not_found");
    assert_non_null(octree_status_text((octree_status)OCTREE_STATUS_COUNT));
    assert_non_null(octree_status_text((octree_status)-1));
    assert_non_null(octree_status_name((octree_status)OCTREE_STATUS_COUNT));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_definition_is_the_documented_one),
        cmocka_unit_test(default_tree_keeps_all_coincident_points),
        cmocka_unit_test(create_refuses_worlds_that_are_empty_or_not_finite),
        cmocka_unit_test(create_accepts_any_finite_world),
        cmocka_unit_test(create_clamps_and_reports_capacity_and_depth),
        cmocka_unit_test(a_capacity_that_is_clamped_still_works),
        cmocka_unit_test(create_refuses_capacity_zero_and_unlisted_options),
        cmocka_unit_test(an_empty_tree_is_one_leaf),
        cmocka_unit_test(clear_makes_a_tree_like_a_new_one),
        cmocka_unit_test(functions_that_change_a_tree_refuse_null),
        cmocka_unit_test(functions_that_query_a_tree_refuse_null),
        cmocka_unit_test(functions_that_search_a_tree_refuse_null),
        cmocka_unit_test(functions_that_search_a_tree_refuse_bad_numbers),
        cmocka_unit_test(points_are_ordered_by_id_then_position),
        cmocka_unit_test(functions_that_inspect_a_tree_refuse_null),
        cmocka_unit_test(null_is_refused_by_games_and_samples),
        cmocka_unit_test(null_has_nothing_that_could_be_asked_of_a_game),
        cmocka_unit_test(each_status_has_its_own_name_and_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
