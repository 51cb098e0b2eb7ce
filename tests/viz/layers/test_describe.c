/* SPDX-License-Identifier: MIT */
/* test_describe.c - tests that every element that a tick can show has a description of the right node or point. */
#include "describe.h"
#include "golden_frames.h"
#include "scenes.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* The text that the description of every element of a layer and kind contains. */
static const struct {
    view_layer layer;
    scene_kind kind;
    const char *part;
    bool about_node, about_point;
} expected[] = {
    {LAYER_WORLD, SCENE_BOX, "the world, box (-1000, -1000, -1000) to (1000, 1000, 1000)", false, false},
    {LAYER_WORLD, SCENE_SEGMENT, "axis", false, false},
    {LAYER_WORLD, SCENE_LABEL, "of an axis", false, false},
    {LAYER_NODES, SCENE_BOX, "at depth ", true, false},
    {LAYER_NODES, SCENE_PANEL, "the background of the address of node ", true, false},
    {LAYER_NODES, SCENE_LABEL, "on node ", true, false},
    {LAYER_VISIT_HEAT, SCENE_MARKER, "visited in ", true, false},
    {LAYER_POINT_HEAT, SCENE_MARKER, "summed over ", true, false},
    {LAYER_PRUNED, SCENE_BOX, "this tick's queries pruned it", true, false},
    {LAYER_VISITED, SCENE_BOX, "this tick's queries visited it", true, false},
    {LAYER_HIT, SCENE_BOX, "it holds points that this tick's queries found", true, false},
    {LAYER_MERGES, SCENE_SEGMENT, "that merged at this tick, node ", true, false},
    {LAYER_SPLITS, SCENE_SEGMENT, "that split at this tick, node ", true, false},
    {LAYER_POINTS, SCENE_MARKER, "point ", false, true},
    {LAYER_POINTS, SCENE_LABEL, ", the id of a point", false, false},
    {LAYER_POINTS, SCENE_PANEL, "the background of the id of a point", false, false},
    {LAYER_VELOCITIES, SCENE_SEGMENT, "the velocity of point 700 at (", false, true},
    {LAYER_BODIES, SCENE_BOX, "), half extents (", false, true},
    {LAYER_PAIRS, SCENE_BOX, "the overlap of body 700 and body 701, box (", false, false},
    {LAYER_PAIRS, SCENE_MARKER, "the overlap of body 700 and body 701, box (", false, false},
    {LAYER_RANGE, SCENE_BOX, "the box of the range query", false, false},
    {LAYER_RANGE, SCENE_MARKER, "found by a range query", false, true},
    {LAYER_RADIUS, SCENE_SEGMENT, "radius 450 about (", false, false},
    {LAYER_RADIUS, SCENE_MARKER, "found by a radius query", false, true},
    {LAYER_KNEAREST, SCENE_SEGMENT, "to neighbour ", false, true},
    {LAYER_KNEAREST, SCENE_LABEL, "the rank of a neighbour", false, false},
    {LAYER_NEAREST, SCENE_SEGMENT, "to neighbour 1: point ", false, true},
    {LAYER_NEAREST, SCENE_MARKER, "found by a nearest query", false, true},
    {LAYER_KNEAREST, SCENE_PANEL, "the background of the rank of a neighbour", false, false},
    {LAYER_FRUSTUM, SCENE_SEGMENT, "the edge of the frustum query", false, false},
    {LAYER_FRUSTUM, SCENE_MARKER, "found by a frustum query", false, true},
    {LAYER_SWEEP, SCENE_BOX, " of the sweep query (answer ", false, false},
    {LAYER_SWEEP, SCENE_SEGMENT, "the way of a corner of the sweep query", false, false},
    {LAYER_SWEEP, SCENE_MARKER, "found by a sweep query", false, true},
    {LAYER_SWEEP, SCENE_LABEL, "the rank of a hit", false, false},
    {LAYER_SWEEP, SCENE_PANEL, "the background of the rank of a hit", false, false},
    {LAYER_RAY, SCENE_SEGMENT, " of the ray query (answer ", false, false},
    {LAYER_RAY, SCENE_MARKER, "found by a ray query", false, true},
    {LAYER_RAY, SCENE_LABEL, "the rank of a hit", false, false},
    {LAYER_RAY, SCENE_PANEL, "the background of the rank of a hit", false, false},
    {LAYER_PLAYER, SCENE_SEGMENT, "down to the world's floor", false, false},
    {LAYER_PLAYER, SCENE_MARKER, "the player, point 6 at ", false, true},
    {LAYER_BOX, SCENE_BOX, "collision box", false, false},
    {LAYER_BOX, SCENE_SEGMENT, "the cross on the collision box", false, false},
    {LAYER_BOX, SCENE_MARKER, "in the player's collision box", false, true},
    {LAYER_SHAPES, SCENE_BOX, "shape 0 of the session, box (-400, 100, -300) to (-100, 300, 0)", false, false},
    {LAYER_SHAPES, SCENE_SEGMENT, "shape 1 of the session, segment (-900, -900, 0) to (900, 900, 0)", false, false},
    {LAYER_SHAPES, SCENE_MARKER, "shape 2 of the session, point (300, -300, 300)", false, false},
    {LAYER_SHAPES, SCENE_LABEL, "text \"goal\", shape 3 of the session, label at (300, -300, 300)", false, false},
    {LAYER_SHAPES, SCENE_PANEL, "the background of shape 3 of the session, label at (300, -300, 300)", false, false},
    {LAYER_WRONG, SCENE_MARKER, " the foreign answer to the nearest query (answer ", false, true},
    {LAYER_WRONG, SCENE_SEGMENT, "the line to an extra point of the foreign answer", false, false},
    {LAYER_WRONG, SCENE_PANEL, "the background of the text about the foreign answer", false, false},
    {LAYER_WRONG, SCENE_LABEL, "\", about the foreign answer to the nearest query", false, false},
    {LAYER_TEXT, SCENE_PANEL, "the background of the panel", false, false},
    {LAYER_TEXT, SCENE_LABEL, "text \"", false, false},
    {LAYER_DIAGRAM, SCENE_PANEL, "the diagram", false, false},
    {LAYER_DIAGRAM, SCENE_SEGMENT, "the line from its parent to node ", true, false},
    {LAYER_DIAGRAM, SCENE_LABEL, "of the diagram", false, false},
};

