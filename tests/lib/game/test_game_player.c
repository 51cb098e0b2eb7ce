/* SPDX-License-Identifier: MIT */
/* test_game_player.c - games without a player, and games whose player is a body that edits move. */
#include "fixture.h"

#include <math.h>

#include "brute.h"
#include "game_fixture.h"
#include "octree/sample.h"

/* Play the session's next tick. */
static const octree_tick *play(octree_game *game)
{
    assert_int_equal(octree_game_advance(game), OCTREE_OK);
    assert_valid(octree_game_tree(game));
    return octree_game_tick(game);
}

/* The small session with an id for its player that a body has, while there is one. */
static octree_session led_session(const octree_game_body *bodies, size_t body_count, const octree_edit *edits,
                                  size_t edit_count)
{
    octree_session session = small_session(bodies, body_count);
    session.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = 1, .box_size = 0.5};
    session.edits = edits;
    session.edit_count = edit_count;
    session.ticks = 4;
    return session;
}

static void without_a_player_nothing_steps_collides_or_is_asked_about_it(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 0, .position = {1, 1, 1}}, {.id = 2, .position = {1, 1, 1.25}}};
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .at_player = true},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .target = {1, 1, 0}}};
    octree_session session = small_session(bodies, 2);
    session.player = (octree_player){.kind = OCTREE_PLAYER_NONE, .box_size = -1, .step = -1};
    session.keys = "dn.";
    session.queries = queries;
    session.query_count = 2;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_count(octree_game_tree(game)), 2);
    for (const octree_tick *tick = octree_game_tick(game);; tick = play(game)) {
        assert_false(tick->has_player);
        assert_int_equal(tick->hit_count, 0);
        assert_int_equal(tick->events, tick->number ? 0 : octree_game_tick(game)->events);
        assert_int_equal(tick->answer_count, 1);
        assert_int_equal(tick->answers[0].neighbors[0].point.id, 0);
        if (octree_game_over(game))
            break;
    }
    octree_game_destroy(game);
}

static void a_player_that_is_a_body_comes_moves_and_goes_by_edits(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 2, .position = {3, 0, 0}}};
    static const octree_edit edits[] = {{1, OCTREE_EDIT_INSERT, {.id = 1, .position = {-3, 0, 0}}},
                                        {2, OCTREE_EDIT_MOVE, {.id = 1, .position = {2.75, 0, 0}}},
                                        {3, OCTREE_EDIT_REMOVE, {.id = 1}},
                                        {4, OCTREE_EDIT_INSERT, {.id = 1, .position = {9, 9, 9}}}};
    const octree_session session = led_session(bodies, 1, edits, 4);
    octree_game *game = start_game(&session);
    assert_false(octree_game_tick(game)->has_player);
    assert_true(same_position(octree_game_tick(game)->player, (double[]){0, 0, 0}));
    const octree_tick *tick = play(game);
    assert_true(tick->has_player && tick->hit_count == 0);
    assert_true(same_position(tick->player, (double[]){-3, 0, 0}) && same_position(tick->from, tick->player));
    tick = play(game); /* next to point 2; an edit is not taken back */
    assert_true(same_position(tick->player, (double[]){2.75, 0, 0}));
    assert_true(tick->hit_count == 1 && tick->hits[0].id == 2);
    assert_int_equal(tick->events & (OCTREE_EVENT_COLLIDED | OCTREE_EVENT_MOVED), OCTREE_EVENT_COLLIDED);
    tick = play(game);
    assert_false(tick->has_player);
    assert_true(tick->hit_count == 0 && !(tick->events & OCTREE_EVENT_COLLIDED));
    assert_true(same_position(tick->player, (double[]){2.75, 0, 0}));
    assert_int_equal(octree_count(octree_game_tree(game)), 1);
    tick = play(game);
    assert_true(tick->has_player && same_position(tick->player, (double[]){9, 9, 9}));
    octree_game_destroy(game);
}

static void keys_do_not_move_a_player_that_is_a_body(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {1, 2, 3}}, {.id = 2, .position = {5, 5, 5}}};
    octree_session session = led_session(bodies, 2, NULL, 0);
    session.player.step = 1;
    octree_game *game = start_game(&session);
    for (const char *key = "wasdef"; *key; key++) {
        const octree_tick *tick = play_key(game, *key);
        assert_true(same_position(tick->player, bodies[0].position));
        assert_int_equal(tick->events, 0);
    }
    const octree_tick *tick = play_key(game, 'n');
    assert_int_equal(tick->answers[0].neighbors[0].point.id, 2); /* not itself */
    octree_game_destroy(game);
}

