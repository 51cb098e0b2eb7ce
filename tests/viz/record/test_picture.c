/* SPDX-License-Identifier: MIT */
/* test_picture.c - a scene draws the pixels that it should, and no others. */
#include "frames.h"
#include "layer.h"

#include <math.h>
#include <stdlib.h>

#define WIDTH 320
#define HEIGHT 240

static view view_with(view_camera camera, unsigned layers)
{
    return view_of(WIDTH, HEIGHT, camera, layers);
}

static unsigned role_at(const uint8_t *frame, int x, int y)
{
    return x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT ? ROLE_BACKGROUND : frame[y * WIDTH + x] / THEME_SHADES;
}

/* Whether a pixel, or one beside it, has a role from `first` to `last`. */
static bool role_near(const uint8_t *frame, const double pixel[2], unsigned first, unsigned last)
{
    const int x = (int)floor(pixel[0]), y = (int)floor(pixel[1]);
    for (int i = 0; i < 9; i++) {
        const unsigned role = role_at(frame, x + i % 3 - 1, y + i / 3 - 1);
        if (role >= first && role <= last)
            return true;
    }
    return false;
}

/* The default session after some ticks. */
static scene scene_at_tick(unsigned tick, view_camera camera, unsigned layers)
{
    const octree_session session = octree_session_default();
    const view v = view_with(camera, layers);
    octree_game *game = start_game(&session);
    scene s = {0};
    for (unsigned i = 0; i < tick; i++)
        play_tick(game);
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    return s;
}

static void corners_of_the_world_have_the_colour_of_the_visible_layer(void **state)
{
    (void)state;
    static const struct {
        view_layer layer;
        unsigned first, last;
    } rows[] = {{LAYER_WORLD, ROLE_WORLD, ROLE_WORLD}, {LAYER_NODES, ROLE_NODE, ROLE_COUNT - 1}};
    const octree_box world = octree_session_default().tree.world;
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        for (size_t row = 0; row < 2; row++) {
            scene s = scene_at_tick(40, (view_camera)kind, 1u << rows[row].layer);
            uint8_t *frame = draw_once(&s);
            for (unsigned corner = 0; kind != CAMERA_FOLLOW && corner < 8; corner++) {
                double position[3], pixel[2];
                box_corner(&world, corner, position);
                pixel_of(&s, position, pixel);
                assert_true(role_near(frame, pixel, rows[row].first, rows[row].last));
            }
            free(frame);
            scene_release(&s);
        }
    }
}

/* The distance of a pixel's middle from the outline of eight corners: the largest one over the directions of the
 * outline's sides; negative inside. */
static double outside_by(double corners[8][2], double x, double y)
{
    double most = -INFINITY;
    for (int i = 0; i < 8; i++) {
        for (int j = 0; j < 8; j++) {
            const double dx = corners[j][0] - corners[i][0], dy = corners[j][1] - corners[i][1], length = hypot(dx, dy);
            if (length < 1e-9)
                continue;
            double reach = -INFINITY;
            for (int k = 0; k < 8; k++)
                reach = fmax(reach, (dy * corners[k][0] - dx * corners[k][1]) / length);
            most = fmax(most, (dy * x - dx * y) / length - reach);
        }
    }
    return most;
}

static void pixels_outside_the_world_are_background(void **state)
{
    (void)state;
    const octree_box world = octree_session_default().tree.world;
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        if (kind == CAMERA_FOLLOW)
            continue;
        scene s = scene_at_tick(40, (view_camera)kind, 1u << LAYER_NODES);
        uint8_t *frame = draw_once(&s);
        double corners[8][2];
        size_t outside = 0;
        for (unsigned corner = 0; corner < 8; corner++) {
            double position[3];
            box_corner(&world, corner, position);
            pixel_of(&s, position, corners[corner]);
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            if (outside_by(corners, i % WIDTH + 0.5, i / WIDTH + 0.5) <= 1.5)
                continue;
            assert_int_equal(frame[i], 0);
            outside++;
        }
        assert_true(outside > WIDTH * HEIGHT / 20 && lit_pixels(frame, &s) > 500);
        free(frame);
        scene_release(&s);
    }
}

