/* SPDX-License-Identifier: MIT */
/* test_legend.c - tests which layers the legend lists, and which lines it drops without room for all. */
#include "scenes.h"
#include "brute.h"
#include "column.h"
#include "draw_list.h"
#include "layer_type.h"

#include <stdio.h>
#include <string.h>

/* The layers that have a line in the legend, from its last line up; what colour its swatch has and what its words say.
 */
static const struct legend_row {
    view_layer layer;
    unsigned role;
    bool shared; /* other layers have this colour too */
    const char *text;
} legend_rows[] = {
    {LAYER_PLAYER, ROLE_PLAYER, false, "player"},
    {LAYER_POINTS, ROLE_POINT, true, "point"},
    {LAYER_BODIES, ROLE_POINT, true, "box of a body"},
    {LAYER_VELOCITIES, ROLE_FAINT, true, "velocity, "},
    {LAYER_NODES, ROLE_NODE, true, "nodes, depth 0"},
    {LAYER_VISITED, ROLE_NODE + 2, true, " visited"},
    {LAYER_PRUNED, ROLE_NODE + 2, true, " pruned"},
    {LAYER_HIT, ROLE_HIT, true, " hit"},
    {LAYER_SPLITS, ROLE_CHANGE, true, " split"},
    {LAYER_MERGES, ROLE_CHANGE, true, " merged"},
    {LAYER_RANGE, ROLE_RANGE, false, "range query"},
    {LAYER_RADIUS, ROLE_RADIUS, true, "radius query"},
    {LAYER_KNEAREST, ROLE_KNEAREST, false, "k nearest"},
    {LAYER_NEAREST, ROLE_NEAREST, false, "nearest point"},
    {LAYER_RAY, ROLE_RADIUS, true, "ray query"},
    {LAYER_FRUSTUM, ROLE_RANGE, true, "frustum query"},
    {LAYER_SWEEP, ROLE_RADIUS, true, "sweep query"},
    {LAYER_BOX, ROLE_COLLISION, true, "collision"},
    {LAYER_PAIRS, ROLE_COLLISION, true, "1 pair overlaps"},
    {LAYER_SHAPES, ROLE_SHAPE, false, "4 shapes"},
    {LAYER_VISIT_HEAT, ROLE_NODE + 9, true, "+ visits"},
    {LAYER_POINT_HEAT, ROLE_NODE + 9, true, "+ points"},
    {LAYER_WRONG, ROLE_WRONG, false, "extra point"},
    {LAYER_WRONG, ROLE_MISSED, false, "missing point"},
    {LAYER_WRONG, ROLE_WRONG, false, "wrong answer"},
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

static size_t count_shapes(const scene *s, scene_shape shape)
{
    size_t count = 0;
    for (size_t i = 0; i < s->markers.count; i++)
        count += s->markers.items[i].style.layer == LAYER_WRONG && s->markers.items[i].shape == shape;
    return count;
}

/* Whether the frame has what a row explains. */
static bool occurs(const scene *s, const octree_game *game, const struct legend_row *row)
{
    const layer_counts found = count_layer(s, row->layer);
    if (row->layer == LAYER_BOX)
        return octree_game_tick(game)->hit_count > 0 && found.boxes > 0;
    if (row->layer == LAYER_WRONG)
        return count_shapes(s, row->role == ROLE_MISSED           ? SHAPE_TRIANGLE
                               : strcmp(row->text, "extra point") ? SHAPE_RING
                                                                  : SHAPE_WEDGE) > 0;
    return found.boxes + found.segments + found.markers > 0;
}

/* At every tick, with another layer hidden, each row is there if the frame has what it explains. There is room for all.
 */
static void legend_lists_what_occurs(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    size_t seen[LEGEND_ROWS] = {0};
    heat h = {0};
    scene s = {0};
    for (size_t tick = 0; !octree_game_over(game); tick++) {
        const view_layer hidden = legend_rows[tick % LEGEND_ROWS].layer;
        const unsigned text = tick % 3 ? 1u << LAYER_TEXT : 0;
        const view v =
            view_of(1280, 1440, CAMERA_ISO, (VIEW_ALL_LAYERS & ~(1u << LAYER_TEXT) & ~(1u << hidden)) | text);
        play_tick(game);
        assert_true(heat_add_tick(&h, game));
        build_hot_tick(&s, &v, game, &h);
        for (size_t i = 0; i < LEGEND_ROWS; i++) {
            const bool occurring = occurs(&s, game, &legend_rows[i]);
            assert_int_equal(is_explained(&s, &legend_rows[i]), text && occurring);
            assert_true(!(text && occurring) || has_swatch(&s, legend_rows[i].role));
            assert_true(text || !has_swatch(&s, legend_rows[i].role) || legend_rows[i].shared);
            seen[i] += occurring;
        }
    }
    for (size_t i = 0; i < LEGEND_ROWS; i++)
        if (seen[i] == 0)
            fail_msg("no frame has a line \"%s\"", legend_rows[i].text);
    heat_release(&h);
    octree_game_destroy(game);
    scene_release(&s);
}

/* The order in which rows are dropped: self-explanatory layers, layers whose answer the panel shows, all others. */
static unsigned worth_of(const struct legend_row *row)
{
    static const unsigned answers = 1u << LAYER_RANGE | 1u << LAYER_RADIUS | 1u << LAYER_KNEAREST |
                                    1u << LAYER_NEAREST | 1u << LAYER_RAY | 1u << LAYER_FRUSTUM | 1u << LAYER_SWEEP;
    return row->layer == LAYER_POINTS || row->layer == LAYER_PLAYER ? 0 : answers >> row->layer & 1 ? 1 : 2;
}

static bool has_range_query(const octree_tick *tick)
{
    for (size_t i = 0; i < tick->answer_count; i++)
        if (tick->answers[i].kind == OCTREE_QUERY_RANGE)
            return true;
    return false;
}

/* A row is dropped only after all rows with an earlier drop order. The rows dropped last go from the end. The last line
 * counts the dropped rows. */
static void legend_drops_lines_in_drop_order(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    while (!has_range_query(octree_game_tick(game)))
        play_tick(game);
    scene s = {0};
    size_t whole = 0, partial = 0, cut = 0, none = 0;
    for (int height = 100; height <= 1440; height += 10) {
        const view v = view_of(1280, height, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        size_t there[3] = {0}, missing[3] = {0};
        char more[SCENE_TEXT];
        build_tick(&s, &v, game);
        assert_inside_column(&s);
        for (size_t i = LEGEND_ROWS; i-- > 0;) {
            const unsigned worth = worth_of(&legend_rows[i]);
            const bool listed = is_explained(&s, &legend_rows[i]);
            if (!occurs(&s, game, &legend_rows[i]))
                continue;
            assert_true(!listed || worth < 2 || missing[2] == 0);
            there[worth] += listed;
            missing[worth] += !listed;
        }
        for (unsigned worth = 1; worth < 3; worth++)
            assert_true(missing[worth] == 0 || there[worth - 1] == 0);
        const size_t all = there[0] + there[1] + there[2], gone = missing[0] + missing[1] + missing[2];
        snprintf(more, sizeof more, "and %zu more", gone);
        bool told = false;
        for (size_t i = 0; i < s.labels.count; i++)
            told = told ||
                   (strcmp(s.labels.items[i].text, more) == 0 && s.labels.items[i].at[0] == find_legend_text_x(&s));
        assert_int_equal(told, all > 0 && gone > 0);
        whole += missing[0] == 0;
        partial += missing[2] == 0 && missing[0] > 0;
        cut += all > 0 && missing[2] > 0;
        none += all == 0;
    }
    assert_true(whole > 0 && partial > 0 && cut > 0 && none > 0);
    octree_game_destroy(game);
    scene_release(&s);
}

/* A query is listed only at its tick. A player that is away has no line. */
static void legend_lists_a_query_at_its_tick(void **state)
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
            assert_int_equal(has_swatch(&s, ROLE_RADIUS), tick == 2);
            assert_false(has_swatch(&s, ROLE_NEAREST) || has_swatch(&s, ROLE_PLAYER));
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
        octree_stats stats;
        char depths[32];
        assert_int_equal(octree_statistics(i & 4 ? large : small, &stats), OCTREE_OK);
        assert_true(stats.depth > 1 && stats.depth < 9);
        snprintf(depths, sizeof depths, "nodes, depth 0-%u", stats.depth);
        assert_true(has_label_with(&s, depths));
        assert_true(has_label_with(&s, "inner node, leaf"));
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
        cmocka_unit_test(legend_lists_what_occurs),
        cmocka_unit_test(legend_drops_lines_in_drop_order),
        cmocka_unit_test(legend_lists_a_query_at_its_tick),
        cmocka_unit_test(legend_lists_the_elements_of_the_diagram),
        cmocka_unit_test(every_listed_layer_has_a_place_and_text),
        cmocka_unit_test(every_query_kind_has_a_layer_and_a_panel_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
