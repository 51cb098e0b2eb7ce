/* SPDX-License-Identifier: MIT */
/* test_both_fills.c - integers and GL draw every scene with the same pixels: lines across each border, places far
 * outside the picture, markers, letters and panels of any size, and whole sessions with all layers. */
#include "frames.h"
#include "camera.h"
#include "point_scale.h"
#include "random_session.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Renderers of both kinds with the same size. */
typedef struct both {
    renderer *integers, *gl;
} both;

static both open_both(const view *v)
{
    const int samples = v->aa;
    return (both){open_renderer(v->width * samples, v->height * samples),
                  open_gl_renderer(v->width * samples, v->height * samples)};
}

static void close_both(both *b)
{
    renderer_close(b->integers);
    renderer_close(b->gl);
}

static void assert_drawn_alike(const both *b, const scene *s)
{
    uint8_t *one = draw(b->integers, s), *other = draw(b->gl, s);
    const size_t width = (size_t)s->view.width * (size_t)s->view.aa;
    for (size_t i = 0; i < frame_samples(s); i++)
        if (one[i] != other[i])
            fail_msg("sample %zu %zu is %d by integers, %d by GL", i % width, i / width, one[i], other[i]);
    free(one);
    free(other);
}

/* ---- Random scenes ------------------------------------------------------------------------------------------ */

/* A number of the magnitude of `unit`, or, as often, a much larger one, up to 1e300, of either sign. */
static double some_number(uint64_t *random, double unit)
{
    static const double sizes[] = {1, 1, 1, 1, 1, 2, 10, 1e3, 1e6, 1e15, 1e150, 1e300};
    const double size = sizes[random_below(random, sizeof sizes / sizeof *sizes)];
    const double at = (double)random_below(random, 4097) / 2048 - 1;
    return at * unit * size;
}

static void some_place(uint64_t *random, double unit, double place[3])
{
    for (int axis = 0; axis < 3; axis++)
        place[axis] = some_number(random, unit);
}

static scene_style some_style(uint64_t *random)
{
    static const uint8_t widths[] = {1, 1, 1, 2, 3, 4, 9, 40, 255};
    return (scene_style){
        .layer = (uint8_t)random_below(random, LAYER_COUNT),
        .role = (uint8_t)random_below(random, ROLE_COUNT),
        .stroke = (uint8_t)random_below(random, STROKE_ARROW + 1),
        .width = widths[random_below(random, sizeof widths)],
    };
}

static void add_in_world(scene *s, uint64_t *random)
{
    scene_box box = {.style = some_style(random), .depth = (uint8_t)random_below(random, 20)};
    scene_segment line = {.style = some_style(random)};
    scene_marker mark = {.style = some_style(random), .shape = (uint8_t)random_below(random, SHAPE_COUNT)};
    scene_label label = {.style = some_style(random), .in_world = true, .text = "Octant 0/3/7"};
    some_place(random, 1.5, line.ends[0]);
    some_place(random, 1.5, line.ends[1]);
    some_place(random, 1.5, mark.at);
    some_place(random, 1.5, label.at);
    some_place(random, 1.5, box.box.min);
    for (int axis = 0; axis < 3; axis++)
        box.box.max[axis] = box.box.min[axis] + fabs(some_number(random, 1)) * (double)random_below(random, 2);
    scene_add_box(s, box);
    scene_add_segment(s, line);
    scene_add_marker(s, mark);
    scene_add_label(s, label);
}

static int some_pixel(uint64_t *random)
{
    static const int far[] = {INT_MIN, INT_MIN / 2, -70000, 70000, INT_MAX / 2, INT_MAX};
    return random_below(random, 8) ? (int)random_below(random, 400) - 100 : far[random_below(random, 6)];
}

