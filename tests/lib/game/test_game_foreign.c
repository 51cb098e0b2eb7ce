/* SPDX-License-Identifier: MIT */
/* test_game_foreign.c - the nodes of a program's own tree: which are a tree, which are in force, and each thing that
 * can be wrong with them by itself; and that nothing is held against a tree that is right. */
#include "fixture.h"
#include "game_fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define IDS(...)                                                                                                       \
    {                                                                                                                  \
        (const uint64_t[]){__VA_ARGS__}, sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t)                    \
    }
#define POINTS(...) .has_points = true, .points = IDS(__VA_ARGS__)
#define UNDER(id) .has_parent = true, .parent = (id)
#define X_BOX(from, to) .box = {{from, -10, -10}, {to, 10, 10}}

static const octree_game_body bodies[] = {{.id = 1, .position = {-8, 0, 0}},
                                          {.id = 2, .position = {-2, 0, 0}},
                                          {.id = 3, .position = {2, 0, 0}},
                                          {.id = 4, .position = {8, 0, 0}}};

/* A tree of intervals on x that is right: two halves, of which the left has two leaves. */
enum { ROOT, LEFT, RIGHT, FAR_LEFT, NEAR_LEFT, NODES };
static const octree_foreign_node right_nodes[NODES] = {
    [ROOT] = {.id = 50, X_BOX(-10, 10), .kind = "inner"},
    [LEFT] = {.id = 7, UNDER(50), X_BOX(-10, 0), .kind = "inner"},
    [RIGHT] = {.id = 60, UNDER(50), X_BOX(0, 10), .kind = "leaf", POINTS(3, 4)},
    [FAR_LEFT] = {.id = 8, UNDER(7), X_BOX(-10, -5), .kind = "leaf", POINTS(1)},
    [NEAR_LEFT] = {.id = 3, UNDER(7), X_BOX(-5, 0), .kind = "leaf", POINTS(2)},
};

static octree_session session_of(const octree_foreign_tree *trees, size_t count)
{
    octree_session session = small_session(bodies, 4);
    session.player.position[2] = 9; /* far from all of them */
    session.ticks = 8;
    session.foreign = trees;
    session.foreign_count = count;
    return session;
}

/* The tick of a query about nodes that are in force from the beginning; it is good until the next. */
static octree_game *last_game;

static const octree_tick *tick_with(const octree_foreign_node *nodes, size_t count, const octree_query *query)
{
    static octree_foreign_tree tree;
    static octree_session session;
    octree_game_destroy(last_game);
    tree = (octree_foreign_tree){.nodes = nodes, .node_count = count};
    session = session_of(&tree, 1);
    session.queries = query;
    session.query_count = query != NULL;
    last_game = start_game(&session);
    return octree_game_tick(last_game);
}

static void assert_faultless(const octree_tick *tick)
{
    for (size_t i = 0; i < tick->foreign.listed_count; i++)
        fail_msg("%s: node %d, point %d", octree_wrong_node_name(tick->foreign.listed[i].kind),
                 (int)tick->foreign.listed[i].node, (int)tick->foreign.listed[i].point);
    assert_int_equal(tick->foreign.wrong_count, 0);
    assert_false(tick->events & OCTREE_EVENT_WRONG);
}

/* That this is all that is wrong. */
static void assert_fault(const octree_tick *tick, octree_wrong_node_kind kind, uint64_t node, uint64_t point)
{
    const octree_foreign_state *f = &tick->foreign;
    assert_int_equal(f->wrong_count, 1);
    assert_int_equal(f->listed_count, 1);
    assert_int_equal(f->wrong[kind], 1);
    assert_int_equal(f->listed[0].kind, kind);
    assert_int_equal(f->listed[0].node, node);
    assert_int_equal(f->listed[0].point, point);
    assert_true(tick->events & OCTREE_EVENT_WRONG);
    for (size_t i = 0; i < f->node_count; i++)
        assert_int_equal(f->nodes[i].wrong, f->nodes[i].node->id == node && node ? 1u << kind : 0);
}

