/* SPDX-License-Identifier: MIT */
/* test_game_paper.c - our game against the paper's loop upon the paper's algorithms: the same positions, collisions and
 * nearest neighbours at every tick. Where the paper's text is at fault the difference is shown. */
#include "fixture.h"

#include "game_fixture.h"
#include "paper_game.h"
#include "random_session.h"

static bool happened(const octree_tick *tick, octree_event event)
{
    return (tick->events & event) != 0;
}

/* Collisions agree wherever the step could be made. Into a full leaf the paper's loop has no collision test: its
 * Algorithm 5 needs the moving point inside. */
static void compare_events(const octree_tick *ours, const paper_game *theirs)
{
    assert_true(happened(ours, OCTREE_EVENT_MOVED) == theirs->moved);
    assert_true(happened(ours, OCTREE_EVENT_REFUSED) == theirs->refused);
    if (theirs->full) {
        assert_true(happened(ours, OCTREE_EVENT_FULL) || happened(ours, OCTREE_EVENT_COLLIDED));
        return;
    }
    assert_true(happened(ours, OCTREE_EVENT_COLLIDED) == theirs->collided);
    assert_int_equal(ours->hit_count, theirs->hits);
}

/* The paper leaves out whatever lies at the player's coordinates; we leave out the player. Of neighbours at one
 * distance the paper names the first it meets, and we the lowest id. */
static void compare_nearest(const octree_game *game, const paper_game *theirs)
{
    const octree_tick *tick = octree_game_tick(game);
    octree_neighbor ours;
    octree_status status = octree_nearest(octree_game_tree(game), tick->player, OCTREE_SKIP_COINCIDENT, 0, &ours);
    assert_int_equal(status, theirs->found ? OCTREE_OK : OCTREE_NOT_FOUND);
    if (theirs->found)
        assert_true(ours.distance == theirs->distance);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_answer *answer = &tick->answers[i];
        if (answer->kind != OCTREE_QUERY_NEAREST || answer->count == 0 || answer->neighbors[0].distance == 0)
            continue;
        assert_true(theirs->found);
        assert_true(answer->neighbors[0].distance == theirs->distance);
    }
}

static void compare_tick(const octree_game *game, const paper_game *theirs)
{
    const octree_tick *ours = octree_game_tick(game);
    assert_true(same_position(ours->player, theirs->player.position));
    if (ours->number > 0)
        compare_events(ours, theirs);
    compare_nearest(game, theirs);
}

/* Play both. Returns the events that were met. */
static unsigned play_both(const octree_session *session)
{
    octree_game *game = start_game(session);
    paper_game theirs;
    size_t refused = paper_game_start(&theirs, session);
    assert_int_equal(octree_game_tick(game)->refusal_count, refused);
    assert_true(happened(octree_game_tick(game), OCTREE_EVENT_COLLIDED) == theirs.collided);
    assert_int_equal(octree_game_tick(game)->hit_count, theirs.hits);
    compare_tick(game, &theirs);
    unsigned met = 0;
    while (!octree_game_over(game)) {
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        paper_game_play_key(&theirs, octree_game_tick(game)->key);
        compare_tick(game, &theirs);
        met |= octree_game_tick(game)->events;
    }
    paper_game_end(&theirs);
    octree_game_destroy(game);
    return met;
}

static void the_default_session_plays_as_in_the_paper(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    assert_int_equal(play_both(&session), OCTREE_EVENT_WRONG - 1);
}

/* The crowded corner, while the player is there. */
static void the_default_session_asks_once_a_tick(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    assert_int_equal(session.query_count, 12);
    for (uint64_t i = 0; i < 12; i++)
        assert_true(session.queries[i].tick == 212 + i && session.queries[i].kind == OCTREE_QUERY_RANGE);
}

