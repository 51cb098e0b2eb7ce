/* SPDX-License-Identifier: MIT */
/* judge.c - judges what a program answered. Two lists are made, of the points that it named and of those of the true
 * answer, each with the positions that its promise is about; then they are compared as sets, or rank by rank.
 */
#include "judge.h"
#include "exact.h"
#include "game_state.h"
#include "point.h"
#include "queries.h"
#include "search.h"

#include <stdlib.h>

const char *octree_fault_name(octree_fault fault)
{
    static const char *const names[OCTREE_FAULTS] = {"none",  "unknown", "duplicate", "skipped",
                                                     "count", "farther", "missed",    "extra"};
    return (unsigned)fault < OCTREE_FAULTS ? names[fault] : NULL;
}

/* What is asked, with the positions that the answer is judged by. */
typedef struct judge_state {
    const judging *about;
    octree_judgement *made;
    bool rounds;
    double target[3], radius, epsilon;
    octree_box box;
    metric metric;
    bool failed; /* there is no memory */
} judge_state;

static const octree_query_traits *traits_of(const judge_state *s)
{
    return octree_query_about(s->about->query->kind);
}

/* ---- Positions ---------------------------------------------------------------------------------------------- */

static void place(const judge_state *s, const double from[3], double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = s->rounds ? round_to_float(from[i]) : from[i];
}

static judge_state begin(const judging *about, octree_judgement *made)
{
    const octree_answer *answer = about->answer;
    const octree *tree = about->game->tree;
    judge_state s = {.about = about, .made = made, .epsilon = answer->epsilon};
    s.rounds = answer->precision == OCTREE_FLOATS;
    place(&s, answer->target, s.target);
    place(&s, answer->box.min, s.box.min);
    place(&s, answer->box.max, s.box.max);
    s.radius = s.rounds ? round_to_float(answer->radius) : answer->radius;
    s.metric = metric_make(tree->scale, is_subnormal_world(tree), s.target);
    return s;
}

static judged_point judge_point(const judge_state *s, const octree_point *point)
{
    judged_point p = {.point = *point, .target = s->target};
    place(s, point->position, p.at);
    p.square = metric_point(&s->metric, p.at);
    return p;
}

static bool is_skipped(const judge_state *s, const judged_point *p)
{
    return (s->about->skip == OCTREE_SKIP_ID && p->point.id == s->about->skip_id) ||
           (s->about->skip == OCTREE_SKIP_COINCIDENT && same_position(p->at, s->target));
}

static void keep(judge_state *s, list *l, const judged_point *p)
{
    s->failed |= !list_push(&s->about->game->memory, l, p, sizeof *p);
}

/* ---- Orders ------------------------------------------------------------------------------------------------- */

static int compare_ids(const void *a, const void *b)
{
    const judged_point *p = a, *q = b;
    return (p->point.id > q->point.id) - (p->point.id < q->point.id);
}

/* By the real distances: the squares decide where they are surely apart. */
static int compare_distances(const judged_point *a, const judged_point *b)
{
    if (a->square > metric_above(b->square))
        return 1;
    if (a->square < metric_below(b->square))
        return -1;
    return metric_compare(a->target, a->at, b->at);
}

static int compare_ranks(const void *a, const void *b)
{
    const int by_distance = compare_distances(a, b);
    return by_distance ? by_distance : compare_ids(a, b);
}

static void sort(list *l, int (*compare)(const void *, const void *))
{
    if (l->count > 1)
        qsort(l->items, l->count, sizeof(judged_point), compare);
}

/* ---- What was named ----------------------------------------------------------------------------------------- */

static void accuse(judge_state *s, octree_fault fault, uint64_t id)
{
    octree_judgement *made = s->made;
    const bool by_id = fault <= OCTREE_FAULT_SKIPPED;
    if (made->fault && (fault > made->fault || (fault == made->fault && id >= made->fault_id)))
        return;
    made->fault = fault;
    made->fault_id = by_id ? id : 0;
}

/* List what was named, each point once, and none that the query leaves out; by id. */
static void list_named(judge_state *s)
{
    octree_game *game = s->about->game;
    const octree_query *query = s->about->query;
    for (size_t i = 0; !s->failed && i < query->answer_count; i++) {
        octree_point point;
        s->failed |= !list_push(&game->memory, &game->given, &query->answer[i], sizeof *query->answer);
        if (!octree_game_find(game, query->answer[i], &point)) {
            accuse(s, OCTREE_FAULT_UNKNOWN, query->answer[i]);
            continue;
        }
        judged_point p = judge_point(s, &point);
        if (is_skipped(s, &p))
            accuse(s, OCTREE_FAULT_SKIPPED, point.id);
        else
            keep(s, &game->named, &p);
    }
    sort(&game->named, compare_ids);
    judged_point *named = game->named.items;
    size_t kept = 0;
    for (size_t i = 0; i < game->named.count; i++) {
        if (kept > 0 && named[i].point.id == named[kept - 1].point.id)
            accuse(s, OCTREE_FAULT_DUPLICATE, named[i].point.id);
        else
            named[kept++] = named[i];
    }
    game->named.count = kept;
}

