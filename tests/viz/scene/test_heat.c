/* SPDX-License-Identifier: MIT */
/* test_heat.c - the heat of nodes equals the sums over the ticks since tick 0, is drawn on a fixed scale, and does not
 * depend on which ticks are filmed. */
#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw_list.h"
#include "files.h"
#include "heat_layers.h"
#include "random_session.h"
#include "recordings.h"
#include "recount.h"
#include "playback.h"
#include "tick_lines.h"

/* An unsorted list of counts by address. */
typedef struct count {
    octree_address node;
    uint64_t visits, points;
} count;

typedef struct counts {
    count items[8192];
    size_t size;
} counts;

static count *count_of(counts *all, octree_address node)
{
    size_t i = 0;
    while (i < all->size && all->items[i].node != node)
        i++;
    assert_true(i < sizeof all->items / sizeof all->items[0]);
    if (i == all->size)
        all->items[all->size++] = (count){.node = node};
    return &all->items[i];
}

/* The visit of a node in a tick: its own, or that of an ancestor that was taken whole. */
static bool was_visited(const recount *met, octree_address node)
{
    for (octree_address at = node; at; at >>= 3)
        for (size_t i = 0; i < met->count; i++)
            if (met->visits[i].node == at &&
                (met->visits[i].taken || (at == node && met->visits[i].touch == OCTREE_TRACE_VISITED)))
                return true;
    return false;
}

typedef struct tick_walk {
    counts *all;
    const recount *met;
} tick_walk;

static octree_walk_order add_node(const octree_node *node, void *context)
{
    const tick_walk *w = context;
    count *c = count_of(w->all, node->address);
    c->points += node->count;
    c->visits += was_visited(w->met, node->address);
    return OCTREE_WALK_ON;
}

static octree_walk_order check_node(const octree_node *node, void *context)
{
    const heat *h = ((void **)context)[0];
    const count *expected = count_of(((void **)context)[1], node->address);
    const heat_cell seen = heat_get_cell(h, node->address);
    assert_int_equal(seen.points, expected->points);
    assert_int_equal(seen.visits, expected->visits);
    return OCTREE_WALK_ON;
}

/* A session, with visits that the test recounts at every tick. */
static void check_session(const octree_session *session)
{
    static counts all;
    octree_game *game = start_game(session);
    recount met = {0};
    heat h = {0};
    double before[3];
    all.size = 0;
    memcpy(before, session->player.position, sizeof before);
    for (;; play_tick(game)) {
        const octree *tree = octree_game_tree(game);
        recount_tick(&met, game, before);
        octree_walk(tree, add_node, &(tick_walk){&all, &met});
        assert_true(heat_add_tick(&h, game));
        octree_walk(tree, check_node, (void *[]){&h, &all});
        assert_int_equal(h.places.count, all.size);
        memcpy(before, octree_game_tick(game)->player, sizeof before);
        if (octree_game_over(game))
            break;
    }
    for (size_t i = 0; i < all.size; i++) /* counts of deleted nodes are kept */
        assert_int_equal(heat_get_cell(&h, all.items[i].node).points, all.items[i].points);
    assert_int_equal(heat_get_cell(&h, UINT64_MAX).points, 0);
    heat_release(&h);
    recount_free(&met);
    octree_game_destroy(game);
}

static void heat_is_the_sum_over_the_ticks(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    check_session(&session);
    for (uint64_t seed = 1; seed <= 10; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session);
    }
}

/* One query takes an octant whole, and another one searches neighbours in it. The tick counts as one visit of a node,
 * also of nodes that the second query prunes. */
static void a_tick_counts_once_for_any_number_of_queries(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {
        {.id = 1, .position = {-6, -6, -6}}, {.id = 2, .position = {-2, -2, -2}}, {.id = 3, .position = {6, 6, 6}}};
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-9, -9, -9}, {1, 1, 1}}},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-7, -7, -7}, {-5, -5, -5}}},
    };
    octree_session session = small_session(bodies, 3);
    session.tree = define(cube(-8, 8), 1, OCTREE_MAX_DEPTH, OCTREE_REFUSE);
    session.player = (octree_player){.id = 100, .position = {-6, 6, 6}, .step = 1, .box_size = 0.5};
    session.queries = queries;
    session.query_count = 2;
    session.ticks = 5;
    octree_game *game = start_game(&session);
    heat h = {0};
    for (uint64_t tick = 0; tick < 5; tick++) {
        assert_true(heat_add_tick(&h, game));
        static const octree_address met[] = {OCTREE_ROOT, 010, 0100, 0107};
        for (size_t i = 0; i < 4; i++)
            assert_int_equal(heat_get_cell(&h, met[i]).visits, tick + 1);
        assert_int_equal(heat_get_cell(&h, 0107).points, tick + 1);
        play_tick(game);
    }
    heat_release(&h);
    octree_game_destroy(game);
}

static void the_scale_has_powers_of_two_without_limit(void **state)
{
    (void)state;
    for (unsigned shift = 1; shift <= 2; shift++) {
        unsigned step = 0;
        for (uint64_t amount = 1; amount < 1 << 20; amount++) {
            if (step + 1 < HEAT_STEPS && amount == UINT64_C(1) << shift * (step + 1))
                step++;
            assert_int_equal(heat_step(amount, shift), step);
        }
        assert_int_equal(step, HEAT_STEPS - 1);
        assert_int_equal(heat_step(UINT64_MAX, shift), HEAT_STEPS - 1);
    }
}

/* The context of the walk that compares leaves with markers. */
typedef struct mark_check {
    const scene *scene;
    const heat *heat;
    size_t marks[2];
} mark_check;

