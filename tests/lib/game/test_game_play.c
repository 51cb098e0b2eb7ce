/* SPDX-License-Identifier: MIT */
/* test_game_play.c - ticks whose edits and queries were not in the session: the same as in a session that has them. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "game_fixture.h"
#include "random_session.h"

static bool same_points(const octree_point *a, size_t a_count, const octree_point *b, size_t b_count)
{
    return a_count == b_count && (a_count == 0 || memcmp(a, b, a_count * sizeof *a) == 0);
}

static void assert_same_answers(const octree_tick *a, const octree_tick *b)
{
    assert_int_equal(a->answer_count, b->answer_count);
    for (size_t i = 0; i < a->answer_count; i++) {
        const octree_answer *left = &a->answers[i], *right = &b->answers[i];
        assert_true(left->kind == right->kind && left->by_key == right->by_key);
        assert_memory_equal(&left->cost, &right->cost, sizeof left->cost);
        if (left->points || right->points)
            assert_true(same_points(left->points, left->count, right->points, right->count));
        assert_int_equal(left->count, right->count);
        for (size_t n = 0; left->neighbors && n < left->count; n++)
            assert_memory_equal(&left->neighbors[n], &right->neighbors[n], sizeof left->neighbors[n]);
    }
}

static void assert_same_tick(const octree_game *left, const octree_game *right)
{
    const octree_tick *a = octree_game_tick(left), *b = octree_game_tick(right);
    assert_true(a->number == b->number && a->key == b->key && a->events == b->events);
    assert_memory_equal(a->player, b->player, sizeof a->player);
    assert_memory_equal(a->attempt, b->attempt, sizeof a->attempt);
    assert_true(same_points(a->hits, a->hit_count, b->hits, b->hit_count));
    assert_int_equal(a->refusal_count, b->refusal_count);
    for (size_t i = 0; i < a->refusal_count; i++)
        assert_true(a->refusals[i].id == b->refusals[i].id && a->refusals[i].why == b->refusals[i].why);
    assert_int_equal(a->visit_count, b->visit_count);
    assert_same_answers(a, b);
    assert_true(octree_digest(octree_game_tree(left)) == octree_digest(octree_game_tree(right)));
}

/* What a session has for a tick. */
static octree_input input_of(const octree_session *session, uint64_t tick)
{
    octree_input input = {.key = tick <= strlen(session->keys) ? session->keys[tick - 1] : '.'};
    for (size_t i = 0; i < session->edit_count; i++) {
        if (session->edits[i].tick != tick)
            continue;
        input.edits = input.edit_count++ ? input.edits : &session->edits[i];
    }
    for (size_t i = 0; i < session->query_count; i++) {
        if (session->queries[i].tick != tick)
            continue;
        input.queries = input.query_count++ ? input.queries : &session->queries[i];
    }
    return input;
}

/* The session as it is known at tick 0: what is asked then, and at every tick. */
static octree_session known_at_start(const octree_session *session, octree_query queries[RANDOM_SESSION_QUERIES])
{
    octree_session known = *session;
    known.edit_count = known.query_count = 0;
    known.edits = NULL;
    known.keys = NULL;
    known.queries = queries;
    for (size_t i = 0; i < session->query_count; i++)
        if (session->queries[i].tick == 0 || session->queries[i].tick == OCTREE_EVERY_TICK)
            queries[known.query_count++] = session->queries[i];
    return known;
}

static void a_tick_that_is_given_is_that_of_a_session_that_has_it(void **state)
{
    (void)state;
    static random_session made;
    static octree_query queries[RANDOM_SESSION_QUERIES];
    for (uint64_t seed = 0; seed < 40; seed++) {
        random_session_mixed(&made, seed);
        const octree_session known = known_at_start(&made.session, queries);
        octree_game *whole = start_game(&made.session), *live = start_game(&known);
        assert_same_tick(whole, live);
        while (!octree_game_over(whole)) {
            const octree_input input = input_of(&made.session, octree_game_tick(whole)->number + 1);
            assert_int_equal(octree_game_advance(whole), OCTREE_OK);
            assert_int_equal(octree_game_play(live, &input), OCTREE_OK);
            assert_same_tick(whole, live);
        }
        octree_game_destroy(whole);
        octree_game_destroy(live);
    }
}

