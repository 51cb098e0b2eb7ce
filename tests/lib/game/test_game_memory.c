/* SPDX-License-Identifier: MIT */
/* test_game_memory.c - each allocation of games fails in turn: the game says so at the load or the tick that needed it,
 * plays on to no other end, and gives all memory back.
 */
#include "counting_allocator.h"
#include "fixture.h"
#include "random_session.h"

/* Play to the end. */
static octree_status play(const octree_session *session, octree_game **game)
{
    octree_status status = octree_game_create(session, game);
    while (status == OCTREE_OK && !octree_game_over(*game))
        status = octree_game_advance(*game);
    return status;
}

/* From its n-th allocation on every `step`-th fails in a game of its own, until one is played that needs no more.
 * Returns how many failed. */
static size_t fail_each(octree_session *session, size_t step)
{
    octree_status status = OCTREE_NO_MEMORY;
    size_t failed = 0;
    for (size_t n = 0; status != OCTREE_OK; n += step, failed++) {
        counting_allocator counts = {0};
        octree_game *game;
        session->tree.allocator = counting_allocator_use(&counts);
        counting_allocator_fail_at(&counts, n);
        status = play(session, &game);
        assert_true(status == OCTREE_OK || status == OCTREE_NO_MEMORY);
        octree_game_destroy(game);
        assert_all_returned(&counts);
    }
    return failed - 1;
}

static void a_random_game_survives_each_failure(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        static random_session made;
        random_session_full(&made, seed);
        assert_true(fail_each(&made.session, 1) > 20);
    }
}

enum { SWARM = 600 }; /* enough for moves that are made at once */

/* What random sessions have not: shapes, wrong answers of a program, a sweep, and a swarm that moves and shrinks. */
static void a_swarm_with_wrong_answers_survives_each_failure(void **state)
{
    (void)state;
    static octree_body bodies[SWARM];
    static octree_edit edits[SWARM];
    static const uint64_t answer[] = {1, 2, 2, 5000};
    uint64_t random = 1;
    for (size_t i = 0; i < SWARM; i++) {
        bodies[i] = (octree_body){.id = i + 1};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = random_between(&random, -9, 9);
            bodies[i].velocity[axis] = random_between(&random, -3, 3);
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
    assert_true(fail_each(&session, 1) > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_game_survives_each_failure),
        cmocka_unit_test(a_swarm_with_wrong_answers_survives_each_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