static bool has_mark(const scene *s, view_layer layer, scene_shape shape, const octree_node *leaf, unsigned step)
{
    double middle[3];
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = leaf->box.min[axis] / 2 + leaf->box.max[axis] / 2;
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *mark = &s->markers.items[i];
        if (mark->style.layer != layer || mark->id != leaf->address)
            continue;
        const double room = camera_box_size_in_pixels(&s->camera, &leaf->box);
        assert_true(same_position(mark->at, middle) && mark->shape == shape);
        assert_int_equal(mark->style.role, theme_node_role(step));
        assert_true(mark->style.width == step + 1 ||
                    (mark->style.width < step + 1 && (mark->style.width + 1) * 2 * s->unit > room));
        return true;
    }
    return false;
}

static octree_walk_order check_leaf(const octree_node *node, void *context)
{
    mark_check *c = context;
    const heat_cell seen = heat_get_cell(c->heat, node->address);
    if (!node->leaf)
        return OCTREE_WALK_ON;
    assert_int_equal(has_mark(c->scene, LAYER_VISIT_HEAT, SHAPE_SQUARE, node, heat_step(seen.visits, 1)),
                     seen.visits > 0);
    assert_int_equal(has_mark(c->scene, LAYER_POINT_HEAT, SHAPE_DIAMOND, node, heat_step(seen.points, 2)),
                     seen.points > 0);
    c->marks[0] += seen.visits > 0;
    c->marks[1] += seen.points > 0;
    return OCTREE_WALK_ON;
}

static void check_marks(const scene *s, const octree_game *game, const heat *h)
{
    mark_check c = {.scene = s, .heat = h};
    octree_walk(octree_game_tree(game), check_leaf, &c);
    for (unsigned i = 0; i < 2; i++) {
        const layer_counts found = count_layer(s, LAYER_VISIT_HEAT + i);
        assert_int_equal(found.markers, c.marks[i]);
        assert_int_equal(found.boxes + found.segments + found.labels + found.panels, 0);
    }
}

static void every_leaf_with_heat_has_a_marker(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 8; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        const octree_session session = seed ? made.session : octree_session_default();
        const view v = view_of(640, 360, (view_camera)(seed % CAMERA_COUNT), VIEW_ALL_LAYERS);
        octree_game *game = start_game(&session);
        scene s = {0};
        heat h = {0};
        build_tick(&s, &v, game);
        assert_int_equal(count_layer(&s, LAYER_VISIT_HEAT).markers + count_layer(&s, LAYER_POINT_HEAT).markers, 0);
        for (;; play_tick(game)) {
            assert_true(heat_add_tick(&h, game));
            build_hot_tick(&s, &v, game, &h);
            check_marks(&s, game, &h);
            if (octree_game_over(game))
                break;
        }
        heat_release(&h);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void keep_scene(const char *line, size_t number, void *context)
{
    char(*scenes)[17] = context;
    json_t *tick = json_read(line);
    const json_t *scene = json_object_get(tick, "scene");
    snprintf(scenes[number], 17, "%s", scene ? json_string_value(scene) : "");
    json_decref(tick);
}

static void a_frame_has_the_heat_of_unfilmed_ticks_as_well(void **state)
{
    enum { TICKS = 253, EVERY = 21 };
    static char all[TICKS][17], some[TICKS][17];
    const place first = place_in(*state, "all"), second = place_in(*state, "some");
    const octree_session session = octree_session_default();
    film_options options = small_film(first.path);
    options.view.layers = VIEW_HEAT_LAYERS;
    assert_filmed(&session, &options);
    options = small_film(second.path);
    options.view.layers = VIEW_HEAT_LAYERS;
    options.every = EVERY;
    assert_filmed(&session, &options);
    assert_int_equal(for_each_line(first.path, keep_scene, all), TICKS);
    assert_int_equal(for_each_line(second.path, keep_scene, some), TICKS);
    for (size_t tick = 0; tick < TICKS; tick += EVERY) {
        assert_int_equal(strlen(some[tick]), 16);
        assert_string_equal(all[tick], some[tick]);
        assert_true(tick == 0 || strcmp(all[tick], all[tick - EVERY]) != 0);
    }
}

static bool keep_digest(void *context, const film_step *step, octreel_error *error)
{
    (void)error;
    json_t *line = json_read(step->line);
    snprintf(context, 17, "%s", json_string_value(json_member(line, "scene")));
    json_decref(line);
    return true;
}

/* Filming a chunk plays the ticks before it as well. */
static void a_chunk_begins_with_the_heat_of_earlier_ticks(void **state)
{
    const octree_session session = octree_session_default();
    film_options options = small_film(place_in(*state, "film").path);
    options.view.layers = VIEW_HEAT_LAYERS;
    char whole[17], part[17];
    for (int parted = 0; parted < 2; parted++) {
        const film_share share = {.first = parted ? 200 : 0, .last = 201};
        octreel_error error;
        playback p;
        assert_true(playback_open(&p, &session, NULL, &options.view, &error));
        assert_true(playback_open_picture(&p, &(playback_target){.frames = FRAMES_SHOW, .every = 1}, &error));
        assert_true(playback_run(&p, &share, keep_digest, parted ? part : whole, NULL, &error));
        playback_close(&p);
    }
    assert_string_equal(whole, part);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heat_is_the_sum_over_the_ticks),
        cmocka_unit_test(a_tick_counts_once_for_any_number_of_queries),
        cmocka_unit_test(the_scale_has_powers_of_two_without_limit),
        cmocka_unit_test(every_leaf_with_heat_has_a_marker),
        cmocka_unit_test_setup_teardown(a_chunk_begins_with_the_heat_of_earlier_ticks, temp_folder_make,
                                        nested_folder_remove),
        cmocka_unit_test_setup_teardown(a_frame_has_the_heat_of_unfilmed_ticks_as_well, temp_folder_make,
                                        nested_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
