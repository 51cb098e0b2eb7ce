/* SPDX-License-Identifier: MIT */
/* test_renderer.c - renderers accept certain sizes, and draw the same frame for the same scene. */
#include "frames.h"
#include "layer.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Run a check in a child process, which may change its environment. Returns its result, 0 to 2. */
typedef int (*child_check)(void);

static int run_child(child_check check)
{
    int status = 0;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(check());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

enum { REFUSED_WITH_REASON = 0, REFUSED_WITHOUT = 1, DRAWN = 2 };

/* The driver would be refused, too: an error about the size shows that no context was opened. */
static int ask_for_a_size_too_large(void)
{
    octreel_error error = {""};
    setenv("GALLIUM_DRIVER", "softpipe", 1);
    if (renderer_open(16385, 1, &(renderer_choice){0}, &error))
        return DRAWN;
    return strstr(error.text, "16385 x 1") ? REFUSED_WITH_REASON : REFUSED_WITHOUT;
}

static void invalid_size_is_refused_before_a_context_is_opened(void **state)
{
    (void)state;
    assert_int_equal(run_child(ask_for_a_size_too_large), REFUSED_WITH_REASON);
}

static void error_names_a_size_out_of_range(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        const char *named;
    } rows[] = {
        {0, 0, "0 x 0"},           {0, 720, "0 x 720"},
        {1280, 0, "1280 x 0"},     {-1, 5, "-1 x 5"},
        {5, INT_MIN, "5 x -2147"}, {16385, 1, "16385 x 1"},
        {1, 16385, "1 x 16385"},   {INT_MAX, INT_MAX, "2147483647 x 2147483647"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        octreel_error error = {""};
        assert_null(renderer_open(rows[i].width, rows[i].height, &(renderer_choice){0}, &error));
        assert_non_null(strstr(error.text, rows[i].named));
        assert_non_null(strstr(error.text, "16384"));
    }
}

static void renderer_names_its_libraries(void **state)
{
    (void)state;
    renderer *r = open_gl_renderer(16, 16);
    const renderer_info about = renderer_describe(r);
    assert_true(strcmp(about.context, "osmesa") == 0 || strcmp(about.context, "egl") == 0);
    assert_non_null(about.vendor);
    assert_non_null(about.version);
    assert_int_equal(strncmp(about.renderer, "llvmpipe", 8), 0);
    renderer_close(r);
    renderer_close(NULL);
}

/* The default rasterizer, and GL. */
static renderer *(*const open_either[])(int width, int height) = {open_renderer, open_gl_renderer};

static void extreme_sizes_are_drawn_to_their_edges(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 16384}, {16384, 1}, {16384, 3}, {7, 4099}, {255, 257}};
    for (size_t i = 0; i < 2 * (sizeof sizes / sizeof sizes[0]); i++) {
        const int width = sizes[i / 2][0], height = sizes[i / 2][1];
        const view v = view_of(width, height, CAMERA_ISO, VIEW_ALL_LAYERS);
        const octree_box world = cube(-1, 1);
        const scene_style style = {.layer = LAYER_TEXT, .role = ROLE_TEXT};
        scene s = empty_scene(&v, &world);
        renderer *r = open_either[i % 2](width, height);
        uint8_t *blank = draw(r, &s);
        assert_int_equal(lit_pixels(blank, &s), 0);
        scene_add_panel(&s, (scene_panel){.x = 0, .y = 0, .width = 1, .height = 1, .style = style});
        scene_add_panel(&s, (scene_panel){.x = width - 1, .y = height - 1, .width = 1, .height = 1, .style = style});
        uint8_t *corners = draw(r, &s);
        assert_int_equal(lit_pixels(corners, &s), width * height == 1 ? 1 : 2);
        assert_int_equal(corners[0], theme_color_index(ROLE_TEXT, 0));
        assert_int_equal(corners[(size_t)width * (size_t)height - 1], theme_color_index(ROLE_TEXT, 0));
        free(blank);
        free(corners);
        scene_release(&s);
        s = busy_scene(width, height, CAMERA_ORBIT);
        uint8_t *busy = draw(r, &s);
        assert_true(lit_pixels(busy, &s) > 0);
        free(busy);
        scene_release(&s);
        renderer_close(r);
    }
}

