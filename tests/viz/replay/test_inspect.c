/* SPDX-License-Identifier: MIT */
/* test_inspect.c - the world that is chosen for a cloud, also at the limits of doubles, and the tree that is built in
 * it. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "inspect.h"
#include "point_world.h"
#include "octree/sample.h"

/* Clouds at the limits of doubles; the name says what is special. */
typedef struct hostile {
    const char *name;
    double positions[4][3];
    size_t count;
} hostile;

static const hostile clouds[] = {
    {"one point", {{1, 2, 3}}, 1},
    {"one point at zero", {{0, 0, 0}}, 1},
    {"minus zeros", {{-0.0, -0.0, -0.0}, {0, 0, 0}}, 2},
    {"equal points", {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}, 3},
    {"a line along x", {{0, 5, 5}, {10, 5, 5}}, 2},
    {"a line along z", {{1e-3, 5, -5}, {1e-3, 5, 5}}, 2},
    {"a plane", {{0, 0, 1}, {10, 3, 1}, {4, 9, 1}}, 3},
    {"one point far off", {{1e15, -1e15, 1e15}}, 1},
    {"a tiny extent far off", {{1e15, 1e15, 1e15}, {1e15 + 0.125, 1e15, 1e15}}, 2},
    {"a tiny extent far off on one axis", {{1e15, 0, 0}, {1e15, 1e-9, 0}}, 2},
    {"below a power of two", {{0x1p53, 0, 0}, {0x1.fffffffffffffp52, 0, 0}}, 2},
    {"all of the doubles", {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}}, 2},
    {"1e308 either way on x", {{-1e308, 0, 0}, {1e308, 0, 0}}, 2},
    {"1e308 either way, shifted", {{-1e308, 5e307, 0}, {1e308, 5e307, 1}}, 2},
    {"the largest double", {{DBL_MAX, DBL_MAX, DBL_MAX}}, 1},
    {"the largest double on one axis", {{DBL_MAX, 0, 0}}, 1},
    {"the lowest double", {{-DBL_MAX, 1, 1}}, 1},
    {"half of the doubles", {{0, 0, 0}, {DBL_MAX, 1, 1}}, 2},
    {"a subnormal", {{5e-324, 5e-324, 5e-324}}, 1},
    {"subnormals", {{5e-324, 0, 0}, {0, 0, 0}}, 2},
    {"subnormals either way", {{5e-324, 0, 0}, {-5e-324, 0, 0}}, 2},
    {"the smallest normal", {{DBL_MIN, 0, -DBL_MIN}, {0, 0, 0}}, 2},
    {"large beside small", {{1e300, 1e-300, 0}, {-1e300, -1e-300, 5e-324}}, 2},
    {"tenths", {{0.1, 0.2, 0.3}, {0.7, 0.9, 1.1}, {-0.3, 1e-17, 0.1}}, 3},
};

enum { CLOUDS = sizeof clouds / sizeof clouds[0] };

/* A cloud with a copy of these positions, which building a tree frees. */
static cloud copy_cloud(const void *positions, size_t count)
{
    cloud c = {.positions = malloc(count * sizeof *c.positions), .count = count};
    assert_non_null(c.positions);
    memcpy(c.positions, positions, count * sizeof *c.positions);
    return c;
}

static octree_box world_of(const hostile *h)
{
    return find_point_world(h->positions, sizeof *h->positions, h->count);
}

static void world_holds_every_point_and_is_valid_for_a_tree(void **state)
{
    (void)state;
    for (size_t i = 0; i < CLOUDS; i++) {
        cloud c = copy_cloud(clouds[i].positions, clouds[i].count);
        const octree_def def = define(world_of(&clouds[i]), 1, OCTREE_MAX_DEPTH, OCTREE_GROW);
        inspection made;
        octreel_error error = {""};
        if (!inspect_build(&c, &def, NULL, &made, &error))
            fail_msg("%s: %s", clouds[i].name, error.text);
        assert_null(c.positions); /* building the tree has freed the positions */
        if (made.outside + made.refused != 0)
            fail_msg("%s: points are left out", clouds[i].name);
        assert_int_equal(octree_count(made.tree), c.count);
        assert_valid(made.tree);
        inspect_release(&made);
    }
}

