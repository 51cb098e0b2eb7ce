/* SPDX-License-Identifier: MIT */
/* test_diff_trace.c - the pixels in which two frames differ are traced to the elements that differ. */
#include <stdlib.h>
#include <string.h>

#include "explain.h"
#include "explained.h"
#include "fixture.h"
#include "frame_file.h"
#include "galleries.h"
#include "layer.h"
#include "recordings.h"

/* A film of these layers alone. */
static place film_layers(const temp_folder *own, const char *name, const octree_session *session, unsigned layers,
                         int aa)
{
    const place folder = place_in(own, name);
    film_options options = small_film(folder.path);
    options.view.layers = layers;
    options.view.aa = aa;
    options.view.lod = 0;
    assert_filmed(session, &options);
    return folder;
}

static comparison_of assert_traced(const place *a, const place *b, const diff_options *options)
{
    comparison_of made = assert_compared(a->path, b->path, options);
    octreel_error error = {""};
    if (!explain(&made.a, &made.b, &made.result, 10, &made.why, &error))
        fail_msg("%s", error.text);
    assert_true(made.why.recordings);
    assert_string_equal(made.why.tracer.untraced, "");
    return made;
}

static const trace *trace_of(const comparison_of *made, uint64_t tick)
{
    const cause_tick *told = cause_find_tick(&made->why.cause, tick);
    assert_non_null(told);
    assert_true(told->trace.made);
    return &told->trace;
}

/* The parts are all of the pixels that the comparison counts, the largest first and none twice. */
static void assert_adds_up(const comparison_of *made)
{
    for (size_t i = 0; i < made->result.count; i++) {
        const diff_pair *pair = &made->result.pairs[i];
        if (!explain_has_difference(pair))
            continue;
        const trace *t = trace_of(made, i);
        uint64_t sum = 0;
        for (size_t j = 0; j < t->count; j++) {
            sum += t->parts[j].pixels;
            assert_true(t->parts[j].pixels > 0);
            assert_true(j == 0 || t->parts[j].pixels <= t->parts[j - 1].pixels);
            for (size_t k = 0; k < j; k++)
                assert_false(t->parts[k].layer == t->parts[j].layer && t->parts[k].id == t->parts[j].id);
        }
        assert_int_equal(sum, pair->difference.unlike.pixels);
        assert_int_equal(t->pixels, sum);
    }
}

static void assert_part(const trace_part *part, int layer, uint64_t id)
{
    if (part->layer != layer || part->id != id)
        fail_msg("layer %d, id %llu", part->layer, (unsigned long long)part->id);
}

/* ---- What moves, splits, is written -------------------------------------------------------------------------- */

static octree_session moved_session(octree_edit *edit)
{
    octree_session session = short_session("wd");
    *edit = (octree_edit){1, OCTREE_EDIT_MOVE, {.id = 3, .position = {300, -700, 300}}};
    session.edits = edit;
    session.edit_count = 1;
    return session;
}

static void moved_point_has_all_pixels_of_its_layer(void **state)
{
    const octree_session session = short_session("wd");
    octree_edit edit;
    const octree_session other = moved_session(&edit);
    for (int aa = 1; aa <= 4; aa *= 2) {
        const char *names[2] = {aa == 1 ? "a1" : aa == 2 ? "a2" : "a4", aa == 1 ? "b1" : aa == 2 ? "b2" : "b4"};
        const place a = film_layers(*state, names[0], &session, 1u << LAYER_POINTS, aa);
        const place b = film_layers(*state, names[1], &other, 1u << LAYER_POINTS, aa);
        comparison_of made = assert_traced(&a, &b, NULL);
        assert_adds_up(&made);
        assert_null(cause_find_tick(&made.why.cause, 0));
        for (uint64_t tick = 1; tick < 3; tick++) {
            assert_int_equal(trace_of(&made, tick)->count, 1);
            assert_part(&trace_of(&made, tick)->parts[0], LAYER_POINTS, 3);
        }
        assert_non_null(strstr(find_cause_text(&made, "frame_000001.png"), " of point 3"));
        comparison_release(&made);
    }
}

/* One point more in a leaf that is full: its children are drawn, and belong to the node that split. */
static void pixels_of_a_split_belong_to_the_node_that_split(void **state)
{
    octree_session session = short_session("wd");
    const octree_edit edits[] = {{1, OCTREE_EDIT_INSERT, {.id = 50, .position = {-400, -300, -900}}},
                                 {1, OCTREE_EDIT_INSERT, {.id = 51, .position = {-900, -300, -100}}},
                                 {1, OCTREE_EDIT_INSERT, {.id = 52, .position = {-900, -800, -900}}}};
    session.edits = edits;
    session.edit_count = 2;
    const place a = film_layers(*state, "a", &session, 1u << LAYER_NODES, 1);
    session.edit_count = 3;
    const place b = film_layers(*state, "b", &session, 1u << LAYER_NODES, 1);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_adds_up(&made);
    const cause_tick *told = cause_find_tick(&made.why.cause, 1);
    const cause_group *split = cause_find_group(&told->facts, "nodes.split", CAUSE_MORE);
    octree_address node;
    assert_non_null(split);
    assert_int_equal(split->found, 1);
    assert_true(octree_address_parse(json_string_value(split->listed[0].b), &node));
    assert_int_equal(trace_of(&made, 1)->count, 1);
    assert_part(&trace_of(&made, 1)->parts[0], LAYER_NODES, node);
    comparison_release(&made);
}