#define ALL_NODE_ROLES ((UINT64_C(1) << (ROLE_NODE + THEME_NODE_DEPTHS)) - (UINT64_C(1) << ROLE_NODE))

/* The roles that a layer may draw, as bits. */
static uint64_t roles_of(unsigned layer)
{
    const uint64_t one = 1;
    switch (layer) {
    case LAYER_WORLD:
        return one << ROLE_WORLD | one << ROLE_FAINT;
    case LAYER_NODES:
    case LAYER_PRUNED:
    case LAYER_VISITED:
    case LAYER_VISIT_HEAT:
    case LAYER_POINT_HEAT:
        return ALL_NODE_ROLES;
    case LAYER_POINTS:
    case LAYER_BODIES:
        return one << ROLE_POINT;
    case LAYER_PAIRS:
        return one << ROLE_COLLISION;
    case LAYER_VELOCITIES:
        return one << ROLE_FAINT;
    case LAYER_HIT:
        return one << ROLE_HIT;
    case LAYER_SPLITS:
    case LAYER_MERGES:
        return one << ROLE_CHANGE;
    case LAYER_RANGE:
    case LAYER_FRUSTUM:
        return one << ROLE_RANGE;
    case LAYER_RADIUS:
    case LAYER_RAY:
    case LAYER_SWEEP:
        return one << ROLE_RADIUS;
    case LAYER_KNEAREST:
        return one << ROLE_KNEAREST;
    case LAYER_NEAREST:
        return one << ROLE_NEAREST;
    case LAYER_WRONG:
        return one << ROLE_WRONG | one << ROLE_MISSED;
    case LAYER_SHAPES:
        return one << ROLE_SHAPE;
    case LAYER_PLAYER:
        return one << ROLE_PLAYER | one << ROLE_FAINT;
    case LAYER_BOX:
        return one << ROLE_PLAYER | one << ROLE_COLLISION;
    default:
        return ~UINT64_C(0);
    }
}

static uint64_t roles_in(const uint8_t *frame)
{
    uint64_t roles = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        roles |= UINT64_C(1) << frame[i] / THEME_SHADES;
    return roles & ~(UINT64_C(1) << ROLE_BACKGROUND);
}

static void each_layer_draws_all_its_colours_and_no_others(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    renderer *r = open_renderer(WIDTH, HEIGHT);
    for (unsigned layer = 0; layer < LAYER_TEXT; layer++) {
        const view v = view_with(CAMERA_ISO, 1u << layer);
        octree_game *game = start_game(&session);
        scene s = {0};
        heat h = {0};
        uint64_t seen = 0;
        for (; !octree_game_over(game); play_tick(game)) {
            assert_true(heat_add_tick(&h, game));
            build_hot_tick(&s, &v, game, &h);
            if (s.boxes.count + s.segments.count + s.markers.count == 0)
                continue;
            uint8_t *frame = draw(r, &s);
            const uint64_t roles = roles_in(frame);
            assert_true(roles != 0 && (roles & ~roles_of(layer)) == 0);
            const octree_tick *tick = octree_game_tick(game);
            assert_int_equal(roles >> ROLE_COLLISION & 1, (layer == LAYER_BOX && tick->hit_count != 0) ||
                                                              (layer == LAYER_PAIRS && tick->pair_count != 0));
            seen |= roles;
            free(frame);
        }
        /* This tree has six depths, is never broken, and no node is selected. */
        const bool never = layer == LAYER_BROKEN || layer == LAYER_ASKED;
        assert_true(roles_of(layer) == ALL_NODE_ROLES ? seen != 0 : never || seen == roles_of(layer));
        heat_release(&h);
        octree_game_destroy(game);
        scene_release(&s);
    }
    renderer_close(r);
}

static scene blank_scene(view_camera camera)
{
    const octree_box world = {{-160, -160, -120}, {160, 160, 120}};
    const view v = view_with(camera, VIEW_ALL_LAYERS);
    return empty_scene(&v, &world);
}

static scene_segment line_of(double x0, double y0, double z0, double x1, double y1, double z1)
{
    return (scene_segment){.ends = {{x0, y0, z0}, {x1, y1, z1}}, .style = {.role = ROLE_RANGE, .width = 1}};
}

/* The test fails unless the line draws one pixel in each column (or row) that it passes, next to the line, and no
 * other. */