/* Half the length of a side; the whole length could overflow. */
static double half_side(const octree_box *box, int axis)
{
    return box->max[axis] / 2 - box->min[axis] / 2;
}

/* Whether a face is at the limit of doubles, beyond which it cannot be moved. */
static bool is_cut_off(const octree_box *box, int axis)
{
    return box->min[axis] == -DBL_MAX || box->max[axis] == DBL_MAX;
}

/* Twice the ulp of a face, by which rounding moves it at most. */
static double rounding_of(const octree_box *box, int axis)
{
    const double face = fmax(fabs(box->min[axis]), fabs(box->max[axis]));
    return face == DBL_MAX ? 0x1p971 : next_up(face) - face;
}

static void world_is_a_cube_up_to_rounding(void **state)
{
    (void)state;
    for (size_t i = 0; i < CLOUDS; i++) {
        const octree_box box = world_of(&clouds[i]);
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3;
            const double slack = 2 * (rounding_of(&box, a) + rounding_of(&box, b));
            if (is_cut_off(&box, a) || is_cut_off(&box, b))
                continue;
            if (fabs(half_side(&box, a) - half_side(&box, b)) > slack)
                fail_msg("%s: sides %c and %c differ", clouds[i].name, "xyz"[a], "xyz"[b]);
        }
    }
}

/* Half of the expected side: the largest extent, but at least 4 ulp of the largest coordinate, and 1 if all points are
 * equal. */
static double half_of_smallest(const hostile *h)
{
    double half = 0, largest = 0;
    for (size_t i = 0; i < h->count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            largest = fmax(largest, fabs(h->positions[i][axis]));
            for (size_t j = 0; j < h->count; j++)
                half = fmax(half, h->positions[i][axis] / 2 - h->positions[j][axis] / 2);
        }
    }
    const bool equal = memcmp(h->positions[0], h->positions[h->count - 1], sizeof h->positions[0]) == 0;
    const double ulp = largest == DBL_MAX ? 0x1p971 : next_up(largest) - largest;
    return fmax(half == 0 && (equal || largest == 0) ? 0.5 : half, 2 * ulp);
}

static void world_is_the_smallest_that_holds_the_points(void **state)
{
    (void)state;
    for (size_t i = 0; i < CLOUDS; i++) {
        const octree_box box = world_of(&clouds[i]);
        const double smallest = half_of_smallest(&clouds[i]);
        for (int axis = 0; axis < 3; axis++)
            if (half_side(&box, axis) > smallest + 2 * rounding_of(&box, axis))
                fail_msg("%s: half of side %c is %g and not %g", clouds[i].name, "xyz"[axis], half_side(&box, axis),
                         smallest);
    }
}

static void world_is_centred_on_the_points(void **state)
{
    static const hostile ordinary = {"ordinary", {{0, 10, -4}, {8, 12, -4}}, 2};
    const octree_box box = world_of(&ordinary), expected = {{0, 7, -8}, {8, 15, 0}};
    (void)state;
    assert_memory_equal(&box, &expected, sizeof box);
}

