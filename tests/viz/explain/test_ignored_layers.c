/* SPDX-License-Identifier: MIT */
/* test_ignored_layers.c - --ignore-layer excludes the pixels of a layer wherever it is in the frames of a recording. */
#include <stdio.h>
#include <string.h>

#include "fixture.h"
#include "galleries.h"
#include "ignored_layers.h"
#include "images.h"
#include "recordings.h"

/* A layer is left out, and nothing else is forgiven. */
static diff_options leave_out(view_layer layer)
{
    diff_options options = diff_options_default();
    options.mask = ignore_layers;
    options.ignored_layers = 1u << layer;
    return options;
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

static void set_red(const char *path, int x, int y)
{
    image frame = assert_read_rgb(path);
    memcpy(frame.pixels + 3 * (y * frame.width + x), "\xff\0\0", 3);
    assert_written(&frame, path);
    image_release(&frame);
}

static void text_of_both_recordings_is_ignored_at_its_pixels(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    octree_session session = octree_session_default();
    film_options film = small_film(a.path);
    diff_options options = diff_options_default();
    session.keys = "wd";
    film.view.width = 480;
    film.view.height = 270;
    assert_filmed(&session, &film);
    film.folder = b.path;
    assert_filmed(&session, &film);
    set_red(place_below(b.path, "frame_000001.png").path, 70, 10);  /* in the panel */
    set_red(place_below(b.path, "frame_000002.png").path, 470, 10); /* in no letter */
    comparison_of made = assert_compared(a.path, b.path, &options);
    assert_int_equal(made.result.found[FOUND_PIXELS], 2);
    comparison_release(&made);
    options = leave_out(LAYER_TEXT);
    made = assert_compared(a.path, b.path, &options);
    assert_int_equal(find_finding(&made, "frame_000000.png"), FOUND_SAME_BYTES);
    assert_int_equal(find_finding(&made, "frame_000001.png"), FOUND_WITHIN);
    assert_int_equal(diff_find(&made.result, "frame_000001.png")->difference.ignored, 1);
    assert_int_equal(find_finding(&made, "frame_000002.png"), FOUND_PIXELS);
    comparison_release(&made);
    for (int i = 0; i < 2; i++) { /* a tick that the session does not have */
        const char *folder = i ? b.path : a.path;
        assert_int_equal(
            rename(place_below(folder, "frame_000002.png").path, place_below(folder, "frame_000009.png").path), 0);
    }
    assert_not_compared(a.path, b.path, &options, "no tick 9: the last tick of the session is 2");
}

/* One side is enough, and a folder of plain pictures may be the other. */
static void text_is_located_by_the_side_that_is_a_recording(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    octree_session session = octree_session_default();
    film_options film = small_film(a.path);
    const diff_options options = leave_out(LAYER_TEXT);
    session.keys = "";
    assert_filmed(&session, &film);
    film.folder = b.path;
    assert_filmed(&session, &film);
    remove(place_below(b.path, "recording.json").path);
    set_red(place_below(b.path, "frame_000000.png").path, 5, 6); /* in "tick 0" */
    comparison_of made = assert_compared(a.path, b.path, &options);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
    remove(place_below(a.path, "session.json").path);
    assert_not_compared(a.path, b.path, &options, "session.json");
}

/* ---- Any layer ---------------------------------------------------------------------------------------------- */

static place film_layers(const temp_folder *own, const char *name, const octree_session *session, unsigned layers,
                         int aa)
{
    const place folder = place_in(own, name);
    film_options film = small_film(folder.path);
    film.view.layers = layers;
    film.view.aa = aa;
    assert_filmed(session, &film);
    return folder;
}

/* Of frames that differ in one layer: they are the same but for that, and differ where another one is left out. */
static void assert_left_out(const place *a, const place *b, view_layer layer, view_layer other)
{
    diff_options options = leave_out(layer);
    comparison_of made = assert_compared(a->path, b->path, &options);
    assert_int_equal(made.result.found[FOUND_WITHIN], 1);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    assert_true(made.result.pairs[0].difference.ignored > 0);
    comparison_release(&made);
    options = leave_out(other);
    made = assert_compared(a->path, b->path, &options);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    comparison_release(&made);
}

static void nodes_and_points_are_ignored_under_anti_aliasing(void **state)
{
    const unsigned layers = 1u << LAYER_WORLD | 1u << LAYER_NODES | 1u << LAYER_POINTS;
    octree_session session;
    octree_game_body bodies[32];
    char names[3][8];
    for (int aa = 1; aa <= 2; aa++) {
        for (int i = 0; i < 3; i++)
            snprintf(names[i], sizeof names[i], "%c%d", 'a' + i, aa);
        session = short_session("");
        session.tree.full_leaf = OCTREE_GROW; /* all points, whatever the capacity */
        const place a = film_layers(*state, names[0], &session, layers, aa);
        session.tree.leaf_capacity = 3;
        const place nodes = film_layers(*state, names[1], &session, layers, aa);
        session.tree.leaf_capacity = 2;
        assert_true(session.body_count <= 32);
        memcpy(bodies, session.bodies, session.body_count * sizeof *bodies);
        bodies[0].position[0] -= 25; /* in the same leaf */
        session.bodies = bodies;
        const place points = film_layers(*state, names[2], &session, layers, aa);
        assert_left_out(&a, &nodes, LAYER_NODES, LAYER_POINTS);
        assert_left_out(&a, &points, LAYER_POINTS, LAYER_NODES);
    }
}

static void labels_in_the_world_are_ignored_under_anti_aliasing(void **state)
{
    octree_shape shape = {
        .tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_LABEL, .at = {-500, 500, 0}, .text = "a goal"};
    octree_session session = short_session("");
    session.shapes = &shape;
    session.shape_count = 1;
    for (int aa = 1; aa <= 4; aa *= 2) {
        const char names[2][4] = {{'a', (char)('0' + aa)}, {'b', (char)('0' + aa)}};
        shape.text[0] = 'a';
        const place a = film_layers(*state, names[0], &session, VIEW_ALL_LAYERS, aa);
        shape.text[0] = 'A';
        const place b = film_layers(*state, names[1], &session, VIEW_ALL_LAYERS, aa);
        assert_left_out(&a, &b, LAYER_TEXT, LAYER_NODES);
    }
}

static void several_layers_are_ignored_together(void **state)
{
    const unsigned layers = 1u << LAYER_WORLD | 1u << LAYER_NODES | 1u << LAYER_POINTS;
    const unsigned both = 1u << LAYER_NODES | 1u << LAYER_POINTS;
    octree_session session = short_session("");
    const place a = film_layers(*state, "a", &session, layers, 1);
    session.tree.leaf_capacity = 1;
    session.body_count--;
    const place b = film_layers(*state, "b", &session, layers, 1);
    diff_options options = leave_out(LAYER_NODES);
    comparison_of made = assert_compared(a.path, b.path, &options);
    assert_int_equal(made.result.verdict, DIFF_DIFFERENT);
    comparison_release(&made);
    options.ignored_layers = both;
    made = assert_compared(a.path, b.path, &options);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(text_of_both_recordings_is_ignored_at_its_pixels),
        WITH_FOLDER(text_is_located_by_the_side_that_is_a_recording),
        WITH_FOLDER(nodes_and_points_are_ignored_under_anti_aliasing),
        WITH_FOLDER(labels_in_the_world_are_ignored_under_anti_aliasing),
        WITH_FOLDER(several_layers_are_ignored_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