static void a_tree_that_is_right_is_told_and_not_accused(void **state)
{
    (void)state;
    const octree_tick *tick = tick_with(right_nodes, NODES, NULL);
    const octree_foreign_state *f = &tick->foreign;
    assert_faultless(tick);
    assert_true(f->given && f->fresh && f->node_count == NODES && f->leaf_count == 3 && f->depth == 2);
    assert_true(f->nodes[ROOT].points == 4 && f->nodes[LEFT].points == 2 && f->nodes[FAR_LEFT].points == 1);
    assert_true(f->nodes[ROOT].parent == SIZE_MAX && f->nodes[FAR_LEFT].parent == LEFT);
    assert_true(f->nodes[ROOT].depth == 0 && f->nodes[FAR_LEFT].depth == 2 && !f->nodes[LEFT].leaf);
    assert_int_equal(f->kind_count, 2);
    assert_string_equal(f->kinds[f->nodes[RIGHT].kind], "leaf");
    assert_false(play_key(last_game, '.')->foreign.fresh);
    assert_int_equal(octree_game_tick(last_game)->foreign.node_count, NODES);
}

static void nodes_hold_until_others_replace_them(void **state)
{
    (void)state;
    const octree_foreign_node grid[] = {{.id = 1, X_BOX(-10, 0)}, {.id = 2, X_BOX(0, 10)}};
    const octree_foreign_tree trees[] = {{.tick = 2, .nodes = right_nodes, .node_count = NODES},
                                         {.tick = 4},
                                         {.tick = 5, .nodes = grid, .node_count = 2}};
    const size_t counts[] = {0, 0, NODES, NODES, 0, 2, 2};
    const octree_session session = session_of(trees, 3);
    octree_game *game = start_game(&session);
    uint64_t digests[7];
    for (int number = 0; number < 7; number++) {
        const octree_tick *tick = octree_game_tick(game);
        assert_int_equal(tick->foreign.given, number >= 2);
        assert_int_equal(tick->foreign.node_count, counts[number]);
        assert_int_equal(tick->foreign.wrong[OCTREE_NODE_LOST_POINT], number == 4 ? 4 : 0);
        digests[number] = tick->foreign.digest;
        play_key(game, '.');
    }
    assert_true(digests[2] == digests[3] && digests[3] != digests[5] && digests[5] == digests[6]);
    octree_game_destroy(game);
}

static void assert_refused(const octree_foreign_node *nodes, size_t count, octree_status why, size_t at)
{
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = count};
    const octree_session session = session_of(&tree, 1);
    const octree_input input = {.foreign = &tree};
    octree_game *game;
    size_t place;
    assert_int_equal(octree_foreign_check(&tree, &place), why);
    assert_int_equal(place, at);
    assert_int_equal(octree_input_check(&input), why);
    assert_int_equal(octree_game_create(&session, &game), why);
    assert_null(game);
}

static void nodes_that_are_no_tree_are_refused(void **state)
{
    (void)state;
#define ONE(...) &(const octree_foreign_node){__VA_ARGS__}, 1
    assert_refused(ONE(.id = OCTREE_NODE_ID_LIMIT), OCTREE_BAD_SIZE, 0);
    assert_refused(ONE(.has_depth = true, .depth = -1), OCTREE_BAD_SIZE, 0);
    assert_refused(ONE(.box = {{0, NAN, 0}, {0, 0, 0}}), OCTREE_NOT_FINITE, 0);
    assert_refused(ONE(.box = {{0, 0, 0}, {0, INFINITY, 0}}), OCTREE_NOT_FINITE, 0);
    assert_refused(ONE(.box = {{0, 1, 0}, {0, 0, 0}}), OCTREE_BAD_RANGE, 0);
    assert_refused(ONE(.kind = "\a"), OCTREE_BAD_TEXT, 0);
    assert_refused(ONE(.precision = OCTREE_PRECISIONS), OCTREE_BAD_OPTION, 0);
    assert_refused(ONE(.has_points = true, .points = {NULL, 1}), OCTREE_NULL_ARGUMENT, 0);
    assert_refused(ONE(.id = 5, UNDER(5)), OCTREE_BAD_PARENT, 0);
    assert_refused(NULL, 1, OCTREE_NULL_ARGUMENT, 0);
    octree_foreign_node nodes[NODES];
    memcpy(nodes, right_nodes, sizeof nodes);
    nodes[FAR_LEFT].id = 60;
    assert_refused(nodes, NODES, OCTREE_DUPLICATE, FAR_LEFT);
    nodes[FAR_LEFT].id = 8;
    nodes[NEAR_LEFT].parent = 9;
    assert_refused(nodes, NODES, OCTREE_NOT_FOUND, NEAR_LEFT);
    nodes[NEAR_LEFT].parent = 7;
    nodes[LEFT].parent = 8;
    assert_refused(nodes, NODES, OCTREE_BAD_PARENT, LEFT);
    assert_int_equal(octree_foreign_check(&(octree_foreign_tree){.nodes = nodes, .node_count = 0}, NULL), OCTREE_OK);
    const octree_foreign_tree twice[] = {{.tick = 3}, {.tick = 3}};
    const octree_session session = session_of(twice, 2);
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_BAD_ORDER);
    assert_int_equal(octree_foreign_check(NULL, NULL), OCTREE_NULL_ARGUMENT);
}