/* Random clouds, whose extents and offsets have any exponent. */
static void worlds_of_random_extents_hold_their_points(void **state)
{
    uint64_t random = 3;
    (void)state;
    for (int round = 0; round < 3000; round++) {
        double positions[4][3];
        cloud c = {.positions = positions, .count = 1 + random_below(&random, 4)};
        for (int axis = 0; axis < 3; axis++) {
            const double offset = ldexp(random_between(&random, -1, 1), (int)random_below(&random, 2090) - 1066);
            const double extent = ldexp(1, (int)random_below(&random, 2090) - 1066);
            for (size_t i = 0; i < c.count; i++) {
                const double x = offset + extent * random_between(&random, -1, 1);
                positions[i][axis] = isfinite(x) ? x : offset;
            }
        }
        const octree_box box = find_point_world(c.positions, sizeof *c.positions, c.count);
        for (size_t i = 0; i < c.count; i++)
            assert_true(box_holds(&box, positions[i]));
        octree_destroy(make_tree(box, 1, OCTREE_MAX_DEPTH, OCTREE_GROW));
    }
}

static void every_point_is_stored_refused_or_outside(void **state)
{
    enum { COUNT = 3000 };
    static double positions[COUNT][3];
    const octree_box all = cube(-10, 10), world = cube(-5, 5);
    octree_def def = define(world, 2, 3, OCTREE_REFUSE);
    inspection made;
    octreel_error error = {""};
    size_t outside = 0;
    (void)state;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &all, COUNT, positions), OCTREE_OK);
    cloud c = copy_cloud(positions, COUNT);
    c.skipped = 4;
    for (size_t i = 0; i < COUNT; i++)
        outside += !box_holds(&world, positions[i]);
    assert_true(inspect_build(&c, &def, NULL, &made, &error));
    assert_int_equal(made.points, COUNT);
    assert_int_equal(made.skipped, 4);
    assert_int_equal(made.outside, outside);
    assert_int_equal(made.refused + made.outside + octree_count(made.tree), COUNT);
    for (size_t i = 0; i < COUNT; i++)
        if (!box_holds(&world, positions[i]))
            assert_false(octree_contains(made.tree, positions[i], i));
    inspect_release(&made);
    assert_null(made.tree);
}

typedef struct told {
    uint64_t times, done;
} told;

static void tell(uint64_t done, uint64_t total, void *context)
{
    told *t = context;
    assert_true(done > t->done && done <= total);
    t->times++;
    t->done = done;
}

/* Some points are outside, and one is far away, so that the world is large and its cells are coarse. The nodes are
 * those of inserting one point at a time, with the same points refused by full leaves. */
static void large_cloud_is_inserted_in_portions(void **state)
{
    enum { COUNT = 200000 };
    static double positions[COUNT][3];
    static octree_point points[COUNT];
    const octree_box all = cube(-10, 10);
    const struct {
        octree_box world;
        octree_full_leaf full;
        uint64_t times;
    } rows[] = {{{{-10, -10, -5}, {10, 10, 100}}, OCTREE_GROW, 3}, {cube(-5, 50), OCTREE_REFUSE, 1}};
    (void)state;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &all, COUNT, positions), OCTREE_OK);
    for (size_t i = 0; i < COUNT; i++)
        points[i] = (octree_point){{positions[i][0], positions[i][1], positions[i][2]}, i};
    for (size_t r = 0; r < 2; r++) {
        octree_def def = define(rows[r].world, 8, 4, rows[r].full);
        cloud c = copy_cloud(positions, COUNT);
        told t = {0};
        inspection made;
        octreel_error error = {""};
        size_t inserted = 0;
        octree *whole = make_tree(def.world, 8, 4, rows[r].full);
        assert_int_equal(octree_insert_many(whole, points, COUNT, NULL, &inserted), OCTREE_OK);
        assert_true(inspect_build(&c, &def, &(watcher){tell, NULL, &t}, &made, &error));
        assert_int_equal(t.times, rows[r].times);
        assert_int_equal(t.done, COUNT);
        assert_true(octree_digest(made.tree) == octree_digest(whole));
        assert_int_equal(made.outside + made.refused, COUNT - inserted);
        assert_true(made.outside > 0 && (made.refused > 0) == (rows[r].full == OCTREE_REFUSE));
        octree_destroy(whole);
        inspect_release(&made);
    }
}

