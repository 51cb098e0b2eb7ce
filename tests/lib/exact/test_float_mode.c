/* SPDX-License-Identifier: MIT */
/* test_float_mode.c - a thread with a non-default floating-point mode gets OCTREE_FLOAT_MODE, never a wrong answer. */
#include "fixture.h"

#include <fenv.h>
#include <string.h>

#include "octree/game.h"
#include "octree/sample.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

static bool ignore(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

static octree_walk_order look(const octree_node *node, void *context)
{
    (void)node;
    (void)context;
    return OCTREE_WALK_ON;
}

static const double here[3] = {1, 2, 3}, there[3] = {4, 5, 6};

/* What every function that computes says, as a bit a status; 1 << OCTREE_FLOAT_MODE alone when they agree. */
static uint64_t ask_everything(octree *tree, octree_game *game)
{
    const octree_box box = {{0, 0, 0}, {9, 9, 9}};
    const octree_def def = octree_def_default();
    octree *other;
    octree_node node;
    octree_neighbor nearest;
    octree_point points[2] = {{{7, 7, 7}, 9}, {{1, 2, 3}, 1}};
    double samples[2][3];
    size_t count;
    bool found;
    octree_stats stats;
    const octree_query query = {.kind = OCTREE_QUERY_NEAREST};
    const octree_status said[] = {
        octree_create(&def, &other),
        octree_insert(tree, there, 2),
        octree_remove(tree, here, 1),
        octree_move(tree, here, 1, there),
        octree_insert_many(tree, points, 1, NULL, NULL),
        octree_remove_many(tree, points + 1, 1, NULL, NULL),
        octree_reworld(tree, &box),
        octree_find(tree, here, NULL),
        octree_range(tree, &box, ignore, NULL),
        octree_range_count(tree, &box, &count),
        octree_range_collect(tree, &box, NULL, points, 2, &count),
        octree_radius(tree, here, 5, NULL, ignore, NULL),
        octree_collide(tree, here, 5, NULL, ignore, NULL),
        octree_collide_swept(tree, here, there, 5, NULL, NULL, ignore, NULL),
        octree_nearest(tree, here, OCTREE_SKIP_NONE, 0, &nearest),
        octree_nearest_k(tree, here, 1, NULL, &nearest, &count),
        octree_nearest_within(tree, here, 5, NULL, &nearest),
        octree_nearest_batch(tree, (const double(*)[3]) & here, 1, NULL, &nearest, &found),
        octree_locate(tree, here, &node),
        octree_node_at(tree, OCTREE_ROOT, &node),
        octree_walk(tree, look, NULL),
        octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &box, 2, samples),
        octree_game_step(game, 'w'),
        octree_game_ask(game, &query, 1),
        octree_statistics(tree, &stats),
    };
    uint64_t statuses = 0;
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++)
        statuses |= UINT64_C(1) << said[i];
    return statuses;
}

typedef void set_mode(bool unusual);

static void assert_refused(set_mode *set)
{
    octree *tree = make_tree(cube(-1000, 1000), 2, 21, OCTREE_GROW);
    assert_int_equal(octree_insert(tree, here, 1), OCTREE_OK);
    for (uint64_t id = 10; id < 40; id++) /* so many that one more is inserted singly */
        assert_int_equal(octree_insert(tree, (double[3]){-100, (double)id, 0}, id), OCTREE_OK);
    const octree_session session = octree_session_default();
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    set(true);
    const uint64_t said = ask_everything(tree, game), unusual = octree_digest(tree);
    const bool checked = octree_check(tree, NULL) == NULL;
    set(false);
    assert_true(said == UINT64_C(1) << OCTREE_FLOAT_MODE);
    assert_true(unusual == 0 && !checked);
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    assert_int_equal(octree_game_tick(game)->number, 0);
    assert_valid(tree);
    octree_game_destroy(game);
    octree_destroy(tree);
}

static void round_up(bool unusual)
{
    fesetround(unusual ? FE_UPWARD : FE_TONEAREST);
}

static void round_down(bool unusual)
{
    fesetround(unusual ? FE_DOWNWARD : FE_TONEAREST);
}

static void round_to_zero(bool unusual)
{
    fesetround(unusual ? FE_TOWARDZERO : FE_TONEAREST);
}

static void directed_rounding_is_refused(void **state)
{
    (void)state;
    assert_refused(round_up);
    assert_refused(round_down);
    assert_refused(round_to_zero);
}

#if defined(__SSE2__)
static void flush_to_zero(bool unusual)
{
    _mm_setcsr(unusual ? _mm_getcsr() | 0x8000u : _mm_getcsr() & ~0x8000u);
}

static void take_subnormals_as_zero(bool unusual)
{
    _mm_setcsr(unusual ? _mm_getcsr() | 0x0040u : _mm_getcsr() & ~0x0040u);
}

static void flushed_subnormals_are_refused(void **state)
{
    (void)state;
    assert_refused(flush_to_zero);
    assert_refused(take_subnormals_as_zero);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directed_rounding_is_refused),
#if defined(__SSE2__)
        cmocka_unit_test(flushed_subnormals_are_refused),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
