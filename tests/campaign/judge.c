/* SPDX-License-Identifier: MIT */
/* judge.c - see judge.h. */
#include "judge.h"

#include <inttypes.h>

void gather_begin(trial *t, size_t stop_at)
{
    t->found.count = 0;
    t->found.seals = 0;
    t->found.stop_at = stop_at;
}

bool gather(const octree_point *point, void *context)
{
    gathered *found = context;
    if (found->count < POINTS_AT_MOST)
        found->points[found->count] = *point;
    found->count++;
    found->seals += model_seal(point);
    return found->count != found->stop_at;
}

static bool fail_with(trial *t, const char *question, const char *what, const octree_point *p)
{
    return trial_fail(t, "%s: point %" PRIu64 " at (%a, %a, %a) %s", question, p->id, p->position[0], p->position[1],
                      p->position[2], what);
}

/* Each found point is removed from the verdicts; points that must be found and are left were missed. */
static bool judge_each(trial *t, const char *question, bool whole)
{
    for (size_t i = 0; i < t->found.count && i < POINTS_AT_MOST; i++) {
        const size_t at = model_find_bits(&t->model, &t->found.points[i]);
        if (at == MODEL_NONE)
            return fail_with(t, question, "is found and is not stored", &t->found.points[i]);
        if (t->verdicts[at] == MUST_NOT)
            return fail_with(t, question, "is found and does not belong, or is found twice", &t->found.points[i]);
        t->verdicts[at] = MUST_NOT;
    }
    for (size_t i = 0; whole && i < t->model.count; i++)
        if (t->verdicts[i] == MUST)
            return fail_with(t, question, "is missed", &t->model.points[i]);
    return t->found.count <= t->model.count || trial_fail(t, "%s: too many points are found", question);
}

bool judge(trial *t, const char *question)
{
    size_t expected = 0, open = 0;
    uint64_t seals = 0;
    for (size_t i = 0; i < t->model.count; i++) {
        const bool belongs = t->verdicts[i] == MUST;
        expected += belongs;
        seals += belongs ? t->model.seals[i] : 0;
        open += t->verdicts[i] == MAY;
    }
    t->answers += t->found.count;
    if (open == 0 && t->found.count == expected && t->found.seals == seals)
        return true;
    return judge_each(t, question, true) &&
           (open > 0 || trial_fail(t, "%s: the points' bits are not those that were stored", question));
}

bool judge_stopped(trial *t, const char *question)
{
    size_t expected = 0;
    for (size_t i = 0; i < t->model.count; i++)
        expected += t->verdicts[i] == MUST;
    expected = expected < t->found.stop_at ? expected : t->found.stop_at;
    t->answers += t->found.count;
    if (t->found.count != expected)
        return trial_fail(t, "%s: a visitor that stops at call %zu is called %zu times, not %zu", question,
                          t->found.stop_at, t->found.count, expected);
    return judge_each(t, question, false);
}
