/* SPDX-License-Identifier: MIT */
/* closeup_course.c - what a close-up shows.
 *
 * It follows step by step: kept still until what it shows leaves it, it would jump by as much as it shows. Its scale
 * stays, since nothing in it could be compared from tick to tick otherwise. */
#include "closeup_course.h"
#include "layer_type.h"
#include "layout.h"
#include "octree/octree.h"

#include <math.h>
#include <string.h>

/* Parts of the height of the picture. */
#define SMALL (32.0 / 720)     /* what appears larger needs no close-up, */
#define WANTED (68.0 / 720)    /* and a close-up makes it about so large, */
#define STILL 0.4              /* or, where nothing moves, this part of itself. */
#define SURROUNDED (8.0 / 720) /* Neighbours are visible_part with so much around them, or with their leaf, */
#define CHANGED (31.0 / 720)   /* and what is moved with so much: what is around it at other ticks is not known */
#define LEAF_PART 0.5          /* The part of a leaf that counts, which is then seen as a whole */
#define MAX_MAGNIFICATION 1e6  /* as --zoom */

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static const octree_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static bool is_empty(const octree_box *box)
{
    return !(box->min[0] <= box->max[0]);
}

static void widen(octree_box *box, const double from[3], const double to[3])
{
    for (int i = 0; i < 3; i++) {
        box->min[i] = from[i] < box->min[i] ? from[i] : box->min[i];
        box->max[i] = to[i] > box->max[i] ? to[i] : box->max[i];
    }
}

static void widen_by_cell(octree_box *box, const octree_box *world, octree_address node)
{
    const octree_box cell = octree_cell_box(world, node);
    widen(box, cell.min, cell.max);
}

/* Half of the longest extent, which may overflow. */
static double half_extent(const octree_box *box)
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, box->max[i] / 2 - box->min[i] / 2);
    return reach;
}

/* ---- What there is to be seen ------------------------------------------------------------------------------- */

/* The region of a query; of a query for neighbours its target and the neighbours found. */
static octree_box answer_box(const octree_answer *answer)
{
    octree_box box = nothing;
    if (octree_answer_bound(answer, &box))
        return box;
    widen(&box, answer->target, answer->target);
    for (size_t i = 0; answer->neighbors && i < answer->count; i++)
        widen(&box, answer->neighbors[i].point.position, answer->neighbors[i].point.position);
    return box;
}

/* Where a point moves to in the next tick, too: a close-up is of no use to one that leaves it at once. */
static void widen_by_movement(octree_box *box, const octree_body *mover)
{
    double next[3];
    for (int i = 0; i < 3; i++)
        next[i] = mover->position[i] + mover->velocity[i];
    widen(box, mover->position, mover->position);
    widen(box, next, next);
}

/* What a tick edits, moves, splits and merges. */
static octree_box changes_box(const layer_source *in)
{
    const octree_tick *tick = in->tick;
    octree_box box = tick->edit_count ? tick->edited : nothing;
    for (size_t i = 0; i < tick->mover_count; i++)
        widen_by_movement(&box, &tick->movers[i]);
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
    const camera c = camera_make(in->view, layout_camera(&with, &in->world), &in->world, center, 0);
    return (measure){view_height_in_wide(in->view), camera_pixel_length(&c)};
}

static double part_of_height(const measure *m, double reach)
{
    return 2 * reach / m->pixel / m->height;
}

/* Whether anything is: else what there is to be seen is what a tick changes. */
static bool has_queries(const layer_source *in)
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

/* The part that a close-up shows, which is as many times as large. */
static double visible_part(const layer_source *in, const measure *m, double times)
{
    const camera_window w = layout_closeup(in->view);
    return fmin(w.width, w.height) / m->height / times;
}

/* Of what has this reach; 0 where that is large enough already, or nothing. Where nothing moves it may fill the
 * close-up. */
static double magnification_for(double reach, const layer_source *in, const measure *m)
{
    const double part = part_of_height(m, reach),
                 wanted = in->game ? WANTED : fmax(WANTED, STILL * visible_part(in, m, 1));
    return part > 0 && part < SMALL ? round_down(fmin(wanted / part, MAX_MAGNIFICATION)) : 0;
}

double closeup_magnification(const closeup_course *course, const layer_source *in)
{
    const measure m = measure_of(in);
    return in->view->closeup && layout_closeup(in->view).width > 0 ? magnification_for(course->reach, in, &m) : 0;
}