static void skipped_points_are_reported_with_the_reason(void **state)
{
    cloud c = copy_cloud((double[3]){0, 0, 0}, 1);
    const octree_def def = define(cube(-1, 1), 2, 3, OCTREE_GROW);
    char text[4096] = "";
    inspection made;
    octreel_error error = {""};
    FILE *out = fmemopen(text, sizeof text, "w");
    (void)state;
    assert_non_null(out);
    c.skipped = 3;
    c.why_skipped = "marked as withheld";
    assert_true(inspect_build(&c, &def, NULL, &made, &error));
    inspect_print(&made, "cloud", false, out);
    assert_int_equal(fclose(out), 0);
    assert_non_null(strstr(text, "\n  points    4 in the file, 1 in the tree, 0 refused, 0 outside the world\n"
                                 "  skipped   3 marked as withheld\n"));
    inspect_release(&made);
}

static void assert_prints(const inspection *made, bool json, const char *part)
{
    char text[8192] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    assert_non_null(out);
    inspect_print(made, "cloud", json, out);
    assert_int_equal(fclose(out), 0);
    if (!strstr(text, part))
        fail_msg("%s\nhas not %s", text, part);
}

static void statistics_name_the_values_of_the_points(void **state)
{
    static const char text[] =
        "x y z r g b intensity class\n1 2 3 0 0 255 -7.5 6\n4 5 6 1 2 3 none 2\n7 8 9 0 0 0 65535 6\n";
    const octree_def def = define(cube(-10, 10), 2, 3, OCTREE_GROW);
    cloud c;
    inspection made;
    octreel_error error = {""};
    (void)state;
    assert_true(cloud_parse("a.xyz", (const unsigned char *)text, sizeof text - 1, &c, &error));
    assert_true(inspect_build(&c, &def, NULL, &made, &error));
    assert_int_equal(c.values.count, 0); /* the inspection has taken the values over */
    cloud_release(&c);
    assert_prints(&made, false, "\n  values    color 0-255; intensity -7.5 to 65535 of 2 points; classes 2, 6\n");
    assert_prints(&made, true,
                  "\"values\": {\"color\": {\"points\": 3, \"full\": 255}, \"intensity\": {\"points\": 2, \"min\": "
                  "-7.5, \"max\": 65535}, \"class\": {\"points\": 3, \"classes\": [{\"class\": 2, \"points\": 1}, "
                  "{\"class\": 6, \"points\": 2}]}}");
    inspect_release(&made);
}

static void invalid_tree_definition_is_an_error(void **state)
{
    cloud c = copy_cloud((double[3]){0, 0, 0}, 1);
    const octree_def defs[] = {define(cube(1, 1), 2, 3, OCTREE_GROW), define(cube(-1, 1), 0, 3, OCTREE_GROW),
                               define(cube(-INFINITY, 1), 2, 3, OCTREE_GROW)};
    (void)state;
    for (size_t i = 0; i < sizeof defs / sizeof defs[0]; i++) {
        inspection made;
        octreel_error error = {""};
        assert_false(inspect_build(&c, &defs[i], NULL, &made, &error));
        assert_non_null(strstr(error.text, "the tree cannot be built"));
        assert_null(made.tree);
    }
    cloud_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(world_holds_every_point_and_is_valid_for_a_tree),
        cmocka_unit_test(world_is_a_cube_up_to_rounding),
        cmocka_unit_test(world_is_the_smallest_that_holds_the_points),
        cmocka_unit_test(world_is_centred_on_the_points),
        cmocka_unit_test(worlds_of_random_extents_hold_their_points),
        cmocka_unit_test(every_point_is_stored_refused_or_outside),
        cmocka_unit_test(large_cloud_is_inserted_in_portions),
        cmocka_unit_test(skipped_points_are_reported_with_the_reason),
        cmocka_unit_test(statistics_name_the_values_of_the_points),
        cmocka_unit_test(invalid_tree_definition_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
