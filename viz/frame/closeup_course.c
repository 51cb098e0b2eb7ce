/* SPDX-License-Identifier: MIT */
/* closeup_course.c - what a close-up shows.
 *
 * It follows step by step: kept still until what it shows leaves it, it would jump by as much as it shows. Its scale
 * stays, since nothing in it could be compared from tick to tick otherwise. */
#include "closeup_course.h"
#include "layer_type.h"
#include "layout.h"

#include <math.h>
#include <string.h>

/* Parts of the height of the picture. */
#define SMALL (32.0 / 720)     /* what appears larger needs no close-up, */
#define WANTED (68.0 / 720)    /* and a close-up makes it about so large, */
#define STILL 0.4              /* or, where nothing moves, this part of itself. */
#define SURROUNDED (8.0 / 720) /* A point that is asked for is shown with so much around it, or with its leaf, */
#define CHANGED (31.0 / 720)   /* and one that is moved with so much: what is around it at other ticks is not known */
#define LEAF_PART 0.5          /* The part of a leaf that counts, which is then seen as a whole */
#define MOST_TIMES 1e6         /* as --zoom */

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static const octree_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static bool is_empty(const octree_box *box)
{
    return !(box->min[0] <= box->max[0]);
}

static void widen(octree_box *box, const double from[3], const double to[3])
{
    for (int i = 0; i < 3; i++) {
        box->min[i] = fmin(box->min[i], from[i]);
        box->max[i] = fmax(box->max[i], to[i]);
    }
}

static void widen_by_cell(octree_box *box, const octree_box *world, octree_address node)
{
    const octree_box cell = octree_cell_box(world, node);
    widen(box, cell.min, cell.max);
}

/* Half of the longest extent, which may overflow. */
static double reach_of(const octree_box *box)
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, box->max[i] / 2 - box->min[i] / 2);
    return reach;
}

/* ---- What there is to be seen ------------------------------------------------------------------------------- */

/* What is asked, and what neighbours are found. */
static octree_box box_of_answer(const octree_answer *answer)
{
    octree_box box = nothing;
    double from[3], to[3];
    if (answer->kind == OCTREE_QUERY_RANGE)
        return answer->box;
    for (int i = 0; i < 3; i++) {
        const double radius = answer->kind == OCTREE_QUERY_RADIUS ? answer->radius : 0;
        from[i] = answer->target[i] - radius;
        to[i] = answer->target[i] + radius;
    }
    widen(&box, from, to);
    for (size_t i = 0; answer->neighbors && i < answer->count; i++)
        widen(&box, answer->neighbors[i].point.position, answer->neighbors[i].point.position);
    return box;
}

/* Where a point moves to in the next tick, too: a close-up is of no use to one that leaves it at once. */
static void widen_by_way(octree_box *box, const octree_body *mover)
{
    double next[3];
    for (int i = 0; i < 3; i++)
        next[i] = mover->position[i] + mover->velocity[i];
    widen(box, mover->position, mover->position);
    widen(box, next, next);
}

/* What a tick edits, moves, splits and merges. */
static octree_box box_of_changes(const layer_source *in)
{
    const octree_tick *tick = in->tick;
    octree_box box = tick->edit_count ? tick->edited : nothing;
    for (size_t i = 0; i < tick->mover_count; i++)
        widen_by_way(&box, &tick->movers[i]);
    for (size_t i = 0; i < tick->split_count; i++)
        widen_by_cell(&box, &in->world, tick->splits[i]);
    for (size_t i = 0; i < tick->merge_count; i++)
        widen_by_cell(&box, &in->world, tick->merges[i]);
    return box;
}

/* The height of a picture in pixels, and how long a pixel is in world units at the distance of what the camera looks
 * at: that of tick 0, since an orbit does not show everything at the same size at every tick. */
typedef struct measure {
    double height, pixel;
} measure;

static measure measure_of(const layer_source *in)
{
    scene with = {.has_closeup = true};
    double center[3]; /* what it looks at does not matter */
    scene_set_view(&with, in->view);
    scene_box_middle(&in->world, center);
    const camera c = camera_make(in->view, layout_camera(&with), &in->world, center, 0);
    return (measure){view_height_in_wide(in->view), camera_pixel_length(&c)};
}

static double part_of(const measure *m, double reach)
{
    return 2 * reach / m->pixel / m->height;
}

/* Whether anything is: else what there is to be seen is what a tick changes. */
static bool is_asked(const layer_source *in)
{
    return in->answer_count > 0 || !in->tick;
}

/* ---- How large ---------------------------------------------------------------------------------------------- */

