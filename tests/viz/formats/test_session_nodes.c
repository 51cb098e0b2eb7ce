/* SPDX-License-Identifier: MIT */
/* test_session_nodes.c - foreign nodes in session files survive the round trip, invalid ones are refused, and wrong
 * ones are listed in ticks.jsonl. */
#include "fixture.h"
#include "session_file.h"
#include "session_texts.h"
#include "ticks_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[-5,0,0],[5,0,0]],\n\"ticks\":3"
#define ROOT "{\"id\":9,\"box\":{\"min\":[-10,-10,-10],\"max\":[10,10,10]}}"
#define LEAF(rest) "{\"id\":4,\"parent\":9,\"box\":{\"min\":[0,-1,-1],\"max\":[10,1,1]}" rest "}"

static void nodes_are_read_with_all_members(void **state)
{
    (void)state;
    session_file file = session_of_text(HEADER ",\"foreign_nodes\":[" ROOT
                                               "," LEAF(",\"points\":[2,7],\"kind\":\"leaf\",\"depth\":3,"
                                                        "\"mode\":\"float\"") "]}\n{\"tick\":2,\"foreign_nodes\":[]}");
    const octree_session *s = &file.session;
    assert_int_equal(s->foreign_count, 2);
    assert_true(s->foreign[0].tick == 0 && s->foreign[0].node_count == 2);
    assert_true(s->foreign[1].tick == 2 && s->foreign[1].node_count == 0);
    const octree_foreign_node *root = s->foreign[0].nodes, *leaf = root + 1;
    assert_true(root->id == 9 && !root->has_parent && !root->has_depth && !root->has_points && !*root->kind);
    assert_true(leaf->id == 4 && leaf->has_parent && leaf->parent == 9 && leaf->has_depth && leaf->depth == 3);
    assert_true(leaf->has_points && leaf->points.count == 2 && leaf->points.ids[1] == 7);
    assert_string_equal(leaf->kind, "leaf");
    assert_true(leaf->precision == OCTREE_FLOATS && leaf->box.max[0] == 10);
    session_release(&file);
}

static void nodes_and_visits_survive_the_round_trip(void **state)
{
    (void)state;
    session_file file = session_of_text(
        HEADER
        ",\"queries\":[{\"radius\":1,\"at\":[0,0,0],\"hit\":[4]}]}\n"
        "{\"tick\":0,\"foreign_nodes\":[" LEAF(
            ",\"points\":[]") "," ROOT "]}\n"
                              "{\"tick\":1,\"queries\":[{\"nearest\":[1,2,3],\"visited\":[9,4],\"pruned\":[8],\"mode\":"
                              "\"float\"}],"
                              "\"foreign_nodes\":[" ROOT "," LEAF(
                                  ",\"points\":[1],\"depth\":1,\"kind\":\"a b\"") "]}\n"
                                                                                  "{\"tick\":3,\"foreign_nodes\":[]}");
    session_file copy, again;
    octreel_error error;
    assert_true(session_copy(&file.session, &copy, &error));
    char *text = text_of_session(&copy.session, NULL);
    session_release(&file);
    again = session_of_text(text);
    char *second = text_of_session(&again.session, NULL);
    assert_string_equal(text, second);
    assert_non_null(strstr(text, "\n{\"tick\": 0, \"foreign_nodes\": [{\"id\": 4, \"parent\": 9, \"box\": "));
    assert_non_null(strstr(text, "\"points\": []"));
    assert_non_null(strstr(text, "\"visited\": [9, 4], \"pruned\": [8], \"mode\": \"float\""));
    assert_non_null(strstr(text, "\"points\": [1], \"kind\": \"a b\""));
    assert_non_null(strstr(text, "\n{\"tick\": 3, \"foreign_nodes\": []}\n"));
    assert_int_equal(again.session.foreign_count, 3);
    free(text);
    free(second);
    session_release(&copy);
    session_release(&again);
}

