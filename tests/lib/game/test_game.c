/* SPDX-License-Identifier: MIT */
/* test_game.c - the game loop: the default session, the player's steps, keys, and what create refuses. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "game_fixture.h"

static void assert_at(const double position[3], double x, double y, double z)
{
    assert_true(position[0] == x && position[1] == y && position[2] == z);
}

static void the_default_session_is_the_one_of_the_paper(void **state)
{
    (void)state;
    static const double expected[11][3] = {{-50, -50, 100}, {900, -900, -900}, {900, 900, 900},  {-100, -100, 100},
                                           {-1, 2, 3},      {750, 750, 750},   {800, 800, 800},  {500, 500, 500},
                                           {750, 750, 800}, {975, 975, 1000},  {1000, 1000, 975}};
    octree_session session = octree_session_default();
    assert_int_equal(session.body_count, 11);
    for (size_t i = 0; i < 11; i++)
        assert_true(same_position(session.bodies[i].position, expected[i]));
    for (int axis = 0; axis < 3; axis++)
        assert_true(session.tree.world.min[axis] == -1000 && session.tree.world.max[axis] == 1000);
    assert_int_equal(session.tree.leaf_capacity, 2);
    assert_int_equal(session.tree.max_depth, 5);
    assert_int_equal(session.tree.full_leaf, OCTREE_REFUSE);
    assert_at(session.player.position, 0, 0, 0);
    assert_true(session.player.step == 50 && session.player.box_size == 30);
    assert_true(octree_session_length(&session) >= 240);
}

static void tick_zero_of_the_default_session_refuses_the_third_point_of_a_cell(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->number, 0);
    assert_int_equal(tick->key, 0);
    assert_int_equal(tick->refusal_count, 1);
    assert_int_equal(tick->refusals[0].why, OCTREE_FULL);
    assert_at(tick->refusals[0].position, 750, 750, 800);
    assert_true(tick->events & OCTREE_EVENT_FULL);
    assert_true(tick->events & OCTREE_EVENT_COLLIDED); /* (-1, 2, 3) lies in the box about the origin */
    assert_int_equal(tick->hit_count, 1);
    assert_at(tick->hits[0].position, -1, 2, 3);
    assert_at(tick->player, 0, 0, 0);
    octree_game_destroy(game);
}

/* The face (axis, side) that a refused tick met, as a bit. */
static unsigned face_met(const octree_tick *tick)
{
    static const char keys[] = "adswfe";
    const char *key = strchr(keys, tick->key);
    assert_non_null(key);
    size_t face = (size_t)(key - keys);
    double beyond = tick->player[face / 2] + (face % 2 == 0 ? -50 : 50);
    assert_true(fabs(beyond) > 1000);
    return 1u << face;
}

static void the_default_session_meets_every_event_and_all_six_faces(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    unsigned seen = 0, faces = 0, full_steps = 0, taken_back = 0, waits = 0, named = 0;
    double before[3] = {0, 0, 0};
    while (!octree_game_over(game)) {
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        const octree_tick *tick = octree_game_tick(game);
        bool stepped = tick->key != 'n' && tick->key != '.';
        seen |= tick->events;
        faces |= tick->events & OCTREE_EVENT_REFUSED ? face_met(tick) : 0;
        full_steps += stepped && tick->events & OCTREE_EVENT_FULL ? 1 : 0;
        taken_back += stepped && tick->events & OCTREE_EVENT_COLLIDED && same_position(before, tick->player) ? 1 : 0;
        waits += tick->key == '.' ? 1 : 0;
        named += tick->answer_count > 0 && tick->answers[0].by_key ? 1 : 0;
        memcpy(before, tick->player, sizeof before);
        assert_valid(octree_game_tree(game));
    }
    assert_int_equal(seen, OCTREE_EVENT_WRONG - 1);
    assert_int_equal(faces, 63);
    assert_true(full_steps > 0 && taken_back > 0 && waits > 0 && named > 0);
    octree_game_destroy(game);
}

