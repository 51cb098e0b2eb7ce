/* SPDX-License-Identifier: MIT */
/* test_game_visits.c - what a tick says that its questions met, held against a walk over all nodes. */
#include "fixture.h"

#include <string.h>

#include "game_fixture.h"
#include "octree/sample.h"
#include "random_session.h"
#include "recount.h"

/* Which kinds of touch and of leaf a session has shown. */
typedef struct shown {
    size_t touched[OCTREE_TRACE_KINDS];
    size_t leaves, cost_points;
} shown;

static void check_session(const octree_session *session, shown *met)
{
    octree_game *game = start_game(session);
    recount all = {0};
    double before[3];
    memcpy(before, session->player.position, sizeof before);
    for (;;) {
        const octree_tick *tick = octree_game_tick(game);
        recount_tick(&all, game, before);
        assert_recount(&all, tick);
        for (int touch = 0; touch < OCTREE_TRACE_KINDS; touch++)
            met->touched[touch] += tick->touched[touch];
        met->leaves += tick->hit_leaf_count;
        met->cost_points += tick->hit_cost.points;
        memcpy(before, tick->player, sizeof before);
        if (octree_game_over(game))
            break;
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    recount_free(&all);
    octree_game_destroy(game);
}

static void assert_all_shown(const shown *met)
{
    for (int touch = 0; touch < OCTREE_TRACE_KINDS; touch++)
        assert_true(met->touched[touch] > 0);
    assert_true(met->leaves > 0 && met->cost_points > 0);
}

static void ticks_of_random_sessions_tell_what_a_recount_finds(void **state)
{
    (void)state;
    shown met = {{0}, 0, 0};
    for (uint64_t seed = 1; seed <= 120; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session, &met);
    }
    assert_all_shown(&met);
}

static void ticks_of_the_default_session_tell_what_a_recount_finds(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    shown met = {{0}, 0, 0};
    check_session(&session, &met);
    assert_all_shown(&met);
}

enum { BODIES = 2000 };

/* Boxes and balls that hold whole nodes, neighbours, and points in clusters. */
static void ticks_among_many_points_tell_what_a_recount_finds(void **state)
{
    (void)state;
    static octree_game_body bodies[BODIES];
    static double positions[BODIES][3];
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .at_player = true, .box = {{-3, -4, -5}, {5.5, 4, 3}}},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .target = {2.3, 1.7, -0.3}, .radius = 6.1},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .target = {-30, 2.5, 0.3}, .k = 40},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{20, 20, 20}, {30, 30, 30}}},
    };
    octree_session session = small_session(bodies, BODIES);
    session.tree = define(cube(-10, 10), 4, OCTREE_MAX_DEPTH, OCTREE_GROW);
    session.player.position[0] = 0.137;
    session.player.step = 1.7;
    session.keys = "wdnefasn.";
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 9, &session.tree.world, BODIES, positions), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        bodies[i] = (octree_game_body){.id = i + 1000};
        memcpy(bodies[i].position, positions[i], sizeof positions[i]);
    }
    shown met = {{0}, 0, 0};
    check_session(&session, &met);
    assert_all_shown(&met);
}

/* Three levels of capacity 1, as test_cost.c draws them: 0 holds 0/0 and 0/7, beside 4 and 7. The player, in 3, keeps
 * clear of all, so that its own test visits the root and 3, and prunes the others. */
static octree_session three_levels(void)
{
    static const octree_game_body bodies[] = {{.id = 1, .position = {-6, -6, -6}},
                                              {.id = 2, .position = {-2, -2, -2}},
                                              {.id = 3, .position = {6, 6, 6}},
                                              {.id = 4, .position = {6, -6, -6}}};
    octree_session session = small_session(bodies, 4);
    session.tree = define(cube(-8, 8), 1, OCTREE_MAX_DEPTH, OCTREE_REFUSE);
    session.player = (octree_player){.id = 100, .position = {-6, 6, 6}, .step = 1, .box_size = 0.5};
    return session;
}

static octree_trace_kind touch_of(const octree_tick *tick, octree_address node)
{
    for (size_t i = 0; i < tick->visit_count; i++)
        if (tick->visits[i].node == node)
            return tick->visits[i].touch;
    return OCTREE_TRACE_KINDS;
}

