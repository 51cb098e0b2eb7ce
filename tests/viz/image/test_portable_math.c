/* SPDX-License-Identifier: MIT */
/* test_portable_math.c - exp and pow against the C library, and bit for bit. */
#include "fixture.h"
#include "portable_math.h"

#include <math.h>

static void assert_close(double got, double expected, double part)
{
    if (!(fabs(got - expected) <= part * fabs(expected)))
        fail_msg("%.17g instead of %.17g", got, expected);
}

static void exp_is_as_exact_as_promised(void **state)
{
    (void)state;
    for (int i = -14000; i <= 14000; i++)
        assert_close(portable_exp(i / 20.0 + i * 1e-7), exp(i / 20.0 + i * 1e-7),
                     i >= -276 && i <= 276 ? 1e-14 : 1e-12);
    assert_true(portable_exp(0) == 1);
}

static void pow_is_as_exact_as_promised(void **state)
{
    (void)state;
    static const double exponents[] = {2.4, 1 / 3.0, 0.7, -1.3, 1, 0};
    for (int i = -300; i <= 300; i++)
        for (int j = 0; j < 6; j++) {
            const double x = ldexp(1 + (i & 31) / 32.0, i / 20), expected = pow(x, exponents[j]);
            assert_close(portable_pow(x, exponents[j]), expected, expected > 1e-6 && expected < 1e6 ? 1e-14 : 1e-12);
        }
    assert_close(portable_pow(1e300, 1), 1e300, 1e-12);
    assert_close(portable_pow(1e-300, 1), 1e-300, 1e-12);
}

static void bits_are_the_same_everywhere(void **state)
{
    (void)state;
    assert_true(portable_exp(-1) == 0x1.78b56362cef38p-2);
    assert_true(portable_pow(0.3, 2.4) == 0x1.c77e018c0c76ep-5);
    assert_true(portable_pow(1e5, 1 / 3.0) == 0x1.7353bd4393a74p+5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exp_is_as_exact_as_promised),
        cmocka_unit_test(pow_is_as_exact_as_promised),
        cmocka_unit_test(bits_are_the_same_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
