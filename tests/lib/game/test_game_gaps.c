/* SPDX-License-Identifier: MIT */
/* test_game_gaps.c - ticks of which nothing is known: nothing is played in them, and their numbers stay theirs. */
#include "fixture.h"

#include <string.h>

#include "game_fixture.h"

static const octree_game_body bodies[] = {{.id = 1, .position = {1, 2, 3}}, {.id = 2, .position = {-5, 0, 5}}};
static const octree_query asked = {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST};
static const octree_edit edits[] = {{.tick = 1, .kind = OCTREE_EDIT_MOVE, .body = {.id = 1, .position = {4, 4, 4}}},
                                    {.tick = 4, .kind = OCTREE_EDIT_REMOVE, .body = {.id = 2}}};

static octree_session session_with(const octree_gap *gaps, size_t count)
{
    octree_session session = small_session(bodies, 2);
    session.keys = "wwwww";
    session.edits = edits;
    session.edit_count = 2;
    session.queries = &asked;
    session.query_count = 1;
    session.gaps = gaps;
    session.gap_count = count;
    return session;
}

static void nothing_is_played_in_a_gap_and_the_next_tick_has_its_own_number(void **state)
{
    (void)state;
    const octree_gap gaps[] = {{2, "two points have one id"}, {3, "the queue is full"}};
    const octree_session session = session_with(gaps, 2);
    const double known_steps[] = {0, 1, 1, 1, 2, 3};
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    for (uint64_t number = 0; number <= 5; number++) {
        const bool gap = number == 2 || number == 3;
        assert_int_equal(tick->number, number);
        assert_int_equal(tick->answer_count, !gap);
        assert_true(octree_session_gap(&session, number) == (gap ? &gaps[number - 2] : NULL));
        assert_true(tick->player[1] == known_steps[number]);
        if (gap)
            assert_string_equal(tick->gap, gaps[number - 2].why);
        else
            assert_null(tick->gap);
        if (gap)
            assert_true(tick->events == 0 && tick->visit_count == 0 && tick->shape_count == 0);
        assert_int_equal(octree_count(octree_game_tree(game)), number < 4 ? 3 : 2);
        if (number < 5)
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    octree_game_destroy(game);
}

/* A body with a velocity stays where it was, and moves on after the gap as if there had been none. */
static void movers_are_listed_in_a_gap_where_they_were(void **state)
{
    (void)state;
    const octree_gap gap = {2, "the queue is full"};
    const octree_game_body mover = {.id = 1, .velocity = {1, 0, 0}};
    octree_session session = small_session(&mover, 1);
    session.ticks = 3;
    session.gaps = &gap;
    session.gap_count = 1;
    octree_game *game = start_game(&session);
    const double known[] = {0, 1, 1, 3};
    for (uint64_t number = 0; number <= 3; number++) {
        const octree_tick *tick = octree_game_tick(game);
        assert_int_equal(tick->mover_count, 1);
        assert_true(tick->movers[0].position[0] == known[number] && tick->movers[0].velocity[0] == 1);
        if (number < 3)
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    octree_game_destroy(game);
}

static void tick_0_may_be_a_gap(void **state)
{
    (void)state;
    const octree_gap first = {0, "a query has a NaN"};
    const octree_session session = session_with(&first, 1);
    octree_game *game = start_game(&session);
    assert_string_equal(octree_game_tick(game)->gap, first.why);
    assert_int_equal(octree_game_tick(game)->answer_count, 0);
    assert_int_equal(octree_count(octree_game_tree(game)), 3);
    assert_null(play_key(game, 'w')->gap);
    octree_game_destroy(game);
}

static void bodies_have_their_extents_in_a_gap_at_tick_0(void **state)
{
    (void)state;
    const octree_gap first = {0, "a query has a NaN"};
    const octree_game_body large = {.id = 1, .half = {5, 5, 5}};
    const octree_query range = {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{4, 4, 4}, {6, 6, 6}}};
    octree_session session = small_session(&large, 1);
    session.gaps = &first;
    session.gap_count = 1;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_ask(game, &range, 1), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->answers[0].count, 1);
    octree_game_destroy(game);
}

static void a_gap_is_given_as_it_comes_too(void **state)
{
    (void)state;
    const octree_session session = session_with(NULL, 0);
    octree_game *game = start_game(&session);
    octree_gap gap = {77, "not known"};
    const octree_input nothing = {.gap = &gap, .edits = edits, .edit_count = 1};
    assert_int_equal(octree_game_play(game, &nothing), OCTREE_OK);
    memset(gap.why, 'x', sizeof gap.why); /* it is not needed afterwards */
    assert_string_equal(octree_game_tick(game)->gap, "not known");
    uint64_t id;
    assert_int_equal(octree_find(octree_game_tree(game), bodies[0].position, &id), OCTREE_OK);
    assert_int_equal(octree_game_play(game, &nothing), OCTREE_BAD_TEXT);
    octree_game_destroy(game);
}

static void assert_refused(const octree_gap *gaps, size_t count, octree_status why)
{
    const octree_session session = session_with(gaps, count);
    octree_game *game = NULL;
    assert_int_equal(octree_game_create(&session, &game), why);
    assert_null(game);
}

static void gaps_out_of_order_and_without_a_text_are_refused(void **state)
{
    (void)state;
    const octree_gap disorder[] = {{3, "late"}, {2, "early"}}, twice[] = {{2, "one"}, {2, "two"}}, mute = {2, ""},
                     bell = {2, "\a"};
    assert_refused(disorder, 2, OCTREE_BAD_ORDER);
    assert_refused(twice, 2, OCTREE_BAD_ORDER);
    assert_refused(&mute, 1, OCTREE_BAD_TEXT);
    assert_refused(&bell, 1, OCTREE_BAD_TEXT);
    assert_refused(NULL, 1, OCTREE_NULL_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_played_in_a_gap_and_the_next_tick_has_its_own_number),
        cmocka_unit_test(movers_are_listed_in_a_gap_where_they_were),
        cmocka_unit_test(tick_0_may_be_a_gap),
        cmocka_unit_test(bodies_have_their_extents_in_a_gap_at_tick_0),
        cmocka_unit_test(a_gap_is_given_as_it_comes_too),
        cmocka_unit_test(gaps_out_of_order_and_without_a_text_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
