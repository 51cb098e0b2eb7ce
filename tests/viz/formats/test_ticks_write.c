/* SPDX-License-Identifier: MIT */
/* test_ticks_write.c - lines of ticks.jsonl hold every fact of a tick, and numbers to the bit. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "game_fixture.h"
#include "octree/sample.h"
#include "random_session.h"
#include "tick_lines.h"
#include "ticks_write.h"

/* The line of a tick; the caller frees it. */
static char *line_of(const octree_tick *tick, const tick_extras *extras)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, tick, extras);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_told(const octree_tick *tick, const octree *tree)
{
    const tick_extras extras = {.frame = NULL};
    char *text = line_of(tick, &extras);
    json_t *line = json_read(text);
    assert_line_has_facts(line, tick, tree);
    json_decref(line);
    free(text);
}

/* A tick of an empty tree, built by hand. */
static void assert_made_is_told(octree_tick tick)
{
    octree *tree = make_tree(cube(-1, 1), 2, 5, OCTREE_REFUSE);
    tick.tree_digest = octree_digest(tree);
    assert_int_equal(octree_statistics(tree, &tick.stats), OCTREE_OK);
    assert_told(&tick, tree);
    octree_destroy(tree);
}

static void lines_of_random_sessions_hold_every_fact(void **state)
{
    static random_session made;
    unsigned events = 0;
    (void)state;
    for (uint64_t seed = 0; seed < 12; seed++) {
        random_session_mixed(&made, seed);
        octree_game *game = start_game(&made.session);
        assert_told(octree_game_tick(game), octree_game_tree(game));
        while (!octree_game_over(game)) {
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
            assert_told(octree_game_tick(game), octree_game_tree(game));
            events |= octree_game_tick(game)->events;
        }
        octree_game_destroy(game);
    }
    assert_int_equal(events, (OCTREE_EVENT_WRONG - 1) | OCTREE_EVENT_OVERLAPPED);
}

