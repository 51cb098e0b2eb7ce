/* SPDX-License-Identifier: MIT */
/* test_closeup_course.c - tests the place of close-ups without a player: in ticks with queries or changes, and of
 * trees. */
#include "brute.h"
#include "extreme_worlds.h"
#include "layout.h"
#include "scenes.h"

#include <math.h>
#include <string.h>

/* ---- Recordings --------------------------------------------------------------------------------------------- */

/* A game that is filmed tick by tick. */
typedef struct film {
    octree_session session;
    octree_game *game;
    view view;
    tick_history history;
    scene scene;
} film;

/* A session without a player, in the default world, with a few points. */
static octree_session nobodys_session(void)
{
    octree_session session = octree_session_default();
    session.player = (octree_player){.kind = OCTREE_PLAYER_NONE};
    session.keys = NULL;
    session.queries = NULL;
    session.query_count = 0;
    return session;
}

static void build_next(film *f)
{
    assert_true(tick_history_add(&f->history, &f->view, f->game));
    assert_true(tick_scene_build(&f->scene, &f->view, f->game, &f->history, NULL));
}

static void film_begin(film *f, const octree_session *session)
{
    *f = (film){.session = *session, .view = view_make_default()};
    f->game = start_game(&f->session);
    build_next(f);
}

static void film_next(film *f)
{
    play_tick(f->game);
    build_next(f);
}

static void film_end(film *f)
{
    tick_history_release(&f->history);
    scene_release(&f->scene);
    octree_game_destroy(f->game);
}

static void assert_place(const scene *s, double x, double y, double z)
{
    const double expected[] = {x, y, z};
    assert_true(s->has_closeup);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(s->closeup->camera.center[i] - expected[i]) < 1e-9);
}

static octree_query ball(uint64_t tick, double x, double y, double z, double radius)
{
    return (octree_query){.tick = tick, .kind = OCTREE_QUERY_RADIUS, .target = {x, y, z}, .radius = radius};
}

/* The close-up begins at the first tick with a small query, keeps its magnification, and stays in place while nothing
 * is asked. */
static void close_up_follows_queries_from_the_first_small_one(void **state)
{
    (void)state;
    const octree_query queries[] = {ball(0, 0, 0, 0, 700), ball(2, 500, 0, 0, 20), ball(3, -500, 100, 0, 30)};
    octree_session session = nobodys_session();
    session.queries = queries;
    session.query_count = 3;
    session.ticks = 5;
    film f;
    film_begin(&f, &session);
    for (int tick = 0; tick < 2; tick++, film_next(&f))
        assert_false(f.scene.has_closeup);
    assert_place(&f.scene, 500, 0, 0);
    const double times = f.scene.closeup->times;
    assert_true(times > 1);
    for (int tick = 3; tick < 6; tick++) {
        film_next(&f);
        assert_place(&f.scene, -500, 100, 0);
        assert_true(f.scene.closeup->times == times);
    }
    film_end(&f);
}

/* Of two distant subjects it shows the first, not the empty middle. If both fit, their middle is its middle. */
static void close_up_shows_the_first_of_distant_subjects(void **state)
{
    (void)state;
    const octree_query queries[] = {ball(0, 0, 0, 0, 700),    ball(0, 500, 0, 0, 20), ball(0, -500, 100, 0, 20),
                                    ball(1, -500, 0, 0, 20),  ball(1, 500, 0, 0, 20), ball(2, 100, 0, 0, 20),
                                    ball(2, 100, 50, 10, 20), ball(3, 9e9, 0, 0, 20), ball(3, 0, 0, 50, 20)};
    octree_session session = nobodys_session();
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    session.ticks = 3;
    film f;
    film_begin(&f, &session);
    assert_place(&f.scene, 500, 0, 0);
    film_next(&f);
    assert_place(&f.scene, -500, 0, 0);
    film_next(&f);
    assert_place(&f.scene, 100, 25, 5);
    film_next(&f); /* the other is outside the world */
    assert_place(&f.scene, 0, 0, 50);
    film_end(&f);
}

