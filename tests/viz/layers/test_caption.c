/* SPDX-License-Identifier: MIT */
/* test_caption.c - the caption of a tick says in words what happened. */
#include "caption.h"
#include "scenes.h"

#include <string.h>

static void caption_of(const octree_game *game, char text[CAPTION_TEXT])
{
    const view v = view_make_default();
    const octree_tick *tick = octree_game_tick(game);
    const layer_source in = {.view = &v,
                             .tree = octree_game_tree(game),
                             .world = octree_game_session(game)->tree.world,
                             .answers = tick->answers,
                             .answer_count = tick->answer_count,
                             .game = game,
                             .session = octree_game_session(game),
                             .tick = tick};
    caption_write(&in, text);
}

static void captions_of_the_default_session_are_exact(void **state)
{
    (void)state;
    static const struct {
        uint64_t tick;
        const char *text;
    } expected[] = {
        {0, "11 points in 8 leaves of capacity 2, at most 5 levels deep; point 10 refused, its leaf is full"},
        {1, "n: nearest is point 5, 3.74166 away; point 5 in the player's box"},
        {2, "point 5 in the player's box"},
        {3, "e: player to (0, 0, 50)"},
        {6, "s: step taken back, its box would hit point 1"},
        {9, "s: player to (-100, -50, 100); 4 leaves split"},
        {13, "the player waits"},
        {14, "a: player to (-150, -50, 100); node 1/6/6/6 merges"},
        {22, "f: player to (-250, -200, -50); 3 nodes merge"},
        {74, "a: step refused, the world ends at x = -1000"},
        {76, "f: step refused, the world ends at z = -1000"},
        {126, "d: step refused, the world ends at x = 1000"},
        {213, "6 points in the box: 5 of 13 nodes visited"},
        {214, "e: step taken back, the leaf there is full; 6 points in the box: 5 of 13 nodes visited"},
        {218, "e: player to (850, 800, 750); leaf 7/7/7/0 splits, 3 points for capacity 2; "
              "6 points in the box: 4 of 14 nodes visited"},
        {239, "w: step refused, the world ends at y = 1000"},
    };
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        char text[CAPTION_TEXT];
        while (octree_game_tick(game)->number < expected[i].tick)
            play_tick(game);
        caption_of(game, text);
        assert_string_equal(text, expected[i].text);
    }
    octree_game_destroy(game);
}

/* The caption of a tree with `count` of three points and leaves of `capacity` points. */
static void assert_caption_of_tree(size_t count, size_t capacity, const char *expected)
{
    static const double positions[3][3] = {{1, 1, 1}, {-1, -1, -1}, {-1, 1, 1}};
    octree *tree = make_tree(cube(-2, 2), capacity, 4, OCTREE_GROW);
    const view v = view_make_default();
    char text[CAPTION_TEXT];
    for (size_t i = 0; i < count; i++)
        assert_int_equal(octree_insert(tree, positions[i], i), OCTREE_OK);
    caption_write(&(layer_source){.view = &v, .tree = tree, .world = cube(-2, 2)}, text);
    assert_string_equal(text, expected);
    octree_destroy(tree);
}

static void caption_of_a_tree_has_plurals_where_they_belong(void **state)
{
    (void)state;
    assert_caption_of_tree(3, 64, "3 points in 1 leaf of capacity 64, the root");
    assert_caption_of_tree(1, 64, "1 point in 1 leaf of capacity 64, the root");
    assert_caption_of_tree(3, 1, "3 points in 3 leaves of capacity 1, at most 1 level deep");
}

/* Several queries, moving points, edits and wrong answers are counted. */
static void captions_count_what_is_many(void **state)
{
    (void)state;
    static const uint64_t wrong[] = {2};
    static const octree_game_body bodies[] = {{.id = 1, .position = {1, 1, 1}},
                                              {.id = 2, .position = {5, 5, 5}, .velocity = {0.25, 0, 0}}};
    const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .answered = true, .answer = wrong, .answer_count = 1},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .radius = 2}};
    const octree_edit edits[] = {{.tick = 1, .kind = OCTREE_EDIT_REMOVE, .body.id = 9},
                                 {.tick = 1, .kind = OCTREE_EDIT_INSERT, .body = {.id = 8, .position = {-9, 2, 3}}}};
    octree_session session = small_session(bodies, 2);
    session.player.kind = OCTREE_PLAYER_NONE;
    session.queries = queries;
    session.query_count = 2;
    session.edits = edits;
    session.edit_count = 2;
    session.ticks = 1;
    octree_game *game = start_game(&session);
    char text[CAPTION_TEXT];
    play_tick(game);
    caption_of(game, text);
    assert_string_equal(
        text, "1 point moves; 2 edits; point 9 refused, the tree has no such point or node; "
              "leaf root splits, 3 points for capacity 2; 2 queries visit 6 nodes; 1 foreign answer is wrong");
    octree_game_destroy(game);
}

static void caption_tells_how_foreign_pairs_are_wrong(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .half = {1, 1, 1}}, {.id = 2, .position = {1, 1, 1}}};
    const octree_foreign_pairs none = {.tick = 1};
    octree_session session = small_session(bodies, 2);
    session.player.kind = OCTREE_PLAYER_NONE;
    session.foreign_pairs = &none;
    session.foreign_pairs_count = 1;
    session.ticks = 1;
    octree_game *game = start_game(&session);
    char text[CAPTION_TEXT];
    play_tick(game);
    caption_of(game, text);
    assert_string_equal(text, "foreign pairs: 1 missing");
    octree_game_destroy(game);
}

static void caption_names_the_reason_of_a_gap(void **state)
{
    (void)state;
    const octree_gap gap = {.tick = 1, .why = "the queue was full"};
    octree_session session = small_session(NULL, 0);
    session.gaps = &gap;
    session.gap_count = 1;
    session.ticks = 2;
    octree_game *game = start_game(&session);
    char text[CAPTION_TEXT];
    play_tick(game);
    caption_of(game, text);
    assert_string_equal(text, "gap: the queue was full");
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(captions_of_the_default_session_are_exact),
        cmocka_unit_test(caption_of_a_tree_has_plurals_where_they_belong),
        cmocka_unit_test(captions_count_what_is_many),
        cmocka_unit_test(caption_tells_how_foreign_pairs_are_wrong),
        cmocka_unit_test(caption_names_the_reason_of_a_gap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
