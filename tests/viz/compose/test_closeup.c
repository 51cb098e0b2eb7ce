/* SPDX-License-Identifier: MIT */
/* test_closeup.c - tests when a scene has a close-up of the player, what it shows, and where it stands. */
#include "extreme_worlds.h"
#include "layout.h"
#include "octree/sample.h"
#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static octree_game *open_game(const octree_session *session)
{
    octree_game *game;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    return game;
}

static bool has_closeup(const octree_session *session, const view *v)
{
    octree_game *game = open_game(session);
    scene s = {.refused = 0};
    build_tick(&s, v, game);
    const bool has = s.has_closeup;
    scene_release(&s);
    octree_game_destroy(game);
    return has;
}

static bool is_within(const camera_window *inner, const camera_window *outer)
{
    return inner->x >= outer->x && inner->y >= outer->y && inner->x + inner->width <= outer->x + outer->width &&
           inner->y + inner->height <= outer->y + outer->height;
}

static bool are_apart(const camera_window *a, const camera_window *b)
{
    return a->x + a->width <= b->x || b->x + b->width <= a->x || a->y + a->height <= b->y || b->y + b->height <= a->y;
}

/* A close-up is of the same size, at the same place and as many times as large at every tick, and the player is in its
 * middle. */
static void a_close_up_follows_the_player_and_is_fixed_in_the_picture(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    for (view_camera camera = 0; camera < CAMERA_COUNT; camera++) {
        octree_game *game = open_game(&session);
        view v = view_make_default();
        scene s = {.refused = 0};
        double times = 0;
        int left_out = 0;
        v.camera = camera;
        const camera_window w = layout_closeup_area(&v);
        for (int tick = 0; tick < 40; tick++) {
            const double *player = octree_game_tick(game)->player;
            double pixel[2];
            build_tick(&s, &v, game);
            if (!s.has_closeup) { /* it would show only the player */
                left_out++;
                play_tick(game);
                continue;
            }
            times = tick ? times : s.closeup->times;
            assert_true(s.closeup->times == times && times > 1);
            assert_true(s.closeup->place[0] == w.x && s.closeup->place[1] == w.y);
            assert_true(s.closeup->view.width == w.width && s.closeup->view.height == w.height);
            assert_true(camera_find_pixel(&s.closeup->camera, player, pixel));
            assert_true(fabs(pixel[0] - w.width / 2) < 1e-6 && fabs(pixel[1] - w.height / 2) < 1e-6);
            assert_memory_equal(s.closeup->camera.forward, s.camera.forward, sizeof s.camera.forward);
            play_tick(game);
        }
        assert_true(left_out > 0 && left_out < 30);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

/* What is about it in the world appears `times` as large, where a camera is orthographic everywhere. */
static void everything_is_enlarged_by_the_printed_factor(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = open_game(&session);
    const octree_box box = cube(-30, 30);
    scene s = {.refused = 0};
    const view v = view_make_default();
    build_tick(&s, &v, game);
    const double before = camera_box_size_in_pixels(&s.camera, &box),
                 after = camera_box_size_in_pixels(&s.closeup->camera, &box);
    assert_true(fabs(after / before - s.closeup->times) < 1e-9 && after > 60 && before < 40);
    const scene_panel *marks[2] = {NULL, NULL}; /* the ends of its scale */
    size_t count = 0;
    for (size_t i = 0; i < s.closeup->panels.count; i++) {
        const scene_panel *mark = &s.closeup->panels.items[i];
        if (mark->style.layer == LAYER_CLOSEUP && mark->height > mark->width)
            marks[count++ % 2] = mark;
    }
    assert_int_equal(count, 2);
    assert_true(marks[0]->y == marks[1]->y && marks[0]->height == marks[1]->height);
    scene_release(&s);
    octree_game_destroy(game);
}

static void large_or_unwanted_subject_has_no_close_up(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    view v = view_make_default();
    assert_true(has_closeup(&session, &v));
    v.closeup = false;
    assert_false(has_closeup(&session, &v));
    v = view_make_default();
    v.diagram = DIAGRAM_ONLY;
    assert_false(has_closeup(&session, &v));
    v = view_make_default();
    v.width = 200;
    v.height = 120;
    assert_false(has_closeup(&session, &v));
    v = view_make_default();
    v.zoom = 10;
    assert_false(has_closeup(&session, &v));
    v = view_make_default();
    session.player.box_size = 200;
    assert_false(has_closeup(&session, &v));
    session.player.box_size = 0; /* its step is long */
    session.player.step = 400;
    assert_false(has_closeup(&session, &v));
    session.player.step = 0; /* it has no extent at all */
    assert_false(has_closeup(&session, &v));
}

/* It overlaps neither text nor diagram nor the world's space, and the frame of what it shows lies in that. A pointer
 * outside this frame is short, so that no line crosses the scene. */
static void close_up_overlaps_nothing_else(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 720}, {640, 360}, {3840, 2160}, {720, 1280}, {960, 540}, {500, 500}};
    const octree_session session = octree_session_default();
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    for (int i = 0; i < 24; i++) {
        view v = view_make_default();
        v.width = sizes[i % 6][0];
        v.height = sizes[i % 6][1];
        v.diagram = i / 6 % 2 ? DIAGRAM_BESIDE : DIAGRAM_NONE;
        v.camera = i / 12 ? CAMERA_ORBIT : CAMERA_ISO;
        build_tick(&s, &v, game);
        const camera_window all = {layout_panel_width(&v), 0, v.width - layout_panel_width(&v), v.height};
        const camera_window w = layout_closeup_area(&v), space = layout_space_area(&s),
                            diagram = layout_diagram_area(&v);
        assert_true(s.has_closeup == (w.width > 0));
        if (!s.has_closeup)
            continue;
        assert_true(is_within(&w, &all) && are_apart(&w, &space) && are_apart(&w, &diagram));
        const scene_segment *outside = NULL;
        for (size_t n = 0; n < s.segments.count; n++) {
            const scene_segment *line = &s.segments.items[n];
            for (int end = 0; line->style.layer == LAYER_CLOSEUP && end < 2; end++) {
                const camera_window at = {floor(line->ends[end][0]), floor(line->ends[end][1]), 0, 0};
                assert_true(is_within(&at, &all) && are_apart(&at, &diagram));
            }
            outside = line->style.layer == LAYER_CLOSEUP ? line : outside; /* the last one */
        }
        assert_non_null(outside);
        const double aside = fabs(outside->ends[1][0] - outside->ends[0][0]),
                     down = fabs(outside->ends[1][1] - outside->ends[0][1]);
        assert_true(aside == 0 || down == 0);
        assert_true(aside + down <= 8 * s.unit);
    }
    scene_release(&s);
    octree_game_destroy(game);
}

