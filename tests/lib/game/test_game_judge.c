/* SPDX-License-Identifier: MIT */
/* What a program answered, judged in a game: each fault by itself. */
#include "fixture.h"
#include "octree/game.h"

#include <math.h>
#include <string.h>

#define PLAYER 5000

static const octree_game_body few[] = {{.id = 1, .position = {1, 0, 0}},  {.id = 2, .position = {0, 2, 0}},
                                       {.id = 3, .position = {-2, 0, 0}}, {.id = 4, .position = {3, 0, 0}},
                                       {.id = 5, .position = {0, 0, 4}},  {.id = 6, .position = {0, 0, 0}}};

/* The judgement of one answer, about the points above and a player far off; the arrays are good until the next. */
static octree_game *last_game;

static octree_judgement judge_one(octree_query q, const uint64_t *ids, size_t count)
{
    q.tick = 0;
    q.answered = true;
    q.answer = ids;
    q.answer_count = count;
    octree_session session = {.tree = define(cube(-10, 10), 2, 5, OCTREE_GROW),
                              .player = {.id = PLAYER, .position = {9, 9, 9}},
                              .bodies = few,
                              .body_count = sizeof few / sizeof few[0],
                              .queries = &q,
                              .query_count = 1};
    octree_game_destroy(last_game);
    assert_int_equal(octree_game_create(&session, &last_game), OCTREE_OK);
    const octree_tick *tick = octree_game_tick(last_game);
    const octree_judgement made = tick->answers[0].judgement;
    assert_int_equal((tick->events & OCTREE_EVENT_WRONG) != 0, made.wrong != OCTREE_WRONG_NONE);
    assert_memory_equal(made.given, ids, count * sizeof *ids);
    return made;
}

#define IDS(...) (const uint64_t[]){__VA_ARGS__}, sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t)

static const octree_query three = {.kind = OCTREE_QUERY_KNEAREST, .target = {0, 0, 0}, .k = 3};
static const octree_query ball = {.kind = OCTREE_QUERY_RADIUS, .target = {0, 0, 0}, .radius = 2};
static const octree_query box = {.kind = OCTREE_QUERY_RANGE, .box = {{-2, -2, -2}, {2, 2, 2}}};

static void ties_are_right_in_any_order(void **state)
{
    (void)state;
    assert_int_equal(judge_one(three, IDS(6, 1, 2)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(three, IDS(3, 6, 1)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(ball, IDS(3, 6, 1, 2)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(box, IDS(1, 2, 6, 3)).wrong, OCTREE_WRONG_NONE);
}

static void every_fault_has_its_reason(void **state)
{
    (void)state;
    octree_judgement j = judge_one(three, IDS(6, 1, 99, 77));
    assert_true(j.wrong == OCTREE_WRONG_UNKNOWN && j.wrong_id == 77);
    j = judge_one(three, IDS(6, 1, 77, 99));
    assert_true(j.wrong == OCTREE_WRONG_UNKNOWN && j.wrong_id == 77);
    j = judge_one(three, IDS(6, 1, 1));
    assert_true(j.wrong == OCTREE_WRONG_DUPLICATE && j.wrong_id == 1 && j.missing_count == 1 && j.missing[0].id == 2);
    j = judge_one(three, IDS(6, 1));
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.rank == 3 && j.missing_count == 1 && j.missing[0].id == 2);
    j = judge_one(three, NULL, 0);
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.rank == 1 && j.missing_count == 3 && isinf(j.ratio));
    j = judge_one(three, IDS(77));
    assert_true(j.wrong == OCTREE_WRONG_UNKNOWN && j.missing_count == 3 && isinf(j.ratio));
    j = judge_one(three, IDS(6, 1, 2, 3));
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.rank == 4 && j.missing_count == 0 && j.ratio == 1);
    j = judge_one(three, IDS(6, 2, 3));
    assert_true(j.wrong == OCTREE_WRONG_FARTHER && j.rank == 2 && j.ratio == 2 && j.missing_count == 1);
    assert_true(j.missing[0].id == 1 && j.extra_count == 0 && j.expected == 3);
    j = judge_one(three, IDS(6, 1, 4));
    assert_true(j.rank == 3 && j.ratio == 1.5 && j.extra_count == 1 && j.extra[0].id == 4 && j.missing[0].id == 2);
    j = judge_one(three, IDS(1, 2, 3));
    assert_true(j.rank == 1 && isinf(j.ratio) && j.missing_count == 1 && j.missing[0].id == 6);
    j = judge_one(ball, IDS(6, 1, 2));
    assert_true(j.wrong == OCTREE_WRONG_MISSING && j.missing_count == 1 && j.missing[0].id == 3 && j.expected == 4);
    j = judge_one(box, IDS(6, 1, 2, 3, 4));
    assert_true(j.wrong == OCTREE_WRONG_EXTRA && j.extra_count == 1 && j.extra[0].id == 4);
    j = judge_one(box, NULL, 0);
    assert_true(j.wrong == OCTREE_WRONG_MISSING && j.missing_count == 4);
    octree_query q = three;
    q.k = 0;
    j = judge_one(q, IDS(1));
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.extra_count == 1 && j.extra[0].id == 1 && j.expected == 0);
    q = three;
    q.skip = OCTREE_SKIP_COINCIDENT;
    j = judge_one(q, IDS(6, 1, 2));
    assert_true(j.wrong == OCTREE_WRONG_SKIPPED && j.wrong_id == 6);
    assert_int_equal(judge_one(q, IDS(1, 2, 3)).wrong, OCTREE_WRONG_NONE);
    q.at_player = true;
    q.skip = OCTREE_SKIP_NONE;
    j = judge_one(q, IDS(PLAYER, 4, 2));
    assert_true(j.wrong == OCTREE_WRONG_SKIPPED && j.wrong_id == PLAYER);
}

