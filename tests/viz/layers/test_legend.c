/* SPDX-License-Identifier: MIT */
/* test_legend.c - tests which layers the legend lists, and which lines it drops without room for all. */
#include "scenes.h"
#include "brute.h"
#include "column.h"
#include "draw_list.h"
#include "layer_type.h"

#include <stdio.h>
#include <string.h>

/* The layers that have a line in the legend, what colour its swatch has and what its words say. */
static const struct legend_row {
    view_layer layer;
    unsigned role;
    bool shared; /* other layers have this colour too */
    const char *text;
} legend_rows[] = {
    {LAYER_WRONG, ROLE_WRONG, false, "wrong answer"},
    {LAYER_WRONG, ROLE_MISSED, false, "missing point"},
    {LAYER_WRONG, ROLE_WRONG, false, "extra point"},
    {LAYER_PLAYER, ROLE_PLAYER, false, "player and its box"},
    {LAYER_BOX, ROLE_COLLISION, false, "collision, crossed"},
    {LAYER_POINTS, ROLE_POINT, true, "point"},
    {LAYER_VELOCITIES, ROLE_FAINT, true, "velocity, "},
    {LAYER_NODES, ROLE_NODE, true, "nodes, depth 0"},
    {LAYER_VISITED, ROLE_NODE + 2, true, " visited"},
    {LAYER_PRUNED, ROLE_NODE + 2, true, " pruned"},
    {LAYER_HIT, ROLE_HIT, true, " hit"},
    {LAYER_SPLITS, ROLE_CHANGE, true, " split"},
    {LAYER_MERGES, ROLE_CHANGE, true, " merged"},
    {LAYER_RANGE, ROLE_RANGE, false, "range query"},
    {LAYER_RADIUS, ROLE_RADIUS, false, "radius query"},
    {LAYER_KNEAREST, ROLE_KNEAREST, false, "k nearest"},
    {LAYER_NEAREST, ROLE_NEAREST, false, "nearest point"},
    {LAYER_SHAPES, ROLE_SHAPE, false, "4 shapes"},
    {LAYER_VISIT_HEAT, ROLE_NODE + 9, true, "+ visits"},
    {LAYER_POINT_HEAT, ROLE_NODE + 9, true, "+ points"},
};

#define LEGEND_ROWS (sizeof legend_rows / sizeof legend_rows[0])

/* Whether the row is in the legend, whose words begin right of a swatch. Of points the whole text is compared: other
 * rows have the word too. */
static bool is_explained(const scene *s, const struct legend_row *row)
{
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->style.layer != LAYER_TEXT || label->at[0] != find_legend_text_x(s))
            continue;
        if (row->layer == LAYER_POINTS ? strcmp(label->text, row->text) == 0 : strstr(label->text, row->text) != NULL)
            return true;
    }
    return false;
}

/* Play to the first tick by which each kind of query has been asked. */
static octree_game *start_asking(const octree_session *session)
{
    octree_game *game = start_game(session);
    while (!(octree_game_tick(game)->asked >> OCTREE_QUERY_RANGE & 1))
        play_tick(game);
    return game;
}

/* A layer shown alone has its line and no other. If one layer is hidden, all others have theirs. There is room for all.
 */
static void legend_lists_the_shown_layers(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_asking(&session);
    scene s = {0};
    for (size_t i = 0; i < LEGEND_ROWS; i++) {
        for (unsigned text = 0; text < 2; text++) {
            const unsigned words = text << LAYER_TEXT, own = 1u << legend_rows[i].layer;
            view v = view_of(1280, 1440, CAMERA_ISO, own | words);
            build_tick(&s, &v, game);
            for (size_t j = 0; j < LEGEND_ROWS; j++)
                assert_int_equal(is_explained(&s, &legend_rows[j]),
                                 text && legend_rows[i].layer == legend_rows[j].layer);
            assert_int_equal(has_swatch(&s, legend_rows[i].role), text);
            v.layers = VIEW_ALL_LAYERS & ~own & ~(text ? 0 : 1u << LAYER_TEXT);
            build_tick(&s, &v, game);
            for (size_t j = 0; j < LEGEND_ROWS; j++)
                assert_int_equal(is_explained(&s, &legend_rows[j]),
                                 text && legend_rows[i].layer != legend_rows[j].layer);
            assert_true(legend_rows[i].shared || !has_swatch(&s, legend_rows[i].role));
        }
    }
    octree_game_destroy(game);
    scene_release(&s);
}

