/* SPDX-License-Identifier: MIT */
/* test_view.c - names of layers, lists of layers, and the unit of the widths of lines and text. */
#include "scenes.h"

static void every_layer_is_found_by_its_name(void **state)
{
    (void)state;
    for (int i = 0; i < LAYER_COUNT; i++) {
        unsigned layers = 0;
        const char *bad;
        assert_non_null(layer_rows[i].name);
        assert_true(view_layers_parse(layer_rows[i].name, &layers, &bad));
        assert_int_equal(layers, 1u << i);
    }
}

static void lists_of_layers_are_read_from_left_to_right(void **state)
{
    (void)state;
    static const struct {
        const char *list;
        unsigned layers;
    } rows[] = {
        {"all", VIEW_ALL_LAYERS},
        {"none", 0},
        {"nodes,points", 1u << LAYER_NODES | 1u << LAYER_POINTS},
        {"points,nodes,points", 1u << LAYER_NODES | 1u << LAYER_POINTS},
        {"default", VIEW_DEFAULT_LAYERS},
        {"default,visit-heat,point-heat", VIEW_ALL_LAYERS},
        {"-text", VIEW_DEFAULT_LAYERS & ~(1u << LAYER_TEXT)},
        {"-text,-nodes", VIEW_DEFAULT_LAYERS & ~(1u << LAYER_TEXT | 1u << LAYER_NODES)},
        {"all,-visit-heat,-point-heat", VIEW_DEFAULT_LAYERS},
        {"all,-box", VIEW_ALL_LAYERS & ~(1u << LAYER_BOX)},
        {"-box,box", VIEW_DEFAULT_LAYERS},
        {"nodes,-nodes", 0},
        {"none,world", 1u << LAYER_WORLD},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        unsigned layers = 12345;
        const char *bad;
        assert_true(view_layers_parse(rows[i].list, &layers, &bad));
        assert_int_equal(layers, rows[i].layers);
    }
}

static void unknown_layers_are_reported_and_change_nothing(void **state)
{
    (void)state;
    static const struct {
        const char *list, *rest;
    } rows[] = {
        {"", ""},
        {",", ","},
        {"nodes,", ""},
        {"nodes,,points", ",points"},
        {"node", "node"},
        {"nodess", "nodess"},
        {"points,Nodes", "Nodes"},
        {"-", "-"},
        {"-al", "-al"},
        {"all,-x,text", "-x,text"},
        {"nodes points", "nodes points"},
        {"--text", "--text"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        unsigned layers = 12345;
        const char *bad = NULL;
        assert_false(view_layers_parse(rows[i].list, &layers, &bad));
        assert_string_equal(bad, rows[i].rest);
        assert_int_equal(layers, 12345);
    }
}

static void the_default_view_shows_all_but_heat_and_has_even_sides(void **state)
{
    (void)state;
    const view v = view_make_default();
    assert_true(v.width == 1280 && v.height == 720);
    assert_int_equal(v.camera, CAMERA_ISO);
    for (int i = 0; i < LAYER_COUNT; i++)
        assert_int_equal(view_shows_layer(&v, (view_layer)i), i != LAYER_VISIT_HEAT && i != LAYER_POINT_HEAT);
}

static void unit_is_a_whole_number_of_pixels_and_grows_with_the_picture(void **state)
{
    (void)state;
    int last = 1;
    for (int height = 1; height <= 16384; height++) {
        const view wide = view_of(16384, height, CAMERA_ISO, 0), slit = view_of(1, height, CAMERA_ISO, 0);
        assert_true(view_pixels_per_unit(&wide) >= last);
        assert_int_equal(view_pixels_per_unit(&slit), 1);
        last = view_pixels_per_unit(&wide);
    }
    const view usual = view_make_default(), film = view_of(3840, 2160, CAMERA_ISO, 0);
    assert_int_equal(view_pixels_per_unit(&usual), 2);
    assert_int_equal(view_pixels_per_unit(&film), 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layer_is_found_by_its_name),
        cmocka_unit_test(lists_of_layers_are_read_from_left_to_right),
        cmocka_unit_test(unknown_layers_are_reported_and_change_nothing),
        cmocka_unit_test(the_default_view_shows_all_but_heat_and_has_even_sides),
        cmocka_unit_test(unit_is_a_whole_number_of_pixels_and_grows_with_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