static void a_promise_about_a_box_without_ends_is_held_to_it(void **state)
{
    (void)state;
    octree_query q = box;
    q.epsilon = 1;
    q.box.min[0] = -INFINITY;
    q.box.max[1] = INFINITY;
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 4)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 5)).wrong, OCTREE_WRONG_EXTRA);
    q.box.max[0] = -INFINITY;
    assert_int_equal(judge_one(q, NULL, 0).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(q, IDS(4)).wrong, OCTREE_WRONG_EXTRA);
    q = box;
    q.box.min[0] = 0.5;
    q.epsilon = 2.5;
    assert_int_equal(judge_one(q, IDS(1, 3)).wrong, OCTREE_WRONG_NONE);
    q.epsilon = next_down(2.5);
    assert_int_equal(judge_one(q, IDS(1, 3)).wrong, OCTREE_WRONG_EXTRA);
}

/* Judged by the truth, whose own answer has no epsilon then. */
static void a_promise_with_epsilon_is_held_to_it(void **state)
{
    (void)state;
    octree_query q = three;
    q.epsilon = 0.5;
    octree_judgement j = judge_one(q, IDS(6, 1, 4));
    assert_true(j.wrong == OCTREE_WRONG_NONE && j.ratio == 1.5 && j.rank == 0 && j.missing_count == 0);
    assert_int_equal(octree_game_tick(last_game)->answers[0].neighbors[2].point.id, 2);
    assert_int_equal(judge_one(q, IDS(6, 4, 2)).wrong, OCTREE_WRONG_FARTHER);
    assert_int_equal(judge_one(q, IDS(1, 2, 3)).wrong, OCTREE_WRONG_FARTHER);
    q = ball;
    q.epsilon = 1;
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 4)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 5)).wrong, OCTREE_WRONG_EXTRA);
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 4)).wrong, OCTREE_WRONG_MISSING);
    q = box;
    q.epsilon = 1;
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 4)).wrong, OCTREE_WRONG_NONE);
    q.epsilon = next_down(1);
    assert_int_equal(judge_one(q, IDS(6, 1, 2, 3, 4)).wrong, OCTREE_WRONG_EXTRA);
}

/* Else a promise would be judged by what is no truth. */
static void what_judges_has_no_epsilon(void **state)
{
    (void)state;
    for (int x = -9; x <= 9; x++)
        for (int y = -9; y <= 9; y += 3) {
            const octree_query q = {.kind = OCTREE_QUERY_NEAREST, .target = {x, y, 0.25}, .epsilon = 9};
            octree_query exact = q;
            exact.epsilon = 0;
            judge_one(exact, IDS(1));
            const double distance = octree_game_tick(last_game)->answers[0].neighbors[0].distance;
            judge_one(q, IDS(1));
            assert_true(octree_game_tick(last_game)->answers[0].neighbors[0].distance == distance);
        }
}

static void answers_that_cannot_be_judged_are_refused(void **state)
{
    (void)state;
    octree_query q = three;
    q.answered = true;
    q.answer_count = 1;
    assert_int_equal(octree_query_check(&q), OCTREE_NULL_ARGUMENT);
    q.answer_count = 0;
    q.precision = OCTREE_PRECISIONS;
    assert_int_equal(octree_query_check(&q), OCTREE_BAD_OPTION);
    q.precision = OCTREE_FLOATS;
    assert_int_equal(octree_query_check(&q), OCTREE_OK);
    q.box.min[0] = NAN; /* which it has not */
    assert_int_equal(octree_query_check(&q), OCTREE_OK);
}

/* Ids of the bodies of a game with this query, judged in floats. Its lists go with the game, but for the first that was
 * missed. */
