/* SPDX-License-Identifier: MIT */
/* velocity_layer.c - the layer of velocities: for each point that moves and that the view shows an arrow with its id,
 * from where it is along its velocity, up to the world's bounds, where it bounces. Arrows beyond the budget, a
 * thousandth of the view's since more would be indistinct, and arrows shorter than the view's lod are left out and
 * counted. */
#include "velocity_layer.h"
#include "layer_type.h"
#include "node_boxes.h"
#include "octree/octree.h"
#include "text.h"

#include <math.h>
#include <string.h>

#define ARROW_FRACTION 10      /* of the world's longest side: the fastest arrow */
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
        if (speed * choices[i] <= half * 2 / ARROW_FRACTION)
            ticks = choices[i];
    return ticks;
}

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

/* Its position after so many ticks, or where it meets the bounds before. */
static void extrapolate(const octree_body *body, const octree_box *world, double ticks, double end[3])
{
    int stops = -1; /* the axis whose bound it meets */
    for (int i = 0; i < 3; i++) {
        const double bound = body->velocity[i] > 0 ? world->max[i] : world->min[i];
        const double room = body->velocity[i] != 0 ? (bound - body->position[i]) / body->velocity[i] : ticks;
        stops = room < ticks ? i : stops;
        ticks = lesser(ticks, room);
    }
    for (int i = 0; i < 3; i++)
        end[i] = lesser(greater(body->position[i] + body->velocity[i] * ticks, world->min[i]), world->max[i]);
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

/* What is the same for all arrows of a tick. */
typedef struct arrows {
    const scene *scene;
    const octree *tree;
    const octree_box *world;
    double ticks;
} arrows;

/* Whether a body gets on, to this end. */
static bool find_arrow_end(const arrows *a, const octree_body *body, double end[3])
{
    extrapolate(body, a->world, a->ticks, end);
    return memcmp(body->position, end, sizeof body->position) != 0;
}

/* The same without the end, which most need not look for: they meet no bound, and go far enough for a double to tell,
 * however the bounds are rounded. */
static bool has_length(const arrows *a, const octree_body *body)
{
    bool within = true, far = false;
    double end[3];
    for (int i = 0; i < 3; i++) {
        const double at = body->position[i], way = body->velocity[i] * a->ticks;
        within &= (at + way > a->world->min[i]) & (at + way < a->world->max[i]);
        far |= fabs(way) > fabs(at) * 1e-9;
    }
    return (within && far) || find_arrow_end(a, body, end);
}

/* Whether a body has an arrow: it has none where it does not get on, or the view does not show it. */
static bool has_arrow(const arrows *a, const octree_body *body)
{
    return has_length(a, body) && is_shown(a->scene, a->tree, a->world, body->position);
}

/* Sieves are all ones: an id passes those of no more bits than its digest ends with zeros. */
enum { SIEVES = 65 };

static unsigned count_passed_sieves(uint64_t id)
{
    unsigned passed = 0;
    for (uint64_t sieve = 1; passed < SIEVES - 1 && !sieve_drops(sieve, id); sieve <<= 1)
        passed++;
    return passed;
}

/* At least one, so that there is something to see. */
static size_t max_arrows(const view *v)
{
    return v->budget ? (size_t)ceil((double)v->budget / BOXES_PER_ARROW) : SIZE_MAX;
}

/* The first sieve from this one on that lets pass no more arrows than the view's budget has; notes what it leaves out.
 */
static uint64_t choose_sieve(scene *s, const arrows *a, const octree_tick *tick, uint64_t sieve)
{
    size_t passing[SIEVES] = {0}, all = 0; /* at first: those that are dropped by the next finer one */
    for (size_t i = 0; i < tick->mover_count; i++)
        if (has_arrow(a, &tick->movers[i]))
            passing[count_passed_sieves(tick->movers[i].id)]++;
    for (unsigned bits = SIEVES; bits-- > 0;)
        passing[bits] = all += passing[bits];
    unsigned bits = 0;
    while (sieve >> bits & 1)
        bits++;
    for (; bits < SIEVES - 1 && passing[bits] > max_arrows(&s->view); bits++)
        sieve = finer_sieve(sieve);
    s->tally.arrows.thinned = all - passing[bits];
    s->tally.arrows.one_in = sieve + 1;
    return sieve;
}

static void add(scene *s, const layer_source *in, view_layer own)
{
    const octree_tick *tick = in->tick;
    const arrows a = {s, octree_game_tree(in->game), &octree_game_session(in->game)->tree.world,
                      velocity_ticks(in->game)};
    if (!view_shows(&s->view, own) || tick->mover_count == 0)
        return;
    const uint64_t points = s->tally.one_in - 1; /* arrows of points that are left out are left out with them */
    const uint64_t sieve = choose_sieve(s, &a, tick, points);
    for (size_t i = 0; i < tick->mover_count; i++) {
        const octree_body *body = &tick->movers[i];
        scene_segment arrow = {.id = body->id, .style = layer_style(LAYER_VELOCITIES, STROKE_ARROW, 1)};
        if (sieve_drops(sieve, body->id) || !find_arrow_end(&a, body, arrow.ends[1]) ||
            !is_shown(s, a.tree, a.world, body->position))
            continue;
        memcpy(arrow.ends[0], body->position, sizeof arrow.ends[0]);
        if (is_small(s, arrow.ends))
            s->tally.arrows.small++;
        else
            scene_add_segment(s, arrow);
    }
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

static void describe(description *d, const described_element *element)
{
    for (size_t i = 0; i < d->tick->mover_count; i++) {
        const octree_body *body = &d->tick->movers[i];
        if (body->id != element->id)
            continue;
        append_text(d, "the velocity of ");
        describe_point(d, body->id, body->position);
        append_text(d, ": ");
        append_position(d, body->velocity);
        append_text(d, " per tick, drawn for %u tick%s", velocity_ticks(d->game), plural(velocity_ticks(d->game)));
    }
}

const layer_type layer_VELOCITIES = {
    .applies = applies, .add = add, .legend_place = 40, .legend = add_legend, .describe = describe};
