/* SPDX-License-Identifier: MIT */
/* velocity_layer.c - the layer of velocities: an arrow for each moving point that the view shows.
 *
 * An arrow starts at the point and follows the point's velocity for count_velocity_ticks() ticks. If the arrow meets
 * the world's bounds earlier, it ends at the bounds, because the point bounces there. The number of ticks depends only
 * on the session, so readers can compare lengths from tick to tick. A point whose arrow would have no length gets no
 * arrow.
 *
 * The arrows of a large session would cover the picture, so there is at most one arrow per thousand boxes of the view's
 * budget. Arrows are chosen with the sieve that also drops points (node_boxes.h), beginning with the sieve that dropped
 * points from this scene. So an arrow is never shown without its point, and the same points keep their arrows from tick
 * to tick. A first pass counts how many arrows each of the 65 sieves would keep, by the number of zero bits at the end
 * of each id's digest. A second pass uses the coarsest sieve that keeps the number of arrows within the limit, and adds
 * the arrows that this sieve keeps. The cost is O(movers), whatever the budget. Arrows shorter than the view's lod are
 * left out and counted. */
#include "velocity_layer.h"
#include "layer_type.h"
#include "node_boxes.h"
#include "octree/octree.h"
#include "text.h"

#include <math.h>
#include <string.h>

#define ARROW_FRACTION 10      /* the longest arrow is at most a tenth of the world's longest side */
#define BOXES_PER_ARROW 1000.0 /* at most one arrow per thousand boxes of the view's budget */

unsigned count_velocity_ticks(const octree_game *game)
{
    static const unsigned choices[] = {2, 5, 10, 20, 50, 100, 200, 500, 1000};
    const octree_box *world = &octree_game_session(game)->tree.world;
    const double speed = octree_game_fastest(game);
    double half = 0; /* half the world's longest side; the whole side could overflow */
    unsigned ticks = 1;
    for (int axis = 0; axis < 3; axis++)
        half = fmax(half, world->max[axis] / 2 - world->min[axis] / 2);
    for (size_t i = 0; speed > 0 && i < sizeof choices / sizeof choices[0]; i++)
        if (speed * choices[i] <= half * 2 / ARROW_FRACTION)
            ticks = choices[i];
    return ticks;
}

static double clamp(double value, double low, double high)
{
    value = value > low ? value : low;
    return value < high ? value : high;
}

/* Compute a body's position after a number of ticks. If the body meets the world's bounds earlier, compute the position
 * where it meets the bounds. */
static void extrapolate_position(const octree_game_body *body, const octree_box *world, double ticks, double end[3])
{
    int stops = -1; /* the axis whose bound the body meets first; -1: it meets none */
    for (int i = 0; i < 3; i++) {
        const double bound = body->velocity[i] > 0 ? world->max[i] : world->min[i];
        const double room = body->velocity[i] != 0 ? (bound - body->position[i]) / body->velocity[i] : ticks;
        stops = room < ticks ? i : stops;
        ticks = room < ticks ? room : ticks;
    }
    for (int i = 0; i < 3; i++)
        end[i] = clamp(body->position[i] + body->velocity[i] * ticks, world->min[i], world->max[i]);
    if (stops >= 0)
        end[stops] = body->velocity[stops] > 0 ? world->max[stops] : world->min[stops];
}

/* Return whether an arrow appears shorter on screen than the view's lod. */
static bool is_arrow_below_lod(const scene *s, double ends[2][3])
{
    double from[2], to[2];
    return s->view.lod > 0 && camera_find_pixel(&s->camera, ends[0], from) &&
           camera_find_pixel(&s->camera, ends[1], to) &&
           fmax(fabs(to[0] - from[0]), fabs(to[1] - from[1])) < s->view.lod;
}

/* The data that all arrows of a tick share. */
typedef struct arrow_context {
    const scene *scene;
    const layer_source *in;
    double ticks; /* an arrow shows the movement of this many ticks */
} arrow_context;

/* Compute the end of a body's arrow. Return false if the arrow would have no length. */
static bool find_arrow_end(const arrow_context *a, const octree_game_body *body, double end[3])
{
    extrapolate_position(body, &a->in->world, a->ticks, end);
    return memcmp(body->position, end, sizeof body->position) != 0;
}

/* Return whether a body gets an arrow: the view shows the body, and the arrow's length is not 0. The exact end of the
 * arrow is computed only if the body may leave the world's bounds, or moves so little that rounding could hide the
 * movement. */
static bool has_arrow(const arrow_context *a, const octree_game_body *body)
{
    const octree_box *world = &a->in->world;
    bool within = true, far = false;
    double end[3];
    for (int i = 0; i < 3; i++) {
        const double at = body->position[i], step = body->velocity[i] * a->ticks;
        within &= (at + step > world->min[i]) & (at + step < world->max[i]);
        far |= fabs(step) > fabs(at) * 1e-9;
    }
    return ((within && far) || find_arrow_end(a, body, end)) &&
           is_position_shown(&a->scene->view.filter, a->in->tree, &a->in->world, body->position);
}