/* The close-up has the nodes and points around the player, small ones too, and none that are far away. */
static void close_up_shows_only_the_players_surroundings(void **state)
{
    (void)state;
    enum { MANY = 20000 };
    octree_session session = octree_session_default();
    octree_game_body *bodies = calloc(MANY, sizeof *bodies);
    double(*positions)[3] = calloc(MANY, sizeof *positions);
    assert_true(bodies && positions);
    octree_sample(OCTREE_SAMPLE_UNIFORM, 3, &session.tree.world, MANY, positions);
    for (size_t i = 0; i < MANY; i++) {
        bodies[i].id = i + 100;
        memcpy(bodies[i].position, positions[i], sizeof positions[i]);
    }
    session.bodies = bodies;
    session.body_count = MANY;
    session.tree.max_depth = 12;
    session.tree.full_leaf = OCTREE_GROW;
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    view v = view_make_default();
    v.lod = 30;
    build_tick(&s, &v, game);
    const octree_box *region = &s.closeup->view.filter.region;
    size_t points = 0;
    for (size_t i = 0; i < s.closeup->markers.count; i++)
        points += s.closeup->markers.items[i].style.layer == LAYER_POINTS;
    size_t there = 0, shown = 0, deepest[2] = {0, 0};
    for (size_t i = 0; i < MANY; i++) {
        bool is_in = true;
        for (int axis = 0; axis < 3; axis++)
            is_in &= positions[i][axis] >= region->min[axis] && positions[i][axis] <= region->max[axis];
        there += is_in;
    }
    assert_true(there > 10 && there < MANY / 10);
    shown = points;
    assert_int_equal(shown, there + 1); /* and the player */
    for (int close = 0; close < 2; close++) {
        const scene *of = close ? s.closeup : &s;
        for (size_t i = 0; i < of->boxes.count; i++)
            if (of->boxes.items[i].style.layer == LAYER_NODES && of->boxes.items[i].depth > deepest[close])
                deepest[close] = of->boxes.items[i].depth;
    }
    assert_true(deepest[1] > deepest[0]);
    scene_release(&s);
    octree_game_destroy(game);
    free(bodies);
    free(positions);
}

/* The outline of the enlarged area is visible at any scale. */
static void enlarged_area_is_outlined_however_small(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    const octree_game_body near_player = {.id = 99, .position = {1e-6, 0, 0}};
    session.player.step = session.player.box_size = 1e-5;
    session.bodies = &near_player;
    session.body_count = 1;
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    const view v = view_make_default();
    build_tick(&s, &v, game);
    size_t lines = 0;
    for (size_t i = 0; i < s.segments.count; i++) {
        const scene_segment *line = &s.segments.items[i];
        const double x = fabs(line->ends[0][0] - line->ends[1][0]), y = fabs(line->ends[0][1] - line->ends[1][1]);
        lines += line->style.layer == LAYER_CLOSEUP && x + y >= 4;
    }
    assert_int_equal(lines, 5); /* and the pointer to the close-up */
    scene_release(&s);
    octree_game_destroy(game);
}

