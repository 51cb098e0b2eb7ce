/* SPDX-License-Identifier: MIT */
/* test_recording_file.c - recording.json restores the view that was written, and invalid files are refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "layer.h"
#include "recording_file.h"
#include "folder_files.h"
#include "view_options.h"

static octree_box random_box(uint64_t *random)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = random_between(random, -1e6, 0);
        box.max[i] = random_between(random, 0.001, 1e-3 + 1e6);
    }
    return box;
}

static view random_view(uint64_t *random)
{
    view v = {.width = 1 + (int)random_below(random, 16384), .height = 1 + (int)random_below(random, 16384)};
    v.camera = (view_camera)random_below(random, CAMERA_COUNT);
    v.layers = (unsigned)random_below(random, VIEW_ALL_LAYERS + 1);
    v.coloring = (view_coloring)random_below(random, COLORING_COUNT);
    v.diagram = (view_diagram)random_below(random, DIAGRAM_COUNT);
    v.fit = random_below(random, 2) ? FIT_BOX : FIT_WORLD;
    if (v.fit == FIT_BOX)
        v.focus = random_box(random);
    v.look.given = random_below(random, 2);
    if (v.look.given) {
        v.look.azimuth = random_between(random, -360, 360);
        v.look.elevation = random_between(random, -90, 90);
    }
    v.center.given = random_below(random, 2);
    for (int i = 0; v.center.given && i < 3; i++)
        v.center.place[i] = random_between(random, -1e6, 1e6);
    v.zoom = random_below(random, 2) ? random_between(random, 0.001, 1e6) : 1;
    v.point_color = (view_point_color)random_below(random, POINTS_BY_COUNT);
    v.shade = (view_shade)random_below(random, SHADE_COUNT);
    v.point_scale.given = random_below(random, 2);
    for (int i = 0; v.point_scale.given && i < 3; i++) {
        v.point_scale.of.low[i] = random_between(random, -1e6, 0);
        v.point_scale.of.high[i] = random_between(random, 0, 1e6);
        v.point_scale.of.spacing = random_between(random, 0, 10);
        v.point_scale.of.intensities[1] = random_between(random, 0, 10);
        v.point_scale.of.ids[1] = random_between(random, 0, 1e15);
    }
    v.filter.slice = "\0xyz"[random_below(random, 4)];
    v.filter.slice_at = v.filter.slice ? random_between(random, -1, 1) : 0;
    v.filter.leaves = random_below(random, 2);
    v.filter.by_depth = random_below(random, 2);
    if (v.filter.by_depth) {
        v.filter.min_depth = (unsigned)random_below(random, 10);
        v.filter.max_depth = v.filter.min_depth + (unsigned)random_below(random, 12);
    }
    v.filter.by_region = random_below(random, 2);
    if (v.filter.by_region)
        v.filter.region = random_box(random);
    v.labels = random_below(random, 2);
    v.aa = 1 << random_below(random, 3);
    v.lod = random_below(random, 2) ? random_between(random, 0, 16384) : 0;
    v.closeup = random_below(random, 2);
    v.budget = random_below(random, UINT64_C(1) << 53);
    return v;
}

static void assert_same_view(const view *a, const view *b)
{
    assert_true(a->width == b->width && a->height == b->height && a->camera == b->camera && a->layers == b->layers);
    assert_true(a->coloring == b->coloring && a->diagram == b->diagram && a->fit == b->fit);
    assert_true(a->labels == b->labels && a->closeup == b->closeup && a->lod == b->lod && a->budget == b->budget &&
                a->aa == b->aa);
    assert_true(a->point_color == b->point_color && a->shade == b->shade);
    assert_int_equal(a->point_scale.given, b->point_scale.given);
    assert_memory_equal(&a->point_scale.of, &b->point_scale.of, sizeof a->point_scale.of);
    assert_memory_equal(&a->focus, &b->focus, sizeof a->focus);
    assert_true(a->look.given == b->look.given && a->look.azimuth == b->look.azimuth &&
                a->look.elevation == b->look.elevation);
    assert_true(a->zoom == b->zoom);
    assert_true(a->center.given == b->center.given && same_position(a->center.place, b->center.place));
    const view_filter *f = &a->filter, *g = &b->filter;
    assert_true(f->slice == g->slice && f->slice_at == g->slice_at && f->leaves == g->leaves);
    assert_true(f->by_depth == g->by_depth && f->min_depth == g->min_depth && f->max_depth == g->max_depth);
    assert_int_equal(f->by_region, g->by_region);
    assert_memory_equal(&f->region, &g->region, sizeof f->region);
}

static void view_survives_the_round_trip_to_the_bit(void **state)
{
    const temp_folder *folder = *state;
    uint64_t random = 8;
    for (int i = 0; i < 300; i++) {
        const view written = random_view(&random);
        view read;
        uint64_t every;
        octreel_error error = {""};
        assert_true(write_recording_file(&(folder_place){.folder = folder->name}, &written, 1, &error));
        if (!recording_read(folder->name, &read, &every, &error))
            fail_msg("%s", error.text);
        assert_same_view(&written, &read);
    }
}

#define START "{\"octreel\": \"recording\", \"version\": 4,\n\"size\": [160, 90],\n"
#define VIEW START "\"camera\": \"top\", \"layers\": [\"nodes\"]"

static void write_text(const view *v, char text[2048])
{
    FILE *stream = fmemopen(text, 2048, "w");
    assert_non_null(stream);
    recording_write(stream, v, 1);
    assert_int_equal(fclose(stream), 0);
}

/* --camera-from is not a member of recording.json: it sets other members. */
static void every_view_option_is_written(void **state)
{
    static const char *const samples[][2] = {
        {"size", "640x360"}, {"camera", "top"},   {"layers", "nodes"},       {"color-by", "plain"},
        {"tree", "both"},    {"diagram", "only"}, {"slice", "z=7"},          {"depths", "2:3"},
        {"leaves", ""},      {"labels", ""},      {"region", "0,0,0,1,2,3"}, {"lod", "9"},
        {"budget", "77"},    {"aa", "4"},         {"camera-from", NULL},     {"fit", "points"},
        {"look", "10,-5"},   {"center", "1,2,3"}, {"zoom", "2.5"},           {"color-points", "leaf"},
        {"shade", "edl"},    {"no-closeup", ""},
    };
    const temp_folder *folder = *state;
    char unchanged[2048], written[2048], again[2048];
    const view usual = view_make_default();
    write_text(&usual, unchanged);
    for (size_t i = 0; view_option_at(i); i++) {
        const char *name = view_option_at(i)->name;
        view v = usual, read;
        uint64_t every;
        octreel_error error = {""};
        size_t n = 0;
        while (n < sizeof samples / sizeof samples[0] && strcmp(samples[n][0], name) != 0)
            n++;
        if (n == sizeof samples / sizeof samples[0])
            fail_msg("no sample of --%s", name);
        if (!samples[n][1])
            continue;
        assert_true(view_option_at(i)->parse(view_option_at(i), samples[n][1], &v, &error));
        write_text(&v, written);
        assert_string_not_equal(written, unchanged);
        assert_true(write_recording_file(&(folder_place){.folder = folder->name}, &v, 1, &error));
        if (!recording_read(folder->name, &read, &every, &error))
            fail_msg("--%s: %s", name, error.text);
        write_text(&read, again);
        assert_string_equal(again, written);
    }
}

