/* SPDX-License-Identifier: MIT */
/* test_game_tree_summary.c - what a tick says of its tree, looking at what changed alone, is what a look at all of it
 * says: in trees of many thousand points, of which a tick touches none, a few, a cell full, or nearly all.
 */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "game_fixture.h"
#include "inner_nodes.h"
#include "octree/sample.h"

enum { BODIES = 6000, INSERTED = 6000, EDITS = 6000, TICKS = 60 };

/* A game, the bodies that are in it, and its inner nodes at the tick before. */
typedef struct crowd_game {
    octree_game *game;
    uint64_t random;
    octree_game_body bodies[BODIES + INSERTED];
    size_t count;
    uint64_t next_id;
    octree_edit edits[EDITS];
    size_t edit_count;
    inner_nodes inner;
} crowd_game;

static crowd_game crowd; /* of megabytes */

/* ---- What is expected --------------------------------------------------------------------------------------- */

static void assert_told(crowd_game *c)
{
    const octree *tree = octree_game_tree(c->game);
    const octree_tick *tick = octree_game_tick(c->game);
    octree_stats stats;
    assert_true(tick->tree_digest == octree_digest(tree));
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_memory_equal(&stats, &tick->stats, sizeof stats);
    if (tick->number == 0) /* nothing came before it */
        list_inner_nodes(tree, &c->inner);
    assert_splits_and_merges(tick, tree, &c->inner);
}

/* ---- What happens ------------------------------------------------------------------------------------------- */

static void start_crowd(crowd_game *c, uint64_t seed, size_t capacity, double speed, size_t count)
{
    static double positions[BODIES][3];
    static octree_session session;
    session = (octree_session){.tree = define(cube(-100, 100), capacity, OCTREE_MAX_DEPTH, OCTREE_GROW),
                               .player = {.id = 0, .position = {1, 2, 3}, .step = 7, .box_size = 0},
                               .bodies = c->bodies,
                               .body_count = count};
    *c = (crowd_game){.random = seed, .count = count, .next_id = count + 1};
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, seed, &session.tree.world, count, positions), OCTREE_OK);
    for (size_t i = 0; i < count; i++) {
        c->bodies[i] = (octree_game_body){.id = i + 1, .velocity = {i % 100 ? 0 : speed, 0, 0}};
        memcpy(c->bodies[i].position, positions[i], sizeof positions[i]);
    }
    c->game = start_game(&session);
    assert_told(c);
}

static octree_game_body random_body(crowd_game *c, const double about[3], double reach)
{
    octree_game_body body = {.id = c->next_id++};
    for (int i = 0; i < 3; i++)
        body.position[i] = fmin(fmax(about[i] + random_between(&c->random, -reach, reach), -100), 100);
    return body;
}

static void insert_near(crowd_game *c, size_t count, double reach)
{
    const double about[3] = {random_between(&c->random, -90, 90), random_between(&c->random, -90, 90), 5};
    for (size_t i = 0; i < count && c->count < BODIES + INSERTED && c->edit_count < EDITS; i++) {
        const octree_game_body body = random_body(c, about, reach);
        c->edits[c->edit_count++] = (octree_edit){.kind = OCTREE_EDIT_INSERT, .body = body};
        c->bodies[c->count++] = body;
    }
}

static void remove_some(crowd_game *c, size_t count)
{
    for (size_t i = 0; i < count && c->count > 0 && c->edit_count < EDITS; i++) {
        const size_t which = (size_t)random_below(&c->random, c->count);
        c->edits[c->edit_count++] = (octree_edit){.kind = OCTREE_EDIT_REMOVE, .body = {.id = c->bodies[which].id}};
        c->bodies[which] = c->bodies[--c->count];
    }
}

