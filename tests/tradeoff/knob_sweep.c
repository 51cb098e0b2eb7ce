/* SPDX-License-Identifier: MIT */
/* knob_sweep.c - collision at the ends of a step against collision all the way, by speed. */
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "frames.h"
#include "knob.h"
#include "layer.h"
#include "picture.h"
#include "recording_file.h"
#include "tick_scene.h"
#include "quick_oracle.h"
#include "timing.h"
#include "must.h"

static const column columns[] = {
    {"setting", "speed: the step / the side of the player's box", NULL},
    {"collisions", "points that the box touches on its way, in all steps", NULL},
    {"missed", "of them not reported", "bound_missed"},
    {"missed_share", "the same as a share", "bound_share"},
    {"bound_missed", "proven", NULL},
    {"bound_share", "proven; 1 where nothing is", NULL},
    {"expected_share", "what evenly strewn points make of it along an axis: 1 - 2 / (1 + speed)", NULL},
    {"false", "reported and not touched", "0"},
    {"ns", "processor nanoseconds a step (the place where it begins was tested by the step before)", NULL},
    {"nodes", "nodes visited a step", NULL},
    {"points", "points compared one by one a step", NULL},
};

static const chart charts[] = {
    {.title = "Collisions missed", .x = "setting", .y = "missed_share", .bound = "bound_share", .x_log = true},
    {.title = "Time of a step", .x = "setting", .y = "ns", .x_log = true, .y_log = true},
};

static const gain gains[] = {
    {"ends of a step instead of sweep",
     {.variant = "swept-on-axis", .setting = 1},
     {.variant = "ends-on-axis", .setting = 1},
     "ns"},
};

static const double speeds[] = {0.25, 0.5, 1, 1.5, 2, 3, 4, 8, 16};
enum { SPEEDS = sizeof speeds / sizeof speeds[0] };
static const double half = 32; /* of the player's box: dyadic, as are its places, so that steps are not rounded */

typedef struct step {
    double from[3], to[3];
} step;

/* Steps of one length, on which the box is tested at the ends or all the way. */
typedef struct flights {
    const octree *tree;
    const workload *load;
    step *steps;
    size_t count;
    bool swept;
} flights;