/* ---- The true answer, of positions as they are --------------------------------------------------------------- */

static void list_truth(judge_state *s)
{
    const judging *about = s->about;
    for (size_t i = 0; !s->failed && i < about->answer->count; i++) {
        judged_point p = judge_point(s, about->points ? &about->points[i] : &about->neighbors[i].point);
        keep(s, &about->game->truth, &p);
    }
}

/* ---- The true answer, of rounded positions ------------------------------------------------------------------- *
 *
 * Rounding moves a point by at most a share of the world's largest coordinate. So all points that may belong to the
 * answer are collected from a region that is so much larger, and decided by their rounded positions.
 */

/* How far rounding moves a point of the world, on one axis at most. */
static double rounding_of(const octree *tree)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = larger(largest, larger(fabs(tree->def.world.min[i]), fabs(tree->def.world.max[i])));
    return largest > FLT_MAX ? largest : largest * 0x1p-24 + 0x1p-149;
}

static bool is_in_region(const judge_state *s, const double at[3])
{
    const unsigned members = traits_of(s)->members;
    if (members & OCTREE_QUERY_HAS_BOX)
        return box_contains(&s->box, at);
    return !(members & OCTREE_QUERY_HAS_RADIUS) || metric_compare_radius(s->target, at, s->radius) <= 0;
}

/* A visitor: neighbours are kept wherever they are. */
static bool keep_rounded(const octree_point *point, void *context)
{
    judge_state *s = context;
    judged_point p = judge_point(s, point);
    if (!is_skipped(s, &p) && is_in_region(s, p.at))
        keep(s, &s->about->game->truth, &p);
    return !s->failed;
}

static octree_status collect_ball(judge_state *s, double radius, double slack)
{
    static const octree_box all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    const octree *tree = s->about->game->tree;
    const double reach = exact_add_up(radius, slack);
    return reach < DBL_MAX ? octree_radius(tree, s->target, reach, NULL, keep_rounded, s)
                           : octree_range(tree, &all, keep_rounded, s);
}

static octree_status collect_box(judge_state *s, double slack)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = exact_add_down(s->box.min[i], -slack);
        box.max[i] = exact_add_up(s->box.max[i], slack);
    }
    return octree_range(s->about->game->tree, &box, keep_rounded, s);
}

/* Collect from larger and larger balls, until the k-th of those found is nearer than all that were left out. */
static octree_status collect_nearest(judge_state *s, double slack)
{
    const judging *about = s->about;
    const octree *tree = about->game->tree;
    list *truth = &about->game->truth;
    const size_t count = about->answer->count, k = about->answer->k;
    double radius = count && count == k ? metric_distance(s->target, about->neighbors[count - 1].point.position) : 0;
    if (k >= octree_count(tree))
        radius = DBL_MAX;
    for (radius += slack;; radius *= 2) {
        truth->count = 0;
        radius = radius < DBL_MAX ? radius : DBL_MAX;
        const octree_status status = collect_ball(s, radius, slack);
        /* unreachable: a search of such a ball is not refused */
        if (status != OCTREE_OK || s->failed)
            return status;
        sort(truth, compare_ranks);
        const judged_point *found = truth->items;
        if (k == 0 || radius == DBL_MAX ||
            (truth->count >= k && metric_compare_radius(s->target, found[k - 1].at, radius) <= 0))
            break;
    }
    truth->count = truth->count < k ? truth->count : k;
    return OCTREE_OK;
}

static octree_status list_rounded_truth(judge_state *s)
{
    const double slack = 2 * rounding_of(s->about->game->tree); /* above the root of 3 times that */
    const unsigned members = traits_of(s)->members;
    if (traits_of(s)->neighbors)
        return collect_nearest(s, slack);
    return members & OCTREE_QUERY_HAS_BOX ? collect_box(s, slack) : collect_ball(s, s->radius, slack);
}

/* ---- Boxes and balls ---------------------------------------------------------------------------------------- */

/* The sign of a - b - length in real numbers; a and b may be infinite. */
static int compare_gap(double a, double b, double length)
{
    if (isinf(a) || isinf(b))
        return a > b ? 1 : -1;
    exact_sum sum;
    exact_clear(&sum);
    exact_add_product(&sum, 1, a, 1);
    exact_add_product(&sum, -1, b, 1);
    exact_add_product(&sum, -1, length, 1);
    return exact_sign(&sum);
}

