/* SPDX-License-Identifier: MIT */
/* test_visit_layers.c - tests the layers and legend lines of visited, pruned and hit nodes against an independent
 * recount. */
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_list.h"
#include "filter.h"
#include "octree/sample.h"
#include "random_session.h"
#include "recount.h"
#include "tick_lines.h"
#include "ticks_write.h"

#define VISIT_LAYERS (1u << LAYER_VISITED | 1u << LAYER_PRUNED | 1u << LAYER_HIT)

/* The node at an address or, where a step has merged it away, its cell. */
static octree_node node_or_cell(const octree *tree, octree_address address)
{
    octree_node node;
    const octree_box world = octree_definition(tree).world;
    if (octree_node_at(tree, address, &node) != OCTREE_OK)
        node = (octree_node){.address = address,
                             .depth = octree_address_depth(address),
                             .leaf = true,
                             .box = octree_cell_box(&world, address)};
    return node;
}

/* Whether a visited node is below the lod and has a shown ancestor. */
static bool is_small(const scene *s, const octree_node *node)
{
    const view *v = &s->view;
    const unsigned first = v->filter.by_depth ? v->filter.min_depth : 0;
    const bool below_another = node->depth > first && !v->filter.leaves;
    return below_another && camera_box_size_in_pixels(&s->camera, &node->box) < v->lod;
}

/* The number of elements that a scene must have, and of those that are too small for it. */
typedef struct dues {
    size_t boxes[LAYER_COUNT], small;
} dues;

static void check_box(const scene *s, const octree *tree, octree_address address, scene_style style, dues *due)
{
    const octree_node node = node_or_cell(tree, address);
    const octree_box world = octree_definition(tree).world;
    if (!filter_shows_node(&s->view.filter, &world, &node))
        return;
    due->small += is_small(s, &node);
    if (is_small(s, &node))
        return;
    const scene_box *box = find_only_box(s, style.layer, address);
    assert_true(same_box(&box->box, &node.box));
    assert_int_equal(box->depth, node.depth);
    assert_int_equal(box->style.role, style.role ? style.role : theme_node_role(node.depth));
    assert_int_equal(box->style.stroke, style.stroke);
    assert_int_equal(box->style.width, style.width);
    due->boxes[style.layer]++;
}

static bool says(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* Each visited or pruned node is in its layer, each leaf with a found point is in the layer of hits, and nothing else
 * is. */
static void check_visits(const scene *s, const recount *met, const octree *tree)
{
    static const scene_style styles[OCTREE_TRACE_KINDS] = {
        [OCTREE_TRACE_VISITED] = {LAYER_VISITED, 0, STROKE_SOLID, 2},
        [OCTREE_TRACE_TAKEN] = {LAYER_VISITED, 0, STROKE_SOLID, 2},
        [OCTREE_TRACE_PRUNED] = {LAYER_PRUNED, 0, STROKE_CUT, 1},
    };
    static const scene_style hit = {LAYER_HIT, ROLE_HIT, STROKE_SOLID, 2};
    dues due = {{0}, 0};
    char text[SCENE_TEXT];
    for (size_t i = 0; i < met->count; i++)
        check_box(s, tree, met->visits[i].node, styles[met->visits[i].touch], &due);
    for (size_t i = 0; i < met->leaf_count; i++)
        check_box(s, tree, met->leaves[i], hit, &due);
    for (unsigned layer = 0; layer < LAYER_COUNT; layer++) {
        const layer_counts found = count_layer(s, layer);
        if (!(VISIT_LAYERS >> layer & 1))
            continue;
        assert_int_equal(found.boxes, due.boxes[layer]);
        assert_int_equal(found.segments + found.markers + found.labels + found.panels, 0);
    }
    snprintf(text, sizeof text, "%zu marked node%s", due.small, due.small == 1 ? "" : "s");
    assert_int_equal(s->tally.small_marked, due.small);
    assert_int_equal(says(s, text), due.small > 0);
}

/* A line of the legend is there if its layer has boxes in the frame. */
static void assert_line(const scene *s, const char *text, view_layer layer)
{
    assert_int_equal(says(s, text), count_layer(s, layer).boxes > 0);
}

/* The legend's counts must match the recount. */
static void check_words(const scene *s, const recount *met)
{
    char text[SCENE_TEXT];
    const size_t taken = met->touched[OCTREE_TRACE_TAKEN];
    const size_t visited = met->touched[OCTREE_TRACE_VISITED], pruned = met->touched[OCTREE_TRACE_PRUNED];
    snprintf(text, sizeof text, "%zu node%s visited", visited, visited == 1 ? "" : "s");
    assert_line(s, text, LAYER_VISITED);
    snprintf(text, sizeof text, "%zu taken whole", taken);
    assert_true(taken == 0 || says(s, text) || count_layer(s, LAYER_VISITED).boxes == 0);
    snprintf(text, sizeof text, "%zu node%s pruned", pruned, pruned == 1 ? "" : "s");
    assert_line(s, text, LAYER_PRUNED);
    snprintf(text, sizeof text, met->leaf_count == 1 ? "%zu leaf hit" : "%zu leaves hit", met->leaf_count);
    assert_line(s, text, LAYER_HIT);
}

/* The tick's line in ticks.jsonl must have the same counts. */
static void check_line(const octree_game *game, const recount *met)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
    assert_int_equal(fclose(out), 0);
    json_t *line = json_read(text);
    const json_t *visits = json_member(line, "visits");
    assert_whole_number(json_member(visits, "visited"), met->touched[OCTREE_TRACE_VISITED]);
    assert_whole_number(json_member(visits, "taken"), met->touched[OCTREE_TRACE_TAKEN]);
    assert_whole_number(json_member(visits, "pruned"), met->touched[OCTREE_TRACE_PRUNED]);
    assert_whole_number(json_member(visits, "hit"), met->leaf_count);
    json_decref(line);
    free(text);
}

