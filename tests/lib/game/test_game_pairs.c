/* SPDX-License-Identifier: MIT */
/* test_game_pairs.c - the pairs of a foreign index, judged in a game: each kind of error by itself, and random pairs
 * against brute force. */
#include "fixture.h"
#include "game_fixture.h"

#include <string.h>

#define PLAYER 100

/* 1 and 2 overlap, 2 and 3 touch in a corner, 4 is inside 3, and 5 is far from all. */
static const octree_game_body few[] = {{.id = 1, .position = {-3, 0, 0}, .half = {1, 1, 1}},
                                       {.id = 2, .position = {-1.5, 0, 0}, .half = {1, 1, 1}},
                                       {.id = 3, .position = {1.5, 3, -3}, .half = {2, 2, 2}},
                                       {.id = 4, .position = {2, 3, -3}},
                                       {.id = 5, .position = {-8, -8, -8}, .half = {0, 1, 0}}};

#define PAIRS(...) (const octree_pair[]){__VA_ARGS__}, sizeof((const octree_pair[]){__VA_ARGS__}) / sizeof(octree_pair)

static octree_session session_of(const octree_foreign_pairs *lists, size_t count)
{
    octree_session session = small_session(few, sizeof few / sizeof *few);
    session.tree.full_leaf = OCTREE_GROW;
    session.player.id = PLAYER;
    session.player.position[2] = 9;
    session.ticks = 4;
    session.foreign_pairs = lists;
    session.foreign_pairs_count = count;
    return session;
}

/* The game of the last judgement, whose arrays are valid until the next one. */
static octree_game *last_game;

static const octree_pair_judgement *judge(const octree_pair *pairs, size_t count)
{
    static octree_foreign_pairs list;
    static octree_session session;
    octree_game_destroy(last_game);
    list = (octree_foreign_pairs){.pairs = pairs, .pair_count = count};
    session = session_of(&list, 1);
    last_game = start_game(&session);
    const octree_tick *tick = octree_game_tick(last_game);
    assert_true(tick->judged && tick->foreign_pairs.judged && tick->foreign_pairs.given_count == count);
    assert_int_equal((tick->events & OCTREE_EVENT_WRONG) != 0, tick->foreign_pairs.wrong != OCTREE_WRONG_NONE);
    assert_false(tick->pair_count || tick->events & OCTREE_EVENT_OVERLAPPED);
    return &tick->foreign_pairs;
}

static void assert_list(const octree_pair *list, size_t count, const octree_pair *expected, size_t expected_count)
{
    assert_int_equal(count, expected_count);
    for (size_t i = 0; i < count; i++)
        assert_true(list[i].a == expected[i].a && list[i].b == expected[i].b);
}

static void right_pairs_are_right_in_any_order(void **state)
{
    (void)state;
    const octree_pair_judgement *made = judge(PAIRS({4, 3}, {2, 3}, {1, 2}));
    assert_true(made->wrong == OCTREE_WRONG_NONE && made->expected == 3);
    assert_false(made->missing_count || made->extra_count || made->wrong_pair.a || made->wrong_pair.b);
    assert_list(made->given, made->given_count, PAIRS({1, 2}, {2, 3}, {3, 4}));
}

static void boxes_that_touch_overlap(void **state)
{
    (void)state;
    const octree_pair_judgement *made = judge(PAIRS({1, 2}, {3, 4}));
    assert_int_equal(made->wrong, OCTREE_WRONG_MISSING);
    assert_list(made->missing, made->missing_count, PAIRS({2, 3}));
}