#define EXPECTED (sizeof expected / sizeof expected[0])

static void check_node(const octree_game *game, const element_subject *subject, uint64_t id)
{
    char path[OCTREE_ADDRESS_TEXT], text[OCTREE_ADDRESS_TEXT + 8];
    octree_node node;
    assert_int_equal(subject->node.address, id);
    snprintf(text, sizeof text, "node %s: ", octree_address_format(id, path));
    assert_non_null(strstr(subject->text, text));
    const bool there = octree_node_at(octree_game_tree(game), id, &node) == OCTREE_OK;
    assert_int_equal(subject->gone, !there);
    assert_non_null(strstr(subject->text, !there ? "its node no longer exists" : node.leaf ? "leaf" : "inner node"));
}

static size_t expectation_of(scene_style style, scene_kind kind)
{
    size_t i = 0;
    while (i < EXPECTED && (expected[i].layer != (view_layer)style.layer || expected[i].kind != kind))
        i++;
    if (i == EXPECTED)
        fail_msg("nothing is expected of kind %d in layer %d", (int)kind, style.layer);
    return i;
}

static bool is_ring(const scene *s, scene_element element)
{
    return element.kind == SCENE_MARKER && s->markers.items[element.index].shape == SHAPE_RING;
}

/* Whether an element is the cross on the collision box: it has the player's id, and the player is never a hit. */
static bool is_cross(const octree_game *game, const scene *s, scene_element element)
{
    return element.kind == SCENE_MARKER && scene_element_head(s, element).style.layer == LAYER_BOX &&
           scene_element_head(s, element).id == octree_game_session(game)->player.id;
}