/* Whether a point that is not of the true answer may be named all the same. */
static bool is_allowed(const judge_state *s, const double at[3])
{
    if (!(s->epsilon > 0))
        return false;
    if (traits_of(s)->members & OCTREE_QUERY_HAS_RADIUS) {
        const double reach = exact_add_up(s->radius, s->epsilon);
        return isinf(reach) || metric_compare_radius(s->target, at, reach) <= 0;
    }
    bool within = true;
    for (int i = 0; i < 3; i++)
        within &=
            compare_gap(s->box.min[i], at[i], s->epsilon) <= 0 && compare_gap(at[i], s->box.max[i], s->epsilon) <= 0;
    return within;
}

static void list_accused(judge_state *s, const judged_point *p, size_t *count)
{
    s->failed |= !list_push(&s->about->game->memory, &s->about->game->accused, &p->point, sizeof p->point);
    ++*count;
}

/* Append those of a list, which is by id, that another lacks. */
static void list_lacking(judge_state *s, const list *of, const list *other, bool named, size_t *count)
{
    const judged_point *items = of->items, *others = other->items;
    for (size_t i = 0, j = 0; !s->failed && i < of->count; i++) {
        while (j < other->count && compare_ids(&others[j], &items[i]) < 0)
            j++;
        const bool lacks = j == other->count || compare_ids(&others[j], &items[i]) > 0;
        if (lacks && !(named && is_allowed(s, items[i].at)))
            list_accused(s, &items[i], count);
    }
}

static void judge_set(judge_state *s)
{
    octree_game *game = s->about->game;
    sort(&game->truth, compare_ids);
    list_lacking(s, &game->truth, &game->named, false, &s->made->missed_count);
    list_lacking(s, &game->named, &game->truth, true, &s->made->extra_count);
    if (s->made->missed_count)
        accuse(s, OCTREE_FAULT_MISSED, 0);
    if (s->made->extra_count)
        accuse(s, OCTREE_FAULT_EXTRA, 0);
}

/* ---- Neighbours --------------------------------------------------------------------------------------------- */

/* Whether a, which is farther than the true neighbour b, is farther than the promise allows. */
static bool is_farther(const judge_state *s, const judged_point *a, const judged_point *b)
{
    if (!(s->epsilon > 0) || same_position(b->at, s->target))
        return true;
    const double factor = 1 + s->epsilon; /* what it and the squares are off by is within the band of metric_above */
    return a->square > metric_above(factor * factor * (b->square + 0x1p-999));
}

static void judge_ranks(judge_state *s, const judged_point *named, const judged_point *truth, size_t count)
{
    octree_judgement *made = s->made;
    made->ratio = count == 0 && made->expected > 0 ? INFINITY : 1;
    for (size_t i = 0; i < count; i++) {
        if (compare_distances(&named[i], &truth[i]) <= 0)
            continue;
        const double ratio = metric_distance(named[i].at, s->target) / metric_distance(truth[i].at, s->target);
        made->ratio = ratio > made->ratio ? ratio : made->ratio;
        if (made->rank == 0 && is_farther(s, &named[i], &truth[i]))
            made->rank = i + 1;
    }
    if (made->rank)
        accuse(s, OCTREE_FAULT_FARTHER, 0);
}

/* Of a wrong answer. Every right one has the points that are nearer than the last of the truth, and of those at its
 * distance as many as it takes; none has any that are farther. */
static void list_wrong_neighbors(judge_state *s)
{
    octree_game *game = s->about->game;
    octree_judgement *made = s->made;
    const judged_point *truth = game->truth.items, *named = game->named.items;
    const judged_point *last = game->truth.count ? &truth[game->truth.count - 1] : NULL;
    size_t in_reach = 0;
    while (last && in_reach < game->named.count && compare_distances(&named[in_reach], last) <= 0)
        in_reach++;
    for (size_t i = 0, j = 0; !s->failed && i < game->truth.count; i++) {
        while (j < in_reach && compare_ranks(&named[j], &truth[i]) < 0)
            j++;
        const bool lacks = j == in_reach || named[j].point.id != truth[i].point.id;
        const bool needed = compare_distances(&truth[i], last) < 0 || made->missed_count + in_reach < game->truth.count;
        if (lacks && needed)
            list_accused(s, &truth[i], &made->missed_count);
    }
    for (size_t i = in_reach; !s->failed && i < game->named.count; i++)
        if (!last || is_farther(s, &named[i], last))
            list_accused(s, &named[i], &made->extra_count);
}

