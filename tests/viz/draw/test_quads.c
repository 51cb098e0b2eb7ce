/* SPDX-License-Identifier: MIT */
/* test_quads.c - the quads of a scene are in painter's order before they are rasterized. */
#include "scenes.h"
#include "paint.h"

#include <math.h>
#include <stdlib.h>

static void quads_are_sorted_by_layer_then_band_then_depth(void **state)
{
    (void)state;
    int last = -1;
    for (unsigned layer = 0; layer < LAYER_COUNT; layer++) {
        for (int band = QUAD_BANDS - 1; band >= 0; band--) {
            for (int depth = OCTREE_MAX_DEPTH; depth >= 0; depth--) {
                const int order = make_quad_order(layer, (unsigned)band, (unsigned)depth);
                assert_true(order > last);
                last = order;
            }
        }
    }
}

/* No point, player or collision box hides the rank of a neighbour. */
static void ranks_of_neighbours_lie_above_points_and_boxes(void **state)
{
    (void)state;
    static const unsigned below[] = {LAYER_POINTS,  LAYER_VELOCITIES, LAYER_RANGE, LAYER_RADIUS,
                                     LAYER_NEAREST, LAYER_PLAYER,     LAYER_BOX,   LAYER_KNEAREST};
    for (size_t i = 0; i < sizeof below / sizeof below[0]; i++)
        assert_true(make_text_order(LAYER_KNEAREST) > make_quad_order(below[i], 0, 0));
}

static quad random_quad(uint64_t *random, int number)
{
    quad q = {.color = (uint8_t)random_below(random, 256)};
    q.x[0] = number;
    q.order = make_quad_order((unsigned)random_below(random, LAYER_COUNT), (unsigned)random_below(random, QUAD_BANDS),
                              (unsigned)random_below(random, OCTREE_MAX_DEPTH + 1));
    return q;
}

static void sorting_keeps_every_quad_and_the_order_of_equals(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int count = 0; count < 5000; count = 2 * count + 1) {
        quad_list list = {0};
        uint64_t sum = 0;
        for (int i = 0; i < count; i++) {
            const quad q = random_quad(&random, i);
            quads_add_quad(&list, &q);
            sum += (uint64_t)(i + 1) * (q.order + UINT64_C(65536) * q.color);
        }
        assert_true(quads_sort(&list));
        assert_int_equal(list.count, count);
        for (int i = 0; i < count; i++) {
            const quad *q = &list.items[i];
            sum -= (uint64_t)(q->x[0] + 1) * (q->order + UINT64_C(65536) * q->color);
            assert_true(i == 0 || q[-1].order < q->order || (q[-1].order == q->order && q[-1].x[0] < q->x[0]));
        }
        assert_true(sum == 0);
        quads_release(&list);
    }
}

/* The test fails unless floats, which GL takes, hold the coordinates exactly. */
static void assert_drawable(const quad_list *quads)
{
    for (size_t i = 0; i < quads->count; i++) {
        const quad *q = &quads->items[i];
        assert_true(q->color < THEME_COLORS);
        assert_true(i == 0 || q[-1].order <= q->order);
        for (int j = 0; j < 4; j++) {
            assert_true(abs(q->x[j]) < 1 << 23);
            assert_true(abs(q->y[j]) < 1 << 23);
        }
    }
}

static void quads_of_every_tick_are_in_painters_order_within_23_bits(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 720}, {320, 180}, {16384, 16}, {1, 1}};
    const octree_session session = octree_session_default();
    painter p = {0};
    scene s = {0};
    octree_game *game = start_game(&session);
    for (unsigned tick = 0; !octree_game_over(game); tick++) {
        const int *size = sizes[tick % 4];
        const view v = view_of(size[0], size[1], (view_camera)(tick % CAMERA_COUNT), VIEW_ALL_LAYERS);
        play_tick(game);
        build_tick(&s, &v, game);
        assert_true(painter_paint_scene(&p, &s));
        assert_true(p.quads.count > 0);
        assert_int_equal(p.overflowed, 0);
        assert_drawable(&p.quads);
    }
    octree_game_destroy(game);
    scene_release(&s);
    painter_release(&p);
}

static scene point_scene(view_camera kind)
{
    const octree_box world = cube(-1, 1);
    const view v = view_of(100, 100, kind, VIEW_ALL_LAYERS);
    return empty_scene(&v, &world);
}

