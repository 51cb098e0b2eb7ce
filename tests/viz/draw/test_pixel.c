/* SPDX-License-Identifier: MIT */
/* test_pixel.c - all elements of one pixel: the one on top, the covered ones, and those that share a line or point with
 * it. */
#include "frames.h"
#include "golden_frames.h"
#include "layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 320
#define HEIGHT 240

static scene blank_scene(view_camera camera, int aa)
{
    const octree_box world = {{-160, -160, -120}, {160, 160, 120}};
    view v = view_of(WIDTH, HEIGHT, camera, VIEW_ALL_LAYERS);
    v.aa = aa;
    return empty_scene(&v, &world);
}

static draw_covers touches_at(renderer *r, const scene *s, int x, int y)
{
    draw_covers list = {0};
    octreel_error error = {""};
    if (!renderer_list_pixel_covers(r, s, x, y, &list, &error))
        fail_msg("%s", error.text);
    return list;
}

/* The index of an element in the list, or -1. */
static int place_of(const scene *s, const draw_covers *list, scene_kind kind, size_t index)
{
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].number == scene_element_number(s, (scene_element){.kind = kind, .index = index}))
            return (int)i;
    return -1;
}

/* ---- Against the whole picture ------------------------------------------------------------------------------ */

/* The number of samples of a pixel at which renderer_find_element_numbers() returns this number. */
static int picked(const scene *s, const uint32_t *numbers, int x, int y, uint32_t number)
{
    const int samples = s->view.aa, width = s->view.width * samples;
    int count = 0;
    for (int i = 0; i < samples * samples; i++)
        count += numbers[(y * samples + i / samples) * width + x * samples + i % samples] == number;
    return count;
}

static void check_pixel(renderer *r, const scene *s, const uint32_t *numbers, int x, int y)
{
    draw_covers list = touches_at(r, s, x, y);
    const int samples = s->view.aa;
    int shown = 0;
    for (size_t i = 0; i < list.count; i++) {
        const draw_cover *touch = &list.items[i];
        assert_int_equal(touch->shown, picked(s, numbers, x, y, touch->number));
        assert_true(touch->shown <= touch->painted && touch->painted <= samples * samples);
        shown += touch->shown;
    }
    assert_int_equal(shown + picked(s, numbers, x, y, 0), samples * samples);
    draw_covers_release(&list);
}

static void element_at_a_pixel_equals_that_of_the_whole_picture(void **state)
{
    uint64_t seed = 11;
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        scene s;
        octreel_error failed = {""};
        octreel_error error = {""};
        if (!golden_scene(&golden_frames[i], &s, &failed))
            fail_msg("%s", failed.text);
        renderer *r = open_renderer_for(&s);
        const int samples = s.view.aa, size = s.view.width * s.view.height * samples * samples;
        uint32_t *numbers = malloc((size_t)size * sizeof *numbers);
        assert_true(renderer_find_element_numbers(r, &s, numbers, &error));
        for (int lit = 0, tries = 0; lit < 12 && tries < 4000; tries++) {
            const int x = (int)random_below(&seed, (uint64_t)s.view.width);
            const int y = (int)random_below(&seed, (uint64_t)s.view.height);
            if (picked(&s, numbers, x, y, 0) == samples * samples && tries % 400)
                continue; /* check only a few empty pixels */
            check_pixel(r, &s, numbers, x, y);
            lit++;
        }
        free(numbers);
        renderer_close(r);
        scene_release(&s);
    }
}

/* ---- Covered ------------------------------------------------------------------------------------------------ */

static void covered_elements_follow_the_elements_that_cover_them(void **state)
{
    (void)state;
    scene s = blank_scene(CAMERA_TOP, 1);
    const scene_panel panel = {
        .x = 10, .y = 10, .width = 20, .height = 20, .style = {.layer = LAYER_TEXT, .role = ROLE_PANEL}};
    scene_add_panel(&s, panel);
    scene_add_panel(&s, panel);
    renderer *r = open_renderer_for(&s);
    draw_covers list = touches_at(r, &s, 12, 12);
    assert_int_equal(list.count, 2);
    assert_int_equal(place_of(&s, &list, SCENE_PANEL, 1), 0);
    assert_int_equal(list.items[0].shown, 1);
    assert_int_equal(list.items[0].color, theme_color_index(ROLE_PANEL, 0));
    assert_int_equal(list.items[1].shown, 0);
    assert_int_equal(list.items[1].painted, 1);
    draw_covers_release(&list);
    list = touches_at(r, &s, 9, 12);
    assert_int_equal(list.count, 0);
    draw_covers_release(&list);
    renderer_close(r);
    scene_release(&s);
}

