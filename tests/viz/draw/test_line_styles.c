/* SPDX-License-Identifier: MIT */
/* test_line_styles.c - bold lines, cut lines, arrows and markers draw the pixels that they promise. */
#include "frames.h"
#include "layer.h"

#include <stdlib.h>

#define WIDTH 320
#define HEIGHT 240

static scene blank_scene(view_camera camera)
{
    const octree_box world = {{-160, -160, -120}, {160, 160, 120}};
    const view v = view_of(WIDTH, HEIGHT, camera, VIEW_ALL_LAYERS);
    return empty_scene(&v, &world);
}

static scene_segment line_of(double x0, double y0, double z0, double x1, double y1, double z1)
{
    return (scene_segment){.ends = {{x0, y0, z0}, {x1, y1, z1}}, .style = {.role = ROLE_RANGE, .width = 1}};
}

/* Where a cut line lies on another line, only its dashes and the background between them are visible. */
static void cut_line_hides_the_line_below(void **state)
{
    (void)state;
    renderer *r = open_renderer(WIDTH, HEIGHT);
    for (int i = 0; i < 40; i++) {
        scene s = blank_scene(CAMERA_ISO);
        scene_segment line = line_of(-100, 2 * i, -90, 120, 10 - i, i);
        line.style.layer = LAYER_NODES;
        scene_add_segment(&s, line);
        uint8_t *alone = draw(r, &s);
        line.style = (scene_style){.layer = LAYER_RANGE, .role = ROLE_NEAREST, .stroke = STROKE_CUT, .width = 1};
        scene_add_segment(&s, line);
        uint8_t *cut = draw(r, &s);
        size_t dashes = 0, gaps = 0;
        for (size_t at = 0; at < WIDTH * HEIGHT; at++) {
            dashes += cut[at] / THEME_SHADES == ROLE_NEAREST;
            gaps += alone[at] != 0 && cut[at] == 0;
            assert_true(cut[at] / THEME_SHADES == ROLE_NEAREST || cut[at] == 0);
        }
        assert_true(gaps > dashes / 3 && gaps < dashes);
        free(alone);
        free(cut);
        scene_release(&s);
    }
    renderer_close(r);
}

static void bold_line_is_two_pixels_wide_in_a_small_picture(void **state)
{
    (void)state;
    scene s = blank_scene(CAMERA_TOP);
    assert_int_equal(s.unit, 1);
    scene_segment line = line_of(0, -100, 0, 0, 100, 0);
    double ends[2][2];
    line.style.width = 2;
    pixel_of(&s, line.ends[0], ends[0]);
    pixel_of(&s, line.ends[1], ends[1]);
    scene_add_segment(&s, line);
    uint8_t *frame = draw_once(&s);
    for (int y = (int)ends[1][1] + 2; y < (int)ends[0][1] - 2; y++) {
        size_t lit = 0;
        for (int x = 0; x < WIDTH; x++)
            lit += frame[y * WIDTH + x] != 0;
        assert_int_equal(lit, 2);
    }
    free(frame);
    scene_release(&s);
}

/* The number of drawn pixels in a column of the picture. */
static size_t lit_in_column(const uint8_t *frame, int x)
{
    size_t lit = 0;
    for (int y = 0; y < HEIGHT; y++)
        lit += frame[y * WIDTH + x] != 0;
    return lit;
}

/* The line is wider only before its second end; a line too short for a head stays a line. */
static void arrow_has_its_head_at_its_second_end(void **state)
{
    (void)state;
    for (int length = 1; length < 120; length += 7) {
        scene s = blank_scene(CAMERA_TOP);
        scene_segment line = line_of(-length, 0, 0, length, 0, 0);
        double ends[2][2];
        size_t wide = 0;
        line.style.stroke = STROKE_ARROW;
        pixel_of(&s, line.ends[0], ends[0]);
        pixel_of(&s, line.ends[1], ends[1]);
        scene_add_segment(&s, line);
        uint8_t *frame = draw_once(&s);
        for (int x = 0; x < WIDTH; x++) {
            const size_t lit = lit_in_column(frame, x);
            wide += lit > 1;
            assert_true(lit <= 1 || (x + 0.5 < ends[1][0] && x + 0.5 > (ends[0][0] + ends[1][0]) / 2 - 1));
            assert_true(lit <= 3); /* the shaft and both sides of the head */
        }
        assert_true(wide == 0 || wide <= 5);
        assert_int_equal(wide > 0, ends[1][0] - ends[0][0] >= 4);
        free(frame);
        scene_release(&s);
    }
}