/* Of an answer that has so many ids. */
static void judge_neighbors(judge_state *s, size_t given)
{
    octree_game *game = s->about->game;
    const size_t named = game->named.count, truth = game->truth.count, ranks = named < truth ? named : truth;
    sort(&game->named, compare_ranks);
    judge_ranks(s, game->named.items, game->truth.items, ranks);
    if (given != truth)
        accuse(s, OCTREE_FAULT_COUNT, 0);
    if (named != truth && s->made->rank == 0)
        s->made->rank = ranks + 1;
    if (s->made->fault)
        list_wrong_neighbors(s);
}

/* ---- An answer ---------------------------------------------------------------------------------------------- */

static octree_status find_truth(judge_state *s)
{
    octree_status status = OCTREE_OK;
    if (s->rounds)
        status = list_rounded_truth(s);
    else
        list_truth(s);
    s->made->expected = s->about->game->truth.count;
    return s->failed ? OCTREE_NO_MEMORY : status;
}

static octree_status compare(judge_state *s, size_t given)
{
    if (traits_of(s)->neighbors)
        judge_neighbors(s, given);
    else
        judge_set(s);
    return s->failed ? OCTREE_NO_MEMORY : OCTREE_OK;
}

octree_status judge(const judging *about, octree_judgement *made)
{
    octree_game *game = about->game;
    *made = (octree_judgement){.judged = true, .given_count = about->query->answer_count};
    judge_state s = begin(about, made);
    game->named.count = game->truth.count = 0;
    list_named(&s);
    const octree_status status = s.failed ? OCTREE_NO_MEMORY : find_truth(&s);
    return status == OCTREE_OK ? compare(&s, about->query->answer_count) : status;
}

/* ---- An answer without some points -------------------------------------------------------------------------- */

static void drop_lost(list *l, point_test *is_lost, void *context)
{
    judged_point *items = l->items;
    size_t kept = 0;
    for (size_t i = 0; i < l->count; i++)
        if (!is_lost(&items[i].point, context))
            items[kept++] = items[i];
    l->count = kept;
}

/* Into `named`, which is empty: the points that other neighbours can be, those within the promise of the last. */
static octree_status list_other_neighbors(judge_state *s)
{
    octree_game *game = s->about->game;
    const judged_point *last = (const judged_point *)game->truth.items + game->truth.count - 1;
    const double distance = metric_distance(s->target, last->at), factor = (1 + s->epsilon) * (1 + 0x1p-40);
    const list truth = game->truth;
    game->truth = game->named;
    const octree_status status = collect_ball(s, distance < DBL_MAX / factor ? distance * factor : DBL_MAX,
                                              s->rounds ? 2 * rounding_of(s->about->game->tree) : 0x1p-1000);
    game->named = game->truth;
    game->truth = truth;
    return s->failed ? OCTREE_NO_MEMORY : status;
}

octree_status judge_without(const judging *about, point_test *is_lost, point_visit *blame, void *context)
{
    octree_game *game = about->game;
    octree_judgement made = {.judged = true};
    judge_state s = begin(about, &made);
    const size_t accused = game->accused.count;
    game->named.count = game->truth.count = 0;
    octree_status status = find_truth(&s);
    for (size_t i = 0; i < game->truth.count; i++)
        keep(&s, &game->named, (const judged_point *)game->truth.items + i);
    drop_lost(&game->named, is_lost, context);
    if (status != OCTREE_OK || s.failed || game->named.count == game->truth.count)
        return s.failed ? OCTREE_NO_MEMORY : status;
    if (traits_of(&s)->neighbors) {
        game->named.count = 0;
        status = list_other_neighbors(&s);
        drop_lost(&game->named, is_lost, context);
        sort(&game->named, compare_ranks);
        game->named.count = game->named.count < game->truth.count ? game->named.count : game->truth.count;
    } else {
        sort(&game->named, compare_ids);
    }
    if (status == OCTREE_OK)
        status = compare(&s, game->named.count);
    const octree_point *missed = game->accused.items;
    for (size_t i = 0; status == OCTREE_OK && made.fault && i < made.missed_count; i++)
        status = blame(&missed[accused + i], context); /* only what is lost is missed: others are as near as any */
    game->accused.count = accused;
    return status;
}

void judge_assign(octree_game *game)
{
    const uint64_t *given = game->given.items;
    const octree_point *accused = game->accused.items;
    octree_answer *answers = game->answers.items;
    size_t ids = 0, points = 0; /* of the answers before */
    for (size_t i = 0; i < game->answers.count; i++) {
        octree_judgement *made = &answers[i].judgement;
        made->given = made->given_count ? given + ids : NULL;
        made->missed = made->missed_count ? accused + points : NULL;
        made->extra = made->extra_count ? accused + points + made->missed_count : NULL;
        ids += made->given_count;
        points += made->missed_count + made->extra_count;
    }
}
