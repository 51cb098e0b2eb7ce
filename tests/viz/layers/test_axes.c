/* SPDX-License-Identifier: MIT */
/* test_axes.c - the numbers along the edges of the world: round, where they say, apart from each other. */
#include "scenes.h"
#include "camera.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_ID 1000

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

/* A whole multiple of 1, 2 or 5 times a power of ten that is at least a thousandth of the extent. */
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

/* A number is that of its tick, which leads away from an edge of the box. */
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
                assert_true(tick->ends[0][other] == box->min[other] && tick->ends[1][other] < box->min[other]);
    }
}

/* Numbers and letters are told from what lies behind them by a rim, and hide no more of it. */
static void check_rims(const scene *s)
{
    for (size_t i = 0; i < s->panels.count; i++)
        assert_int_not_equal(s->panels.items[i].style.layer, LAYER_WORLD);
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_WORLD)
            assert_int_equal(s->labels.items[i].style.stroke, STROKE_CUT);
}

/* By the room that their letters take in pixels. */
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

static void numbers_are_round_and_stand_at_their_ticks_and_apart(void **state)
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
            assert_true(kind == CAMERA_FOLLOW || count_numbers(&s) >= 3);
            check_numbers(&s, &worlds[i]);
            check_apart(&s);
            scene_release(&s);
        }
    }
}

static void a_fitted_box_has_the_axes_and_not_the_world(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1000, 1000), 1, 21, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{500, 500, 500}, {620, 540, 570}}, 2);
    view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = {0};
    v.fit = FIT_POINTS;
    camera_fit(&v, tree);
    build_tree(&s, &v, tree, "fitted");
    assert_true(count_numbers(&s) >= 5);
    check_numbers(&s, &v.focus);
    check_apart(&s);
    for (uint64_t axis = 0; axis < 3; axis++) {
        const scene_segment *line = tick_of(&s, axis);
        assert_true(same_position(line->ends[0], v.focus.min) && line->ends[1][axis] == v.focus.max[axis]);
    }
    scene_release(&s);
    octree_destroy(tree);
}

static void without_text_or_world_there_are_none(void **state)
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

static void an_axis_that_is_seen_end_on_has_neither_numbers_nor_a_letter(void **state)
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

/* As far from there as a line and a half is high, on the way from the axis's start. */
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
        double start[2], end[2], corner[3] = {-1000, -1000, -1000};
        assert_true(camera_pixel(&s.camera, corner, start));
        corner[label->id] = 1000;
        assert_true(camera_pixel(&s.camera, corner, end));
        const double length = hypot(end[0] - start[0], end[1] - start[1]), beyond = 1.5 * s.text.height / length;
        assert_true(fabs(label->at[0] + s.text.width / 2.0 - end[0] - beyond * (end[0] - start[0])) <= 1);
        assert_true(fabs(label->at[1] + s.text.height / 2.0 - end[1] - beyond * (end[1] - start[1])) <= 1);
        letters++;
    }
    assert_int_equal(letters, 3);
    scene_release(&s);
}

/* Numbers of an orbit do not come and go with another distance between them. */
static void an_orbit_keeps_its_ticks(void **state)
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

/* Nor do they hang, where extents overflow, underflow, or have no digits of their own. */
static void worlds_without_room_for_numbers_have_none(void **state)
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_round_and_stand_at_their_ticks_and_apart),
        cmocka_unit_test(a_fitted_box_has_the_axes_and_not_the_world),
        cmocka_unit_test(without_text_or_world_there_are_none),
        cmocka_unit_test(an_axis_that_is_seen_end_on_has_neither_numbers_nor_a_letter),
        cmocka_unit_test(a_letter_stands_beyond_the_end_of_its_axis),
        cmocka_unit_test(an_orbit_keeps_its_ticks),
        cmocka_unit_test(worlds_without_room_for_numbers_have_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
