/* SPDX-License-Identifier: MIT */
/* knob_tick.c - the length of a tick: one flight, played in 1, 2, 4 ... 64 steps. */
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "exact_oracle.h"
#include "knob.h"
#include "octree/game.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "ticks of the flight", NULL},
    {"flights", "flights that truly end at a point", NULL},
    {"flown_past", "of them did not stop before the point that is first in the way", "bound_past"},
    {"worst_error", "the worst distance of the stop from the true one, in lengths of the flight", "bound_error"},
    {"mean_error", "the mean of it", NULL},
    {"bound_error", "proven: a step; without sweep nothing, the whole flight", NULL},
    {"bound_past", "proven", NULL},
    {"false", "stops where nothing was in the way", "0"},
    {"ns", "processor nanoseconds a flight", NULL},
    {"nodes", "nodes visited by the collision tests of a flight", NULL},
    {"points", "points compared by them", NULL},
};

static const chart charts[] = {
    {.title = "Error of the place where a flight ends",
     .x = "setting",
     .y = "worst_error",
     .bound = "bound_error",
     .x_log = true,
     .y_log = true},
    {.title = "Time of a flight", .x = "setting", .y = "ns", .x_log = true, .y_log = true},
};

static const gain gains[] = {
    {"4 ticks instead of 64", {.variant = "ends", .setting = 64}, {.variant = "ends", .setting = 4}, "ns"},
};

enum { LENGTH = 1024, BODIES = 1200, TICKS_AT_MOST = 64 };
static const double half = 32; /* of the player's box */

/* A flight along +x from the origin of all. Places are whole numbers and ways multiples of 64, so that every step of
 * every body is exact however many there are. */
typedef struct flight {
    octree_game_body bodies[BODIES]; /* with the whole way for a velocity; first those that are touched on it */
    size_t count, touched;
    double from[3];
} flight;

static void place_after(const octree_game_body *body, double share, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = body->position[axis] + share * body->velocity[axis];
}

/* Whether the player touches a body in a part of the flight. */
static bool touches(const flight *f, const octree_game_body *body, double first, double last)
{
    double p[3], q[3];
    const double from[3] = {f->from[0] + first * LENGTH, f->from[1], f->from[2]};
    const double to[3] = {f->from[0] + last * LENGTH, f->from[1], f->from[2]};
    place_after(body, first, p);
    place_after(body, last, q);
    return exact_touches(from, to, half, p, q, NULL);
}

static bool is_free(const flight *f, double first, double last)
{
    for (size_t i = 0; i < f->touched; i++)
        if (touches(f, &f->bodies[i], first, last))
            return false;
    return true;
}

static double whole(uint64_t *random, double low, double high)
{
    return low + (double)random_below(random, (uint64_t)(high - low) + 1);
}

static void make_flight(flight *f, uint64_t *random)
{
    *f = (flight){.from = {-LENGTH / 2, whole(random, -200, 200), whole(random, -200, 200)}};
    for (uint64_t id = 1; id <= BODIES; id++) {
        octree_game_body body = {.id = id};
        for (int axis = 0; axis < 3; axis++) {
            const double to = 64 * whole(random, -6, 6);
            body.position[axis] = whole(random, -1000, 1000);
            body.velocity[axis] = fabs(body.position[axis] + to) <= 1024 ? to : 0; /* it must not bounce */
        }
        if (touches(f, &body, 0, 0))
            continue;
        f->bodies[f->count++] = body;
        if (touches(f, &body, 0, 1)) {
            f->bodies[f->count - 1] = f->bodies[f->touched];
            f->bodies[f->touched++] = body;
        }
    }
}

/* The share of the flight until the first touch, 1 when there is none: a touch within the first t of the way is decided
 * exactly, for more and more exact t. */
static double true_stop(const flight *f)
{
    double free = 0, touched = 1;
    if (is_free(f, 0, 1))
        return 1;
    for (int i = 0; i < 40; i++) {
        const double middle = (free + touched) / 2;
        *(is_free(f, 0, middle) ? &free : &touched) = middle;
    }
    return free;
}

/* ---- Playing ------------------------------------------------------------------------------------------------ */

typedef struct playing {
    const flight *flights;
    size_t count, ticks;
    bool sweep;
    double *stops;     /* of each flight: the share of it that was flown */
    octree_cost *cost; /* of all collision tests */
} playing;

static double play(const flight *f, size_t ticks, bool sweep, octree_cost *cost)
{
    octree_game_body bodies[BODIES];
    memcpy(bodies, f->bodies, f->count * sizeof *bodies);
    for (size_t i = 0; i < f->count; i++)
        for (int axis = 0; axis < 3; axis++)
            bodies[i].velocity[axis] /= (double)ticks;
    octree_session session = {
        .tree = define(cube(-1024, 1024), 64, OCTREE_MAX_DEPTH, OCTREE_GROW), .bodies = bodies, .body_count = f->count};
    session.player = (octree_player){.step = LENGTH / (double)ticks, .box_size = half, .sweep = sweep};
    memcpy(session.player.position, f->from, sizeof f->from);
    octree_game *game;
    size_t flown = 0;
    must(octree_game_create(&session, &game));
    for (; flown < ticks; flown++) {
        must(octree_game_step(game, 'd'));
        const octree_cost *test = &octree_game_tick(game)->hit_cost;
        cost->nodes += test->nodes;
        cost->points += test->points;
        if (octree_game_tick(game)->events & OCTREE_EVENT_COLLIDED)
            break;
    }
    octree_game_destroy(game);
    return (double)flown / (double)ticks;
}

