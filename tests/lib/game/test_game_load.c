/* SPDX-License-Identifier: MIT */
/* test_game_load.c - bodies that a session begins with, which are loaded at once, are in the game as if each had been
 * inserted after the other: by edits of the first tick.
 */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "game_fixture.h"

enum { BODIES = 400 };

/* One in a few cannot be in the game; and the id of one that cannot may be used again. */
static octree_game_body random_body(uint64_t *random, const octree_game_body *before, size_t i)
{
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1.5, -0.0};
    const double strange = odd[random_below(random, 5)];
    octree_game_body body = {.id = i + 1};
    for (int axis = 0; axis < 3; axis++) /* few places: leaves are full soon, and stay so where they cannot split */
        body.position[axis] = (double)random_below(random, 7) / 4 - 0.75;
    switch (random_below(random, 6)) {
    case 0:
        body.position[random_below(random, 3)] = strange;
        break;
    case 1:
        body.velocity[random_below(random, 3)] = NAN;
        break;
    case 2:
        body.id = i > 0 && isnan(before[i - 1].velocity[0]) ? before[i - 1].id : body.id;
        break;
    default:
        break;
    }
    return body;
}

static void assert_same_refusals(const octree_tick *loaded, const octree_tick *inserted)
{
    assert_int_equal(loaded->refusal_count, inserted->refusal_count);
    for (size_t i = 0; i < loaded->refusal_count; i++) {
        const octree_refusal *a = &loaded->refusals[i], *b = &inserted->refusals[i];
        assert_true(a->id == b->id && a->why == b->why);
        assert_memory_equal(a->position, b->position, sizeof a->position);
    }
}

/* Nothing moves: an edit comes before the motion of its tick. */
static void assert_loads_as_inserted(octree_session session)
{
    static octree_edit edits[BODIES];
    for (size_t i = 0; i < session.body_count; i++)
        edits[i] = (octree_edit){.kind = OCTREE_EDIT_INSERT, .body = session.bodies[i]};
    const octree_input input = {.edits = edits, .edit_count = session.body_count};
    octree_game *loaded = start_game(&session);
    session.body_count = 0;
    octree_game *inserted = start_game(&session);
    assert_int_equal(octree_game_play(inserted, &input), OCTREE_OK);
    assert_same_refusals(octree_game_tick(loaded), octree_game_tick(inserted));
    assert_true(octree_game_tick(loaded)->tree_digest == octree_game_tick(inserted)->tree_digest);
    assert_valid(octree_game_tree(loaded));
    octree_game_destroy(loaded);
    octree_game_destroy(inserted);
}

static void bodies_are_loaded_as_if_one_after_the_other(void **state)
{
    static octree_game_body bodies[BODIES];
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t random = seed;
        for (size_t i = 0; i < BODIES; i++)
            bodies[i] = random_body(&random, bodies, i);
        const octree_full_leaf full = seed % 3 ? OCTREE_REFUSE : OCTREE_GROW;
        assert_loads_as_inserted((octree_session){.tree = define(cube(-1, 1), 1 + seed % 4, 1 + seed % 3, full),
                                                  .player = {.id = BODIES + 1, .step = 1, .box_size = 0.1},
                                                  .bodies = bodies,
                                                  .body_count = BODIES});
    }
}

static void an_id_that_was_refused_can_be_used_again(void **state)
{
    const octree_game_body bodies[] = {{.id = 1, .position = {0, 0, NAN}},
                                       {.id = 1, .position = {0.5, 0, 0}, .velocity = {0, NAN, 0}},
                                       {.id = 2, .position = {2, 0, 0}},
                                       {.id = 1, .position = {0.25, 0, 0}}};
    const octree_session session = {.tree = define(cube(-1, 1), 4, 5, OCTREE_REFUSE),
                                    .player = {.kind = OCTREE_PLAYER_NONE},
                                    .bodies = bodies,
                                    .body_count = 4};
    (void)state;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->refusal_count, 3);
    assert_int_equal(tick->refusals[0].why, OCTREE_NOT_FINITE);
    assert_int_equal(tick->refusals[1].why, OCTREE_NOT_FINITE);
    assert_int_equal(tick->refusals[2].why, OCTREE_OUTSIDE);
    assert_int_equal(tick->stats.points, 1);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_are_loaded_as_if_one_after_the_other),
        cmocka_unit_test(an_id_that_was_refused_can_be_used_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
