/* SPDX-License-Identifier: MIT */
/* closeup_course.c - chooses the place and the magnification of the close-up.
 *
 * The problem: the close-up should show what happens in a tick, but a viewer must be able to follow it from frame to
 * frame. The choice may depend only on ticks up to the shown tick.
 *
 * The idea: every tick has subjects. A subject is the box of something that the close-up should show: the player, the
 * requested node, an answer, or the changes of the tick. Some of the subjects form a group. A first pass tries subjects
 * that appear small in the view, a second pass all others. A subject joins the group if the whole group then still fits
 * into the close-up. The middle of the group becomes the middle of the close-up.
 *
 * The first small subject fixes the magnification of all ticks, so that viewers can compare sizes from tick to tick.
 * The magnification is a round number that makes the subject about WANTED of the picture's height.
 *
 * The place follows the player or the queries at every tick. A close-up that stood still until the subject left it
 * would then jump by its whole width. In a tick without queries the changes are the subject. Changes are spread over
 * the world, so the close-up moves only if it does not already show all changes of the tick. The box of a moving point
 * contains its position at the next tick too, so that the point does not leave the close-up at once. */
#include "closeup_course.h"
#include "layer_type.h"
#include "layout.h"
#include "octree/octree.h"

#include <math.h>
#include <string.h>

/* Sizes of things in the picture, as parts of the picture's height. */
#define SMALL (32.0 / 720)  /* a subject that appears at least this large in the view needs no close-up */
#define WANTED (68.0 / 720) /* the close-up enlarges the subject to about this size */
/* In a tree without a game nothing moves from tick to tick, so the subject may fill this part of the close-up. */
#define STILL 0.4
/* margin around a query and the points it found; the margin is smaller if the leaf of these points is small */
#define SURROUNDED (8.0 / 720)
#define CHANGED (31.0 / 720) /* margin around changes; it is wide because later ticks may change other places */
/* margin around a subject, as a part of the half extent of its leaf; with it the close-up shows the whole leaf */
#define LEAF_PART 0.5
#define MAX_MAGNIFICATION 1e6 /* maximum magnification, as for the option --zoom */

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static const octree_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* Widen a box so that it contains the box with the corners `min` and `max`. */
static void widen_by_box(octree_box *box, const double min[3], const double max[3])
{
    for (int i = 0; i < 3; i++) {
        box->min[i] = min[i] < box->min[i] ? min[i] : box->min[i];
        box->max[i] = max[i] > box->max[i] ? max[i] : box->max[i];
    }
}

static void widen_by_cell(octree_box *box, const octree_box *world, octree_address node)
{
    const octree_box cell = octree_cell_box(world, node);
    widen_by_box(box, cell.min, cell.max);
}

/* Return half the longest side of a box. The whole side could overflow. */
static double half_extent(const octree_box *box)
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, box->max[i] / 2 - box->min[i] / 2);
    return reach;
}

/* ---- Subjects ------------------------------------------------------------------------------------------------ */

/* Return the box of an answer: the region of the query. A query for neighbours has no region; its box contains the
 * target and the neighbours found. */
static octree_box find_answer_box(const octree_answer *answer)
{
    octree_box box = nothing;
    if (octree_answer_bound(answer, &box))
        return box;
    widen_by_box(&box, answer->target, answer->target);
    for (size_t i = 0; answer->neighbors && i < answer->count; i++)
        widen_by_box(&box, answer->neighbors[i].point.position, answer->neighbors[i].point.position);
    return box;
}

/* Widen a box so that it contains a moving point's positions at this tick and at the next tick. */
static void widen_by_movement(octree_box *box, const octree_game_body *mover)
{
    double next[3];
    for (int i = 0; i < 3; i++)
        next[i] = mover->position[i] + mover->velocity[i];
    widen_by_box(box, mover->position, mover->position);
    widen_by_box(box, next, next);
}

/* Return a box that contains all points that a tick edits or moves, and all nodes that it splits or merges. */
static octree_box find_changes_box(const layer_source *in)
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

/* The scale of a view: the height of the picture in pixels, and the length of a pixel in world units at the position
 * that the camera looks at. The scale is computed for the camera of tick 0, because the distance of an orbiting camera
 * changes from tick to tick. */
typedef struct view_scale {
    double height, pixel;
} view_scale;

static view_scale make_view_scale(const layer_source *in)
{
    scene with = {.has_closeup = true};
    scene_set_view(&with, in->view);
    const camera c = camera_make(in->view, layout_camera_area(&with, &in->world), &in->world, find_player(in), 0);
    view own = *in->view;
    own.suited_height = 0; /* a page enlarges the same things as the recorded frame, whatever the size of its picture */
    return (view_scale){view_height_at_16_9(&own), camera_world_length_of_pixel(&c)};
}

/* Return the size of a box with the half extent `reach`, as a part of the picture's height. */
static double find_part_of_height(const view_scale *m, double reach)
{
    return 2 * reach / m->pixel / m->height;
}

/* Return true if the subjects of the close-up are queries, or if the scene shows a tree without a game. Return false if
 * the subjects are the changes of the tick. */
static bool are_queries_subjects(const layer_source *in)
{
    return in->answer_count > 0 || !in->tick;
}

/* ---- Magnification ------------------------------------------------------------------------------------------- */

/* Return the greatest number not above `limit` that is 1, 2, 3, 4, 5, 6 or 8 times a power of ten. `limit` must be at
 * least 1. */
