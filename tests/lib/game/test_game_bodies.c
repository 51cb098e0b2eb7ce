/* SPDX-License-Identifier: MIT */
/* test_game_bodies.c - bodies that move, edits, queries, and the order of all these within a tick. */
#include "fixture.h"

#include <math.h>

#include "game_fixture.h"

static bool body_is_at(const octree_game *game, uint64_t id, double x, double y, double z)
{
    return octree_contains(octree_game_tree(game), (double[3]){x, y, z}, id);
}

static void a_body_moves_by_its_velocity_every_tick_from_tick_one(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 1, .position = {5, 5, 5}, .velocity = {0.5, -1, 0.25}}};
    octree_session session = small_session(body, 1);
    octree_game *game = start_game(&session);
    assert_true(body_is_at(game, 1, 5, 5, 5));
    for (int i = 1; i <= 9; i++) {
        play_key(game, '.');
        assert_true(body_is_at(game, 1, 5 + 0.5 * i, 5.0 - i, 5 + 0.25 * i));
    }
    octree_game_destroy(game);
}

static void a_body_that_meets_the_bounds_is_reflected(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 4, 4}, .velocity = {2, 0, 0}},
                                              {.id = 2, .position = {-4, -9.5, 4}, .velocity = {0, -1, 0}},
                                              {.id = 3, .position = {4, 4, 9}, .velocity = {0, 0, 1}}};
    octree_session session = small_session(bodies, 3);
    octree_game *game = start_game(&session);
    static const double first[] = {9, 7, 5, 3, 1}, second[] = {-9.5, -8.5, -7.5, -6.5, -5.5},
                        third[] = {10, 9, 8, 7, 6};
    for (int i = 0; i < 5; i++) {
        play_key(game, '.');
        assert_true(body_is_at(game, 1, first[i], 4, 4));
        assert_true(body_is_at(game, 2, -4, second[i], 4));
        assert_true(body_is_at(game, 3, 4, 4, third[i])); /* on the face itself for a tick */
    }
    octree_game_destroy(game);
}

static void a_body_of_any_speed_stays_in_the_world(void **state)
{
    (void)state;
    static const double speeds[] = {19.5, 20, 40, 41, 123.25, 1e6, 1e17, 1e300, 1.7e308};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        octree_game_body body[] = {{.id = 1, .position = {5, -5, 9}, .velocity = {speeds[i], -speeds[i], 0.5}}};
        octree_session session = small_session(body, 1);
        octree_game *game = start_game(&session);
        octree_box world = cube(-10, 10);
        for (int tick = 0; tick < 100; tick++) {
            assert_int_equal(play_key(game, '.')->refusal_count, 0);
            size_t count = 0;
            assert_int_equal(octree_range_count(octree_game_tree(game), &world, &count), OCTREE_OK);
            assert_int_equal(count, 2);
        }
        octree_game_destroy(game);
    }
}

static void a_body_that_its_leaf_refuses_stays_and_is_told(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 9, 9}},
                                              {.id = 2, .position = {9, 9, 8}},
                                              {.id = 3, .position = {-1, 9, 9}, .velocity = {2, 0, 0}}};
    octree_session session = small_session(bodies, 3);
    session.tree.max_depth = 1;
    session.player.position[2] = -5;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_int_equal(tick->events & OCTREE_EVENT_FULL, OCTREE_EVENT_FULL);
    assert_int_equal(tick->refusal_count, 1);
    assert_int_equal(tick->refusals[0].id, 3);
    assert_int_equal(tick->refusals[0].why, OCTREE_FULL);
    assert_true(tick->refusals[0].position[0] == 1);
    assert_true(body_is_at(game, 3, -1, 9, 9));
    octree_game_destroy(game);
}

static octree_walk_order find_minus_zero(const octree_node *node, void *context)
{
    size_t *found = context;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        *found += node->points[i].id == 1 && signbit(node->points[i].position[0]);
    return OCTREE_WALK_ON;
}

