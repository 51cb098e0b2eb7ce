/* SPDX-License-Identifier: MIT */
/* test_velocity_layer.c - tests that exactly the moving points have arrows, along their velocities, and that arrows
 * left out are counted. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw_list.h"
#include "octree/sample.h"
#include "velocity_layer.h"

/* Every arrow whatever its size. */
static view every_arrow(view_camera camera)
{
    view v = view_of(1280, 1440, camera, VIEW_DEFAULT_LAYERS);
    v.lod = 0;
    v.budget = 0;
    return v;
}

static const scene_segment *find_arrow(const scene *s, uint64_t id)
{
    const scene_segment *found = NULL;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *segment = &s->segments.items[i];
        if (segment->style.layer != LAYER_VELOCITIES || segment->id != id)
            continue;
        assert_null(found);
        found = segment;
    }
    return found;
}

static bool says(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* An arrow leads from the point along its velocity for `ticks` ticks, or ends at the world's face that it would pass.
 */
static void check_arrow(const scene_segment *arrow, const octree_game_body *body, const octree_box *world, double ticks)
{
    const double *end = arrow->ends[1];
    double part = 1;
    bool on_face = false;
    assert_true(same_position(arrow->ends[0], body->position) && !arrow->in_picture);
    assert_true(arrow->style.stroke == STROKE_ARROW && arrow->style.role == ROLE_FAINT);
    for (int i = 0; i < 3; i++) {
        const double whole = body->velocity[i] * ticks;
        assert_true(end[i] >= world->min[i] && end[i] <= world->max[i]);
        if (whole != 0 && (end[i] - body->position[i]) / whole < part)
            part = (end[i] - body->position[i]) / whole;
        on_face = on_face || (whole > 0 && end[i] == world->max[i] && body->position[i] + whole >= world->max[i]) ||
                  (whole < 0 && end[i] == world->min[i] && body->position[i] + whole <= world->min[i]);
    }
    assert_true(part > 0);
    for (int i = 0; i < 3; i++) {
        const double extent = world->max[i] - world->min[i];
        assert_true(fabs(end[i] - (body->position[i] + body->velocity[i] * ticks * part)) < 1e-9 * extent);
    }
    assert_true(on_face || part > 1 - 1e-9);
}

/* The arrows of a tick belong to its movers, and the tree holds each mover where its arrow begins. */
static void check_tick(const scene *s, const octree_game *game, double ticks)
{
    const octree_tick *tick = octree_game_tick(game);
    const layer_counts found = count_layer(s, LAYER_VELOCITIES);
    for (size_t i = 0; i < tick->mover_count; i++) {
        const octree_game_body *body = &tick->movers[i];
        const scene_segment *arrow = find_arrow(s, body->id);
        assert_non_null(arrow);
        assert_true(octree_contains(octree_game_tree(game), arrow->ends[0], body->id));
        check_arrow(arrow, body, &octree_game_session(game)->tree.world, ticks);
    }
    assert_int_equal(found.segments, tick->mover_count);
    assert_int_equal(found.boxes + found.markers + found.labels + found.panels, 0);
}

/* Some bodies are at rest, and some cross the world in one tick. */
static octree_session moving_session(octree_game_body *bodies, size_t count, double speed)
{
    uint64_t random = 3;
    for (size_t i = 0; i < count; i++) {
        bodies[i] = (octree_game_body){.id = i + 1000};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = random_between(&random, -10, 10);
            bodies[i].velocity[axis] = i % 5 ? random_between(&random, -speed, speed) : 0;
        }
    }
    octree_session session = small_session(bodies, count);
    session.tree.full_leaf = OCTREE_GROW;
    session.ticks = 12;
    return session;
}

enum { BODIES = 40 };

static void every_mover_and_nothing_else_has_an_arrow(void **state)
{
    (void)state;
    static const double speeds[] = {0.01, 0.4, 3, 17, 60};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        octree_game_body bodies[BODIES];
        const octree_session session = moving_session(bodies, BODIES, speeds[i]);
        const view v = every_arrow((view_camera)(i % CAMERA_COUNT));
        octree_game *game = start_game(&session);
        scene s = {0};
        for (;; play_tick(game)) {
            build_tick(&s, &v, game);
            assert_int_equal(octree_game_tick(game)->mover_count, BODIES / 5 * 4);
            check_tick(&s, game, count_velocity_ticks(game));
            if (octree_game_over(game))
                break;
        }
        scene_release(&s);
        octree_game_destroy(game);
    }
}

