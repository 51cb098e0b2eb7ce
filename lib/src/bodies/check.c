/* SPDX-License-Identifier: MIT */
/* check.c - checks the invariants of a set of bodies: octree_bodies_check(). */
#include "boxes.h"
#include "lookup.h"
#include "few_bodies.h"
#include "../exact/float_mode.h"
#include "../exact/point.h"

typedef struct inspection {
    octree_bodies *set; /* its levels are compared with `counted`, which has the same bodies */
    octree_bodies *counted;
    unsigned number;
    const char *violation;
} inspection;

static const char *check_row(inspection *s, const octree_point *point)
{
    const uint32_t row = row_of_point(point);
    if (row >= s->set->rows.end)
        return "a point in the tree of a level has no body in the set";
    const octree_body *body = row_at(&s->set->rows, row);
    if (!is_same_position(body->position, point->position))
        return "a row has another position than its point";
    if (find_level(s->set, body->half) != s->number)
        return "a body is in the wrong level";
    if (make_point_id(&s->set->levels[s->number], row, body->half) != point->id)
        return "the id of a point has other half extents than its row";
    found_body found;
    if (!find_body(s->set, body, &found) || found.row != row)
        return "a body is not found";
    change_reach(s->counted, s->number, body->half, 1);
    return NULL;
}

static octree_walk_order check_rows_of_leaf(const octree_node *node, void *context)
{
    inspection *s = context;
    for (size_t i = 0; node->leaf && !s->violation && i < node->count; i++)
        s->violation = check_row(s, &node->points[i]);
    return s->violation ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

/* Returns whether the counts and the reach of level 0 are those of its bodies. */
static bool is_reach_right(const octree_bodies *set, const octree_bodies *counted)
{
    return memcmp(set->reach_counts, counted->reach_counts, sizeof set->reach_counts) == 0 &&
           memcmp(set->levels[0].reach, counted->levels[0].reach, sizeof set->levels[0].reach) == 0;
}

/* Count the half extents of level 0 again, in a set on the stack that has no bodies. */
static const char *check_rows(const octree_bodies *set)
{
    octree_bodies counted = {.world_exponent = set->world_exponent};
    size_t count = 0;
    inspection s = {(octree_bodies *)(uintptr_t)set, &counted, 0, NULL};
    for (; s.number < OCTREE_BODY_LEVELS && !s.violation; s.number++) {
        const level *l = &set->levels[s.number];
        count += octree_count(l->tree);
        if (l->tree)
            octree_walk(l->tree, check_rows_of_leaf, &s);
        if (!s.violation && l->tree && !are_boxes_right(l))
            s.violation = "the box of a node is not that of its bodies";
    }
    if (!s.violation && !is_reach_right(set, &counted))
        s.violation = "the reach of level 0 is not that of its bodies";
    return s.violation                ? s.violation
           : count == set->rows.count ? NULL
                                      : "the levels do not add up to the number of rows";
}

const char *octree_bodies_check(const octree_bodies *bodies)
{
    RETURN_IN_DEFAULT_MODE(const char *, octree_bodies_check, bodies);
    if (!bodies)
        return NULL;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++) {
        const char *violation = bodies->levels[i].tree ? octree_check(bodies->levels[i].tree, NULL) : NULL;
        if (violation)
            return violation;
    }
    return bodies->points ? NULL : check_rows(bodies);
}