static void assert_one_pixel_a_step(const uint8_t *frame, const double from[2], const double to[2])
{
    const int major = fabs(to[0] - from[0]) < fabs(to[1] - from[1]);
    const double low = fmin(from[major], to[major]), high = fmax(from[major], to[major]);
    const double slope = (to[!major] - from[!major]) / (to[major] - from[major]);
    const int steps = major ? HEIGHT : WIDTH, across = major ? WIDTH : HEIGHT;
    for (int step = 0; step < steps; step++) {
        int lit = 0;
        for (int side = 0; side < across; side++) {
            if (role_at(frame, major ? side : step, major ? step : side) == ROLE_BACKGROUND)
                continue;
            lit++;
            assert_true(fabs(from[!major] + (step + 0.5 - from[major]) * slope - (side + 0.5)) < 0.5 + 1.0 / 64);
        }
        const double middle = step + 0.5, slack = 1.0 / 64;
        if (middle > low + slack && middle < high - slack)
            assert_int_equal(lit, 1);
        if (middle < low - slack || middle > high + slack)
            assert_int_equal(lit, 0);
    }
}

static void line_of_one_pixel_draws_one_pixel_per_step(void **state)
{
    (void)state;
    renderer *r = open_renderer(WIDTH, HEIGHT);
    uint64_t random = 5;
    for (int i = 0; i < 400; i++) {
        scene s = blank_scene((view_camera)(i % 2 ? CAMERA_FRONT : CAMERA_ISO));
        double ends[6], pixels[2][2];
        for (int j = 0; j < 6; j++)
            ends[j] = random_between(&random, -80, 80) * (random_below(&random, 9) != 0);
        const scene_segment line = line_of(ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]);
        pixel_of(&s, line.ends[0], pixels[0]);
        pixel_of(&s, line.ends[1], pixels[1]);
        const double dx = fabs(pixels[1][0] - pixels[0][0]), dy = fabs(pixels[1][1] - pixels[0][1]);
        if (fmax(dx, dy) > 2 && fabs(dx - dy) > fmax(dx, dy) / 8) { /* near 45 degrees each band has its own steps */
            scene_add_segment(&s, line);
            uint8_t *frame = draw(r, &s);
            assert_one_pixel_a_step(frame, pixels[0], pixels[1]);
            free(frame);
        }
        scene_release(&s);
    }
    renderer_close(r);
}

static void diagonal_line_has_no_gap(void **state)
{
    (void)state;
    for (int falling = 0; falling < 2; falling++) {
        scene s = blank_scene(CAMERA_FRONT);
        const double side = falling ? -50.25 : 50.25;
        const scene_segment line = line_of(-50.25, 0, -side, 50.25, 0, side);
        double pixels[2][2];
        pixel_of(&s, line.ends[0], pixels[0]);
        pixel_of(&s, line.ends[1], pixels[1]);
        scene_add_segment(&s, line);
        uint8_t *frame = draw_once(&s);
        for (int x = (int)ceil(pixels[0][0]); x < (int)floor(pixels[1][0]); x++) {
            int lit = 0;
            for (int y = 0; y < HEIGHT; y++)
                lit += role_at(frame, x, y) != ROLE_BACKGROUND;
            assert_true(lit == 1 || lit == 2);
        }
        free(frame);
        scene_release(&s);
    }
}

/* The inverse of camera_to_unit_coordinates() on one axis, for worlds of moderate size. */
static double world_at(const camera *c, int axis, double unit)
{
    return c->origin[axis] + (unit + c->half[axis]) / 2 * c->size;
}

/* The test fails unless single boxes of every size, from a point to some pixels, flat and long ones too, are visible at
 * their place. */
