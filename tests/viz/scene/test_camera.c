/* SPDX-License-Identifier: MIT */
/* test_camera.c - cameras: turns, bases, the visible region, and independence of the position and scale of the world.
 */
#include "scenes.h"

#include <float.h>
#include <math.h>

static const camera_window window = {40, 10, 400, 300};

static camera camera_of(view_camera kind, const octree_box *world, const double player[3], uint64_t tick)
{
    const view v = view_of(440, 320, kind, VIEW_ALL_LAYERS);
    return camera_make(&v, window, world, player, tick);
}

static void turns_agree_with_the_sine_and_cosine_of_libm(void **state)
{
    (void)state;
    const long double pi = acosl(-1);
    uint64_t random = 3;
    for (int i = 0; i < 20000; i++) {
        const double turns = i < 4800 ? (i - 2400) / 480.0 : random_between(&random, -3, 3);
        double cosine, sine;
        camera_compute_cosine_sine(turns, &cosine, &sine);
        assert_true(fabsl(cosine - cosl(2 * pi * turns)) < 1e-15L);
        assert_true(fabsl(sine - sinl(2 * pi * turns)) < 1e-15L);
    }
}

static void quarter_turns_are_exact(void **state)
{
    (void)state;
    static const double exact[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int quarter = -9; quarter <= 9; quarter++) {
        double cosine, sine;
        camera_compute_cosine_sine(quarter / 4.0, &cosine, &sine);
        assert_true(cosine == exact[quarter & 3][0] && sine == exact[quarter & 3][1]);
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void every_basis_is_orthonormal_and_right_handed(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    const double player[3] = {50, -150, 300};
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        for (uint64_t tick = 0; tick < 1000; tick += 7) {
            const camera c = camera_of((view_camera)kind, &world, player, tick);
            const double *axes[3] = {c.right, c.up, c.forward};
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    assert_true(fabs(dot(axes[i], axes[j]) - (i == j)) < 1e-15);
            for (int i = 0; i < 3; i++) { /* the cross product of right and up points toward the eye */
                const int j = (i + 1) % 3, k = (i + 2) % 3;
                assert_true(fabs(c.right[j] * c.up[k] - c.right[k] * c.up[j] + c.forward[i]) < 1e-15);
            }
        }
    }
}

/* Worlds of all shapes that a tree accepts. */
static const octree_box worlds[] = {
    {{-1000, -1000, -1000}, {1000, 1000, 1000}},
    {{0, 0, 0}, {1, 2, 3}},
    {{-1, -1, -1e-3}, {1, 1, 1e-3}},
    {{-1e-3, -1e-3, -1}, {1e-3, 1e-3, 1}},
    {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}},
    {{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}},
    {{-1e200, -1e200, -1e200}, {1e200, 1e200, 1e200}},
    {{-1, -1e-300, -1e-300}, {1, 1e-300, 1e-300}},
    {{-1e300, -1, -1}, {1e300, 1, 1}},
    {{1e-300, 1e-300, 1e-300}, {2e-300, 2e-300, 2e-300}},
    {{0, 0, 0}, {DBL_MAX, DBL_MAX, DBL_MAX}},
    {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
    {{5e-324, 5e-324, 5e-324}, {1e-310, 1e-310, 1e-310}},
    {{0, 0, 0}, {5e-324, 5e-324, 5e-324}},
    {{-1, -1e-308, -1e-308}, {1, 1e-308, 1e-308}},
};

static void assert_in_window(const double pixel[2])
{
    assert_true(pixel[0] >= window.x && pixel[0] <= window.x + window.width);
    assert_true(pixel[1] >= window.y && pixel[1] <= window.y + window.height);
}

static void the_corners_of_any_world_are_in_the_window_and_before_the_camera(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof worlds / sizeof worlds[0]; i++) {
        for (int kind = 0; kind < CAMERA_COUNT; kind++) {
            for (uint64_t tick = 0; kind != CAMERA_FOLLOW && tick < 480; tick += 37) {
                const camera c = camera_of((view_camera)kind, &worlds[i], worlds[i].min, tick);
                for (unsigned corner = 0; corner < 8; corner++) {
                    double position[3], seen[3], pixel[2];
                    box_corner(&worlds[i], corner, position);
                    camera_transform(&c, position, seen);
                    camera_project(&c, seen, pixel);
                    assert_in_window(pixel);
                    assert_true(seen[2] > c.near);
                    assert_true(seen[2] > c.near_depth - 1e-9 && seen[2] < c.far_depth + 1e-9);
                }
            }
        }
    }
}