static void a_body_at_rest_keeps_its_bits_while_others_move(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {-0.0, 5, 0}},
                                              {.id = 2, .position = {5, 5, 5}, .velocity = {1, 0, 0}}};
    octree_session session = small_session(bodies, 2);
    octree_game *game = start_game(&session);
    size_t found = 0;
    play_key(game, '.');
    assert_int_equal(octree_walk(octree_game_tree(game), find_minus_zero, &found), OCTREE_OK);
    assert_int_equal(found, 1);
    octree_game_destroy(game);
}

static void a_waiting_player_is_hit_and_nothing_is_taken_back(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 1, .position = {3, 0, 0}, .velocity = {-1, 0, 0}}};
    octree_session session = small_session(body, 1);
    octree_game *game = start_game(&session);
    static const unsigned hits[] = {0, 0, 1, 0}; /* at 2, 1, 0, -1 */
    for (int i = 0; i < 4; i++) {
        const octree_tick *tick = play_key(game, '.');
        assert_int_equal(tick->hit_count, hits[i]);
        assert_true(((tick->events & OCTREE_EVENT_COLLIDED) != 0) == (hits[i] == 1));
        assert_true(body_is_at(game, 1, 2.0 - i, 0, 0));
        assert_true(body_is_at(game, 100, 0, 0, 0));
    }
    octree_game_destroy(game);
}

static void bodies_that_the_tree_refuses_are_refusals_of_tick_zero(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {11, 0, 0}},
                                              {.id = 2, .position = {NAN, 0, 0}},
                                              {.id = 3, .position = {5, 5, 5}},
                                              {.id = 4, .position = {5, 5, 5}},
                                              {.id = 5, .position = {5, 5, 5}},
                                              {.id = 6, .position = {-5, 5, 5}, .velocity = {NAN, 0, 0}},
                                              {.id = 7, .position = {-5, 5, 5}, .velocity = {0, 0, -INFINITY}}};
    static const octree_status why[] = {OCTREE_OUTSIDE, OCTREE_NOT_FINITE, OCTREE_FULL, OCTREE_NOT_FINITE,
                                        OCTREE_NOT_FINITE};
    static const uint64_t ids[] = {1, 2, 5, 6, 7};
    octree_session session = small_session(bodies, 7);
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->refusal_count, 5);
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(tick->refusals[i].why, why[i]);
        assert_int_equal(tick->refusals[i].id, ids[i]);
    }
    assert_int_equal(octree_count(octree_game_tree(game)), 3);
    octree_game_destroy(game);
}

static void edits_insert_remove_and_move_by_id(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}}};
    static const octree_edit edits[] = {
        {1, OCTREE_EDIT_INSERT, {.id = 7, .position = {-5, 5, 5}}},
        {2, OCTREE_EDIT_MOVE, {.id = 7, .position = {-5, -5, 5}, .velocity = {9, 9, 9}}}, /* not read */
        {2, OCTREE_EDIT_REMOVE, {.id = 1, .position = {NAN, NAN, NAN}}},                  /* not read */
        {5, OCTREE_EDIT_INSERT, {.id = 1, .position = {6, 6, 6}}},                        /* free again */
    };
    octree_session session = small_session(bodies, 1);
    session.edits = edits;
    session.edit_count = 4;
    octree_game *game = start_game(&session);
    play_key(game, '.');
    assert_true(body_is_at(game, 7, -5, 5, 5) && body_is_at(game, 1, 5, 5, 5));
    for (int tick = 2; tick <= 4; tick++) {
        play_key(game, '.');
        assert_true(body_is_at(game, 7, -5, -5, 5));
        assert_int_equal(octree_count(octree_game_tree(game)), 2);
    }
    assert_int_equal(play_key(game, '.')->refusal_count, 0);
    assert_true(body_is_at(game, 1, 6, 6, 6));
    octree_game_destroy(game);
}