static void move_some(crowd_game *c, size_t count, double reach)
{
    for (size_t i = 0; i < count && c->count > 0 && c->edit_count < EDITS; i++) {
        octree_game_body *body = &c->bodies[random_below(&c->random, c->count)];
        const octree_game_body moved = random_body(c, body->position, reach);
        memcpy(body->position, moved.position, sizeof body->position);
        c->edits[c->edit_count++] = (octree_edit){.kind = OCTREE_EDIT_MOVE, .body = *body};
    }
}

static void edit_anyhow(crowd_game *c)
{
    c->edit_count = 0;
    switch (random_below(&c->random, 8)) {
    case 0:
        return;
    case 1:
        insert_near(c, 1 + (size_t)random_below(&c->random, 20), 1);
        return;
    case 2:
        insert_near(c, 1500, 2); /* a part becomes several */
        return;
    case 3:
        insert_near(c, 300, 0); /* a leaf that cannot split */
        return;
    case 4:
        remove_some(c, 1 + (size_t)random_below(&c->random, 2000));
        return;
    case 5:
        move_some(c, 10, 0.01);
        return;
    case 6:
        move_some(c, 300, 100);
        return;
    default:
        move_some(c, 5000, 1); /* more than are told apart */
    }
}

static void play_crowd(crowd_game *c)
{
    static const char keys[] = "wasdefn.";
    for (size_t tick = 0; tick < TICKS; tick++) {
        edit_anyhow(c);
        const octree_input input = {
            .key = keys[random_below(&c->random, 8)], .edits = c->edits, .edit_count = c->edit_count};
        assert_int_equal(octree_game_play(c->game, &input), OCTREE_OK);
        assert_told(c);
    }
    octree_game_destroy(c->game);
}

static void what_a_tick_touches_is_enough_to_tell_of_the_tree(void **state)
{
    (void)state;
    static const size_t capacities[] = {1, 8, 64, 2000};
    for (uint64_t seed = 1; seed <= 4; seed++) {
        start_crowd(&crowd, seed, capacities[seed - 1], 0, BODIES);
        play_crowd(&crowd);
    }
}

static void bodies_that_move_by_themselves_are_told_of(void **state)
{
    (void)state;
    start_crowd(&crowd, 5, 8, 0.3, BODIES);
    play_crowd(&crowd);
}

static void a_capacity_that_is_chosen_anew_is_told_of(void **state)
{
    (void)state;
    size_t changes = 0;
    start_crowd(&crowd, 6, OCTREE_AUTO, 0, 900);
    while (crowd.count < BODIES + INSERTED) {
        const size_t before = octree_definition(octree_game_tree(crowd.game)).leaf_capacity;
        crowd.edit_count = 0;
        insert_near(&crowd, 400, crowd.count < 5000 ? 100 : 3);
        const octree_input input = {.edits = crowd.edits, .edit_count = crowd.edit_count};
        assert_int_equal(octree_game_play(crowd.game, &input), OCTREE_OK);
        assert_told(&crowd);
        changes += octree_definition(octree_game_tree(crowd.game)).leaf_capacity != before;
    }
    assert_true(changes > 0);
    octree_game_destroy(crowd.game);
}

static void all_that_is_removed_leaves_a_root_alone(void **state)
{
    (void)state;
    start_crowd(&crowd, 7, 8, 0, BODIES);
    crowd.edit_count = 0;
    remove_some(&crowd, BODIES);
    const octree_input input = {.edits = crowd.edits, .edit_count = crowd.edit_count};
    assert_int_equal(octree_game_play(crowd.game, &input), OCTREE_OK);
    assert_told(&crowd);
    assert_int_equal(octree_game_tick(crowd.game)->stats.points, 1); /* the player */
    assert_int_equal(octree_game_tick(crowd.game)->stats.nodes, 1);
    octree_game_destroy(crowd.game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_tick_touches_is_enough_to_tell_of_the_tree),
        cmocka_unit_test(bodies_that_move_by_themselves_are_told_of),
        cmocka_unit_test(a_capacity_that_is_chosen_anew_is_told_of),
        cmocka_unit_test(all_that_is_removed_leaves_a_root_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