static void check_element(const octree_game *game, const heat *h, const scene *s, scene_element element,
                          size_t seen[EXPECTED])
{
    const element_subject subject = describe_element(game, h, s, element);
    const size_t i = expectation_of(scene_element_head(s, element).style, element.kind);
    if (is_cross(game, s, element)) {
        assert_string_equal(subject.text, "the cross on the collision box");
        assert_false(subject.has_point || subject.has_node);
        return;
    }
    if (!strstr(subject.text, expected[i].part) && !(element.kind == SCENE_PANEL && strstr(subject.text, "diagram")) &&
        !(element.kind == SCENE_PANEL && strstr(subject.text, "a symbol or a rule in the panel")))
        fail_msg("\"%s\" says nothing of \"%s\"", subject.text, expected[i].part);
    if (expected[i].layer == LAYER_BOX &&
        element.kind == SCENE_BOX) /* there are two boxes; one is the box around the player */
        assert_int_equal(strncmp(subject.text, "the player's", 12) == 0,
                         scene_element_head(s, element).id == octree_game_session(game)->player.id);
    assert_true(strlen(subject.text) + 1 < ELEMENT_TEXT);
    assert_true(expected[i].about_node <= subject.has_node);
    const bool to_hit = expected[i].layer == LAYER_RAY && strstr(subject.text, " to hit "); /* not the ray itself */
    assert_int_equal((expected[i].about_point && !is_ring(s, element)) || to_hit, subject.has_point);
    if (subject.has_node)
        check_node(game, &subject,
                   expected[i].layer == LAYER_SPLITS || expected[i].layer == LAYER_MERGES
                       ? scene_element_head(s, element).id >> 2
                       : scene_element_head(s, element).id);
    if (subject.has_point && element.kind == SCENE_MARKER)
        assert_int_equal(subject.point.id, scene_element_head(s, element).id);
    seen[i]++;
}

static void every_element_of_every_layer_is_described(void **state)
{
    size_t seen[EXPECTED] = {0};
    octree_game *game;
    heat h = {0};
    scene s = {0};
    const octree_session session = session_with_all_layers();
    view v = view_of(960, 540, CAMERA_ISO, VIEW_ALL_LAYERS);
    v.labels = true;
    v.diagram = DIAGRAM_BESIDE;
    (void)state;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    for (;;) {
        assert_true(heat_add_tick(&h, game));
        build_hot_tick(&s, &v, game, &h);
        const size_t all = s.boxes.count + s.segments.count + s.markers.count + s.panels.count + s.labels.count;
        for (uint32_t number = 1; number <= all; number++)
            check_element(game, &h, &s, scene_element_at(&s, number), seen);
        if (octree_game_over(game))
            break;
        play_tick(game);
    }
    for (size_t i = 0; i < EXPECTED; i++)
        if (seen[i] == 0)
            fail_msg("no element says \"%s\"", expected[i].part);
    heat_release(&h);
    scene_release(&s);
    octree_game_destroy(game);
}

/* Check that a text is a phrase: it begins with a word and has no gap and no repeated word. */
static void assert_is_a_phrase(const char *text)
{
    static const char *const holes[] = {"(null)", "  ", " ,", ",,", "( ", "the the "};
    if (!*text || strchr(" ,;:", *text) || strlen(text) + 1 >= ELEMENT_TEXT)
        fail_msg("\"%s\" is no phrase", text);
    for (size_t i = 0; strncmp(text, "text ", 5) != 0 && i < sizeof holes / sizeof *holes;
         i++) /* a quoted text may contain them */
        if (strstr(text, holes[i]))
            fail_msg("\"%s\" has \"%s\"", text, holes[i]);
}