static void an_edit_that_cannot_be_made_is_a_refusal(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}}};
    static const octree_edit edits[] = {
        {1, OCTREE_EDIT_INSERT, {.id = 1, .position = {-5, 5, 5}}},
        {1, OCTREE_EDIT_INSERT, {.id = 100, .position = {-5, 5, 5}}},
        {1, OCTREE_EDIT_INSERT, {.id = 8, .position = {0, 10.5, 0}}},
        {1, OCTREE_EDIT_INSERT, {.id = 8, .position = {0, NAN, 0}}},
        {1, OCTREE_EDIT_REMOVE, {.id = 9}},
        {1, OCTREE_EDIT_MOVE, {.id = 9, .position = {1, 1, 1}}},
        {1, OCTREE_EDIT_MOVE, {.id = 1, .position = {0, 0, -11}}},
        {1, OCTREE_EDIT_INSERT, {.id = 8, .position = {-5, 5, 5}, .velocity = {0, INFINITY, 0}}},
    };
    static const octree_status why[] = {OCTREE_DUPLICATE, OCTREE_DUPLICATE, OCTREE_OUTSIDE, OCTREE_NOT_FINITE,
                                        OCTREE_NOT_FOUND, OCTREE_NOT_FOUND, OCTREE_OUTSIDE, OCTREE_NOT_FINITE};
    octree_session session = small_session(bodies, 1);
    session.edits = edits;
    session.edit_count = 8;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_int_equal(tick->refusal_count, 8);
    assert_int_equal(tick->events, OCTREE_EVENT_REFUSED);
    for (size_t i = 0; i < 8; i++) {
        assert_int_equal(tick->refusals[i].why, why[i]);
        assert_int_equal(tick->refusals[i].id, edits[i].body.id);
        assert_memory_equal(tick->refusals[i].position, edits[i].body.position, sizeof edits[i].body.position);
    }
    for (size_t i = 0; i < 8; i++) { /* each is an event by itself */
        assert_int_equal(octree_game_play(game, &(octree_input){.edits = &edits[i], .edit_count = 1}), OCTREE_OK);
        assert_int_equal(octree_game_tick(game)->events, OCTREE_EVENT_REFUSED);
    }
    assert_int_equal(play_key(game, '.')->events, 0);
    assert_true(body_is_at(game, 1, 5, 5, 5) && body_is_at(game, 100, 0, 0, 0));
    assert_int_equal(octree_count(octree_game_tree(game)), 2);
    octree_game_destroy(game);
}

static void an_edit_cannot_take_the_player_away(void **state)
{
    (void)state;
    static const octree_edit edits[] = {{1, OCTREE_EDIT_REMOVE, {.id = 100}},
                                        {1, OCTREE_EDIT_MOVE, {.id = 100, .position = {5, 5, 5}}}};
    octree_session session = small_session(NULL, 0);
    session.edits = edits;
    session.edit_count = 2;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd');
    assert_int_equal(tick->refusal_count, 2);
    assert_true(body_is_at(game, 100, 1, 0, 0));
    octree_game_destroy(game);
}

static void edits_come_before_motion_and_motion_before_the_step(void **state)
{
    (void)state;
    /* Inserted two to the right and moving left: at the player's step it is one to the right, and hit. */
    static const octree_edit edits[] = {
        {1, OCTREE_EDIT_INSERT, {.id = 7, .position = {2, 0, 0}, .velocity = {-1, 0, 0}}}};
    octree_session session = small_session(NULL, 0);
    session.edits = edits;
    session.edit_count = 1;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd');
    assert_true(body_is_at(game, 7, 1, 0, 0));
    assert_int_equal(tick->events & OCTREE_EVENT_COLLIDED, OCTREE_EVENT_COLLIDED);
    assert_int_equal(tick->hit_count, 1);
    assert_true(tick->player[0] == 0);
    octree_game_destroy(game);
}

