/* SPDX-License-Identifier: MIT */
/* ask_neighbors.c - checks nearest neighbours and balls, decided by real numbers, and the approximate answers that an
 * epsilon or FAST mode allows. */
#include "arguments.h"
#include "brute.h"
#include "fixture.h"
#include "judge.h"
#include "operations.h"
#include "quick_oracle.h"

#include <inttypes.h>
#include <float.h>
#include <math.h>
#include <string.h>

/* A search about a target; the verdicts say which points count at all. */
typedef struct question {
    double target[3];
    octree_search how;
    double radius; /* negative: none */
    size_t eligible;
    const char *name;
} question;

/* Half of the world's extent; in FAST mode 2^-489 of it is always allowed. */
static double tolerance(const trial *t, octree_mode mode)
{
    double most = 0;
    for (int axis = 0; axis < 3; axis++)
        most = fmax(most, t->model.def.world.max[axis] / 2 - t->model.def.world.min[axis] / 2);
    return mode == OCTREE_FAST ? most * 0x1p-489 : 0;
}

static bool is_exact(const octree_search *how)
{
    return how->mode == OCTREE_EXACT && how->epsilon == 0;
}

/* Always false. */
static bool explain(trial *t, const question *q)
{
    static const char *const skips[] = {"nobody", "an id", "the same place"};
    return trial_add(t, "; to (%a, %a, %a) within %a, epsilon %a, %s, but for %s", q->target[0], q->target[1],
                     q->target[2], q->radius, q->how.epsilon, q->how.mode == OCTREE_FAST ? "FAST" : "exact",
                     skips[q->how.skip]);
}

/* Which points a ball has: all that must be in it, and in FAST mode or with an epsilon those that may be. */
static verdict verdict_of(const question *q, const double p[3], double epsilon, double slack)
{
    if (q->radius < 0)
        return MUST;
    if (q->radius >= slack && quick_compare_radius(q->target, p, q->radius, -slack) <= 0)
        return MUST;
    const double most = slack == 0 ? epsilon : scene_nudge(epsilon + slack, 1);
    return most > 0 && quick_compare_radius(q->target, p, q->radius, most) <= 0 ? MAY : MUST_NOT;
}

static void judge_ball(trial *t, question *q, double epsilon, bool skips)
{
    double slack = 0;
    if (q->how.mode == OCTREE_FAST && q->radius >= 0)
        slack = fmax(fmin(q->radius + epsilon, DBL_MAX) * 0x1p-50, fmax(tolerance(t, OCTREE_FAST), 0x1p-1074));
    q->eligible = 0;
    for (size_t i = 0; i < t->model.count; i++) {
        const octree_point *p = &t->model.points[i];
        const bool counts = !skips || !brute_is_skipped(p, q->target, q->how.skip, q->how.skip_id);
        t->verdicts[i] = counts ? verdict_of(q, p->position, epsilon, slack) : MUST_NOT;
        q->eligible += t->verdicts[i] == MUST;
    }
}

static void any_question(trial *t, question *q, const char *name, bool with_radius)
{
    q->name = name;
    any_target(t, q->target);
    q->how = any_search(t);
    q->how.epsilon = any_ratio(t);
    q->radius = with_radius ? any_radius(t, q->target) : -1;
}

static bool fail_at(trial *t, const question *q, size_t i, const octree_neighbor *n, const char *what)
{
    return trial_fail(t, "%s: number %zu, point %" PRIu64 " at (%a, %a, %a), distance %a, %s", q->name, i, n->point.id,
                      n->point.position[0], n->point.position[1], n->point.position[2], n->distance, what);
}

/* The order of the real numbers, then by id, then by position. */
static int order(const double target[3], const octree_point *a, const octree_point *b)
{
    const int nearer = quick_compare(target, a->position, b->position);
    return nearer != 0 ? nearer : model_order(a, b);
}