static void line_of_a_known_tick_has_the_expected_bytes(void **state)
{
    static const char expected[] =
        "{\"tick\": 3, \"key\": \"w\", \"player\": [0.1, -0, 1e+300], \"events\": [\"moved\", \"split\"], "
        "\"attempt\": [0.1, 50, 1e+300], \"hits\": [4, 9007199254740991], "
        "\"hit_cost\": {\"nodes\": 1, \"leaves\": 2, \"points\": 3, \"pruned\": 4}, "
        "\"answers\": [{\"nearest\": {\"target\": [1, 2, 3], \"id\": null, "
        "\"cost\": {\"nodes\": 0, \"leaves\": 0, \"points\": 0, \"pruned\": 1}}}, "
        "{\"range\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1], \"ids\": [4], "
        "\"cost\": {\"nodes\": 5, \"leaves\": 6, \"points\": 7, \"pruned\": 8, \"taken\": 9}}}, "
        "{\"knearest\": {\"target\": [4, 5, 6], \"k\": 8, \"skip\": 7, "
        "\"neighbors\": [{\"id\": 9, \"position\": [4, 5, 7], \"distance\": 1}], "
        "\"cost\": {\"nodes\": 0, \"leaves\": 0, \"points\": 0, \"pruned\": 0}}}, "
        "{\"radius\": {\"center\": [7, 8, 9], \"radius\": 0.5, \"bounds\": \"either\", \"skip\": \"coincident\", "
        "\"epsilon\": 0.25, \"ids\": "
        "[], "
        "\"cost\": {\"nodes\": 0, \"leaves\": 0, \"points\": 0, \"pruned\": 18446744073709551615}}}], "
        "\"visits\": {\"visited\": 10, \"taken\": 12, \"pruned\": 11, \"hit\": 13}, "
        "\"refusals\": [{\"id\": 7, \"why\": \"outside\", \"position\": [4.94065645841247e-324, 0, 0]}], "
        "\"splits\": [\"root\", \"0/7\"], \"merges\": [], "
        "\"tree\": {\"points\": 2, \"nodes\": 5, \"leaves\": 4, \"depth\": 1, \"digest\": \"00000000000000ff\"}, "
        "\"frame\": \"frame_000003.png\", \"scene\": \"ffffffffffffffff\"}\n";
    const octree_point hits[] = {{.id = 4}, {.id = 9007199254740991}};
    const octree_neighbor near = {.point = {.position = {4, 5, 7}, .id = 9}, .distance = 1};
    const octree_answer answers[] = {
        {.kind = OCTREE_QUERY_NEAREST, .target = {1, 2, 3}, .cost = {.pruned = 1}},
        {.box = {{0, 0, 0}, {1, 1, 1}}, .points = hits, .count = 1, .cost = {5, 6, 7, 8, 9}},
        {.kind = OCTREE_QUERY_KNEAREST,
         .target = {4, 5, 6},
         .k = 8,
         .neighbors = &near,
         .count = 1,
         .skip = OCTREE_SKIP_ID,
         .skip_id = 7},
        {.kind = OCTREE_QUERY_RADIUS,
         .target = {7, 8, 9},
         .radius = 0.5,
         .bounds = OCTREE_BOUNDS_EITHER,
         .cost = {.pruned = UINT64_MAX},
         .skip = OCTREE_SKIP_COINCIDENT,
         .epsilon = 0.25},
    };
    const octree_refusal refused = {7, OCTREE_OUTSIDE, {5e-324, 0, 0}};
    const octree_address splits[] = {OCTREE_ROOT, 0107};
    const octree_tick tick = {.number = 3,
                              .key = 'w',
                              .events = OCTREE_EVENT_MOVED | OCTREE_EVENT_SPLIT,
                              .has_player = true,
                              .player = {0.1, -0.0, 1e300},
                              .attempt = {0.1, 50, 1e300},
                              .hits = hits,
                              .hit_count = 2,
                              .hit_cost = {1, 2, 3, 4, 0},
                              .refusals = &refused,
                              .refusal_count = 1,
                              .splits = splits,
                              .split_count = 2,
                              .answers = answers,
                              .answer_count = 4,
                              .touched = {10, 11, 12},
                              .hit_leaf_count = 13,
                              .stats = {.points = 2, .nodes = 5, .leaves = 4, .depth = 1},
                              .tree_digest = 255};
    const tick_extras extras = {.frame = "frame_000003.png", .scene_digest = UINT64_MAX};
    (void)state;
    char *text = line_of(&tick, &extras);
    assert_string_equal(text, expected);
    free(text);
}

static void tick_without_a_frame_has_neither_frame_nor_scene(void **state)
{
    const octree_tick tick = {.number = UINT64_C(1) << 52};
    const tick_extras extras = {.scene_digest = 1};
    (void)state;
    char *text = line_of(&tick, &extras);
    json_t *line = json_read(text);
    assert_null(json_object_get(line, "frame"));
    assert_null(json_object_get(line, "scene"));
    assert_true(json_is_null(json_member(line, "key")));
    assert_whole_number(json_member(line, "tick"), tick.number);
    json_decref(line);
    free(text);
}

static void tick_without_a_player_has_null_positions(void **state)
{
    (void)state;
    assert_made_is_told((octree_tick){.number = 1, .key = '.', .player = {1, 2, 3}, .attempt = {1, 2, 3}});
}

static void every_set_of_events_is_written(void **state)
{
    (void)state;
    for (unsigned events = 0; events < 1u << OCTREE_EVENT_KINDS; events++) {
        const octree_tick tick = {.number = events, .has_player = true, .key = '.', .events = events};
        assert_made_is_told(tick);
    }
}

