/* SPDX-License-Identifier: MIT */
/* test_axes.c - tests that the numbers along the world's edges are round, stand at their values, and do not overlap. */
#include "scenes.h"
#include "camera.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_ID 1000
#define SCALE_ID 100

static scene scene_of_world(const octree_box *world, const view *v)
{
    octree *tree = make_tree(*world, 4, 21, OCTREE_GROW);
    scene s = {0};
    build_tree(&s, v, tree, "axes");
    octree_destroy(tree);
    return s;
}

static bool is_number(const scene_label *label)
{
    return label->style.layer == LAYER_WORLD && label->id >= FIRST_ID;
}

static size_t count_numbers(const scene *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->labels.count; i++)
        count += is_number(&s->labels.items[i]);
    return count;
}

static const scene_segment *tick_of(const scene *s, uint64_t id)
{
    const scene_segment *found = NULL;
    for (size_t i = 0; i < s->segments.count; i++) {
        if (s->segments.items[i].style.layer != LAYER_WORLD || s->segments.items[i].id != id)
            continue;
        assert_null(found);
        found = &s->segments.items[i];
    }
    assert_non_null(found);
    return found;
}

/* Whether a number is a multiple of 1, 2 or 5 times a power of ten, which is at least a thousandth of the extent. */
static bool is_round(double value, double extent)
{
    double power = pow(10, floor(log10(extent)) - 3);
    for (int i = 0; i < 9; i++, power *= i % 2 ? 2 : 5) {
        const double times = value / power;
        if (fabs(times - round(times)) < 1e-6 * fmax(1, fabs(times) * 1e-9))
            return true;
    }
    return false;
}

/* A number is the coordinate of its tick mark, which leads away from an edge of the box. */
static void check_numbers(const scene *s, const octree_box *box)
{
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (!is_number(label))
            continue;
        const int axis = (int)(label->id / FIRST_ID) - 1;
        const double extent = box->max[axis] - box->min[axis], value = strtod(label->text, NULL);
        const scene_segment *tick = tick_of(s, label->id);
        assert_true(axis >= 0 && axis < 3);
        assert_true(fabs(tick->ends[0][axis] - value) <= 1e-8 * fmax(fabs(value), extent));
        assert_true(tick->ends[0][axis] == tick->ends[1][axis]);
        assert_true(value >= box->min[axis] - 1e-9 * extent && value <= box->max[axis] + 1e-9 * extent);
        assert_true(is_round(value, extent) && strcmp(label->text, "-0") != 0);
        for (int other = 0; other < 3; other++)
            if (other != axis)
                assert_true(tick->ends[0][other] == box->min[other]
                                ? tick->ends[1][other] < box->min[other]
                                : tick->ends[0][other] == box->max[other] && tick->ends[1][other] > box->max[other]);
    }
}

/* Numbers and letters have a rim that separates them from the picture, and no background. */
static void check_rims(const scene *s)
{
    for (size_t i = 0; i < s->panels.count; i++)
        assert_int_not_equal(s->panels.items[i].style.layer, LAYER_WORLD);
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_WORLD)
            assert_int_equal(s->labels.items[i].style.stroke, STROKE_CUT);
}

/* Whether the rectangles that the letters of two labels take overlap. */
static bool overlap(const scene *s, const scene_label *a, const scene_label *b)
{
    const double width[2] = {(double)strlen(a->text) * s->text.width, (double)strlen(b->text) * s->text.width};
    const double height = s->text.height;
    return a->at[0] < b->at[0] + width[1] && b->at[0] < a->at[0] + width[0] && a->at[1] < b->at[1] + height &&
           b->at[1] < a->at[1] + height;
}

static void check_apart(const scene *s)
{
    check_rims(s);
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *a = &s->labels.items[i];
        for (size_t j = 0; is_number(a) && j < i; j++)
            assert_false(is_number(&s->labels.items[j]) && overlap(s, a, &s->labels.items[j]));
        if (is_number(a))
            assert_true(a->at[0] >= 0 && a->at[1] >= 0 && a->at[0] < s->view.width && a->at[1] < s->view.height);
    }
}

/* The pixels of the corners of a box. */
static void project(const scene *s, const octree_box *box, double corners[8][2])
{
    for (unsigned corner = 0; corner < 8; corner++) {
        double at[3];
        for (int i = 0; i < 3; i++)
            at[i] = corner >> i & 1 ? box->max[i] : box->min[i];
        assert_true(camera_find_pixel(&s->camera, at, corners[corner]));
    }
}

/* Return the distance of a pixel from the line between two others; positive at the left. */
static double left_of(const double from[2], const double to[2], const double at[2])
{
    return ((to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])) /
           hypot(to[0] - from[0], to[1] - from[1]);
}