static void invalid_nodes_are_refused_with_line_and_member(void **state)
{
    (void)state;
    assert_session_refused(HEADER ",\n\"foreign_nodes\":{}}",
                           "s.json:3: foreign_nodes: expected a list of nodes, found an object");
    assert_session_refused(HEADER ",\n\"foreign_nodes\":[" ROOT ",\n5]}",
                           "s.json:4: foreign_nodes[1]: expected an object, found 5");
    assert_session_refused(HEADER ",\"foreign_nodes\":[{\"id\":5}]}",
                           "s.json:2: foreign_nodes[0]: the member \"box\" is missing");
    assert_session_refused(HEADER ",\"foreign_nodes\":[" ROOT ",\n" ROOT "]}",
                           "s.json:3: foreign_nodes[1]: id 9 already belongs to another node");
    assert_session_refused(HEADER "}\n{\"tick\":1,\"foreign_nodes\":[" LEAF("") "]}",
                           "s.json:3: foreign_nodes[0]: the parent of node 4 is 9, but this list has no such node");
    assert_session_refused(HEADER
                           ",\"foreign_nodes\":[{\"id\":1,\"parent\":2,\"box\":{\"min\":[0,0,0],\"max\":[0,0,0]}},\n"
                           "{\"id\":2,\"parent\":1,\"box\":{\"min\":[0,0,0],\"max\":[0,0,0]}}]}",
                           "s.json:2: foreign_nodes[0]: node 1 is its own ancestor");
    assert_session_refused(HEADER ",\"foreign_nodes\":[]}\n{\"tick\":0,\"foreign_nodes\":[]}",
                           "s.json:3: foreign_nodes: the header already has the nodes of tick 0");
    assert_session_refused(
        HEADER ",\"foreign_nodes\":[" LEAF(",\"points\":[1,-1]") "]}",
        "s.json:2: foreign_nodes[0].points[1]: expected a whole number from 0 to 9007199254740991, found -1");
    assert_session_refused(HEADER ",\"foreign_nodes\":[" LEAF(",\"points\":7") "]}",
                           "s.json:2: foreign_nodes[0].points: expected a list of ids, found 7");
    assert_session_refused(HEADER ",\"foreign_nodes\":[" LEAF(",\"kind\":\"1234567890123456\"") "]}",
                           "s.json:2: foreign_nodes[0].kind: a node's kind may have at most 15 characters, but has 16");
    assert_session_refused(
        HEADER ",\"foreign_nodes\":[" LEAF(",\"colour\":7") "]}",
        "s.json:2: foreign_nodes[0]: unknown member \"colour\"; known: id, parent, box, depth, points, kind, mode");
    assert_session_refused(
        HEADER ",\"queries\":[{\"nearest\":[0,0,0],\"pruned\":[1,\n\"a\"]}]}",
        "s.json:3: queries[0].pruned[1]: expected a whole number from 0 to 9007199254740991, found \"a\"");
}

/* Without has_points, the list of ids is not read: here it is a null pointer with a count of 7. */
static void copy_ignores_points_without_has_points(void **state)
{
    (void)state;
    const octree_foreign_node node = {.id = 1, .points = {NULL, 7}};
    const octree_foreign_tree tree = {.tick = 4, .nodes = &node, .node_count = 1};
    octree_foreign_tree copy;
    assert_int_equal(octree_foreign_check(&tree, NULL), OCTREE_OK);
    assert_true(foreign_tree_duplicate(&tree, &copy));
    assert_true(copy.tick == 4 && copy.node_count == 1 && copy.nodes[0].points.count == 0);
    foreign_tree_release(&copy);
}

static char *write_tick(const octree_session *session)
{
    octree_game *game;
    char *text;
    size_t size;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
    assert_int_equal(fclose(out), 0);
    octree_game_destroy(game);
    return text;
}

static void ticks_list_foreign_nodes_and_wrong_nodes(void **state)
{
    (void)state;
    session_file file = session_of_text(HEADER ",\"foreign_nodes\":[" ROOT "," LEAF(
        ",\"points\":[1,2,3]") "],"
                               "\"queries\":[{\"nearest\":[4,0,0],\"visited\":[9],\"pruned\":[4,5]}]}");
    char *text = write_tick(&file.session);
    const char *at = strstr(text, "\"foreign_nodes\": {\"count\": 2, \"leaves\": 1, \"depth\": 1, \"digest\": \"");
    assert_non_null(at);
    assert_non_null(strstr(text, "\"events\": [\"wrong\"]"));
    at = strstr(at, "\", \"visited\": 1");
    assert_non_null(at);
    static const char rest[] =
        "\", \"visited\": 1, \"pruned\": 1, \"hit\": 0, \"wrong\": {\"count\": 4, \"unknown_point\": 1, "
        "\"outside_point\": 1, "
        "\"unknown_node\": 1, \"pruned_point\": 1, \"first\": ["
        "{\"wrong\": \"outside_point\", \"node\": 4, \"point\": 1}, "
        "{\"wrong\": \"unknown_point\", \"node\": 4, \"point\": 3}, "
        "{\"wrong\": \"unknown_node\", \"node\": 5, \"answer\": 0}, "
        "{\"wrong\": \"pruned_point\", \"node\": 4, \"point\": 2, \"answer\": 0}]}}, \"refusals\"";
    if (strncmp(at, rest, strlen(rest)) != 0)
        fail_msg("%s", at);
    free(text);
    file.session.foreign_count = 0;
    text = write_tick(&file.session);
    assert_null(strstr(text, "\"foreign_nodes\": {\"count\""));
    file.session.foreign_count = 1;
    free(text);
    session_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_are_read_with_all_members),
        cmocka_unit_test(nodes_and_visits_survive_the_round_trip),
        cmocka_unit_test(copy_ignores_points_without_has_points),
        cmocka_unit_test(invalid_nodes_are_refused_with_line_and_member),
        cmocka_unit_test(ticks_list_foreign_nodes_and_wrong_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