static void a_depth_that_a_program_tells_is_taken(void **state)
{
    (void)state;
    octree_foreign_node nodes[NODES];
    memcpy(nodes, right_nodes, sizeof nodes);
    nodes[LEFT].has_depth = true;
    nodes[LEFT].depth = 4;
    const uint64_t digest = tick_with(right_nodes, NODES, NULL)->foreign.digest;
    const octree_foreign_state *f = &tick_with(nodes, NODES, NULL)->foreign;
    assert_true(f->nodes[ROOT].depth == 0 && f->nodes[LEFT].depth == 4 && f->nodes[RIGHT].depth == 1);
    assert_true(f->nodes[FAR_LEFT].depth == 5 && f->depth == 5);
    assert_true(f->digest != digest);
}

/* One thing that is otherwise of the right nodes. */
static void change_member(octree_foreign_node nodes[NODES], int member)
{
    static const uint64_t other_point = 2;
    octree_foreign_node *node = &nodes[FAR_LEFT];
    switch (member) {
    case 0:
        node->id++;
        break;
    case 1:
        node->parent = 60;
        break;
    case 2:
        node->has_parent = false;
        break;
    case 3:
        node->box.min[1]--;
        break;
    case 4:
        node->box.max[2]--;
        break;
    case 5:
        node->kind[1] = 'x';
        break;
    case 6:
        node->has_points = false;
        break;
    case 7:
        node->points = (octree_ids){&other_point, 1};
        break;
    default:
        node->precision = OCTREE_FLOATS;
    }
}

static void whatever_a_program_tells_of_a_node_changes_the_digest(void **state)
{
    (void)state;
    const uint64_t digest = tick_with(right_nodes, NODES, NULL)->foreign.digest;
    for (int member = 0; member <= 8; member++) {
        octree_foreign_node nodes[NODES];
        memcpy(nodes, right_nodes, sizeof nodes);
        change_member(nodes, member);
        assert_true(tick_with(nodes, NODES, NULL)->foreign.digest != digest);
    }
    assert_true(tick_with(right_nodes, NODES, NULL)->foreign.digest == digest);
}

static void more_kinds_than_there_is_room_for_are_the_last(void **state)
{
    (void)state;
    octree_foreign_node nodes[OCTREE_NODE_KINDS + 2];
    for (size_t i = 0; i < OCTREE_NODE_KINDS + 2; i++) {
        nodes[i] = (octree_foreign_node){.id = i, X_BOX(-10, 10)};
        nodes[i].kind[0] = (char)('a' + i);
    }
    const octree_foreign_state *f = &tick_with(nodes, OCTREE_NODE_KINDS + 2, NULL)->foreign;
    assert_int_equal(f->kind_count, OCTREE_NODE_KINDS);
    for (size_t i = 0; i < OCTREE_NODE_KINDS + 2; i++)
        assert_int_equal(f->nodes[i].kind, i < OCTREE_NODE_KINDS ? i : OCTREE_NODE_KINDS - 1);
}

static void a_long_chain_of_nodes_is_a_tree(void **state)
{
    (void)state;
    enum { LONG = 100000 };
    octree_foreign_node *nodes = calloc(LONG, sizeof *nodes);
    assert_non_null(nodes);
    for (size_t i = 0; i < LONG; i++)
        nodes[i] =
            (octree_foreign_node){.id = LONG - i, .has_parent = i + 1 < LONG, .parent = LONG - i - 1, X_BOX(-10, 10)};
    assert_faultless(tick_with(nodes, LONG, NULL));
    assert_int_equal(octree_game_tick(last_game)->foreign.depth, LONG - 1);
    nodes[LONG - 1].has_parent = true;
    nodes[LONG - 1].parent = LONG;
    assert_int_equal(octree_foreign_check(&(octree_foreign_tree){.nodes = nodes, .node_count = LONG}, NULL),
                     OCTREE_BAD_PARENT);
    free(nodes);
}

