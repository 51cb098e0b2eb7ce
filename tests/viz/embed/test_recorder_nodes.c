/* SPDX-License-Identifier: MIT */
/* test_recorder_nodes.c - the nodes of a foreign index, and how its queries visited them, are recorded with a tick. */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

static const octree_point points[] = {{{-4, 0, 0}, 10}, {{4, 0, 0}, 11}};

/* A root with one leaf on each side of x = 0. */
static const octree_foreign_node halves[] = {
    {.id = 1, .box = {{-8, -8, -8}, {8, 8, 8}}},
    {.id = 2, .has_parent = true, .parent = 1, .box = {{-8, -8, -8}, {0, 8, 8}}, .kind = "leaf"},
    {.id = 3, .has_parent = true, .parent = 1, .box = {{0, -8, -8}, {8, 8, 8}}, .kind = "leaf"},
};
static const octree_foreign_tree two_leaves = {.nodes = halves, .node_count = 3},
                                 one_node = {.nodes = halves, .node_count = 1}, no_node = {.nodes = NULL};

/* Record a query for the nearest point on the left, which prunes one leaf. */
static octreel_status tick(octreel_recorder *recorder, const octree_foreign_tree *foreign, uint64_t pruned)
{
    uint64_t answer = 10, visited[] = {1, 5 - pruned};
    const octree_query query = {.kind = OCTREE_QUERY_NEAREST,
                                .target = {-3, 0, 0},
                                .answered = true,
                                .answer = &answer,
                                .answer_count = 1,
                                .visits[OCTREE_NODE_VISITED] = {visited, 2},
                                .visits[OCTREE_NODE_PRUNED] = {&pruned, 1}};
    const octreel_tick_info about = {
        .points = points, .point_count = 2, .queries = &query, .query_count = pruned ? 1 : 0, .foreign = foreign};
    return octreel_recorder_tick(recorder, NULL, &about);
}

/* Append the number of current nodes of a tick; '-' if there are none, 'W' if something is wrong. */
static void note_nodes(const char *line, size_t number, void *context)
{
    static const char counted[] = "\"foreign_nodes\": {\"count\": ";
    const char *nodes = strstr(line, counted);
    char *told = context;
    (void)number;
    snprintf(told + strlen(told), 4, "%s%.1s", strstr(line, "\"wrong\"]") ? "W" : "",
             nodes ? nodes + strlen(counted) : "-");
}

static void nodes_are_recorded_with_ticks_and_checked(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(tick(recorder, NULL, 0), OCTREEL_OK);
    assert_int_equal(tick(recorder, &two_leaves, 3), OCTREEL_OK);
    assert_int_equal(tick(recorder, NULL, 2), OCTREEL_OK); /* prunes the leaf that holds the answer */
    assert_int_equal(tick(recorder, &one_node, 0), OCTREEL_OK);
    assert_int_equal(tick(recorder, &two_leaves, 3), OCTREEL_OK);
    assert_int_equal(tick(recorder, &no_node, 0), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_nodes, "-3W313W0");
    assert_films_again(&folder, &again, 6);
}

static void nodes_of_tick_0_are_recorded(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(tick(recorder, &two_leaves, 3), OCTREEL_OK);
    assert_int_equal(tick(recorder, NULL, 3), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_nodes, "33");
    assert_films_again(&folder, &again, 2);
}

/* Nodes passed before the first tick of the ring are still current in it. */
static void ring_remembers_the_current_nodes(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    octreel_recorder *recorder = open_recorder_without_frames(NULL, 2);
    assert_int_equal(tick(recorder, &two_leaves, 0), OCTREEL_OK);
    for (int i = 0; i < 5; i++)
        assert_int_equal(tick(recorder, NULL, 3), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_nodes, "33");
    assert_films_again(&folder, &again, 2);
}

static void nodes_of_a_refused_tick_are_recorded_with_the_next(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const octree_query bad = {.kind = OCTREE_QUERY_NEAREST, .target = {NAN}};
    octreel_tick_info about = {.queries = &bad, .query_count = 1, .foreign = &two_leaves};
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(tick(recorder, NULL, 3), OCTREEL_OK);
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_BAD_QUERY);
    assert_int_equal(tick(recorder, &one_node, 0), OCTREEL_OK);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    assert_noted_lines(folder.path, note_nodes, "-3-1");
    assert_films_again(&folder, &again, 4);
}

static void assert_bad(octreel_recorder *recorder, octree_foreign_node node, const char *sentence)
{
    octree_foreign_node nodes[] = {halves[0], node};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 2};
    assert_int_equal(tick(recorder, &tree, 0), OCTREEL_BAD_NODE);
    if (strncmp(octreel_recorder_error(recorder), sentence, strlen(sentence)) != 0)
        fail_msg("%s", octreel_recorder_error(recorder));
}

static void invalid_nodes_are_refused_with_their_index(void **state)
{
    const place folder = place_in(*state, "film");
    uint64_t large = UINT64_C(1) << 53;
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_bad(recorder, (octree_foreign_node){.id = 1}, "nodes[1]: ");
    assert_bad(recorder, (octree_foreign_node){.id = 2, .box = {{NAN}, {0}}}, "nodes[1]: ");
    assert_bad(recorder, (octree_foreign_node){.id = 2, .has_parent = true, .parent = 2}, "nodes[1]: ");
    assert_bad(recorder, (octree_foreign_node){.id = 2, .has_points = true, .points = {&large, 1}},
               "nodes[1]: an id is 2^53 or larger");
    octreel_recorder_destroy(recorder);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(nodes_are_recorded_with_ticks_and_checked),  TEST(nodes_of_tick_0_are_recorded),
        TEST(ring_remembers_the_current_nodes),           TEST(nodes_of_a_refused_tick_are_recorded_with_the_next),
        TEST(invalid_nodes_are_refused_with_their_index),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
