/* SPDX-License-Identifier: MIT */
/* test_game_ask.c - questions about a tick that has been played: they are answered as though its session asked them. */
#include "fixture.h"
#include "game_fixture.h"

#include <string.h>

enum { TICKS = 40 };

static const octree_query asked[] = {
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-300, -300, -300}, {900, 900, 900}}},
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .target = {700, 700, 700}, .k = 4},
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 400},
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .at_player = true},
};

enum { ASKED = sizeof asked / sizeof asked[0] };

static octree_game *play(const octree_session *session)
{
    octree_game *game;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    return game;
}

static void assert_same_answer(const octree_answer *a, const octree_answer *b)
{
    assert_true(a->kind == b->kind && a->count == b->count && a->by_key == b->by_key);
    assert_memory_equal(&a->cost, &b->cost, sizeof a->cost);
    for (size_t i = 0; i < a->count; i++)
        assert_int_equal(a->points ? a->points[i].id : a->neighbors[i].point.id,
                         b->points ? b->points[i].id : b->neighbors[i].point.id);
}

static void assert_same_tick(const octree_tick *a, const octree_tick *b)
{
    assert_true(a->number == b->number && a->events == b->events && a->tree_digest == b->tree_digest);
    assert_int_equal(a->answer_count, b->answer_count);
    for (size_t i = 0; i < a->answer_count; i++)
        assert_same_answer(&a->answers[i], &b->answers[i]);
    assert_memory_equal(a->touched, b->touched, sizeof a->touched);
    assert_true(a->visit_count == b->visit_count && a->hit_leaf_count == b->hit_leaf_count);
    for (size_t i = 0; i < a->visit_count; i++)
        assert_true(a->visits[i].node == b->visits[i].node && a->visits[i].touch == b->visits[i].touch &&
                    a->visits[i].taken == b->visits[i].taken);
    assert_memory_equal(a->hit_leaves, b->hit_leaves, a->hit_leaf_count * sizeof *a->hit_leaves);
}

/* One by one or all at once, at ticks with hits and answers of their own. */
static void a_tick_that_is_asked_is_that_of_a_session_that_asks(void **state)
{
    (void)state;
    const octree_session quiet = octree_session_default();
    octree_session asking = quiet;
    asking.queries = asked;
    asking.query_count = ASKED;
    octree_session silent = quiet;
    silent.query_count = 0;
    octree_game *later = play(&silent), *there = play(&asking);
    for (int tick = 0; tick < TICKS; tick++) {
        if (tick % 2) {
            assert_int_equal(octree_game_ask(later, asked, ASKED), OCTREE_OK);
        } else {
            for (size_t i = 0; i < ASKED; i++)
                assert_int_equal(octree_game_ask(later, &asked[i], 1), OCTREE_OK);
        }
        assert_same_tick(octree_game_tick(later), octree_game_tick(there));
        assert_int_equal(octree_game_advance(later), OCTREE_OK);
        assert_int_equal(octree_game_advance(there), OCTREE_OK);
    }
    octree_game_destroy(later);
    octree_game_destroy(there);
}

static void what_cannot_be_asked_leaves_the_tick_as_it_was(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    const octree_query bad[] = {asked[0], {.kind = OCTREE_QUERY_RADIUS, .radius = -1}};
    octree_game *game = play(&session), *other = play(&session);
    assert_int_equal(octree_game_ask(NULL, asked, 1), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_ask(game, NULL, 1), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_ask(game, bad, 2), OCTREE_BAD_SIZE);
    assert_int_equal(octree_game_ask(game, NULL, 0), OCTREE_OK);
    assert_same_tick(octree_game_tick(game), octree_game_tick(other));
    octree_game_destroy(game);
    octree_game_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tick_that_is_asked_is_that_of_a_session_that_asks),
        cmocka_unit_test(what_cannot_be_asked_leaves_the_tick_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