/* In whatever order they come. */
static void two_points_are_found_in_the_nodes_that_list_them(void **state)
{
    (void)state;
    static octree_session session;
    const octree_foreign_node nodes[] = {{.id = 1, X_BOX(-10, 10)},
                                         {.id = 2, UNDER(1), X_BOX(-5, 10), POINTS(2)},
                                         {.id = 3, UNDER(1), X_BOX(-10, -5), POINTS(1)}};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 3};
    session = session_of(&tree, 1);
    session.body_count = 2;
    octree_game_destroy(last_game);
    last_game = start_game(&session);
    assert_faultless(octree_game_tick(last_game));
}

static void each_fault_of_a_node_is_found(void **state)
{
    (void)state;
    octree_foreign_node nodes[NODES];
#define CHANGED(place, ...)                                                                                            \
    (memcpy(nodes, right_nodes, sizeof nodes), nodes[place] = (octree_foreign_node){__VA_ARGS__},                      \
     tick_with(nodes, NODES, NULL))
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 10.5), POINTS(3, 4)), OCTREE_NODE_OUTSIDE_PARENT, 60, 0);
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 10), POINTS(3, 9, 4)), OCTREE_NODE_UNKNOWN_POINT, 60, 9);
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 7), POINTS(3, 4)), OCTREE_NODE_OUTSIDE_POINT, 60, 4);
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 10), POINTS(4, 3, 4, 4)), OCTREE_NODE_REPEATED_POINT, 60,
                 4);
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 10), POINTS(4)), OCTREE_NODE_LOST_POINT, 0, 3);
    assert_fault(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 7)), OCTREE_NODE_LOST_POINT, 0, 4);
    assert_faultless(CHANGED(RIGHT, .id = 60, UNDER(50), X_BOX(0, 10)));
    assert_faultless(CHANGED(ROOT, .id = 50, X_BOX(-1e300, 1e300), POINTS(1, 4)));
    assert_faultless(CHANGED(RIGHT, .id = 60, .box = {{2, 0, 0}, {8, 0, 0}}, POINTS(3, 4)));
    assert_faultless(CHANGED(ROOT, .id = 50, X_BOX(-10, 10), .has_points = true)); /* none */
}

/* A point may be in several nodes, but once in each. */
static void repeated_points_are_told_by_node_and_then_by_point(void **state)
{
    (void)state;
    octree_foreign_node nodes[NODES];
    memcpy(nodes, right_nodes, sizeof nodes);
    nodes[ROOT] = (octree_foreign_node){.id = 50, X_BOX(-10, 10), POINTS(4, 4, 1)};
    nodes[RIGHT] = (octree_foreign_node){.id = 60, UNDER(50), X_BOX(0, 10), POINTS(4, 3, 4, 3)};
    const octree_foreign_state *foreign = &tick_with(nodes, NODES, NULL)->foreign;
    static const uint64_t nodes_and_points[][2] = {{50, 4}, {60, 3}, {60, 4}};
    assert_int_equal(foreign->wrong_count, 3);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(foreign->listed[i].kind, OCTREE_NODE_REPEATED_POINT);
        assert_int_equal(foreign->listed[i].node, nodes_and_points[i][0]);
        assert_int_equal(foreign->listed[i].point, nodes_and_points[i][1]);
    }
}