static void each_key_moves_along_its_axis(void **state)
{
    (void)state;
    static const struct {
        char key;
        double x, y, z;
    } keys[] = {{'w', 0, 1, 0}, {'s', 0, -1, 0}, {'d', 1, 0, 0}, {'a', -1, 0, 0}, {'e', 0, 0, 1}, {'f', 0, 0, -1}};
    octree_session session = small_session(NULL, 0);
    for (size_t i = 0; i < 6; i++) {
        octree_game *game = start_game(&session);
        const octree_tick *tick = play_key(game, keys[i].key);
        assert_int_equal(tick->number, 1);
        assert_int_equal(tick->key, keys[i].key);
        assert_int_equal(tick->events, OCTREE_EVENT_MOVED);
        assert_at(tick->player, keys[i].x, keys[i].y, keys[i].z);
        assert_at(tick->attempt, keys[i].x, keys[i].y, keys[i].z);
        assert_true(octree_contains(octree_game_tree(game), tick->player, 100));
        assert_int_equal(octree_count(octree_game_tree(game)), 1);
        octree_game_destroy(game);
    }
}

static void waiting_and_naming_do_not_move(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    for (const char *key = ".n.n"; *key != '\0'; key++) {
        uint64_t version = octree_version(octree_game_tree(game));
        const octree_tick *tick = play_key(game, *key);
        assert_int_equal(tick->events, 0);
        assert_at(tick->player, 0, 0, 0);
        assert_true(octree_version(octree_game_tree(game)) == version);
    }
    octree_game_destroy(game);
}

static void a_step_may_end_on_a_face_but_not_beyond(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    for (const char *key = "wasdef"; *key != '\0'; key++) {
        octree_game *game = start_game(&session);
        for (int i = 0; i < 10; i++)
            assert_int_equal(play_key(game, *key)->events, OCTREE_EVENT_MOVED);
        double face[3];
        memcpy(face, octree_game_tick(game)->player, sizeof face);
        assert_true(fabs(face[0]) + fabs(face[1]) + fabs(face[2]) == 10);
        const octree_tick *tick = play_key(game, *key);
        assert_int_equal(tick->events, OCTREE_EVENT_REFUSED);
        assert_true(same_position(tick->player, face));
        assert_true(octree_contains(octree_game_tree(game), face, 100));
        octree_game_destroy(game);
    }
}

static void a_step_that_collides_is_taken_back(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 9, .position = {2.5, 0, 0}},
                                              {.id = 3, .position = {2, 0.5, -0.5}}};
    octree_session session = small_session(bodies, 2);
    octree_game *game = start_game(&session);
    assert_int_equal(play_key(game, 'd')->events, OCTREE_EVENT_MOVED); /* (1, 0, 0): 1.5 away */
    for (int i = 0; i < 3; i++) {
        const octree_tick *tick = play_key(game, 'd');
        assert_true(tick->events & OCTREE_EVENT_COLLIDED);
        assert_false(tick->events & OCTREE_EVENT_MOVED);
        assert_at(tick->player, 1, 0, 0);
        assert_at(tick->attempt, 2, 0, 0);
        assert_int_equal(tick->hit_count, 2);
        assert_int_equal(tick->hits[0].id, 3); /* by id */
        assert_int_equal(tick->hits[1].id, 9);
        assert_true(octree_contains(octree_game_tree(game), tick->player, 100));
    }
    octree_game_destroy(game);
}

static void a_step_into_a_full_leaf_is_taken_back(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {9, 9, 9}}, {.id = 2, .position = {9, 9, 8}}};
    octree_session session = small_session(bodies, 2);
    session.tree.max_depth = 1;
    for (int axis = 0; axis < 3; axis++)
        session.player.position[axis] = axis == 0 ? -0.5 : 0.5;
    octree_game *game = start_game(&session);
    uint64_t digest = octree_digest(octree_game_tree(game));
    const octree_tick *tick = play_key(game, 'd');
    assert_int_equal(tick->events, OCTREE_EVENT_FULL);
    assert_at(tick->player, -0.5, 0.5, 0.5);
    assert_at(tick->attempt, 0.5, 0.5, 0.5);
    assert_true(octree_digest(octree_game_tree(game)) == digest);
    assert_int_equal(play_key(game, 'a')->events, OCTREE_EVENT_MOVED);
    octree_game_destroy(game);
}

static void a_million_steps_of_a_tenth_and_back_end_where_they_began(void **state)
{
    (void)state;
    enum { million = 1000000 };
    octree_session session = small_session(NULL, 0);
    session.tree.world = cube(-2e5, 2e5);
    session.player.step = 0.1;
    session.player.position[0] = 0.3;
    octree_game *game = start_game(&session);
    for (int i = 0; i < million; i++)
        assert_true(octree_game_step(game, 'd') == OCTREE_OK);
    assert_true(octree_game_tick(game)->player[0] == 0.3 + million * 0.1);
    for (int i = 0; i < million; i++)
        assert_true(octree_game_step(game, 'a') == OCTREE_OK);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->number, 2 * million);
    assert_memory_equal(tick->player, session.player.position, sizeof tick->player);
    octree_game_destroy(game);
}

