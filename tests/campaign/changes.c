/* SPDX-License-Identifier: MIT */
/* changes.c - random changes, applied to the tree and to the model; in some of them an allocation fails first. */
#include "arguments.h"
#include "fixture.h"
#include "octree/sample.h"
#include "operations.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { BATCH_AT_MOST = 64 };

typedef enum change_kind { INSERT, REMOVE, MOVE, INSERT_MANY, REMOVE_MANY, MOVE_MANY, REWORLD, CLEAR } change_kind;

static const char *const change_names[] = {"insert",      "remove",    "move",    "insert_many",
                                           "remove_many", "move_many", "reworld", "clear"};

typedef struct change {
    change_kind kind;
    octree_point points[BATCH_AT_MOST]; /* one of them, but for many */
    size_t count;
    double to[BATCH_AT_MOST][3]; /* where each moves to */
    octree_box world;            /* reworld */
    octree_status statuses[BATCH_AT_MOST];
    size_t done;     /* many: what the tree says */
    size_t happened; /* what the model says: changes that were made */
} change;

static octree_status apply(octree *tree, change *c)
{
    const octree_point *p = c->points;
    switch (c->kind) {
    case INSERT:
        return octree_insert(tree, p->position, p->id);
    case REMOVE:
        return octree_remove(tree, p->position, p->id);
    case MOVE:
        return octree_move(tree, p->position, p->id, c->to[0]);
    case INSERT_MANY:
        return octree_insert_many(tree, p, c->count, c->statuses, &c->done);
    case REMOVE_MANY:
        return octree_remove_many(tree, p, c->count, c->statuses, &c->done);
    case MOVE_MANY:
        return octree_move_many(tree, p, (const double(*)[3])c->to, c->count, c->statuses, &c->done);
    case REWORLD:
        return octree_reworld(tree, &c->world);
    default:
        return octree_clear(tree);
    }
}

/* Apply one change of many to the model. Returns the status that the tree must return. */
static octree_status apply_one(model *m, const change *c, size_t i)
{
    const octree_point *p = &c->points[i];
    if (c->kind == MOVE_MANY)
        return model_move(m, p->position, p->id, c->to[i]);
    return c->kind == INSERT_MANY ? model_insert(m, p->position, p->id) : model_remove(m, p->position, p->id);
}

static bool compare_many(trial *t, change *c)
{
    c->happened = 0;
    for (size_t i = 0; i < c->count; i++) {
        const octree_status expected = apply_one(&t->model, c, i);
        c->happened += expected == OCTREE_OK;
        if (c->statuses[i] != expected)
            return trial_fail(t, "%s: point %zu of %zu is said to be %s, and is %s", change_names[c->kind], i, c->count,
                              octree_status_name(c->statuses[i]), octree_status_name(expected));
    }
    return c->done == c->happened || trial_fail(t, "%s: %zu points are said to be done, and %zu are",
                                                change_names[c->kind], c->done, c->happened);
}

/* Compare the results of the tree and of the model. */
static bool compare(trial *t, change *c, octree_status status)
{
    octree_status expected = OCTREE_OK;
    const octree_point *p = c->points;
    switch (c->kind) {
    case INSERT:
        expected = model_insert(&t->model, p->position, p->id);
        break;
    case REMOVE:
        expected = model_remove(&t->model, p->position, p->id);
        break;
    case MOVE:
        expected = model_move(&t->model, p->position, p->id, c->to[0]);
        break;
    case REWORLD:
        expected = model_reworld(&t->model, &c->world);
        break;
    case CLEAR:
        model_clear(&t->model);
        break;
    default:
        break;
    }
    if (status != expected)
        return trial_fail(t, "%s of (%a, %a, %a), to (%a, %a, %a): the answer is %s and not %s", change_names[c->kind],
                          p->position[0], p->position[1], p->position[2], c->to[0][0], c->to[0][1], c->to[0][2],
                          octree_status_name(status), octree_status_name(expected));
    if (c->kind == INSERT_MANY || c->kind == REMOVE_MANY || c->kind == MOVE_MANY)
        return compare_many(t, c);
    c->happened = status == OCTREE_OK;
    return true;
}

/* Let an allocation of the change fail, if there is one: the change must be refused and leave the tree unchanged. */
static bool fail_first(trial *t, change *c, octree_status *status)
{
    const uint64_t version = octree_version(t->tree);
    counting_allocator_fail_at(&t->memory, below(t, 5));
    *status = apply(t->tree, c);
    counting_allocator_stop_failing(&t->memory);
    if (*status != OCTREE_NO_MEMORY)
        return true;
    if (octree_version(t->tree) != version || octree_count(t->tree) != t->model.count)
        return trial_fail(t, "%s without memory changes the tree", change_names[c->kind]);
    if (!trial_audit(t))
        return false;
    *status = apply(t->tree, c);
    return true;
}