/* Whether the pixel at this distance from the middle of a marker is drawn. */
static bool is_lit(const uint8_t *frame, const double middle[2], double right, double down)
{
    return frame[(int)(middle[1] + down) * WIDTH + (int)(middle[0] + right)] != 0;
}

/* Rings and triangles are hollow, wedges are filled; each is as large as its style says. */
static void markers_of_wrong_answers_have_different_shapes(void **state)
{
    (void)state;
    for (unsigned shape = SHAPE_RING; shape <= SHAPE_WEDGE; shape++) {
        scene s = blank_scene(CAMERA_TOP);
        double middle[2];
        const double at[3] = {0, 0, 0};
        scene_add_mark(&s, 1, at, (scene_shape)shape, (scene_style){.role = ROLE_WRONG, .width = 60});
        pixel_of(&s, at, middle);
        uint8_t *frame = draw_once(&s);
        assert_int_equal(is_lit(frame, middle, 0, 0), shape == SHAPE_WEDGE);
        assert_int_equal(is_lit(frame, middle, 0, -29.5), shape != SHAPE_WEDGE);
        assert_int_equal(is_lit(frame, middle, 0, 29.5), shape != SHAPE_TRIANGLE);
        assert_int_equal(is_lit(frame, middle, 29.5, 0) && is_lit(frame, middle, -29.5, 0), shape == SHAPE_RING);
        assert_int_equal(is_lit(frame, middle, 20, 15), shape == SHAPE_TRIANGLE);
        assert_int_equal(is_lit(frame, middle, 20, -15), shape == SHAPE_WEDGE);
        assert_false(is_lit(frame, middle, 0, 34) || is_lit(frame, middle, 34, 0) || is_lit(frame, middle, 24, 24));
        free(frame);
        scene_release(&s);
    }
}

/* A point of the smallest width is one pixel up to 1280 x 720, and grows with larger pictures; the other widths always
 * grow. */
static void points_grow_with_the_picture(void **state)
{
    (void)state;
    static const struct {
        int height, sides[3];
    } rows[] = {{360, {1, 1, 3}}, {720, {1, 3, 5}}, {1080, {1, 3, 7}}, {1440, {2, 5, 9}}, {2160, {3, 7, 13}}};
    const octree_box world = cube(-1, 1);
    for (size_t i = 0; i < 3 * sizeof rows / sizeof *rows; i++) {
        const int height = rows[i / 3].height, side = rows[i / 3].sides[i % 3];
        const view v = view_of(height * 16 / 9, height, CAMERA_TOP, 1u << LAYER_POINTS);
        scene s = empty_scene(&v, &world);
        scene_add_marker(&s, (scene_marker){.style = {LAYER_POINTS, ROLE_POINT, STROKE_SOLID, (uint8_t)(i % 3)}});
        renderer *r = open_renderer_for(&s);
        uint8_t *drawn = draw(r, &s);
        int lit = 0;
        for (size_t p = 0; p < frame_samples(&s); p++)
            lit += drawn[p] != 0;
        assert_int_equal(lit, side * side);
        free(drawn);
        renderer_close(r);
        scene_release(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_line_hides_the_line_below),
        cmocka_unit_test(arrow_has_its_head_at_its_second_end),
        cmocka_unit_test(markers_of_wrong_answers_have_different_shapes),
        cmocka_unit_test(bold_line_is_two_pixels_wide_in_a_small_picture),
        cmocka_unit_test(points_grow_with_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