static void keys_that_are_not_listed_are_refused(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    for (int key = -128; key < 128; key++) {
        if (key > 0 && strchr("wasdefnq.", key) != NULL)
            continue;
        assert_int_equal(octree_game_step(game, (char)key), OCTREE_BAD_KEY);
        octree_game_destroy(game);
        game = start_game(&session); /* after an error a game is not stepped again */
        char keys[] = {'w', (char)key, '\0'};
        octree_session bad = session;
        bad.keys = keys;
        octree_game *none = (octree_game *)&session;
        assert_int_equal(octree_game_create(&bad, &none), key == 0 ? OCTREE_OK : OCTREE_BAD_KEY);
        assert_true((none == NULL) == (key != 0));
        octree_game_destroy(none);
    }
    octree_game_destroy(game);
}

/* The number of ticks that a session plays, by playing it. */
static uint64_t ticks_played(const octree_session *session)
{
    octree_game *game = start_game(session);
    uint64_t ticks = 0;
    for (; !octree_game_over(game); ticks++)
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->number, ticks);
    assert_int_equal(octree_game_advance(game), OCTREE_NOT_FOUND);
    assert_int_equal(octree_game_tick(game)->number, ticks);
    octree_game_destroy(game);
    return ticks;
}

static void a_session_ends_with_its_keys_its_ticks_or_q(void **state)
{
    (void)state;
    static const struct {
        const char *keys;
        uint64_t ticks, length, unplayed;
    } sessions[] = {{NULL, 0, 0, 0},  {"", 0, 0, 0},      {"wwd", 0, 3, 0}, {"wwd", 2, 3, 0},         {"wwd", 5, 5, 0},
                    {NULL, 7, 7, 0},  {"wwqdd", 0, 2, 0}, {"q", 0, 0, 0},   {"wwq", 0, 2, 0},         {"wwd", 0, 2, 1},
                    {"wwd", 5, 1, 4}, {"wwqdd", 0, 1, 1}, {"wwd", 5, 0, 5}, {"wwd", 0, 0, UINT64_MAX}};
    for (size_t i = 0; i < sizeof sessions / sizeof sessions[0]; i++) {
        octree_session session = small_session(NULL, 0);
        session.keys = sessions[i].keys;
        session.ticks = sessions[i].ticks;
        session.unplayed = sessions[i].unplayed;
        assert_int_equal(octree_session_length(&session), sessions[i].length);
        assert_int_equal(ticks_played(&session), sessions[i].length);
    }
}

static void keys_that_are_missing_are_waits(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    session.keys = "d";
    session.ticks = 3;
    octree_game *game = start_game(&session);
    const char expected[] = "d..";
    for (int i = 0; i < 3; i++) {
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        assert_int_equal(octree_game_tick(game)->key, expected[i]);
    }
    assert_at(octree_game_tick(game)->player, 1, 0, 0);
    octree_game_destroy(game);
}

static void create_refuses_bad_players(void **state)
{
    (void)state;
    static const struct {
        octree_player player;
        octree_status status;
    } bad[] = {
        {{.position = {NAN, 0, 0}}, OCTREE_NOT_FINITE}, {{.position = {0, INFINITY, 0}}, OCTREE_NOT_FINITE},
        {{.position = {0, 0, 10.5}}, OCTREE_OUTSIDE},   {{.step = NAN}, OCTREE_NOT_FINITE},
        {{.step = INFINITY}, OCTREE_NOT_FINITE},        {{.step = -1}, OCTREE_BAD_SIZE},
        {{.box_size = -5e-324}, OCTREE_BAD_SIZE},       {{.box_size = NAN}, OCTREE_NOT_FINITE},
        {{.box_size = INFINITY}, OCTREE_NOT_FINITE},    {{.step = 0, .box_size = 0}, OCTREE_OK},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        octree_session session = small_session(NULL, 0);
        session.player = bad[i].player;
        octree_game *game = (octree_game *)&session;
        assert_int_equal(octree_game_create(&session, &game), bad[i].status);
        assert_true((game == NULL) == (bad[i].status != OCTREE_OK));
        octree_game_destroy(game);
    }
}

