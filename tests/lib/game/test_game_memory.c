/* SPDX-License-Identifier: MIT */
/* test_game_memory.c - each allocation of games fails in turn: the game says so at the load or the tick that needed it,
 * plays on to no other end, and gives all memory back.
 */
#include "counting_allocator.h"
#include "fixture.h"
#include "random_session.h"

/* Play to the end, and ask more than was asked. */
static octree_status play(const octree_session *session, octree_game **game)
{
    enum { MORE = 30 };
    octree_query more[MORE];
    for (size_t i = 0; i < MORE; i++)
        more[i] = (octree_query){.kind = OCTREE_QUERY_KNEAREST, .k = i};
    octree_status status = octree_game_create(session, game);
    while (status == OCTREE_OK && !octree_game_over(*game))
        status = octree_game_advance(*game);
    return status == OCTREE_OK ? octree_game_ask(*game, more, MORE) : status;
}

/* Each allocation fails in a game of its own, until one is played that needs no more. Some cost time alone. Returns how
 * many failed. */
static size_t fail_each(octree_session *session)
{
    bool failing = true;
    size_t failed = 0;
    for (; failing; failed++) {
        counting_allocator counts = {0};
        octree_game *game;
        session->tree.allocator = counting_allocator_use(&counts);
        counting_allocator_fail_at(&counts, failed);
        const octree_status status = play(session, &game);
        failing = counts.calls > failed;
        assert_true(status == OCTREE_OK || (failing && status == OCTREE_NO_MEMORY));
        octree_game_destroy(game);
        assert_all_returned(&counts);
    }
    return failed - 1;
}

static void a_random_game_survives_each_failure(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        static random_session made;
        random_session_mixed(&made, seed);
        assert_true(fail_each(&made.session) > 20);
    }
}

enum { SWARM = 300 }; /* enough for moves that are made at once */

/* Shapes, wrong answers of a program, a sweep, and a swarm that moves and shrinks. `half`: the bodies are boxes of this
 * size, and their pairs are listed and compared with wrong ones. */
static void fail_each_of_a_swarm(double half)
{
    static octree_game_body bodies[SWARM];
    static octree_edit edits[SWARM];
    static const uint64_t answer[] = {1, 2, 2, 5000};
    uint64_t random = 1;
    for (size_t i = 0; i < SWARM; i++) {
        bodies[i] = (octree_game_body){.id = i + 1};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = random_between(&random, -9, 9);
            bodies[i].velocity[axis] = random_between(&random, -3, 3);
            bodies[i].half[axis] = half * (double)(i % 4);
        }
        edits[i] = (octree_edit){
            .tick = 2, .kind = OCTREE_EDIT_MOVE, .body = {.id = i + 1, .position = {0, 0, 1e-3 * (double)i}}};
    }
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK,
         .kind = OCTREE_QUERY_KNEAREST,
         .k = 5,
         .answered = true,
         .answer = answer,
         .answer_count = 4},
        {.tick = OCTREE_EVERY_TICK,
         .kind = OCTREE_QUERY_RADIUS,
         .radius = 4,
         .answered = true,
         .answer = answer,
         .answer_count = 1},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-3, -3, -3}, {3, 3, 3}}, .answered = true}};
    static const octree_shape shapes[] = {{.tick = 1, .kind = OCTREE_SHAPE_POINT},
                                          {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_LABEL, .text = "goal"}};
    octree_session session = {
        .tree = define(cube(-10, 10), 4, 8, OCTREE_GROW),
        .player = {.id = 9999, .kind = OCTREE_PLAYER_KEYS, .step = 2, .box_size = 3, .sweep = true},
        .keys = "wdse",
        .bodies = bodies,
        .body_count = SWARM,
        .edits = edits,
        .edit_count = SWARM,
        .queries = queries,
        .query_count = sizeof queries / sizeof *queries,
        .shapes = shapes,
        .shape_count = sizeof shapes / sizeof *shapes};
    static const octree_pair wrong_pairs[] = {{1, 2}, {2, 1}, {1, 5000}, {3, 299}, {7, 9}};
    static const octree_foreign_pairs pairs[] = {{.tick = 1, .pairs = wrong_pairs, .pair_count = 5}, {.tick = 2}};
    session.pairs = half > 0;
    session.foreign_pairs = pairs;
    session.foreign_pairs_count = half > 0 ? 2 : 0;
    assert_true(fail_each(&session) > 20);
}

