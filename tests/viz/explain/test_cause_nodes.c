/* SPDX-License-Identifier: MIT */
/* test_cause_nodes.c - two sessions that differ in the nodes of a program's own tree, and the line that says so. */
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

static void a_node_more_is_told(void **state)
{
    (void)state;
    assert_says_of(give_small, give_right,
                   "one more node of the program at tick 0 (id 6, parent 5, "
                   "box (0, -1, -1) to (1, 1, 1)); tick 0: another number of the program's nodes "
                   "(2, was 1), another depth of the program's tree (1, was 0), another tree of the program "
                   "(f49a4f94454fc709, was bb7cba137201538c)");
}

static void a_fault_more_is_told_with_its_tick(void **state)
{
    (void)state;
    assert_says_of(give_right, give_wrong,
                   "another node of the program at tick 0 (id 6, parent 5, box (0, -1, -1) to "
                   "(2, 1, 1), was (0, -1, -1) to (1, 1, 1)); tick 0: one more fault in the "
                   "program's nodes (fault \"outside_parent\", node 6)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_node_more_is_told),
        cmocka_unit_test(a_fault_more_is_told_with_its_tick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