static octree_judgement judge_floats(const octree_game_body *bodies, size_t count, octree_query q, const uint64_t *ids,
                                     size_t id_count)
{
    q.answered = true;
    q.answer = ids;
    q.answer_count = id_count;
    q.precision = OCTREE_FLOATS;
    const octree_session session = {.tree = define(cube(-10, 10), 2, 21, OCTREE_GROW),
                                    .player.kind = OCTREE_PLAYER_NONE,
                                    .bodies = bodies,
                                    .body_count = count,
                                    .queries = &q,
                                    .query_count = 1};
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    static octree_point missed;
    octree_judgement made = octree_game_tick(game)->answers[0].judgement;
    if (made.missing_count > 0)
        missed = made.missing[0];
    made.missing = &missed;
    octree_game_destroy(game);
    return made;
}

/* What is beside the target in doubles is on it in floats, and left out: then the nearest are farther than they seemed.
 * Point 3 is beyond the first ball, and nearly so. */
static void floats_that_coincide_are_left_out(void **state)
{
    (void)state;
    const octree_game_body near[] = {{.id = 3, .position = {2e-6, 0, 0}},
                                     {.id = 1, .position = {1e-50, 0, 0}},
                                     {.id = 2, .position = {0, 1e-50, 0}},
                                     {.id = 4, .position = {7, 0, 0}}};
    octree_query q = {.kind = OCTREE_QUERY_KNEAREST, .k = 1, .skip = OCTREE_SKIP_COINCIDENT};
    octree_judgement j = judge_floats(near + 1, 3, q, NULL, 0);
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.missing_count == 1 && j.missing[0].id == 4);
    j = judge_floats(near, 4, q, IDS(3));
    assert_true(j.wrong == OCTREE_WRONG_NONE && j.expected == 1);
    j = judge_floats(near, 4, q, IDS(1));
    assert_true(j.wrong == OCTREE_WRONG_SKIPPED && j.wrong_id == 1);
    q.k = 3; /* of which there are two */
    j = judge_floats(near, 4, q, IDS(3, 4));
    assert_true(j.wrong == OCTREE_WRONG_NONE && j.expected == 2);
    q.k = 9; /* more than there are points */
    assert_int_equal(judge_floats(near, 4, q, IDS(3, 4)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_floats(near, 4, q, IDS(4)).wrong, OCTREE_WRONG_COUNT);
    const octree_game_body twins[] = {{.id = 1}, {.id = 2}, {.id = 3}, {.id = 4, .position = {7, 0, 0}}};
    q.k = 2; /* one is there, and it is not known how far others are */
    assert_int_equal(judge_floats(twins, 4, q, IDS(4)).wrong, OCTREE_WRONG_NONE);
}

/* Point 4 is nearest in doubles and on the target in floats, so that balls grow: twice the first is one of 2.5. It has
 * point 2, whose rounded position is beyond it, and not point 3, which rounds down in two coordinates and is nearer.
 * What the query before listed does not matter. */
static void the_kth_of_floats_is_nearer_than_all_that_a_ball_left_out(void **state)
{
    (void)state;
    const octree_game_body bodies[] = {{.id = 1, .position = {1.25 - 10 * 0x1p-23, 0, 0}},
                                       {.id = 2, .position = {2.5 + 4.875 * 0x1p-22, 0, 0}},
                                       {.id = 3, .position = {0x1.b8b000ep+0, 0x1.d01b48ep+0, 0}},
                                       {.id = 4, .position = {1e-50, 0, 0}},
                                       {.id = 5},
                                       {.id = 6}};
    const octree_query at_target = {
        .kind = OCTREE_QUERY_KNEAREST, .k = 4, .answered = true, .precision = OCTREE_FLOATS};
    octree_query queries[] = {at_target, at_target};
    queries[1].k = 2;
    queries[1].skip = OCTREE_SKIP_COINCIDENT;
    const octree_session session = {.tree = define(cube(-10, 10), 2, 21, OCTREE_GROW),
                                    .player.kind = OCTREE_PLAYER_NONE,
                                    .bodies = bodies,
                                    .body_count = 6,
                                    .queries = queries,
                                    .query_count = 2};
    octree_game_destroy(last_game);
    assert_int_equal(octree_game_create(&session, &last_game), OCTREE_OK);
    const octree_judgement j = octree_game_tick(last_game)->answers[1].judgement;
    assert_true(j.missing_count == 2 && j.missing[0].id == 1 && j.missing[1].id == 3);
}

