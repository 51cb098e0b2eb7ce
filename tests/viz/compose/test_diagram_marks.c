/* SPDX-License-Identifier: MIT */
/* test_diagram_marks.c - tests the bold and dashed lines of visited and pruned nodes in the diagram against a recount.
 */
#include "scenes.h"

#include <stdio.h>
#include <string.h>

#include "draw_list.h"
#include "random_session.h"
#include "recount.h"

static bool panel_says(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_TEXT && strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* Return how a query visited a node according to a recount; OCTREE_TRACE_KINDS if none did. */
static unsigned touch_of(const recount *met, octree_address node)
{
    for (size_t i = 0; i < met->count; i++)
        if (met->visits[i].node == node)
            return met->visits[i].touch;
    return OCTREE_TRACE_KINDS;
}

/* Every line of the diagram; those on the way are yellow and bold whatever else. Returns how many are told as met. */
static size_t check_lines(const scene *s, const recount *met, unsigned layers)
{
    size_t told = 0;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *line = &s->segments.items[i];
        if (line->style.layer != LAYER_DIAGRAM || line->style.role == ROLE_PLAYER)
            continue;
        const unsigned touch = touch_of(met, line->id);
        const bool pruned = touch == OCTREE_TRACE_PRUNED && layers >> LAYER_PRUNED & 1;
        const bool visited = touch != OCTREE_TRACE_PRUNED && touch != OCTREE_TRACE_KINDS && layers >> LAYER_VISITED & 1;
        assert_int_equal(line->style.stroke, pruned ? STROKE_DASHED : STROKE_SOLID);
        assert_int_equal(line->style.width, visited ? 2 : 1);
        told += pruned || visited;
    }
    return told;
}

/* The legend says what the marks are, and all that the tick met. */
static void check_legend(const scene *s, const recount *met)
{
    char text[SCENE_TEXT];
    const size_t taken = met->touched[OCTREE_TRACE_TAKEN];
    const size_t visited = met->touched[OCTREE_TRACE_VISITED], pruned = met->touched[OCTREE_TRACE_PRUNED];
    snprintf(text, sizeof text, "%zu node%s visited", visited, visited == 1 ? "" : "s");
    assert_true(!s->tally.marked_visited || panel_says(s, text));
    snprintf(text, sizeof text, "%zu taken whole", taken);
    assert_true(!s->tally.marked_visited || taken == 0 || panel_says(s, text));
    snprintf(text, sizeof text, "%zu node%s pruned", pruned, pruned == 1 ? "" : "s");
    assert_int_equal(panel_says(s, text), s->tally.marked_pruned > 0);
}

static size_t check_session(const octree_session *session, unsigned layers, view_diagram diagram)
{
    view v = view_of(1280, 1440, CAMERA_ISO, layers);
    octree_game *game = start_game(session);
    recount met = {0};
    scene s = {0};
    double before[3];
    size_t told = 0;
    v.diagram = diagram;
    memcpy(before, session->player.position, sizeof before);
    for (int tick = 0; tick < 40; tick++) {
        recount_tick(&met, game, before);
        build_tick(&s, &v, game);
        const size_t marked = check_lines(&s, &met, layers);
        told += marked;
        if (diagram == DIAGRAM_ONLY && layers >> LAYER_PRUNED & 1)
            check_legend(&s, &met);
        memcpy(before, octree_game_tick(game)->player, sizeof before);
        if (octree_game_over(game))
            break;
        play_tick(game);
    }
    recount_free(&met);
    scene_release(&s);
    octree_game_destroy(game);
    return told;
}

static void lines_show_visited_and_pruned_nodes(void **state)
{
    (void)state;
    const octree_session session = session_of_points_with_all_layers();
    for (int diagram = DIAGRAM_BESIDE; diagram <= DIAGRAM_ONLY; diagram++)
        assert_true(check_session(&session, VIEW_DEFAULT_LAYERS, (view_diagram)diagram) > 100);
    for (uint64_t seed = 1; seed <= 8; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session, VIEW_DEFAULT_LAYERS, DIAGRAM_ONLY);
    }
}

static void diagram_ignores_hidden_layers(void **state)
{
    (void)state;
    const octree_session session = session_of_points_with_all_layers();
    const unsigned visited = 1u << LAYER_VISITED, pruned = 1u << LAYER_PRUNED;
    assert_true(check_session(&session, VIEW_DEFAULT_LAYERS & ~pruned, DIAGRAM_BESIDE) > 0);
    assert_true(check_session(&session, VIEW_DEFAULT_LAYERS & ~visited, DIAGRAM_BESIDE) > 0);
    assert_int_equal(check_session(&session, VIEW_DEFAULT_LAYERS & ~visited & ~pruned, DIAGRAM_BESIDE), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_show_visited_and_pruned_nodes),
        cmocka_unit_test(diagram_ignores_hidden_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
