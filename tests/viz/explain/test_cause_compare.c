/* SPDX-License-Identifier: MIT */
/* test_cause_compare.c - JSON objects are compared member by member, including members without a phrase. */
#include <string.h>

#include "cause_compare.h"
#include "cause_words.h"
#include "fixture.h"
#include "text.h"

static json_t *parsed(const char *text)
{
    json_error_t error;
    json_t *object = json_loads(text, JSON_DECODE_INT_AS_REAL, &error);
    if (!object)
        fail_msg("%s: %s", text, error.text);
    return object;
}

/* In what b differs from a. */
static void assert_told(const char *a, const char *b, const char *expected)
{
    cause_facts facts = {0};
    const cause_place place = {&facts, "", "", CAUSE_NO_TICK, true};
    json_t *objects[2] = {parsed(a), parsed(b)};
    text_stream s;
    char *text;
    cause_compare_members(&place, objects[0], objects[1]);
    assert_false(facts.out_of_memory);
    assert_true(text_stream_begin(&s));
    cause_print_facts(s.stream, &facts, false);
    assert_true(text_stream_end(&s, &text));
    if (strcmp(text ? text : "", expected) != 0)
        fail_msg("it says \"%s\" and not \"%s\"", text ? text : "", expected);
    free(text);
    cause_facts_release(&facts);
    json_decref(objects[0]);
    json_decref(objects[1]);
}

static void member_without_a_description_is_named_by_its_path(void **state)
{
    (void)state;
    assert_told("{\"a\": {\"b\": 1, \"c\": 2}}", "{\"a\": {\"b\": 1, \"c\": 3}}", "another a.c (3, was 2)");
    assert_told("{\"a\": 1}", "{\"a\": 1, \"d\": \"word\"}", "another d (word, was none)");
    assert_told("{\"a\": true}", "{}", "another a (none, was on)");
    assert_told("{\"a\": [1, 2, 3]}", "{\"a\": [1, 2, -0.0]}", "another a ((1, 2, -0), was (1, 2, 3))");
    assert_told("{\"a\": [0.0]}", "{\"a\": [-0.0]}", "another a ((-0), was (0))");
    assert_told("{\"a\": {\"min\": [0], \"max\": [1]}}", "{\"a\": {\"min\": [0], \"max\": [2]}}",
                "another a ((0) to (2), was (0) to (1))");
    assert_told("{\"a\": 1}", "{\"a\": 1}", "");
}

static void elements_with_keys_are_paired_by_key(void **state)
{
    (void)state;
    assert_told("{\"a\": [\"x\", \"y\"]}", "{\"a\": [\"y\", \"z\"]}", "one a fewer (x), one more a (z)");
    assert_told("{\"a\": [{\"id\": 2, \"b\": 1}]}", "{\"a\": [{\"id\": 1, \"b\": 1}, {\"id\": 2, \"b\": 3}]}",
                "one more a (id 1, b 1), another a (id 2, b 3, was 1)");
    assert_told("{\"a\": [{\"id\": 2}, {\"id\": 1}]}", "{\"a\": [{\"id\": 1}, {\"id\": 2}]}",
                "another order of the as");
    assert_told("{}", "{\"a\": [\"x\", \"y\", \"z\"]}", "3 more as (x, y and z)");
}

/* The same point is inserted twice. */
static void edits_of_one_point_are_compared_in_order(void **state)
{
    static const char base[] = "{\"edits\": [{\"insert\": {\"id\": 1, \"position\": [0, 0, 0]}}, {\"remove\": 1},"
                               " {\"insert\": {\"id\": 1, \"position\": [1, 0, 0]}}]}";
    (void)state;
    assert_told(base,
                "{\"edits\": [{\"insert\": {\"id\": 1, \"position\": [0, 0, 0]}}, {\"remove\": 1},"
                " {\"insert\": {\"id\": 1, \"position\": [2, 0, 0]}}]}",
                "another edit (insert id 1, position (2, 0, 0), was (1, 0, 0))");
    assert_told(base, "{\"edits\": [{\"insert\": {\"id\": 1, \"position\": [0, 0, 0]}}]}",
                "2 fewer edits (points 1 and 1)");
}

static void elements_without_keys_are_paired_by_equal_members(void **state)
{
    (void)state;
    assert_told("{\"queries\": [{\"nearest\": \"player\"}, {\"radius\": 1, \"at\": \"player\"}]}",
                "{\"queries\": [{\"nearest\": \"player\"}, {\"radius\": 2, \"at\": \"player\"}]}",
                "another query at every tick (radius 2, was 1, at \"player\")");
    assert_told("{\"queries\": [{\"nearest\": \"player\"}]}",
                "{\"queries\": [{\"knearest\": 2, \"at\": \"player\"}, {\"nearest\": \"player\"}]}",
                "one more query at every tick (knearest 2, at \"player\")");
}

/* The first answer is to a key; what is asked at every tick keeps its place at the end. */
static void answers_are_compared_by_query(void **state)
{
    (void)state;
    assert_told(
        "{\"answers\": [{\"range\": {\"ids\": [1, 2, 3], \"cost\": {\"nodes\": 1}}}]}",
        "{\"answers\": [{\"nearest\": {\"id\": 4}}, {\"range\": {\"ids\": [2, 9, 8], \"cost\": {\"nodes\": 2}}}]}",
        "2 fewer hits in the range query (points 1 and 3), 2 more hits in the range query (points 8 and 9), the "
        "nearest query asked only in the frames; another cost in the range query");
    assert_told("{\"answers\": [{\"nearest\": {\"id\": 4}}, {\"nearest\": {\"id\": 5}}]}",
                "{\"answers\": [{\"nearest\": {\"id\": 4}}, {\"nearest\": {\"id\": null}}]}",
                "another nearest point in query 2 (nearest) (none, was 5)");
}