/* One panel covers half of the samples of a pixel, another a quarter. */
static void samples_of_a_pixel_are_shared_among_elements(void **state)
{
    (void)state;
    scene s = blank_scene(CAMERA_TOP, 4);
    const scene_style style = {.layer = LAYER_PLAYER, .role = ROLE_PLAYER, .width = 1};
    for (int i = 0; i < 2; i++) /* lines of one pixel, which cover a quarter and a half of the row of pixels */
        scene_add_segment(&s, (scene_segment){.in_picture = true,
                                              .style = style,
                                              .ends = {{20, 30.75 + 0.5 * i, 0}, {60, 30.75 + 0.5 * i, 0}}});
    renderer *r = open_renderer_for(&s);
    draw_covers list = touches_at(r, &s, 40, 30);
    const int above = place_of(&s, &list, SCENE_SEGMENT, 0), below = place_of(&s, &list, SCENE_SEGMENT, 1);
    assert_true(above >= 0 && below >= 0);
    assert_int_equal(list.items[below].shown, 4); /* the last one is painted from 30.75 on */
    assert_int_equal(list.items[above].painted, 12);
    assert_int_equal(list.items[above].shown, 8);
    draw_covers_release(&list);
    renderer_close(r);
    scene_release(&s);
}

/* ---- There by another's paint ------------------------------------------------------------------------------- */

static scene_marker point_at(uint64_t id, double x, double y)
{
    return (scene_marker){
        .id = id, .at = {x, y, 0}, .style = {.layer = LAYER_POINTS, .role = ROLE_POINT}, .shape = SHAPE_SQUARE};
}

static void all_points_of_a_pixel_are_listed(void **state)
{
    (void)state;
    scene s = blank_scene(CAMERA_TOP, 1);
    double pixel[2];
    for (int i = 0; i < 5; i++)
        scene_add_marker(&s, point_at((uint64_t)i, 40 + 1e-9 * i, 20));
    scene_add_marker(&s, point_at(5, 60, 20));
    pixel_of(&s, s.markers.items[0].at, pixel);
    renderer *r = open_renderer_for(&s);
    draw_covers list = touches_at(r, &s, (int)pixel[0], (int)pixel[1]);
    assert_int_equal(list.count, 5);
    assert_int_equal(list.items[0].shown, 1);
    for (size_t i = 0; i < 5; i++)
        assert_true(place_of(&s, &list, SCENE_MARKER, i) >= 0);
    for (size_t i = 1; i < 5; i++)
        assert_int_equal(list.items[i].painted, 0);
    draw_covers_release(&list);
    renderer_close(r);
    scene_release(&s);
}

/* Discs of 9 pixels around x 40 to 44, seen from above, the nearest last; and a separate disc of 90. */
static void hidden_points_are_listed_nearest_first(void **state)
{
    (void)state;
    for (int aa = 1; aa <= 4; aa *= 2) {
        scene s = blank_scene(CAMERA_TOP, aa);
        double pixel[2];
        s.view.point_color = POINTS_BY_Z;
        s.view.shade = SHADE_EDL;
        s.spacing = 6;
        for (int i = 0; i < 5; i++) {
            scene_marker marker = point_at((uint64_t)(10 - i), i == 4 ? 90 : 40 + i, 20);
            marker.at[2] = 10 * (i % 4);
            marker.style.role = ROLE_OWN;
            scene_add_marker(&s, marker);
        }
        scene_add_marker(&s, s.markers.items[1]); /* the same place, and a lower id */
        s.markers.items[5].id = 1;
        pixel_of(&s, s.markers.items[0].at, pixel);
        renderer *r = open_renderer_for(&s);
        draw_covers list = touches_at(r, &s, (int)pixel[0], (int)pixel[1]);
        static const size_t expected[] = {3, 2, 5, 1, 0};
        assert_int_equal(list.count, 5);
        for (int i = 0; i < 5; i++) {
            assert_int_equal(place_of(&s, &list, SCENE_MARKER, expected[i]), i);
            assert_int_equal(list.items[i].shown, i == 0 ? aa * aa : 0);
            assert_int_equal(list.items[i].painted, i == 0 ? aa * aa : 0);
        }
        draw_covers_release(&list);
        renderer_close(r);
        scene_release(&s);
    }
}

static scene_box cell(uint64_t id, double x0, double x1, uint8_t depth)
{
    return (scene_box){.id = id,
                       .box = {{x0, -40, -40}, {x1, 40, 40}},
                       .depth = depth,
                       .style = {.layer = LAYER_NODES, .role = (uint8_t)theme_node_role(depth), .width = 1}};
}

