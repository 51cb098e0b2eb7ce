/* SPDX-License-Identifier: MIT */
/* ask_boxes.c - checks queries for boxes, at rest and moving: ranges and collisions. */
#include "arguments.h"
#include "fixture.h"
#include "judge.h"
#include "operations.h"
#include "quick_oracle.h"

#include <float.h>
#include <math.h>

/* A box and the epsilon it is asked for with; epsilon is 0 for functions that take none. */
typedef struct box_question {
    octree_box box;
    octree_search how;
    const char *name;
} box_question;

static verdict verdict_of(const octree_box *box, double epsilon, const double p[3])
{
    if (box_holds(box, p))
        return MUST;
    for (int axis = 0; axis < 3; axis++) {
        const double face = p[axis] < box->min[axis] ? box->min[axis] : box->max[axis];
        const bool outside = p[axis] < box->min[axis] || p[axis] > box->max[axis];
        if (outside && (epsilon == 0 || isinf(face) || !quick_within(face, epsilon, p[axis])))
            return MUST_NOT;
    }
    return MAY;
}

/* A random box and the verdicts of all points. */
static void any_question(trial *t, box_question *q, const char *name, bool with_epsilon)
{
    q->box = any_box(t);
    q->how = any_search(t);
    double corner[3];
    for (int axis = 0; axis < 3; axis++)
        corner[axis] = isfinite(q->box.min[axis]) ? q->box.min[axis] : 0;
    q->how.epsilon = with_epsilon ? any_slack(t, corner) : 0;
    for (size_t i = 0; i < t->model.count; i++)
        t->verdicts[i] = verdict_of(&q->box, q->how.epsilon, t->model.points[i].position);
    q->name = name;
}

/* Always false. */
static bool explain(trial *t, const box_question *q)
{
    const double *low = q->box.min, *high = q->box.max;
    return trial_add(t, "; the box is (%a, %a, %a) to (%a, %a, %a), epsilon %a", low[0], low[1], low[2], high[0],
                     high[1], high[2], q->how.epsilon);
}

static bool said_ok(trial *t, octree_status status, const char *question)
{
    return status == OCTREE_OK || trial_fail(t, "%s says %s", question, octree_status_name(status));
}

bool ask_range(trial *t)
{
    box_question q;
    any_question(t, &q, "range", true);
    gather_begin(t, 0);
    const bool plain = q.how.epsilon == 0 && below(t, 2) == 0;
    const octree_status status = plain ? octree_range(t->tree, &q.box, gather, &t->found)
                                       : octree_range_search(t->tree, &q.box, &q.how, gather, &t->found);
    return (said_ok(t, status, q.name) && judge(t, q.name)) || explain(t, &q);
}

bool ask_range_stopped(trial *t)
{
    box_question q;
    any_question(t, &q, "range", false);
    gather_begin(t, 1 + below(t, 8));
    const octree_status status = octree_range(t->tree, &q.box, gather, &t->found);
    return (said_ok(t, status, q.name) && judge_stopped(t, q.name)) || explain(t, &q);
}

static size_t count_must(const trial *t)
{
    size_t count = 0;
    for (size_t i = 0; i < t->model.count; i++)
        count += t->verdicts[i] == MUST;
    return count;
}

static bool said_count(trial *t, size_t count, const char *question)
{
    return count == count_must(t) || trial_fail(t, "%s counts %zu points and not %zu", question, count, count_must(t));
}

bool ask_range_count(trial *t)
{
    box_question q;
    size_t count = SIZE_MAX;
    any_question(t, &q, "range_count", false);
    const octree_status status = octree_range_count(t->tree, &q.box, &count);
    t->answers += count;
    return (said_ok(t, status, q.name) && said_count(t, count, q.name)) || explain(t, &q);
}

/* The points that were written, as if a visitor had seen them; one place behind the room must be as it was. */
static bool take_collected(trial *t, const octree_point *points, size_t room, size_t count, const char *question)
{
    static const octree_point untouched = {{0, 0, 0}, 0x5eed};
    if (model_seal(&points[room]) != model_seal(&untouched))
        return trial_fail(t, "%s writes beyond its room", question);
    gather_begin(t, 0);
    for (size_t i = 0; i < count && i < room; i++)
        gather(&points[i], &t->found);
    return true;
}

/* Room for all, or for too few. */
static size_t any_room(trial *t, octree_point *points)
{
    const size_t room = below(t, 2) == 0 ? POINTS_AT_MOST : below(t, 20);
    points[room] = (octree_point){{0, 0, 0}, 0x5eed};
    return room;
}

/* Any of those that belong, within the room. */
static bool judge_collected(trial *t, const box_question *q, size_t room, size_t count)
{
    if (count <= room)
        return judge(t, q->name);
    if (q->how.epsilon == 0 && !said_count(t, count, q->name))
        return false;
    for (size_t i = 0; i < t->model.count; i++)
        t->verdicts[i] = t->verdicts[i] == MUST ? MAY : t->verdicts[i];
    return judge(t, q->name);
}

