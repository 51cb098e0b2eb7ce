/* SPDX-License-Identifier: MIT */
/* test_game_sweep.c - collisions on the way of a tick: nothing is tunnelled, whoever moves. test_game_ticks.c has
 * random sessions, test_exact_game_sweep.c the truth to the last bit. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "game_fixture.h"

/* A world of +-1000, and a player of box 30 and step 60 in its middle, id 100. */
static octree_session wide_session(const octree_game_body *bodies, size_t count, bool sweep)
{
    octree_session session = small_session(bodies, count);
    session.tree.world = cube(-1000, 1000);
    session.player.step = 60;
    session.player.box_size = 30;
    session.player.sweep = sweep;
    return session;
}

static bool has_event(const octree_tick *tick, octree_event event)
{
    return (tick->events & event) != 0;
}

static void assert_taken_back(const octree_tick *tick, double x, double y, double z)
{
    assert_true(has_event(tick, OCTREE_EVENT_COLLIDED));
    assert_false(has_event(tick, OCTREE_EVENT_MOVED));
    assert_true(same_position(tick->player, (double[3]){x, y, z}));
    assert_true(tick->swept && same_position(tick->from, tick->player));
}

static void a_session_is_swept_only_when_it_says_so(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    assert_false(session.player.sweep);
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'w');
    assert_false(tick->swept);
    assert_null(tick->hit_from);
    assert_true(same_position(tick->from, (double[3]){0, 0, 0}));
    octree_game_destroy(game);
}

/* The relative step is (60, 60): both end boxes miss the point that is (45, 15) off. */
static void a_point_that_both_ends_miss_is_met_on_the_way(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 1, .position = {45, 15, 0}, .velocity = {0, -60, 0}};
    for (int sweep = 0; sweep < 2; sweep++) {
        const octree_session session = wide_session(&body, 1, sweep);
        octree_game *game = start_game(&session);
        const octree_tick *tick = play_key(game, 'd');
        assert_int_equal(tick->hit_count, sweep);
        if (sweep) {
            assert_taken_back(tick, 0, 0, 0);
            assert_true(same_position(tick->attempt, (double[3]){60, 0, 0}));
            assert_true(same_position(tick->hits[0].position, (double[3]){45, -45, 0}));
            assert_true(same_position(tick->hit_from[0], (double[3]){45, 15, 0}));
        } else {
            assert_true(tick->player[0] == 60);
        }
        octree_game_destroy(game);
    }
}

/* A wall of points 60 apart at x = 100 stops a step of 500, and is not even seen without a sweep. */
static void a_thin_wall_stops_a_long_step(void **state)
{
    (void)state;
    octree_game_body wall[81];
    for (size_t i = 0; i < 81; i++)
        wall[i] =
            (octree_game_body){.id = i, .position = {100, 60 * (double)(i / 9) - 217, 60 * (double)(i % 9) - 251}};
    for (int sweep = 0; sweep < 2; sweep++) {
        octree_session session = wide_session(wall, 81, sweep);
        session.tree.full_leaf = OCTREE_GROW;
        session.player.step = 500;
        octree_game *game = start_game(&session);
        const uint64_t digest = octree_digest(octree_game_tree(game));
        const octree_tick *tick = play_key(game, 'd');
        assert_true(has_event(tick, OCTREE_EVENT_MOVED) == !sweep);
        assert_true((octree_digest(octree_game_tree(game)) == digest) == sweep);
        if (sweep)
            assert_taken_back(tick, 0, 0, 0);
        assert_false(has_event(play_key(game, 'a'), OCTREE_EVENT_REFUSED));
        octree_game_destroy(game);
    }
}

static void a_bullet_through_a_waiting_player_is_told(void **state)
{
    (void)state;
    static const octree_game_body bullets[] = {{.id = 9, .position = {-100, 30, 0}, .velocity = {200, 0, 0}},
                                               {.id = 3, .position = {0, 10, 500}, .velocity = {0, 0, -900}},
                                               {.id = 5, .position = {-100, 31, 0}, .velocity = {200, 0, 0}}};
    const octree_session session = wide_session(bullets, 3, true);
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_int_equal(tick->hit_count, 2);
    assert_true(tick->hits[0].id == 3 && tick->hits[1].id == 9);
    assert_true(tick->hit_from[0][2] == 500 && tick->hits[0].position[2] == -400);
    assert_true(tick->hit_from[1][0] == -100 && tick->hits[1].position[0] == 100);
    assert_taken_back(tick, 0, 0, 0);
    octree_game_destroy(game);
}