static void what_moves_out_of_its_leaf_is_found_when_it_does(void **state)
{
    (void)state;
    const octree_foreign_tree tree = {.nodes = right_nodes, .node_count = NODES};
    const octree_edit edits[] = {{.tick = 2, .kind = OCTREE_EDIT_MOVE, .body = {.id = 3, .position = {-1, 0, 0}}},
                                 {.tick = 4, .kind = OCTREE_EDIT_REMOVE, .body = {.id = 3}},
                                 {.tick = 5, .kind = OCTREE_EDIT_INSERT, .body = {.id = 3, .position = {1, 0, 0}}},
                                 {.tick = 6, .kind = OCTREE_EDIT_INSERT, .body = {.id = 6, .position = {1, 1, 1}}}};
    octree_session session = session_of(&tree, 1);
    session.edits = edits;
    session.edit_count = 4;
    octree_game *game = start_game(&session);
    assert_faultless(octree_game_tick(game));
    assert_faultless(play_key(game, '.'));
    assert_fault(play_key(game, '.'), OCTREE_NODE_OUTSIDE_POINT, 60, 3);
    assert_fault(play_key(game, '.'), OCTREE_NODE_OUTSIDE_POINT, 60, 3);
    assert_fault(play_key(game, '.'), OCTREE_NODE_UNKNOWN_POINT, 60, 3);
    assert_faultless(play_key(game, '.'));
    assert_fault(play_key(game, '.'), OCTREE_NODE_LOST_POINT, 0, 6);
    octree_game_destroy(game);
}

/* The double that its text in float is not. */
static void boxes_of_floats_are_compared_in_floats(void **state)
{
    (void)state;
    const octree_game_body near[] = {{.id = 1, .position = {0.1, 0, 0}}, {.id = 2, .position = {next_up(9), 0, 0}}};
    octree_foreign_node nodes[] = {{.id = 1, .box = {{0.1f, 0, 0}, {9, 0, 0}}, POINTS(1)},
                                   {.id = 2, UNDER(1), .box = {{0.1, 0, 0}, {9, 0, 0}}, POINTS(1)}};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 2};
    octree_session session = session_of(&tree, 1);
    session.bodies = near;
    session.body_count = 1;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->foreign.wrong[OCTREE_NODE_OUTSIDE_PARENT], 1);
    assert_int_equal(octree_game_tick(game)->foreign.wrong[OCTREE_NODE_OUTSIDE_POINT], 1);
    octree_game_destroy(game);
    nodes[0].precision = OCTREE_FLOATS;
    game = start_game(&session);
    assert_faultless(octree_game_tick(game));
    octree_game_destroy(game);
    nodes[1] = (octree_foreign_node){.id = 2, UNDER(1), .box = {{next_up(0.1f), 0, 0}, {9, 0, 0}}}; /* by its box */
    nodes[0].has_points = false;
    nodes[1].precision = OCTREE_FLOATS;
    nodes[1].box.min[0] = nextafterf(0.1f, 1);
    game = start_game(&session);
    assert_fault(octree_game_tick(game), OCTREE_NODE_LOST_POINT, 0, 1); /* though it is near enough to be looked at */
    octree_game_destroy(game);
    nodes[0].has_points = nodes[1].has_points = false; /* held by the box alone */
    session.body_count = 2;
    nodes[1].box.min[0] = 0.1f;
    game = start_game(&session);
    assert_faultless(octree_game_tick(game));
    octree_game_destroy(game);
}

#define ASK(...)                                                                                                       \
    &(const octree_query)                                                                                              \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }
#define PRUNED(...) .visits = {[OCTREE_NODE_PRUNED] = IDS(__VA_ARGS__)}

static const octree_tick *right_tick(const octree_query *query)
{
    return tick_with(right_nodes, NODES, query);
}

static void how_queries_met_nodes_is_told(void **state)
{
    (void)state;
    const octree_query query = {
        .kind = OCTREE_QUERY_NEAREST, .target = {3, 0, 0}, .visits = {IDS(50, 60, 50), IDS(7), IDS(60)}};
    const octree_tick *tick = right_tick(&query);
    assert_faultless(tick);
    assert_true(tick->foreign.visits[OCTREE_NODE_VISITED] == 2 && tick->foreign.visits[OCTREE_NODE_PRUNED] == 1);
    assert_int_equal(tick->foreign.nodes[RIGHT].visits, 1 << OCTREE_NODE_VISITED | 1 << OCTREE_NODE_HIT);
    assert_int_equal(tick->foreign.nodes[LEFT].visits, 1 << OCTREE_NODE_PRUNED);
    assert_int_equal(play_key(last_game, '.')->foreign.nodes[RIGHT].visits, 0);
    assert_int_equal(octree_game_tick(last_game)->foreign.visits[OCTREE_NODE_VISITED], 0);
    assert_int_equal(octree_game_ask(last_game, &query, 1), OCTREE_OK);
    assert_int_equal(octree_game_tick(last_game)->foreign.visits[OCTREE_NODE_HIT], 1);
    tick =
        right_tick(ASK(.kind = OCTREE_QUERY_NEAREST, .target = {3, 0, 0}, .visits = {[OCTREE_NODE_HIT] = IDS(60, 61)}));
    assert_fault(tick, OCTREE_NODE_UNKNOWN_NODE, 61, 0);
    assert_int_equal(octree_query_check(ASK(.visits = {{NULL, 1}})), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_query_check(ASK(.visits = {IDS(OCTREE_NODE_ID_LIMIT)})), OCTREE_BAD_SIZE);
}