static void a_swept_player_that_an_edit_moves_misses_nothing_on_its_way(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {
        {.id = 1, .position = {-9, 0, 0}}, {.id = 2, .position = {0, 0.25, 0}}, {.id = 3, .position = {0, 2, 0}}};
    static const octree_edit edits[] = {{1, OCTREE_EDIT_MOVE, {.id = 1, .position = {9, 0, 0}}},
                                        {2, OCTREE_EDIT_REMOVE, {.id = 1}},
                                        {3, OCTREE_EDIT_INSERT, {.id = 1, .position = {-9, 0, 0}}}};
    octree_session session = led_session(bodies, 3, edits, 3);
    session.player.sweep = true;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play(game);
    assert_true(tick->swept && same_position(tick->from, (double[]){-9, 0, 0}));
    assert_true(tick->hit_count == 1 && tick->hits[0].id == 2);
    assert_false(play(game)->swept);
    tick = play(game); /* what is inserted begins where it is put */
    assert_true(tick->swept && tick->hit_count == 0);
    octree_game_destroy(game);
}

/* Where a random edit leaves the bodies; what the tree would refuse is not asked for. */
static octree_edit random_edit(uint64_t *random, uint64_t tick, brute *now)
{
    octree_edit edit = {.tick = tick, .body.id = random_below(random, 12)};
    for (int i = 0; i < 3; i++)
        edit.body.position[i] = (double)random_below(random, 9) - 4;
    size_t at = 0;
    while (at < now->count && now->points[at].id != edit.body.id)
        at++;
    if (at == now->count) {
        edit.kind = OCTREE_EDIT_INSERT;
        brute_insert(now, edit.body.position, edit.body.id);
        return edit;
    }
    const octree_point there = now->points[at];
    brute_remove(now, there.position, there.id);
    edit.kind = random_below(random, 4) ? OCTREE_EDIT_MOVE : OCTREE_EDIT_REMOVE;
    if (edit.kind == OCTREE_EDIT_MOVE)
        brute_insert(now, edit.body.position, edit.body.id);
    return edit;
}

static void assert_hits(const octree_tick *tick, const brute *now)
{
    brute expected = {0}, hits = {0};
    const octree_point *player = NULL;
    for (size_t i = 0; i < now->count; i++)
        player = now->points[i].id == 1 ? &now->points[i] : player;
    assert_true(tick->has_player == (player != NULL));
    if (player) {
        assert_true(same_position(tick->player, player->position));
        brute_collide(now, player->position, 1, player, &expected);
    }
    for (size_t i = 0; i < tick->hit_count; i++)
        brute_insert(&hits, tick->hits[i].position, tick->hits[i].id);
    assert_true(brute_equal(&hits, &expected));
    brute_free(&hits);
    brute_free(&expected);
}

static void hits_of_a_player_that_is_a_body_are_those_of_a_scan(void **state)
{
    (void)state;
    enum { TICKS = 200, EACH = 3 };
    static octree_edit edits[TICKS * EACH];
    static brute after[TICKS + 1];
    size_t met = 0, away = 0;
    uint64_t random = 7;
    for (size_t tick = 1; tick <= TICKS; tick++) {
        for (size_t i = 0; i < after[tick - 1].count; i++)
            brute_insert(&after[tick], after[tick - 1].points[i].position, after[tick - 1].points[i].id);
        for (size_t i = 0; i < EACH; i++)
            edits[(tick - 1) * EACH + i] = random_edit(&random, tick, &after[tick]);
    }
    octree_session session = led_session(NULL, 0, edits, TICKS * EACH);
    session.tree.full_leaf = OCTREE_GROW;
    session.player.box_size = 1;
    session.ticks = TICKS;
    octree_game *game = start_game(&session);
    for (size_t tick = 1; tick <= TICKS; tick++) {
        assert_hits(play(game), &after[tick]);
        met += octree_game_tick(game)->hit_count;
        away += !octree_game_tick(game)->has_player;
    }
    assert_true(met > 20 && away > 20 && away < TICKS - 20);
    octree_game_destroy(game);
    for (size_t tick = 0; tick <= TICKS; tick++)
        brute_free(&after[tick]);
}

static void a_player_of_no_kind_or_of_a_bad_size_is_refused(void **state)
{
    (void)state;
    octree_game *game;
    octree_session session = led_session(NULL, 0, NULL, 0);
    session.player.kind = (octree_player_kind)(OCTREE_PLAYER_NONE + 1);
    assert_int_equal(octree_game_create(&session, &game), OCTREE_BAD_OPTION);
    session.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .box_size = -1};
    assert_int_equal(octree_game_create(&session, &game), OCTREE_BAD_SIZE);
    session.player.box_size = INFINITY;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_NOT_FINITE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_player_nothing_steps_collides_or_is_asked_about_it),
        cmocka_unit_test(a_player_that_is_a_body_comes_moves_and_goes_by_edits),
        cmocka_unit_test(keys_do_not_move_a_player_that_is_a_body),
        cmocka_unit_test(a_swept_player_that_an_edit_moves_misses_nothing_on_its_way),
        cmocka_unit_test(hits_of_a_player_that_is_a_body_are_those_of_a_scan),
        cmocka_unit_test(a_player_of_no_kind_or_of_a_bad_size_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