static void every_double_is_written_to_the_bit(void **state)
{
    static const double values[] = {0.0,      -0.0,   5e-324,  -5e-324,      DBL_MIN, DBL_MAX,
                                    -DBL_MAX, 0.1,    1.0 / 3, 1e15,         1e16,    1e17,
                                    0x1p53,   1e22,   1e23,    1e-5,         1e-4,    123456.789,
                                    1e300,    1e-300, 0.7,     0x1.fffffp30, -2.5e-8, 9007199254740993.0};
    uint64_t random = 9;
    (void)state;
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        const octree_tick tick = {.key = 'n', .has_player = true, .player = {values[i], -values[i], values[i] / 3}};
        assert_made_is_told(tick);
    }
    for (int i = 0; i < 2000; i++) {
        octree_tick tick = {.key = 'n', .has_player = true};
        for (int axis = 0; axis < 3; axis++) {
            const uint64_t bits = octree_random(&random);
            memcpy(&tick.player[axis], &bits, sizeof bits);
            if (!isfinite(tick.player[axis]))
                tick.player[axis] = 0;
        }
        assert_made_is_told(tick);
    }
}

static void digest_is_sixteen_hexadecimal_digits(void **state)
{
    char text[DIGEST_TEXT];
    (void)state;
    assert_string_equal(digest_print(0, text), "0000000000000000");
    assert_string_equal(digest_print(UINT64_MAX, text), "ffffffffffffffff");
    assert_string_equal(digest_print(UINT64_C(0x0123456789abcdef), text), "0123456789abcdef");
}

static void write_error_stays_in_the_stream(void **state)
{
    const octree_tick tick = {.number = 1};
    const tick_extras extras = {.frame = NULL};
    FILE *out = fopen("/dev/full", "wb");
    (void)state;
    assert_non_null(out);
    tick_write(out, &tick, &extras);
    assert_true(fflush(out) != 0 || ferror(out));
    fclose(out);
}

static void gap_has_only_its_tick_and_reason(void **state)
{
    octree_tick tick = {.number = 50, .gap = "two points have one id: 7", .player = {1, 2, 3}, .has_player = true};
    char *text = line_of(&tick, &(tick_extras){0});
    (void)state;
    assert_string_equal(text, "{\"tick\": 50, \"gap\": \"two points have one id: 7\"}\n");
    free(text);
}

static void assert_nodes(const octree_tick *tick, bool whole, const char *part)
{
    char *text = line_of(tick, &(tick_extras){.whole = whole});
    if (!strstr(text, part))
        fail_msg("\"%s\" does not say %s", text, part);
    free(text);
}

/* Up to TICK_LISTED nodes the line lists all of them; for more, its length does not depend on their number. */
static void many_splits_or_merges_are_written_as_count_and_digest(void **state)
{
    octree_address nodes[TICK_LISTED + 1];
    octree_tick tick = {.splits = nodes, .split_count = TICK_LISTED, .merges = nodes, .merge_count = TICK_LISTED + 1};
    (void)state;
    for (size_t i = 0; i <= TICK_LISTED; i++)
        nodes[i] = 01000 + i;
    assert_nodes(&tick, false, "\"splits\": [\"0/0/0\", \"0/0/1\", ");
    assert_nodes(&tick, false, "\"3/7/7\"], \"merges\": {\"count\": 257, \"digest\": \"d171d6def3e720b9\"}, \"tree\"");
    assert_nodes(&tick, true, "\"3/7/7\", \"4/0/0\"], \"tree\"");
    nodes[7]++;
    assert_nodes(&tick, false, "\"merges\": {\"count\": 257, \"digest\": \"9af747e30447331f\"}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_random_sessions_hold_every_fact),
        cmocka_unit_test(line_of_a_known_tick_has_the_expected_bytes),
        cmocka_unit_test(tick_without_a_frame_has_neither_frame_nor_scene),
        cmocka_unit_test(tick_without_a_player_has_null_positions),
        cmocka_unit_test(every_set_of_events_is_written),
        cmocka_unit_test(every_double_is_written_to_the_bit),
        cmocka_unit_test(digest_is_sixteen_hexadecimal_digits),
        cmocka_unit_test(write_error_stays_in_the_stream),
        cmocka_unit_test(gap_has_only_its_tick_and_reason),
        cmocka_unit_test(many_splits_or_merges_are_written_as_count_and_digest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