static void an_orthographic_world_fills_most_of_the_window(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    for (int kind = CAMERA_ISO; kind <= CAMERA_SIDE; kind++) {
        const camera c = camera_of((view_camera)kind, &world, world.min, 0);
        double low = window.height, high = 0;
        for (unsigned corner = 0; corner < 8; corner++) {
            double position[3], seen[3], pixel[2];
            box_corner(&world, corner, position);
            camera_transform(&c, position, seen);
            camera_project(&c, seen, pixel);
            low = fmin(low, pixel[1]);
            high = fmax(high, pixel[1]);
        }
        assert_true(high - low > 0.7 * window.height);
    }
}

static void axes_point_as_the_camera_names_state(void **state)
{
    (void)state;
    static const struct {
        view_camera kind;
        double right[3], up[3], forward[3];
    } rows[] = {
        {CAMERA_TOP, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {CAMERA_FRONT, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {CAMERA_SIDE, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}},
    };
    const octree_box world = cube(-1, 1);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const camera c = camera_of(rows[i].kind, &world, world.min, 11);
        assert_true(same_position(c.right, rows[i].right));
        assert_true(same_position(c.up, rows[i].up));
        assert_true(same_position(c.forward, rows[i].forward));
    }
}

static void the_camera_that_follows_looks_at_the_player(void **state)
{
    (void)state;
    const octree_box world = {{-10, 0, 5}, {30, 80, 9}};
    uint64_t random = 5;
    for (int i = 0; i < 200; i++) {
        double player[3], seen[3], pixel[2];
        for (int axis = 0; axis < 3; axis++)
            player[axis] = random_between(&random, world.min[axis], world.max[axis]);
        const camera c = camera_of(CAMERA_FOLLOW, &world, player, (uint64_t)i);
        camera_transform(&c, player, seen);
        camera_project(&c, seen, pixel);
        assert_true(seen[2] > c.near);
        assert_true(fabs(pixel[0] - (window.x + window.width / 2)) < 1e-9);
        assert_true(fabs(pixel[1] - (window.y + window.height / 2)) < 1e-9);
    }
}

/* An orbit keeps the world in the window and fills it up to a margin, which is equal above and below. This also holds
 * beside a diagram, where the window is higher than wide. */
static void an_orbit_keeps_the_world_in_the_window(void **state)
{
    (void)state;
    static const double windows[][2] = {{960, 720}, {480, 720}, {500, 500}, {1200, 300}};
    const octree_box worlds[] = {cube(-1000, 1000), {{0, 0, 0}, {900, 300, 20}}, {{-1, -1, -9}, {1, 1, 9}}};
    for (int i = 0; i < 12; i++) {
        const double *size = windows[i % 4];
        const octree_box *world = &worlds[i / 4];
        const view v = {.width = (int)size[0], .height = (int)size[1], .camera = CAMERA_ORBIT, .zoom = 1};
        double most = 0; /* as a fraction of the distance from the middle to a side */
        double low = 0, high = 0;
        for (uint64_t tick = 0; tick < 480; tick++) {
            const camera c = camera_make(&v, (camera_window){0, 0, size[0], size[1]}, world, world->min, tick);
            for (unsigned corner = 0; corner < 8; corner++) {
                double position[3], pixel[2];
                box_corner(world, corner, position);
                assert_true(camera_find_pixel(&c, position, pixel));
                low = fmax(low, pixel[1] - size[1] / 2);
                high = fmax(high, size[1] / 2 - pixel[1]);
                for (int axis = 0; axis < 2; axis++)
                    most = fmax(most, fabs(pixel[axis] - size[axis] / 2) / (size[axis] / 2));
            }
        }
        assert_true(most < 0.911 && most > 0.88);
        assert_true(fabs(high - low) < 0.01 * size[1]);
    }
}

/* Without a player, the camera that follows the player shows the world as the orbit of tick 0 does. */
static void without_a_player_the_follower_keeps_the_world_in_the_window(void **state)
{
    (void)state;
    const octree_box world = {{-10, 0, 5}, {30, 80, 9}};
    const double player[3] = {1, 2, 6};
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        const camera alone = camera_of((view_camera)kind, &world, NULL, 77);
        const camera same = kind == CAMERA_FOLLOW ? camera_of(CAMERA_ORBIT, &world, player, 0)
                                                  : camera_of((view_camera)kind, &world, player, 77);
        assert_true(same_position(alone.eye, same.eye) && same_position(alone.forward, same.forward));
        assert_true(alone.zoom == same.zoom && alone.middle[1] == same.middle[1]);
        assert_false(alone.follows);
    }
}

static void camera_follows_the_player_of_a_session_that_has_one(void **state)
{
    (void)state;
    const view v = view_of(440, 320, CAMERA_FOLLOW, VIEW_ALL_LAYERS);
    static const octree_player_kind kinds[] = {OCTREE_PLAYER_KEYS, OCTREE_PLAYER_BODY, OCTREE_PLAYER_NONE};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        octree_session session = octree_session_default();
        session.player.kind = kinds[i];
        octree_game *game = start_game(&session);
        scene s = {0};
        build_tick(&s, &v, game);
        assert_int_equal(s.camera.follows, kinds[i] != OCTREE_PLAYER_NONE);
        octree_game_destroy(game);
        scene_release(&s);
    }
}

