/* SPDX-License-Identifier: MIT */
/* test_splats.c - points that are painted one by one: the nearest wins in any order, surfaces have no holes at any
 * picture size, shading shows depth, and flat ground is evenly lit. */
#include "frames.h"
#include "brute.h"
#include "point_scale.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

/* A drawn picture with its colours. */
typedef struct lit {
    renderer *renderer;
    uint8_t *indices;
} lit;

static scene painted_scene(view_camera camera, view_shade shade, int height)
{
    const octree_box world = cube(-1, 1);
    view v = view_of(height * 16 / 9, height, camera, 1u << LAYER_POINTS);
    v.point_color = POINTS_BY_Z;
    v.shade = shade;
    return empty_scene(&v, &world);
}

static void add_point(scene *s, uint64_t id, double x, double y, double z, theme_color color)
{
    scene_add_marker(
        s,
        (scene_marker){.id = id, .at = {x, y, z}, .color = color, .style = {.layer = LAYER_POINTS, .role = ROLE_OWN}});
}

/* Add a grid of points in the plane z = at + slope * y, `spacing` apart. */
static void add_ground(scene *s, double from, double to, double spacing, double at, double slope)
{
    uint64_t id = s->markers.count;
    for (double y = from; y <= to; y += spacing)
        for (double x = from; x <= to; x += spacing)
            add_point(s, id++, x, y, at + slope * y, (theme_color){200, 100, 50});
    s->spacing = spacing;
}

static lit draw_lit(const scene *s)
{
    lit l = {.renderer = open_renderer_for(s)};
    l.indices = draw(l.renderer, s);
    return l;
}

static void release(lit *l, scene *s)
{
    free(l->indices);
    renderer_close(l->renderer);
    scene_release(s);
}

static theme_color color_at(const lit *l, const scene *s, int x, int y)
{
    const size_t i = (size_t)y * (size_t)(s->view.width * s->view.aa) + (size_t)x;
    const uint8_t *own = renderer_sample_colors(l->renderer) + 3 * i;
    assert_int_equal(l->indices[i], THEME_OWN);
    return (theme_color){own[0], own[1], own[2]};
}

static theme_color color_in_the_middle(const lit *l, const scene *s)
{
    double pixel[2];
    pixel_of(s, (double[]){0, 0, 0}, pixel);
    return color_at(l, s, (int)pixel[0], (int)pixel[1]);
}

static void nearest_point_wins_in_any_order_and_lowest_id_breaks_ties(void **state)
{
    (void)state;
    static const struct {
        double z;
        uint64_t id;
    } points[] = {{0.1, 9}, {-0.5, 1}, {0.5, 7}, {0.5, 3}, {0.5 - 1e-12, 2}};
    for (unsigned order = 0; order < 5; order++) {
        scene s = painted_scene(CAMERA_TOP, SHADE_NONE, 90);
        for (unsigned i = 0; i < 5; i++) {
            const unsigned n = (i + order) % 5;
            add_point(&s, points[n].id, 0, 0, points[n].z, (theme_color){(uint8_t)(points[n].id * 10), 0, 0});
        }
        lit l = draw_lit(&s);
        assert_int_equal(color_in_the_middle(&l, &s).r, 30);
        release(&l, &s);
    }
}

static void surface_has_no_holes_at_any_picture_size(void **state)
{
    (void)state;
    static const int heights[] = {90, 360, 720, 2160};
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++) {
        scene s = painted_scene(CAMERA_TOP, SHADE_EDL, heights[i]);
        double corners[2][2];
        add_ground(&s, -0.9, 0.9, 0.018, 0, 0);
        lit l = draw_lit(&s);
        pixel_of(&s, (double[]){-0.85, 0.85, 0}, corners[0]);
        pixel_of(&s, (double[]){0.85, -0.85, 0}, corners[1]);
        size_t holes = 0;
        for (int y = (int)corners[0][1] + 1; y < (int)corners[1][1]; y++)
            for (int x = (int)corners[0][0] + 1; x < (int)corners[1][0]; x++)
                holes += l.indices[(size_t)y * (size_t)s.view.width + (size_t)x] != THEME_OWN;
        assert_int_equal(holes, 0);
        release(&l, &s);
    }
}

/* Points at random places of a plane, of which the budget keeps one in eight. */
static void thinned_surface_has_almost_no_holes(void **state)
{
    (void)state;
    uint64_t random = 3;
    scene s = painted_scene(CAMERA_TOP, SHADE_EDL, 360);
    view v = s.view;
    octree_def def = octree_def_default();
    octree *tree;
    v.budget = 15000;
    scene_release(&s);
    def.world = cube(-1, 1);
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (uint64_t i = 0; i < 80000; i++)
        octree_insert(tree,
                      (double[]){(double)random_below(&random, 20001) / 10000 - 1,
                                 (double)random_below(&random, 20001) / 10000 - 1, 0},
                      i);
    assert_true(point_scale_compute(&v, tree, NULL));
    build_tree(&s, &v, tree, "");
    assert_int_equal(s.tally.one_in, 8);
    lit l = draw_lit(&s);
    double corners[2][2];
    pixel_of(&s, (double[]){-0.9, 0.9, 0}, corners[0]);
    pixel_of(&s, (double[]){0.9, -0.9, 0}, corners[1]);
    size_t holes = 0, pixels = 0;
    for (int y = (int)corners[0][1]; y < (int)corners[1][1]; y++)
        for (int x = (int)corners[0][0]; x < (int)corners[1][0]; x++, pixels++)
            holes += l.indices[(size_t)y * (size_t)s.view.width + (size_t)x] != THEME_OWN;
    assert_true(holes * 50 < pixels);
    octree_destroy(tree);
    release(&l, &s);
}