#define RADIUS(r, x) "{\"radius\": " #r ", \"at\": [" #x ", 0, 0]}"
#define FOUR RADIUS(1, 1) ", " RADIUS(2, 2) ", " RADIUS(3, 3) ", " RADIUS(4, 4)

static void each_query_is_described(void **state)
{
    (void)state;
    assert_told(
        "{\"queries\": [" FOUR "]}", "{\"queries\": [" RADIUS(2, 2) ", " RADIUS(3, 3) ", " RADIUS(5, 4) "]}",
        "another query at every tick (radius 5, was 4, at (4, 0, 0)), one query fewer at every tick (radius 1, at "
        "(1, 0, 0))");
    assert_told("{\"queries\": [" FOUR "]}",
                "{\"queries\": [" RADIUS(4, 4) ", " RADIUS(2, 2) ", " RADIUS(3, 3) ", " RADIUS(1, 1) "]}",
                "another order of the queries at every tick");
    assert_told("{\"queries\": [" RADIUS(1, 1) "]}", "{\"queries\": [" RADIUS(9, 9) ", " RADIUS(2, 1) "]}",
                "another query at every tick (radius 2, was 1, at (1, 0, 0)), one more query at every tick (radius 9, "
                "at (9, 0, 0))");
    assert_told("{\"queries\": [{\"knearest\": 3, \"at\": [1, 2, 3]}]}",
                "{\"queries\": [{\"knearest\": 3, \"at\": \"player\"}]}",
                "another query at every tick (knearest 3, at \"player\", was (1, 2, 3))");
    assert_told("{\"queries\": [{\"nearest\": [1, 2, 3]}]}",
                "{\"queries\": [{\"nearest\": [1, 2, 3], \"epsilon\": 0.5}]}",
                "another query at every tick (nearest (1, 2, 3), epsilon 0.5, was none)");
    assert_told("{\"queries\": [{\"radius\": 1, \"at\": \"player\"}]}",
                "{\"queries\": [{\"radius\": 1, \"at\": \"player\", \"bounds\": \"open\"}]}",
                "another query at every tick (radius 1, at \"player\", bounds \"open\", was none)");
    assert_told("{\"queries\": [{\"ray\": [1, 0, 0], \"at\": [1, 2, 3], \"k\": 1}]}",
                "{\"queries\": [{\"ray\": [1, 0, 0], \"at\": [1, 2, 3], \"k\": 1, \"thickness\": 0.5}]}",
                "another query at every tick (ray (1, 0, 0), at (1, 2, 3), k 1, thickness 0.5, was none)");
}

#define BALL(r, x, ids) "{\"radius\": {\"center\": [" #x ", 0, 0], \"radius\": " #r ", \"ids\": [" ids "]}}"

#define RAY(hits)                                                                                                      \
    "{\"answers\": [{\"ray\": {\"origin\": [0, 0, 0], \"direction\": [1, 0, 0], \"k\": 1, \"neighbors\": [" hits "]}}" \
    "]}"

/* Whatever they found, and wherever they stand. */
static void each_answer_is_named_by_its_query(void **state)
{
    (void)state;
    assert_told("{\"answers\": [" BALL(1, 1, "1") ", " BALL(2, 2, "2") ", " BALL(3, 3, "3") "]}",
                "{\"answers\": [" BALL(2, 2, "2, 4") ", " BALL(3, 3, "") "]}",
                "one more hit in query 1 (radius) (point 4), one hit fewer in query 2 (radius) (point 3), query 1 "
                "(radius) of the reference asked only in the reference");
    assert_told("{\"answers\": [" BALL(1, 1, "1") ", " BALL(2, 2, "2") "]}",
                "{\"answers\": [" BALL(2, 2, "2") ", " BALL(1, 1, "1") "]}", "another order of the queries");
    assert_told("{\"answers\": [" BALL(1, 1, "1") "]}", "{\"answers\": [" BALL(2, 1, "1") "]}",
                "another radius in the radius query (2, was 1)");
    assert_told("{\"answers\": [{\"nearest\": {\"target\": [0, 0, 0], \"id\": 4, \"position\": [1, 0, 0]}}]}",
                "{\"answers\": [{\"nearest\": {\"target\": [0, 0, 0], \"id\": 4, \"position\": [2, 0, 0]}}]}",
                "another position of the nearest point in the nearest query ((2, 0, 0), was (1, 0, 0))");
    assert_told(RAY("{\"id\": 4, \"position\": [3, 0, 0], \"t\": 3}"),
                RAY("{\"id\": 2, \"position\": [2, 0, 0], \"t\": 2}"),
                "one more neighbour in the ray query (id 2, position (2, 0, 0), t 2), one neighbour fewer in the ray "
                "query (id 4, position (3, 0, 0), t 3)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(member_without_a_description_is_named_by_its_path),
        cmocka_unit_test(elements_with_keys_are_paired_by_key),
        cmocka_unit_test(edits_of_one_point_are_compared_in_order),
        cmocka_unit_test(elements_without_keys_are_paired_by_equal_members),
        cmocka_unit_test(answers_are_compared_by_query),
        cmocka_unit_test(each_query_is_described),
        cmocka_unit_test(each_answer_is_named_by_its_query),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