/* 20 units wide: the fastest arrow is at most 2 long, or a tick. */
static void arrow_scale_makes_movement_visible(void **state)
{
    (void)state;
    static const struct {
        double speed;
        unsigned ticks;
        const char *text;
    } cases[] = {
        {0.001, 1000, "velocity, 1000 ticks"}, {1e-9, 1000, "velocity, 1000 ticks"}, {0.1, 20, "velocity, 20 ticks"},
        {0.125, 10, "velocity, 10 ticks"},     {0.2, 10, "velocity, 10 ticks"},      {0.21, 5, "velocity, 5 ticks"},
        {0.6, 2, "velocity, 2 ticks"},         {1.25, 1, "velocity, 1 tick"},        {5, 1, "velocity, 1 tick"},
        {1e300, 1, "velocity, 1 tick"}};
    const view v = every_arrow(CAMERA_ISO);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const octree_game_body bodies[] = {{.id = 1, .position = {1, 2, 3}, .velocity = {0, -cases[i].speed, 0}},
                                           {.id = 2, .position = {1, 2, 4}, .velocity = {cases[i].speed / 4, 0, 0}}};
        const octree_session session = small_session(bodies, 2);
        octree_game *game = start_game(&session);
        scene s = {0};
        build_tick(&s, &v, game);
        assert_int_equal(count_velocity_ticks(game), cases[i].ticks);
        assert_true(says(&s, cases[i].text));
        check_tick(&s, game, cases[i].ticks);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void session_without_movers_has_no_arrows_and_no_legend_line(void **state)
{
    (void)state;
    const octree_session still = octree_session_default();
    const octree_session moving = session_with_all_layers();
    for (int i = 0; i < 3; i++) {
        octree_game *game = start_game(i ? &moving : &still);
        view v = every_arrow(CAMERA_FOLLOW);
        scene s = {0};
        v.layers &= i == 2 ? ~(1u << LAYER_VELOCITIES) : VIEW_ALL_LAYERS;
        build_tick(&s, &v, game);
        assert_int_equal(count_layer(&s, LAYER_VELOCITIES).segments, i == 1);
        bool told = false;
        for (size_t j = 0; j < s.labels.count; j++)
            told = told || strstr(s.labels.items[j].text, "velocity");
        assert_int_equal(told, i == 1);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void filtered_point_has_no_arrow(void **state)
{
    (void)state;
    octree_game_body bodies[BODIES];
    const octree_session session = moving_session(bodies, BODIES, 1);
    octree_game *game = start_game(&session);
    static const view_filter filters[] = {{.by_region = true, .region = {{-4, -9, -9}, {9, 9, 6}}},
                                          {.slice = 'z', .slice_at = 2.5},
                                          {.by_depth = true, .min_depth = 3, .max_depth = 21}};
    for (size_t f = 0; f < sizeof filters / sizeof filters[0]; f++) {
        view v = every_arrow(CAMERA_TOP);
        scene s = {0};
        size_t shown = 0;
        v.filter = filters[f];
        build_tick(&s, &v, game);
        for (size_t i = 0; i < BODIES; i++) {
            const bool point = count_markers_at(&s, LAYER_POINTS, bodies[i].id, bodies[i].position) == 1;
            assert_int_equal(find_arrow(&s, bodies[i].id) != NULL, point && i % 5 != 0);
            shown += point;
        }
        assert_true(shown > 3 && shown < BODIES);
        scene_release(&s);
    }
    octree_game_destroy(game);
}

/* Return the length of an arrow in the picture: the larger of its width and height in pixels. */
static double pixels_of(const scene *s, const scene_segment *arrow)
{
    double a[2], b[2];
    pixel_of(s, arrow->ends[0], a);
    pixel_of(s, arrow->ends[1], b);
    return fmax(fabs(a[0] - b[0]), fabs(a[1] - b[1]));
}

static void arrows_below_the_lod_are_left_out_and_counted(void **state)
{
    (void)state;
    octree_game_body bodies[BODIES];
    const octree_session session = moving_session(bodies, BODIES, 0.4);
    octree_game *game = start_game(&session);
    for (double lod = 2; lod < 200; lod *= 1.5) {
        view v = every_arrow(CAMERA_ISO);
        scene all = {0}, some = {0};
        char text[SCENE_TEXT];
        size_t out = 0;
        v.layers &= ~(1u << LAYER_NODES | 1u << LAYER_VISITED);
        build_tick(&all, &v, game);
        v.lod = lod;
        build_tick(&some, &v, game);
        for (size_t i = 0; i < BODIES; i++) {
            const scene_segment *arrow = find_arrow(&all, bodies[i].id);
            const bool small = arrow && pixels_of(&all, arrow) < lod;
            assert_int_equal(find_arrow(&some, bodies[i].id) != NULL, arrow && !small);
            out += small;
        }
        assert_int_equal(some.tally.arrows.small, out);
        v.layers &= ~(1u << LAYER_HIT | 1u << LAYER_PRUNED);
        build_tick(&some, &v, game);
        assert_int_equal(some.tally.arrows.small, out);
        snprintf(text, sizeof text, "under %.3g px", lod);
        assert_int_equal(says(&some, text), out > 0);
        snprintf(text, sizeof text, "%zu arrow%s", out, out == 1 ? "" : "s");
        assert_int_equal(says(&some, text), out > 0);
        v.layers = VIEW_DEFAULT_LAYERS;
        build_tick(&some, &v, game);
        assert_int_equal(says(&some, text), out > 0);
        scene_release(&all);
        scene_release(&some);
    }
    octree_game_destroy(game);
}

enum { MANY = 100000 };

/* Each budget shows about as many arrows as it allows. A smaller budget shows a subset. */
static void budget_thins_a_hundred_thousand_arrows_and_reports_it(void **state)
{
    (void)state;
    static octree_game_body bodies[MANY];
    static double positions[MANY][3], velocities[MANY][3];
    octree_session session = small_session(bodies, MANY);
    session.tree = define(cube(-10, 10), 64, OCTREE_MAX_DEPTH, OCTREE_GROW);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &session.tree.world, MANY, positions), OCTREE_OK);
    const octree_box slow = cube(-0.1, 0.1);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 2, &slow, MANY, velocities), OCTREE_OK);
    for (size_t i = 0; i < MANY; i++) {
        bodies[i] = (octree_game_body){.id = i + 1000};
        memcpy(bodies[i].position, positions[i], sizeof positions[i]);
        memcpy(bodies[i].velocity, velocities[i], sizeof velocities[i]);
    }
    octree_game *game = start_game(&session);
    scene last = {0};
    for (uint64_t budget = view_make_default().budget; budget > 20000; budget /= 3) {
        view v = view_of(1280, 1440, CAMERA_ISO, VIEW_DEFAULT_LAYERS & ~(1u << LAYER_NODES | 1u << LAYER_POINTS));
        scene s = {0};
        char text[SCENE_TEXT];
        v.budget = budget;
        build_tick(&s, &v, game);
        const size_t shown = count_layer(&s, LAYER_VELOCITIES).segments;
        assert_int_equal(shown + s.tally.arrows.thinned, MANY);
        assert_true(shown <= budget / 1000 + 1 && shown > budget / 1000 / 4);
        snprintf(text, sizeof text, "1 in %d", (int)s.tally.arrows.one_in);
        assert_true(says(&s, "arrows") && says(&s, text));
        assert_false(says(&s, "budget")); /* of boxes and points, which it does not limit here */
        assert_true(fabs((double)MANY / (double)shown / (double)s.tally.arrows.one_in - 1) < 0.6);
        for (size_t i = 0; last.view.width && i < MANY; i += 7)
            assert_true(!find_arrow(&s, bodies[i].id) || find_arrow(&last, bodies[i].id));
        scene_release(&last);
        last = s;
    }
    scene_release(&last);
    octree_game_destroy(game);
}

