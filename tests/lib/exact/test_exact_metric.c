/* SPDX-License-Identifier: MIT */
/* test_exact_metric.c - metric_compare() and metric_compare_radius() against integers of GMP, where doubles do not
 * decide: points at equal and nearly equal distances, on grids and off them, at all magnitudes. */
#include "fixture.h"
#include "exact_oracle.h"
#include "exact.h"
#include "metric.h"

#include <math.h>

enum { TRIALS = 200000 };

/* A number on a grid of 2^bits cells, multiplied by 2^shift. */
static double random_grid_number(uint64_t *random, int bits, int shift)
{
    const double limit = ldexp(1, bits);
    return ldexp(floor(random_between(random, -limit, limit)), shift);
}

/* The reflection of a in the target, moved by a few doubles: it is as far as a, or nearly. */
static void reflect(uint64_t *random, const double target[3], const double a[3], double b[3])
{
    for (int i = 0; i < 3; i++) {
        b[i] = random_below(random, 2) ? a[i] : 2 * target[i] - a[i];
        if (random_below(random, 4) == 0)
            b[i] = nextafter(b[i], random_below(random, 2) ? INFINITY : -INFINITY);
    }
}

static void compare_at(int bits, int shift, double offset)
{
    uint64_t random = (uint64_t)(bits * 5000 + shift + 3000);
    int signs[3] = {0};
    for (int trial = 0; trial < TRIALS / 50; trial++) {
        double target[3], a[3], b[3];
        for (int i = 0; i < 3; i++) {
            target[i] = offset + random_grid_number(&random, bits, shift);
            a[i] = offset + random_grid_number(&random, bits, shift);
        }
        reflect(&random, target, a, b);
        const int sign = metric_compare(target, a, b);
        assert_int_equal(sign, exact_compare(target, a, b));
        signs[sign + 1]++;
        const double radius = metric_distance(target, a);
        assert_int_equal(metric_compare_radius(target, b, radius), exact_compare_radius(target, b, radius, 0));
    }
    if (bits < 53 && offset == 0)
        assert_true(signs[1] > 0); /* ties occur */
    assert_true(signs[0] > 0 && signs[2] > 0);
}

static void comparisons_are_those_of_real_numbers(void **state)
{
    (void)state;
    static const int bits[] = {2, 10, 26, 50, 53};
    static const int shifts[] = {-1074, -1040, -960, -700, -60, -26, 0, 200, 840, 900, 960};
    for (size_t i = 0; i < sizeof bits / sizeof bits[0]; i++)
        for (size_t j = 0; j < sizeof shifts / sizeof shifts[0]; j++)
            compare_at(bits[i], shifts[j], 0);
    compare_at(20, -20, 1e6);
    compare_at(20, -30, 1e12);
    compare_at(53, -53, 1e3);
}

/* Coordinates whose exponents differ by more than a common unit allows. */
static void coordinates_of_different_sizes_are_compared(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int trial = 0; trial < TRIALS / 4; trial++) {
        double target[3], a[3], b[3];
        for (int i = 0; i < 3; i++) {
            target[i] = random_grid_number(&random, 53, -53 - (int)random_below(&random, 20));
            a[i] = random_grid_number(&random, 53, -53 - (int)random_below(&random, 20));
        }
        reflect(&random, target, a, b);
        assert_int_equal(metric_compare(target, a, b), exact_compare(target, a, b));
    }
}

/* Whether a double is the nearest one to a sum of terms: the sum lies between the midpoints beside the double. */
static bool is_nearest_double(double value, const double terms[], int count)
{
    for (int side = -1; side <= 1; side += 2) {
        exact_sum sum;
        exact_clear(&sum);
        for (int i = 0; i < count; i++)
            exact_add_product(&sum, 2, terms[i], 1);
        exact_add_product(&sum, -1, value, 1);
        exact_add_product(&sum, -1, side > 0 ? next_up(value) : next_down(value), 1);
        if (exact_sign(&sum) * side > 0)
            return false;
    }
    return true;
}

static void sums_are_rounded_to_the_nearest_double(void **state)
{
    (void)state;
    uint64_t random = 3;
    const double half_way[3] = {0x1.106172abb2a7ep+113, 0x1p+60, 0x1.fffffffffep+59};
    for (int trial = 0; trial < TRIALS / 4; trial++) {
        double terms[4];
        exact_sum sum;
        for (int i = 0; i < 4; i++)
            terms[i] = trial == 0 ? (i < 3 ? half_way[i] : 0)
                                  : random_grid_number(&random, 1 + (int)random_below(&random, 53),
                                                       (int)random_below(&random, 120) - 60);
        exact_clear(&sum);
        for (int i = 0; i < 4; i++)
            exact_add_product(&sum, 1, terms[i], 1);
        assert_true(is_nearest_double(exact_round(&sum), terms, 4));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comparisons_are_those_of_real_numbers),
        cmocka_unit_test(coordinates_of_different_sizes_are_compared),
        cmocka_unit_test(sums_are_rounded_to_the_nearest_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