static void missing_option_has_its_default(void **state)
{
    const temp_folder *folder = *state;
    view read;
    uint64_t every;
    octreel_error error = {""};
    view expected = view_make_default();
    expected.width = 160;
    expected.height = 90;
    expected.camera = CAMERA_TOP;
    expected.layers = 1u << LAYER_NODES;
    file_write_text(place_in(folder, "recording.json").path, VIEW "}\n");
    assert_true(recording_read(folder->name, &read, &every, &error));
    assert_same_view(&expected, &read);
}

static void invalid_view_is_refused_with_line_and_reason(void **state)
{
    static const char *const rows[][2] = {
        {"", "recording.json:1: "},
        {"[]", "recording.json:1: "},
        {"{}", "the member \"octreel\" is missing"},
        {"{\"octreel\": \"session\", \"version\": 2}", "octreel: expected \"recording\", found \"session\""},
        {VIEW, "recording.json:3: "},
        {VIEW "} x", "recording.json:3: "},
        {VIEW ",\n\"tilt\": 3}", "recording.json:4: unknown member \"tilt\""},
        {VIEW ", \"version\": 4}", "duplicate"},
        {"{\"octreel\": \"recording\", \"version\": 5}", "version: recording version 5 is newer than version 4, the "
                                                         "newest that this Octreel reads; use a newer Octreel"},
        {"{\"octreel\": \"recording\", \"version\": 5, \"tilt\": 3}", "recording version 5 is newer than version 4"},
        {"{\"octreel\": \"recording\", \"version\": 0}", "version: expected a whole number from 1"},
        {"{\"octreel\": \"recording\", \"version\": 3, \"width\": 160}",
         "version: recording version 3 is not supported; record it again with this Octreel"},
        {"{\"octreel\": \"recording\", \"version\": 4, \"size\": [0, 90]}",
         "size[0]: expected a whole number from 1 to 16384, found 0"},
        {"{\"octreel\": \"recording\", \"version\": 4, \"size\": 160}",
         "size: expected a width and a height in pixels"},
        {START "\"camera\": null}", "recording.json:3: camera: expected one of iso, "},
        {START "\"camera\": \"up\"}",
         "recording.json:3: camera: expected one of iso, top, front, side, follow, orbit, found \"up\""},
        {START "\"camera\": \"iso\", \"layers\": [\"nodes\", \"walls\"]}", "layers[1]: expected the name of a layer"},
        {START "\"camera\": \"iso\", \"layers\": 7}", "layers: expected a list of layers, found 7"},
        {VIEW ", \"color_by\": null}", "color_by: expected one of depth, occupancy, plain, kind, found null"},
        {VIEW ", \"diagram\": \"above\"}", "diagram: expected one of none, beside, only, found \"above\""},
        {VIEW ", \"look\": 7}", "look: expected an azimuth and an elevation in degrees as in [30, 22], found 7"},
        {VIEW ", \"look\": [10, true]}", "look[1]: expected a number, found true"},
        {VIEW ", \"look\": [361, 0]}", "look: must be an azimuth from -360 to 360"},
        {VIEW ", \"look\": [10]}", "look: expected an azimuth and an elevation"},
        {VIEW ", \"look\": [10, 91]}", "look: must be an azimuth from -360 to 360 and an elevation from -90 to 90"},
        {VIEW ", \"center\": [1, 2]}", "center: expected three numbers"},
        {VIEW ", \"zoom\": 0}", "zoom: expected a number"},
        {VIEW ", \"slice\": {}}", "slice: expected an axis"},
        {VIEW ", \"slice\": {\"w\": 1}}", "slice: expected an axis"},
        {VIEW ", \"slice\": {\"x\": 1, \"y\": 1}}", "slice: expected an axis"},
        {VIEW ", \"slice\": {\"x\": true}}", "slice.x: expected a number, found true"},
        {VIEW ", \"depths\": 1}", "depths: expected two depths as in [2, 5], found 1"},
        {VIEW ", \"depths\": [1]}", "depths: expected two depths"},
        {VIEW ", \"depths\": [3, 2]}", "depths: the first depth must not be greater than the second"},
        {VIEW ", \"depths\": [0, 22]}", "depths[1]"},
        {VIEW ", \"leaves\": 1}", "leaves: expected true or false, found 1"},
        {VIEW ", \"region\": {\"min\": [0, 0, 0]}}", "region: the member \"max\" is missing"},
        {VIEW ", \"region\": {\"min\": [0, 2, 0], \"max\": [1, 1, 1]}}", "region: min is above max on axis y"},
        {VIEW ", \"fit\": \"box\"}", "fit: expected one of world, points, found \"box\""},
        {VIEW ", \"derived\": 5}", "derived: expected an object, found 5"},
        {VIEW ", \"derived\": {\"point_scale\": 5}}", "derived.point_scale: expected eleven numbers"},
        {VIEW ", \"derived\": {\"point_scale\": [1, 2]}}", "derived.point_scale: expected eleven numbers"},
        {VIEW ", \"derived\": {\"point_scale\": [0, 0, 0, 1, 1, 1, 0, 1, 0, 1, null]}}",
         "derived.point_scale[10]: expected a number, found null"},
        {VIEW ", \"derived\": {\"point_scale\": [0, 2, 0, 1, 1, 1, 0, 1, 0, 1, 0]}}",
         "derived.point_scale: the lowest corner is above the highest"},
        {VIEW ", \"derived\": {\"point_scale\": [0, 0, 0, 1, 1, 1, 0, 1, 0, 1, -1]}}",
         "derived.point_scale: the spacing is below 0"},
        {VIEW ", \"derived\": {\"focus\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}}}",
         "derived.focus: needs \"fit\": \"points\""},
        {VIEW ", \"fit\": \"points\", \"derived\": {\"focus\": {\"min\": [0, 0, 0], \"max\": [0, 0, 0]}}}",
         "derived.focus: the box has no extent"},
        {VIEW ", \"derived\": {\"focus\": {\"min\": [0, 0, 0], \"max\": [1e999, 0, 0]}}}", "recording.json:"},
        {VIEW ", \"lod\": -1}", "lod: expected a number from 0 to 16384, found -1"},
        {VIEW ", \"aa\": \"2\"}", "aa: expected a whole number from 1 to 4, found \"2\""},
        {VIEW ", \"aa\": 3}", "aa: expected 1, 2 or 4, found 3"},
        {VIEW ", \"budget\": 0.5}", "budget: expected a whole number"},
        {VIEW ", \"theme\": \"day\"}", "theme: expected \"night\""},
    };
    const temp_folder *folder = *state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        view read;
        uint64_t every;
        octreel_error error = {""};
        file_write_text(place_in(folder, "recording.json").path, rows[i][0]);
        assert_false(recording_read(folder->name, &read, &every, &error));
        if (!strstr(error.text, rows[i][1]))
            fail_msg("\"%s\" and not \"%s\"", error.text, rows[i][1]);
    }
}