static void only_the_orbit_turns_and_only_the_follower_moves(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    const double here[3] = {0, 0, 0}, there[3] = {0.5, -0.25, 0.125};
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        const camera first = camera_of((view_camera)kind, &world, here, 0);
        const camera later = camera_of((view_camera)kind, &world, here, 100);
        const camera moved = camera_of((view_camera)kind, &world, there, 0);
        assert_int_equal(same_position(first.forward, later.forward), kind != CAMERA_ORBIT);
        assert_int_equal(same_position(first.eye, moved.eye), kind != CAMERA_FOLLOW);
    }
}

static void assert_in_the_middle(const camera *c, const double place[3])
{
    double pixel[2];
    assert_true(camera_find_pixel(c, place, pixel));
    assert_true(fabs(pixel[0] - (window.x + window.width / 2)) < 1e-9);
    assert_true(fabs(pixel[1] - (window.y + window.height / 2)) < 1e-9);
}

/* Zoom keeps the center in place and multiplies all distances in the picture. */
static void look_center_and_zoom_replace_those_of_the_camera(void **state)
{
    (void)state;
    const octree_box world = {{-10, 0, 5}, {30, 80, 9}};
    const double player[3] = {1, 2, 6}, other[3] = {3, 7, 8};
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        view v = view_of(440, 320, (view_camera)kind, VIEW_ALL_LAYERS);
        v.look.given = v.center.given = true;
        v.look.azimuth = 90;
        v.look.elevation = 0;
        for (int i = 0; i < 3; i++)
            v.center.place[i] = (double[3]){4, 70, 6}[i];
        double near[2], far[2];
        const camera c = camera_make(&v, window, &world, player, 77);
        assert_true(same_position(c.forward, (double[3]){-1, 0, 0})); /* the eye is on the side of +x */
        assert_in_the_middle(&c, v.center.place);
        v.look.elevation = 90;
        assert_true(same_position(camera_make(&v, window, &world, player, 77).forward, (double[3]){0, 0, -1}));
        v.look.elevation = 0;
        assert_true(camera_find_pixel(&c, other, near));
        v.zoom = 3;
        const camera closer = camera_make(&v, window, &world, player, 0);
        assert_in_the_middle(&closer, v.center.place);
        assert_true(camera_find_pixel(&closer, other, far));
        for (int i = 0; i < 2; i++)
            assert_true(fabs((far[i] - c.middle[i]) - 3 * (near[i] - c.middle[i])) < 1e-9);
        v.look.given = false;
        const camera own = camera_make(&v, window, &world, player, 77);
        assert_in_the_middle(&own, v.center.place);
    }
}

/* Multiples of 1/8 stay exact at 1e15, whose neighbours are 1/8 apart, and under any power of two. */
static void assert_same_pixels_elsewhere(view_camera kind, double scale, double offset)
{
    octree_box world = cube(-1000, 1000), elsewhere = cube(-1000 * scale + offset, 1000 * scale + offset);
    uint64_t random = 9;
    double player[3], there[3];
    for (int axis = 0; axis < 3; axis++) {
        player[axis] = (double)random_below(&random, 16000) / 8 - 1000;
        there[axis] = player[axis] * scale + offset;
    }
    const camera a = camera_of(kind, &world, player, 123), b = camera_of(kind, &elsewhere, there, 123);
    for (int i = 0; i < 200; i++) {
        double position[3], moved[3], seen[2][3], pixels[2][2];
        for (int axis = 0; axis < 3; axis++) {
            position[axis] = (double)random_below(&random, 16000) / 8 - 1000;
            moved[axis] = position[axis] * scale + offset;
        }
        camera_transform(&a, position, seen[0]);
        camera_transform(&b, moved, seen[1]);
        assert_true(same_position(seen[0], seen[1]));
        camera_project(&a, seen[0], pixels[0]);
        camera_project(&b, seen[1], pixels[1]);
        assert_true(pixels[0][0] == pixels[1][0] && pixels[0][1] == pixels[1][1]);
    }
}

static void pixels_do_not_depend_on_position_and_scale_of_the_world(void **state)
{
    (void)state;
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        assert_same_pixels_elsewhere((view_camera)kind, 1, 1e15);
        assert_same_pixels_elsewhere((view_camera)kind, 1, -1e15);
        assert_same_pixels_elsewhere((view_camera)kind, ldexp(1, 600), 0);
        assert_same_pixels_elsewhere((view_camera)kind, ldexp(1, -600), 0);
        assert_same_pixels_elsewhere((view_camera)kind, ldexp(1, -1000), 0);
        assert_same_pixels_elsewhere((view_camera)kind, ldexp(1, 600), ldexp(1e15, 600));
    }
}