static void every_error_has_its_kind(void **state)
{
    (void)state;
    const octree_pair_judgement *made = judge(NULL, 0);
    assert_true(made->wrong == OCTREE_WRONG_MISSING && made->missing_count == 3 && made->extra_count == 0);
    made = judge(PAIRS({1, 2}, {5, 1}, {2, 3}, {3, 4}, {4, 1}));
    assert_true(made->wrong == OCTREE_WRONG_EXTRA && made->missing_count == 0);
    assert_list(made->extra, made->extra_count, PAIRS({1, 4}, {1, 5}));
    made = judge(PAIRS({3, 4}, {1, 2}, {4, 3}, {2, 1}, {2, 3}));
    assert_true(made->wrong == OCTREE_WRONG_DUPLICATE && made->wrong_pair.a == 1 && made->wrong_pair.b == 2);
    assert_false(made->missing_count || made->extra_count);
    made = judge(PAIRS({1, 2}, {2, 3}, {3, 4}, {5, 77}, {9, 1}));
    assert_true(made->wrong == OCTREE_WRONG_UNKNOWN && made->wrong_pair.a == 9 && made->wrong_pair.b == 1);
    assert_int_equal(made->extra_count, 0);
}

/* An error is reported by the lowest kind, with all missing and extra pairs. An extra pair that is given three times is
 * listed once. */
static void lowest_of_several_errors_is_reported(void **state)
{
    (void)state;
    const octree_pair_judgement *made = judge(PAIRS({1, 5}, {5, 1}, {1, 2}, {1, 5}));
    assert_true(made->wrong == OCTREE_WRONG_DUPLICATE && made->missing_count == 2);
    assert_list(made->extra, made->extra_count, PAIRS({1, 5}));
    made = judge(PAIRS({6, 7}, {7, 6}, {1, 5}));
    assert_true(made->wrong == OCTREE_WRONG_UNKNOWN && made->wrong_pair.a == 6 && made->wrong_pair.b == 7);
    assert_true(made->missing_count == 3 && made->extra_count == 1);
}

/* Keys move a player that is no body, but a player that is a body is in pairs. */
static void player_that_keys_move_is_unknown(void **state)
{
    (void)state;
    const octree_pair_judgement *made = judge(PAIRS({PLAYER, 1}, {1, 2}, {2, 3}, {3, 4}));
    assert_true(made->wrong == OCTREE_WRONG_UNKNOWN && made->wrong_pair.a == PLAYER && made->wrong_pair.b == 1);
    const octree_foreign_pairs list = {.pairs = PAIRS({1, 2}, {2, 3}, {3, 4})};
    octree_session session = session_of(&list, 1);
    session.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = 1};
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->foreign_pairs.wrong, OCTREE_WRONG_NONE);
    octree_game_destroy(game);
}

/* Only the ticks with a list are judged. The list of exact pairs is shown only if the session wants it. */
static void ticks_with_a_list_are_judged(void **state)
{
    (void)state;
    const octree_pair right[] = {{1, 2}, {2, 3}, {3, 4}};
    const octree_gap gap = {.tick = 3, .why = "lost"};
    const octree_foreign_pairs lists[] = {{.tick = 1}, {.tick = 2, .pairs = right, .pair_count = 3}, {.tick = 3}};
    for (int shown = 0; shown < 2; shown++) {
        octree_session session = session_of(lists, 3);
        session.pairs = shown;
        session.gaps = &gap;
        session.gap_count = 1;
        octree_game *game = start_game(&session);
        for (uint64_t i = 0; i < 5; i++) {
            const octree_tick *tick = octree_game_tick(game);
            assert_int_equal(tick->foreign_pairs.judged, i == 1 || i == 2);
            assert_int_equal(tick->foreign_pairs.wrong, i == 1 ? OCTREE_WRONG_MISSING : OCTREE_WRONG_NONE);
            assert_int_equal(tick->pair_count, shown && i != 3 ? 3 : 0);
            assert_int_equal(tick->judged, i > 0);
            assert_int_equal(tick->events,
                             (i == 1 ? OCTREE_EVENT_WRONG : 0u) | (shown && i != 3 ? OCTREE_EVENT_OVERLAPPED : 0u));
            if (i < 4)
                play_key(game, '.');
        }
        octree_game_destroy(game);
    }
}