static void add_in_picture(scene *s, uint64_t *random)
{
    const double side = s->view.width > s->view.height ? s->view.width : s->view.height;
    scene_segment line = {.style = some_style(random), .in_picture = true};
    scene_label label = {.style = some_style(random), .text = "Tick 219\nnearest"};
    scene_panel panel = {.style = some_style(random)};
    some_place(random, side, line.ends[0]);
    some_place(random, side, line.ends[1]);
    some_place(random, side, label.at);
    panel.x = some_pixel(random);
    panel.y = some_pixel(random);
    panel.width = abs(some_pixel(random) / 2);
    panel.height = abs(some_pixel(random) / 2);
    scene_add_segment(s, line);
    scene_add_label(s, label);
    if (random_below(random, 8) == 0) /* large panels cover the rest */
        scene_add_panel(s, panel);
}

static view some_view(uint64_t *random)
{
    static const int sizes[][2] = {{160, 90}, {128, 128}, {31, 200}, {256, 3}};
    const int *size = sizes[random_below(random, sizeof sizes / sizeof *sizes)];
    view v = view_of(size[0], size[1], (view_camera)random_below(random, CAMERA_COUNT), VIEW_ALL_LAYERS);
    v.aa = 1 + (int)random_below(random, 2);
    const bool zooms = random_below(random, 2);
    const double times = (double)(1 + random_below(random, 16)) * (random_below(random, 4) ? 0.25 : 1000);
    v.zoom = zooms ? times : 1;
    v.look.given = random_below(random, 3) == 0;
    v.look.azimuth = (double)random_below(random, 720) / 2;
    v.look.elevation = (double)random_below(random, 361) / 2 - 90;
    return v;
}

static void both_rasterizers_draw_random_scenes_alike(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    uint64_t random = 1;
    for (int round = 0; round < 60; round++) {
        const view v = some_view(&random);
        both b = open_both(&v);
        for (int frame = 0; frame < 12; frame++) {
            scene s = empty_scene(&v, &world);
            for (int i = 0; i < 8; i++) {
                add_in_world(&s, &random);
                add_in_picture(&s, &random);
            }
            assert_false(s.out_of_memory);
            assert_drawn_alike(&b, &s);
            scene_release(&s);
        }
        close_both(&b);
    }
}

/* Lines of all angles and widths that cross one or two borders of the picture, which GL would have to clip. */
static void both_rasterizers_draw_lines_across_borders_alike(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    uint64_t random = 2;
    view v = view_of(128, 128, CAMERA_TOP, VIEW_ALL_LAYERS);
    both b = open_both(&v);
    for (int frame = 0; frame < 200; frame++) {
        scene s = empty_scene(&v, &world);
        for (int i = 0; i < 30; i++) {
            scene_segment line = {.style = some_style(&random), .in_picture = true};
            for (int end = 0; end < 2; end++)
                for (int axis = 0; axis < 2; axis++)
                    line.ends[end][axis] = (double)random_below(&random, 256 * 256) / (frame % 2 ? 256 : 2) - 64;
            line.ends[1][i & 1] = line.ends[1][i & 1] / (double)(1 + i) + line.ends[0][i & 1];
            scene_add_segment(&s, line);
        }
        assert_drawn_alike(&b, &s);
        scene_release(&s);
    }
    close_both(&b);
}

/* ---- Sessions ----------------------------------------------------------------------------------------------- */

static void check_session(const octree_session *session, view v, uint64_t step)
{
    octree_game *game;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    camera_fit_points(&v, octree_game_tree(game));
    assert_true(point_scale_compute(&v, octree_game_tree(game), NULL));
    both b = open_both(&v);
    scene s = {0};
    for (uint64_t tick = 0; tick < 12 * step; tick++) {
        if (tick % step == 0) {
            build_tick(&s, &v, game);
            assert_drawn_alike(&b, &s);
            scene_clear(&s);
        }
        play_tick(game);
    }
    scene_release(&s);
    close_both(&b);
    octree_game_destroy(game);
}