static void what_is_given_comes_in_place_of_what_the_session_has(void **state)
{
    (void)state;
    static const octree_edit edits[] = {{1, OCTREE_EDIT_INSERT, {.id = 1, .position = {1, 1, 1}}},
                                        {2, OCTREE_EDIT_INSERT, {.id = 2, .position = {2, 2, 2}}}};
    static const octree_query queries[] = {{.tick = 1, .kind = OCTREE_QUERY_NEAREST},
                                           {.tick = 2, .kind = OCTREE_QUERY_KNEAREST, .k = 1},
                                           {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .radius = 1}};
    octree_session session = small_session(NULL, 0);
    session.edits = edits;
    session.edit_count = 2;
    session.queries = queries;
    session.query_count = 3;
    session.ticks = 2;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_play(game, &(octree_input){.key = '.'}), OCTREE_OK);
    assert_int_equal(octree_count(octree_game_tree(game)), 1);
    assert_int_equal(octree_game_tick(game)->answer_count, 1);
    assert_int_equal(octree_game_advance(game), OCTREE_OK);
    assert_int_equal(octree_count(octree_game_tree(game)), 2);
    assert_int_equal(octree_game_tick(game)->answer_count, 2);
    octree_game_destroy(game);
}

static void bad_input_plays_no_tick(void **state)
{
    (void)state;
    static const octree_edit edit = {.kind = (octree_edit_kind)9};
    static const octree_query nan = {.kind = OCTREE_QUERY_NEAREST, .target = {0, INFINITY, 0}},
                              negative = {.kind = OCTREE_QUERY_RADIUS, .radius = -1},
                              twisted = {.kind = OCTREE_QUERY_RANGE, .box = {{1, 0, 0}, {0, 0, 0}}},
                              unknown = {.kind = OCTREE_QUERY_KINDS};
    const struct {
        octree_input input;
        octree_status why;
    } rows[] = {
        {{.key = 'x'}, OCTREE_BAD_KEY},
        {{.key = '.', .edits = &edit, .edit_count = 1}, OCTREE_BAD_OPTION},
        {{.key = '.', .queries = &nan, .query_count = 1}, OCTREE_NOT_FINITE},
        {{.key = '.', .queries = &negative, .query_count = 1}, OCTREE_BAD_SIZE},
        {{.key = '.', .queries = &twisted, .query_count = 1}, OCTREE_BAD_RANGE},
        {{.key = '.', .queries = &unknown, .query_count = 1}, OCTREE_BAD_OPTION},
        {{.key = '.', .edit_count = 1}, OCTREE_NULL_ARGUMENT},
        {{.key = '.', .query_count = 1}, OCTREE_NULL_ARGUMENT},
    };
    const octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(octree_game_play(game, &rows[i].input), rows[i].why);
        assert_int_equal(octree_game_tick(game)->number, 0);
    }
    assert_int_equal(octree_game_play(NULL, &rows[0].input), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_play(game, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_play(game, &(octree_input){.key = 'd'}), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->number, 1);
    octree_game_destroy(game);
}

static void no_key_waits(void **state)
{
    (void)state;
    const octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_play(game, &(octree_input){0}), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->number, 1);
    assert_int_equal(octree_game_tick(game)->key, '.');
    assert_int_equal(octree_game_tick(game)->events, 0);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tick_that_is_given_is_that_of_a_session_that_has_it),
        cmocka_unit_test(what_is_given_comes_in_place_of_what_the_session_has),
        cmocka_unit_test(bad_input_plays_no_tick),
        cmocka_unit_test(no_key_waits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