static void a_node_that_was_pruned_with_a_point_of_the_answer_is_found(void **state)
{
    (void)state;
    const octree_wrong_node_kind pruned = OCTREE_NODE_PRUNED_POINT;
#define RANGE .kind = OCTREE_QUERY_RANGE, .box = { {-3, -1, -1}, {3, 1, 1} }
    assert_faultless(right_tick(ASK(RANGE, PRUNED(8))));
    assert_fault(right_tick(ASK(RANGE, PRUNED(8, 60))), pruned, 60, 3);
    assert_fault(right_tick(ASK(RANGE, PRUNED(7))), pruned, 7, 2);
    assert_int_equal(play_key(last_game, '.')->foreign.nodes[LEFT].wrong, 0); /* it is the query's, of its tick */
    assert_fault(right_tick(ASK(RANGE, PRUNED(7, 8, 3))), pruned, 3, 2);      /* the first from the point up */
    assert_faultless(right_tick(ASK(RANGE, .visits = {IDS(3), IDS(7)})));
    assert_faultless(right_tick(ASK(RANGE, .visits = {IDS(7), IDS(7)})));
    assert_faultless(right_tick(ASK(RANGE, .visits = {[OCTREE_NODE_PRUNED] = IDS(7), [OCTREE_NODE_HIT] = IDS(7)})));
#define NEAR(x, many) .kind = OCTREE_QUERY_KNEAREST, .target = {x, 0, 0}, .k = (many)
    assert_faultless(right_tick(ASK(NEAR(0.5, 1), PRUNED(7))));
    assert_fault(right_tick(ASK(NEAR(0.5, 1), PRUNED(60))), pruned, 60, 3);
    assert_fault(right_tick(ASK(NEAR(0.5, 2), PRUNED(7))), pruned, 7, 2);
    /* Points at the same distance stand for each other. */
    assert_faultless(right_tick(ASK(NEAR(0, 1), .skip = OCTREE_SKIP_COINCIDENT, PRUNED(7))));
    assert_faultless(right_tick(ASK(NEAR(0, 1), .skip = OCTREE_SKIP_COINCIDENT, PRUNED(60))));
    assert_int_equal(right_tick(ASK(NEAR(0, 1), .skip = OCTREE_SKIP_COINCIDENT, PRUNED(7, 60)))->foreign.wrong_count,
                     1);
    /* And what a promise allows is no fault: 2 is 3 away, 3 is 1 away. */
    assert_fault(right_tick(ASK(NEAR(1, 1), .epsilon = 1.9, PRUNED(60))), pruned, 60, 3);
    assert_faultless(right_tick(ASK(NEAR(1, 1), .epsilon = 2, PRUNED(60))));
    assert_int_equal(octree_game_tick(last_game)->answers[0].neighbors[0].point.id, 3);
    assert_fault(right_tick(ASK(NEAR(1, 1), .epsilon = 1.9, .precision = OCTREE_FLOATS, PRUNED(60))), pruned, 60, 3);
    assert_faultless(right_tick(ASK(NEAR(1, 1), .epsilon = 2, .precision = OCTREE_FLOATS, PRUNED(60))));
    assert_faultless(right_tick(ASK(NEAR(1, 1), .epsilon = DBL_MAX, PRUNED(60)))); /* any other is allowed */
}

