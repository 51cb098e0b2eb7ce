/* SPDX-License-Identifier: MIT */
/* velocity_layer.c - the layer of velocities: for each point that moves and that the view shows an arrow with its id,
 * from where it is along its velocity, up to the world's bounds, where it bounces. Arrows beyond the budget, a
 * thousandth of the view's since more would be indistinct, and arrows shorter than the view's lod are left out and
 * counted. */
#include "velocity_layer.h"
#include "layer_type.h"
#include "node_boxes.h"
#include "text.h"

#include <math.h>
#include <string.h>

#define PART 10                /* of the world's longest side: the fastest arrow */
#define BOXES_PER_ARROW 1000.0 /* of the budget, for which there is one arrow: some hundreds can be told apart */

unsigned velocity_ticks(const octree_game *game)
{
    static const unsigned choices[] = {2, 5, 10, 20, 50, 100, 200, 500, 1000};
    const octree_box *world = &octree_game_session(game)->tree.world;
    const double speed = octree_game_fastest(game);
    double half = 0; /* of the longest side, which may be more than a double holds */
    unsigned ticks = 1;
    for (int axis = 0; axis < 3; axis++)
        half = fmax(half, world->max[axis] / 2 - world->min[axis] / 2);
    for (size_t i = 0; speed > 0 && i < sizeof choices / sizeof choices[0]; i++)
        if (speed * choices[i] <= half * 2 / PART)
            ticks = choices[i];
    return ticks;
}

/* Its position after so many ticks, or where it meets the bounds before. */
static void go_on(const octree_body *body, const octree_box *world, double ticks, double end[3])
{
    int stops = -1; /* the axis whose bound it meets */
    for (int i = 0; i < 3; i++) {
        const double bound = body->velocity[i] > 0 ? world->max[i] : world->min[i];
        const double room = body->velocity[i] != 0 ? (bound - body->position[i]) / body->velocity[i] : ticks;
        stops = room < ticks ? i : stops;
        ticks = fmin(ticks, room);
    }
    for (int i = 0; i < 3; i++)
        end[i] = fmin(fmax(body->position[i] + body->velocity[i] * ticks, world->min[i]), world->max[i]);
    if (stops >= 0)
        end[stops] = body->velocity[stops] > 0 ? world->max[stops] : world->min[stops];
}

/* Whether the view shows the point: its leaf, and its place. */
static bool is_shown(const scene *s, const octree *tree, const octree_box *world, const double position[3])
{
    const view_filter *f = &s->view.filter;
    octree_node leaf;
    return !filter_is_on(f) || (filter_shows_point(f, position) && octree_locate(tree, position, &leaf) == OCTREE_OK &&
                                filter_shows_points_of(f, world, &leaf));
}

/* Shorter than the view's lod, as it appears. */
static bool is_small(const scene *s, double ends[2][3])
{
    double from[2], to[2];
    return s->view.lod > 0 && camera_pixel(&s->camera, ends[0], from) && camera_pixel(&s->camera, ends[1], to) &&
           fmax(fabs(to[0] - from[0]), fabs(to[1] - from[1])) < s->view.lod;
}

/* The arrow of a body; false when it has none, or the view does not show the body. */
static bool make_arrow(const scene *s, const octree_game *game, const octree_body *body, double ticks,
                       scene_segment *arrow)
{
    const octree_box *world = &octree_game_session(game)->tree.world;
    *arrow = (scene_segment){
        .id = body->id,
        .style = layer_style(LAYER_VELOCITIES, STROKE_ARROW, 1),
    };
    memcpy(arrow->ends[0], body->position, sizeof arrow->ends[0]);
    go_on(body, world, ticks, arrow->ends[1]);
    return memcmp(arrow->ends[0], arrow->ends[1], sizeof arrow->ends[0]) != 0 &&
           is_shown(s, octree_game_tree(game), world, body->position);
}

/* The arrows that pass a sieve. */
static size_t count_arrows(const scene *s, const octree_game *game, double ticks, uint64_t sieve)
{
    const octree_tick *tick = octree_game_tick(game);
    scene_segment arrow;
    size_t count = 0;
    for (size_t i = 0; i < tick->mover_count; i++)
        count += !sieve_drops(sieve, tick->movers[i].id) && make_arrow(s, game, &tick->movers[i], ticks, &arrow);
    return count;
}

/* At least one, so that there is something to see. */
static size_t most_arrows(const view *v)
{
    return v->budget ? (size_t)ceil((double)v->budget / BOXES_PER_ARROW) : SIZE_MAX;
}

static void add(scene *s, const layer_source *in, view_layer own)
{
    const octree_game *game = in->game;
    const octree_tick *tick = in->tick;
    const double ticks = velocity_ticks(game);
    uint64_t sieve = s->tally.one_in - 1; /* those of points that are left out are left out with them */
    if (!view_shows(&s->view, own) || tick->mover_count == 0)
        return;
    const size_t all = count_arrows(s, game, ticks, 0);
    size_t left = count_arrows(s, game, ticks, sieve);
    for (; left > most_arrows(&s->view); left = count_arrows(s, game, ticks, sieve))
        sieve = sieve_finer(sieve);
    for (size_t i = 0; i < tick->mover_count; i++) {
        scene_segment arrow;
        if (sieve_drops(sieve, tick->movers[i].id) || !make_arrow(s, game, &tick->movers[i], ticks, &arrow))
            continue;
        if (is_small(s, arrow.ends))
            s->tally.arrows.small++;
        else
            scene_add_segment(s, arrow);
    }
    s->tally.arrows.thinned = all - left;
    s->tally.arrows.one_in = sieve + 1;
}

static bool applies(const layer_source *in)
{
    return in->game && (in->tick->mover_count > 0 || octree_game_fastest(in->game) > 0);
}

static void add_legend(legend *l, const layer_source *in)
{
    const unsigned ticks = velocity_ticks(in->game);
    legend_add(l, SIGN_ARROW, "velocity, %u tick%s", ticks, plural(ticks));
}

static void describe(description *d, const described *element)
{
    for (size_t i = 0; i < d->tick->mover_count; i++) {
        const octree_body *body = &d->tick->movers[i];
        if (body->id != element->id)
            continue;
        say(d, "the velocity of ");
        say_point(d, body->id, body->position);
        say(d, ": ");
        say_place(d, body->velocity);
        say(d, " a tick, drawn for %u", velocity_ticks(d->game));
    }
}

const layer_type layer_VELOCITIES = {
    .applies = applies, .add = add, .legend_place = 40, .legend = add_legend, .describe = describe};