static void play_all(void *contestant)
{
    const playing *p = contestant;
    for (size_t i = 0; i < p->count; i++)
        p->stops[i] = play(&p->flights[i], p->ticks, p->sweep, p->cost);
}

static void add_row(table *t, const playing *p, const double *truth, double ns)
{
    size_t ended = 0, past = 0, wrong = 0;
    double worst = 0, sum = 0;
    const double step = 1 / (double)p->ticks;
    for (size_t i = 0; i < p->count; i++) {
        const double stop = p->stops[i], error = fabs(stop - truth[i]);
        const bool ends = truth[i] < 1, late = !is_free(&p->flights[i], 0, stop);
        ended += ends;
        past += late;
        /* A stop in a step in which nothing is touched. */
        wrong += !late && stop < 1 && is_free(&p->flights[i], stop, stop + step);
        worst = fmax(worst, error);
        sum += error;
    }
    table_add(t, "game", p->sweep ? "swept" : "ends",
              (double[]){(double)p->ticks, (double)ended, (double)past, worst, sum / (double)p->count,
                         p->sweep ? step : 1, p->sweep ? 0 : NAN, (double)wrong, ns / (double)p->count,
                         (double)p->cost->nodes / (double)p->count, (double)p->cost->points / (double)p->count});
}

static void measure(const run *r, table *t)
{
    const size_t count = r->quick ? 4 : 60;
    flight *flights = resize_memory(NULL, count * sizeof *flights);
    double *truth = resize_memory(NULL, count * sizeof *truth), *stops[2];
    uint64_t random = 11;
    for (size_t i = 0; i < count; i++) {
        make_flight(&flights[i], &random);
        truth[i] = true_stop(&flights[i]);
    }
    for (int i = 0; i < 2; i++)
        stops[i] = resize_memory(NULL, count * sizeof *stops[i]);
    for (size_t ticks = 1; ticks <= TICKS_AT_MOST; ticks *= 2) {
        octree_cost costs[2] = {{0}};
        playing ways[] = {{flights, count, ticks, false, stops[0], &costs[0]},
                          {flights, count, ticks, true, stops[1], &costs[1]}};
        double ns[2];
        time_in_turn(play_all, ways, sizeof ways[0], 2, 1, ns);
        for (int i = 0; i < 2; i++)
            add_row(t, &ways[i], truth, ns[i]);
    }
    free(flights);
    free(truth);
    free(stops[0]);
    free(stops[1]);
}

static void tell(const table *t, FILE *out)
{
    const pick any = {.setting = NAN};
    fprintf(out, "The ends of a tick alone are the default; of %.0f flights that end at a point",
            table_most(t, any, "flights"));
    static const double told[] = {4, 16, 64};
    for (size_t i = 0; i < 3; i++)
        fprintf(out, "%s %.0f flew past it in %g ticks", i == 0 ? "" : ",",
                table_sum(t, (pick){.variant = "ends", .setting = told[i]}, "flown_past"), told[i]);
    const pick swept = {.variant = "swept", .setting = 4}, ends = {.variant = "ends", .setting = 4};
    fprintf(out,
            "; swept %.0f did, at any length of a tick, and in 4 ticks it stopped within %.3f of the flight (proven "
            "%.3f) for %.2f x the time of the ends, where 64 ticks take %.1f x.",
            table_sum(t, (pick){.variant = "swept", .setting = NAN}, "flown_past"), table_most(t, swept, "worst_error"),
            table_most(t, swept, "bound_error"), table_ratio(t, swept, ends, "ns"),
            table_ratio(t, (pick){.variant = "ends", .setting = 64}, ends, "ns"));
}

static void defend(const table *t, FILE *out)
{
    const double ticks = LENGTH / (2 * half); /* a box each */
    const pick ends = {.variant = "ends", .setting = ticks}, swept = {.variant = "swept", .setting = ticks};
    fprintf(out,
            "The paper's step without sweep is kept: its points rest, and of what rests a step of up to a box along an "
            "axis misses none. Among points that move, steps of a box flew past %.0f of %.0f: there use sweep, which "
            "takes %.2f x the time.",
            table_sum(t, ends, "flown_past"), table_most(t, ends, "flights"), table_ratio(t, swept, ends, "ns"));
}

const knob knob_tick = {
    .name = "tick",
    .title = "The length of a tick",
    .trades = "The step of a tick: time for finding the point where a flight ends, among points that move too.",
    .preset = "the session's: the paper's step is five thirds of the box size, without sweep",
    .proven = "Swept: the stop is before the true one, by less than a step. The ends: nothing.",
    .truth =
        "The moment of the first touch, the others' motion relative: bisected by a test in rationals (GMP) that is "
        "exact, to 2^-40 of the flight; whether a stop is before it is decided by that test itself.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .gains = gains,
    .gain_count = sizeof gains / sizeof gains[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
