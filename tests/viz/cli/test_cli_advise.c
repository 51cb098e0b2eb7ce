/* SPDX-License-Identifier: MIT */
/* test_cli_advise.c - octreel inspect --advise: its tables and its advice follow from the measured figures, whatever
 * these are. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

static const char *write_cloud(temp_folder *own, int count)
{
    uint64_t random = 3;
    static place path;
    path = place_in(own, "cloud.xyz");
    FILE *file = fopen(path.path, "w");
    assert_non_null(file);
    for (int i = 0; i < count; i++)
        fprintf(file, "%.6f %.6f %.6f\n", random_between(&random, 0, 10), random_between(&random, 0, 10),
                random_between(&random, 0, 10));
    assert_int_equal(fclose(file), 0);
    return path.path;
}

static double number(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    if (!json_is_number(value))
        fail_msg("%s is no number", name);
    return json_number_value(value);
}

static json_t *advise(const char *cloud, const char *options)
{
    command_result result = run_octreel(NULL, "inspect %s --advise --json %s", cloud, options);
    assert_done(&result);
    json_t *advice = json_loads(result.out, 0, NULL);
    assert_non_null(advice);
    command_release(&result);
    return advice;
}

static void errors_are_within_epsilon(void **state)
{
    json_t *advice = advise(write_cloud(*state, 3000), ""), *row;
    size_t i;
    assert_true(number(advice, "points") == 3000);
    assert_int_equal(json_array_size(json_object_get(advice, "epsilons")), 5);
    json_array_foreach(json_object_get(advice, "epsilons"), i, row)
    {
        const double epsilon = number(row, "epsilon"), worst = number(row, "worst_ratio");
        assert_true(worst >= 1 && worst <= 1 + epsilon + 1e-12);
        assert_true(number(row, "mean_ratio") >= 1 && number(row, "mean_ratio") <= worst);
        assert_true(epsilon > 0 ? number(row, "true_share") <= 1 : number(row, "true_share") == 1);
        assert_true(number(row, "eight_nearest_ns") > 0);
    }
    assert_true(number(json_array_get(json_object_get(advice, "epsilons"), 4), "true_share") < 1);
    json_decref(advice);
}

/* The advised capacity is the tree's, unless another one saves a tenth. */
static void the_advice_follows_from_the_times(void **state)
{
    json_t *advice = advise(write_cloud(*state, 20000), "--capacity 3"), *row;
    double best = INFINITY, own = NAN, fastest = NAN;
    size_t i;
    assert_int_equal(json_array_size(json_object_get(advice, "capacities")), 6);
    json_array_foreach(json_object_get(advice, "capacities"), i, row)
    {
        const double cost = number(row, "nearest_ns") + number(row, "eight_nearest_ns");
        assert_true(number(row, "build_ns") > 0 && number(row, "bytes") > 32);
        if (number(row, "capacity") == 3)
            own = cost;
        if (cost < best) {
            best = cost;
            fastest = number(row, "capacity");
        }
    }
    assert_true(number(advice, "capacity") == (own < 1.1 * best ? 3 : fastest));
    json_decref(advice);
}

static void the_text_has_both_tables_and_a_sentence(void **state)
{
    command_result result = run_octreel(NULL, "inspect %s --advise", write_cloud(*state, 1000));
    assert_done(&result);
    static const char *const parts[] = {"cloud.xyz\n10000 searches near 1000 points", "\n*       64 ", "\n         0 ",
                                        "\nadvice: "};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (!strstr(result.out, parts[i]))
            fail_msg("\"%s\" is missing: %s", parts[i], result.out);
    command_release(&result);
}

static void few_points_are_refused(void **state)
{
    command_result result = run_octreel(NULL, "inspect %s --advise", write_cloud(*state, 99));
    assert_trouble(&result, "--advise needs at least 100 points in the tree; it has 99");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(errors_are_within_epsilon, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(the_advice_follows_from_the_times, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(the_text_has_both_tables_and_a_sentence, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(few_points_are_refused, temp_folder_make, temp_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
