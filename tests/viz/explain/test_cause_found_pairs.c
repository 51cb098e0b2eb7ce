/* SPDX-License-Identifier: MIT */
/* test_cause_found_pairs.c - two sessions that differ in the pairs of a foreign index, and the sentence that reports
 * it. */
#include "fixture.h"
#include "session_variant.h"

/* Two bodies that overlap; the list is that of tick 1. */
static void give(variant *v, const octree_foreign_pairs *list)
{
    v->session.edit_count = v->session.query_count = 0;
    v->session.body_count = 2;
    v->bodies[0] = (octree_game_body){.id = 41, .position = {5, 5, 5}, .half = {2, 2, 2}};
    v->bodies[1] = (octree_game_body){.id = 42, .position = {-5, 5, 5}, .half = {9, 9, 9}};
    v->session.foreign_pairs = list;
    v->session.foreign_pairs_count = list != NULL;
}

static const octree_pair pairs[] = {{41, 42}, {42, 43}};
static const octree_foreign_pairs none = {.tick = 1}, right = {.tick = 1, .pairs = pairs, .pair_count = 1},
                                  unknown = {.tick = 1, .pairs = pairs, .pair_count = 2};

static void give_nothing(variant *v)
{
    give(v, NULL);
}

static void give_none(variant *v)
{
    give(v, &none);
}

static void give_right(variant *v)
{
    give(v, &right);
}

static void give_unknown(variant *v)
{
    give(v, &unknown);
}

static void other_pairs_are_reported(void **state)
{
    (void)state;
    assert_change_headline_from(
        give_none, give_right,
        "1 fewer wrong answer at tick 1; one more foreign pair at tick 1 ((41, 42)); tick 1: one "
        "more foreign pair ((41, 42)), another judgement of the foreign pairs (none, was missing)");
    assert_change_headline_from(
        give_right, give_unknown,
        "1 more wrong answer at tick 1; one more foreign pair at tick 1 ((42, 43)); tick 1: one "
        "more foreign pair ((42, 43)), another judgement of the foreign pairs (unknown, was none)");
}

/* The list of one side is missing, so nothing is judged there. */
static void list_of_one_side_is_reported(void **state)
{
    (void)state;
    assert_change_headline_from(
        give_nothing, give_right,
        "one more foreign pair at tick 1 ((41, 42)); tick 1: another judgement of the foreign pairs");
    assert_change_headline_from(
        give_right, give_nothing,
        "one foreign pair fewer at tick 1 ((41, 42)); tick 1: another judgement of the foreign pairs");
    assert_change_headline_from(give_nothing, give_none,
                                "1 more wrong answer at tick 1; another foreign pair at tick 1 ((), was none); tick 1: "
                                "one more event (wrong), another judgement of the foreign pairs");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_pairs_are_reported),
        cmocka_unit_test(list_of_one_side_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
