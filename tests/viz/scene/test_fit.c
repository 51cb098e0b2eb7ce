/* SPDX-License-Identifier: MIT */
/* test_fit.c - --fit points frames the smallest box around the points shown at tick 0. */
#include "scenes.h"
#include "brute.h"
#include "camera.h"

#include <float.h>
#include <math.h>
#include <string.h>

static view fitting(view_camera camera)
{
    view v = view_of(440, 320, camera, VIEW_ALL_LAYERS);
    v.fit = FIT_POINTS;
    return v;
}

/* The bounding box of the points. */
static octree_box box_around(const brute *points)
{
    octree_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < points->count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            box.min[axis] = fmin(box.min[axis], points->points[i].position[axis]);
            box.max[axis] = fmax(box.max[axis], points->points[i].position[axis]);
        }
    }
    return box;
}

static bool same_box(const octree_box *a, const octree_box *b)
{
    return same_position(a->min, b->min) && same_position(a->max, b->max);
}

static void the_box_is_the_bounding_box_of_the_points(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        const octree_box world = cube(-1000, 1000);
        brute points = {0};
        brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, seed, &world, 50 * seed);
        octree *tree = brute_tree(&points, world, 4, 21);
        view v = fitting(CAMERA_ISO);
        camera_fit_points(&v, tree);
        const octree_box expected = box_around(&points);
        assert_int_equal(v.fit, FIT_BOX);
        assert_true(same_box(&v.focus, &expected));
        octree_destroy(tree);
        brute_free(&points);
    }
}

static void filtered_points_are_not_framed(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute points = {0}, shown = {0};
    brute_sample(&points, OCTREE_SAMPLE_UNIFORM, 4, &world, 2000);
    octree *tree = brute_tree(&points, world, 4, 21);
    view v = fitting(CAMERA_ISO);
    v.filter = (view_filter){.by_region = true, .region = {{-900, 0, 100}, {0, 500, 999}}};
    brute_range(&points, &v.filter.region, &shown);
    camera_fit_points(&v, tree);
    const octree_box expected = box_around(&shown);
    assert_true(shown.count > 50 && same_box(&v.focus, &expected));
    octree_destroy(tree);
    brute_free(&points);
    brute_free(&shown);
}

static void other_views_and_empty_trees_frame_the_world(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    view v = fitting(CAMERA_TOP);
    camera_fit_points(&v, tree);
    assert_int_equal(v.fit, FIT_WORLD);
    insert_all(tree, (const double[][3]){{0.5, 0.5, 0.5}}, 1);
    camera_fit_points(&v, tree);
    assert_int_equal(v.fit, FIT_WORLD);
    v.fit = FIT_BOX;
    v.focus = cube(0, 0.25);
    camera_fit_points(&v, tree);
    assert_true(v.fit == FIT_BOX && v.focus.max[0] == 0.25);
    v.fit = FIT_POINTS;
    v.filter = (view_filter){.by_region = true, .region = cube(-1, 0)};
    camera_fit_points(&v, tree);
    assert_int_equal(v.fit, FIT_WORLD);
    octree_destroy(tree);
}

static void one_point_and_equal_points_are_framed_by_their_cell(void **state)
{
    (void)state;
    static const double place[3] = {0.3, -0.7, 0.9};
    for (size_t count = 1; count <= 100; count += 33) {
        brute points = {0};
        for (size_t i = 0; i < count; i++)
            brute_insert(&points, place, i);
        octree *tree = brute_tree(&points, cube(-1, 1), 1, 6);
        octree_node leaf;
        assert_int_equal(octree_locate(tree, place, &leaf), OCTREE_OK);
        view v = fitting(CAMERA_FRONT);
        camera_fit_points(&v, tree);
        assert_int_equal(leaf.depth, count == 1 ? 0 : 6);
        assert_true(v.fit == FIT_BOX && same_box(&v.focus, &leaf.box));
        octree_destroy(tree);
        brute_free(&points);
    }
}