static void pixels_of_all_layers_add_up(void **state)
{
    octree_session session = short_session("wdnwd.");
    const place a = film_layers(*state, "a", &session, VIEW_ALL_LAYERS, 2);
    session.tree.leaf_capacity = 4;
    session.player.step = 75;
    const place b = film_layers(*state, "b", &session, VIEW_ALL_LAYERS, 2);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_true(made.result.found[FOUND_PIXELS] > 4);
    assert_adds_up(&made);
    comparison_release(&made);
}

static void ignored_pixels_are_not_traced(void **state)
{
    octree_session session = short_session("wd");
    const place a = film_layers(*state, "a", &session, VIEW_DEFAULT_LAYERS, 1);
    session.player.step = 300;
    const place b = film_layers(*state, "b", &session, VIEW_DEFAULT_LAYERS, 1);
    const image_rectangle left = {0, 0, SMALL_WIDTH / 2, SMALL_HEIGHT};
    diff_options options = diff_options_default();
    options.tolerance.ignored = &left;
    options.tolerance.ignored_count = 1;
    comparison_of made = assert_traced(&a, &b, &options);
    assert_adds_up(&made);
    const uint64_t half = trace_of(&made, 1)->pixels;
    comparison_release(&made);
    made = assert_traced(&a, &b, NULL);
    assert_true(half > 0 && half < trace_of(&made, 1)->pixels);
    comparison_release(&made);
}

/* ---- In words ------------------------------------------------------------------------------------------------ */

static void every_layer_has_a_description(void **state)
{
    (void)state;
    for (int layer = 0; layer <= TRACE_BACKGROUND; layer++) {
        const trace_part part = {.layer = layer, .id = 1};
        char room[TRACE_TEXT];
        const char *text = trace_part_text(&part, room);
        assert_true(text && *text);
    }
}

/* A part of this layer in a frame that differs, and the words for it in its cause. */
static void assert_told(const comparison_of *made, uint64_t tick, int layer, const char *words)
{
    char name[FRAME_NAME];
    const char *cause = find_cause_text(made, frame_print_name(tick, name));
    const trace *t = trace_of(made, tick);
    bool found = false;
    for (size_t i = 0; i < t->count; i++)
        found = found || t->parts[i].layer == layer;
    assert_true(found);
    if (!strstr(cause, words))
        fail_msg("%s", cause);
}

/* Two sessions of one point that moves. */
static void different_velocities_are_reported(void **state)
{
    const octree_game_body bodies[2] = {{.id = 1, .position = {100, 100, 100}, .velocity = {1, 0, 0}},
                                        {.id = 1, .position = {100, 100, 100}, .velocity = {0, 1, 0}}};
    octree_session session = short_session("wd");
    session.body_count = 1;
    session.bodies = &bodies[0];
    const place a = film_layers(*state, "a", &session, VIEW_ALL_LAYERS, 1);
    session.bodies = &bodies[1];
    const place b = film_layers(*state, "b", &session, VIEW_ALL_LAYERS, 1);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_adds_up(&made);
    assert_told(&made, 0, LAYER_VELOCITIES, " of velocities");
    comparison_release(&made);
}

static void different_shapes_are_reported(void **state)
{
    octree_shape shape = {
        .tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_LABEL, .at = {-500, 500, 0}, .text = "a goal"};
    octree_session session = short_session("wd");
    session.shapes = &shape;
    session.shape_count = 1;
    const place a = film_layers(*state, "a", &session, VIEW_ALL_LAYERS, 1);
    shape.text[0] = 'A';
    const place b = film_layers(*state, "b", &session, VIEW_ALL_LAYERS, 1);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_adds_up(&made);
    for (uint64_t tick = 0; tick < 3; tick++)
        assert_told(&made, tick, LAYER_SHAPES, " of shapes");
    comparison_release(&made);
}

/* A close-up at a tick that asks nothing is where an earlier tick has left it. */
static void elements_of_an_unmoved_close_up_are_traced(void **state)
{
    const octree_query query = {.tick = 1, .kind = OCTREE_QUERY_RADIUS, .target = {500, 500, 500}, .radius = 20};
    const octree_shape shape = {.tick = 3, .kind = OCTREE_SHAPE_POINT, .at = {500, 500, 500}};
    octree_session session = octree_session_default();
    session.player = (octree_player){.kind = OCTREE_PLAYER_NONE};
    session.keys = NULL;
    session.ticks = 3;
    session.queries = &query;
    session.query_count = 1;
    film_options options = small_film("");
    options.view.width = 640;
    options.view.height = 360;
    const place a = film_into(*state, "a", &session, &options);
    session.shapes = &shape;
    session.shape_count = 1;
    const place b = film_into(*state, "b", &session, &options);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_adds_up(&made);
    assert_true(trace_of(&made, 3)->pixels > 2 * 9); /* the mark is in the close-up, too */
    comparison_release(&made);
}

/* ---- What is not traced -------------------------------------------------------------------------------------- */

static void frames_of_different_sizes_are_not_traced(void **state)
{
    const octree_session session = short_session("wd");
    const place a = film_layers(*state, "a", &session, VIEW_DEFAULT_LAYERS, 1),
                b = film_layers(*state, "b", &session, VIEW_DEFAULT_LAYERS, 2);
    comparison_of made = assert_traced(&a, &b, NULL);
    assert_false(cause_find_tick(&made.why.cause, 1)->trace.made);
    comparison_release(&made);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(moved_point_has_all_pixels_of_its_layer),
        TEST(pixels_of_a_split_belong_to_the_node_that_split),
        TEST(pixels_of_all_layers_add_up),
        TEST(ignored_pixels_are_not_traced),
        TEST(every_layer_has_a_description),
        TEST(different_velocities_are_reported),
        TEST(different_shapes_are_reported),
        TEST(elements_of_an_unmoved_close_up_are_traced),
        TEST(frames_of_different_sizes_are_not_traced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