/* Whether the distance is the real one: within a few doubles, and in FAST mode within its bound. */
static bool is_distance(const trial *t, const question *q, const octree_neighbor *n)
{
    if (quick_distance_is(n->distance, 4, q->target, n->point.position) || q->how.mode == OCTREE_EXACT)
        return quick_distance_is(n->distance, 4, q->target, n->point.position);
    const double off = fmax(n->distance * 0x1p-48, 2 * tolerance(t, OCTREE_FAST));
    return isinf(n->distance) ||
           (quick_compare_radius(q->target, n->point.position, n->distance, scene_nudge(off, 1)) <= 0 &&
            (off >= n->distance || quick_compare_radius(q->target, n->point.position, n->distance, -off) >= 0));
}

/* Each is stored, counts, is named once and in order, and tells its distance. */
static bool judge_list(trial *t, const question *q, const octree_neighbor *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const size_t at = model_find_bits(&t->model, &list[i].point);
        if (at == MODEL_NONE || t->verdicts[at] == MUST_NOT)
            return fail_at(t, q, i, &list[i], at == MODEL_NONE ? "is not stored" : "does not count, or is there twice");
        t->verdicts[at] = MUST_NOT;
        if (i > 0 && q->how.mode == OCTREE_EXACT && order(q->target, &list[i - 1].point, &list[i].point) >= 0)
            return fail_at(t, q, i, &list[i], "is not in order");
        if ((i > 0 && list[i].distance < list[i - 1].distance) || !is_distance(t, q, &list[i]))
            return fail_at(t, q, i, &list[i], "is said to be at another distance");
    }
    return true;
}

/* In order as they are, they are the nearest when none of the others comes before the last. */
static bool judge_exact(trial *t, const question *q, const octree_neighbor *list, size_t count)
{
    const octree_point *last = &list[count - 1].point;
    for (size_t i = 0; i < t->model.count; i++)
        if (t->verdicts[i] == MUST && order(q->target, &t->model.points[i], last) < 0)
            return fail_at(t, q, count - 1, &list[count - 1], "is not so near as another");
    return true;
}

/* Whether a point at a may stand for one at b. */
static bool may_stand_for(const trial *t, const question *q, const double a[3], const double b[3])
{
    const double ratio = q->how.epsilon;
    if (q->how.mode == OCTREE_EXACT)
        return quick_compare_ratio(q->target, a, b, ratio) <= 0;
    return quick_compare_ratio(q->target, a, b, ratio + 0x1p-50 * (1 + ratio)) <= 0 ||
           quick_compare_longer(q->target, a, b, tolerance(t, OCTREE_FAST)) <= 0;
}

/* Number i, from 0, may stand for the true one when it may not stand for i points at most: they are the nearest i. */
static bool stands(trial *t, const question *q, const octree_neighbor *list, size_t i)
{
    size_t too_near = 0;
    for (size_t j = 0; j < t->model.count; j++) {
        const octree_point *p = &t->model.points[j];
        const bool counts = !brute_is_skipped(p, q->target, q->how.skip, q->how.skip_id);
        too_near += counts && !may_stand_for(t, q, list[i].point.position, p->position);
    }
    return too_near <= i || fail_at(t, q, i, &list[i], "is farther than its bound");
}

/* The verdicts are spent. */
static bool judge_neighbors(trial *t, const question *q, const octree_neighbor *list, size_t count)
{
    t->answers += count;
    if (!judge_list(t, q, list, count) || count == 0)
        return count == 0;
    if (is_exact(&q->how))
        return judge_exact(t, q, list, count);
    const size_t any = below(t, count);
    return stands(t, q, list, 0) && (count == 1 || (stands(t, q, list, count - 1) && stands(t, q, list, any)));
}

static bool said(trial *t, octree_status status, octree_status expected, const question *q)
{
    return status == expected ||
           trial_fail(t, "%s says %s and not %s", q->name, octree_status_name(status), octree_status_name(expected));
}