/* The input of a tick is not needed after the call, and more queries do not change the judgement. */
static void judgement_survives_its_input_and_further_queries(void **state)
{
    (void)state;
    octree_pair pairs[] = {{1, 2}, {5, 4}};
    const octree_foreign_pairs list = {.pairs = pairs, .pair_count = 2};
    const octree_query query = {.kind = OCTREE_QUERY_RADIUS, .radius = 30, .answered = true};
    const octree_session session = session_of(NULL, 0);
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_play(game, &(octree_input){.foreign_pairs = &list}), OCTREE_OK);
    memset(pairs, 0, sizeof pairs);
    assert_int_equal(octree_game_ask(game, &query, 1), OCTREE_OK);
    const octree_pair_judgement *made = &octree_game_tick(game)->foreign_pairs;
    assert_list(made->given, made->given_count, PAIRS({1, 2}, {4, 5}));
    assert_list(made->missing, made->missing_count, PAIRS({2, 3}, {3, 4}));
    assert_list(made->extra, made->extra_count, PAIRS({4, 5}));
    octree_game_destroy(game);
}

static void assert_refused(const octree_foreign_pairs *lists, size_t count, octree_status why)
{
    const octree_session session = session_of(lists, count);
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), why);
    assert_null(game);
    if (lists && count == 1)
        assert_int_equal(octree_input_check(&(octree_input){.foreign_pairs = lists}), why);
}

static void invalid_pairs_are_refused(void **state)
{
    (void)state;
    assert_refused(&(octree_foreign_pairs){.pairs = PAIRS({1, 2}, {3, 3})}, 1, OCTREE_BAD_PAIR);
    assert_refused(&(octree_foreign_pairs){.pair_count = 1}, 1, OCTREE_NULL_ARGUMENT);
    assert_refused((octree_foreign_pairs[]){{.tick = 2}, {.tick = 2}}, 2, OCTREE_BAD_ORDER);
    assert_refused((octree_foreign_pairs[]){{.tick = 2}, {.tick = 1}}, 2, OCTREE_BAD_ORDER);
    assert_refused(NULL, 1, OCTREE_NULL_ARGUMENT);
}

/* ---- Random pairs ------------------------------------------------------------------------------------------ */

/* Ids 1 to BODIES are bodies; ids up to IDS are unknown, and one of them is the player's. */
enum { BODIES = 24, IDS = 28 };

/* given[a][b]: how often the pair is given, for a < b; overlaps[a][b]: whether the boxes overlap. */
typedef struct pair_matrix {
    int given[IDS + 1][IDS + 1];
    bool overlaps[IDS + 1][IDS + 1];
} pair_matrix;

static bool is_known(uint64_t id)
{
    return id <= BODIES;
}

/* Give each pair that overlaps with a probability of 7 in 8, and some others, some of them repeatedly. */
static size_t draw_pairs(pair_matrix *m, octree_pair *pairs, uint64_t *seed)
{
    size_t count = 0;
    for (uint64_t a = 1; a <= IDS; a++)
        for (uint64_t b = a + 1; b <= IDS; b++) {
            const uint64_t drawn = random_below(seed, 64);
            m->given[a][b] = m->overlaps[a][b] ? drawn >= 8 : drawn == 0;
            m->given[a][b] *= random_below(seed, 32) == 0 ? 2 : 1;
            for (int i = 0; i < m->given[a][b]; i++)
                pairs[count++] = random_below(seed, 2) ? (octree_pair){a, b} : (octree_pair){b, a};
        }
    for (size_t i = count; i-- > 1;) {
        const size_t j = random_below(seed, i + 1);
        const octree_pair moved = pairs[i];
        pairs[i] = pairs[j];
        pairs[j] = moved;
    }
    return count;
}