/* In one game in ascending order of their ids, which one call of the tree moves; in the other in pairs that descend. */
static void many_edits_that_move_do_the_same_at_once_as_one_by_one(void **state)
{
    (void)state;
    enum { BODIES = 600, EDITS = 640 };
    static octree_game_body bodies[BODIES];
    static octree_edit edits[2][EDITS];
    uint64_t random = 3;
    for (size_t i = 0; i < EDITS; i++) {
        octree_game_body *body = i < BODIES ? &bodies[i] : &(octree_game_body){.id = 0}, to = {.id = 1000 + i};
        for (int axis = 0; axis < 3; axis++) {
            body->position[axis] = random_between(&random, -10, 10);
            body->velocity[axis] = i % 3 ? random_between(&random, -1, 1) : 0;
            to.position[axis] = random_between(&random, -10, i % 50 == 9 ? 20 : 10);
        }
        body->id = 1000 + i;
        edits[0][i] = edits[1][i ^ 1] = (octree_edit){2, OCTREE_EDIT_MOVE, to};
    }
    octree_session sessions[2]; /* games point into them */
    octree_game *games[2];
    for (int g = 0; g < 2; g++) {
        sessions[g] = small_session(bodies, BODIES);
        sessions[g].tree = define(cube(-10, 10), 4, 21, OCTREE_GROW);
        sessions[g].edits = edits[g];
        sessions[g].edit_count = EDITS;
        games[g] = start_game(&sessions[g]);
        for (int tick = 1; tick <= 3; tick++)
            assert_int_equal(play_key(games[g], '.')->refusal_count > EDITS - BODIES, tick == 2);
    }
    for (size_t i = 0; i < BODIES; i++) {
        octree_point found[2];
        assert_true(octree_game_find(games[0], 1000 + i, &found[0]) && octree_game_find(games[1], 1000 + i, &found[1]));
        assert_memory_equal(&found[0], &found[1], sizeof found[0]);
        assert_true(octree_contains(octree_game_tree(games[0]), found[0].position, 1000 + i));
    }
    assert_true(octree_digest(octree_game_tree(games[0])) == octree_digest(octree_game_tree(games[1])));
    assert_int_equal(octree_game_tick(games[0])->stats.nodes, octree_game_tick(games[1])->stats.nodes);
    octree_game_destroy(games[0]);
    octree_game_destroy(games[1]);
}

static void an_edit_moves_a_body_and_keeps_its_velocity(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}, .velocity = {0, 0, 1}}};
    static const octree_edit edits[] = {{2, OCTREE_EDIT_MOVE, {.id = 1, .position = {-5, -5, -5}}}};
    octree_session session = small_session(bodies, 1);
    session.edits = edits;
    session.edit_count = 1;
    octree_game *game = start_game(&session);
    play_key(game, '.');
    assert_true(body_is_at(game, 1, 5, 5, 6));
    play_key(game, '.');
    assert_true(body_is_at(game, 1, -5, -5, -4));
    play_key(game, '.');
    assert_true(body_is_at(game, 1, -5, -5, -3));
    octree_game_destroy(game);
}

static void a_body_that_leaves_makes_room_for_a_step_in_the_same_tick(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {1, 0, 0}, .velocity = {0, 4, 0}}};
    octree_session session = small_session(bodies, 1);
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd');
    assert_int_equal(tick->events & OCTREE_EVENT_MOVED, OCTREE_EVENT_MOVED);
    assert_true(tick->player[0] == 1);
    octree_game_destroy(game);
}

