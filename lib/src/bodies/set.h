/* SPDX-License-Identifier: MIT */
/* set.h - a set of bodies: its levels and its rows. Private. */
#ifndef OCTREE_SET_H
#define OCTREE_SET_H

#include "rows.h"
#include "../tree/tree.h"

enum { ROW_SHIFT = 30 }; /* the id of a point of a level has the index of a row in the bits from this one on */

/* A bucket counts the half extents between two values whose ratio is at most 1.25. */
enum { REACH_BUCKETS = 32 };

/* A set whose floor was chosen chooses it again when its number of bodies has been multiplied by this. */
enum { GROWTH_BEFORE_REBUILD = 4 };

/* The bodies of similar size. The largest half extents of two bodies differ by a factor below 4; only the bodies of
 * the first level may be larger than that, and those of the last level smaller. */
typedef struct level {
    octree *tree; /* the positions of the bodies; for the ids of its points see few_bodies.h. Null: never used */
    /* an upper bound of the half extents on each axis: in level 0 a function of the counts, in other levels the upper
     * end of their sizes, and in sets that show points the caller's */
    double reach[3];
    /* The ids of points have the half extents in multiples of `unit`, and the rest is at most `rest` (few_bodies.h).
     * If a half extent is too large for that, and in sets that show points, `rest` is infinite. */
    double unit, rest;
    double inverse_unit; /* exactly 1 / unit */
    double box_rest[3];  /* `unit`, with a bound of the rounding errors of the boxes of nodes (boxes.c) */
} level;

/* A function that stores the half extents of a point in half[]. They are at most the reach that was set with it. */
typedef void half_lookup(const void *context, const octree_point *point, double half[3]);

struct octree_bodies {
    arena memory;
    octree_def def;
    int world_exponent; /* of find_exponent_of_world(): level 0 begins with half extents of this exponent */
    /* Bodies whose half extents are at most these belong to the last level. The bucket is that of the largest. */
    double floor[3];
    int64_t floor_bucket;
    size_t due; /* the number of bodies at which the set is rebuilt with another floor; SIZE_MAX: never */
    level levels[OCTREE_BODY_LEVELS];
    /* for level 0: on each axis, the number of half extents in each bucket. Half extents of 0 are not counted. */
    uint32_t reach_counts[3][REACH_BUCKETS];
    rows rows;
    /* only in a set made by octree_bodies_of_points(): the caller's tree, which is also the tree of the last level */
    const octree *points;
    double point_half[3]; /* only then: the half extents of all bodies, unless half_of() finds those of each */
    half_lookup *half_of;
    const void *half_context;
};

static inline size_t count_in_level(const level *l)
{
    return l->tree ? l->tree->root.count : 0;
}

/* A tree that every set has, for its definition and its axes. */
static inline const octree *anchor_of(const octree_bodies *set)
{
    return set->levels[OCTREE_BODY_LEVELS - 1].tree;
}

/* The pointer under which a set is listed while its callbacks run; see visits.h. It is only compared. It is none of the
 * set's trees, so that the set can change them while an executor runs. */
static inline const octree *listed_as(const octree_bodies *set)
{
    return (const octree *)(const void *)set;
}

/* List the set, and the tree whose points it shows. Returns the argument for end_callbacks(). */
static inline unsigned begin_set_callbacks(const octree_bodies *set)
{
    const unsigned begun = begin_callbacks(listed_as(set));
    if (set->points)
        begin_callbacks(set->points);
    return begun;
}

/* Returns the biased binary exponent of half the world's largest extent. */
int find_exponent_of_world(const octree_box *world);

/* Returns the level of a body with these half extents. */
unsigned find_level(const octree_bodies *set, const double half[3]);

/* Reset all of a level but its tree, which is empty. */
void reset_level(octree_bodies *set, unsigned number);

/* Set the floor of an empty set. */
void set_floor(octree_bodies *set, const double floor[3]);

/* Rebuild a set that has grown until its floor may be too large for its leaves. */
void rebuild_if_due(octree_bodies *set);

/* Create the tree of a level if it has none. Returns OK or NO_MEMORY. */
octree_status create_level(octree_bodies *set, unsigned number);

/* Make a level without a tree. */
level make_empty_level(const octree_bodies *set, unsigned number);

/* Add the half extents of a body of level 0 to the reach of this level (change = 1), or remove them (change = -1).
 * change_reach() does the same for a body of any level; other levels do not count half extents. */
void count_half_extents(octree_bodies *set, const double half[3], int change);
static inline void change_reach(octree_bodies *set, unsigned number, const double half[3], int change)
{
    if (number == 0)
        count_half_extents(set, half, change);
}

/* Check half extents. Returns OK, NOT_FINITE or BAD_SIZE. */
octree_status check_half_extents(const double half[3]);

/* Check the numbers of a body. Returns OK, NULL_ARGUMENT, NOT_FINITE, OUTSIDE or BAD_SIZE. */
octree_status check_body(const octree_bodies *set, const octree_body *body);

/* Check the numbers of a body before and after a move. Returns the statuses of check_body(). */
octree_status check_move(const octree_bodies *set, const octree_body *from, const octree_body *to);

/* Check whether a set can be changed. Returns OK, NULL_ARGUMENT, BAD_OPTION (it shows points) or BUSY. */
octree_status check_set_change(const octree_bodies *set);

/* Returns a set that shows each point of a tree as a body with these half extents. It owns nothing. */
octree_bodies show_points_as_bodies(const octree *tree, const double half[3]);

/* Give each point of such a set its own half extents. `reach` is an upper bound of them all,
 * axis by axis; the search descends as if all bodies were as large. */
void set_half_extents(octree_bodies *set, const double reach[3], half_lookup *half_of, const void *context);

/* Returns the index of the row of a point's body; see few_bodies.h. */
static inline uint32_t row_of_point(const octree_point *point)
{
    return (uint32_t)(point->id >> ROW_SHIFT);
}

/* Start to load the bodies of some points of a level, given as a bit mask. */
static inline void prefetch_bodies(const octree_bodies *set, const octree_point *points, uint64_t some)
{
    for (some = set->points ? 0 : some; some; some &= some - 1)
        prefetch_body(row_at(&set->rows, row_of_point(&points[bits_lowest(some)])));
}

/* Returns the body of a point of a level: its row, or `scratch`, which is filled. */
static inline const octree_body *load_body(const octree_bodies *set, const octree_point *point, octree_body *scratch)
{
    if (!set->points)
        return row_at(&set->rows, row_of_point(point));
    memcpy(scratch->position, point->position, sizeof scratch->position);
    scratch->id = point->id;
    if (set->half_of)
        set->half_of(set->half_context, point, scratch->half);
    else
        memcpy(scratch->half, set->point_half, sizeof scratch->half);
    return scratch;
}

#endif