/* The number of colours in a column of the picture through the ground. */
static size_t colors_of_column(const lit *l, const scene *s)
{
    bool seen[256] = {false};
    size_t colors = 0;
    double ends[2][2];
    pixel_of(s, (double[]){0, 0.7, 0.7}, ends[0]);
    pixel_of(s, (double[]){0, -0.7, -0.7}, ends[1]);
    for (int y = (int)ends[0][1]; y < (int)ends[1][1]; y++) {
        const uint8_t red = color_at(l, s, (int)ends[0][0], y).r / 8;
        colors += !seen[red];
        seen[red] = true;
    }
    return colors;
}

/* The ground slopes away from the eye through all bands. */
static void sloping_ground_is_shaded_evenly_without_bands(void **state)
{
    (void)state;
    size_t colors[SHADE_COUNT];
    for (int shade = 0; shade < SHADE_COUNT; shade++) {
        scene s = painted_scene(CAMERA_TOP, (view_shade)shade, 360);
        add_ground(&s, -0.9, 0.9, 0.004, 0, 1);
        lit l = draw_lit(&s);
        colors[shade] = colors_of_column(&l, &s);
        release(&l, &s);
    }
    assert_true(colors[SHADE_BANDS] >= 6);
    assert_true(colors[SHADE_EDL] <= 3);
    assert_int_equal(colors[SHADE_NONE], 1);
}

static void points_behind_a_near_edge_are_darker_beside_it(void **state)
{
    (void)state;
    scene s = painted_scene(CAMERA_TOP, SHADE_EDL, 360);
    add_ground(&s, -0.9, 0.9, 0.005, -0.5, 0);
    add_ground(&s, 0, 0.3, 0.005, 0.5, 0);
    lit l = draw_lit(&s);
    double edge[2], far[2];
    pixel_of(&s, (double[]){0, 0.15, 0}, edge);
    pixel_of(&s, (double[]){-0.5, 0.15, 0}, far);
    const theme_color beside = color_at(&l, &s, (int)edge[0] - 2, (int)edge[1]);
    assert_int_equal(color_at(&l, &s, (int)far[0], (int)far[1]).r, 200);
    assert_true(beside.r < 140 && beside.r > 20);
    assert_int_equal(color_at(&l, &s, (int)edge[0] + 20, (int)edge[1]).r, 200);
    release(&l, &s);
}

static void density_is_the_number_of_points_of_a_pixel(void **state)
{
    (void)state;
    static const uint32_t counts[] = {1, 2, 8, 64, 500};
    theme_color last = {0};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        scene s = painted_scene(CAMERA_TOP, SHADE_NONE, 90);
        s.view.point_color = POINTS_BY_DENSITY;
        for (uint32_t n = 0; n < counts[i]; n++)
            add_point(&s, n, 0, 0, n * 1e-3 - 0.5, (theme_color){0});
        lit l = draw_lit(&s);
        const theme_color color = color_in_the_middle(&l, &s), top = theme_ramp_color(1);
        assert_true(color.g > last.g || counts[i] > 64);
        assert_int_equal(memcmp(&color, &top, sizeof top) == 0, counts[i] >= 64);
        last = color;
        release(&l, &s);
    }
}

static void each_sample_has_the_colour_of_the_picked_point(void **state)
{
    (void)state;
    scene s = painted_scene(CAMERA_ORBIT, SHADE_NONE, 180);
    uint64_t random = 5;
    for (uint64_t i = 0; i < 400; i++)
        add_point(&s, i, (double)random_below(&random, 200) / 100 - 1, (double)random_below(&random, 200) / 100 - 1,
                  (double)random_below(&random, 200) / 100 - 1, (theme_color){(uint8_t)i, (uint8_t)(i >> 8), 7});
    s.spacing = 0.05;
    lit l = draw_lit(&s);
    uint32_t *numbers = malloc(frame_samples(&s) * sizeof *numbers);
    octreel_error error = {""};
    size_t seen = 0;
    assert_true(numbers && renderer_find_element_numbers(l.renderer, &s, numbers, &error));
    for (size_t i = 0; i < frame_samples(&s); i++) {
        assert_int_equal(numbers[i] != 0, l.indices[i] == THEME_OWN);
        if (numbers[i] == 0)
            continue;
        const size_t marker = scene_element_at(&s, numbers[i]).index;
        const theme_color color = color_at(&l, &s, (int)(i % (size_t)s.view.width), (int)(i / (size_t)s.view.width));
        assert_memory_equal(&color, &s.markers.items[marker].color, sizeof color);
        seen++;
    }
    assert_true(seen > 1000);
    free(numbers);
    release(&l, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_point_wins_in_any_order_and_lowest_id_breaks_ties),
        cmocka_unit_test(surface_has_no_holes_at_any_picture_size),
        cmocka_unit_test(thinned_surface_has_almost_no_holes),
        cmocka_unit_test(sloping_ground_is_shaded_evenly_without_bands),
        cmocka_unit_test(points_behind_a_near_edge_are_darker_beside_it),
        cmocka_unit_test(density_is_the_number_of_points_of_a_pixel),
        cmocka_unit_test(each_sample_has_the_colour_of_the_picked_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
