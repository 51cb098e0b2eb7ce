/* SPDX-License-Identifier: MIT */
/* test_foreign_nodes.c - tests foreign nodes in scenes: beside Octreel's own nodes, and in their place. */
#include "foreign_nodes.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "describe.h"
#include "draw_list.h"
#include "foreign_session.h"

#define LOST (FOREIGN_ELEMENT | UINT64_C(1) << 61)
#define BOXES_OF(layer) (count_layer(&shown, layer).boxes)

static octree_session session;
static octree_game *game;
static scene shown;

/* The scene of a tick of the session above. */
static void show(const view *v, uint64_t tick)
{
    octree_game_destroy(game);
    session = foreign_session();
    game = start_game(&session);
    while (octree_game_tick(game)->number < tick)
        play_tick(game);
    build_tick(&shown, v, game);
}

static view view_by(view_tree tree)
{
    view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    v.tree = tree;
    return v;
}

static size_t own_boxes(unsigned layer)
{
    size_t count = 0;
    for (size_t i = 0; i < shown.boxes.count; i++)
        count += shown.boxes.items[i].style.layer == layer && !is_foreign_element(shown.boxes.items[i].id);
    return count;
}

static bool says(const char *text)
{
    for (size_t i = 0; i < shown.labels.count; i++)
        if (strcmp(shown.labels.items[i].text, text) == 0)
            return true;
    return false;
}

static void view_chooses_between_own_and_foreign_nodes(void **state)
{
    (void)state;
    const size_t own = 9; /* the octree of eight points, two in a leaf */
    const struct {
        view_tree tree;
        size_t own, foreign;
    } rows[] = {{TREE_AUTO, 0, 5}, {TREE_OWN, own, 0}, {TREE_FOREIGN, 0, 5}, {TREE_BOTH, own, 5}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const view v = view_by(rows[i].tree);
        show(&v, 0);
        assert_true((own_boxes(LAYER_NODES) > 0) == (rows[i].own > 0));
        assert_int_equal(BOXES_OF(LAYER_NODES) - own_boxes(LAYER_NODES), rows[i].foreign);
        assert_int_equal(shown.tally.nodes, BOXES_OF(LAYER_NODES));
        assert_int_equal(count_layer(&shown, LAYER_POINTS).markers, 8);
        assert_int_equal(says("foreign nodes"), rows[i].foreign > 0);
    }
}

/* A split of Octreel's hidden tree is no event in the panel, and the diagram is labelled as Octreel's. */
static void hidden_own_tree_has_no_events_and_its_diagram_is_labelled(void **state)
{
    (void)state;
    view own = view_by(TREE_OWN), program = view_by(TREE_FOREIGN);
    show(&own, 0);
    ((octree_tick *)(uintptr_t)octree_game_tick(game))->events = OCTREE_EVENT_SPLIT | OCTREE_EVENT_WRONG;
    build_tick(&shown, &own, game);
    assert_true(says("split, wrong"));
    build_tick(&shown, &program, game);
    assert_true(says("wrong"));
    own.diagram = program.diagram = DIAGRAM_BESIDE;
    show(&own, 0);
    assert_true(says("depth") && !says("Octreel's depth"));
    show(&program, 0);
    assert_true(says("Octreel's depth"));
}

static void foreign_nodes_look_like_own_nodes(void **state)
{
    (void)state;
    const view v = view_by(TREE_AUTO);
    show(&v, 0);
    const octree_foreign_node *nodes = session.foreign[0].nodes;
    for (size_t i = 0; i < FOREIGN_NODES; i++) {
        const scene_box *box = find_only_box(&shown, LAYER_NODES, foreign_element_id(nodes[i].id));
        const unsigned depth = i == 0 ? 0 : i < 3 ? 1 : 2;
        assert_true(same_box(&box->box, &nodes[i].box));
        assert_int_equal(box->depth, depth);
        assert_int_equal(box->style.role, theme_node_role(depth));
    }
    assert_int_equal(BOXES_OF(LAYER_VISITED), 3);
    assert_int_equal(BOXES_OF(LAYER_PRUNED), 2);
    assert_int_equal(BOXES_OF(LAYER_HIT), 1);
    assert_int_equal(find_only_box(&shown, LAYER_PRUNED, foreign_element_id(FOREIGN_LOW))->style.stroke, STROKE_CUT);
    assert_int_equal(find_only_box(&shown, LAYER_VISITED, foreign_element_id(FOREIGN_ROOT))->style.width, 2);
    assert_int_equal(find_only_box(&shown, LAYER_HIT, foreign_element_id(FOREIGN_HIGH))->style.role, ROLE_HIT);
    assert_true(says("3 nodes visited") && says("2 nodes pruned") && says("1 leaf hit"));
}

