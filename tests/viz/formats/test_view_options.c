/* SPDX-License-Identifier: MIT */
/* test_view_options.c - the table of view options: names, defaults, choices and limits. */
#include <stdio.h>
#include <string.h>

#include "fixture.h"
#include "layer.h"
#include "recording_file.h"
#include "view_options.h"

static bool parses(const view_option *option, const char *text, view *v, const char *part)
{
    octreel_error error = {""};
    const bool parsed = option->parse(option, text, v, &error);
    if (!parsed && !strstr(error.text, part))
        fail_msg("\"%s\" does not contain \"%s\"", error.text, part);
    return parsed;
}

static void every_row_is_complete_and_found_by_its_name(void **state)
{
    (void)state;
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        assert_non_null(option->name);
        assert_true(!option->member.name || (option->member.codec->read && option->member.codec->write));
        assert_ptr_equal(view_find_option(option->name), option);
        assert_non_null(option->help);
        assert_non_null(option->parse);
    }
    assert_null(view_find_option("camera-at"));
}

/* The help describes the default in words; `standard` in the row is its value. */
static void help_names_the_default_of_every_row(void **state)
{
    static const char *const elsewhere[] = {"fit", "layers", "aa"}; /* described in another way */
    (void)state;
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        char expected[48];
        bool skip = !option->standard || !option->value;
        for (size_t n = 0; n < sizeof elsewhere / sizeof elsewhere[0]; n++)
            skip = skip || strcmp(option->name, elsewhere[n]) == 0;
        snprintf(expected, sizeof expected, "(default %s", option->standard ? option->standard : "");
        if (!skip && !strstr(option->help, expected))
            fail_msg("the help of --%s does not contain \"%s\"", option->name, expected);
    }
}

static void every_default_is_a_value_of_its_option(void **state)
{
    (void)state;
    const view usual = view_make_default();
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        view v = usual;
        if (option->standard)
            assert_true(parses(option, option->standard, &v, ""));
        assert_memory_equal(&v, &usual, sizeof v);
    }
    assert_true(usual.width == 1280 && usual.height == 720 && usual.camera == CAMERA_ISO && usual.closeup);
    assert_true(usual.layers == VIEW_DEFAULT_LAYERS && usual.lod == 2 && usual.budget == 250000 && usual.aa == 1);
}

/* Only exact names are accepted. */
static void every_choice_is_read_by_its_name(void **state)
{
    static const char *const unknown[] = {"", "is", "isometric", "ISO", " iso", "iso ", "0", "iso,top", "Depth"};
    (void)state;
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        view v = view_make_default();
        if (!option->member.names || strcmp(option->name, "layers") == 0)
            continue;
        const int *chosen = (const int *)((const char *)&v + option->member.offset);
        for (int n = 0; option->member.names(n); n++) {
            assert_true(parses(option, option->member.names(n), &v, ""));
            assert_int_equal(*chosen, n);
        }
        const int last = *chosen;
        for (size_t n = 0; n < sizeof unknown / sizeof unknown[0]; n++)
            assert_false(parses(option, unknown[n], &v, "unknown "));
        assert_int_equal(*chosen, last);
    }
}

static void values_out_of_range_are_refused(void **state)
{
    static const char *const rows[][3] = {
        {"size", "640", "--size takes pixels as in 1280x720, not \"640\""},
        {"size", "640x", "--size"},
        {"size", "640x-1", "--size"},
        {"fit", "box", "unknown fit \"box\"; choose from world, points"},
        {"layers", "nodes,walls,text", "unknown layer \"walls\"; choose from world, nodes, "},
        {"look", "30", "--look takes an azimuth from -360 to 360 and an elevation from -90 to 90 as in 30,22"},
        {"look", "30,90.5", "--look"},
        {"look", "361,0", "--look"},
        {"center", "1,2", "--center takes three numbers"},
        {"zoom", "0", "--zoom takes a number from 0.001 to 1000000, not \"0\""},
        {"zoom", "inf", "--zoom"},
        {"slice", "{=1", "--slice"},
        {"slice", "w=1", "--slice takes an axis and a place as in z=100, not \"w=1\""},
        {"slice", "x=1,2", "--slice"},
        {"slice", "x:1", "--slice"},
        {"depths", ":", "--depths takes levels from 0 to 21"},
        {"depths", "3:2", "--depths"},
        {"depths", "22", "--depths"},
        {"depths", "2:5x", "--depths"},
        {"region", "0,0,0,1,1", "--region takes six numbers"},
        {"region", "0,0,2,1,1,1", "--region: min must not be above max on any axis, but z is"},
        {"lod", "-1", "--lod takes pixels from 0 to 16384, not \"-1\""},
        {"lod", "nan", "--lod"},
        {"budget", "9007199254740992", "--budget takes a whole number below 2^53"},
        {"budget", "1.5", "--budget"},
        {"aa", "3", "--aa takes 1, 2 or 4 samples"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        view v = view_make_default();
        assert_false(parses(view_find_option(rows[i][0]), rows[i][1], &v, rows[i][2]));
    }
}

static void limits_of_each_range_are_accepted(void **state)
{
    static const char *const rows[][2] = {{"look", "360,90"},  {"look", "-360,-90"}, {"zoom", "0.001"},
                                          {"zoom", "1000000"}, {"depths", "0:21"},   {"depths", ":0"},
                                          {"depths", "21"},    {"depths", "4:4"},    {"size", "1x16384"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        view v = view_make_default();
        if (!parses(view_find_option(rows[i][0]), rows[i][1], &v, ""))
            fail_msg("--%s %s is refused", rows[i][0], rows[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_complete_and_found_by_its_name),
        cmocka_unit_test(help_names_the_default_of_every_row),
        cmocka_unit_test(every_default_is_a_value_of_its_option),
        cmocka_unit_test(every_choice_is_read_by_its_name),
        cmocka_unit_test(values_out_of_range_are_refused),
        cmocka_unit_test(limits_of_each_range_are_accepted),
    };
    return cmocka_run_group_tests_name("view_options", tests, NULL, NULL);
}