static void the_strongest_touch_of_a_node_counts(void **state)
{
    (void)state;
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RANGE, .box = {{-9, -9, -9}, {-0.5, -0.5, -0.5}}}, /* visits 0 and 0/7, takes 0/0 */
        {.kind = OCTREE_QUERY_RANGE, .box = {{-0.25, -9, -9}, {9, 0.5, 0.5}}},   /* visits 0 and 7, takes 4 */
        {.kind = OCTREE_QUERY_RANGE, .box = {{-7, -7, -7}, {-5, -5, -5}}},       /* visits 0/0, prunes 0/7 */
    };
    octree_session session = three_levels();
    session.queries = queries;
    const struct {
        size_t asked;
        octree_trace_kind touches[5]; /* of 0, 0/0, 0/7, 4, 7 */
    } rows[] = {
        {0, {OCTREE_TRACE_PRUNED, OCTREE_TRACE_KINDS, OCTREE_TRACE_KINDS, OCTREE_TRACE_PRUNED, OCTREE_TRACE_PRUNED}},
        {1, {OCTREE_TRACE_VISITED, OCTREE_TRACE_TAKEN, OCTREE_TRACE_VISITED, OCTREE_TRACE_PRUNED, OCTREE_TRACE_PRUNED}},
        {2, {OCTREE_TRACE_VISITED, OCTREE_TRACE_TAKEN, OCTREE_TRACE_VISITED, OCTREE_TRACE_TAKEN, OCTREE_TRACE_VISITED}},
        {3,
         {OCTREE_TRACE_VISITED, OCTREE_TRACE_VISITED, OCTREE_TRACE_VISITED, OCTREE_TRACE_TAKEN, OCTREE_TRACE_VISITED}},
    };
    static const octree_address nodes[] = {010, 0100, 0107, 014, 017};
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        session.query_count = rows[row].asked;
        octree_game *game = start_game(&session);
        const octree_tick *tick = octree_game_tick(game);
        for (size_t i = 0; i < 5; i++)
            assert_int_equal(touch_of(tick, nodes[i]), rows[row].touches[i]);
        assert_int_equal(touch_of(tick, OCTREE_ROOT), OCTREE_TRACE_VISITED);
        assert_int_equal(touch_of(tick, 013), OCTREE_TRACE_VISITED);
        octree_game_destroy(game);
    }
}

static void leaves_of_hits_and_answers_are_named_once(void **state)
{
    (void)state;
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RANGE, .box = {{-7, -7, -7}, {-1, -1, -1}}},
        {.kind = OCTREE_QUERY_NEAREST, .target = {-6, -6, -5}},
        {.kind = OCTREE_QUERY_RADIUS, .target = {6, 6, 6}, .radius = 1},
    };
    octree_session session = three_levels();
    session.queries = queries;
    session.query_count = 3;
    session.player.position[1] = -6; /* 1 is in its box */
    session.player.position[2] = -5.5;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->hit_count, 1);
    assert_int_equal(tick->hit_leaf_count, 4); /* 0/0 was split to tell the player from 1 */
    octree_node leaf;
    for (size_t i = 0; i < tick->hit_leaf_count; i++) {
        assert_int_equal(octree_node_at(octree_game_tree(game), tick->hit_leaves[i], &leaf), OCTREE_OK);
        assert_true(leaf.leaf && leaf.count == 1);
        assert_true(leaf.points[0].id != 4);
    }
    octree_game_destroy(game);
}

/* The tree prunes its root, and the tick's two moved bodies are compared with the way: one point each. */
static void bodies_that_moved_are_compared_one_by_one_when_swept(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}, .velocity = {1, 0, 0}},
                                              {.id = 2, .position = {-5, 5, 5}, .velocity = {0, 1, 0}},
                                              {.id = 3, .position = {-5, -5, -5}}};
    uint64_t points[2];
    for (int sweep = 0; sweep < 2; sweep++) {
        octree_session session = small_session(bodies, 3);
        session.player.sweep = sweep;
        octree_game *game = start_game(&session);
        points[sweep] = play_key(game, '.')->hit_cost.points;
        octree_game_destroy(game);
    }
    assert_int_equal(points[1], points[0] + 2);
}

static void a_tick_that_asks_nothing_but_its_collision_test_is_counted(void **state)
{
    (void)state;
    const octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    for (int i = 0; i < 3; i++) {
        const octree_tick *tick = play_key(game, "w.f"[i]);
        assert_int_equal(tick->visit_count, 1); /* one leaf, the root */
        assert_int_equal(tick->touched[OCTREE_TRACE_VISITED], 1);
        assert_true(tick->hit_cost.nodes == 1 && tick->hit_cost.leaves == 1 && tick->hit_cost.points == 1);
        assert_int_equal(tick->hit_leaf_count, 0);
    }
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ticks_of_random_sessions_tell_what_a_recount_finds),
        cmocka_unit_test(ticks_of_the_default_session_tell_what_a_recount_finds),
        cmocka_unit_test(ticks_among_many_points_tell_what_a_recount_finds),
        cmocka_unit_test(the_strongest_touch_of_a_node_counts),
        cmocka_unit_test(leaves_of_hits_and_answers_are_named_once),
        cmocka_unit_test(bodies_that_moved_are_compared_one_by_one_when_swept),
        cmocka_unit_test(a_tick_that_asks_nothing_but_its_collision_test_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