static bool count_one(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

/* The test that is made of each step; the place where it begins was tested by the step before. */
static void collide(const flights *f, const step *s, octree_cost *cost, octree_point_visitor visit, void *context)
{
    const octree_search how = {.cost = cost};
    if (f->swept)
        must(octree_collide_swept(f->tree, s->from, s->to, half, NULL, &how, visit, context));
    else
        must(octree_collide_search(f->tree, s->to, half, NULL, &how, visit, context));
}

static void fly(void *contestant)
{
    const flights *f = contestant;
    size_t hits = 0;
    for (size_t i = 0; i < f->count; i++)
        collide(f, &f->steps[i], NULL, count_one, &hits);
}

/* ---- Judging ------------------------------------------------------------------------------------------------ */

typedef struct report {
    bool *of; /* each point */
} report;

static bool note(const octree_point *point, void *context)
{
    ((report *)context)->of[point->id] = true;
    return true;
}

typedef struct tally {
    size_t collisions, missed, wrong;
    octree_cost cost;
} tally;

static tally judge(const flights *f)
{
    tally sum = {0};
    report noted = {resize_memory(NULL, f->load->count * sizeof *noted.of)};
    for (size_t i = 0; i < f->count; i++) {
        const step *s = &f->steps[i];
        memset(noted.of, 0, f->load->count * sizeof *noted.of);
        collide(f, s, &sum.cost, note, &noted);
        if (!f->swept)
            must(octree_collide(f->tree, s->from, half, NULL, note, &noted));
        for (size_t p = 0; p < f->load->count; p++) {
            const bool touches = quick_touches(s->from, s->to, half, f->load->points[p].position);
            sum.collisions += touches;
            sum.missed += touches && !noted.of[p];
            sum.wrong += !touches && noted.of[p];
        }
    }
    free(noted.of);
    return sum;
}

static void add_row(table *t, const flights *f, const char *variant, double speed, bool along_axis, double ns)
{
    const tally sum = judge(f);
    const bool sure = f->swept || (along_axis && speed <= 1);
    const double steps = (double)f->count, share = (double)sum.missed / fmax(1, (double)sum.collisions);
    table_add(t, f->load->name, variant,
              (double[]){speed, (double)sum.collisions, (double)sum.missed, share, sure ? 0 : NAN, sure ? 0 : 1,
                         f->swept || !along_axis ? NAN : fmax(0, 1 - 2 / (1 + speed)), (double)sum.wrong, ns / steps,
                         (double)sum.cost.nodes / steps, (double)sum.cost.points / steps});
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

/* On a grid of 2^-20. */
static double on_grid(double value)
{
    return floor(value * 0x1p20) * 0x1p-20;
}

/* Steps from anywhere, along an axis or slantwise. */
static void make_steps(step *steps, size_t count, double length, bool along_axis, uint64_t *random)
{
    for (size_t i = 0; i < count; i++) {
        double way[3] = {0, 0, 0}, square = 0;
        const uint64_t turn = random_below(random, 6);
        while (!along_axis && (square < 0.01 || square > 1)) {
            square = 0;
            for (int axis = 0; axis < 3; axis++) {
                way[axis] = random_between(random, -1, 1);
                square += way[axis] * way[axis];
            }
        }
        if (along_axis)
            way[turn / 2] = turn % 2 == 0 ? 1 : -1;
        for (int axis = 0; axis < 3; axis++) {
            const double stretch = along_axis ? length : length / sqrt(square);
            steps[i].from[axis] = on_grid(random_between(random, -900, 900));
            steps[i].to[axis] = steps[i].from[axis] + on_grid(way[axis] * stretch);
        }
    }
}

static void measure_scene(const run *r, table *t, const workload *w)
{
    static const char *const variants[2][2] = {{"ends-slantwise", "swept-slantwise"},
                                               {"ends-on-axis", "swept-on-axis"}};
    const size_t count = r->quick ? 40 : 400;
    uint64_t random = 5;
    octree *tree = workload_tree(w, octree_def_default().leaf_capacity, OCTREE_MAX_DEPTH);
    step *steps = resize_memory(NULL, count * sizeof *steps);
    for (int along_axis = 1; along_axis >= 0; along_axis--)
        for (int i = 0; i < SPEEDS; i++) {
            make_steps(steps, count, speeds[i] * 2 * half, along_axis, &random);
            flights ways[] = {{tree, w, steps, count, false}, {tree, w, steps, count, true}};
            double ns[2];
            time_in_turn(fly, ways, sizeof ways[0], 2, 3 * r->rounds, ns);
            for (int j = 0; j < 2; j++)
                add_row(t, &ways[j], variants[along_axis][j], speeds[i], along_axis, ns[j]);
        }
    free(steps);
    octree_destroy(tree);
}

/* A player whose step of six boxes passes a point: the collision test at the ends misses it. */
static void attach_step(const run *r, table *t, bool sweep, const char *caption)
{
    const octree_game_body bodies[] = {{.id = 1, .position = {0, 0, 0}}, {.id = 2, .position = {60, 40, -30}}};
    octree_session session = {.tree = define(cube(-100, 100), 1, 5, OCTREE_GROW), .bodies = bodies, .body_count = 2};
    octree_game *game;
    scene shown = {0};
    picture p;
    octreel_error why;
    view v = view_make_default();
    session.player = (octree_player){.position = {-60, 0, 0}, .step = 120, .box_size = 10, .sweep = sweep};
    session.keys = "d";
    v.width = 240;
    v.height = 136;
    v.layers &= ~(1u << LAYER_TEXT);
    must(octree_game_create(&session, &game));
    must(octree_game_advance(game));
    if (!tick_scene_build(&shown, &v, game, NULL, NULL) || !picture_open(&p, &v, &(renderer_choice){0}, &why) ||
        !picture_draw(&p, &shown, &why))
        stop_with_error("the picture of a step cannot be drawn");
    attach_picture(r, t, &p.frame, v.width, v.height, caption);
    picture_close(&p);
    scene_release(&shown);
    octree_game_destroy(game);
}

static void measure(const run *r, table *t)
{
    static const octree_sample_kind kinds[] = {OCTREE_SAMPLE_UNIFORM, OCTREE_SAMPLE_CLUSTERED, OCTREE_SAMPLE_LATTICE};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        workload w =
            workload_sample(octree_sample_name(kinds[i]), kinds[i], cube(-1000, 1000), r->quick ? 3000 : 20000, 1);
        measure_scene(r, t, &w);
        workload_free(&w);
    }
    attach_step(r, t, false, "the ends of the step: the point in between is missed");
    attach_step(r, t, true, "swept: the point is hit, and the step is taken back");
}

static void tell(const table *t, FILE *out)
{
    fputs("The ends of a step alone are the default (the paper's rule); \"sweep\" costs ", out);
    static const double told[] = {1, 2, 4};
    for (size_t i = 0; i < 3; i++) {
        const pick ends = {.variant = "ends-on-axis", .setting = told[i]};
        const pick swept = {.variant = "swept-on-axis", .setting = told[i]};
        fprintf(out, "%s%.2f x the time at %g box%s a tick (the ends miss %.0f %% at worst, proven %s)",
                i == 0   ? ""
                : i == 1 ? ", "
                         : " and ",
                table_ratio(t, swept, ends, "ns"), told[i], told[i] == 1 ? "" : "es",
                100 * table_most(t, ends, "missed_share"), told[i] == 1 ? "0" : "nothing");
    }
    const pick swept[] = {{.variant = "swept-on-axis", .setting = NAN}, {.variant = "swept-slantwise", .setting = NAN}};
    const pick ends_far = {.variant = "ends-slantwise", .setting = 4},
               swept_far = {.variant = "swept-slantwise", .setting = 4};
    fprintf(
        out,
        "; swept missed %.0f of %.0f, proven 0; slantwise the ends miss %.1f %% even at half a box a tick, and sweep "
        "costs %.2f x the time at 4 boxes.",
        table_sum(t, swept[0], "missed") + table_sum(t, swept[1], "missed"),
        table_sum(t, swept[0], "collisions") + table_sum(t, swept[1], "collisions"),
        100 * table_most(t, (pick){.variant = "ends-slantwise", .setting = 0.5}, "missed_share"),
        table_ratio(t, swept_far, ends_far, "ns"));
}

static void defend(const table *t, FILE *out)
{
    const octree_player paper = octree_session_default().player;
    const pick ends = {.variant = "ends-on-axis", .setting = 1}, swept = {.variant = "swept-on-axis", .setting = 1};
    fprintf(
        out,
        "Off is kept, which is the paper's rule: its player goes %.2f boxes a tick along an axis, and up to 1 the ends "
        "miss %.0f %% of what does not move (proven 0), while sweep takes %.2f x the time.",
        paper.step / (2 * paper.box_size), 100 * table_most(t, ends, "missed_share"),
        table_ratio(t, swept, ends, "ns"));
}

const knob knob_sweep = {
    .name = "sweep",
    .title = "Collision at the ends of a step, or all the way",
    .trades = "octree_player.sweep, octree_collide_swept: time for collisions that a fast player jumps over.",
    .preset = "off: at the ends, as in the paper",
    .proven =
        "Swept: nothing is missed. The ends: nothing is missed where the step is at most the box's side along one "
        "axis; beyond that nothing is proven.",
    .truth = "Each point against the box on its way, by long doubles with a proven error bound, and by rationals (GMP: "
             "exact) where that bound cannot tell.",
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