static void assert_boxes_leave_a_mark(scene_stroke style)
{
    static const double sizes[] = {0, 1e-300, 1e-9, 0.01, 0.3, 0.7, 0.99, 1, 1.01, 1.5, 3, 40};
    const size_t count = sizeof sizes / sizeof sizes[0];
    renderer *r = open_renderer(WIDTH, HEIGHT);
    uint64_t random = 6;
    for (size_t i = 0; i < 400; i++) {
        scene s = blank_scene((view_camera)(i / count % CAMERA_COUNT));
        scene_box box = {.style = {.layer = LAYER_RANGE, .role = ROLE_RANGE, .stroke = (uint8_t)style, .width = 1}};
        double pixel[2];
        for (int axis = 0; axis < 3; axis++) {
            box.box.min[axis] = random_between(&random, -60, 20);
            box.box.max[axis] = box.box.min[axis] + sizes[i < 200 ? i % count : random_below(&random, count)];
        }
        pixel_of(&s, box.box.min, pixel);
        scene_add_box(&s, box);
        uint8_t *frame = draw(r, &s);
        assert_true(role_near(frame, pixel, ROLE_RANGE, ROLE_RANGE));
        free(frame);
        scene_release(&s);
    }
    renderer_close(r);
}

static void box_of_any_size_is_visible_at_its_place(void **state)
{
    (void)state;
    assert_boxes_leave_a_mark(STROKE_SOLID);
}

static void dashed_box_of_any_size_is_visible_at_its_place(void **state)
{
    (void)state;
    assert_boxes_leave_a_mark(STROKE_DASHED);
}

/* Also the line to a very near neighbour. */
static void segment_of_any_length_is_visible_at_its_place(void **state)
{
    (void)state;
    static const double lengths[] = {0, 1e-9, 0.1, 0.3, 0.5, 0.8, 1, 1.2, 2};
    const size_t count = sizeof lengths / sizeof lengths[0];
    renderer *r = open_renderer(WIDTH, HEIGHT);
    uint64_t random = 7;
    for (size_t i = 0; i < 300; i++) {
        scene s = blank_scene((view_camera)(i / 2 / count % CAMERA_COUNT));
        const double x = random_between(&random, -50, 50), length = lengths[i / 2 % count];
        scene_segment line = line_of(x, x / 2, -x / 3, x + length, x / 2 + length / 2, -x / 3 - length / 3);
        double pixel[2];
        line.style.stroke = (uint8_t)(i % 2);
        pixel_of(&s, line.ends[0], pixel);
        scene_add_segment(&s, line);
        uint8_t *frame = draw(r, &s);
        assert_true(role_near(frame, pixel, ROLE_RANGE, ROLE_RANGE));
        free(frame);
        scene_release(&s);
    }
    renderer_close(r);
}

static void add_point(scene *s, uint64_t id, double x, double z)
{
    const scene_style style = {.layer = LAYER_POINTS, .role = ROLE_POINT, .width = 1};
    scene_add_marker(s, (scene_marker){.id = id, .at = {x, 0, z}, .style = style});
}

static void thousand_points_on_a_pixel_look_like_one(void **state)
{
    (void)state;
    scene one = blank_scene(CAMERA_FRONT), many = blank_scene(CAMERA_FRONT);
    add_point(&one, 0, 3.2, 3.2);
    for (uint64_t i = 0; i < 1000; i++)
        add_point(&many, i, 3.2, 3.2);
    uint8_t *a = draw_once(&one), *b = draw_once(&many);
    double pixel[2];
    pixel_of(&one, (double[3]){3.2, 0, 3.2}, pixel);
    assert_int_equal(role_at(a, (int)pixel[0], (int)pixel[1]), ROLE_POINT);
    assert_same_frame(a, b, &one);
    free(a);
    free(b);
    scene_release(&one);
    scene_release(&many);
}