bool ask_nearest(trial *t)
{
    question q;
    any_question(t, &q, "nearest", false);
    q.how.epsilon = 0;
    q.how.mode = OCTREE_EXACT;
    judge_ball(t, &q, 0, true);
    const octree_status status = octree_nearest(t->tree, q.target, q.how.skip, q.how.skip_id, t->neighbors);
    return (said(t, status, q.eligible > 0 ? OCTREE_OK : OCTREE_NOT_FOUND, &q) &&
            judge_neighbors(t, &q, t->neighbors, q.eligible > 0)) ||
           explain(t, &q);
}

static bool said_count(trial *t, size_t count, size_t expected, const question *q)
{
    return count == expected || trial_fail(t, "%s gives %zu of %zu", q->name, count, expected);
}

bool ask_nearest_k(trial *t)
{
    question q;
    any_question(t, &q, "nearest_k", false);
    judge_ball(t, &q, 0, true);
    const size_t counts[] = {0, 1, 2, 3, 8, 8, 16, q.eligible, q.eligible + 1, SIZE_MAX};
    const size_t k = counts[below(t, 10)];
    size_t count = SIZE_MAX;
    const octree_status status = octree_nearest_k(t->tree, q.target, k, &q.how, t->neighbors, &count);
    return (said(t, status, OCTREE_OK, &q) && said_count(t, count, k < q.eligible ? k : q.eligible, &q) &&
            judge_neighbors(t, &q, t->neighbors, count)) ||
           explain(t, &q);
}

bool ask_nearest_within(trial *t)
{
    question q;
    any_question(t, &q, "nearest_within", true);
    judge_ball(t, &q, 0, true);
    const octree_status status = octree_nearest_within(t->tree, q.target, q.radius, &q.how, t->neighbors);
    bool may_find = false;
    for (size_t i = 0; i < t->model.count; i++)
        may_find = may_find || t->verdicts[i] != MUST_NOT;
    if (status == OCTREE_NOT_FOUND && q.eligible == 0)
        return true;
    return (said(t, status, may_find ? OCTREE_OK : OCTREE_NOT_FOUND, &q) && judge_neighbors(t, &q, t->neighbors, 1)) ||
           explain(t, &q);
}

enum { TARGETS_AT_MOST = 24 };

/* One of a batch; where nothing was found its place is untouched. */
static bool judge_one(trial *t, question *q, const double target[3], const octree_neighbor *n, bool found)
{
    memcpy(q->target, target, sizeof q->target);
    judge_ball(t, q, 0, true);
    if (found != (q->eligible > 0) || found != (n->distance != -1))
        return trial_fail(t, "%s: there is %s", q->name, q->eligible > 0 ? "one" : "none");
    return judge_neighbors(t, q, n, found);
}

bool ask_nearest_batch(trial *t)
{
    question q;
    double targets[TARGETS_AT_MOST][3];
    bool found[TARGETS_AT_MOST];
    const size_t count = below(t, TARGETS_AT_MOST + 1);
    any_question(t, &q, "nearest_batch", false);
    for (size_t i = 0; i < count; i++) {
        any_target(t, targets[i]);
        t->neighbors[i].distance = -1;
    }
    const bool told = below(t, 2) == 0;
    const octree_status status =
        octree_nearest_batch(t->tree, (const double(*)[3])targets, count, &q.how, t->neighbors, told ? found : NULL);
    bool ok = said(t, status, OCTREE_OK, &q);
    for (size_t i = 0; ok && i < count; i++)
        ok = judge_one(t, &q, targets[i], &t->neighbors[i], told ? found[i] : t->neighbors[i].distance != -1);
    return ok || explain(t, &q);
}

bool ask_radius(trial *t)
{
    question q;
    any_question(t, &q, "radius", true);
    q.how.epsilon = any_slack(t, q.target);
    judge_ball(t, &q, q.how.epsilon, false);
    gather_begin(t, 0);
    const octree_status status = octree_radius(t->tree, q.target, q.radius, &q.how, gather, &t->found);
    return (said(t, status, OCTREE_OK, &q) && judge(t, q.name)) || explain(t, &q);
}