static octree_wrong_kind judge_by_brute_force(const pair_matrix *m, const octree_pair_judgement *made)
{
    size_t missing = 0, extra = 0, expected = 0;
    bool unknown = false, duplicate = false;
    for (uint64_t a = 1; a <= IDS; a++)
        for (uint64_t b = a + 1; b <= IDS; b++) {
            const bool known = is_known(a) && is_known(b);
            expected += m->overlaps[a][b];
            unknown |= m->given[a][b] && !known;
            duplicate |= m->given[a][b] > 1;
            if (m->overlaps[a][b] && !m->given[a][b]) {
                assert_true(made->missing[missing].a == a && made->missing[missing].b == b);
                missing++;
            }
            if (m->given[a][b] && known && !m->overlaps[a][b]) {
                assert_true(made->extra[extra].a == a && made->extra[extra].b == b);
                extra++;
            }
        }
    assert_true(missing == made->missing_count && extra == made->extra_count && expected == made->expected);
    return unknown     ? OCTREE_WRONG_UNKNOWN
           : duplicate ? OCTREE_WRONG_DUPLICATE
           : missing   ? OCTREE_WRONG_MISSING
           : extra     ? OCTREE_WRONG_EXTRA
                       : OCTREE_WRONG_NONE;
}

/* Whole numbers, so that many boxes touch. */
static void draw_bodies(octree_game_body *bodies, pair_matrix *m, uint64_t *seed)
{
    for (uint64_t i = 0; i < BODIES; i++) {
        bodies[i] = (octree_game_body){.id = i + 1};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = (double)random_below(seed, 13) - 6;
            bodies[i].half[axis] = (double)random_below(seed, 4);
        }
    }
    for (size_t i = 0; i < BODIES; i++)
        for (size_t j = i + 1; j < BODIES; j++) {
            bool *overlaps = &m->overlaps[i + 1][j + 1];
            *overlaps = true;
            for (int axis = 0; axis < 3; axis++) {
                const double apart = bodies[i].position[axis] - bodies[j].position[axis];
                *overlaps &= (apart < 0 ? -apart : apart) <= bodies[i].half[axis] + bodies[j].half[axis];
            }
        }
}

static void random_pairs_are_judged_as_by_brute_force(void **state)
{
    (void)state;
    size_t of_kind[OCTREE_WRONG_KINDS] = {0};
    for (uint64_t seed = 1, drawn = 1; seed <= 400; seed++) {
        octree_game_body bodies[BODIES];
        octree_pair pairs[IDS * IDS];
        pair_matrix m = {{{0}}, {{false}}};
        draw_bodies(bodies, &m, &drawn);
        const octree_foreign_pairs list = {.pairs = pairs, .pair_count = draw_pairs(&m, pairs, &drawn)};
        octree_session session = small_session(bodies, BODIES);
        session.tree.full_leaf = OCTREE_GROW;
        session.player.id = IDS;
        session.foreign_pairs = &list;
        session.foreign_pairs_count = 1;
        octree_game *game = start_game(&session);
        const octree_pair_judgement *made = &octree_game_tick(game)->foreign_pairs;
        assert_int_equal(made->wrong, judge_by_brute_force(&m, made));
        of_kind[made->wrong]++;
        octree_game_destroy(game);
    }
    assert_true(of_kind[OCTREE_WRONG_UNKNOWN] && of_kind[OCTREE_WRONG_DUPLICATE] && of_kind[OCTREE_WRONG_MISSING]);
}

static int destroy_last_game(void **state)
{
    (void)state;
    octree_game_destroy(last_game);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(right_pairs_are_right_in_any_order),
        cmocka_unit_test(boxes_that_touch_overlap),
        cmocka_unit_test(every_error_has_its_kind),
        cmocka_unit_test(lowest_of_several_errors_is_reported),
        cmocka_unit_test(player_that_keys_move_is_unknown),
        cmocka_unit_test(ticks_with_a_list_are_judged),
        cmocka_unit_test(judgement_survives_its_input_and_further_queries),
        cmocka_unit_test(invalid_pairs_are_refused),
        cmocka_unit_test(random_pairs_are_judged_as_by_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, destroy_last_game);
}