/* A found neighbour is part of the subject. A subject without extent is shown with its leaf. */
static void neighbours_are_shown_with_their_surroundings(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {
        {.id = 1, .position = {400, 0, 0}}, {.id = 2, .position = {401, 0, 0}}, {.id = 3, .position = {-400, 0, 0}}};
    octree_query nearest = {.tick = 0, .kind = OCTREE_QUERY_NEAREST, .target = {400, 30, 0}};
    octree_session session = nobodys_session();
    session.bodies = bodies;
    session.body_count = 3;
    session.tree.leaf_capacity = 1;
    session.tree.max_depth = OCTREE_MAX_DEPTH;
    session.queries = &nearest;
    session.query_count = 1;
    film f;
    film_begin(&f, &session);
    assert_place(&f.scene, 400, 15, 0);
    const double far_times = f.scene.closeup->times;
    film_end(&f);
    nearest.target[1] = 0;
    film_begin(&f, &session);
    assert_place(&f.scene, 400, 0, 0);
    octree_node leaf;
    assert_int_equal(octree_locate(octree_game_tree(f.game), nearest.target, &leaf), OCTREE_OK);
    const double pixels = camera_box_size_in_pixels(&f.scene.closeup->camera, &leaf.box);
    assert_true(leaf.leaf && pixels > 60 && pixels < f.scene.closeup->view.width);
    assert_true(f.scene.closeup->times > far_times);
    film_end(&f);
}

/* Edits near each other are shown from the first one on, and the close-up stays while it shows them all. */
static void close_up_stays_at_shown_changes_and_moves_to_others(void **state)
{
    (void)state;
    octree_edit edits[] = {
        {.tick = 1, .kind = OCTREE_EDIT_INSERT, .body = {.id = 50, .position = {400, 400, 400}}},
        {.tick = 2, .kind = OCTREE_EDIT_INSERT, .body = {.id = 51, .position = {420, 400, 380}}},
        {.tick = 3, .kind = OCTREE_EDIT_MOVE, .body = {.id = 51, .position = {-700, -600, 380}}},
        {.tick = 4, .kind = OCTREE_EDIT_REMOVE, .body = {.id = 51}},
    };
    octree_session session = nobodys_session();
    session.body_count = 0;
    session.edits = edits;
    session.edit_count = 4;
    session.ticks = 5;
    film f;
    film_begin(&f, &session);
    assert_false(f.scene.has_closeup);
    static const double expected[][3] = {
        {400, 400, 400}, {400, 400, 400}, {-700, -600, 380}, {-700, -600, 380}, {-700, -600, 380}};
    for (int tick = 0; tick < 5; tick++) {
        film_next(&f);
        assert_place(&f.scene, expected[tick][0], expected[tick][1], expected[tick][2]);
    }
    film_end(&f);
}

/* A single moving point is followed, in steps. Many points that move everywhere have no close-up. */
static void single_mover_is_followed_and_a_crowd_is_not(void **state)
{
    (void)state;
    octree_game_body bodies[20] = {{.id = 1, .position = {-500, 0, 0}, .velocity = {25, 0, 0}}};
    octree_session session = nobodys_session();
    session.bodies = bodies;
    session.body_count = 1;
    session.ticks = 30;
    film f;
    film_begin(&f, &session);
    unsigned steps = 0;
    for (int tick = 0; tick < 30; tick++) {
        const double before = f.scene.closeup->camera.center[0];
        double pixel[2];
        film_next(&f);
        steps += f.scene.closeup->camera.center[0] != before;
        assert_true(camera_find_pixel(&f.scene.closeup->camera, octree_game_tick(f.game)->movers[0].position, pixel));
        assert_true(pixel[0] > 0 && pixel[0] < f.scene.closeup->view.width);
    }
    assert_true(steps > 0 && steps < 15);
    film_end(&f);
    for (uint64_t i = 0; i < 20; i++)
        bodies[i] =
            (octree_game_body){.id = i + 1, .position = {90.0 * (double)i - 900}, .velocity = {1, 2, (double)i}};
    session.body_count = 20;
    film_begin(&f, &session);
    for (int tick = 0; tick < 5; tick++, film_next(&f))
        assert_false(f.scene.has_closeup);
    film_end(&f);
}