static void queries_are_asked_at_their_ticks_after_the_step(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 4, .position = {3, 3, 3}}, {.id = 2, .position = {3, 2, 3}}};
    static const octree_query queries[] = {
        {.tick = 0, .kind = OCTREE_QUERY_RANGE, .box = {{3, 0, 3}, {3, 3, 3}}},
        {.tick = 1, .kind = OCTREE_QUERY_NEAREST, .target = {3, 3, 3.25}},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .at_player = true, .box = {{-1, 0, 0}, {2, 3, 3}}},
    };
    octree_session session = small_session(bodies, 2);
    session.queries = queries;
    session.query_count = 3;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->answer_count, 2);
    assert_int_equal(tick->answers[0].count, 2);
    assert_int_equal(tick->answers[0].points[0].id, 2); /* by id */
    assert_int_equal(tick->answers[0].points[1].id, 4);
    assert_int_equal(tick->answers[1].count, 1); /* the player itself is a point of the range */
    assert_int_equal(tick->answers[1].points[0].id, 100);
    tick = play_key(game, 'd');
    assert_int_equal(tick->answer_count, 2);
    assert_true(tick->answers[0].count == 1 && !tick->answers[0].by_key);
    assert_int_equal(tick->answers[0].neighbors[0].point.id, 4);
    assert_true(tick->answers[0].neighbors[0].distance == 0.25);
    assert_int_equal(tick->answers[1].count, 3); /* the box moved with the player */
    assert_true(tick->answers[1].box.min[0] == 0 && tick->answers[1].box.max[0] == 3);
    octree_game_destroy(game);
}

static void neighbours_come_by_distance_and_then_by_id_without_the_player(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 4, .position = {0, 2, 0}}, {.id = 3, .position = {3, 0, 0}},
                                              {.id = 7, .position = {0, 0, 2}}, {.id = 5, .position = {2, 0, 0}},
                                              {.id = 1, .position = {9, 9, 9}}, {.id = 200, .position = {0, 0, 0}}};
    static const octree_query queries[] = {{.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 5},
                                           {.kind = OCTREE_QUERY_KNEAREST, .target = {0, 0, 0}, .k = 2},
                                           {.kind = OCTREE_QUERY_KNEAREST, .target = {9, 9, 9}, .k = SIZE_MAX},
                                           {.kind = OCTREE_QUERY_KNEAREST, .target = {9, 9, 9}, .k = 0}};
    octree_session session = small_session(bodies, 6);
    session.queries = queries;
    session.query_count = 4;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    static const uint64_t ids[] = {200, 4, 5, 7, 3};
    static const double distances[] = {0, 2, 2, 2, 3};
    assert_int_equal(tick->answers[0].count, 5);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(tick->answers[0].neighbors[i].point.id, ids[i]);
        assert_true(tick->answers[0].neighbors[i].distance == distances[i]);
    }
    assert_int_equal(tick->answers[1].count, 2);
    assert_int_equal(tick->answers[1].neighbors[0].point.id, 100); /* the player is a neighbour of a place */
    assert_int_equal(tick->answers[1].neighbors[1].point.id, 200);
    assert_int_equal(tick->answers[2].count, 7); /* all there are */
    assert_true(tick->answers[2].k == SIZE_MAX);
    assert_int_equal(tick->answers[2].neighbors[0].point.id, 1);
    assert_int_equal(tick->answers[3].count, 0);
    octree_game_destroy(game);
}

static void a_ball_is_closed_and_goes_with_the_player(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {
        {.id = 4, .position = {0, 3, 4}}, {.id = 2, .position = {5, 0, 0}}, {.id = 9, .position = {6, 0, 0}}};
    static const octree_query queries[] = {
        {.tick = 0, .kind = OCTREE_QUERY_RADIUS, .target = {0, 3, 4}, .radius = 0},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 5},
    };
    octree_session session = small_session(bodies, 3);
    session.queries = queries;
    session.query_count = 2;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->answers[0].count, 1);
    assert_int_equal(tick->answers[0].points[0].id, 4);
    assert_int_equal(tick->answers[1].count, 3); /* by id; the player itself is a point of the ball */
    assert_true(tick->answers[1].points[0].id == 2 && tick->answers[1].points[1].id == 4);
    assert_int_equal(tick->answers[1].points[2].id, 100);
    tick = play_key(game, 'd');
    assert_int_equal(tick->answers[0].count, 3);
    assert_true(tick->answers[0].points[0].id == 2 && tick->answers[0].points[1].id == 9);
    assert_true(tick->answers[0].target[0] == 1 && tick->answers[0].radius == 5);
    octree_game_destroy(game);
}