static bool do_change(trial *t, change *c)
{
    const uint64_t version = octree_version(t->tree);
    octree_status status;
    if (below(t, 32) > 0)
        status = apply(t->tree, c);
    else if (!fail_first(t, c, &status))
        return false;
    if (!compare(t, c, status))
        return false;
    if (octree_count(t->tree) != t->model.count)
        return trial_fail(t, "%s leaves %zu points and not %zu", change_names[c->kind], octree_count(t->tree),
                          t->model.count);
    t->answers = c->happened;
    if (c->happened == 0 && octree_version(t->tree) != version)
        return trial_fail(t, "%s does nothing, and the version tells of a change", change_names[c->kind]);
    if (c->happened > 0 && octree_version(t->tree) <= version) /* a lower one will be met again with other contents */
        return trial_fail(t, "%s is told by version %" PRIu64 " after %" PRIu64, change_names[c->kind],
                          octree_version(t->tree), version);
    return true;
}

/* Insertions and removals keep the number of points near the population of the scene. */
static bool has_enough(trial *t)
{
    return below(t, 2 * t->population) < t->model.count;
}

static bool insert_one(trial *t)
{
    change c = {.kind = INSERT};
    any_position(t, c.points[0].position);
    c.points[0].id = any_id(t);
    return do_change(t, &c);
}

static bool remove_one(trial *t)
{
    change c = {.kind = REMOVE};
    c.points[0] = any_pair(t);
    return do_change(t, &c);
}

bool change_one(trial *t)
{
    return has_enough(t) ? remove_one(t) : insert_one(t);
}

bool change_move(trial *t)
{
    change c = {.kind = MOVE};
    c.points[0] = any_pair(t);
    any_position(t, c.to[0]);
    return do_change(t, &c);
}

bool change_insert_many(trial *t)
{
    change c = {.kind = INSERT_MANY};
    const size_t most = has_enough(t) ? 3 : BATCH_AT_MOST + 1;
    for (size_t left = below(t, most); left > 0; left--) {
        octree_point *p = &c.points[c.count++];
        any_position(t, p->position);
        p->id = any_id(t);
        if (c.count > 1 && below(t, 8) == 0)
            *p = c.points[below(t, c.count - 1)]; /* twice in one batch */
    }
    return do_change(t, &c);
}

bool change_remove_many(trial *t)
{
    change c = {.kind = REMOVE_MANY};
    const size_t most = has_enough(t) ? BATCH_AT_MOST + 1 : 3;
    for (size_t left = below(t, most); left > 0; left--)
        c.points[c.count++] = any_pair(t);
    return do_change(t, &c);
}

/* In some batches a point moves to the place that another one leaves, or all points move. */
bool change_move_many(trial *t)
{
    change c = {.kind = MOVE_MANY};
    const bool all = t->model.count <= BATCH_AT_MOST && below(t, 4) == 0;
    for (size_t left = all ? t->model.count : below(t, BATCH_AT_MOST + 1); left > 0; left--) {
        c.points[c.count] = all ? t->model.points[left - 1] : any_pair(t);
        any_position(t, c.to[c.count]);
        const size_t earlier = c.count ? below(t, c.count) : 0, what = c.count && !all ? below(t, 10) : 9;
        if (what == 0) {
            memcpy(c.points[c.count].position, c.to[earlier], sizeof c.to[0]);
            c.points[c.count].id = c.points[earlier].id;
        } else if (what == 1) {
            memcpy(c.to[c.count], c.points[earlier].position, sizeof c.to[0]);
        }
        c.count++;
    }
    return do_change(t, &c);
}

/* A slightly larger world, or one so large that all points share few cells. */
static octree_box larger(trial *t, octree_box world)
{
    const int doublings = below(t, 2) == 0 ? 0 : (int)below(t, 22);
    for (int i = 0; i < 3; i++) {
        const double half = world.max[i] / 2 - world.min[i] / 2;
        world.min[i] = scene_nudge(world.min[i] - ldexp(half * octree_random_unit(&t->random), doublings), -1);
        world.max[i] = scene_nudge(world.max[i] + ldexp(half * octree_random_unit(&t->random), doublings), 1);
    }
    return world;
}

/* The world of the scene, a larger one, one that excludes points, or an invalid one. */
static octree_box another_world(trial *t)
{
    octree_box world = t->model.def.world;
    const size_t kind = below(t, 8), axis = below(t, 3);
    if (kind < 2)
        return t->scene.world;
    if (kind > 4)
        return larger(t, world);
    if (kind == 2)
        world.max[axis] = world.min[axis] / 2 + world.max[axis] / 2;
    else if (kind == 3)
        world.max[axis] = world.min[axis];
    else
        world.min[axis] = scene_nudge(world.min[axis], -1 - (int)below(t, 3));
    return world;
}

bool change_reworld(trial *t)
{
    change c = {.kind = REWORLD, .world = another_world(t)};
    return do_change(t, &c);
}

bool change_clear(trial *t)
{
    change c = {.kind = CLEAR};
    return do_change(t, &c);
}
