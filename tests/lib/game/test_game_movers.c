/* SPDX-License-Identifier: MIT */
/* test_game_movers.c - the bodies that a tick says move: which, where from, and how they go on. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "game_fixture.h"

/* The one mover with this id, or null. */
static const octree_game_body *find_mover(const octree_game *game, uint64_t id)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_game_body *found = NULL;
    for (size_t i = 0; i < tick->mover_count; i++) {
        if (tick->movers[i].id != id)
            continue;
        assert_null(found);
        found = &tick->movers[i];
    }
    return found;
}

static void assert_moves(const octree_game *game, uint64_t id, double at, double velocity)
{
    const octree_game_body *body = find_mover(game, id);
    assert_non_null(body);
    assert_true(body->position[0] == at && body->velocity[0] == velocity);
    assert_true(octree_contains(octree_game_tree(game), body->position, id));
}

/* In a world from -10 to 10. On the face itself a body is about to turn. */
static void a_bounce_turns_the_velocity(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 4, 4}, .velocity = {2, 0, 0}},
                                              {.id = 2, .position = {9, 5, 5}, .velocity = {1, 0, 0}},
                                              {.id = 3, .position = {-10, 6, 6}, .velocity = {-3, 0, 0}},
                                              {.id = 4, .position = {7, 7, 7}, .velocity = {39, 0, 0}}};
    static const double at[4][3] = {{9, 9, 7}, {9, 10, 9}, {-10, -7, -4}, {7, 6, 5}};
    static const double velocity[4][3] = {{2, -2, -2}, {1, -1, -1}, {3, 3, 3}, {39, 39, 39}};
    octree_session session = small_session(bodies, 4);
    octree_game *game = start_game(&session);
    for (int tick = 0; tick < 3; tick++) {
        if (tick)
            play_key(game, '.');
        assert_int_equal(octree_game_tick(game)->mover_count, 4);
        for (int i = 0; i < 4; i++)
            assert_moves(game, (uint64_t)i + 1, at[i][tick], velocity[i][tick]);
    }
    octree_game_destroy(game);
}

/* A mirror at both ends, for numbers that need no rounding. */
static double mirrored(double x, double min, double max)
{
    while (x < min || x > max)
        x = x > max ? 2 * max - x : 2 * min - x;
    return x;
}

enum { BODIES = 40 };

static void a_mover_is_next_where_its_velocity_takes_it(void **state)
{
    (void)state;
    octree_game_body bodies[BODIES];
    uint64_t random = 11;
    for (size_t i = 0; i < BODIES; i++) {
        bodies[i] = (octree_game_body){.id = i + 1};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = floor(random_between(&random, -40, 40)) / 4;
            bodies[i].velocity[axis] = i % 4 ? floor(random_between(&random, -200, 200)) / 4 : 0;
        }
    }
    octree_session session = small_session(bodies, BODIES);
    session.tree.full_leaf = OCTREE_GROW;
    octree_game *game = start_game(&session);
    for (int tick = 0; tick < 60; tick++) {
        octree_game_body before[BODIES];
        const size_t count = octree_game_tick(game)->mover_count;
        assert_int_equal(count, BODIES / 4 * 3);
        memcpy(before, octree_game_tick(game)->movers, count * sizeof *before);
        play_key(game, '.');
        for (size_t i = 0; i < count; i++) {
            double next[3];
            for (int axis = 0; axis < 3; axis++)
                next[axis] = mirrored(before[i].position[axis] + before[i].velocity[axis], -10, 10);
            assert_true(same_position(find_mover(game, before[i].id)->position, next));
        }
    }
    octree_game_destroy(game);
}

static void bodies_at_rest_and_the_player_do_not_move(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}},
                                              {.id = 2, .position = {6, 5, 5}, .velocity = {-0.0, 0, 0}}};
    octree_session session = small_session(bodies, 2);
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->mover_count, 0);
    assert_int_equal(play_key(game, 'd')->mover_count, 0);
    octree_game_destroy(game);
}

/* From the second tick on its way is more than a double holds: it stays where it began. */
static void a_body_too_fast_to_follow_is_at_rest(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 3, .position = {7, 5, 5}, .velocity = {0, 1.7e308, 0}}};
    octree_session session = small_session(body, 1);
    octree_game *game = start_game(&session);
    assert_non_null(find_mover(game, 3));
    play_key(game, '.');
    assert_int_equal(play_key(game, '.')->mover_count, 0);
    assert_true(octree_contains(octree_game_tree(game), body->position, 3));
    octree_game_destroy(game);
}