static void n_names_the_nearest_neighbour_but_the_player(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 200, .position = {0, 4, 0}}, {.id = 2, .position = {0, -3, 0}}};
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .at_player = true}};
    octree_session session = small_session(bodies, 2);
    session.queries = queries;
    session.query_count = 1;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'n');
    assert_int_equal(tick->answer_count, 2);
    for (int i = 0; i < 2; i++) {
        const octree_answer *answer = &tick->answers[i];
        assert_true(answer->by_key == (i == 0)); /* n first */
        assert_int_equal(answer->kind, OCTREE_QUERY_NEAREST);
        assert_true(answer->count == 1 && answer->neighbors[0].point.id == 2 && answer->neighbors[0].distance == 3);
        assert_true(same_position(answer->target, tick->player));
    }
    octree_game_destroy(game);
    session.body_count = 0;
    game = start_game(&session);
    tick = play_key(game, 'n');
    assert_int_equal(tick->answers[0].count + tick->answers[1].count, 0); /* nobody but the player */
    octree_game_destroy(game);
}

static void a_body_at_the_player_is_its_nearest_neighbour(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {0, 0, 0}}, {.id = 2, .position = {0, 1, 0}}};
    octree_session session = small_session(bodies, 2);
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'n');
    assert_int_equal(tick->answers[0].neighbors[0].point.id, 1); /* unlike the paper, which asks for distance != 0 */
    assert_true(tick->answers[0].neighbors[0].distance == 0);
    octree_game_destroy(game);
}

static void a_thousand_ticks_of_waiting_cost_no_changes(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}}};
    octree_session session = small_session(bodies, 1);
    octree_game *game = start_game(&session);
    uint64_t version = octree_version(octree_game_tree(game));
    for (int i = 0; i < 1000; i++)
        play_key(game, '.');
    assert_true(octree_version(octree_game_tree(game)) == version);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_moves_by_its_velocity_every_tick_from_tick_one),
        cmocka_unit_test(a_body_that_meets_the_bounds_is_reflected),
        cmocka_unit_test(a_body_of_any_speed_stays_in_the_world),
        cmocka_unit_test(a_body_that_its_leaf_refuses_stays_and_is_told),
        cmocka_unit_test(a_body_at_rest_keeps_its_bits_while_others_move),
        cmocka_unit_test(a_waiting_player_is_hit_and_nothing_is_taken_back),
        cmocka_unit_test(bodies_that_the_tree_refuses_are_refusals_of_tick_zero),
        cmocka_unit_test(edits_insert_remove_and_move_by_id),
        cmocka_unit_test(an_edit_that_cannot_be_made_is_a_refusal),
        cmocka_unit_test(an_edit_cannot_take_the_player_away),
        cmocka_unit_test(edits_come_before_motion_and_motion_before_the_step),
        cmocka_unit_test(many_edits_that_move_do_the_same_at_once_as_one_by_one),
        cmocka_unit_test(an_edit_moves_a_body_and_keeps_its_velocity),
        cmocka_unit_test(a_body_that_leaves_makes_room_for_a_step_in_the_same_tick),
        cmocka_unit_test(queries_are_asked_at_their_ticks_after_the_step),
        cmocka_unit_test(neighbours_come_by_distance_and_then_by_id_without_the_player),
        cmocka_unit_test(a_ball_is_closed_and_goes_with_the_player),
        cmocka_unit_test(n_names_the_nearest_neighbour_but_the_player),
        cmocka_unit_test(a_body_at_the_player_is_its_nearest_neighbour),
        cmocka_unit_test(a_thousand_ticks_of_waiting_cost_no_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
