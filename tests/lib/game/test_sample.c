/* SPDX-License-Identifier: MIT */
/* test_sample.c - the seeded distributions: in the box, the same everywhere, of the shapes that their names say. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "octree/digest.h"
#include "octree/sample.h"

enum { some = 4096 };

static double points[some][3];

static const octree_box box = {{-3, 10, -0.5}, {5, 11, 0.25}};

static void draw(octree_sample_kind kind, uint64_t seed, size_t count)
{
    assert_int_equal(octree_sample(kind, seed, &box, count, points), OCTREE_OK);
}

static uint64_t digest_of(size_t count)
{
    uint64_t digest = OCTREE_DIGEST_START;
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            digest = octree_digest_double(digest, points[i][axis]);
    return digest;
}

static void the_generator_is_splitmix64(void **state)
{
    (void)state;
    static const uint64_t expected[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                        4593380528125082431u, 16408922859458223821u};
    uint64_t random = 1234567;
    for (size_t i = 0; i < 5; i++)
        assert_true(octree_random(&random) == expected[i]);
}

static void a_unit_has_the_53_highest_bits(void **state)
{
    (void)state;
    uint64_t a = 42, b = 42;
    for (int i = 0; i < 1000; i++) {
        double unit = octree_random_unit(&a);
        assert_true(unit == (double)(octree_random(&b) >> 11) * 0x1p-53);
        assert_true(unit >= 0 && unit < 1);
    }
}

static void each_kind_has_a_name_and_back(void **state)
{
    (void)state;
    static const char *const names[] = {"uniform", "gaussian", "clustered", "surface", "lattice"};
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        octree_sample_kind parsed = OCTREE_SAMPLE_KINDS;
        assert_string_equal(octree_sample_name((octree_sample_kind)kind), names[kind]);
        assert_true(octree_sample_parse(names[kind], &parsed));
        assert_int_equal(parsed, kind);
    }
    octree_sample_kind parsed;
    assert_null(octree_sample_name(OCTREE_SAMPLE_KINDS));
    assert_false(octree_sample_parse("", &parsed));
    assert_false(octree_sample_parse("Uniform", &parsed));
    assert_false(octree_sample_parse("uniforms", &parsed));
}

static void sample_refuses_bad_boxes_and_kinds(void **state)
{
    (void)state;
    octree_box bad = box;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_KINDS, 1, &box, 1, points), OCTREE_BAD_OPTION);
    bad.max[1] = bad.min[1];
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &bad, 1, points), OCTREE_BAD_WORLD);
    bad.max[1] = NAN;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &bad, 1, points), OCTREE_BAD_WORLD);
    bad.max[1] = INFINITY;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &bad, 1, points), OCTREE_BAD_WORLD);
}

static void every_point_lies_in_the_box_even_in_extreme_ones(void **state)
{
    (void)state;
    static const octree_box boxes[] = {
        {{-3, 10, -0.5}, {5, 11, 0.25}},
        {{-DBL_MAX, -1e200, 5e-324}, {DBL_MAX, 1e200, 1e-310}},
        {{1e15, 1, -5e-324}, {1e15 + 1, 1 + 0x1p-52, 5e-324}},
        {{-DBL_MAX, 0, 1e308}, {-1e308, 5e-324, DBL_MAX}},
        {{5e-324, 5e-324, 5e-324}, {1.5e-323, 1e-323, 2e-323}}, /* whose halves are rounded */
    };
    for (size_t b = 0; b < 5; b++)
        for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
            assert_int_equal(octree_sample((octree_sample_kind)kind, b, &boxes[b], some, points), OCTREE_OK);
            for (size_t i = 0; i < some; i++)
                assert_true(box_holds(&boxes[b], points[i]));
        }
}

static void the_same_seed_gives_the_same_points(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        draw((octree_sample_kind)kind, 7, some);
        uint64_t digest = digest_of(some);
        memset(points, 0, sizeof points);
        draw((octree_sample_kind)kind, 7, some);
        assert_true(digest_of(some) == digest);
        draw((octree_sample_kind)kind, 8, some);
        assert_true((digest_of(some) == digest) == (kind == OCTREE_SAMPLE_LATTICE));
    }
}

static void a_shorter_sample_is_the_start_of_a_longer_one(void **state)
{
    (void)state;
    /* A lattice is laid out for its count, so it is no prefix. */
    for (int kind = 0; kind < OCTREE_SAMPLE_LATTICE; kind++) {
        draw((octree_sample_kind)kind, 3, some);
        uint64_t digest = digest_of(10);
        draw((octree_sample_kind)kind, 3, 10);
        assert_true(digest_of(10) == digest);
    }
}

