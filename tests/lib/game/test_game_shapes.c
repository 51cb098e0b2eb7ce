/* SPDX-License-Identifier: MIT */
/* test_game_shapes.c - what a tick shows beside the points: handed through, and nothing else to the game. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "game_fixture.h"

static const octree_shape shapes[] = {
    {0, OCTREE_SHAPE_POINT, {1, 1, 1}, {0}, ""},
    {2, OCTREE_SHAPE_BOX, {-1, -1, -1}, {99, 1, 1}, ""},
    {2, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, "two"},
    {OCTREE_EVERY_TICK, OCTREE_SHAPE_SEGMENT, {0, 0, 0}, {1e300, 0, 0}, ""},
};

static octree_session shown_session(void)
{
    octree_session session = small_session(NULL, 0);
    session.shapes = shapes;
    session.shape_count = sizeof shapes / sizeof shapes[0];
    session.ticks = 3;
    return session;
}

static void assert_shows(const octree_tick *tick, size_t first, size_t count)
{
    assert_int_equal(tick->shape_count, count + 1);
    for (size_t i = 0; i <= count; i++) {
        octree_shape expected = shapes[i < count ? first + i : 3];
        expected.tick = tick->number;
        assert_memory_equal(&tick->shapes[i], &expected, sizeof expected);
    }
}

static void each_tick_has_its_shapes_and_then_those_of_every_tick(void **state)
{
    (void)state;
    static const size_t first[] = {0, 0, 1, 0}, count[] = {1, 0, 2, 0};
    const octree_session session = shown_session();
    octree_game *game = start_game(&session);
    for (int tick = 0; tick < 4; tick++) {
        assert_shows(octree_game_tick(game), first[tick], count[tick]);
        if (tick < 3)
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    octree_game_destroy(game);
    game = start_game(&session);
    for (int tick = 1; tick < 4; tick++) {
        const octree_input input = {.key = '.', .shapes = shapes + first[tick], .shape_count = count[tick]};
        assert_int_equal(octree_game_play(game, &input), OCTREE_OK);
        assert_shows(octree_game_tick(game), first[tick], count[tick]);
    }
    octree_game_destroy(game);
}

static void a_shape_meets_nothing(void **state)
{
    (void)state;
    static const octree_query all = {OCTREE_EVERY_TICK, OCTREE_QUERY_RADIUS, .radius = 100};
    octree_session session = shown_session();
    session.queries = &all;
    session.query_count = 1;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_count(octree_game_tree(game)), 1);
    assert_int_equal(octree_game_tick(game)->answers[0].count, 1); /* the player */
    for (int i = 0; i < 3; i++)
        assert_int_equal(play_key(game, 'd')->events, OCTREE_EVENT_MOVED);
    octree_game_destroy(game);
}

static void shapes_that_cannot_be_shown_are_refused(void **state)
{
    (void)state;
    struct {
        octree_shape shape;
        octree_status why;
    } rows[] = {
        {{1, OCTREE_SHAPE_POINT, {0, NAN, 0}, {0}, ""}, OCTREE_NOT_FINITE},
        {{1, OCTREE_SHAPE_SEGMENT, {0, 0, 0}, {0, 0, -INFINITY}, ""}, OCTREE_NOT_FINITE},
        {{1, OCTREE_SHAPE_BOX, {0, 0, 0}, {NAN, 0, 0}, ""}, OCTREE_NOT_FINITE},
        {{1, OCTREE_SHAPE_LABEL, {INFINITY, 0, 0}, {0}, "x"}, OCTREE_NOT_FINITE},
        {{1, OCTREE_SHAPE_BOX, {0, 0, 0}, {1, -1, 1}, ""}, OCTREE_BAD_RANGE},
        {{1, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, "tab\there"}, OCTREE_BAD_TEXT},
        {{1, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, "\xc3\xa9"}, OCTREE_BAD_TEXT},
        {{1, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, ""}, OCTREE_BAD_TEXT}, /* filled below: it does not end */
        {{1, OCTREE_SHAPE_KINDS, {0, 0, 0}, {0}, ""}, OCTREE_BAD_OPTION},
        {{1, OCTREE_SHAPE_LABEL, {0, 0, 0}, {0}, "delete\x7f"}, OCTREE_BAD_TEXT},
    };
    memset(rows[7].shape.text, 'x', sizeof rows[7].shape.text);
    octree_session session = small_session(NULL, 0);
    octree_game *live = start_game(&session), *game;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const octree_input input = {.key = '.', .shapes = &rows[i].shape, .shape_count = 1};
        octree_session bad = small_session(NULL, 0);
        bad.shapes = &rows[i].shape;
        bad.shape_count = 1;
        assert_int_equal(octree_game_create(&bad, &game), rows[i].why);
        assert_int_equal(octree_game_play(live, &input), rows[i].why);
        assert_int_equal(octree_game_tick(live)->number, 0);
    }
    const octree_shape unordered[2] = {shapes[1], shapes[0]};
    session.shapes = unordered;
    session.shape_count = 2;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_BAD_ORDER);
    session.shapes = NULL;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_game_play(live, &(octree_input){.key = '.', .shape_count = 1}), OCTREE_NULL_ARGUMENT);
    octree_game_destroy(live);
}

static void each_kind_has_a_name(void **state)
{
    (void)state;
    assert_string_equal(octree_shape_name(OCTREE_SHAPE_BOX), "box");
    assert_string_equal(octree_shape_name(OCTREE_SHAPE_LABEL), "label");
    assert_null(octree_shape_name(OCTREE_SHAPE_KINDS));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_tick_has_its_shapes_and_then_those_of_every_tick),
        cmocka_unit_test(a_shape_meets_nothing),
        cmocka_unit_test(shapes_that_cannot_be_shown_are_refused),
        cmocka_unit_test(each_kind_has_a_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
