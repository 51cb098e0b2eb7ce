/* SPDX-License-Identifier: MIT */
/* ask_places.c - checks queries at a place: find, contains, and the leaf. */
#include "arguments.h"
#include "fixture.h"
#include "operations.h"

#include <inttypes.h>

bool ask_find(trial *t)
{
    const octree_point pair = any_pair(t);
    octree_status expected = model_check(&t->model, pair.position);
    uint64_t id = 0, lowest = UINT64_MAX;
    size_t count = 0;
    for (size_t i = 0; expected == OCTREE_OK && i < t->model.count; i++) {
        const octree_point *p = &t->model.points[i];
        if (!same_position(p->position, pair.position))
            continue;
        lowest = p->id < lowest ? p->id : lowest;
        count++;
    }
    if (expected == OCTREE_OK && count == 0)
        expected = OCTREE_NOT_FOUND;
    t->answers += count > 0;
    const octree_status status = octree_find(t->tree, pair.position, &id);
    if (status != expected || (status == OCTREE_OK && id != lowest))
        return trial_fail(t, "find at (%a, %a, %a) says %s, id %" PRIu64 ", and not %s, %" PRIu64, pair.position[0],
                          pair.position[1], pair.position[2], octree_status_name(status), id,
                          octree_status_name(expected), lowest);
    return true;
}

bool ask_contains(trial *t)
{
    const octree_point pair = any_pair(t);
    const bool expected = model_find(&t->model, pair.position, pair.id) != MODEL_NONE;
    t->answers += expected;
    return octree_contains(t->tree, pair.position, pair.id) == expected ||
           trial_fail(t, "contains of %" PRIu64 " at (%a, %a, %a) is not %d", pair.id, pair.position[0],
                      pair.position[1], pair.position[2], expected);
}

/* A leaf's points are those of the model in its cell: in its box, and on an upper face only where the world ends. */
static bool look_into_leaf(trial *t, const octree_node *leaf)
{
    for (size_t i = 0; i < leaf->count; i++) {
        const octree_point *p = &leaf->points[i];
        if (model_find_bits(&t->model, p) == MODEL_NONE || !box_holds(&leaf->box, p->position))
            return trial_fail(t, "point %" PRIu64 " is in a leaf that is not its own", p->id);
    }
    t->answers += leaf->count;
    return true;
}

bool ask_look(trial *t)
{
    double at[3];
    octree_node node;
    octree_stats stats;
    any_position(t, at);
    const octree_status expected = model_check(&t->model, at), status = octree_locate(t->tree, at, &node);
    if (status != expected)
        return trial_fail(t, "locate at (%a, %a, %a) says %s and not %s", at[0], at[1], at[2],
                          octree_status_name(status), octree_status_name(expected));
    if (octree_statistics(t->tree, &stats) != OCTREE_OK || stats.points != t->model.count ||
        stats.memory != t->memory.bytes || stats.depth > t->model.def.max_depth)
        return trial_fail(t, "the statistics tell of %zu points in %zu bytes", stats.points, stats.memory);
    if (status != OCTREE_OK)
        return true;
    if (!box_holds(&node.box, at) || octree_address_depth(node.address) != node.depth)
        return trial_fail(t, "(%a, %a, %a) is not in the box of its node", at[0], at[1], at[2]);
    return !node.leaf || look_into_leaf(t, &node);
}