static void the_points_are_pinned(void **state)
{
    (void)state;
    static const uint64_t pinned[] = {
        0xb2a63ef0f179de56, 0xf0341225e476e36a, 0x26322e4cc4eb5c10, 0x02882da5f439cb01, 0x7258aab20e3ecbf2,
    };
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        draw((octree_sample_kind)kind, 2024, some);
        if (digest_of(some) != pinned[kind])
            fail_msg("%s is 0x%016llx", octree_sample_name((octree_sample_kind)kind),
                     (unsigned long long)digest_of(some));
    }
}

/* Position on an axis as -1 .. 1 across the box. */
static double relative(size_t i, int axis)
{
    double half = (box.max[axis] - box.min[axis]) / 2;
    return (points[i][axis] - box.min[axis]) / half - 1;
}

static void mean_and_variance(int axis, double *mean, double *variance)
{
    *mean = *variance = 0;
    for (size_t i = 0; i < some; i++)
        *mean += relative(i, axis) / some;
    for (size_t i = 0; i < some; i++)
        *variance += (relative(i, axis) - *mean) * (relative(i, axis) - *mean) / some;
}

static void uniform_fills_the_box_evenly(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_UNIFORM, 1, some);
    size_t octants[8] = {0};
    for (size_t i = 0; i < some; i++)
        octants[(relative(i, 0) >= 0) * 4 + (relative(i, 1) >= 0) * 2 + (relative(i, 2) >= 0)]++;
    for (int i = 0; i < 8; i++)
        assert_true(octants[i] >= some / 8 - 100 && octants[i] <= some / 8 + 100);
}

static void gaussian_has_a_sigma_of_a_sixth_of_the_extent(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_GAUSSIAN, 1, some);
    for (int axis = 0; axis < 3; axis++) {
        double mean, variance;
        mean_and_variance(axis, &mean, &variance);
        assert_true(fabs(mean) < 0.03);
        assert_true(fabs(sqrt(variance) - 1.0 / 3) < 0.02);
    }
}

static void surface_lies_on_the_ellipsoid_of_nine_tenths(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_SURFACE, 1, some);
    for (size_t i = 0; i < some; i++) {
        double x = relative(i, 0), y = relative(i, 1), z = relative(i, 2);
        assert_true(fabs(sqrt(x * x + y * y + z * z) - 0.9) < 1e-9);
    }
}

static void lattice_is_a_grid_of_distinct_cell_centres_with_x_slowest(void **state)
{
    (void)state;
    draw(OCTREE_SAMPLE_LATTICE, 1, some); /* 16^3 */
    for (size_t i = 0; i < some; i++) {
        const size_t cells[3] = {i / 256, i / 16 % 16, i % 16};
        for (int axis = 0; axis < 3; axis++)
            assert_true(fabs(relative(i, axis) - (((double)cells[axis] + 0.5) / 8 - 1)) < 1e-12);
    }
    for (size_t count = 1; count < 200; count++) {
        draw(OCTREE_SAMPLE_LATTICE, 1, count);
        for (size_t i = 1; i < count; i++)
            assert_false(same_position(points[i], points[i - 1]));
    }
}

static void clustered_is_crowded_where_uniform_is_not(void **state)
{
    (void)state;
    size_t leaves[2] = {0, 0};
    static const octree_sample_kind kinds[] = {OCTREE_SAMPLE_UNIFORM, OCTREE_SAMPLE_CLUSTERED};
    for (int k = 0; k < 2; k++) {
        draw(kinds[k], 1, some);
        octree *tree = make_tree(box, 1, 4, OCTREE_GROW);
        for (size_t i = 0; i < some; i++)
            assert_int_equal(octree_insert(tree, points[i], i), OCTREE_OK);
        octree_stats stats;
        assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
        leaves[k] = stats.leaves;
        octree_destroy(tree);
    }
    assert_true(leaves[1] < leaves[0] / 2); /* cells of depth 4 that hold a point */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_generator_is_splitmix64),
        cmocka_unit_test(a_unit_has_the_53_highest_bits),
        cmocka_unit_test(each_kind_has_a_name_and_back),
        cmocka_unit_test(sample_refuses_bad_boxes_and_kinds),
        cmocka_unit_test(every_point_lies_in_the_box_even_in_extreme_ones),
        cmocka_unit_test(the_same_seed_gives_the_same_points),
        cmocka_unit_test(a_shorter_sample_is_the_start_of_a_longer_one),
        cmocka_unit_test(the_points_are_pinned),
        cmocka_unit_test(uniform_fills_the_box_evenly),
        cmocka_unit_test(gaussian_has_a_sigma_of_a_sixth_of_the_extent),
        cmocka_unit_test(surface_lies_on_the_ellipsoid_of_nine_tenths),
        cmocka_unit_test(lattice_is_a_grid_of_distinct_cell_centres_with_x_slowest),
        cmocka_unit_test(clustered_is_crowded_where_uniform_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