/* The picture has a quarter of a billion pixels: only some of them are checked. */
static void check_largest_picture(renderer *(*open)(int width, int height))
{
    enum { SIDE = VIEW_MAX_SIDE };
    const view v = view_of(SIDE, SIDE, CAMERA_ISO, VIEW_ALL_LAYERS);
    const octree_box world = cube(-1, 1);
    const scene_style style = {.layer = LAYER_TEXT, .role = ROLE_TEXT};
    const size_t last = (size_t)SIDE * SIDE - 1;
    octreel_error error = {""};
    scene s = empty_scene(&v, &world);
    for (int i = 0; i < 4; i++)
        scene_add_panel(
            &s,
            (scene_panel){.x = i % 2 * (SIDE - 1), .y = i / 2 * (SIDE - 1), .width = 1, .height = 1, .style = style});
    renderer *r = open(SIDE, SIDE);
    uint8_t *frame = malloc(last + 1);
    assert_non_null(frame);
    if (!renderer_draw_scene(r, &s, frame, &error))
        fail_msg("%s", error.text);
    const size_t corners[4] = {0, SIDE - 1, last - SIDE + 1, last};
    for (int i = 0; i < 4; i++)
        assert_int_equal(frame[corners[i]], theme_color_index(ROLE_TEXT, 0));
    const uint8_t *first = memchr(frame + 1, frame[0], last);
    assert_ptr_equal(first, frame + SIDE - 1);
    free(frame);
    scene_release(&s);
    renderer_close(r);
}

static void largest_picture_is_drawn_to_its_corners(void **state)
{
    (void)state;
    check_largest_picture(open_either[0]);
    check_largest_picture(open_either[1]);
}

/* Infinite coordinates, and coordinates that overflow when projected. NaN is refused when an element is added. */
static void elements_that_are_not_finite_are_counted_and_change_no_pixel(void **state)
{
    (void)state;
    static const double wrong[] = {NAN, INFINITY, -INFINITY};
    scene s = busy_scene(320, 180, CAMERA_FOLLOW);
    renderer *r = open_renderer(320, 180);
    uint8_t *before = draw(r, &s);
    assert_int_equal(renderer_left_out_count(r), 0);
    for (size_t w = 0; w < 3; w++) {
        for (int axis = 0; axis < 3; axis++) {
            scene_box box = {.box = cube(-100, 100),
                             .style = {.layer = LAYER_NODES, .role = ROLE_COLLISION, .width = 9}};
            scene_segment segment = {.ends = {{1, 2, 3}, {4, 5, 6}}, .style = box.style};
            scene_marker marker = {.style = box.style};
            scene_label label = {.in_world = true, .text = "X", .style = box.style};
            box.box.max[axis] = segment.ends[1][axis] = marker.at[axis] = label.at[axis] = wrong[w];
            scene_add_box(&s, box);
            scene_add_segment(&s, segment);
            scene_add_marker(&s, marker);
            scene_add_label(&s, label);
        }
    }
    assert_int_equal(s.refused, 3 * 3 * 4);
    uint8_t *after = draw(r, &s);
    assert_same_frame(before, after, &s);
    assert_int_equal(renderer_left_out_count(r), s.refused);
    free(before);
    free(after);
    scene_release(&s);
    renderer_close(r);
}

static void scene_of_another_size_is_refused(void **state)
{
    (void)state;
    static const int sizes[][2] = {{32, 31}, {31, 32}, {33, 32}, {32, 33}, {16, 64}, {64, 16}};
    renderer *r = open_renderer(32, 32);
    uint8_t frame[64 * 64] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        octreel_error error = {""};
        scene s = busy_scene(sizes[i][0], sizes[i][1], CAMERA_ISO);
        assert_false(renderer_draw_scene(r, &s, frame, &error));
        assert_non_null(strstr(error.text, "size"));
        for (size_t pixel = 0; pixel < sizeof frame; pixel++)
            assert_int_equal(frame[pixel], 0);
        scene_release(&s);
    }
    renderer_close(r);
}

static void frame_is_the_same_after_others_and_by_another_renderer(void **state)
{
    (void)state;
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        scene s = busy_scene(320, 180, (view_camera)kind);
        scene other = busy_scene(320, 180, (view_camera)((kind + 1) % CAMERA_COUNT));
        renderer *first = open_renderer(320, 180);
        uint8_t *a = draw(first, &s), *between = draw(first, &other), *b = draw(first, &s);
        renderer_close(first);
        renderer *second = open_renderer(320, 180);
        uint8_t *c = draw(second, &s);
        renderer_close(second);
        assert_true(lit_pixels(a, &s) > 1000);
        assert_same_frame(a, b, &s);
        assert_same_frame(a, c, &s);
        assert_memory_not_equal(a, between, 320 * 180);
        free(a);
        free(between);
        free(b);
        free(c);
        scene_release(&s);
        scene_release(&other);
    }
}