/* Trees whose points fill no volume, or have coordinates near the limits of doubles. */
static octree *odd_tree(size_t kind)
{
    static const double line[][3] = {{-0.5, 0.25, 0.25}, {0, 0.25, 0.25}, {0.5, 0.25, 0.25}, {0.75, 0.25, 0.25}};
    static const double plane[][3] = {{-0.5, -0.5, 1}, {0.5, 0.5, 1}, {0.5, -0.5, 1}};
    static const double ends[][3] = {{-DBL_MAX, -DBL_MAX, 0}, {DBL_MAX, DBL_MAX, 0}, {1, 2, 3}};
    static const double far[][3] = {{1e15, 1e15, 1e15}, {1e15 + 0.125, 1e15, 1e15}};
    static const double tiny[][3] = {{0, 0, 0}, {5e-324, 0, 0}};
    static const struct {
        octree_box world;
        const double (*points)[3];
        size_t count;
    } rows[] = {
        {{{-1, -1, -1}, {1, 1, 1}}, line, 4},
        {{{-1, -1, -1}, {1, 1, 1}}, plane, 3},
        {{{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}}, ends, 3},
        {{{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}}, far, 2},
        {{{0, 0, 0}, {1e-323, 1e-323, 1e-323}}, tiny, 2},
    };
    if (kind >= sizeof rows / sizeof rows[0])
        return NULL;
    octree *tree = make_tree(rows[kind].world, 1, 21, OCTREE_GROW);
    insert_all(tree, rows[kind].points, rows[kind].count);
    return tree;
}

static octree_walk_order assert_points_seen(const octree_node *node, void *context)
{
    const camera *c = context;
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        double seen[3], pixel[2];
        camera_transform(c, node->points[i].position, seen);
        camera_project(c, seen, pixel);
        assert_true(seen[2] > c->near);
        assert_true(pixel[0] >= 0 && pixel[0] <= 440 && pixel[1] >= 0 && pixel[1] <= 320);
    }
    return OCTREE_WALK_ON;
}

static void every_camera_but_the_follower_sees_all_points_of_odd_clouds(void **state)
{
    (void)state;
    octree *tree;
    for (size_t kind = 0; (tree = odd_tree(kind)); kind++) {
        for (int kind_of_camera = 0; kind_of_camera < CAMERA_COUNT; kind_of_camera++) {
            view v = fitting((view_camera)kind_of_camera);
            const octree_box world = octree_definition(tree).world;
            camera_fit_points(&v, tree);
            for (int i = 0; i < 3; i++)
                assert_true(v.focus.min[i] <= v.focus.max[i]);
            for (uint64_t tick = 0; kind_of_camera != CAMERA_FOLLOW && tick < 480; tick += 60) {
                camera c = camera_make(&v, (camera_window){0, 0, 440, 320}, &world, world.min, tick);
                octree_walk(tree, assert_points_seen, &c);
            }
            scene s = {0};
            build_tree(&s, &v, tree, "odd");
            assert_int_equal(s.refused, 0);
            scene_release(&s);
        }
        octree_destroy(tree);
    }
}

/* Scenes that are scaled by 2^600 or moved to 1e15 without rounding have the same pixels. Text is off, because the
 * numbers of the axes have different widths. */
static void fitted_pixels_do_not_depend_on_position_and_scale(void **state)
{
    (void)state;
    static const double places[][2] = {{0x1p600, 0}, {0x1p-600, 0}, {1, 1e15}};
    const double points[][3] = {{-8, 16, 24}, {40, 48, -56}, {64, 8, 8}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const double scale = places[i][0], offset = places[i][1];
        double moved[3][3];
        for (int j = 0; j < 9; j++)
            moved[j / 3][j % 3] = points[j / 3][j % 3] * scale + offset;
        octree *here = make_tree(cube(-128, 128), 1, 9, OCTREE_GROW);
        octree *there = make_tree(cube(-128 * scale + offset, 128 * scale + offset), 1, 9, OCTREE_GROW);
        insert_all(here, points, 3);
        insert_all(there, (const double(*)[3])moved, 3);
        view a = fitting(CAMERA_ORBIT), b = fitting(CAMERA_ORBIT);
        a.layers = b.layers &= ~(1u << LAYER_TEXT);
        scene s = {0}, t = {0};
        camera_fit_points(&a, here);
        camera_fit_points(&b, there);
        build_tree(&s, &a, here, "");
        build_tree(&t, &b, there, "");
        for (int j = 0; j < 3; j++) {
            double pixels[2][2];
            pixel_of(&s, points[j], pixels[0]);
            pixel_of(&t, moved[j], pixels[1]);
            assert_true(pixels[0][0] == pixels[1][0] && pixels[0][1] == pixels[1][1]);
        }
        scene_release(&s);
        scene_release(&t);
        octree_destroy(here);
        octree_destroy(there);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_box_is_the_bounding_box_of_the_points),
        cmocka_unit_test(filtered_points_are_not_framed),
        cmocka_unit_test(other_views_and_empty_trees_frame_the_world),
        cmocka_unit_test(one_point_and_equal_points_are_framed_by_their_cell),
        cmocka_unit_test(every_camera_but_the_follower_sees_all_points_of_odd_clouds),
        cmocka_unit_test(fitted_pixels_do_not_depend_on_position_and_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