static void a_swarm_with_wrong_answers_survives_each_failure(void **state)
{
    (void)state;
    fail_each_of_a_swarm(0);
}

static void a_swarm_of_boxes_and_its_pairs_survive_each_failure(void **state)
{
    (void)state;
    fail_each_of_a_swarm(0.125);
}

/* So many bodies on a diagonal that a leaf of 100 lacks room for one: with the player they are the children of one. */
enum { ROW = 100 };

static octree_session row_session(octree_game_body row[ROW])
{
    for (size_t i = 0; i < ROW; i++)
        row[i] = (octree_game_body){.id = i + 1, .position = {-9 + 0.18 * (double)i, -9 + 0.18 * (double)i, 5}};
    return (octree_session){.tree = define(cube(-10, 10), ROW, 8, OCTREE_GROW),
                            .player = {.id = 9999, .position = {-0.5, 9, -9}, .step = 1, .box_size = 0.1},
                            .bodies = row,
                            .body_count = ROW};
}

/* A leaf that more than 64 points are merged into is a block of its own. */
static void what_merges_leaves_survives_each_failure(void **state)
{
    (void)state;
    octree_game_body row[ROW];
    octree_session session = row_session(row);
    const octree_edit edits[] = {{.tick = 3, .kind = OCTREE_EDIT_MOVE, .body = {.id = 1, .position = {9, 9, 9}}},
                                 {.tick = 4, .kind = OCTREE_EDIT_REMOVE, .body = {.id = 2}}};
    session.keys = "da..";
    session.edits = edits;
    session.edit_count = 2;
    assert_true(fail_each(&session) > 20);
}

/* One goes through the player, and none is there at rest; and then one that the player runs into. */
static void a_hit_survives_each_failure(void **state)
{
    (void)state;
    octree_game_body fast = {.id = 1, .position = {8, 0, 0}, .velocity = {-16, 0, 0}};
    octree_session session = {.tree = define(cube(-10, 10), 4, 8, OCTREE_GROW),
                              .player = {.id = 9999, .step = 1, .box_size = 0.5, .sweep = true},
                              .bodies = &fast,
                              .body_count = 1,
                              .ticks = 1};
    octree_game *game = NULL;
    assert_int_equal(play(&session, &game), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->hit_count, 1);
    octree_game_destroy(game);
    assert_true(fail_each(&session) > 2);
    fast = (octree_game_body){.id = 1, .position = {1, 0, 0}};
    session.player.sweep = false;
    session.keys = "d"; /* into it */
    assert_true(fail_each(&session) > 2);
}

static void refusals_by_full_leaves_survive_each_failure(void **state)
{
    (void)state;
    static octree_game_body bodies[SWARM];
    static octree_edit edits[SWARM];
    for (size_t i = 0; i < SWARM; i++) {
        const double z = 9 - (double)i / SWARM;
        bodies[i] =
            (octree_game_body){.id = i + 1, .position = {i % 2 ? 5 : -5, 5, z}, .velocity = {i % 2 ? 0 : 10, 0, 0}};
        edits[i] = (octree_edit){.tick = 2, .kind = OCTREE_EDIT_MOVE, .body = {.id = i + 1, .position = {6, 6, z}}};
    }
    octree_session session = {.tree = define(cube(-10, 10), SWARM / 2, 1, OCTREE_REFUSE),
                              .player = {.id = 9999, .kind = OCTREE_PLAYER_NONE},
                              .bodies = bodies,
                              .body_count = SWARM,
                              .ticks = 1};
    assert_true(fail_each(&session) > 4); /* by their motion */
    for (size_t i = 0; i < SWARM; i++)
        bodies[i].velocity[0] = 0;
    session.ticks = 2;
    session.edits = edits;
    session.edit_count = SWARM;
    assert_true(fail_each(&session) > 4); /* by edits */
    session = (octree_session){.tree = define(cube(-10, 10), 1, 1, OCTREE_REFUSE),
                               .player = {.id = 9999, .position = {-0.5, 1, 1}, .step = 1, .sweep = true},
                               .bodies = bodies + 1,
                               .body_count = 1,
                               .keys = "d"};
    assert_true(fail_each(&session) > 2); /* by a step */
}

