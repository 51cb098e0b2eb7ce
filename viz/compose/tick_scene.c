/* SPDX-License-Identifier: MIT */
/* tick_scene.c - contains the table of layers, and composes scenes from the layers. */
#include "tick_scene.h"
#include "closeup.h"
#include "kept_tree.h"
#include "layer_type.h"
#include "layout.h"
#include "octree/octree.h"
#include "point_names.h"

#define LAYER_TYPE(layer, ...) &layer_##layer,
const layer_type *const layer_types[LAYER_ALL] = {LAYER_MAP(LAYER_TYPE)};

bool is_game_scene(const layer_source *in)
{
    return in->game != NULL;
}

view_layer layer_of_query(octree_query_kind kind)
{
#define LAYER_OF_QUERY(kind, ...) LAYER_##kind,
    static const view_layer layers[] = {OCTREE_QUERY_MAP(LAYER_OF_QUERY)};
    return layers[kind];
}

static void add_layer(scene *s, const layer_source *in, view_layer layer)
{
    const layer_type *type = layer_types[layer];
    if (type->applies && !type->applies(in))
        return;
    if (type->add)
        type->add(s, in, layer);
    for (size_t i = 0; type->add_answer && i < in->answer_count; i++)
        if (layer_of_query(in->answers[i].kind) == layer)
            type->add_answer(s, in, i, layer);
}

/* Add all layers. The names of points take the room that other labels leave. The panel comes last because it counts
 * what the other layers left out. */
static void add_layers(scene *s, const layer_source *in)
{
    for (int i = 0; i < LAYER_ALL; i++)
        if (i != LAYER_TEXT)
            add_layer(s, in, (view_layer)i);
    add_point_names(s, in);
    add_layer(s, in, LAYER_TEXT);
}

/* Returns whether all markers in a close-up are the player's: the close-up shows neither a point nor an answer. */
static bool shows_only_player(const scene *closeup, const layer_source *in)
{
    size_t i = 0;
    while (i < closeup->markers.count && closeup->markers.items[i].id == in->session->player.id)
        i++;
    return i == closeup->markers.count;
}

/* Build the close-up: a scene of its own, with the layers of the main scene except the world and the text. A close-up
 * that would show only the player is left out. */
static void add_closeup(scene *s, const layer_source *in, const double place[3], double times)
{
    layer_source close;
    if (!closeup_begin(s, in, place, times, &close)) {
        s->out_of_memory = true;
        return;
    }
    add_layers(s->closeup, &close);
    s->out_of_memory |= s->closeup->out_of_memory;
    s->has_closeup = !(in->tick && in->tick->has_player && shows_only_player(s->closeup, in));
}

/* Prepare the results that the history keeps for one tick. If the scene of another tick is built, forget the old
 * results: the history may end one tick before the tick of the scene. The tick of a tree without a game is 0. */
static void prepare_kept_results(tick_history *h, layer_source *in)
{
    const uint64_t tick = in->tick ? in->tick->number : 0;
    if (h->state == 0 || h->built != tick) {
        h->check.done = h->arrows.known = false;
        h->built = tick;
        h->state = kept_tree_make_unique_name();
    }
    in->state = h->state;
}

/* Check the tree, unless it was checked before. */
static void check_tree_once(layer_source *in, tick_check *check)
{
    if (!check->done)
        check->broken = octree_check(in->tree, &check->where);
    check->done = true;
    in->broken = check->broken;
    in->broken_at = check->where;
}

/* Build the scene of a tick, or of a tree without a game. With DIAGRAM_ONLY only the diagram and the text column are
 * added. */
static bool build_scene(scene *s, layer_source *in, closeup_course course, tick_check *check)
{
    const view *v = in->view;
    scene_clear(s);
    scene_set_view(s, v);
    if (v->diagram == DIAGRAM_ONLY)
        s->view.layers &= 1u << LAYER_TEXT;
    if (!(course.reach > 0))
        closeup_course_update(&course, in);
    const double times = closeup_magnification(&course, in);
    s->has_closeup = times > 0;
    s->camera =
        camera_make(v, layout_camera_area(s, &in->world), &in->world, find_player(in), in->tick ? in->tick->number : 0);
    if (view_shows_layer(v, LAYER_BROKEN))
        check_tree_once(in, check);
    if (s->has_closeup)
        add_closeup(s, in, course.place, times);
    s->has_closeup = s->has_closeup && !s->out_of_memory;
    add_layers(s, in);
    return !s->out_of_memory;
}

static layer_source make_layer_source(const view *v, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    return (layer_source){.view = v,
                          .tree = octree_game_tree(game),
                          .world = octree_game_session(game)->tree.world,
                          .answers = tick->answers,
                          .answer_count = tick->answer_count,
                          .game = game,
                          .session = octree_game_session(game),
                          .tick = tick};
}

void tick_history_release(tick_history *h)
{
    heat_release(&h->heat);
    node_changes_release(&h->changes);
}

bool tick_history_add(tick_history *h, const view *v, const octree_game *game)
{
    const layer_source in = make_layer_source(v, game);
    h->state = 0;
    if (in.tick->gap)
        return true;
    closeup_course_update(&h->closeup, &in);
    return node_changes_end_tick(&h->changes, game) &&
           (!(v->layers & VIEW_HEAT_LAYERS) || heat_add_tick(&h->heat, game));
}

bool tick_scene_build(scene *s, const view *v, const octree_game *game, tick_history *h, const point_values *values)
{
    layer_source in = make_layer_source(v, game);
    tick_check check = {0};
    if (h)
        prepare_kept_results(h, &in);
    in.heat = h ? &h->heat : NULL;
    in.arrows = h ? &h->arrows : NULL;
    in.values = values;
    return build_scene(s, &in, h ? h->closeup : (closeup_course){0}, h ? &h->check : &check);
}

bool tree_scene_build(scene *s, const view *v, const octree *tree, const tree_subject *subject)
{
    layer_source in = {.view = v,
                       .tree = tree,
                       .world = octree_definition(tree).world,
                       .answers = subject->answers,
                       .answer_count = subject->answer_count,
                       .values = subject->values,
                       .title = subject->title,
                       .requested = subject->node};
    tick_history *h = subject->history;
    if (h)
        prepare_kept_results(h, &in);
    return build_scene(s, &in, (closeup_course){0}, h ? &h->check : &(tick_check){0});
}