static double round_down_magnification(double limit)
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

/* Return the height of the area that a close-up enlarges `times` times, as a part of the picture's height. */
static double find_visible_part(const layer_source *in, const view_scale *m, double times)
{
    const camera_window w = layout_closeup_area(in->view);
    return fmin(w.width, w.height) / m->height / times;
}

/* Return the magnification for a subject with the half extent `reach`. Return 0 if the subject has no extent or appears
 * large enough already. Without a game the subject may fill more of the close-up. */
static double find_magnification(double reach, const layer_source *in, const view_scale *m)
{
    const double part = find_part_of_height(m, reach),
                 wanted = in->game ? WANTED : fmax(WANTED, STILL * find_visible_part(in, m, 1));
    return part > 0 && part < SMALL ? round_down_magnification(fmin(wanted / part, MAX_MAGNIFICATION)) : 0;
}

double closeup_magnification(const closeup_course *course, const layer_source *in)
{
    const view_scale m = make_view_scale(in);
    return in->view->closeup && layout_closeup_area(in->view).width > 0 ? find_magnification(course->reach, in, &m) : 0;
}

/* Return the half extent of a subject with a margin around it. The margin keeps the leaf visible when neighbours lie at
 * nearly the same place. */
static double half_extent_with_leaf(const layer_source *in, const octree_box *seen, const view_scale *m)
{
    double middle[3];
    octree_node leaf;
    scene_box_middle(seen, middle);
    const bool has_leaf = octree_locate(in->tree, middle, &leaf) == OCTREE_OK && leaf.leaf;
    const double around = (are_queries_subjects(in) ? SURROUNDED : CHANGED) * m->height / 2 * m->pixel;
    return fmax(half_extent(seen), fmin(has_leaf ? LEAF_PART * half_extent(&leaf.box) : INFINITY, around));
}

/* ---- Place --------------------------------------------------------------------------------------------------- */

/* The search for a group of subjects that fit into one close-up. */
typedef struct group_search {
    const layer_source *in;
    view_scale m;
    double size_limit; /* size above which subjects are ignored, as a part of the picture's height */
    double reach;      /* half extent of the first small subject, in world units; 0: none found yet */
    octree_box group;
} group_search;

/* Add a subject to the group if the whole group then still fits into the close-up. The first subject sets g->reach.
 * `is_sized` is true if the user chose the size of the subject; otherwise the subject gets a margin that shows its
 * leaf. */
static void add_to_group(group_search *g, const octree_box *more, bool is_sized)
{
    octree_box both = g->group;
    const octree_box *world = &g->in->world;
    for (int i = 0; i < 3; i++)
        if (!(more->min[i] <= world->max[i] && more->max[i] >= world->min[i]))
            return;
    if (!(find_part_of_height(&g->m, half_extent(more)) < g->size_limit))
        return;
    const double own =
        is_sized && half_extent(more) > 0 ? half_extent(more) : half_extent_with_leaf(g->in, more, &g->m);
    const double reach = g->reach > 0 ? g->reach : own;
    const double times = find_magnification(reach, g->in, &g->m);
    widen_by_box(&both, more->min, more->max);
    if (!(times > 0 && find_part_of_height(&g->m, half_extent(&both)) < find_visible_part(g->in, &g->m, times)))
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
        box = find_answer_box(&in->answers[i]);
        add_to_group(g, &box, !in->answers[i].neighbors);
    }
    if (!are_queries_subjects(in)) {
        box = find_changes_box(in);
        add_to_group(g, &box, false);
    }
}

/* Find the group of subjects that the close-up shows. Small subjects are tried first, then all subjects. */
static group_search choose_group_to_show(const closeup_course *course, const layer_source *in)
{
    group_search g = {in, make_view_scale(in), SMALL, course->reach, nothing};
    add_candidates(&g);
    g.size_limit = INFINITY;
    add_candidates(&g);
    return g;
}

/* Return whether a close-up at `place` shows the whole group. */
static bool is_group_in_closeup(const group_search *g, const double place[3])
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, fmax(g->group.max[i] - place[i], place[i] - g->group.min[i]));
    return find_part_of_height(&g->m, reach) <
           find_visible_part(g->in, &g->m, find_magnification(g->reach, g->in, &g->m));
}

/* Move the close-up to the queries of the tick. If the tick has no queries, move the close-up to the tick's changes,
 * but only if the close-up does not show all changes already. */
static void follow_queries_or_changes(closeup_course *course, const layer_source *in)
{
    const group_search g = choose_group_to_show(course, in);
    const bool empty = !(g.group.min[0] <= g.group.max[0]);
    if (empty || (course->reach > 0 && !are_queries_subjects(in) && is_group_in_closeup(&g, course->place)))
        return;
    course->reach = g.reach;
    scene_box_middle(&g.group, course->place);
    for (int i = 0; i < 3; i++)
        course->place[i] = fmin(fmax(course->place[i], in->world.min[i]), in->world.max[i]);
}

void closeup_course_update(closeup_course *course, const layer_source *in)
{
    const double *place = find_player(in);
    if (place) {
        const octree_player *player = &in->session->player;
        /* The half extent is at least half a step of the player, so that one step does not leave the close-up. */
        course->reach = fmax(player->box_size, player->step / 2);
        memcpy(course->place, place, sizeof course->place);
    } else if (layout_closeup_area(in->view).width > 0) {
        follow_queries_or_changes(course, in);
    }
}