static void add_point(scene *s, uint64_t id, double x, double y, double z)
{
    const scene_style style = {.layer = LAYER_POINTS, .role = ROLE_POINT, .width = 2};
    scene_add_marker(s, (scene_marker){.id = id, .at = {x, y, z}, .style = style});
}

static void points_on_one_pixel_are_one_quad_in_the_nearest_band(void **state)
{
    (void)state;
    painter p = {0};
    scene s = point_scene(CAMERA_TOP);
    for (int i = 0; i < 1000; i++) /* points on one pixel, seen from above; the nearest is neither first nor last */
        add_point(&s, (uint64_t)i, 0.001, -0.001, (i * 7 % 1000) / 500.0 - 1);
    assert_true(painter_paint_scene(&p, &s));
    assert_int_equal(p.quads.count, 1);
    assert_int_equal(p.quads.items[0].color, theme_color_index(ROLE_POINT, 0));
    add_point(&s, 1000, 0.5, 0.5, -1);
    assert_true(painter_paint_scene(&p, &s));
    assert_int_equal(p.quads.count, 2);
    assert_int_equal(p.quads.items[0].color,
                     theme_color_index(ROLE_POINT, THEME_SHADES - 1)); /* the farther one first */
    scene_release(&s);
    painter_release(&p);
}

/* The same points in another order give the same quads, whichever of the points on a pixel is painted. */
static void quads_do_not_depend_on_the_order_of_points(void **state)
{
    (void)state;
    painter forth = {0}, back = {0};
    scene a = point_scene(CAMERA_ISO), b = point_scene(CAMERA_ISO);
    double(*at)[3] = malloc(5000 * sizeof *at);
    assert_non_null(at);
    uint64_t random = 2;
    for (int i = 0; i < 5000; i++)
        for (int axis = 0; axis < 3; axis++)
            at[i][axis] = random_between(&random, -0.3, 0.3);
    for (int i = 0; i < 5000; i++) {
        add_point(&a, (uint64_t)i, at[i][0], at[i][1], at[i][2]);
        add_point(&b, (uint64_t)i, at[4999 - i][0], at[4999 - i][1], at[4999 - i][2]);
    }
    assert_true(painter_paint_scene(&forth, &a) && painter_paint_scene(&back, &b));
    assert_int_equal(forth.quads.count, back.quads.count);
    assert_true(forth.quads.count < 2000);
    for (unsigned band = 0; band < QUAD_BANDS; band++) {
        int64_t sum = 0; /* the sum of all coordinates in this band */
        for (size_t i = 0; i < forth.quads.count; i++) {
            const quad *q = &forth.quads.items[i], *r = &back.quads.items[i];
            sum += q->color == theme_color_index(ROLE_POINT, band) ? q->x[0] * INT64_C(100003) + q->y[0] : 0;
            sum -= r->color == theme_color_index(ROLE_POINT, band) ? r->x[0] * INT64_C(100003) + r->y[0] : 0;
        }
        assert_true(sum == 0);
    }
    free(at);
    scene_release(&a);
    scene_release(&b);
    painter_release(&forth);
    painter_release(&back);
}

static void elements_that_overflow_a_double_are_counted_and_not_drawn(void **state)
{
    (void)state;
    const octree_box tiny = cube(-1e-300, 1e-300);
    const view v = view_of(100, 100, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &tiny);
    painter p = {0};
    scene_add_segment(&s, (scene_segment){.ends = {{-1e300, 0, 0}, {1e300, 0, 0}}});
    assert_true(painter_paint_scene(&p, &s));
    assert_int_equal(p.overflowed, 1);
    assert_int_equal(p.quads.count, 0);
    scene_release(&s);
    painter_release(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quads_are_sorted_by_layer_then_band_then_depth),
        cmocka_unit_test(ranks_of_neighbours_lie_above_points_and_boxes),
        cmocka_unit_test(sorting_keeps_every_quad_and_the_order_of_equals),
        cmocka_unit_test(quads_of_every_tick_are_in_painters_order_within_23_bits),
        cmocka_unit_test(points_on_one_pixel_are_one_quad_in_the_nearest_band),
        cmocka_unit_test(quads_do_not_depend_on_the_order_of_points),
        cmocka_unit_test(elements_that_overflow_a_double_are_counted_and_not_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