static void both_rasterizers_draw_all_layers_alike(void **state)
{
    (void)state;
    static random_session made;
    octree_session session = session_with_all_layers();
    random_session_full(&made, 11);
    for (int i = 0; i < 2 * CAMERA_COUNT; i++) {
        view v = view_of(320, 180, (view_camera)(i / 2), VIEW_ALL_LAYERS);
        v.aa = 1 + i % 2;
        v.labels = true;
        v.diagram = i / 2 % 2 ? DIAGRAM_BESIDE : DIAGRAM_NONE;
        v.zoom = i % 3 == 0 ? 7 : 1; /* with zoom 7 most of the tree is outside the picture */
        v.point_color = (view_point_color)(i % POINTS_BY_COUNT);
        v.shade = (view_shade)(i % SHADE_COUNT);
        check_session(&session, v, 21);
        check_session(&made.session, v, 7);
    }
}

/* GL draws no wider picture, because it needs space for clipping. */
static void both_rasterizers_draw_the_widest_picture_alike(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    uint64_t random = 3;
    const view v = view_of(VIEW_MAX_SIDE, 40, CAMERA_FRONT, VIEW_ALL_LAYERS);
    both b = open_both(&v);
    scene s = empty_scene(&v, &world);
    for (int i = 0; i < 100; i++)
        add_in_picture(&s, &random);
    assert_drawn_alike(&b, &s);
    scene_release(&s);
    close_both(&b);
}

/* ---- Without GL --------------------------------------------------------------------------------------------- */

static void renderer_without_gl_draws_the_same(void **state)
{
    (void)state;
    octreel_error error = {""};
    scene s = busy_scene(320, 180, CAMERA_ORBIT);
    both b = {open_renderer(320, 180), open_gl_renderer(320, 180)};
    assert_drawn_alike(&b, &s);
    const renderer_info info = renderer_describe(b.integers), gl = renderer_describe(b.gl);
    assert_null(info.context);
    assert_string_equal(info.fill, "integers");
    assert_null(info.renderer);
    assert_string_equal(gl.fill, "gl");
    close_both(&b);
    scene_release(&s);
    assert_null(renderer_open(0, 180, &(renderer_choice){0}, &error));
    assert_null(renderer_open(1, VIEW_MAX_SIDE + 1, &(renderer_choice){0}, &error));
    assert_non_null(strstr(error.text, "16385"));
}

/* Both find the same element on top at each sample. */
static void both_rasterizers_find_the_same_elements(void **state)
{
    (void)state;
    octreel_error error = {""};
    scene s = busy_scene(320, 180, CAMERA_ORBIT);
    both b = open_both(&s.view);
    uint32_t *one = calloc(frame_samples(&s), sizeof *one), *other = calloc(frame_samples(&s), sizeof *other);
    assert_true(renderer_find_element_numbers(b.integers, &s, one, &error));
    assert_true(renderer_find_element_numbers(b.gl, &s, other, &error));
    assert_memory_equal(one, other, frame_samples(&s) * sizeof *one);
    for (int x = 0; x < 320; x += 17) {
        draw_covers a = {0}, c = {0};
        assert_true(renderer_list_pixel_covers(b.integers, &s, x, 90, &a, &error));
        assert_true(renderer_list_pixel_covers(b.gl, &s, x, 90, &c, &error));
        assert_int_equal(a.count, c.count);
        for (size_t i = 0; i < a.count; i++)
            assert_true(a.items[i].number == c.items[i].number && a.items[i].at == c.items[i].at &&
                        a.items[i].shown == c.items[i].shown);
        draw_covers_release(&a);
        draw_covers_release(&c);
    }
    free(one);
    free(other);
    close_both(&b);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_rasterizers_draw_random_scenes_alike),
        cmocka_unit_test(both_rasterizers_draw_lines_across_borders_alike),
        cmocka_unit_test(both_rasterizers_draw_all_layers_alike),
        cmocka_unit_test(both_rasterizers_draw_the_widest_picture_alike),
        cmocka_unit_test(renderer_without_gl_draws_the_same),
        cmocka_unit_test(both_rasterizers_find_the_same_elements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