/* The order in which rows are dropped: layers without elements in the frame, self-explanatory layers, layers whose
 * answer the panel shows, all others. */
static unsigned worth_of(const scene *s, const struct legend_row *row)
{
    static const unsigned answers = 1u << LAYER_RANGE | 1u << LAYER_RADIUS | 1u << LAYER_KNEAREST | 1u << LAYER_NEAREST;
    const layer_counts found = count_layer(s, row->layer);
    if (found.boxes + found.segments + found.markers == 0)
        return 0;
    return row->layer == LAYER_POINTS || row->layer == LAYER_PLAYER ? 1 : answers >> row->layer & 1 ? 2 : 3;
}

/* A row is dropped only after all rows with an earlier drop order. The rows dropped last go from the end. The last line
 * counts the dropped rows. */
static void legend_drops_lines_in_drop_order(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_asking(&session);
    scene s = {0};
    size_t whole = 0, partial = 0, cut = 0, none = 0;
    for (int height = 100; height <= 1440; height += 10) {
        const view v = view_of(1280, height, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        size_t there[4] = {0}, missing[4] = {0};
        char more[SCENE_TEXT];
        build_tick(&s, &v, game);
        assert_inside_column(&s);
        for (size_t i = 0; i < LEGEND_ROWS; i++) {
            const unsigned worth = worth_of(&s, &legend_rows[i]);
            const bool listed = is_explained(&s, &legend_rows[i]);
            if (!(v.layers >> legend_rows[i].layer & 1))
                continue;
            assert_true(!listed || worth < 3 || missing[3] == 0);
            there[worth] += listed;
            missing[worth] += !listed;
        }
        for (unsigned worth = 1; worth < 4; worth++)
            assert_true(missing[worth] == 0 || there[worth - 1] == 0);
        const size_t all = there[0] + there[1] + there[2] + there[3];
        const size_t gone = missing[0] + missing[1] + missing[2] + missing[3];
        snprintf(more, sizeof more, "and %zu more", gone);
        bool told = false;
        for (size_t i = 0; i < s.labels.count; i++)
            told = told ||
                   (strcmp(s.labels.items[i].text, more) == 0 && s.labels.items[i].at[0] == find_legend_text_x(&s));
        assert_int_equal(told, all > 0 && gone > 0);
        whole += missing[0] == 0;
        partial += missing[3] == 0 && missing[0] > 0;
        cut += all > 0 && missing[3] > 0;
        none += all == 0;
    }
    assert_true(whole > 0 && partial > 0 && cut > 0 && none > 0);
    octree_game_destroy(game);
    scene_release(&s);
}

static void legend_lists_queries_of_every_tick_but_no_later_ones(void **state)
{
    (void)state;
    static const theme_role roles[OCTREE_QUERY_KINDS] = {ROLE_RANGE, ROLE_NEAREST, ROLE_KNEAREST, ROLE_RADIUS};
    const view v = view_make_default();
    scene s = {0};
    for (int kind = -1; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query asked[] = {
            {.tick = 99, .kind = (octree_query_kind)((kind + 1) % OCTREE_QUERY_KINDS)},
            {.tick = OCTREE_EVERY_TICK, .kind = (octree_query_kind)(kind < 0 ? 0 : kind)},
        };
        octree_session session = small_session(NULL, 0);
        session.queries = asked;
        session.query_count = kind < 0 ? 1 : 2;
        octree_game *game = start_game(&session);
        build_tick(&s, &v, game);
        for (int i = 0; i < OCTREE_QUERY_KINDS; i++) /* the key n can ask for the nearest point in every session */
            assert_int_equal(has_swatch(&s, roles[i]), i == kind || i == OCTREE_QUERY_NEAREST);
        octree_game_destroy(game);
    }
    scene_release(&s);
}

/* The later queries of a program are unknown while its session is recorded. */
static void legend_without_a_player_lists_queries_asked_so_far(void **state)
{
    (void)state;
    const view v = view_make_default();
    const octree_query late = {.tick = 2, .kind = OCTREE_QUERY_RADIUS, .target = {1, 1, 1}, .radius = 1};
    for (octree_player_kind kind = OCTREE_PLAYER_BODY; kind <= OCTREE_PLAYER_NONE; kind++) {
        octree_session session = small_session(NULL, 0);
        session.player.kind = kind;
        session.queries = &late;
        session.query_count = 1;
        session.ticks = 3;
        octree_game *game = start_game(&session);
        scene s = {0};
        for (int tick = 0; tick < 4; tick++) {
            build_tick(&s, &v, game);
            assert_int_equal(has_swatch(&s, ROLE_RADIUS), tick >= 2);
            assert_false(has_swatch(&s, ROLE_NEAREST));
            assert_int_equal(has_swatch(&s, ROLE_PLAYER), kind == OCTREE_PLAYER_BODY);
            assert_int_equal(count_layer(&s, LAYER_PLAYER).markers, 0);
            assert_int_equal(find_text(&s, "away") != NULL, kind == OCTREE_PLAYER_BODY);
            if (tick < 3)
                play_tick(game);
        }
        octree_game_destroy(game);
        scene_release(&s);
    }
}

/* The word, and the line of the legend that a sweep needs. */
static void legend_lists_the_elements_of_the_diagram(void **state)
{
    (void)state;
    brute all = {0};
    const octree_box world = cube(-1000, 1000);
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 3, &world, 4000);
    octree *large = brute_tree(&all, world, 4, OCTREE_MAX_DEPTH);
    all.count = 40;
    octree *small = brute_tree(&all, world, 4, OCTREE_MAX_DEPTH);
    for (int i = 0; i < 16; i++) {
        view v = view_make_default();
        scene s = {0};
        v.diagram = i & 1 ? DIAGRAM_ONLY : DIAGRAM_BESIDE;
        v.filter.leaves = i & 2;
        const tree_subject about = {.title = "legend", .node = i & 8 ? OCTREE_ROOT : 0};
        assert_true(tree_scene_build(&s, &v, i & 4 ? large : small, &about));
        assert_true(has_label_with(&s, "inner node, leaf") && has_label_with(&s, "nodes, depth 0-9+"));
        assert_int_equal(has_label_with(&s, "node filtered out"), (i & 2) != 0);
        assert_int_equal(has_label_with(&s, "bars: many nodes, log2"), (i & 4) != 0);
        assert_int_equal(has_label_with(&s, "path from the root"), (i & 8) != 0);
        scene_release(&s);
    }
    brute_free(&all);
    octree_destroy(small);
    octree_destroy(large);
}

