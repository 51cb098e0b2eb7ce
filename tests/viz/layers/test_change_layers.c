/* SPDX-License-Identifier: MIT */
/* test_change_layers.c - tests that splits, merges and a broken invariant are drawn where they happen, and nothing else
 * is. */
#include "scenes.h"
#include "column.h"
#include "layout.h"

#include <string.h>

#include "broken_tree.h"
#include "draw_list.h"
#include "layer_type.h"
#include "random_session.h"

/* Three lines from face to face through the corner that a cell's eight octants share. */
static void check_planes(const scene *s, const octree *tree, view_layer layer, scene_stroke style,
                         const octree_address *nodes, size_t count)
{
    const octree_box world = octree_definition(tree).world;
    const layer_counts found = count_layer(s, layer);
    for (size_t i = 0; i < count; i++) {
        const octree_box cell = octree_cell_box(&world, nodes[i]), first = octree_cell_box(&world, nodes[i] << 3);
        for (unsigned axis = 0; axis < 3; axis++) {
            double from[3], to[3];
            memcpy(from, first.max, sizeof from);
            memcpy(to, first.max, sizeof to);
            from[axis] = cell.min[axis];
            to[axis] = cell.max[axis];
            assert_int_equal(count_lines_between(s, layer, nodes[i] << 2 | axis, from, to), 1);
        }
    }
    assert_int_equal(found.segments, 3 * count);
    assert_int_equal(found.boxes + found.markers + found.labels + found.panels, 0);
    for (size_t i = 0; i < s->segments.count; i++)
        if (s->segments.items[i].style.layer == layer)
            assert_true(s->segments.items[i].style.stroke == style && s->segments.items[i].style.width == 2);
}

static void check_tick(const scene *s, const octree_game *game, size_t *splits, size_t *merges)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    check_planes(s, tree, LAYER_SPLITS, STROKE_SOLID, tick->splits, tick->split_count);
    check_planes(s, tree, LAYER_MERGES, STROKE_DASHED, tick->merges, tick->merge_count);
    const layer_counts broken = count_layer(s, LAYER_BROKEN);
    assert_int_equal(broken.boxes + broken.segments + broken.markers + broken.labels, 0);
    *splits += tick->split_count;
    *merges += tick->merge_count;
}

static void check_session(const octree_session *session, size_t *splits, size_t *merges)
{
    view v = view_of(320, 180, CAMERA_ORBIT, VIEW_DEFAULT_LAYERS);
    octree_game *game = start_game(session);
    scene s = {0};
    for (;; play_tick(game)) {
        build_tick(&s, &v, game);
        check_tick(&s, game, splits, merges);
        if (octree_game_over(game))
            break;
    }
    scene_release(&s);
    octree_game_destroy(game);
}

static void every_split_and_merge_is_shown_where_it_happened(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    size_t splits = 0, merges = 0;
    check_session(&session, &splits, &merges);
    assert_true(splits > 0 && merges > 0);
    for (uint64_t seed = 1; seed <= 16; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session, &splits, &merges);
    }
    assert_true(splits > 300 && merges > 300);
}

/* The deepest node that can split: its lines have ids of their own, and its planes lie within its cell. */
static void a_split_at_the_greatest_depth_is_shown(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {1.5, 0.25, 0.25}}};
    static const octree_edit edits[] = {{1, OCTREE_EDIT_INSERT, {.id = 2, .position = {0.25, 0.25, 0.25}}},
                                        {1, OCTREE_EDIT_MOVE, {.id = 1, .position = {1.25, 0.25, 0.25}}}};
    octree_session session = {.tree = define(cube(0, 0x1p21), 1, OCTREE_MAX_DEPTH, OCTREE_REFUSE),
                              .player = {.id = 9, .position = {0x1p20, 0x1p20, 0x1p20}},
                              .bodies = bodies,
                              .body_count = 1,
                              .edits = edits,
                              .edit_count = 2,
                              .ticks = 1};
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    octree_game *game = start_game(&session);
    scene s = {0};
    size_t splits = 0, merges = 0;
    play_tick(game);
    build_tick(&s, &v, game);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(octree_address_depth(tick->splits[tick->split_count - 1]), OCTREE_MAX_DEPTH - 1);
    check_tick(&s, game, &splits, &merges);
    assert_int_equal(splits, OCTREE_MAX_DEPTH - 1); /* the root was split before */
    octree_game_destroy(game);
    scene_release(&s);
}

/* Join the panel's lines in the colour of warnings into one sentence. */
static void collect_warning(const scene *s, char text[256])
{
    text[0] = 0;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->style.layer != LAYER_TEXT || label->style.role != ROLE_WARNING)
            continue;
        if (text[0])
            strncat(text, " ", 255 - strlen(text));
        strncat(text, label->text, 255 - strlen(text));
    }
}