static octree_status status_of(const octree_session *session)
{
    octree_game *game = NULL;
    octree_status status = octree_game_create(session, &game);
    assert_true((game == NULL) == (status != OCTREE_OK));
    octree_game_destroy(game);
    return status;
}

static void create_refuses_bad_trees_ids_options_and_orders(void **state)
{
    (void)state;
    static const octree_game_body twins[] = {
        {.id = 1}, {.id = 2, .position = {5, 5, 5}}, {.id = 1, .position = {9, 9, 9}}};
    static const octree_game_body usurper[] = {{.id = 100, .position = {5, 5, 5}}};
    static const octree_edit late[] = {{.tick = 2}, {.tick = 1}};
    static const octree_edit odd[] = {{.tick = 1, .kind = (octree_edit_kind)3}};
    static const octree_query back[] = {{.tick = 2, .box = {{0}, {1, 1, 1}}}, {.tick = 1, .box = {{0}, {1, 1, 1}}}};
    static const octree_query every[] = {{.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST}, {.tick = 1}};
    static const octree_query strange[] = {{.tick = 1, .kind = OCTREE_QUERY_KINDS}};
    octree_session session = small_session(NULL, 0);
    session.tree.world.max[1] = -10;
    assert_int_equal(status_of(&session), OCTREE_BAD_WORLD);
    session = small_session(NULL, 0);
    session.tree.leaf_capacity = 0;
    assert_int_equal(status_of(&session), OCTREE_BAD_CAPACITY);
    session = small_session(NULL, 0);
    session.bodies = twins;
    session.body_count = 3;
    assert_int_equal(status_of(&session), OCTREE_DUPLICATE);
    session.body_count = 2;
    assert_int_equal(status_of(&session), OCTREE_OK);
    session.bodies = usurper;
    session.body_count = 1;
    assert_int_equal(status_of(&session), OCTREE_DUPLICATE);
    session = small_session(NULL, 0);
    session.edits = late;
    session.edit_count = 2;
    assert_int_equal(status_of(&session), OCTREE_BAD_ORDER);
    session.edits = odd;
    static const octree_edit first[] = {{.tick = 0}};
    session.edits = first;
    session.edit_count = 1;
    assert_int_equal(status_of(&session), OCTREE_BAD_ORDER); /* tick 0 is what there is before any edit */
    session.edits = odd;
    session.edit_count = 1;
    assert_int_equal(status_of(&session), OCTREE_BAD_OPTION);
    session = small_session(NULL, 0);
    session.queries = back;
    session.query_count = 2;
    assert_int_equal(status_of(&session), OCTREE_BAD_ORDER);
    session.queries = every;
    assert_int_equal(status_of(&session), OCTREE_BAD_ORDER);
    session.queries = strange;
    session.query_count = 1;
    assert_int_equal(status_of(&session), OCTREE_BAD_OPTION);
}

static void create_refuses_queries_that_no_tick_can_answer(void **state)
{
    (void)state;
    static const struct {
        octree_query query;
        octree_status status;
    } rows[] = {
        {{.kind = OCTREE_QUERY_RANGE, .box = {{0, 0, 1}, {1, 1, 0.5}}}, OCTREE_BAD_RANGE},
        {{.kind = OCTREE_QUERY_RANGE, .at_player = true, .box = {{0, NAN, 0}, {1, 1, 1}}}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_RANGE, .at_player = true, .box = {{-INFINITY, 0, 0}, {1, INFINITY, 1}}}, OCTREE_OK},
        {{.kind = OCTREE_QUERY_NEAREST, .target = {0, 0, INFINITY}}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_NEAREST, .at_player = true, .target = {0, 0, NAN}, .radius = -1}, OCTREE_OK},
        {{.kind = OCTREE_QUERY_KNEAREST, .target = {NAN, 0, 0}, .k = 3}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_KNEAREST, .k = 0}, OCTREE_OK},
        {{.kind = OCTREE_QUERY_KNEAREST, .k = SIZE_MAX}, OCTREE_OK},
        {{.kind = OCTREE_QUERY_RADIUS, .radius = -1}, OCTREE_BAD_SIZE},
        {{.kind = OCTREE_QUERY_RADIUS, .radius = INFINITY}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_RADIUS, .radius = NAN, .at_player = true}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_RADIUS, .target = {0, -INFINITY, 0}}, OCTREE_NOT_FINITE},
        {{.kind = OCTREE_QUERY_RADIUS, .radius = 1.7e308, .target = {-1.7e308, 1e308, 0}}, OCTREE_OK},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        octree_session session = small_session(NULL, 0);
        session.queries = &rows[i].query;
        session.query_count = 1;
        assert_int_equal(status_of(&session), rows[i].status);
        assert_int_equal(octree_query_check(&rows[i].query), rows[i].status);
    }
}