/* Floats end long before doubles do. */
static void floats_are_judged_in_worlds_beyond_them(void **state)
{
    (void)state;
    const octree_game_body far[] = {{.id = 1, .position = {1e300, 0, 0}},
                                    {.id = 2, .position = {1e100, 0, 0}},
                                    {.id = 3, .position = {-1e308, 1e308, 1e308}},
                                    {.id = 4, .position = {1e-320, 0, 0}}};
    const uint64_t tied[] = {1, 4}, not [] = {3, 1};
    const octree_query queries[] = {{.kind = OCTREE_QUERY_KNEAREST,
                                     .target = {1e200, 0, 0},
                                     .k = 1,
                                     .answered = true,
                                     .precision = OCTREE_FLOATS,
                                     .answer = tied,
                                     .answer_count = 1},
                                    {.kind = OCTREE_QUERY_KNEAREST,
                                     .target = {0, 0, 0},
                                     .k = 2,
                                     .answered = true,
                                     .precision = OCTREE_FLOATS,
                                     .answer = tied,
                                     .answer_count = 2},
                                    {.kind = OCTREE_QUERY_KNEAREST,
                                     .target = {0, 0, 0},
                                     .k = 2,
                                     .answered = true,
                                     .precision = OCTREE_FLOATS,
                                     .answer = not,
                                     .answer_count = 2}};
    const octree_session session = {.tree = define(cube(-1.5e308, 1.5e308), 2, 21, OCTREE_GROW),
                                    .player.kind = OCTREE_PLAYER_NONE,
                                    .bodies = far,
                                    .body_count = 4,
                                    .queries = queries,
                                    .query_count = 3};
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->answers[0].judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(tick->answers[1].judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(tick->answers[2].judgement.wrong, OCTREE_WRONG_FARTHER);
    octree_game_destroy(game);
}

/* The sum of radius and epsilon is beyond doubles. */
static void a_promise_beyond_doubles_is_held_to_it(void **state)
{
    (void)state;
    const octree_game_body far = {.id = 3, .position = {-1e308, 1e308, 1e308}};
    const uint64_t named = 3;
    octree_query q = {.kind = OCTREE_QUERY_RADIUS,
                      .radius = 1e308,
                      .epsilon = 1.7e308,
                      .answered = true,
                      .answer = &named,
                      .answer_count = 1};
    const octree_session session = {.tree = define(cube(-1.5e308, 1.5e308), 2, 21, OCTREE_GROW),
                                    .player.kind = OCTREE_PLAYER_NONE,
                                    .bodies = &far,
                                    .body_count = 1,
                                    .queries = &q,
                                    .query_count = 1};
    for (int i = 0; i < 2; i++) {
        octree_game *game;
        assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
        assert_int_equal(octree_game_tick(game)->answers[0].judgement.wrong,
                         i ? OCTREE_WRONG_EXTRA : OCTREE_WRONG_NONE);
        octree_game_destroy(game);
        q.epsilon = 1e307;
    }
}

static void names_are_those_of_files(void **state)
{
    (void)state;
    assert_string_equal(octree_wrong_name(OCTREE_WRONG_NONE), "none");
    assert_string_equal(octree_wrong_name(OCTREE_WRONG_EXTRA), "extra");
    assert_null(octree_wrong_name(OCTREE_WRONG_KINDS));
    assert_string_equal(octree_precision_name(OCTREE_FLOATS), "float");
    assert_null(octree_precision_name(OCTREE_PRECISIONS));
    assert_string_equal(octree_event_name(OCTREE_EVENT_WRONG), "wrong");
    assert_string_equal(octree_node_visit_name(OCTREE_NODE_HIT), "hit");
    assert_null(octree_node_visit_name(OCTREE_NODE_VISITS));
    assert_string_equal(octree_wrong_node_name(OCTREE_NODE_PRUNED_POINT), "pruned_point");
    assert_null(octree_wrong_node_name(OCTREE_WRONG_NODE_KINDS));
    assert_null(octree_wrong_node_words(OCTREE_WRONG_NODE_KINDS));
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        assert_non_null(octree_wrong_node_words((octree_wrong_node_kind)kind));
}

static int forget_game(void **state)
{
    (void)state;
    octree_game_destroy(last_game);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ties_are_right_in_any_order),
        cmocka_unit_test(every_fault_has_its_reason),
        cmocka_unit_test(a_promise_about_a_box_without_ends_is_held_to_it),
        cmocka_unit_test(a_promise_with_epsilon_is_held_to_it),
        cmocka_unit_test(what_judges_has_no_epsilon),
        cmocka_unit_test(answers_that_cannot_be_judged_are_refused),
        cmocka_unit_test(floats_that_coincide_are_left_out),
        cmocka_unit_test(the_kth_of_floats_is_nearer_than_all_that_a_ball_left_out),
        cmocka_unit_test(floats_are_judged_in_worlds_beyond_them),
        cmocka_unit_test(a_promise_beyond_doubles_is_held_to_it),
        cmocka_unit_test(names_are_those_of_files),
    };
    return cmocka_run_group_tests(tests, NULL, forget_game);
}
