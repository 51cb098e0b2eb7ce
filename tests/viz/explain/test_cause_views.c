/* SPDX-License-Identifier: MIT */
/* test_cause_views.c - `octreel diff` of two recordings that differ in one view option names that option, its value and
 * its value before, and nothing that only follows from it. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "view_options.h"

/* For each option: a value that is not its default, and the cause that diff reports. */
static const struct {
    const char *name, *value, *cause;
} changes[] = {
    {"size", "100x60", "size ((100, 60), was (160, 90))"},
    {"camera", "top", "camera (top, was iso)"},
    {"fit", "points", "fit (points, was world)"},
    {"look", "10,5", "direction of view ((10, 5), was none)"},
    {"center", "1,2,3", "center of view ((1, 2, 3), was none)"},
    {"zoom", "2", "zoom (2, was 1)"},
    {"layers", "-text", "one layer fewer (text)"},
    {"color-by", "plain", "colouring (plain, was depth)"},
    {"color-points", "height", "colouring of points (height, was plain)"},
    {"shade", "none", "shade (none, was bands)"},
    {"tree", "own", "tree (own, was auto)"},
    {"diagram", "only", "diagram (only, was beside)"},
    {"no-closeup", "", "close-up (off, was on)"},
    {"slice", "z=100", "slice (z 100, was none)"},
    {"depths", "1:3", "range of depths ((1, 3), was none)"},
    {"leaves", "", "rule for leaves only (on, was off)"},
    {"region", "-9,-9,-9,5,5,5", "region ((-9, -9, -9) to (5, 5, 5), was none)"},
    {"labels", "", "rule for labels (on, was off)"},
    {"lod", "9", "level of detail (9, was 2)"},
    {"budget", "7", "budget (7, was 250000)"},
    {"aa", "2", "anti-aliasing (2, was 1)"},
};

static void film(const char *folder, const char *options)
{
    command_result result = run_octreel(NULL, "record --keys w --size 160x90 %s -o %s", options, folder);
    assert_done(&result);
    command_release(&result);
}

/* The causes are between the first line and ": the ticks are the same, only the view differs". */
static void assert_one_cause(const char *a, const char *b, const char *cause)
{
    char expected[160];
    command_result result = run_octreel(NULL, "diff %s %s", a, b);
    snprintf(expected, sizeof expected, "\n%s%s: the ticks are the same, only the view differs\n",
             strncmp(cause, "one ", 4) == 0 ? "" : "another ", cause);
    if (!strstr(result.out, expected))
        fail_msg("expected \"%s\" in:\n%s", expected + 1, result.out);
    command_release(&result);
}

static void every_option_is_one_cause_with_its_value_before(void **state)
{
    const temp_folder *folder = *state;
    const place a = place_in(folder, "a");
    film(a.path, "");
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        char options[80], name[16];
        snprintf(options, sizeof options, "--%s %s", changes[i].name, changes[i].value);
        snprintf(name, sizeof name, "b%zu", i);
        const place b = place_in(folder, name);
        film(b.path, options);
        assert_one_cause(a.path, b.path, changes[i].cause);
    }
}

static void the_table_has_every_recorded_option(void **state)
{
    (void)state;
    for (size_t i = 0; view_option_at(i); i++) {
        size_t n = 0;
        while (n < sizeof changes / sizeof changes[0] && strcmp(changes[n].name, view_option_at(i)->name) != 0)
            n++;
        if (view_option_at(i)->member.name && n == sizeof changes / sizeof changes[0])
            fail_msg("no row for --%s", view_option_at(i)->name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_option_is_one_cause_with_its_value_before, temp_folder_make,
                                        nested_folder_remove),
        cmocka_unit_test(the_table_has_every_recorded_option),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
