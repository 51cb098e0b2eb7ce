/* SPDX-License-Identifier: MIT */
/* test_camera_places.c - cameras at places where lines run through the eye: inside a node, on a plane, on an edge, at a
 * point; in any direction, also straight up. */
#include "frames.h"
#include "brute.h"
#include "layer.h"
#include "paint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 200

static octree *scattered(brute *points)
{
    const octree_box world = cube(-1000, 1000);
    brute_sample(points, OCTREE_SAMPLE_UNIFORM, 9, &world, 300);
    brute_insert(points, (double[]){250, 250, 250}, 300);
    return brute_tree(points, world, 4, 21);
}

/* The position of the camera in the world, and the three axes of its basis. */
typedef struct stand {
    double eye[3], right[3], up[3], forward[3];
} stand;

static const double places[][3] = {
    {317, -411, 92},    /* inside a leaf */
    {317, -411, 0},     /* on the plane that the root splits at */
    {500, 0, 0},        /* where two planes meet */
    {0, 0, 0},          /* where three planes meet: the lines of the root pass through the eye */
    {250, 250, 250},    /* at a point */
    {1000, 1000, 1000}, /* the world's corner */
};

static const double ways[][3][3] = {
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},                       /* straight up */
    {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},                       /* straight down */
    {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},                       /* along an axis, in a plane of the tree */
    {{0.6, -0.8, 0}, {0, 0, 1}, {0.8, 0.6, 0}},               /* level */
    {{0.6, -0.8, 0}, {-0.48, -0.36, 0.8}, {0.64, 0.48, 0.6}}, /* up and aside */
};

static void stand_at(scene *s, const double place[3], const double way[3][3])
{
    camera_to_unit_coordinates(&s->camera, place, s->camera.eye);
    memcpy(s->camera.right, way[0], sizeof s->camera.right);
    memcpy(s->camera.up, way[1], sizeof s->camera.up);
    memcpy(s->camera.forward, way[2], sizeof s->camera.forward);
}

static scene scene_from(const octree *tree, unsigned layers, const double place[3], const double way[3][3])
{
    view v = view_of(SIDE, SIDE, CAMERA_FOLLOW, layers);
    v.center.given = true;
    scene s = {0};
    build_tree(&s, &v, tree, "places");
    stand_at(&s, place, way);
    return s;
}

static size_t assert_drawable(const scene *s)
{
    painter p = {0};
    assert_true(painter_paint_scene(&p, s));
    assert_int_equal(p.overflowed, 0);
    for (size_t i = 0; i < p.quads.count; i++)
        for (int j = 0; j < 4; j++)
            assert_true(abs(p.quads.items[i].x[j]) < 1 << 23 && abs(p.quads.items[i].y[j]) < 1 << 23);
    const size_t count = p.quads.count;
    painter_release(&p);
    return count;
}

/* A point in front of the camera is drawn where a pinhole camera shows it. A point behind is not drawn: the number of
 * marks is the number of points in front. */
static void assert_points_in_front(const scene *s, const brute *points, const double place[3], const double way[3][3])
{
    uint8_t *frame = draw_once(s), *expected = calloc(SIDE, SIDE);
    assert_non_null(expected);
    for (size_t i = 0; i < points->count; i++) {
        double seen[3] = {0};
        for (int axis = 0; axis < 3; axis++)
            for (int j = 0; j < 3; j++)
                seen[axis] += way[axis][j] * (points->points[i].position[j] - place[j]) / 1000;
        if (seen[2] < s->camera.near)
            continue;
        const double x = floor(SIDE / 2 + s->camera.zoom * seen[0] / seen[2]),
                     y = floor(SIDE / 2 - s->camera.zoom * seen[1] / seen[2]);
        for (int j = 0; j < 9; j++) { /* a mark of three pixels, plus or minus one */
            const double px = x + j % 3 - 1, py = y + j / 3 - 1;
            if (px >= 0 && px < SIDE && py >= 0 && py < SIDE)
                expected[(int)py * SIDE + (int)px] = 1;
        }
        if (x >= 1 && x < SIDE - 1 && y >= 1 && y < SIDE - 1)
            assert_int_equal(frame[(int)y * SIDE + (int)x] / THEME_SHADES, ROLE_POINT);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        bool near_one = false;
        for (int j = 0; j < 9; j++) {
            const int x = i % SIDE + j % 3 - 1, y = i / SIDE + j / 3 - 1;
            near_one |= x >= 0 && x < SIDE && y >= 0 && y < SIDE && expected[y * SIDE + x];
        }
        assert_true(near_one || frame[i] == 0);
    }
    free(expected);
    free(frame);
}

static void every_position_and_direction_agrees_with_a_pinhole_camera(void **state)
{
    (void)state;
    brute points = {0};
    octree *tree = scattered(&points);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        for (size_t j = 0; j < sizeof ways / sizeof ways[0]; j++) {
            scene s = scene_from(tree, 1u << LAYER_POINTS, places[i], ways[j]);
            assert_points_in_front(&s, &points, places[i], ways[j]);
            scene_release(&s);
            s = scene_from(tree, 1u << LAYER_NODES | 1u << LAYER_WORLD, places[i], ways[j]);
            assert_true(assert_drawable(&s) > 0 || places[i][2] == 1000); /* from the corner, no point may be visible */
            scene_release(&s);
        }
    }
    octree_destroy(tree);
    brute_free(&points);
}

/* A box that reaches in front of the near plane is never left out as too small. */
static void the_node_around_the_camera_is_never_left_out_as_small(void **state)
{
    (void)state;
    brute points = {0};
    octree *tree = scattered(&points);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        for (size_t j = 0; j < sizeof ways / sizeof ways[0]; j++) {
            scene s = scene_from(tree, 0, places[i], ways[j]);
            octree_node leaf;
            assert_int_equal(octree_locate(tree, places[i], &leaf), OCTREE_OK);
            for (octree_address at = leaf.address; at; at >>= 3) {
                octree_node node;
                assert_int_equal(octree_node_at(tree, at, &node), OCTREE_OK);
                assert_true(isinf(camera_box_size_in_pixels(&s.camera, &node.box)));
            }
            scene_release(&s);
        }
    }
    octree_destroy(tree);
    brute_free(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_position_and_direction_agrees_with_a_pinhole_camera),
        cmocka_unit_test(the_node_around_the_camera_is_never_left_out_as_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