/* The golden frames also have a close-up, bars, painted points and foreign nodes. */
static void every_element_of_the_golden_frames_is_described_in_a_phrase(void **state)
{
    bool told_scale = false, told_frame = false, told_bar = false, told_way = false;
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        golden_play play;
        octreel_error error;
        tick_history h = {0};
        scene s = {0};
        if (!golden_is_played(&golden_frames[i]))
            continue;
        assert_true(golden_open(&golden_frames[i], &play, &error));
        assert_true(tick_history_add(&h, &play.view, play.game));
        for (uint64_t tick = 0; tick < golden_frames[i].tick; tick++) {
            play_tick(play.game);
            assert_true(tick_history_add(&h, &play.view, play.game));
        }
        assert_true(tick_scene_build(&s, &play.view, play.game, &h, NULL));
        const size_t all = scene_count_elements(&s) + (s.has_closeup ? scene_count_elements(s.closeup) : 0);
        for (uint32_t number = 1; number <= all; number++) {
            const element_subject told = describe_element(play.game, &h.heat, &s, scene_element_at(&s, number));
            assert_is_a_phrase(told.text);
            told_scale |= strstr(told.text, "the close-up's scale") != NULL;
            told_frame |= strcmp(told.text, "the outline of the area that the close-up shows") == 0;
            told_way |= strcmp(told.text, "in the diagram, the path to the player") == 0;
            told_bar |= strstr(told.text, "in the diagram, a bar: nodes of depth ") == told.text;
        }
        scene_release(&s);
        tick_history_release(&h);
        octree_game_destroy(play.game);
    }
    assert_true(told_scale && told_frame && told_bar && told_way);
}

static void descriptions_of_a_node_and_a_point_are_exact(void **state)
{
    octree_game *game;
    scene s = {0};
    const octree_session session = octree_session_default();
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    (void)state;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    build_tick(&s, &v, game);
    bool found = false;
    for (size_t i = 0; i < s.markers.count; i++) {
        const element_subject subject =
            describe_element(game, NULL, &s, (scene_element){.kind = SCENE_MARKER, .index = i});
        found |= strcmp(subject.text, "point 5 at (-1, 2, 3)") == 0;
    }
    assert_true(found);
    for (size_t i = 0; i < s.boxes.count; i++) {
        if (s.boxes.items[i].style.layer != LAYER_NODES || s.boxes.items[i].id != OCTREE_ROOT)
            continue;
        const element_subject subject =
            describe_element(game, NULL, &s, (scene_element){.kind = SCENE_BOX, .index = i});
        assert_string_equal(subject.text,
                            "node root: inner node at depth 0, 11 points, box (-1000, -1000, -1000) to (1000, 1000, "
                            "1000)");
        assert_string_equal(
            layer_rows[scene_element_head(&s, (scene_element){.kind = SCENE_BOX, .index = i}).style.layer].name,
            "nodes");
    }
    scene_release(&s);
    octree_game_destroy(game);
}

/* Point 2 lies exactly on the boundary of the ball. */
static void marks_of_an_answer_that_differs_at_the_boundary_say_so(void **state)
{
    static const octree_game_body bodies[] = {{.id = 2, .position = {200, 0, 0}}};
    const octree_query ball = {.kind = OCTREE_QUERY_RADIUS, .radius = 200, .answered = true};
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_session session = octree_session_default();
    octree_game *game;
    scene s = {0};
    size_t told = 0;
    (void)state;
    session.player.kind = OCTREE_PLAYER_NONE;
    session.bodies = bodies;
    session.body_count = 1;
    session.queries = &ball;
    session.query_count = 1;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    build_tick(&s, &v, game);
    for (size_t i = 0; i < s.markers.count; i++)
        told += s.markers.items[i].style.layer == LAYER_WRONG &&
                strstr(describe_element(game, NULL, &s, (scene_element){.kind = SCENE_MARKER, .index = i}).text,
                       "the foreign answer to the radius query, which is wrong: 1 missing; all its missing points lie "
                       "on the boundary of the ball") != NULL;
    assert_int_equal(told, 2); /* the ring and the point */
    scene_release(&s);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_element_of_every_layer_is_described),
        cmocka_unit_test(every_element_of_the_golden_frames_is_described_in_a_phrase),
        cmocka_unit_test(descriptions_of_a_node_and_a_point_are_exact),
        cmocka_unit_test(marks_of_an_answer_that_differs_at_the_boundary_say_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