/* What arrives where the player was is not met by a player that has left. */
static void a_body_that_arrives_behind_the_player_is_not_met(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 1, .position = {40, 100, 0}, .velocity = {-40, -100, 0}};
    octree_session session = wide_session(&body, 1, true);
    session.player.step = 200;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd'); /* (40, 100) to (-200, 0): x = 40 - 240 t, y = 100 - 100 t */
    assert_int_equal(tick->hit_count, 0);
    assert_true(has_event(tick, OCTREE_EVENT_MOVED));
    octree_game_destroy(game);
}

/* At rest relative to the player, on its box's face or an ulp beside. */
static void companions_of_one_velocity_never_meet(void **state)
{
    (void)state;
    octree_game_body companion = {.id = 1, .position = {0, 0, next_up(30)}, .velocity = {60, 0, 0}};
    octree_session session = wide_session(&companion, 1, true);
    octree_game *game = start_game(&session);
    for (int i = 0; i < 10; i++)
        assert_int_equal(play_key(game, 'd')->hit_count, 0);
    octree_game_destroy(game);
    companion.position[2] = 30; /* on the face: met from the start */
    game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->hit_count, 1);
    for (int i = 0; i < 3; i++)
        assert_int_equal(play_key(game, 'd')->hit_count, i == 0);
    octree_game_destroy(game);
}

static void an_edit_that_moves_is_a_motion_and_one_that_inserts_is_none(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {-100, 0, 0}}, {.id = 2, .position = {-100, 1, 0}}};
    static const octree_edit edits[] = {
        {1, OCTREE_EDIT_MOVE, {.id = 1, .position = {100, 0, 0}}},
        {1, OCTREE_EDIT_REMOVE, {.id = 2}},
        {1, OCTREE_EDIT_INSERT, {.id = 2, .position = {100, 1, 0}}},
        {2, OCTREE_EDIT_INSERT, {.id = 3, .position = {-100, 2, 0}, .velocity = {200, 0, 0}}},
        {3, OCTREE_EDIT_REMOVE, {.id = 3}},
        {4, OCTREE_EDIT_MOVE, {.id = 1, .position = {-100, 0, 0}}},
        {4, OCTREE_EDIT_REMOVE, {.id = 1}},
        {5, OCTREE_EDIT_MOVE, {.id = 2, .position = {0, 500, 0}}}, /* over there, and on */
        {5, OCTREE_EDIT_MOVE, {.id = 2, .position = {-100, 1, 0}}},
    };
    octree_session session = wide_session(bodies, 2, true);
    session.tree.full_leaf = OCTREE_GROW;
    session.edits = edits;
    session.edit_count = sizeof edits / sizeof edits[0];
    octree_game *game = start_game(&session);
    static const uint64_t hit[] = {1, 3, 0, 0, 2};
    for (size_t i = 0; i < sizeof hit / sizeof hit[0]; i++) {
        const octree_tick *tick = play_key(game, '.');
        assert_int_equal(tick->hit_count, hit[i] != 0);
        if (hit[i])
            assert_int_equal(tick->hits[0].id, hit[i]);
    }
    octree_game_destroy(game);
}

/* Edit and velocity are one straight way, and so is a bounce, which does not go to the face. */
static void ways_are_straight_from_tick_to_tick(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {-100, 100, 0}, .velocity = {200, 0, 0}},
                                              {.id = 2, .position = {990, 0, 500}, .velocity = {30, 0, 0}}};
    static const octree_edit edits[] = {{1, OCTREE_EDIT_MOVE, {.id = 1, .position = {-100, -100, 0}}}};
    octree_session session = wide_session(bodies, 2, true);
    session.edits = edits;
    session.edit_count = 1;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.'); /* (-100, 100) to (100, -100), through the middle */
    assert_int_equal(tick->hit_count, 1);
    assert_true(tick->hits[0].id == 1 && tick->hit_from[0][1] == 100 && tick->hits[0].position[0] == 100);
    octree_game_destroy(game);
    session = wide_session(bodies + 1, 1, true);
    session.player = (octree_player){.id = 100, .position = {999, 0, 500}, .box_size = 5, .sweep = true};
    game = start_game(&session); /* the body goes to 1000, back to 980: no nearer to the player than it was */
    assert_int_equal(play_key(game, '.')->hit_count, 0);
    octree_game_destroy(game);
}