static void check_broken(const scene *s, const octree_box *world, octree_address where, const char *sentence)
{
    char told[256];
    const octree_box cell = octree_cell_box(world, where);
    const layer_counts found = count_layer(s, LAYER_BROKEN);
    assert_true(found.boxes == 1 && found.segments == 12 && found.labels == 1 && found.markers + found.panels == 0);
    assert_true(same_box(&find_only_box(s, LAYER_BROKEN, where)->box, &cell));
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *line = &s->segments.items[i];
        assert_true(line->style.layer != LAYER_BROKEN ||
                    (box_holds(&cell, line->ends[0]) && box_holds(&cell, line->ends[1])));
        assert_true(line->style.layer != LAYER_BROKEN || line->style.role == ROLE_WARNING);
    }
    collect_warning(s, told);
    assert_string_equal(told, sentence);
}

static void broken_invariant_is_crossed_out_and_reported(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 5, 5}},
                                              {.id = 2, .position = {6, 5, 5}},
                                              {.id = 3, .position = {-5, 5, 5}},
                                              {.id = 4, .position = {-6, 5, 5}}};
    static const double elsewhere[3] = {-5, -5, -5};
    const octree_session session = small_session(bodies, 4);
    octree_game *game = start_game(&session);
    const octree *tree = octree_game_tree(game);
    const octree_address where = break_tree(tree, bodies[0].position, elsewhere);
    octree_address found;
    const char *sentence = octree_check(tree, &found);
    assert_non_null(sentence);
    assert_int_equal(found, where);
    static const int heights[] = {720, 1440, 100}; /* the last has no column */
    for (size_t i = 0; i < 3; i++) {
        view v = view_of(heights[i] == 100 ? 200 : 1280, heights[i], CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        scene s = {0};
        build_tick(&s, &v, game);
        check_broken(&s, &session.tree.world, where, sentence);
        build_tree(&s, &v, tree, "a cloud");
        check_broken(&s, &session.tree.world, where, sentence);
        v.layers &= ~(1u << LAYER_BROKEN);
        build_tick(&s, &v, game);
        assert_int_equal(count_layer(&s, LAYER_BROKEN).boxes, 0);
        char told[256];
        collect_warning(&s, told);
        assert_string_equal(told, "");
        scene_release(&s);
    }
    octree_game_destroy(game);
}

/* Every sentence of the validator is shown whole, however its lines break. */
static void every_sentence_of_the_validator_is_shown_whole(void **state)
{
    (void)state;
    static const char *const sentences[] = {
        "a node other than the root is empty",
        "a node's count is not the sum of its children's",
        "an inner node has so few points that it should be a leaf",
        "an inner node is deeper than the tree allows",
        "a leaf that could split is over its capacity",
        "a leaf is over its capacity under OCTREE_REFUSE",
        "a point is outside the world",
        "a point is not in its leaf's cell",
        "a pair of position and id is stored twice",
        "one",
        "Donaudampfschifffahrtsgesellschaftskapitaen and more",
    };
    const octree_session session = small_session(NULL, 0);
    octree_game *game = start_game(&session);
    scene s = {0};
    for (size_t i = 0; i < sizeof sentences / sizeof sentences[0]; i++) {
        const view v = view_make_default();
        const layer_source in = {.view = &v,
                                 .tree = octree_game_tree(game),
                                 .world = session.tree.world,
                                 .broken = sentences[i],
                                 .broken_at = OCTREE_ROOT,
                                 .game = game,
                                 .session = &session,
                                 .tick = octree_game_tick(game)};
        build_tick(&s, &v, game);
        s.labels.count = 0;
        layer_BROKEN.add(&s, &in, LAYER_BROKEN);
        layer_TEXT.add(&s, &in, LAYER_TEXT);
        char told[256];
        collect_warning(&s, told);
        assert_true(i + 1 == sizeof sentences / sizeof sentences[0] ? strlen(told) > 0
                                                                    : strcmp(told, sentences[i]) == 0);
        for (size_t j = 0; j < s.labels.count; j++)
            assert_true(strlen(s.labels.items[j].text) <= LAYOUT_LETTERS || is_in_caption(&s, &s.labels.items[j]));
    }
    octree_game_destroy(game);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_split_and_merge_is_shown_where_it_happened),
        cmocka_unit_test(a_split_at_the_greatest_depth_is_shown),
        cmocka_unit_test(broken_invariant_is_crossed_out_and_reported),
        cmocka_unit_test(every_sentence_of_the_validator_is_shown_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