bool ask_range_collect(trial *t)
{
    box_question q;
    octree_point points[POINTS_AT_MOST + 1];
    size_t count = 0;
    any_question(t, &q, "range_collect", true);
    const size_t room = any_room(t, points);
    const octree_status status = octree_range_collect(t->tree, &q.box, &q.how, points, room, &count);
    return (said_ok(t, status, q.name) && take_collected(t, points, room, count, q.name) &&
            judge_collected(t, &q, room, count)) ||
           explain(t, &q);
}

/* All that belong, or the first of them in order. */
static bool judge_sorted(trial *t, const box_question *q, const octree_point *points, size_t room, size_t count)
{
    for (size_t i = 1; i < t->found.count; i++)
        if (model_order(&points[i - 1], &points[i]) >= 0)
            return trial_fail(t, "%s is not sorted at number %zu", q->name, i);
    if (q->how.epsilon == 0 && !said_count(t, count, q->name))
        return false;
    for (size_t i = 0; count > room && i < t->model.count; i++)
        if (room == 0 || model_order(&points[room - 1], &t->model.points[i]) < 0)
            t->verdicts[i] = MUST_NOT;
    return judge(t, q->name);
}

bool ask_range_collect_sorted(trial *t)
{
    box_question q;
    octree_point points[POINTS_AT_MOST + 1];
    size_t count = 0;
    any_question(t, &q, "range_collect_sorted", true);
    const size_t room = any_room(t, points);
    const octree_status status = octree_range_collect_sorted(t->tree, &q.box, &q.how, points, room, &count);
    return (said_ok(t, status, q.name) && take_collected(t, points, room, count, q.name) &&
            judge_sorted(t, &q, points, room, count)) ||
           explain(t, &q);
}

/* A stored pair, one that is not, or none. */
static const octree_point *any_self(trial *t, octree_point *self)
{
    *self = any_pair(t);
    return below(t, 2) == 0 ? self : NULL;
}

static bool is_left_out(const octree_point *self, const octree_point *p)
{
    return self != NULL && self->id == p->id && same_position(self->position, p->position);
}

/* The smallest and largest doubles within the size. */
static bool judge_collision_box(trial *t, const double center[3], double size)
{
    octree_box box;
    if (!said_ok(t, octree_collision_box(center, size, &box), "collision_box"))
        return false;
    for (int axis = 0; axis < 3; axis++)
        if (!quick_within(center[axis], size, box.min[axis]) || !quick_within(center[axis], size, box.max[axis]) ||
            (box.min[axis] > -DBL_MAX && quick_within(center[axis], size, next_down(box.min[axis]))) ||
            (box.max[axis] < DBL_MAX && quick_within(center[axis], size, next_up(box.max[axis]))))
            return trial_fail(t, "the collision box is (%a, %a) on axis %d", box.min[axis], box.max[axis], axis);
    return true;
}

bool ask_collide(trial *t)
{
    double center[3];
    octree_point pair;
    any_target(t, center);
    const double size = any_size(t, center);
    const octree_point *self = any_self(t, &pair);
    for (size_t i = 0; i < t->model.count; i++) {
        const octree_point *p = &t->model.points[i];
        bool touches = !is_left_out(self, p);
        for (int axis = 0; axis < 3; axis++)
            touches = touches && quick_within(center[axis], size, p->position[axis]);
        t->verdicts[i] = touches ? MUST : MUST_NOT;
    }
    gather_begin(t, 0);
    const octree_status status = octree_collide(t->tree, center, size, self, gather, &t->found);
    return (said_ok(t, status, "collide") && judge(t, "collide") && judge_collision_box(t, center, size)) ||
           trial_add(t, "; the centre is (%a, %a, %a), the size %a", center[0], center[1], center[2], size);
}

/* To any other place, or along one axis, or nowhere. */
static void any_step(trial *t, const double from[3], double to[3])
{
    const size_t kind = below(t, 8), only = below(t, 3);
    any_target(t, to);
    for (size_t axis = 0; axis < 3; axis++)
        if (kind == 0 || (kind < 4 && axis != only))
            to[axis] = from[axis];
}

bool ask_collide_swept(trial *t)
{
    double from[3], to[3];
    octree_point pair;
    any_target(t, from);
    any_step(t, from, to);
    const double size = any_size(t, below(t, 2) == 0 ? from : to);
    const octree_point *self = any_self(t, &pair);
    for (size_t i = 0; i < t->model.count; i++) {
        const octree_point *p = &t->model.points[i];
        t->verdicts[i] = !is_left_out(self, p) && quick_touches(from, to, size, p->position) ? MUST : MUST_NOT;
    }
    gather_begin(t, 0);
    const octree_status status = octree_collide_swept(t->tree, from, to, size, self, NULL, gather, &t->found);
    return (said_ok(t, status, "collide_swept") && judge(t, "collide_swept")) ||
           trial_add(t, "; from (%a, %a, %a) to (%a, %a, %a), the size %a", from[0], from[1], from[2], to[0], to[1],
                     to[2], size);
}