static void folder_without_recording_json_is_refused(void **state)
{
    const temp_folder *folder = *state;
    view read;
    uint64_t every;
    octreel_error error;
    assert_false(recording_read(folder->name, &read, &every, &error));
    assert_non_null(strstr(error.text, "recording.json: cannot be opened"));
    assert_false(recording_read(place_in(folder, "absent").path, &read, &every, &error));
    assert_int_equal(mkdir(place_in(folder, "recording.json").path, 0777), 0);
    assert_false(recording_read(folder->name, &read, &every, &error));
}

static void film(const char *format, const char *view, const char *folder)
{
    command_result result = run_octreel(NULL, format, view, folder);
    assert_done(&result);
    command_release(&result);
}

static void assert_same_view_files(const char *a, const char *b)
{
    char *first = file_read(place_below(a, "recording.json").path, NULL);
    char *second = file_read(place_below(b, "recording.json").path, NULL);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

/* The second recording has other keys, so that its own camera would be different. */
static void camera_from_copies_the_view_of_another_recording(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b"), c = place_in(*state, "c"),
                d = place_in(*state, "d");
    film("record --keys ww %s -o %s",
         "--size 200x100 --camera side --look 20,5 --center 1,2,3 --zoom 1.5 --fit points --slice x=0 --depths 1:3 "
         "--leaves --color-by plain --layers -text "
         "--diagram beside "
         "--region -900,-900,-900,500,500,500",
         a.path);
    char from[1100];
    snprintf(from, sizeof from, "--camera-from %s", a.path);
    film("record --keys dd %s -o %s", from, b.path);
    assert_same_view_files(a.path, b.path);
    snprintf(from, sizeof from, "--camera top --camera-from %s", a.path);
    film("record --keys dd %s -o %s", from, c.path);
    snprintf(from, sizeof from, "--camera-from %s --camera top", a.path);
    film("record --keys dd %s -o %s", from, d.path);
    assert_same_view_files(c.path, d.path);
    view changed;
    uint64_t every;
    octreel_error error;
    assert_true(recording_read(c.path, &changed, &every, &error));
    assert_true(changed.camera == CAMERA_TOP && changed.width == 200 && changed.fit == FIT_BOX);
}

static void camera_from_a_missing_recording_is_refused(void **state)
{
    const place absent = place_in(*state, "absent"), film = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record --camera-from %s -o %s", absent.path, film.path);
    assert_trouble(&result, "absent: no such file or folder");
    result = run_octreel(NULL, "record --fit everything -o %s", film.path);
    assert_trouble(&result, "unknown fit \"everything\"; choose from world, points");
    assert_false(file_exists(film.path));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(view_survives_the_round_trip_to_the_bit),
        IN_FOLDER(missing_option_has_its_default),
        IN_FOLDER(every_view_option_is_written),
        IN_FOLDER(invalid_view_is_refused_with_line_and_reason),
        IN_FOLDER(folder_without_recording_json_is_refused),
        IN_FOLDER(camera_from_copies_the_view_of_another_recording),
        IN_FOLDER(camera_from_a_missing_recording_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