static void create_refuses_arrays_that_are_null(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    session.body_count = 1;
    assert_int_equal(status_of(&session), OCTREE_NULL_ARGUMENT);
    session = small_session(NULL, 0);
    session.edit_count = 1;
    assert_int_equal(status_of(&session), OCTREE_NULL_ARGUMENT);
    session = small_session(NULL, 0);
    session.query_count = 1;
    assert_int_equal(status_of(&session), OCTREE_NULL_ARGUMENT);
    session = small_session(NULL, 0);
    session.foreign_count = 1;
    assert_int_equal(status_of(&session), OCTREE_NULL_ARGUMENT);
}

static void more_bodies_than_memory_can_be_are_refused(void **state)
{
    (void)state;
    static const octree_game_body one = {.id = 1};
    const octree_session session = small_session(&one, SIZE_MAX);
    assert_int_equal(status_of(&session), OCTREE_NO_MEMORY);
}

static void q_quits_when_it_is_played(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    session.ticks = 5;
    octree_game *game = start_game(&session);
    assert_false(octree_game_over(game));
    assert_int_equal(octree_game_step(game, 'q'), OCTREE_OK);
    assert_true(octree_game_over(game));
    assert_int_equal(octree_game_tick(game)->number, 0);
    assert_int_equal(octree_game_advance(game), OCTREE_NOT_FOUND);
    octree_game_destroy(game);
}

static void each_event_has_a_name(void **state)
{
    (void)state;
    static const char *const names[] = {"moved", "refused", "collided", "full",
                                        "split", "merged",  "wrong",    "overlapped"};
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        assert_string_equal(octree_event_name(1u << i), names[i]);
    assert_string_equal(octree_event_name(OCTREE_EVENT_MERGED), "merged");
    assert_null(octree_event_name(0));
    assert_null(octree_event_name(1u << OCTREE_EVENT_KINDS));
    assert_null(octree_event_name(OCTREE_EVENT_MOVED | OCTREE_EVENT_SPLIT));
}

/* An empty tree has one node, its root. */
static void an_empty_tree_has_the_same_digest_in_a_tick(void **state)
{
    (void)state;
    octree_session session = small_session(NULL, 0);
    session.player.kind = OCTREE_PLAYER_NONE;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_count(octree_game_tree(game)), 0);
    assert_true(octree_game_tick(game)->tree_digest == octree_digest(octree_game_tree(game)));
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_tree_has_the_same_digest_in_a_tick),
        cmocka_unit_test(the_default_session_is_the_one_of_the_paper),
        cmocka_unit_test(tick_zero_of_the_default_session_refuses_the_third_point_of_a_cell),
        cmocka_unit_test(the_default_session_meets_every_event_and_all_six_faces),
        cmocka_unit_test(each_key_moves_along_its_axis),
        cmocka_unit_test(waiting_and_naming_do_not_move),
        cmocka_unit_test(a_step_may_end_on_a_face_but_not_beyond),
        cmocka_unit_test(a_step_that_collides_is_taken_back),
        cmocka_unit_test(a_step_into_a_full_leaf_is_taken_back),
        cmocka_unit_test(a_million_steps_of_a_tenth_and_back_end_where_they_began),
        cmocka_unit_test(keys_that_are_not_listed_are_refused),
        cmocka_unit_test(a_session_ends_with_its_keys_its_ticks_or_q),
        cmocka_unit_test(keys_that_are_missing_are_waits),
        cmocka_unit_test(create_refuses_bad_players),
        cmocka_unit_test(create_refuses_bad_trees_ids_options_and_orders),
        cmocka_unit_test(create_refuses_queries_that_no_tick_can_answer),
        cmocka_unit_test(create_refuses_arrays_that_are_null),
        cmocka_unit_test(more_bodies_than_memory_can_be_are_refused),
        cmocka_unit_test(q_quits_when_it_is_played),
        cmocka_unit_test(each_event_has_a_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