/* Return the number of bits of the finest sieve that keeps an id, which is the number of zero bits at the end of the
 * id's digest. */
static unsigned count_passed_sieves(uint64_t id)
{
    const uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id); /* as in sieve_rejects_id() */
    unsigned passed = 0;
    while (passed < ARROW_SIEVES - 1 && !(digest >> passed & 1))
        passed++;
    return passed;
}

/* Count the arrows that each sieve keeps. */
static void count_arrows(const arrow_context *a, size_t passing[ARROW_SIEVES])
{
    const octree_tick *tick = a->in->tick;
    memset(passing, 0, ARROW_SIEVES * sizeof *passing);
    for (size_t i = 0; i < tick->mover_count; i++)
        if (has_arrow(a, &tick->movers[i]))
            passing[count_passed_sieves(tick->movers[i].id)]++;
    for (unsigned bits = ARROW_SIEVES - 1; bits-- > 0;)
        passing[bits] += passing[bits + 1];
}

/* Return the number of arrows that each sieve keeps. If the view has no filter, the counts are kept in in->arrows for
 * the other pictures of the tick; otherwise, or if in->arrows is null, they are stored in *own. */
static const size_t *find_arrow_counts(const arrow_context *a, arrow_counts *own)
{
    const bool shared = a->in->arrows && !filter_is_set(&a->scene->view.filter);
    arrow_counts *counts = shared ? a->in->arrows : own;
    if (!counts->known)
        count_arrows(a, counts->passing);
    counts->known = true;
    return counts->passing;
}

/* Choose how many velocity arrows are drawn. Return the coarsest sieve, at least as fine as `sieve`, that keeps at most
 * one arrow per BOXES_PER_ARROW boxes of the view's budget; this limit is at least one arrow. Store the number of
 * dropped arrows in the tally. */
static uint64_t choose_sieve_of_arrows(scene *s, const arrow_context *a, uint64_t sieve)
{
    arrow_counts own = {.known = false};
    const size_t *passing = find_arrow_counts(a, &own);
    const size_t most = s->view.budget ? (size_t)ceil((double)s->view.budget / BOXES_PER_ARROW) : SIZE_MAX;
    unsigned bits = 0;
    while (sieve >> bits & 1)
        bits++;
    for (; bits < ARROW_SIEVES - 1 && passing[bits] > most; bits++)
        sieve = make_finer_sieve(sieve);
    s->tally.arrows.thinned = passing[0] - passing[bits];
    s->tally.arrows.one_in = sieve + 1;
    return sieve;
}

static void add_velocities(scene *s, const layer_source *in, view_layer layer)
{
    const octree_tick *tick = in->tick;
    const arrow_context a = {s, in, count_velocity_ticks(in->game)};
    if (!view_shows_layer(&s->view, layer) || tick->mover_count == 0)
        return;
    /* The sieve that dropped points from this scene. A dropped point gets no arrow, so the arrows use the same or a
     * finer sieve. */
    const uint64_t points = s->tally.one_in - 1;
    const uint64_t sieve = choose_sieve_of_arrows(s, &a, points);
    for (size_t i = 0; i < tick->mover_count; i++) {
        const octree_game_body *body = &tick->movers[i];
        scene_segment arrow = {.id = body->id, .style = make_layer_style(LAYER_VELOCITIES, STROKE_ARROW, 1)};
        if (sieve_rejects_id(sieve, body->id) || !find_arrow_end(&a, body, arrow.ends[1]) ||
            !is_position_shown(&s->view.filter, in->tree, &in->world, body->position))
            continue;
        memcpy(arrow.ends[0], body->position, sizeof arrow.ends[0]);
        if (is_arrow_below_lod(s, arrow.ends))
            s->tally.arrows.small++;
        else
            scene_add_segment(s, arrow);
    }
}

static bool has_movers(const layer_source *in)
{
    return in->game && (in->tick->mover_count > 0 || octree_game_fastest(in->game) > 0);
}

static void add_velocity_legend(legend *l, const layer_source *in)
{
    const unsigned ticks = count_velocity_ticks(in->game);
    legend_add(l, SIGN_ARROW, "velocity, %u tick%s", ticks, plural_ending(ticks));
}

static void describe_arrow(description *d, const described_element *element)
{
    for (size_t i = 0; i < d->tick->mover_count; i++) {
        const octree_game_body *body = &d->tick->movers[i];
        if (body->id != element->id)
            continue;
        describe_point(d, "the velocity of ", body->id, body->position);
        append_position(d, ": ", body->velocity);
        append_text(d, " per tick; the arrow shows the motion of %u tick%s", count_velocity_ticks(d->game),
                    plural_ending(count_velocity_ticks(d->game)));
    }
}

const layer_type layer_VELOCITIES = {.applies = has_movers,
                                     .add = add_velocities,
                                     .legend = {.order = 40, .add_lines = add_velocity_legend},
                                     .describe = describe_arrow};
