/* SPDX-License-Identifier: MIT */
/* test_body_layers.c - tests that exactly the bodies with extent have boxes, and that the overlap of each pair is
 * marked. */
#include "scenes.h"

#include <math.h>
#include <string.h>

#include "draw_list.h"
#include "octree/sample.h"

enum { BODIES = 40 };

static octree_game_body bodies[BODIES];

/* Every third body is a point. Some boxes are far too small to be drawn. */
static octree_session session_of_boxes(void)
{
    uint64_t random = 5;
    octree_session session = small_session(bodies, BODIES);
    session.tree.full_leaf = OCTREE_GROW;
    session.player.id = 1000;
    session.pairs = true;
    for (size_t i = 0; i < BODIES; i++) {
        bodies[i] = (octree_game_body){.id = BODIES - i};
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = random_between(&random, -9, 9);
            bodies[i].half[axis] = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-3 : random_between(&random, 0.5, 4);
        }
    }
    return session;
}

static view whole_view(void)
{
    view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    v.budget = 0;
    return v;
}

static const octree_game_body *find_body(uint64_t id)
{
    return &bodies[BODIES - id];
}

static size_t count_boxes(const scene *s, view_layer layer)
{
    return count_layer(s, layer).boxes;
}

static void each_box_on_screen_is_drawn_once_in_the_order_of_ids(void **state)
{
    (void)state;
    const octree_session session = session_of_boxes();
    const view v = whole_view();
    octree_game *game = start_game(&session);
    scene s = {0};
    uint64_t last = 0;
    build_tick(&s, &v, game);
    for (size_t i = 0; i < s.boxes.count; i++) {
        const scene_box *box = &s.boxes.items[i];
        if (box->style.layer != LAYER_BODIES)
            continue;
        const octree_game_body *body = find_body(box->id);
        assert_true(box->id > last && box->style.role == ROLE_POINT);
        last = box->id;
        for (int axis = 0; axis < 3; axis++) {
            assert_true(box->box.min[axis] == body->position[axis] - body->half[axis]);
            assert_true(box->box.max[axis] == body->position[axis] + body->half[axis]);
        }
    }
    assert_int_equal(count_boxes(&s, LAYER_BODIES), BODIES / 3); /* neither points nor boxes of a thousandth */
    octree_game_destroy(game);
    scene_release(&s);
}

/* The world is 20 wide, so that the sizes on screen are on both sides of eight pixels. */
static void boxes_appear_from_eight_pixels_on(void **state)
{
    (void)state;
    octree_session session = session_of_boxes();
    const view v = whole_view();
    scene s = {0};
    size_t shown[2] = {0};
    for (size_t i = 0; i < BODIES; i++)
        for (int axis = 0; axis < 3; axis++)
            bodies[i].half[axis] = 0.02 * (double)(i + 1);
    octree_game *game = start_game(&session);
    build_tick(&s, &v, game);
    for (size_t i = 0; i < BODIES; i++) {
        octree_box box;
        for (int axis = 0; axis < 3; axis++) {
            box.min[axis] = bodies[i].position[axis] - bodies[i].half[axis];
            box.max[axis] = bodies[i].position[axis] + bodies[i].half[axis];
        }
        size_t boxes = 0;
        for (size_t j = 0; j < s.boxes.count; j++)
            boxes += s.boxes.items[j].style.layer == LAYER_BODIES && s.boxes.items[j].id == bodies[i].id;
        assert_int_equal(boxes, camera_box_size_in_pixels(&s.camera, &box) >= 8);
        shown[boxes]++;
    }
    assert_true(shown[0] > 3 && shown[1] > 3);
    octree_game_destroy(game);
    scene_release(&s);
}

static void overlap_of_each_pair_lies_in_both_boxes(void **state)
{
    (void)state;
    const octree_session session = session_of_boxes();
    const view v = whole_view();
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    scene s = {0};
    build_tick(&s, &v, game);
    assert_true(tick->pair_count >= 3);
    size_t marked = 0;
    for (size_t i = 0; i < s.boxes.count; i++) {
        const scene_box *box = &s.boxes.items[i];
        if (box->style.layer != LAYER_PAIRS)
            continue;
        marked++;
        assert_true(box->id < tick->pair_count && box->style.role == ROLE_COLLISION);
        const octree_game_body *two[] = {find_body(tick->pairs[box->id].a), find_body(tick->pairs[box->id].b)};
        for (int axis = 0; axis < 3; axis++) {
            assert_true(box->box.min[axis] ==
                        fmax(two[0]->position[axis] - two[0]->half[axis], two[1]->position[axis] - two[1]->half[axis]));
            assert_true(box->box.max[axis] ==
                        fmin(two[0]->position[axis] + two[0]->half[axis], two[1]->position[axis] + two[1]->half[axis]));
        }
    }
    assert_int_equal(marked + count_layer(&s, LAYER_PAIRS).markers, tick->pair_count);
    octree_game_destroy(game);
    scene_release(&s);
}

static void filter_and_budget_limit_boxes_as_they_limit_points(void **state)
{
    (void)state;
    const octree_session session = session_of_boxes();
    octree_game *game = start_game(&session);
    for (int points = 0; points < 2; points++) {
        view v = whole_view();
        scene s = {0};
        v.layers &= points ? ~0u : ~(1u << LAYER_POINTS);
        v.budget = 6;
        build_tick(&s, &v, game);
        const size_t boxes = count_boxes(&s, LAYER_BODIES);
        assert_true(boxes > 0 && boxes <= 6);
        for (size_t i = 0; points && i < s.boxes.count; i++)
            if (s.boxes.items[i].style.layer == LAYER_BODIES)
                assert_int_equal(
                    count_markers_at(&s, LAYER_POINTS, s.boxes.items[i].id, find_body(s.boxes.items[i].id)->position),
                    1);
        scene_release(&s);
        v = whole_view();
        v.filter = (view_filter){.by_region = true, .region = cube(0, 10)};
        build_tick(&s, &v, game);
        for (size_t i = 0; i < s.boxes.count; i++)
            if (s.boxes.items[i].style.layer == LAYER_BODIES)
                assert_true(box_holds(&v.filter.region, find_body(s.boxes.items[i].id)->position));
        assert_true(count_boxes(&s, LAYER_BODIES) > 0 && count_boxes(&s, LAYER_BODIES) < BODIES / 3);
        scene_release(&s);
    }
    octree_game_destroy(game);
}

static void session_of_points_has_no_boxes(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    const view v = whole_view();
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    assert_int_equal(count_boxes(&s, LAYER_BODIES) + count_boxes(&s, LAYER_PAIRS), 0);
    octree_game_destroy(game);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_box_on_screen_is_drawn_once_in_the_order_of_ids),
        cmocka_unit_test(boxes_appear_from_eight_pixels_on),
        cmocka_unit_test(overlap_of_each_pair_lies_in_both_boxes),
        cmocka_unit_test(filter_and_budget_limit_boxes_as_they_limit_points),
        cmocka_unit_test(session_of_points_has_no_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