/* Each of these has one kind of fault, more than once. */
static void each_fault_of_nodes_survives_each_failure(void **state)
{
    (void)state;
    enum { NODES = 5 };
    static const uint64_t unknown[] = {501, 502, 503, 1, 2}, twice[] = {1, 1, 2, 2, 3, 3, 4}, one[] = {1};
    const octree_foreign_node all = {.id = 1, .box = cube(-10, 10)}, narrow = {.id = 1, .box = cube(-1, 1)};
    const struct {
        octree_foreign_node root;
        const uint64_t *ids;
        size_t count;
        octree_wrong_node_kind kind;
    } rows[] = {{narrow, NULL, 0, OCTREE_NODE_OUTSIDE_PARENT},
                {all, unknown, 5, OCTREE_NODE_UNKNOWN_POINT},
                {all, twice, 7, OCTREE_NODE_REPEATED_POINT},
                {all, one, 1, OCTREE_NODE_LOST_POINT}};
    octree_game_body row[ROW];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        octree_foreign_node nodes[NODES] = {rows[i].root};
        for (size_t n = 1; n < NODES; n++)
            nodes[n] = (octree_foreign_node){.id = n + 1,
                                             .has_parent = true,
                                             .parent = 1,
                                             .box = cube(-9, 9),
                                             .has_points = rows[i].ids != NULL,
                                             .points = {rows[i].ids, rows[i].count}};
        const octree_foreign_tree tree = {.nodes = nodes, .node_count = NODES};
        octree_session session = row_session(row);
        session.foreign = &tree;
        session.foreign_count = 1;
        octree_game *game;
        assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
        assert_true(octree_game_tick(game)->foreign.wrong[rows[i].kind] > 1);
        octree_game_destroy(game);
        assert_true(fail_each(&session) > 10);
    }
}

/* With a promise that many points keep, in doubles and in floats. */
static void what_was_pruned_wrongly_survives_each_failure(void **state)
{
    (void)state;
    static const uint64_t pruned[] = {2}, answer[] = {50, 51};
    const octree_foreign_node nodes[] = {
        {.id = 1, .box = cube(-10, 10)},
        {.id = 2, .has_parent = true, .parent = 1, .box = {{-10, -10, -10}, {0, 10, 10}}},
        {.id = 3, .has_parent = true, .parent = 1, .box = {{0, -10, -10}, {10, 10, 10}}}};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 3};
    octree_query query = {.tick = OCTREE_EVERY_TICK,
                          .kind = OCTREE_QUERY_KNEAREST,
                          .target = {-1, -1, 5},
                          .k = 5,
                          .epsilon = 9,
                          .visits = {[OCTREE_NODE_PRUNED] = {pruned, 1}}};
    octree_game_body row[ROW];
    octree_session session = row_session(row);
    session.foreign = &tree;
    session.foreign_count = 1;
    session.queries = &query;
    session.query_count = 1;
    for (int precision = 0; precision < OCTREE_PRECISIONS; precision++) {
        query.precision = (octree_precision)precision;
        query.answered = precision == OCTREE_FLOATS;
        query.answer = answer;
        query.answer_count = query.answered ? 2 : 0;
        assert_true(fail_each(&session) > 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_game_survives_each_failure),
        cmocka_unit_test(a_swarm_with_wrong_answers_survives_each_failure),
        cmocka_unit_test(a_swarm_of_boxes_and_its_pairs_survive_each_failure),
        cmocka_unit_test(what_merges_leaves_survives_each_failure),
        cmocka_unit_test(a_hit_survives_each_failure),
        cmocka_unit_test(refusals_by_full_leaves_survive_each_failure),
        cmocka_unit_test(each_fault_of_nodes_survives_each_failure),
        cmocka_unit_test(what_was_pruned_wrongly_survives_each_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