/* Points 2 and 3 lie on the boundary. */
static void a_node_may_be_pruned_whose_points_lie_on_an_open_boundary(void **state)
{
    const octree_query asked[] = {{.kind = OCTREE_QUERY_RADIUS, .radius = 2, PRUNED(60)},
                                  {.kind = OCTREE_QUERY_RANGE, .box = {{-3, -1, -1}, {2, 1, 1}}, PRUNED(60)}};
    (void)state;
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        octree_query q = asked[i];
        assert_fault(right_tick(&q), OCTREE_NODE_PRUNED_POINT, 60, 3);
        q.bounds = OCTREE_BOUNDS_OPEN;
        assert_faultless(right_tick(&q));
        q.bounds = OCTREE_BOUNDS_EITHER;
        assert_faultless(right_tick(&q));
        q.precision = OCTREE_FLOATS;
        assert_faultless(right_tick(&q));
        q.target[0] = q.box.max[0] = 2.5; /* now point 3 is inside */
        assert_fault(right_tick(&q), OCTREE_NODE_PRUNED_POINT, 60, 3);
    }
}

static void a_point_that_is_held_elsewhere_too_may_be_pruned(void **state)
{
    (void)state;
    octree_foreign_node nodes[NODES];
    memcpy(nodes, right_nodes, sizeof nodes);
    nodes[LEFT] = (octree_foreign_node){.id = 7, UNDER(50), X_BOX(-10, 5), POINTS(3)};
    assert_faultless(tick_with(nodes, NODES, ASK(RANGE, PRUNED(60))));
    assert_fault(tick_with(nodes, NODES, ASK(RANGE, PRUNED(7))), OCTREE_NODE_PRUNED_POINT, 7, 2); /* not of 3 */
    assert_int_equal(tick_with(nodes, NODES, ASK(RANGE, PRUNED(60, 7)))->foreign.wrong[OCTREE_NODE_PRUNED_POINT], 2);
    /* Leaves that do not say: by their boxes. */
    nodes[LEFT] = right_nodes[LEFT];
    nodes[RIGHT].has_points = false;
    assert_fault(tick_with(nodes, NODES, ASK(RANGE, PRUNED(60))), OCTREE_NODE_PRUNED_POINT, 60, 3);
    assert_faultless(tick_with(nodes, NODES, ASK(RANGE, PRUNED(8))));
    /* Those whose boxes do not hold it have no part in it. */
    nodes[FAR_LEFT].has_points = nodes[NEAR_LEFT].has_points = false;
    assert_fault(tick_with(nodes, NODES, ASK(RANGE, PRUNED(3, 8))), OCTREE_NODE_PRUNED_POINT, 3, 2);
    nodes[FAR_LEFT].box.max[0] = -1; /* both have it */
    assert_faultless(tick_with(nodes, NODES, ASK(RANGE, PRUNED(3))));
    /* What others list says nothing of it. */
    nodes[RIGHT].has_points = true;
    nodes[FAR_LEFT] = right_nodes[FAR_LEFT];
    assert_fault(tick_with(nodes, NODES, ASK(RANGE, PRUNED(3))), OCTREE_NODE_PRUNED_POINT, 3, 2);
}

/* No foreign node holds it. */
static void the_player_is_held_against_nobody(void **state)
{
    (void)state;
    const octree_foreign_tree tree = {.nodes = right_nodes, .node_count = NODES};
    const octree_query query = {.kind = OCTREE_QUERY_RANGE, .box = {{-1, -1, 8}, {1, 1, 10}}, PRUNED(50)};
    octree_session session = session_of(&tree, 1);
    session.queries = &query;
    session.query_count = 1;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->answers[0].count, 1);
    assert_faultless(octree_game_tick(game));
    octree_game_destroy(game);
    session.player.kind = OCTREE_PLAYER_BODY;
    session.player.id = 1;
    const octree_query about_it = {.kind = OCTREE_QUERY_RANGE, .box = {{-9, -1, -1}, {-7, 1, 1}}, PRUNED(8)};
    session.queries = &about_it;
    game = start_game(&session);
    assert_fault(octree_game_tick(game), OCTREE_NODE_PRUNED_POINT, 8, 1);
    octree_game_destroy(game);
}

