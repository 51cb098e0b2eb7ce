/* SPDX-License-Identifier: MIT */
/* trial.c - see trial.h. */
#include "trial.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "judge.h"
#include "octree/sample.h"
#include "program.h"

size_t below(trial *t, size_t limit)
{
    return (size_t)random_below(&t->random, limit);
}

bool trial_fail(trial *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(t->fault, sizeof t->fault, format, arguments);
    va_end(arguments);
    return false;
}

bool trial_add(trial *t, const char *format, ...)
{
    va_list arguments;
    const size_t used = strlen(t->fault);
    va_start(arguments, format);
    vsnprintf(t->fault + used, sizeof t->fault - used, format, arguments);
    va_end(arguments);
    return false;
}

/* Mostly a few dozen points, so that a scan of all is cheap; now and then some hundreds. */
static size_t any_population(trial *t)
{
    static const size_t limits[] = {8, 8, 16, 32, 32, 64, 64, 64, 96, 128, 160, 400};
    return 1 + below(t, limits[below(t, sizeof limits / sizeof limits[0])]);
}

static octree_def any_definition(trial *t)
{
    static const size_t capacities[] = {1, 1, 2, 2, 3, 4, 6, 8, 16, 16, 32, 64};
    const size_t capacity = below(t, 3) == 0 ? 1 + below(t, 64) : capacities[below(t, 12)];
    const size_t depth = below(t, 2) == 0 ? OCTREE_MAX_DEPTH : below(t, OCTREE_MAX_DEPTH + 1);
    octree_def def = define(t->scene.world, capacity, depth, below(t, 2) == 0 ? OCTREE_REFUSE : OCTREE_GROW);
    def.allocator = counting_allocator_use(&t->memory);
    return def;
}

bool trial_begin(trial *t, uint64_t seed, size_t kind)
{
    static const uint64_t ids[] = {2, 40, 1 << 20, UINT64_MAX};
    t->random = seed;
    t->memory = (counting_allocator){0};
    t->fault[0] = '\0';
    if (kind >= scene_kinds())
        kind = below(t, scene_kinds());
    t->population = any_population(t);
    t->ids = ids[below(t, 4)];
    scene_make(&t->scene, kind, 1 + t->population * (1 + below(t, 3)), &t->random);
    t->def = any_definition(t);
    model_begin(&t->model, &t->def);
    const octree_status status = octree_create(&t->def, &t->tree);
    return status == OCTREE_OK || trial_fail(t, "the tree is not made: %s", octree_status_text(status));
}

/* The model's points in a random order, in memory to be freed. */
static octree_point *shuffled(trial *t)
{
    const size_t count = t->model.count;
    octree_point *points = resize_memory(NULL, count * sizeof *points);
    for (size_t i = 0; i < count; i++) {
        const size_t j = below(t, i + 1);
        points[i] = points[j];
        points[j] = t->model.points[i];
    }
    return points;
}

/* The nodes follow from the contents: a tree that is built of them anew, in any order, has the same digest. */
static bool audit_digest(trial *t)
{
    octree *fresh = NULL;
    octree_status status = octree_create(&t->model.def, &fresh);
    octree_point *points = shuffled(t);
    size_t taken = 0;
    if (status == OCTREE_OK && below(t, 2) == 0)
        status = octree_insert_many(fresh, points, t->model.count, NULL, &taken);
    else
        for (; status == OCTREE_OK && taken < t->model.count; taken++)
            status = octree_insert(fresh, points[taken].position, points[taken].id);
    const uint64_t digest = octree_digest(fresh);
    octree_destroy(fresh);
    free(points);
    if (status != OCTREE_OK || taken != t->model.count)
        return trial_fail(t, "a tree of the same contents takes %zu of %zu points: %s", taken, t->model.count,
                          octree_status_text(status));
    return digest == octree_digest(t->tree) || trial_fail(t, "the nodes are not those of a tree built anew");
}

static bool audit_contents(trial *t)
{
    for (size_t i = 0; i < t->model.count; i++)
        t->verdicts[i] = MUST;
    gather_begin(t, 0);
    octree_range(t->tree, &t->model.def.world, gather, &t->found);
    return judge(t, "the contents");
}

bool trial_audit(trial *t)
{
    octree_address where = OCTREE_ROOT;
    char text[OCTREE_ADDRESS_TEXT];
    const char *broken = octree_check(t->tree, &where);
    if (broken != NULL)
        return trial_fail(t, "the validator says: %s, at node %s", broken, octree_address_format(where, text));
    return audit_contents(t) && audit_digest(t);
}

bool trial_end(trial *t)
{
    octree_destroy(t->tree);
    model_end(&t->model);
    if (t->memory.blocks == 0 && t->memory.bytes == 0 && t->memory.wrong == 0)
        return true;
    return t->fault[0] == '\0' &&
           trial_fail(t, "%zu blocks of %zu bytes are not given back, and %zu were given back wrongly",
                      t->memory.blocks, t->memory.bytes, t->memory.wrong);
}