/* The contents of a gap are unknown. */
static void gap_does_not_move_the_close_up(void **state)
{
    (void)state;
    const octree_query queries[] = {ball(0, 500, 0, 0, 20), ball(1, -500, 100, 0, 30)};
    const octree_gap gap = {.tick = 1, .why = "lost"};
    octree_session session = nobodys_session();
    session.queries = queries;
    session.query_count = 2;
    session.gaps = &gap;
    session.gap_count = 1;
    session.ticks = 2;
    film f;
    film_begin(&f, &session);
    film_next(&f);
    film_next(&f);
    assert_place(&f.scene, 500, 0, 0);
    film_end(&f);
}

/* The history holds the place; the view decides whether there is a close-up and how much it enlarges. */
static void history_serves_every_view(void **state)
{
    (void)state;
    const octree_query query = ball(0, 500, 0, 0, 20);
    octree_session session = nobodys_session();
    session.queries = &query;
    session.query_count = 1;
    session.ticks = 1;
    film f;
    film_begin(&f, &session);
    const double times = f.scene.closeup->times;
    film_next(&f);
    view v = f.view;
    v.closeup = false;
    assert_true(tick_scene_build(&f.scene, &v, f.game, &f.history, NULL) && !f.scene.has_closeup);
    v = f.view;
    v.zoom = 2;
    assert_true(tick_scene_build(&f.scene, &v, f.game, &f.history, NULL));
    assert_true(f.scene.has_closeup && f.scene.closeup->times < times);
    v.zoom = 50;
    assert_true(tick_scene_build(&f.scene, &v, f.game, &f.history, NULL) && !f.scene.has_closeup);
    film_end(&f);
}

/* ---- Trees -------------------------------------------------------------------------------------------------- */

/* Build the scene of a tree with these queries and a requested node; 0: no node. */
static void build_asked(scene *s, const view *v, const octree *tree, const octree_query *queries, size_t count,
                        octree_address node)
{
    octree_answer answers[4];
    assert_true(count <= 4);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(octree_query_answer(tree, &queries[i], NULL, NULL, &answers[i]), OCTREE_OK);
    assert_true(tree_scene_build(
        s, v, tree, &(tree_subject){.title = "cloud", .node = node, .answers = answers, .answer_count = count}));
    for (size_t i = 0; i < count; i++)
        octree_answer_release(tree, &answers[i]);
}

static octree *sampled_tree(octree_box world, size_t count)
{
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 7, &world, count);
    octree *tree = brute_tree(&points, world, 4, OCTREE_MAX_DEPTH);
    brute_free(&points);
    return tree;
}

/* A tree's queries are enlarged in every camera and picture size if they appear small, and otherwise not. */
static void close_up_of_a_tree_shows_its_queries(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 720}, {640, 360}, {3840, 2160}, {720, 1280}};
    octree *tree = sampled_tree(cube(-1000, 1000), 2000);
    const octree_query queries[] = {ball(0, 100, 200, 300, 900), ball(0, 100, 200, 300, 8), ball(0, 103, 200, 300, 5)};
    scene s = {.refused = 0};
    for (int i = 0; i < 4 * CAMERA_COUNT; i++) {
        view v = view_make_default();
        v.camera = (view_camera)(i / 4);
        v.width = sizes[i % 4][0];
        v.height = sizes[i % 4][1];
        build_asked(&s, &v, tree, NULL, 0, 0);
        assert_false(s.has_closeup);
        build_asked(&s, &v, tree, queries, 1, 0);
        assert_false(s.has_closeup);
        build_asked(&s, &v, tree, queries, 3, 0);
        assert_place(&s, 100, 200, 300);
        const octree_box asked = {{92, 192, 292}, {108, 208, 308}};
        const double part =
            camera_box_size_in_pixels(&s.closeup->camera, &asked) / fmin(s.closeup->view.width, s.closeup->view.height);
        assert_true(part > 0.2 && part < 0.8);
        assert_memory_equal(s.closeup->camera.forward, s.camera.forward, sizeof s.camera.forward);
        v.closeup = false;
        build_asked(&s, &v, tree, queries, 3, 0);
        assert_false(s.has_closeup);
    }
    scene_release(&s);
    octree_destroy(tree);
}