/* Seen from the front, the top edges at z = 40 are one line of the picture. */
static void all_boxes_of_an_edge_are_listed(void **state)
{
    (void)state;
    scene s = blank_scene(CAMERA_FRONT, 1);
    scene_add_box(&s, cell(1, -80, 80, 1));
    scene_add_box(&s, cell(2, -80, 0, 2));
    scene_add_box(&s, cell(3, 0, 80, 2));
    const double left[3] = {-30, -40, 40}, joint[3] = {0, -40, 0};
    double pixel[2];
    renderer *r = open_renderer_for(&s);

    pixel_of(&s, left, pixel);
    draw_covers list = touches_at(r, &s, (int)floor(pixel[0]), (int)floor(pixel[1]));
    assert_int_equal(list.count, 2);
    assert_int_equal(place_of(&s, &list, SCENE_BOX, 0), 0);
    assert_true(list.items[0].shown == 1 && list.items[0].painted >= 1);
    assert_int_equal(place_of(&s, &list, SCENE_BOX, 1), 1);
    assert_int_equal(list.items[1].painted, 0);
    draw_covers_release(&list);

    pixel_of(&s, joint, pixel); /* the wall between the two */
    list = touches_at(r, &s, (int)floor(pixel[0] - 0.5), (int)floor(pixel[1]));
    if (list.count == 0) {
        draw_covers_release(&list);
        list = touches_at(r, &s, (int)floor(pixel[0] + 0.5), (int)floor(pixel[1]));
    }
    assert_int_equal(list.count, 2);
    assert_true(place_of(&s, &list, SCENE_BOX, 1) >= 0 && place_of(&s, &list, SCENE_BOX, 2) >= 0);
    draw_covers_release(&list);
    renderer_close(r);
    scene_release(&s);
}

static void gap_of_a_cut_line_belongs_to_it_and_of_a_dashed_line_does_not(void **state)
{
    (void)state;
    for (int style = STROKE_DASHED; style <= STROKE_CUT; style++) {
        scene s = blank_scene(CAMERA_TOP, 1);
        scene_segment line = {
            .in_picture = true, .ends = {{20, 50, 0}, {120, 50, 0}}, .style = {.role = ROLE_NODE, .width = 1}};
        line.style.layer = LAYER_NODES;
        scene_add_segment(&s, line);
        line.style = (scene_style){.layer = LAYER_PRUNED, .role = ROLE_RANGE, .stroke = (uint8_t)style, .width = 1};
        scene_add_segment(&s, line);
        renderer *r = open_renderer_for(&s);
        int gaps = 0, dashes = 0;
        for (int x = 25; x < 115; x++) {
            draw_covers list = touches_at(r, &s, x, 50);
            if (list.count == 0) {
                draw_covers_release(&list);
                list = touches_at(r, &s, x, 49);
            }
            const int upper = place_of(&s, &list, SCENE_SEGMENT, 1);
            assert_true(place_of(&s, &list, SCENE_SEGMENT, 0) >= 0);
            assert_true(style == STROKE_DASHED || upper == 0);
            if (upper == 0 && list.items[0].color)
                dashes++;
            else
                gaps++;
            draw_covers_release(&list);
        }
        assert_true(gaps > 15 && dashes > 15);
        renderer_close(r);
        scene_release(&s);
    }
}

static void pixel_outside_the_picture_is_refused(void **state)
{
    static const int outside[][2] = {{-1, 0}, {0, -1}, {WIDTH, 0}, {0, HEIGHT}};
    (void)state;
    scene s = blank_scene(CAMERA_TOP, 1);
    renderer *r = open_renderer_for(&s);
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        draw_covers list = {0};
        octreel_error error = {""};
        assert_false(renderer_list_pixel_covers(r, &s, outside[i][0], outside[i][1], &list, &error));
        assert_non_null(strstr(error.text, "320 x 240"));
        draw_covers_release(&list);
    }
    renderer_close(r);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(element_at_a_pixel_equals_that_of_the_whole_picture),
        cmocka_unit_test(covered_elements_follow_the_elements_that_cover_them),
        cmocka_unit_test(samples_of_a_pixel_are_shared_among_elements),
        cmocka_unit_test(all_points_of_a_pixel_are_listed),
        cmocka_unit_test(hidden_points_are_listed_nearest_first),
        cmocka_unit_test(all_boxes_of_an_edge_are_listed),
        cmocka_unit_test(gap_of_a_cut_line_belongs_to_it_and_of_a_dashed_line_does_not),
        cmocka_unit_test(pixel_outside_the_picture_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
