/* SPDX-License-Identifier: MIT */
/* test_cause_nodes.c - two sessions that differ in their foreign nodes, and the sentence that reports it. */
#include "fixture.h"
#include "session_variant.h"

#define X_BOX(from, to) .box = {{from, -1, -1}, {to, 1, 1}}

static const octree_foreign_node two[] = {{.id = 5, X_BOX(-1, 1)},
                                          {.id = 6, .has_parent = true, .parent = 5, X_BOX(0, 1)}},
                                 outside[] = {{.id = 5, X_BOX(-1, 1)},
                                              {.id = 6, .has_parent = true, .parent = 5, X_BOX(0, 2)}};
static const octree_foreign_tree small = {.nodes = two, .node_count = 1}, right = {.nodes = two, .node_count = 2},
                                 wrong = {.nodes = outside, .node_count = 2};

/* All points but the player are removed, so that none is lost. */
static void give(variant *v, const octree_foreign_tree *tree)
{
    v->session.body_count = 0;
    v->session.edit_count = v->session.query_count = 0;
    v->session.foreign = tree;
    v->session.foreign_count = 1;
}

static void give_small(variant *v)
{
    give(v, &small);
}

static void give_right(variant *v)
{
    give(v, &right);
}

static void give_wrong(variant *v)
{
    give(v, &wrong);
}

static void added_node_is_reported(void **state)
{
    (void)state;
    assert_change_headline_from(
        give_small, give_right,
        "one more foreign node at tick 0 (id 6, parent 5, "
        "box (0, -1, -1) to (1, 1, 1)); tick 0: another number of foreign nodes "
        "(2, was 1), another depth of the foreign nodes (1, was 0), another digest of the foreign nodes "
        "(f49a4f94454fc709, was bb7cba137201538c)");
}

/* ---- Nodes that queries met ----------------------------------------------------------------------------------- */

enum { ASKED = 3 };
static octree_query asked[2][ASKED];
static const uint64_t met_one[] = {5}, met_two[] = {5, 6}, met_other[] = {6}, met_many[] = {5, 6, 5, 6, 5, 6, 5};

/* A ball about one place at each of some ticks, and the nodes that it met there. */
static void ask(variant *v, int side, size_t count, const uint64_t *met, size_t met_count, double x)
{
    give(v, &right);
    for (size_t i = 0; i < count; i++)
        asked[side][i] = (octree_query){.tick = i,
                                        .kind = OCTREE_QUERY_RADIUS,
                                        .target = {x, 0, 0},
                                        .radius = 1,
                                        .visits = {[OCTREE_NODE_VISITED] = {met, met_count}}};
    v->session.queries = asked[side];
    v->session.query_count = count;
}

static void meet_one(variant *v)
{
    ask(v, 0, 1, met_one, 1, 0);
}

static void meet_two(variant *v)
{
    ask(v, 1, 1, met_two, 2, 0);
}

static void meet_another(variant *v)
{
    ask(v, 1, 1, met_other, 1, 0);
}

static void meet_one_always(variant *v)
{
    ask(v, 0, ASKED, met_one, 1, 0);
}

static void meet_two_always(variant *v)
{
    ask(v, 1, ASKED, met_two, 2, 0);
}

static void meet_many_elsewhere(variant *v)
{
    ask(v, 1, 1, met_many, 7, 0.5);
}

/* The query is the same. */
static void different_visited_nodes_are_counted(void **state)
{
    (void)state;
    assert_change_headline_from(
        meet_one, meet_two,
        "the query visited other nodes at tick 0 (visited 2, was 1); tick 0: another number of foreign "
        "nodes visited (2, was 1)");
    assert_change_headline_from(meet_one, meet_another,
                                "the query visited other nodes at tick 0; the ticks that both sides have are equal");
    assert_change_headline_from(
        meet_one_always, meet_two_always,
        "3 queries visited other nodes, the first at tick 0 (visited 2, was 1); tick 0: another number of foreign "
        "nodes visited (2, was 1)");
}

static void long_lists_are_cut(void **state)
{
    (void)state;
    assert_change_headline_from(
        meet_one, meet_many_elsewhere,
        "another query at tick 0 (radius 1, at (0.5, 0, 0), was (0, 0, 0), visited (5, 6, 5, 6 and 3 more), "
        "was (5)); tick 0: another center in the radius query ((0.5, 0, 0), was (0, 0, 0)), another number of "
        "foreign nodes visited (2, was 1)");
}

static void added_wrong_node_is_named_with_its_tick(void **state)
{
    (void)state;
    assert_change_headline_from(give_right, give_wrong,
                                "another foreign node at tick 0 (id 6, parent 5, box (0, -1, -1) to "
                                "(2, 1, 1), was (0, -1, -1) to (1, 1, 1)); tick 0: one more wrong foreign "
                                "node (wrong \"outside_parent\", node 6)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(added_node_is_reported),
        cmocka_unit_test(added_wrong_node_is_named_with_its_tick),
        cmocka_unit_test(different_visited_nodes_are_counted),
        cmocka_unit_test(long_lists_are_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