static void a_point_that_moves_is_judged_where_it_is(void **state)
{
    (void)state;
    const octree_foreign_tree tree = {.nodes = right_nodes, .node_count = NODES};
    const octree_query query = {.tick = OCTREE_EVERY_TICK, RANGE, PRUNED(8)};
    const octree_edit edit = {.tick = 1, .kind = OCTREE_EDIT_MOVE, .body = {.id = 1, .position = {-2.5, 0, 0}}};
    octree_session session = session_of(&tree, 1);
    session.queries = &query;
    session.query_count = 1;
    session.edits = &edit;
    session.edit_count = 1;
    octree_game *game = start_game(&session);
    assert_faultless(octree_game_tick(game));
    const octree_tick *tick = play_key(game, '.');
    assert_int_equal(tick->foreign.wrong[OCTREE_NODE_OUTSIDE_POINT], 1);
    assert_int_equal(tick->foreign.wrong[OCTREE_NODE_PRUNED_POINT], 1);
    assert_int_equal(play_key(game, '.')->foreign.wrong_count, 2);
    octree_game_destroy(game);
}

static void faults_are_listed_up_to_a_number_and_all_counted(void **state)
{
    (void)state;
    static const uint64_t ids[] = {1, 2, 3, 4, 99};
    octree_foreign_node nodes[300] = {{.id = 0}};
    for (size_t i = 0; i < 300; i++)
        nodes[i] = (octree_foreign_node){.id = i, X_BOX(-10, 10), .has_points = true, .points = {ids, 5}};
    const octree_foreign_state *f = &tick_with(nodes, 300, NULL)->foreign;
    assert_int_equal(f->wrong_count, 300);
    assert_int_equal(f->wrong[OCTREE_NODE_UNKNOWN_POINT], 300);
    assert_int_equal(f->listed_count, OCTREE_LISTED_WRONG_NODES);
    assert_int_equal(f->listed[99].node, 99);
}

/* Nodes as a program gives them, tick by tick: its arrays are its own again at once. */
static void nodes_are_given_as_they_come_too(void **state)
{
    (void)state;
    octree_session session = session_of(NULL, 0);
    octree_game *game = start_game(&session);
    for (int i = 0; i < 3; i++) {
        uint64_t ids[] = {1, 2, 3, 4};
        octree_foreign_node node = {.id = 5, X_BOX(-10, 10), .has_points = true, .points = {ids, 4}};
        const octree_foreign_tree tree = {.tick = 77, .nodes = &node, .node_count = 1};
        assert_int_equal(octree_game_play(game, &(octree_input){.foreign = &tree}), OCTREE_OK);
        memset(ids, 0xff, sizeof ids);
        memset(&node, 0xff, sizeof node);
        assert_faultless(octree_game_tick(game));
        assert_faultless(play_key(game, '.'));
        assert_int_equal(octree_game_tick(game)->foreign.nodes[0].points, 4);
    }
    octree_game_destroy(game);
}

static int end(void **state)
{
    (void)state;
    octree_game_destroy(last_game);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_that_is_right_is_told_and_not_accused),
        cmocka_unit_test(nodes_hold_until_others_replace_them),
        cmocka_unit_test(nodes_that_are_no_tree_are_refused),
        cmocka_unit_test(a_depth_that_a_program_tells_is_taken),
        cmocka_unit_test(whatever_a_program_tells_of_a_node_changes_the_digest),
        cmocka_unit_test(more_kinds_than_there_is_room_for_are_the_last),
        cmocka_unit_test(a_long_chain_of_nodes_is_a_tree),
        cmocka_unit_test(two_points_are_found_in_the_nodes_that_list_them),
        cmocka_unit_test(each_fault_of_a_node_is_found),
        cmocka_unit_test(repeated_points_are_told_by_node_and_then_by_point),
        cmocka_unit_test(what_moves_out_of_its_leaf_is_found_when_it_does),
        cmocka_unit_test(boxes_of_floats_are_compared_in_floats),
        cmocka_unit_test(how_queries_met_nodes_is_told),
        cmocka_unit_test(a_node_that_was_pruned_with_a_point_of_the_answer_is_found),
        cmocka_unit_test(a_node_may_be_pruned_whose_points_lie_on_an_open_boundary),
        cmocka_unit_test(a_point_that_is_held_elsewhere_too_may_be_pruned),
        cmocka_unit_test(the_player_is_held_against_nobody),
        cmocka_unit_test(a_point_that_moves_is_judged_where_it_is),
        cmocka_unit_test(faults_are_listed_up_to_a_number_and_all_counted),
        cmocka_unit_test(nodes_are_given_as_they_come_too),
    };
    return cmocka_run_group_tests(tests, NULL, end);
}
