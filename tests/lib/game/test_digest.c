/* SPDX-License-Identifier: MIT */
/* test_digest.c - digest.h in a program that is built by other rules than the library: without signed zeros. */
#include "fixture.h"
#include "octree/digest.h"

static void zeros_count_as_equal_and_other_doubles_do_not(void **state)
{
    (void)state;
    static const volatile double zeros[] = {0.0, -0.0}, others[] = {1, -1, 5e-324, -5e-324, 1e300, -1e300};
    const uint64_t zero = octree_digest_double(OCTREE_DIGEST_START, zeros[0]);
    assert_true(octree_digest_double(OCTREE_DIGEST_START, zeros[1]) == zero);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        for (size_t k = 0; k < i; k++)
            assert_true(octree_digest_double(zero, others[i]) != octree_digest_double(zero, others[k]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(zeros_count_as_equal_and_other_doubles_do_not)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
