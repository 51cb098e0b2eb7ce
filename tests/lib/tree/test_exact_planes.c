/* SPDX-License-Identifier: MIT */
/* test_exact_planes.c - the planes of cells compared with exact ones. */
#include "exact_oracle.h"
#include "extreme_worlds.h"

/* The test fails unless the plane k is the real one where that is a double at this and every shallower depth on the
 * way, and within two steps of it elsewhere. */
static void assert_plane(size_t row, uint32_t k, unsigned depth)
{
    double low = world_axes[row][0], high = world_axes[row][1], real;
    double ours = cell(row, k, depth).min[0];
    bool exact = true;
    for (unsigned shift = 0; shift < depth; shift++) {
        uint32_t at = k >> shift;
        exact = exact && exact_plane(low, high, at, depth - shift, &real);
        exact = exact && exact_plane(low, high, at + 1, depth - shift, &real);
    }
    exact_plane(low, high, k, depth, &real);
    if (exact && ours != real)
        fail_msg("plane %u/2^%u of [%.17g, %.17g] is %.17g, not %.17g", k, depth, low, high, ours, real);
    if (!exact_plane_is_near(low, high, k, depth, 2, ours))
        fail_msg("plane %u/2^%u of [%.17g, %.17g] is far off: %.17g", k, depth, low, high, ours);
}

static void planes_are_exact_or_within_two_steps(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (size_t row = 0; row < world_count; row++) {
        for (unsigned depth = 0; depth <= 6; depth++)
            for (uint32_t k = 0; k < 1u << depth; k++)
                assert_plane(row, k, depth);
        for (int i = 0; i < 300; i++) {
            unsigned depth = 7 + (unsigned)random_below(&random, 15);
            assert_plane(row, (uint32_t)random_below(&random, UINT64_C(1) << depth), depth);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_exact_or_within_two_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