/* Whether all corners lie at the left of a line through two corners, and the letters of a number at its right. */
static bool is_apart(const scene *s, const scene_label *number, double corners[8][2])
{
    const double width = (double)strlen(number->text) * s->text.width, height = s->text.height;
    for (int i = 0; i < 64; i++) {
        const double *from = corners[i / 8], *to = corners[i % 8];
        bool apart = hypot(to[0] - from[0], to[1] - from[1]) > 1;
        for (int j = 0; apart && j < 8; j++)
            apart = left_of(from, to, corners[j]) > -1e-3;
        for (int j = 0; apart && j < 4; j++)
            apart = left_of(from, to, (double[]){number->at[0] + j % 2 * width, number->at[1] + j / 2 * height}) < 1e-3;
        if (apart)
            return true;
    }
    return false;
}

static void axis_numbers_stand_beside_the_box_and_never_on_its_contents(void **state)
{
    (void)state;
    const octree_box worlds[] = {cube(-1000, 1000), {{512049, 5403029, 290}, {513149, 5404129, 420}}};
    for (int i = 0; i < 2 * 36; i++) {
        view v = view_of(1280, 720, i % 2 ? CAMERA_ORBIT : CAMERA_ISO, VIEW_ALL_LAYERS);
        v.look.given = true;
        v.look.azimuth = i * 10;
        v.look.elevation = i % 7 * 9 - 18;
        double corners[8][2];
        scene s = scene_of_world(&worlds[i % 3 > 0], &v);
        project(&s, &worlds[i % 3 > 0], corners);
        assert_true(count_numbers(&s) >= 4);
        for (size_t j = 0; j < s.labels.count; j++)
            assert_true(!is_number(&s.labels.items[j]) || is_apart(&s, &s.labels.items[j], corners));
        scene_release(&s);
    }
}

/* Along a level axis numbers are in the middle of their ticks and on one line; along an upright one they end at one
 * pixel. They are as far from the ends of their ticks in any camera. */
static void axis_numbers_are_aligned(void **state)
{
    (void)state;
    static const int sizes[][2] = {{640, 360}, {1280, 720}, {720, 1280}};
    const octree_box world = cube(-200, 200);
    for (int i = 0; i < 9; i++) {
        const int *size = sizes[i / 3];
        const view v =
            view_of(size[0], size[1], (view_camera[]){CAMERA_FRONT, CAMERA_TOP, CAMERA_SIDE}[i % 3], VIEW_ALL_LAYERS);
        scene s = scene_of_world(&world, &v);
        size_t ticks = 0;
        for (size_t j = 0; j < s.segments.count; j++)
            ticks += s.segments.items[j].style.layer == LAYER_WORLD;
        assert_true(count_numbers(&s) + 1 >= ticks); /* two meet in a corner */
        for (size_t j = 0; j < s.labels.count; j++) {
            const scene_label *label = &s.labels.items[j];
            double end[2];
            if (!is_number(label))
                continue;
            const double width = (double)strlen(label->text) * s.text.width, height = s.text.height;
            assert_true(camera_find_pixel(&s.camera, tick_of(&s, label->id)->ends[1], end));
            const bool level = label->at[1] >= end[1];
            const double aside = level ? label->at[0] + width / 2 - end[0] : label->at[1] + height / 2 - end[1];
            const double away = level ? label->at[1] - end[1] : end[0] - (label->at[0] + width);
            assert_true(fabs(aside) <= 1);
            assert_true(fabs(away - s.unit) <= 1);
        }
        scene_release(&s);
    }
}

static void axis_numbers_are_round_stand_at_their_tick_marks_and_do_not_touch(void **state)
{
    (void)state;
    static const octree_box worlds[] = {
        {{-1000, -1000, -1000}, {1000, 1000, 1000}},
        {{0, 0, 0}, {1, 2, 3}},
        {{-0.00123, 7, 1e-5}, {0.004, 7.01, 0.013}},
        {{512049.78, 5403029.6, -210.6}, {513149.9, 5404129.8, 889.5}},
        {{-0.5, -3, -1.5}, {4, 4, 4}},
        {{-1e200, -3e200, 0}, {1e200, 1e200, 2e200}},
        {{1e-300, 0, 0}, {9e-300, 5e-300, 2e-300}},
    };
    static const int sizes[][2] = {{640, 360}, {1280, 720}, {3840, 2160}};
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; i++) {
        for (int kind = 0; kind < CAMERA_COUNT; kind++) {
            const int *size = sizes[(i + (size_t)kind) % 3];
            const view v = view_of(size[0], size[1], (view_camera)kind, VIEW_ALL_LAYERS);
            scene s = scene_of_world(&worlds[i], &v);
            assert_true(count_numbers(&s) >= 3);
            check_numbers(&s, &worlds[i]);
            check_apart(&s);
            scene_release(&s);
        }
    }
}

