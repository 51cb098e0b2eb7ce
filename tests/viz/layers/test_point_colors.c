/* SPDX-License-Identifier: MIT */
/* test_point_colors.c - tests the colours of painted points, and the legend's scale with round numbers. */
#include "scenes.h"
#include "brute.h"
#include "point_colors.h"
#include "point_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define POINTS 3000

typedef struct painted {
    octree *tree;
    view view;
    scene scene;
} painted;

/* Points of a world that ends at no round number, as seen with a colouring and with values. */
static painted paint_points(view_point_color color, const point_values *values)
{
    const octree_box world = cube(-987, 1003);
    brute points = {0};
    painted p = {.view = view_make_default()};
    brute_sample(&points, OCTREE_SAMPLE_UNIFORM, 2, &world, POINTS);
    p.tree = brute_tree(&points, world, 16, 21);
    p.view.point_color = color;
    assert_true(point_scale_compute(&p.view, p.tree, values));
    assert_true(tree_scene_build(&p.scene, &p.view, p.tree, &(tree_subject){.title = "points", .values = values}));
    brute_free(&points);
    return p;
}

static void release(painted *p)
{
    scene_release(&p->scene);
    octree_destroy(p->tree);
}

static bool has_text(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

static bool is_point(const scene_marker *m)
{
    return m->style.layer == LAYER_POINTS;
}

static bool same_color(theme_color a, theme_color b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* Green grows along the whole ramp. */
static void higher_points_are_lighter(void **state)
{
    (void)state;
    static const struct {
        view_point_color color;
        int axis;
    } rows[] = {{POINTS_BY_HEIGHT, 2}, {POINTS_BY_X, 0}, {POINTS_BY_Y, 1}, {POINTS_BY_Z, 2}};
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        painted p = paint_points(rows[row].color, NULL);
        size_t points = 0;
        for (size_t i = 0; i < p.scene.markers.count; i++) {
            const scene_marker *m = &p.scene.markers.items[i];
            if (!is_point(m))
                continue;
            assert_int_equal(m->style.role, ROLE_OWN);
            const double part = (m->at[rows[row].axis] + 970) / (2 * 970);
            assert_true(m->color.g >= theme_ramp_color(part - 0.05).g && m->color.g <= theme_ramp_color(part + 0.05).g);
            points++;
        }
        assert_int_equal(points, POINTS);
        assert_true(has_text(&p.scene, "-500") && has_text(&p.scene, "0") && has_text(&p.scene, "500"));
        release(&p);
    }
}

/* Where a number's middle is. */
static double middle_of(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return s->labels.items[i].at[0] + (double)strlen(text) * s->text.width / 2;
    fail_msg("there is no \"%s\"", text);
    return 0;
}

static void numbers_stand_under_the_middle_of_their_marks(void **state)
{
    (void)state;
    painted p = paint_points(POINTS_BY_HEIGHT, NULL);
    const double low = middle_of(&p.scene, "-500"), zero = middle_of(&p.scene, "0"), high = middle_of(&p.scene, "500");
    assert_true(low < zero && fabs((zero - low) - (high - zero)) <= 2); /* each is a whole pixel */
    release(&p);
}

/* All points have the same height, so that only their leaves make their colours differ. */
static void leaves_beside_each_other_are_dark_and_light(void **state)
{
    (void)state;
    view v = view_make_default();
    octree_def def = octree_def_default();
    octree *tree;
    scene s = {0};
    def.world = cube(0, 4);
    def.leaf_capacity = 1;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (uint64_t i = 0; i < 16; i++)
        assert_int_equal(octree_insert(tree, (double[]){(double)(i % 4) + 0.5, (double)(i / 4) + 0.5, 0.5}, i),
                         OCTREE_OK);
    v.point_color = POINTS_BY_LEAF;
    assert_true(point_scale_compute(&v, tree, NULL));
    build_tree(&s, &v, tree, "leaves");
    theme_color at[16];
    for (size_t i = 0; i < s.markers.count; i++)
        if (is_point(&s.markers.items[i]))
            at[s.markers.items[i].id] = s.markers.items[i].color;
    for (size_t i = 0; i < 16; i++) {
        assert_true(i % 4 == 3 || !same_color(at[i], at[i + 1]));
        assert_true(i / 4 == 3 || !same_color(at[i], at[i + 4]));
        assert_true(i % 4 == 3 || i / 4 == 3 || same_color(at[i], at[i + 5]));
    }
    assert_true(has_text(&s, "leaves of points"));
    scene_release(&s);
    octree_destroy(tree);
}

/* Each third point has a value of each kind. */
static point_values make_values(void)
{
    point_values v = {0};
    for (uint64_t id = 0; id < POINTS; id += 3) {
        const point_entry entry = {.id = id,
                                   .value = {.color = {(uint8_t)id, 7, 9},
                                             .class = id % 2 ? 2 : 6,
                                             .intensity = (float)id,
                                             .has = {true, true, true}}};
        assert_true(point_values_add_entries(&v, &entry, 1));
    }
    return v;
}

static theme_color expected_color(view_point_color color, uint64_t id)
{
    if (id % 3)
        return theme_color_at(theme_color_index(ROLE_POINT, 0));
    return color == POINTS_BY_CLASS ? theme_kind_color(id % 2 ? 1 : 3) : (theme_color){(uint8_t)id, 7, 9};
}

static void points_have_the_colours_of_their_values_or_the_plain_colour(void **state)
{
    (void)state;
    point_values values = make_values();
    for (int color = 0; color < POINTS_BY_COUNT; color++) {
        if (color != POINTS_BY_FILE && color != POINTS_BY_CLASS && color != POINTS_BY_INTENSITY)
            continue;
        painted p = paint_points((view_point_color)color, &values);
        for (size_t i = 0; i < p.scene.markers.count; i++) {
            const scene_marker *m = &p.scene.markers.items[i];
            if (is_point(m) && (color != POINTS_BY_INTENSITY || m->id % 3))
                assert_true(same_color(m->color, expected_color((view_point_color)color, m->id)));
            else if (is_point(m))
                assert_true(m->color.g >= theme_ramp_color((double)m->id / POINTS - 0.05).g &&
                            m->color.g <= theme_ramp_color((double)m->id / POINTS + 0.05).g);
        }
        assert_true(color != POINTS_BY_CLASS ||
                    (has_text(&p.scene, "ground") && has_text(&p.scene, "building") && !has_text(&p.scene, "water")));
        assert_true(color != POINTS_BY_INTENSITY || has_text(&p.scene, "1000"));
        release(&p);
    }
    point_values_release(&values);
}

static void every_colouring_works_without_values_and_reports_the_lack(void **state)
{
    (void)state;
    static const char *const said[POINTS_BY_COUNT] = {[POINTS_BY_PLAIN] = "point",
                                                      [POINTS_BY_HEIGHT] = "points, by height",
                                                      [POINTS_BY_X] = "points, by x",
                                                      [POINTS_BY_Y] = "points, by y",
                                                      [POINTS_BY_Z] = "points, by z",
                                                      [POINTS_BY_FILE] = "points, without colours",
                                                      [POINTS_BY_LEAF] = "points, by height",
                                                      [POINTS_BY_DEPTH] = "points, leaf depth 0-3",
                                                      [POINTS_BY_DENSITY] = "64+",
                                                      [POINTS_BY_CLASS] = "points, without classes",
                                                      [POINTS_BY_INTENSITY] = "points, no intensities",
                                                      [POINTS_BY_ID] = "points, by id"};
    for (int color = 0; color < POINTS_BY_COUNT; color++) {
        painted p = paint_points((view_point_color)color, NULL);
        if (!has_text(&p.scene, said[color]))
            fail_msg("%s: no \"%s\"", view_point_color_name(color), said[color]);
        release(&p);
    }
}

/* The classes of LAS 1.4, of which 19 and more are a program's own. */
static void class_kinds_follow_las(void **state)
{
    static const char *const kinds[] = {"unclassified",
                                        "unclassified",
                                        "ground",
                                        "vegetation",
                                        "vegetation",
                                        "vegetation",
                                        "building",
                                        "noise",
                                        "ground",
                                        "water",
                                        "road, rail, bridge",
                                        "road, rail, bridge",
                                        "other",
                                        "other",
                                        "other",
                                        "other",
                                        "other",
                                        "road, rail, bridge",
                                        "noise",
                                        "other"};
    (void)state;
    for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++)
        assert_string_equal(class_kind_names[find_class_color_kind(i)], kinds[i]);
    assert_string_equal(class_kind_names[find_class_color_kind(UINT16_MAX)], "other");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(higher_points_are_lighter),
        cmocka_unit_test(numbers_stand_under_the_middle_of_their_marks),
        cmocka_unit_test(leaves_beside_each_other_are_dark_and_light),
        cmocka_unit_test(points_have_the_colours_of_their_values_or_the_plain_colour),
        cmocka_unit_test(every_colouring_works_without_values_and_reports_the_lack),
        cmocka_unit_test(class_kinds_follow_las),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