/* Where neighbours are very near, they alone say nothing. */
static double half_extent_with_leaf(const layer_source *in, const octree_box *seen, const measure *m)
{
    double middle[3];
    octree_node leaf;
    scene_box_middle(seen, middle);
    const bool has_leaf = octree_locate(in->tree, middle, &leaf) == OCTREE_OK && leaf.leaf;
    const double around = (has_queries(in) ? SURROUNDED : CHANGED) * m->height / 2 * m->pixel;
    return fmax(half_extent(seen), fmin(has_leaf ? LEAF_PART * half_extent(&leaf.box) : INFINITY, around));
}

/* ---- Where -------------------------------------------------------------------------------------------------- */

/* What is gathered for a close-up. */
typedef struct group_search {
    const layer_source *in;
    measure m;
    double most;  /* nothing is taken in that takes a larger part */
    double reach; /* of the first that is small; 0: there was none */
    octree_box group;
} group_search;

/* What has no size of its own, which somebody asked for, is visible_part with its leaf. */
static void add_to_group(group_search *g, const octree_box *more, bool is_sized)
{
    octree_box both = g->group;
    const octree_box *world = &g->in->world;
    for (int i = 0; i < 3; i++)
        if (!(more->min[i] <= world->max[i] && more->max[i] >= world->min[i]))
            return;
    if (!(part_of_height(&g->m, half_extent(more)) < g->most))
        return;
    const double own =
        is_sized && half_extent(more) > 0 ? half_extent(more) : half_extent_with_leaf(g->in, more, &g->m);
    const double reach = g->reach > 0 ? g->reach : own;
    const double times = magnification_for(reach, g->in, &g->m);
    widen(&both, more->min, more->max);
    if (!(times > 0 && part_of_height(&g->m, half_extent(&both)) < visible_part(g->in, &g->m, times)))
        return;
    g->reach = reach;
    g->group = both;
}

static void add_candidates(group_search *g)
{
    octree_node node;
    octree_box box;
    const layer_source *in = g->in;
    if (in->requested && octree_node_at(in->tree, in->requested, &node) == OCTREE_OK)
        add_to_group(g, &node.box, true);
    for (size_t i = 0; i < in->answer_count; i++) {
        box = answer_box(&in->answers[i]);
        add_to_group(g, &box, !in->answers[i].neighbors);
    }
    if (!has_queries(in)) {
        box = changes_box(in);
        add_to_group(g, &box, false);
    }
}

/* Those that are small come first. */
static group_search find_group(const closeup_course *course, const layer_source *in)
{
    group_search g = {in, measure_of(in), SMALL, course->reach, nothing};
    add_candidates(&g);
    g.most = INFINITY;
    add_candidates(&g);
    return g;
}

/* Whether a close-up at a place shows it all. */
static bool is_within(const group_search *g, const double place[3])
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, fmax(g->group.max[i] - place[i], place[i] - g->group.min[i]));
    return part_of_height(&g->m, reach) < visible_part(g->in, &g->m, magnification_for(g->reach, g->in, &g->m));
}

/* What is asked is followed as a player is. Changes are here and there, and those that a close-up shows need not move
 * it. */
static void follow_queries_or_changes(closeup_course *course, const layer_source *in)
{
    const group_search g = find_group(course, in);
    if (is_empty(&g.group) || (course->reach > 0 && !has_queries(in) && is_within(&g, course->place)))
        return;
    course->reach = g.reach;
    scene_box_middle(&g.group, course->place);
    for (int i = 0; i < 3; i++)
        course->place[i] = fmin(fmax(course->place[i], in->world.min[i]), in->world.max[i]);
}

/* A close-up is of no use to a player that leaves it at once by its step. */
static void follow_player(closeup_course *course, const layer_source *in)
{
    const octree_player *player = &in->session->player;
    course->reach = fmax(player->box_size, player->step / 2);
    memcpy(course->place, in->tick->player, sizeof course->place);
}

void closeup_follow(closeup_course *course, const layer_source *in)
{
    if (in->session && in->session->player.kind != OCTREE_PLAYER_NONE)
        follow_player(course, in);
    else if (layout_closeup(in->view).width > 0)
        follow_queries_or_changes(course, in);
}