/* Worlds of extreme sizes have close-ups too. */
static void close_up_is_the_same_at_every_scale_of_the_world(void **state)
{
    (void)state;
    static const double scales[] = {1e-300, 1e-12, 1, 1e12, 1e300};
    const view v = view_make_default();
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        scaled_session made;
        scene s = {.refused = 0};
        scale_session(&made, scales[i], 0);
        octree_game *game = open_game(&made.session);
        play_tick(game);
        build_tick(&s, &v, game);
        assert_true(s.has_closeup && s.closeup->times == 5);
        assert_int_equal(s.closeup->refused, 0);
        assert_true(s.closeup->boxes.count > 5);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void every_world_has_a_close_up_of_finite_numbers(void **state)
{
    (void)state;
    const view v = view_make_default();
    for (size_t row = 0; row < world_count; row++) {
        octree_session session = octree_session_default();
        session.tree.world = world_of(row);
        scene_box_middle(&session.tree.world, session.player.position);
        session.player.box_size = session.player.step =
            session.tree.world.max[0] / 100 - session.tree.world.min[0] / 100;
        session.body_count = session.query_count = 0;
        octree_game *game;
        scene s = {.refused = 0};
        if (octree_game_create(&session, &game) != OCTREE_OK)
            continue;
        assert_true(tick_scene_build(&s, &v, game, NULL, NULL));
        if (s.has_closeup)
            assert_true(s.closeup->refused <= s.refused);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void scene_digest_covers_the_close_up(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    const view v = view_make_default();
    build_tick(&s, &v, game);
    const uint64_t with = scene_digest(&s);
    s.closeup->place[0]++;
    assert_true(scene_digest(&s) != with);
    s.closeup->place[0]--;
    s.closeup->boxes.items[0].id++;
    assert_true(scene_digest(&s) != with);
    s.has_closeup = false;
    assert_true(scene_digest(&s) != with);
    scene_release(&s);
    octree_game_destroy(game);
}

/* The numbers of the close-up's elements continue after the scene's. */
static void close_up_elements_are_numbered_after_the_scene(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    const view v = view_make_default();
    build_tick(&s, &v, game);
    const uint32_t all = (uint32_t)(scene_count_elements(&s) + scene_count_elements(s.closeup));
    for (uint32_t number = 1; number <= all; number++) {
        const scene_element element = scene_element_at(&s, number);
        assert_int_equal(element.in_closeup, number > scene_count_elements(&s));
        assert_int_equal(scene_element_number(&s, element), number);
    }
    const scene_element last = scene_element_at(&s, all);
    assert_int_equal(scene_element_head(&s, last).id, s.closeup->labels.items[s.closeup->labels.count - 1].id);
    scene_release(&s);
    octree_game_destroy(game);
}

/* With a region filter, the close-up shows only elements within the region. */
static void close_up_respects_the_region_filter(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = open_game(&session);
    scene s = {.refused = 0};
    view v = view_make_default();
    build_tick(&s, &v, game);
    const octree_box whole = s.closeup->view.filter.region;
    for (int axis = 0; axis < 3; axis++) {
        octree_box expected = whole;
        v.filter.by_region = true;
        v.filter.region = cube(-1000, 1000);
        v.filter.region.min[axis] = expected.min[axis] = -7;
        v.filter.region.max[axis] = expected.max[axis] = 9;
        build_tick(&s, &v, game);
        assert_memory_equal(&s.closeup->view.filter.region, &expected, sizeof expected);
    }
    scene_release(&s);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_close_up_follows_the_player_and_is_fixed_in_the_picture),
        cmocka_unit_test(everything_is_enlarged_by_the_printed_factor),
        cmocka_unit_test(large_or_unwanted_subject_has_no_close_up),
        cmocka_unit_test(close_up_overlaps_nothing_else),
        cmocka_unit_test(close_up_shows_only_the_players_surroundings),
        cmocka_unit_test(enlarged_area_is_outlined_however_small),
        cmocka_unit_test(close_up_is_the_same_at_every_scale_of_the_world),
        cmocka_unit_test(every_world_has_a_close_up_of_finite_numbers),
        cmocka_unit_test(scene_digest_covers_the_close_up),
        cmocka_unit_test(close_up_elements_are_numbered_after_the_scene),
        cmocka_unit_test(close_up_respects_the_region_filter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