/* No two layers have the same order in the legend, and each layer with an order has a text. */
static void every_listed_layer_has_a_place_and_text(void **state)
{
    (void)state;
    for (int i = 0; i <= LAYER_COUNT; i++) {
        const layer_type *type = layer_types[i];
        assert_int_equal(type->legend.order > 0, type->legend.text || type->legend.add_lines);
        for (int j = 0; type->legend.order && j < i; j++)
            assert_int_not_equal(type->legend.order, layer_types[j]->legend.order);
    }
}

static void every_query_kind_has_a_layer_and_a_panel_row(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const view_layer layer = layer_of_query((octree_query_kind)kind);
        assert_string_equal(layer_rows[layer].name, octree_query_name((octree_query_kind)kind));
        assert_true(layer_types[layer]->add_answer && layer_types[layer]->write_answer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legend_lists_the_shown_layers),
        cmocka_unit_test(legend_drops_lines_in_drop_order),
        cmocka_unit_test(legend_lists_queries_of_every_tick_but_no_later_ones),
        cmocka_unit_test(legend_without_a_player_lists_queries_asked_so_far),
        cmocka_unit_test(legend_lists_the_elements_of_the_diagram),
        cmocka_unit_test(every_listed_layer_has_a_place_and_text),
        cmocka_unit_test(every_query_kind_has_a_layer_and_a_panel_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