static void axes_run_along_the_fitted_box_and_not_the_world(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1000, 1000), 1, 21, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{500, 500, 500}, {620, 540, 570}}, 2);
    view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = {0};
    v.fit = FIT_POINTS;
    camera_fit_points(&v, tree);
    build_tree(&s, &v, tree, "fitted");
    assert_true(count_numbers(&s) >= 5);
    check_numbers(&s, &v.focus);
    check_apart(&s);
    for (uint64_t axis = 0; axis < 3; axis++) {
        const scene_segment *line = tick_of(&s, axis);
        for (uint64_t i = 0; i < 3; i++) {
            const double from = line->ends[0][i], to = line->ends[1][i];
            assert_true(from == v.focus.min[i] || (i != axis && from == v.focus.max[i]));
            assert_true(to == (i == axis ? v.focus.max[i] : from));
        }
    }
    scene_release(&s);
    octree_destroy(tree);
}

/* The axes of a zoomed picture have at least two numbers each, also where no edge of the world is in the picture. At a
 * corner of the world, where the axes are half as long, they have at least one. A bar shows the scale: its length
 * in pixels is the number beside it. */
static void zoomed_picture_keeps_axis_numbers_and_has_a_scale_bar(void **state)
{
    (void)state;
    static const double places[][3] = {{0, 0, 0}, {400, -300, 200}, {1000, 1000, 1000}};
    const octree_box world = cube(-1000, 1000);
    for (int i = 0; i < 2 * 3 * 5; i++) {
        static const view_camera kinds[] = {CAMERA_ISO, CAMERA_ORBIT};
        view v = view_of(1280, 720, kinds[i % 2], VIEW_DEFAULT_LAYERS);
        v.zoom = (double[]){1.5, 4, 30, 1000, 1e6}[i / 6];
        v.center.given = true;
        memcpy(v.center.place, places[i / 2 % 3], sizeof v.center.place);
        scene s = scene_of_world(&world, &v);
        size_t on_axis[3] = {0}, bars = 0;
        for (size_t k = 0; k < s.labels.count; k++)
            if (is_number(&s.labels.items[k]))
                on_axis[s.labels.items[k].id / FIRST_ID - 1]++;
        for (int axis = 0; axis < 3; axis++)
            assert_true(on_axis[axis] >= (places[i / 2 % 3][0] < 1000 ? 2 : 1));
        for (size_t k = 0; k < s.labels.count; k++) {
            const scene_label *label = &s.labels.items[k];
            if (label->style.layer != LAYER_WORLD || label->id != SCALE_ID)
                continue;
            const double length = strtod(label->text, NULL), pixels = length / camera_world_length_of_pixel(&s.camera);
            bars++;
            assert_true(is_round(length, 2000 / v.zoom));
            for (size_t n = 0; n < s.panels.count; n++)
                if (s.panels.items[n].style.layer == LAYER_WORLD && s.panels.items[n].id == SCALE_ID + 1)
                    assert_true(fabs(s.panels.items[n].width - pixels) <= s.unit);
        }
        assert_int_equal(bars, 1);
        scene_release(&s);
    }
}

static void axes_have_no_numbers_without_the_text_or_world_layer(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    static const unsigned off[] = {LAYER_TEXT, LAYER_WORLD};
    for (size_t i = 0; i < 2; i++) {
        const view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS & ~(1u << off[i]));
        scene s = scene_of_world(&world, &v);
        assert_int_equal(count_numbers(&s), 0);
        assert_int_equal(s.segments.count, 0);
        scene_release(&s);
    }
}

static void axis_seen_end_on_has_no_numbers_and_no_letter(void **state)
{
    (void)state;
    static const struct {
        view_camera camera;
        uint64_t axis;
    } rows[] = {{CAMERA_TOP, 2}, {CAMERA_FRONT, 1}, {CAMERA_SIDE, 0}};
    const octree_box world = cube(-1000, 1000);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const view v = view_of(1280, 720, rows[i].camera, VIEW_ALL_LAYERS);
        scene s = scene_of_world(&world, &v);
        for (size_t j = 0; j < s.segments.count; j++)
            assert_true(s.segments.items[j].id / FIRST_ID != rows[i].axis + 1);
        size_t letters = 0;
        for (size_t j = 0; j < s.labels.count; j++) {
            const scene_label *label = &s.labels.items[j];
            const bool letter = label->style.layer == LAYER_WORLD && label->id < 3;
            letters += letter;
            assert_true(!letter || label->id != rows[i].axis);
        }
        assert_int_equal(letters, 2);
        assert_true(count_numbers(&s) >= 6);
        scene_release(&s);
    }
}