static void two_renderers_at_once_do_not_disturb_each_other(void **state)
{
    (void)state;
    scene small = busy_scene(160, 90, CAMERA_ISO), large = busy_scene(320, 180, CAMERA_ORBIT);
    renderer *first = open_renderer(160, 90);
    uint8_t *alone = draw(first, &small);
    renderer *second = open_renderer(320, 180);
    uint8_t *a = draw(first, &small), *b = draw(second, &large);
    assert_same_frame(alone, a, &small);
    renderer_close(second);
    uint8_t *after = draw(first, &small);
    assert_same_frame(alone, after, &small);
    renderer_close(first);
    second = open_renderer(320, 180);
    uint8_t *c = draw(second, &large);
    assert_same_frame(b, c, &large);
    renderer_close(second);
    free(alone);
    free(a);
    free(b);
    free(after);
    free(c);
    scene_release(&small);
    scene_release(&large);
}

/* The test fails unless frames of the default session, moved and scaled, have the same pixels; without text, which
 * shows the coordinates. */
static void assert_same_frames_elsewhere(renderer *r, view_camera camera, double scale, double offset)
{
    const view v = view_of(320, 180, camera, VIEW_ALL_LAYERS & ~(1u << LAYER_TEXT));
    const octree_session session = octree_session_default();
    scaled_session made;
    scene a = {0}, b = {0};
    scale_session(&made, scale, offset);
    octree_game *here = start_game(&session), *there = start_game(&made.session);
    for (int tick = 0; !octree_game_over(here); tick++, play_tick(here), play_tick(there)) {
        if (tick % 43 != 0)
            continue;
        build_tick(&a, &v, here);
        build_tick(&b, &v, there);
        uint8_t *first = draw(r, &a), *second = draw(r, &b);
        assert_true(lit_pixels(first, &a) > 500);
        assert_same_frame(first, second, &a);
        free(first);
        free(second);
    }
    octree_game_destroy(here);
    octree_game_destroy(there);
    scene_release(&a);
    scene_release(&b);
}

static void frame_does_not_depend_on_place_and_scale_of_the_world(void **state)
{
    (void)state;
    renderer *r = open_renderer(320, 180);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        assert_same_frames_elsewhere(r, (view_camera)kind, 1, 1e15);
        assert_same_frames_elsewhere(r, (view_camera)kind, ldexp(1, -1000), 0);
        assert_same_frames_elsewhere(r, (view_camera)kind, ldexp(1, 620), ldexp(-1e15, 620));
    }
    renderer_close(r);
}

/* Segments to far points and to points behind the eye, all in one frame: it is drawn, in colours of the theme. */
static void segments_to_far_points_are_drawn(void **state)
{
    (void)state;
    static const double sizes[] = {0, 1, 1e16, 1e100, 1e300, 1.7e308};
    uint64_t random = 3;
    renderer *r = open_renderer(64, 64);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        const octree_box world = cube(-1, 1);
        const view v = view_of(64, 64, (view_camera)kind, VIEW_ALL_LAYERS);
        scene s = empty_scene(&v, &world);
        for (uint64_t i = 0; i < 2000; i++) {
            scene_segment segment = {.id = i, .style = {.role = ROLE_RANGE, .stroke = (uint8_t)(i % 2), .width = 1}};
            for (int j = 0; j < 6; j++)
                segment.ends[j / 3][j % 3] =
                    sizes[random_below(&random, sizeof sizes / sizeof sizes[0])] * (random_below(&random, 2) ? 1 : -1);
            scene_add_segment(&s, segment);
        }
        uint8_t *frame = draw(r, &s);
        assert_true(lit_pixels(frame, &s) > 0);
        free(frame);
        scene_release(&s);
    }
    renderer_close(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        /* The test with a child process comes first, because Mesa's threads do not survive a fork. */
        cmocka_unit_test(invalid_size_is_refused_before_a_context_is_opened),
        cmocka_unit_test(error_names_a_size_out_of_range),
        cmocka_unit_test(renderer_names_its_libraries),
        cmocka_unit_test(extreme_sizes_are_drawn_to_their_edges),
        cmocka_unit_test(largest_picture_is_drawn_to_its_corners),
        cmocka_unit_test(elements_that_are_not_finite_are_counted_and_change_no_pixel),
        cmocka_unit_test(scene_of_another_size_is_refused),
        cmocka_unit_test(frame_is_the_same_after_others_and_by_another_renderer),
        cmocka_unit_test(two_renderers_at_once_do_not_disturb_each_other),
        cmocka_unit_test(frame_does_not_depend_on_place_and_scale_of_the_world),
        cmocka_unit_test(segments_to_far_points_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