/* The greatest of 1, 2, 3, 4, 5, 6 and 8 times a power of ten that is at most `limit`, which is at least 1. */
static double round_down(double limit)
{
    static const double steps[] = {8, 6, 5, 4, 3, 2, 1};
    double power = 1;
    while (power * 10 <= limit)
        power *= 10;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        if (steps[i] * power <= limit)
            return steps[i] * power;
    return power;
}

/* Of what takes this part, to take another: 0 where it is large enough already, or nothing. */
static double times_of(double part, double wanted)
{
    return part > 0 && part < SMALL ? round_down(fmin(wanted / part, MOST_TIMES)) : 0;
}

/* The part that a close-up shows. */
static double shown(const layer_source *in, const measure *m, double times)
{
    const camera_window w = layout_closeup(in->view);
    return fmin(w.width, w.height) / m->height / times;
}

/* What is to be seen may be nearly a point, which alone says nothing. */
static double part_with_leaf(const layer_source *in, const octree_box *seen, const measure *m)
{
    double middle[3];
    octree_node leaf;
    scene_box_middle(seen, middle);
    const bool has_leaf = octree_locate(in->tree, middle, &leaf) == OCTREE_OK && leaf.leaf;
    const double around = has_leaf ? LEAF_PART * part_of(m, reach_of(&leaf.box)) : INFINITY;
    return fmax(part_of(m, reach_of(seen)), fmin(around, is_asked(in) ? SURROUNDED : CHANGED));
}

/* Nothing moves in the picture of a tree, and what is asked may fill a close-up. */
static double times_of_seen(const layer_source *in, const octree_box *seen, const measure *m)
{
    return times_of(part_with_leaf(in, seen, m), in->game ? WANTED : STILL * shown(in, m, 1));
}

/* ---- Where -------------------------------------------------------------------------------------------------- */

/* What is gathered for a close-up, which is times as large. */
typedef struct gathering {
    const layer_source *in;
    measure m;
    double most; /* nothing is taken in that takes a larger part */
    double times;
    octree_box group;
} gathering;

/* Take in what is seen together with what is there. The first that is small says how large. */
static void take_in(gathering *g, const octree_box *more)
{
    octree_box both = g->group;
    const octree_box *world = &g->in->world;
    for (int i = 0; i < 3; i++)
        if (!(more->min[i] <= world->max[i] && more->max[i] >= world->min[i]))
            return;
    if (!(part_of(&g->m, reach_of(more)) < g->most))
        return;
    if (!(g->times > 0))
        g->times = times_of_seen(g->in, more, &g->m);
    widen(&both, more->min, more->max);
    if (g->times > 0 && part_of(&g->m, reach_of(&both)) < shown(g->in, &g->m, g->times))
        g->group = both;
}

static void gather(gathering *g)
{
    octree_node node;
    octree_box box;
    const layer_source *in = g->in;
    if (in->asked && octree_node_at(in->tree, in->asked, &node) == OCTREE_OK)
        take_in(g, &node.box);
    for (size_t i = 0; i < in->answer_count; i++) {
        box = box_of_answer(&in->answers[i]);
        take_in(g, &box);
    }
    if (!is_asked(in)) {
        box = box_of_changes(in);
        take_in(g, &box);
    }
}

/* The size depends on the session and the view alone, and so is the same at every tick. A close-up is of no use to a
 * player that leaves it at once by its step. */
static void follow_player(closeup_course *course, const layer_source *in, const measure *m)
{
    const octree_player *player = &in->session->player;
    course->times = times_of(part_of(m, fmax(player->box_size, player->step / 2)), WANTED);
    memcpy(course->place, in->tick->player, sizeof course->place);
}

/* Whether a close-up at a place shows it all. */
static bool is_within(const gathering *g, const double place[3])
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, fmax(g->group.max[i] - place[i], place[i] - g->group.min[i]));
    return part_of(&g->m, reach) < shown(g->in, &g->m, g->times);
}

/* What is asked is followed as a player is. Changes are here and there, and one at which a close-up is need not move
 * it. */
static void follow_seen(closeup_course *course, const layer_source *in, const measure *m)
{
    gathering g = {in, *m, SMALL, course->times, nothing};
    gather(&g);
    g.most = INFINITY;
    gather(&g);
    if (is_empty(&g.group) || (course->times > 0 && !is_asked(in) && is_within(&g, course->place)))
        return;
    course->times = g.times;
    scene_box_middle(&g.group, course->place);
    for (int i = 0; i < 3; i++)
        course->place[i] = fmin(fmax(course->place[i], in->world.min[i]), in->world.max[i]);
}

void closeup_follow(closeup_course *course, const layer_source *in)
{
    if (!in->view->closeup || layout_closeup(in->view).width == 0)
        return;
    const measure m = measure_of(in);
    const bool has_player = in->session && in->session->player.kind != OCTREE_PLAYER_NONE;
    (has_player ? follow_player : follow_seen)(course, in, &m);
}