static void foreign_nodes_are_coloured_by_kind_and_by_occupancy(void **state)
{
    (void)state;
    view v = view_by(TREE_AUTO);
    v.coloring = COLORING_KIND;
    show(&v, 0);
    const theme_role leaf = find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_LOW))->style.role;
    assert_int_equal(find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_RIGHT))->style.role, leaf);
    assert_int_not_equal(find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_ROOT))->style.role, leaf);
    assert_int_not_equal(find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_LEFT))->style.role, leaf);
    assert_true(says("node: leaf") && says("node: split x"));
    v.coloring = COLORING_OCCUPANCY;
    show(&v, 0);
    assert_int_equal(find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_ROOT))->style.role,
                     theme_node_role(theme_step_of_doubling_ramp(8, 1)));
    assert_int_equal(find_only_box(&shown, LAYER_NODES, foreign_element_id(FOREIGN_LOW))->style.role,
                     theme_node_role(theme_step_of_doubling_ramp(2, 1)));
    assert_true(says("foreign, 0-256+ points"));
    v.tree = TREE_BOTH;
    show(&v, 0);
    char own[SCENE_TEXT];
    snprintf(own, sizeof own, "leaves, 0-%zu+ points", octree_definition(octree_game_tree(game)).leaf_capacity);
    assert_true(says(own) && says("foreign, 0-256+ points"));
}

static void kinds_beyond_the_colours_share_the_last_colour(void **state)
{
    (void)state;
    static const char kinds[][OCTREE_NODE_KIND] = {"a", "b", "c", "d", "e", "f", "g", "h"};
    view v = view_by(TREE_AUTO);
    v.coloring = COLORING_KIND;
    show(&v, 0);
    octree_foreign_state *foreign = (octree_foreign_state *)(uintptr_t)&octree_game_tick(game)->foreign;
    foreign->kinds = kinds;
    foreign->kind_count = THEME_NODE_KINDS;
    build_tick(&shown, &v, game);
    assert_true(says("node: g") && !says("node: any other kind"));
    foreign->kind_count++;
    build_tick(&shown, &v, game);
    assert_true(says("node: f") && !says("node: g") && says("node: any other kind"));
}

static void filter_budget_and_lod_apply_to_foreign_nodes(void **state)
{
    (void)state;
    view v = view_by(TREE_AUTO);
    v.filter = (view_filter){.leaves = true};
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 3);
    v.filter = (view_filter){.by_depth = true, .min_depth = 2, .max_depth = 2};
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 2);
    assert_int_equal(BOXES_OF(LAYER_VISITED), 1);
    assert_int_equal(count_layer(&shown, LAYER_POINTS).markers, 8); /* the depths are those of the other tree */
    v.filter = (view_filter){.slice = 'x', .slice_at = -200};       /* the faces of two boxes */
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 3);
    v.filter = (view_filter){.by_region = true, .region = {{200, 0, 0}, {250, 1, 1}}};
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 1);
    v.filter = (view_filter){0};
    v.budget = 4;
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 3);
    assert_int_equal(shown.tally.beyond, 2);
    assert_true(says("nodes to depth 1"));
    v.budget = 0;
    v.lod = 5000;
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_NODES), 1);
    assert_int_equal(shown.tally.small, 4);
}

static void faults_of_foreign_nodes_are_marked_and_described(void **state)
{
    (void)state;
    const view v = view_by(TREE_AUTO);
    show(&v, 0);
    assert_int_equal(BOXES_OF(LAYER_WRONG), 0);
    show(&v, 1);
    assert_int_equal(BOXES_OF(LAYER_WRONG), 2);
    find_only_box(&shown, LAYER_WRONG, foreign_element_id(FOREIGN_LOW));
    find_only_box(&shown, LAYER_WRONG, foreign_element_id(FOREIGN_HIGH));
    assert_int_equal(count_markers_at(&shown, LAYER_WRONG, LOST | 8, session.bodies[7].position), 1);
    assert_true(says("outside parent") && says("wrongly pruned") && says("in no node"));
    assert_true(says("wrong nodes"));
    char text[WRONG_NODE_TEXT];
    assert_string_equal(wrong_node_text(&octree_game_tick(game)->foreign, text),
                        "node 4: its box extends outside its parent's box");
}