/* A random box in a world, of any size down to the smallest possible. */
static octree_box some_box(const octree_box *world, uint64_t *random)
{
    octree_box box;
    const double part = ldexp(1, -(int)random_below(random, 60));
    for (int i = 0; i < 3; i++) {
        const double extent = world->max[i] - world->min[i], at = random_between(random, 0, 1);
        box.min[i] = world->min[i] + at * extent;
        box.max[i] = fmin(box.min[i] + part * extent, world->max[i]);
    }
    return box;
}

static void a_box_is_below_a_size_if_it_appears_smaller(void **state)
{
    (void)state;
    static const double near[] = {1e-15, 1e-12, 1e-9, 1e-7, 1e-4, 0.01, 0.3, 0.9};
    static const double places[][2] = {{0, 1}, {1e15, 1}, {0, 1e-290}, {-1e300, 1e298}, {7, 1e-14}};
    uint64_t random = 5;
    for (int i = 0; i < 60000; i++) {
        const double *place = places[random_below(&random, 5)];
        octree_box world = {{-1000, -700, -10}, {1000, 1000, 1000}};
        for (int j = 0; j < 3; j++) {
            world.min[j] = place[0] + place[1] * world.min[j];
            world.max[j] = place[0] + place[1] * world.max[j];
        }
        const camera c =
            camera_of((view_camera)random_below(&random, CAMERA_COUNT), &world, world.min, random_below(&random, 480));
        const octree_box box = some_box(&world, &random);
        const double size = camera_box_size_in_pixels(&c, &box), off = near[random_below(&random, 8)];
        const double pixels[] = {
            size, nextafter(size, 0), nextafter(size, 1e300), size * (1 + off), size * (1 - off), 0, 2};
        for (size_t j = 0; j < sizeof pixels / sizeof pixels[0]; j++)
            assert_int_equal(camera_is_box_smaller_than(&c, &box, pixels[j]), size < pixels[j]);
    }
}

/* The positions of a ray appear at its pixel, before the camera, and all of the world lies ahead of its origin. */
static void a_ray_through_a_pixel_appears_at_the_pixel(void **state)
{
    (void)state;
    uint64_t random = 11;
    for (int i = 0; i < 2000; i++) {
        const octree_box world = i % 2 ? cube(-1000, 1000) : (octree_box){{1e6, -3, 0}, {1e6 + 8, 5, 2}};
        const camera c =
            camera_of((view_camera)random_below(&random, CAMERA_COUNT), &world, world.min, random_below(&random, 480));
        const double pixel[2] = {random_between(&random, 40, 440), random_between(&random, 10, 310)};
        double origin[3], direction[3], at[3], found[2], corner[3];
        camera_find_ray(&c, pixel, &world, origin, direction);
        assert_true(fabs(dot(direction, direction) - 1) < 1e-14);
        const double far = (world.max[0] - world.min[0]) * random_between(&random, 0.7, 3);
        for (int axis = 0; axis < 3; axis++)
            at[axis] = origin[axis] + far * direction[axis];
        assert_true(camera_find_pixel(&c, at, found));
        assert_true(fabs(found[0] - pixel[0]) < 1e-5 && fabs(found[1] - pixel[1]) < 1e-5);
        for (unsigned n = 0; !c.perspective && n < 8; n++) {
            box_corner(&world, n, corner);
            for (int axis = 0; axis < 3; axis++)
                corner[axis] -= origin[axis];
            assert_true(dot(corner, direction) > -1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_agree_with_the_sine_and_cosine_of_libm),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(every_basis_is_orthonormal_and_right_handed),
        cmocka_unit_test(the_corners_of_any_world_are_in_the_window_and_before_the_camera),
        cmocka_unit_test(an_orthographic_world_fills_most_of_the_window),
        cmocka_unit_test(axes_point_as_the_camera_names_state),
        cmocka_unit_test(the_camera_that_follows_looks_at_the_player),
        cmocka_unit_test(an_orbit_keeps_the_world_in_the_window),
        cmocka_unit_test(without_a_player_the_follower_keeps_the_world_in_the_window),
        cmocka_unit_test(camera_follows_the_player_of_a_session_that_has_one),
        cmocka_unit_test(only_the_orbit_turns_and_only_the_follower_moves),
        cmocka_unit_test(look_center_and_zoom_replace_those_of_the_camera),
        cmocka_unit_test(a_box_is_below_a_size_if_it_appears_smaller),
        cmocka_unit_test(a_ray_through_a_pixel_appears_at_the_pixel),
        cmocka_unit_test(pixels_do_not_depend_on_position_and_scale_of_the_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