/* As far from there as a line and a quarter is high, on the way from the axis's start; of x and z that is the lowest
 * corner, of y one on the outline of the box. */
static void a_letter_stands_beyond_the_end_of_its_axis(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    const view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = scene_of_world(&world, &v);
    size_t letters = 0;
    for (size_t i = 0; i < s.labels.count; i++) {
        const scene_label *label = &s.labels.items[i];
        if (label->style.layer != LAYER_WORLD || label->id >= 3)
            continue;
        double start[2], end[2], corner[3] = {label->id == 1 ? 1000 : -1000, -1000, -1000};
        assert_true(camera_find_pixel(&s.camera, corner, start));
        corner[label->id] = 1000;
        assert_true(camera_find_pixel(&s.camera, corner, end));
        const double length = hypot(end[0] - start[0], end[1] - start[1]), beyond = 1.25 * s.text.height / length;
        assert_true(fabs(label->at[0] + s.text.width / 2.0 - end[0] - beyond * (end[0] - start[0])) <= 1);
        assert_true(fabs(label->at[1] + s.text.height / 2.0 - end[1] - beyond * (end[1] - start[1])) <= 1);
        letters++;
    }
    assert_int_equal(letters, 3);
    scene_release(&s);
}

/* The step between numbers stays the same while the camera orbits. */
static void orbiting_camera_keeps_the_step_between_numbers(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    const view v = view_of(640, 360, CAMERA_ORBIT, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene s = {0};
    size_t first = 0;
    for (int tick = 0; !octree_game_over(game); tick++, play_tick(game)) {
        size_t ticks = 0;
        build_tick(&s, &v, game);
        for (size_t i = 0; i < s.segments.count; i++)
            ticks += s.segments.items[i].style.layer == LAYER_WORLD;
        first = tick == 0 ? ticks : first;
        assert_int_equal(ticks, first);
        check_apart(&s);
    }
    assert_true(first >= 9);
    scene_release(&s);
    octree_game_destroy(game);
}

/* Worlds whose extent overflows, underflows, or is lost in rounding have no numbers, and nothing hangs. */
static void extreme_worlds_have_no_axis_numbers(void **state)
{
    (void)state;
    static const octree_box worlds[] = {
        {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
        {{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}},
        {{0, 0, 0}, {5e-324, 5e-324, 5e-324}},
        {{0, 0, 0}, {1e-323, 1e-323, 1e-323}},
    };
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; i++) {
        const view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS);
        scene s = scene_of_world(&worlds[i], &v);
        assert_int_equal(count_numbers(&s), 0);
        scene_release(&s);
    }
    const octree_box world = cube(-1, 1);
    const view tiny = view_of(24, 16, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = scene_of_world(&world, &tiny);
    assert_int_equal(count_numbers(&s), 0);
    scene_release(&s);
}

/* Coordinates of a map in metres. The numbers of an upright axis stand at the left, beside the text column. */
static void numbers_of_seven_digits_have_room(void **state)
{
    (void)state;
    const octree_box world = {{512000, 5403000, 0}, {513000, 5404000, 1000}};
    static const int sizes[][2] = {{700, 700}, {700, 900}, {1000, 1000}, {1920, 2000}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const view v = view_of(sizes[i][0], sizes[i][1], CAMERA_TOP, VIEW_DEFAULT_LAYERS);
        scene s = scene_of_world(&world, &v);
        size_t on_axis[3] = {0};
        for (size_t k = 0; k < s.labels.count; k++)
            if (is_number(&s.labels.items[k]))
                on_axis[s.labels.items[k].id / FIRST_ID - 1]++;
        assert_true(on_axis[0] >= 3 && on_axis[1] >= 3);
        scene_release(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axis_numbers_are_round_stand_at_their_tick_marks_and_do_not_touch),
        cmocka_unit_test(axis_numbers_stand_beside_the_box_and_never_on_its_contents),
        cmocka_unit_test(axis_numbers_are_aligned),
        cmocka_unit_test(axes_run_along_the_fitted_box_and_not_the_world),
        cmocka_unit_test(zoomed_picture_keeps_axis_numbers_and_has_a_scale_bar),
        cmocka_unit_test(axes_have_no_numbers_without_the_text_or_world_layer),
        cmocka_unit_test(axis_seen_end_on_has_no_numbers_and_no_letter),
        cmocka_unit_test(a_letter_stands_beyond_the_end_of_its_axis),
        cmocka_unit_test(orbiting_camera_keeps_the_step_between_numbers),
        cmocka_unit_test(extreme_worlds_have_no_axis_numbers),
        cmocka_unit_test(numbers_of_seven_digits_have_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