/* Return the description of the element with this layer, kind and id. */
static const char *told(view_layer layer, scene_kind kind, uint64_t id)
{
    static element_subject subject;
    const size_t all =
        shown.boxes.count + shown.segments.count + shown.markers.count + shown.panels.count + shown.labels.count;
    for (uint32_t number = 1; number <= all; number++) {
        const scene_element element = scene_element_at(&shown, number);
        const scene_head head = scene_element_head(&shown, element);
        if (element.kind != kind || head.style.layer != layer || head.id != id)
            continue;
        subject = describe_element(game, NULL, &shown, element);
        return subject.text;
    }
    fail_msg("there is no such element");
    return "";
}

static void foreign_nodes_are_described(void **state)
{
    (void)state;
    view v = view_by(TREE_AUTO);
    v.labels = true;
    show(&v, 1);
    assert_string_equal(told(LAYER_NODES, SCENE_BOX, foreign_element_id(FOREIGN_LEFT)),
                        "foreign node 2: inner node at depth 1 of kind \"split z\" under node 1, 4 points listed, "
                        "box (-900, -700, -800) to (-200, 400, 900)");
    assert_string_equal(told(LAYER_WRONG, SCENE_BOX, foreign_element_id(FOREIGN_LOW)),
                        "foreign node 4: leaf at depth 2 of kind \"leaf\" under node 2, 2 points listed, "
                        "box (-900, -700, -800) to (100, 400, -200); wrong: its box extends outside its parent's box");
    assert_non_null(
        strstr(told(LAYER_PRUNED, SCENE_BOX, foreign_element_id(FOREIGN_RIGHT)), "; this tick's queries pruned it"));
    assert_non_null(
        strstr(told(LAYER_VISITED, SCENE_BOX, foreign_element_id(FOREIGN_ROOT)), "; this tick's queries visited it"));
    assert_non_null(
        strstr(told(LAYER_NODES, SCENE_LABEL, foreign_element_id(FOREIGN_RIGHT)), "text \"3\" on foreign node 3"));
    assert_string_equal(told(LAYER_WRONG, SCENE_MARKER, LOST | 8),
                        "point 8 at (900, -100, 600), which is in no foreign node");
}

/* The highest set bit of an address is at a multiple of 3. */
static void element_ids_of_foreign_nodes_differ_from_all_addresses(void **state)
{
    (void)state;
    for (unsigned depth = 0; depth <= OCTREE_MAX_DEPTH; depth++) {
        const uint64_t first = UINT64_C(1) << 3 * depth;
        assert_false(is_foreign_element(first));
        assert_false(is_foreign_element(first | (first - 1)));
    }
    assert_true(is_foreign_element(foreign_element_id(0)) &&
                is_foreign_element(foreign_element_id(OCTREE_NODE_ID_LIMIT - 1)));
    assert_int_equal(foreign_node_id(foreign_element_id(OCTREE_NODE_ID_LIMIT - 1)), OCTREE_NODE_ID_LIMIT - 1);
}

static int end(void **state)
{
    (void)state;
    octree_game_destroy(game);
    scene_release(&shown);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(view_chooses_between_own_and_foreign_nodes),
        cmocka_unit_test(hidden_own_tree_has_no_events_and_its_diagram_is_labelled),
        cmocka_unit_test(foreign_nodes_look_like_own_nodes),
        cmocka_unit_test(foreign_nodes_are_coloured_by_kind_and_by_occupancy),
        cmocka_unit_test(kinds_beyond_the_colours_share_the_last_colour),
        cmocka_unit_test(filter_budget_and_lod_apply_to_foreign_nodes),
        cmocka_unit_test(faults_of_foreign_nodes_are_marked_and_described),
        cmocka_unit_test(foreign_nodes_are_described),
        cmocka_unit_test(element_ids_of_foreign_nodes_differ_from_all_addresses),
    };
    return cmocka_run_group_tests(tests, NULL, end);
}