/* Panels and markers that are partly outside are clipped, and those that are entirely outside are invisible. */
static void panels_and_markers_are_clipped_at_the_border(void **state)
{
    (void)state;
    static const int places[][4] = {{-5, -5, 10, 10},        {WIDTH - 5, HEIGHT - 5, 10, 10},
                                    {-5, 100, 10, 10},       {100, HEIGHT - 5, 10, 10},
                                    {-20, 0, 10, 10},        {0, HEIGHT, 10, 10},
                                    {-900, -900, 9000, 9000}};
    static const size_t lit[] = {25, 25, 50, 50, 0, 0, WIDTH * HEIGHT};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        scene s = blank_scene(CAMERA_FRONT);
        scene_add_panel(&s, (scene_panel){.x = places[i][0],
                                          .y = places[i][1],
                                          .width = places[i][2],
                                          .height = places[i][3],
                                          .style = {.layer = LAYER_TEXT, .role = ROLE_TEXT}});
        uint8_t *frame = draw_once(&s);
        assert_int_equal(lit_pixels(frame, &s), lit[i]);
        free(frame);
        scene_release(&s);
    }
    for (unsigned shape = SHAPE_SQUARE; shape < SHAPE_COUNT; shape++) {
        scene s = blank_scene(CAMERA_FRONT);
        const camera *c = &s.camera;
        const double left = world_at(c, 0, -c->middle[0] / c->zoom); /* the picture's left edge */
        const scene_style style = {.layer = LAYER_BOX, .role = ROLE_COLLISION, .width = 20};
        scene_add_marker(&s, (scene_marker){.at = {left, 0, 0}, .style = style, .shape = (uint8_t)shape});
        uint8_t *frame = draw_once(&s);
        assert_true(lit_pixels(frame, &s) > 0);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 30; x < WIDTH; x++)
                assert_int_equal(role_at(frame, x, y), ROLE_BACKGROUND);
        free(frame);
        scene_release(&s);
    }
}

/* There is a line of four pixels for every four pixels of a row: a single missing line leaves a hole. */
static void hundred_thousand_segments_are_all_drawn(void **state)
{
    (void)state;
    const octree_box world = {{0, -1, 0}, {1000, 1, 400}};
    const view v = view_of(1000, 400, CAMERA_FRONT, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &world);
    const camera *c = &s.camera;
    for (uint64_t i = 0; i < 100000; i++) {
        const double x = (double)(i % 250 * 4), y = (double)(i / 250) + 0.5; /* pixels, converted back by the camera */
        scene_segment line = line_of(0, 0, 0, 0, 0, 0);
        line.id = i;
        for (int end = 0; end < 2; end++) {
            line.ends[end][0] = world_at(c, 0, (x + 4 * end - c->middle[0]) / c->zoom);
            line.ends[end][2] = world_at(c, 2, -(y - c->middle[1]) / c->zoom);
        }
        scene_add_segment(&s, line);
    }
    uint8_t *frame = draw_once(&s);
    assert_int_equal(lit_pixels(frame, &s), 400000);
    free(frame);
    scene_release(&s);
}

/* Of two layers at one place the later one is visible, whatever their depth and order in the list. */
static void later_layers_are_drawn_on_top(void **state)
{
    (void)state;
    renderer *r = open_renderer(WIDTH, HEIGHT);
    for (uint8_t low = 0; low < LAYER_COUNT; low++) {
        for (uint8_t high = (uint8_t)(low + 1); high < LAYER_COUNT; high++) {
            scene s = blank_scene(CAMERA_TOP);
            scene_segment above = line_of(-50, 1, 100, 50, 1, 100), below = line_of(-50, 1, -100, 50, 1, -100);
            double pixel[2];
            above.style.layer = low;
            below.style.layer = high;
            below.style.role = ROLE_NEAREST;
            pixel_of(&s, (double[3]){0, 1, 0}, pixel);
            scene_add_segment(&s, below);
            scene_add_segment(&s, above);
            uint8_t *frame = draw(r, &s);
            assert_true(role_near(frame, pixel, ROLE_NEAREST, ROLE_NEAREST));
            assert_false(role_near(frame, pixel, ROLE_RANGE, ROLE_RANGE));
            free(frame);
            scene_release(&s);
        }
    }
    renderer_close(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_of_the_world_have_the_colour_of_the_visible_layer),
        cmocka_unit_test(pixels_outside_the_world_are_background),
        cmocka_unit_test(each_layer_draws_all_its_colours_and_no_others),
        cmocka_unit_test(line_of_one_pixel_draws_one_pixel_per_step),
        cmocka_unit_test(diagonal_line_has_no_gap),
        cmocka_unit_test(box_of_any_size_is_visible_at_its_place),
        cmocka_unit_test(dashed_box_of_any_size_is_visible_at_its_place),
        cmocka_unit_test(segment_of_any_length_is_visible_at_its_place),
        cmocka_unit_test(thousand_points_on_a_pixel_look_like_one),
        cmocka_unit_test(panels_and_markers_are_clipped_at_the_border),
        cmocka_unit_test(hundred_thousand_segments_are_all_drawn),
        cmocka_unit_test(later_layers_are_drawn_on_top),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