static void edits_begin_and_end_motion(void **state)
{
    (void)state;
    static const octree_edit edits[] = {
        {1, OCTREE_EDIT_INSERT, {.id = 7, .position = {-5, 5, 5}, .velocity = {0.5, 0, 0}}},
        {2, OCTREE_EDIT_MOVE, {.id = 7, .position = {2, 2, 2}}},
        {3, OCTREE_EDIT_REMOVE, {.id = 7}},
    };
    octree_session session = small_session(NULL, 0);
    session.edits = edits;
    session.edit_count = 3;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->mover_count, 0);
    play_key(game, '.');
    assert_moves(game, 7, -4.5, 0.5);
    play_key(game, '.');
    assert_moves(game, 7, 2.5, 0.5);
    play_key(game, '.');
    assert_int_equal(octree_game_tick(game)->mover_count, 0);
    octree_game_destroy(game);
}

enum { BOUNCING = 4 };

/* Where a tick after `before` a body must be that an edit has put here. */
static void assert_goes_on(const octree_game *game, const octree_game_body *before, const double put[3])
{
    double next[3];
    for (int axis = 0; axis < 3; axis++)
        next[axis] = mirrored(put[axis] + before->velocity[axis], -10, 10);
    assert_true(same_position(find_mover(game, before->id)->position, next));
}

/* A body that is moved goes on as its tick before said: turned on the axes where it had bounced, or was about to. */
static void a_move_undoes_no_bounce(void **state)
{
    (void)state;
    static const octree_game_body bodies[BOUNCING] = {{.id = 1, .position = {5, 5, 9}, .velocity = {0, 0, 2}},
                                                      {.id = 2, .position = {9, 0, -9}, .velocity = {2, 0.5, -3}},
                                                      {.id = 3, .position = {9, 3, 3}, .velocity = {1, 0, 0}},
                                                      {.id = 4, .position = {0, 4, 0}, .velocity = {39, 0, 0}}};
    octree_edit edits[BOUNCING];
    for (size_t i = 0; i < BOUNCING; i++)
        edits[i] = (octree_edit){0, OCTREE_EDIT_MOVE, {.id = bodies[i].id, .position = {1, 2, -3}}};
    for (uint64_t when = 0; when < 6; when++) {
        octree_session session = small_session(bodies, BOUNCING);
        session.tree.full_leaf = OCTREE_GROW;
        octree_game *game = start_game(&session);
        for (uint64_t tick = 0; tick < when; tick++)
            play_key(game, '.');
        octree_game_body before[BOUNCING];
        for (size_t i = 0; i < BOUNCING; i++)
            before[i] = *find_mover(game, bodies[i].id);
        const octree_input input = {.edits = edits, .edit_count = BOUNCING};
        assert_int_equal(octree_game_play(game, &input), OCTREE_OK);
        for (size_t i = 0; i < BOUNCING; i++)
            assert_goes_on(game, &before[i], edits[i].body.position);
        octree_game_destroy(game);
    }
}

/* At rest, since nobody can tell where it is on its way, it has lost no velocity. */
static void a_move_lets_a_body_go_on_that_was_too_fast_to_follow(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 3, .position = {7, 5, 5}, .velocity = {0, 1.7e308, 0}}};
    static const octree_edit move = {0, OCTREE_EDIT_MOVE, {.id = 3, .position = {1, 2, 3}}};
    octree_session session = small_session(body, 1);
    octree_game *game = start_game(&session);
    play_key(game, '.');
    assert_int_equal(play_key(game, '.')->mover_count, 0);
    assert_int_equal(octree_game_play(game, &(octree_input){.edits = &move, .edit_count = 1}), OCTREE_OK);
    assert_true(fabs(find_mover(game, 3)->velocity[1]) == 1.7e308);
    octree_game_destroy(game);
}

static void a_body_that_its_leaf_refuses_is_told_where_it_stays(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 9, 9}},
                                              {.id = 2, .position = {9, 9, 8}},
                                              {.id = 3, .position = {-1, 9, 9}, .velocity = {2, 0, 0}}};
    octree_session session = small_session(bodies, 3);
    session.tree.max_depth = 1;
    session.player.position[2] = -5;
    octree_game *game = start_game(&session);
    assert_int_equal(play_key(game, '.')->refusal_count, 1);
    assert_moves(game, 3, -1, 2);
    octree_game_destroy(game);
}

static void the_fastest_body_is_known_from_the_start(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {1, 1, 1}},
                                              {.id = 2, .position = {2, 2, 2}, .velocity = {1, -7, 2}},
                                              {.id = 3, .position = {3, 3, 3}, .velocity = {NAN, 50, 0}},
                                              {.id = 4, .position = {4, 4, 4}, .velocity = {0, 0, -INFINITY}}};
    const double fastest[] = {0, 7, 7, 7};
    for (size_t count = 1; count <= 4; count++) {
        octree_session session = small_session(bodies, count);
        octree_game *game = start_game(&session);
        assert_true(octree_game_fastest(game) == fastest[count - 1]);
        octree_game_destroy(game);
    }
    assert_true(octree_game_fastest(NULL) == 0);
}