/* Every tick as the view shows it. A column that is high enough has room for all of the legend. */
static void check_session(const octree_session *session, const view *v, bool words)
{
    octree_game *game = start_game(session);
    recount met = {0};
    scene s = {0};
    double before[3];
    memcpy(before, session->player.position, sizeof before);
    for (;; play_tick(game)) {
        recount_tick(&met, game, before);
        build_tick(&s, v, game);
        check_visits(&s, &met, octree_game_tree(game));
        check_line(game, &met);
        if (words)
            check_words(&s, &met);
        memcpy(before, octree_game_tick(game)->player, sizeof before);
        if (octree_game_over(game))
            break;
    }
    recount_free(&met);
    scene_release(&s);
    octree_game_destroy(game);
}

static void visits_of_the_default_session_match_a_recount(void **state)
{
    (void)state;
    const octree_session session = session_of_points_with_all_layers();
    const view v = view_of(1280, 1440, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    check_session(&session, &v, true);
}

static void visits_of_random_sessions_match_a_recount(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        const view v = view_of(1280, 1440, (view_camera)(seed % CAMERA_COUNT), VIEW_DEFAULT_LAYERS);
        check_session(&made.session, &v, true);
    }
}

enum { BODIES = 600 };

/* 600 clustered points, a box, a ball and neighbours. */
static octree_session clustered_session(octree_game_body bodies[BODIES])
{
    static const octree_query queries[] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-7.3, -6.1, -8.2}, {5.5, 7.7, 3.1}}},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .target = {2.5, 1.5, 0.3}, .k = 9},
    };
    double positions[BODIES][3];
    octree_session session = small_session(bodies, BODIES);
    session.tree = define(cube(-10, 10), 2, OCTREE_MAX_DEPTH, OCTREE_GROW);
    session.queries = queries;
    session.query_count = 2;
    session.keys = "wd";
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 4, &session.tree.world, BODIES, positions), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        bodies[i] = (octree_game_body){.id = i + 1000};
        memcpy(bodies[i].position, positions[i], sizeof positions[i]);
    }
    return session;
}

static void filter_and_lod_apply_to_visited_nodes(void **state)
{
    (void)state;
    static octree_game_body bodies[BODIES];
    static const view_filter filters[] = {
        {.leaves = true},
        {.by_depth = true, .min_depth = 2, .max_depth = 4},
        {.slice = 'z', .slice_at = 1.25},
        {.by_region = true, .region = {{-1, -1, -1}, {6, 6, 6}}},
    };
    const octree_session session = clustered_session(bodies);
    for (size_t i = 0; i < sizeof filters / sizeof filters[0]; i++) {
        for (int lod = 0; lod <= 30; lod += 15) {
            view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
            v.filter = filters[i];
            v.lod = lod;
            check_session(&session, &v, false);
        }
    }
}

/* Shallower boxes give shared edges their colour, so that nodes look as they do in their own layer. */
static void visited_nodes_keep_their_colour(void **state)
{
    (void)state;
    static octree_game_body bodies[BODIES];
    const octree_session session = clustered_session(bodies);
    octree_game *game = start_game(&session);
    for (int coloring = 0; coloring < COLORING_COUNT; coloring++) {
        view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        scene s = {0};
        size_t met = 0;
        v.coloring = (view_coloring)coloring;
        build_tick(&s, &v, game);
        for (size_t i = 0; i < s.boxes.count; i++) {
            const scene_box *box = &s.boxes.items[i];
            if (box->style.layer != LAYER_VISITED && box->style.layer != LAYER_PRUNED)
                continue;
            assert_int_equal(box->style.role, find_only_box(&s, LAYER_NODES, box->id)->style.role);
            met++;
        }
        assert_true(met > 20);
        scene_release(&s);
    }
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(visits_of_the_default_session_match_a_recount),
        cmocka_unit_test(visits_of_random_sessions_match_a_recount),
        cmocka_unit_test(filter_and_lod_apply_to_visited_nodes),
        cmocka_unit_test(visited_nodes_keep_their_colour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