/* An arrow without its point would begin in empty space. */
static void points_beyond_the_budget_have_no_arrow(void **state)
{
    (void)state;
    octree_game_body bodies[BODIES];
    const octree_session session = moving_session(bodies, BODIES, 1);
    octree_game *game = start_game(&session);
    view v = every_arrow(CAMERA_ISO);
    scene s = {0};
    v.budget = 25;
    build_tick(&s, &v, game);
    for (size_t i = 0; i < BODIES; i++)
        assert_true(!find_arrow(&s, bodies[i].id) ||
                    count_markers_at(&s, LAYER_POINTS, bodies[i].id, bodies[i].position) == 1);
    assert_true(s.tally.thinned > 0 && count_layer(&s, LAYER_VELOCITIES).segments <= 1);
    scene_release(&s);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mover_and_nothing_else_has_an_arrow),
        cmocka_unit_test(arrow_scale_makes_movement_visible),
        cmocka_unit_test(session_without_movers_has_no_arrows_and_no_legend_line),
        cmocka_unit_test(filtered_point_has_no_arrow),
        cmocka_unit_test(arrows_below_the_lod_are_left_out_and_counted),
        cmocka_unit_test(budget_thins_a_hundred_thousand_arrows_and_reports_it),
        cmocka_unit_test(points_beyond_the_budget_have_no_arrow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