/* The bullet would miss a player that leaves, and hits the one that stays. */
static void a_step_that_a_full_leaf_refuses_is_a_wait(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 9, 9}},
                                              {.id = 2, .position = {9, 9, 8}},
                                              {.id = 3, .position = {-1.375, 0.25, -9}, .velocity = {0, 0, 18}}};
    octree_session session = small_session(bodies, 3);
    session.tree.max_depth = 1;
    session.player.position[0] = -1;
    session.player.sweep = true;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd');
    assert_true(has_event(tick, OCTREE_EVENT_FULL));
    assert_taken_back(tick, -1, 0, 0);
    assert_true(same_position(tick->attempt, tick->player)); /* where it stayed, and was run into */
    assert_int_equal(tick->hits[0].id, 3);
    octree_game_destroy(game);
}

static void a_body_whose_motion_is_refused_is_at_rest(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 9, 9}},
                                              {.id = 2, .position = {9, 9, 8}},
                                              {.id = 3, .position = {-2, 1, 1}, .velocity = {4, 0, 0}}};
    octree_session session = small_session(bodies, 3);
    session.tree.max_depth = 1;
    session.player.position[2] = -0.25; /* its box reaches the way of the third body, and not where that stays */
    session.player.box_size = 1.25;
    session.player.sweep = true;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_true(has_event(tick, OCTREE_EVENT_FULL));
    assert_int_equal(tick->hit_count, 0);
    octree_game_destroy(game);
}

/* A way from end to end of the largest world, whose length no double holds. */
static void nothing_overflows_in_the_largest_world(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {
        {.id = 1, .position = {-DBL_MAX, -DBL_MAX, -DBL_MAX}, .velocity = {0}}, /* moved by the edit: hits */
        {.id = 2, .position = {-DBL_MAX, DBL_MAX, 0}},                          /* moved by the edit: passes by */
        {.id = 3, .position = {DBL_MAX / 2, 0, 0}},                             /* in the way of the step */
    };
    static const octree_edit edits[] = {{1, OCTREE_EDIT_MOVE, {.id = 1, .position = {DBL_MAX, DBL_MAX, DBL_MAX}}},
                                        {1, OCTREE_EDIT_MOVE, {.id = 2, .position = {DBL_MAX, DBL_MAX, 0}}}};
    octree_session session = wide_session(bodies, 3, true);
    session.tree.world = cube(-DBL_MAX, DBL_MAX);
    session.tree.max_depth = 21;
    session.edits = edits;
    session.edit_count = 2;
    session.player.step = DBL_MAX;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_int_equal(tick->hit_count, 1);
    assert_int_equal(tick->hits[0].id, 1);
    tick = play_key(game, 'd');
    assert_int_equal(tick->hit_count, 1);
    assert_int_equal(tick->hits[0].id, 3);
    assert_true(tick->attempt[0] == DBL_MAX);
    tick = play_key(game, 'w');
    assert_true(has_event(tick, OCTREE_EVENT_MOVED) && tick->player[1] == DBL_MAX);
    tick = play_key(game, 'w');
    assert_true(has_event(tick, OCTREE_EVENT_REFUSED));
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_session_is_swept_only_when_it_says_so),
        cmocka_unit_test(a_point_that_both_ends_miss_is_met_on_the_way),
        cmocka_unit_test(a_thin_wall_stops_a_long_step),
        cmocka_unit_test(a_bullet_through_a_waiting_player_is_told),
        cmocka_unit_test(a_body_that_arrives_behind_the_player_is_not_met),
        cmocka_unit_test(companions_of_one_velocity_never_meet),
        cmocka_unit_test(an_edit_that_moves_is_a_motion_and_one_that_inserts_is_none),
        cmocka_unit_test(ways_are_straight_from_tick_to_tick),
        cmocka_unit_test(a_step_that_a_full_leaf_refuses_is_a_wait),
        cmocka_unit_test(a_body_whose_motion_is_refused_is_at_rest),
        cmocka_unit_test(nothing_overflows_in_the_largest_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