/* More bodies than are moved one by one, in leaves so small that they refuse some: as single moves in their order. */
static void many_bodies_move_as_one_by_one(void **state)
{
    (void)state;
    enum { COUNT = 700, TICKS = 12 };
    static octree_game_body bodies[COUNT];
    static double stored[COUNT][3];
    uint64_t random = 4;
    for (int i = 0; i < COUNT; i++) {
        bodies[i].id = (uint64_t)(i * 37 % COUNT) + 1000;
        for (int axis = 0; axis < 3; axis++) {
            stored[i][axis] = bodies[i].position[axis] = (double)random_below(&random, 17) - 8;
            bodies[i].velocity[axis] = ((double)random_below(&random, 5) - 2) / 16; /* none reaches a face */
        }
    }
    octree_session session = small_session(bodies, COUNT);
    octree_game *game = start_game(&session);
    octree_def def = session.tree;
    octree *tree;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    bool known[COUNT] = {false};
    size_t refused = 0;
    for (int i = 0; i < COUNT; i++)
        known[i] = octree_contains(octree_game_tree(game), stored[i], bodies[i].id);
    for (int i = 0; i < COUNT; i++)
        if (known[i])
            assert_int_equal(octree_insert(tree, stored[i], bodies[i].id), OCTREE_OK);
    for (int tick = 1; tick <= TICKS; tick++) {
        play_key(game, '.');
        for (int i = 0; i < COUNT; i++) {
            double to[3];
            for (int axis = 0; axis < 3; axis++)
                to[axis] = bodies[i].position[axis] + bodies[i].velocity[axis] * tick;
            if (!known[i] || memcmp(to, stored[i], sizeof to) == 0)
                continue;
            if (octree_move(tree, stored[i], bodies[i].id, to) == OCTREE_OK)
                memcpy(stored[i], to, sizeof to);
            else
                refused++;
        }
        for (int i = 0; i < COUNT; i++)
            assert_true(!known[i] || octree_contains(octree_game_tree(game), stored[i], bodies[i].id));
    }
    assert_true(refused > 0);
    octree_destroy(tree);
    octree_game_destroy(game);
}

/* The extent of the first world overflows; in the others rounding leaves it by an ulp. */
static void a_reflected_body_stays_in_the_world_to_the_last_bit(void **state)
{
    (void)state;
    const struct {
        double min, max, from, velocity, to;
    } rows[] = {{-1.2e308, 1.2e308, 1e308, 1e308, 4e307},
                {5e-324, DBL_MAX, 1e308, -1e308, 5e-324},
                {-0.4, 0.18, 0.18, 5.551115123125783e-17, 0.18},
                {-0.7, 0.05, 0.05, 6.938893903907228e-18, 0.05}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const octree_game_body body = {.id = 1, .position = {rows[i].from, 0.01, 0.01}, .velocity = {rows[i].velocity}};
        octree_session session = small_session(&body, 1);
        session.player.kind = OCTREE_PLAYER_NONE;
        session.tree.world.min[0] = rows[i].min;
        session.tree.world.max[0] = rows[i].max;
        octree_game *game = start_game(&session);
        octree_point point;
        play_key(game, '.');
        assert_true(octree_game_find(game, 1, &point));
        if (!(fabs(point.position[0] - rows[i].to) <= 1e-12 * fabs(rows[i].to)))
            fail_msg("row %d: %.17g", (int)i, point.position[0]);
        assert_true(rows[i].min <= point.position[0] && point.position[0] <= rows[i].max);
        octree_game_destroy(game);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bounce_turns_the_velocity),
        cmocka_unit_test(a_mover_is_next_where_its_velocity_takes_it),
        cmocka_unit_test(bodies_at_rest_and_the_player_do_not_move),
        cmocka_unit_test(a_body_too_fast_to_follow_is_at_rest),
        cmocka_unit_test(edits_begin_and_end_motion),
        cmocka_unit_test(a_move_undoes_no_bounce),
        cmocka_unit_test(a_move_lets_a_body_go_on_that_was_too_fast_to_follow),
        cmocka_unit_test(a_body_that_its_leaf_refuses_is_told_where_it_stays),
        cmocka_unit_test(the_fastest_body_is_known_from_the_start),
        cmocka_unit_test(many_bodies_move_as_one_by_one),
        cmocka_unit_test(a_reflected_body_stays_in_the_world_to_the_last_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