static void a_hundred_random_sessions_play_as_in_the_paper(void **state)
{
    (void)state;
    static random_session made;
    unsigned met = 0;
    for (uint64_t seed = 1; seed <= 100; seed++) {
        random_session_plain(&made, seed);
        met |= play_both(&made.session);
    }
    assert_int_equal(met, OCTREE_EVENT_WRONG - 1); /* else the comparison shows too little */
}

/* A world of one leaf that holds one point beside the player, with the player next to it. */
static octree_session crowded_session(const octree_game_body *body)
{
    octree_session session = {.tree = define(cube(-8, 8), 2, 0, OCTREE_REFUSE)};
    session.player = (octree_player){.id = 100, .position = {-1, 0, 0}, .step = 1, .box_size = 0.5};
    session.bodies = body;
    session.body_count = 1;
    return session;
}

/* The paper's loop as printed does not keep its player in the tree; Algorithm 5 inserts it for the test. Give the tree
 * that the session's other points make. */
static paper_octree tree_without_player(const octree_session *session, size_t capacity)
{
    paper_octree octree = createOctree(session->tree.world, capacity, session->tree.max_depth);
    for (size_t i = 0; i < session->body_count; i++) {
        const double *at = session->bodies[i].position;
        octree_point point = {{at[0], at[1], at[2]}, session->bodies[i].id};
        assert_true(insertPoint(&octree, octree.root, &point));
    }
    return octree;
}

static void at_fault_the_paper_steps_onto_a_point_in_a_full_leaf_and_deletes_it(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 1, .position = {0, 0, 0}}};
    octree_session session = crowded_session(body);
    paper_octree octree = tree_without_player(&session, 1); /* full without the player */
    const octree_point step_end = {{0, 0, 0}, 100};
    assert_false(detect_collision(&octree, &step_end, 0.5)); /* not inserted: count is 1, no collision is seen */
    assert_null(searchPoint(octree.root, &step_end));        /* and what was there is deleted */
    freeOctree(&octree);
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, 'd');
    assert_true(happened(tick, OCTREE_EVENT_COLLIDED));
    assert_true(tick->player[0] == -1);
    assert_true(octree_contains(octree_game_tree(game), body[0].position, 1));
    octree_game_destroy(game);
}

static void at_fault_the_paper_does_not_name_a_neighbour_at_the_player(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 1, .position = {-1, 0, 0}}};
    octree_session session = crowded_session(body);
    octree_game *game = start_game(&session);
    paper_game theirs;
    paper_game_start(&theirs, &session);
    const octree_answer *answer = &play_key(game, 'n')->answers[0];
    assert_false(theirs.found);
    assert_true(answer->count == 1 && answer->neighbors[0].point.id == 1 && answer->neighbors[0].distance == 0);
    paper_game_end(&theirs);
    octree_game_destroy(game);
}

static void at_fault_a_rounded_box_collides_where_the_real_one_does_not(void **state)
{
    (void)state;
    /* The double 0.1 + 0.2 is more than 0.2 away from 0.1; the rounded corner of Equation 4 lies exactly on it. */
    static const octree_game_body body[] = {{.id = 1, .position = {0.1 + 0.2, 0, 0}}};
    octree_session session = crowded_session(body);
    session.player = (octree_player){.id = 100, .position = {0.1, 0, 0}, .step = 1, .box_size = 0.2};
    octree_game *game = start_game(&session);
    paper_game theirs;
    paper_game_start(&theirs, &session);
    assert_true(theirs.collided);
    assert_int_equal(octree_game_tick(game)->hit_count, 0);
    paper_game_end(&theirs);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_session_plays_as_in_the_paper),
        cmocka_unit_test(the_default_session_asks_once_a_tick),
        cmocka_unit_test(a_hundred_random_sessions_play_as_in_the_paper),
        cmocka_unit_test(at_fault_the_paper_steps_onto_a_point_in_a_full_leaf_and_deletes_it),
        cmocka_unit_test(at_fault_the_paper_does_not_name_a_neighbour_at_the_player),
        cmocka_unit_test(at_fault_a_rounded_box_collides_where_the_real_one_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