static octree_walk_order keep_deepest(const octree_node *node, void *context)
{
    octree_node *deepest = context;
    if (node->depth >= deepest->depth)
        *deepest = *node;
    return OCTREE_WALK_ON;
}

/* A small requested node is in the middle of the close-up; a large one has no close-up. */
static void close_up_of_a_tree_shows_the_requested_node(void **state)
{
    (void)state;
    octree *tree = sampled_tree(cube(-1000, 1000), 2000);
    const view v = view_make_default();
    octree_node node = {0};
    scene s = {.refused = 0};
    double middle[3];
    octree_walk(tree, keep_deepest, &node);
    scene_box_middle(&node.box, middle);
    build_asked(&s, &v, tree, NULL, 0, node.address);
    assert_place(&s, middle[0], middle[1], middle[2]);
    build_asked(&s, &v, tree, NULL, 0, OCTREE_ROOT);
    assert_false(s.has_closeup);
    scene_release(&s);
    octree_destroy(tree);
}

/* In worlds of extreme sizes, a close-up has finite numbers whatever the queries are. */
static void close_ups_of_extreme_worlds_are_finite(void **state)
{
    (void)state;
    const view v = view_make_default();
    size_t found = 0;
    for (size_t row = 0; row < world_count; row++) {
        const octree_box world = world_of(row);
        octree *tree = sampled_tree(world, 20);
        octree_query queries[] = {
            {.kind = OCTREE_QUERY_RANGE, .box = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}},
            {.kind = OCTREE_QUERY_NEAREST},
            {.kind = OCTREE_QUERY_RADIUS, .radius = DBL_MAX},
            {.kind = OCTREE_QUERY_RADIUS}};
        scene_box_middle(&world, queries[1].target);
        memcpy(queries[2].target, world.min, sizeof world.min);
        memcpy(queries[3].target, world.max, sizeof world.max);
        queries[3].radius = (world.max[0] / 2 - world.min[0] / 2) / 100;
        scene s = {.refused = 0};
        for (size_t count = 0; count <= 4; count++) {
            build_asked(&s, &v, tree, queries, count, 0);
            found += s.has_closeup;
            for (int i = 0; s.has_closeup && i < 3; i++)
                assert_true(s.closeup->camera.center[i] >= world.min[i] && s.closeup->camera.center[i] <= world.max[i]);
            assert_true(!s.has_closeup || (s.closeup->times >= 2 && s.closeup->times <= 1e6));
        }
        scene_release(&s);
        octree_destroy(tree);
    }
    assert_true(found > world_count / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(close_up_follows_queries_from_the_first_small_one),
        cmocka_unit_test(close_up_shows_the_first_of_distant_subjects),
        cmocka_unit_test(neighbours_are_shown_with_their_surroundings),
        cmocka_unit_test(close_up_stays_at_shown_changes_and_moves_to_others),
        cmocka_unit_test(single_mover_is_followed_and_a_crowd_is_not),
        cmocka_unit_test(gap_does_not_move_the_close_up),
        cmocka_unit_test(history_serves_every_view),
        cmocka_unit_test(close_up_of_a_tree_shows_its_queries),
        cmocka_unit_test(close_up_of_a_tree_shows_the_requested_node),
        cmocka_unit_test(close_ups_of_extreme_worlds_are_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
