/* SPDX-License-Identifier: MIT */
/* level.c - the levels of a set: which body belongs to which level, and how far the bodies of a level reach.
 *
 * Problem: a search among positions must be extended by the half extents of the bodies. Extended by the largest body of
 * all, it visits far too many bodies. So each node has a box around its bodies (boxes.c). But in a scene with many
 * sizes, each leaf may have a large body, which makes its box large.
 *
 * Idea: bodies whose sizes differ by less than a factor of 4 form a level, a tree of its own (Ulrich 2000 calls one
 * tree with a level of cells for each size a loose octree). Bodies up to the floor of the set share the last level,
 * although they differ more: they are not large beside its leaves. A bulk insertion into an empty set chooses the floor
 * (order.c).
 *
 * Level 0 has no boxes, nor has a set that shows points. Their nodes are extended by the `reach`, an upper bound of the
 * half extents, axis by axis, so that thin plates are extended little across. The reach must not depend on the history
 * of the set, so that costs and traces are reproducible: the half extents are counted in buckets, and the reach is the
 * upper end of the highest bucket in use. The reach of another level is the upper end of its sizes.
 *
 * Cost: a query descends once in each level in use. A change in level 0 updates three counters.
 */
#include "few_bodies.h"
#include "../query/search.h"

/* A level spans two binary exponents, each divided into four buckets. */
enum { LEVEL_EXPONENTS = 2, BUCKET_SHIFT = 50, BUCKETS_OF_EXPONENT = 4 };

static int get_exponent(double value) /* of a value >= 0; its sign bit may be set if it is 0 */
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (int)(bits >> 52 & 0x7ff);
}

/* Halves are subtracted, because the extent may be beyond the range of doubles. */
int find_exponent_of_world(const octree_box *world)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = larger(largest, world->max[i] / 2 - world->min[i] / 2);
    return get_exponent(largest);
}

unsigned find_level(const octree_bodies *set, const double half[3])
{
    if (half[0] <= set->floor[0] && half[1] <= set->floor[1] && half[2] <= set->floor[2])
        return OCTREE_BODY_LEVELS - 1;
    const double largest = larger(larger(half[0], half[1]), half[2]);
    const int below = set->world_exponent - get_exponent(largest);
    const int number = below < 0 ? 0 : below / LEVEL_EXPONENTS;
    return number < OCTREE_BODY_LEVELS ? (unsigned)number : OCTREE_BODY_LEVELS - 1;
}

octree_status create_level(octree_bodies *set, unsigned number)
{
    octree **tree = &set->levels[number].tree;
    return *tree ? OCTREE_OK : create_tree(&set->def, number > 0 ? NODE_WITH_BOX : sizeof(node), tree);
}

/* ---- The reach ---------------------------------------------------------------------------------------------- */

/* Returns the number that all half extents of a bucket share: their exponent and the two highest bits of the
 * mantissa. */
static int64_t number_of_bucket(double half)
{
    uint64_t bits;
    memcpy(&bits, &half, sizeof bits);
    return (int64_t)(bits >> BUCKET_SHIFT);
}

/* Returns the number of the highest bucket of a level. */
static int64_t number_of_top_bucket(const octree_bodies *set, unsigned number)
{
    const int64_t top = (int64_t)(set->world_exponent - LEVEL_EXPONENTS * (int)number + 1) * BUCKETS_OF_EXPONENT - 1;
    return number == OCTREE_BODY_LEVELS - 1 && set->floor_bucket > top ? set->floor_bucket : top;
}

static int find_bucket(int64_t top, double half)
{
    const int64_t bucket = REACH_BUCKETS - 1 + number_of_bucket(half) - top;
    return bucket < 0 ? 0 : bucket >= REACH_BUCKETS ? REACH_BUCKETS - 1 : (int)bucket;
}

/* Returns the least value with this number: that of the buckets above 0. */
static double value_of_number(int64_t number)
{
    const uint64_t bits = (uint64_t)(number > 0 ? number : 0) << BUCKET_SHIFT;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Returns the upper end of the bucket with this number. */
static double end_of_bucket(int64_t number)
{
    const double value = value_of_number(number + 1);
    return value <= DBL_MAX ? value : DBL_MAX; /* beyond the range of doubles, the bits are an infinity or NaN */
}

/* The unit is the least power of two of which MAX_STEPS + 1 reach the upper end of the highest bucket. Below 2^-1022 it
 * would not be a power of two; there it is larger. */
level make_empty_level(const octree_bodies *set, unsigned number)
{
    const int64_t exponent = number_of_top_bucket(set, number) / BUCKETS_OF_EXPONENT + 1;
    const int64_t unit = (exponent - STEP_BITS) * BUCKETS_OF_EXPONENT;
    level l = {.tree = NULL};
    l.unit = l.rest = value_of_number(unit < BUCKETS_OF_EXPONENT ? BUCKETS_OF_EXPONENT : unit);
    l.inverse_unit = 1 / l.unit;
    for (int i = 0; i < 3; i++) {
        const double farthest = larger(fabs(set->def.world.min[i]), fabs(set->def.world.max[i]));
        l.reach[i] = number > 0 ? end_of_bucket(number_of_top_bucket(set, number)) : 0;
        l.box_rest[i] = l.unit + (farthest + l.unit * (MAX_STEPS + 1)) * 0x1p-51;
    }
    return l;
}

/* The highest bucket has no upper end. */
static void update_reach(octree_bodies *set, int axis)
{
    level *l = &set->levels[0];
    const uint32_t *buckets = set->reach_counts[axis];
    int highest = REACH_BUCKETS - 1;
    while (highest >= 0 && buckets[highest] == 0)
        highest--;
    l->reach[axis] = highest < 0 ? 0
                     : highest == REACH_BUCKETS - 1
                         ? DBL_MAX
                         : end_of_bucket(number_of_top_bucket(set, 0) + highest + 1 - REACH_BUCKETS);
    l->rest = larger(larger(l->reach[0], l->reach[1]), l->reach[2]) < DBL_MAX ? l->unit : HUGE_VAL;
}

void count_half_extents(octree_bodies *set, const double half[3], int change)
{
    const int64_t top = number_of_top_bucket(set, 0);
    for (int i = 0; i < 3; i++) {
        if (half[i] == 0)
            continue;
        uint32_t *count = &set->reach_counts[i][find_bucket(top, half[i])];
        *count += (uint32_t)change;
        if (*count <= 1) /* the bucket has become empty, or is used for the first time */
            update_reach(set, i);
    }
}

void reset_level(octree_bodies *set, unsigned number)
{
    octree *tree = set->levels[number].tree;
    set->levels[number] = make_empty_level(set, number);
    set->levels[number].tree = tree;
    if (number == 0)
        memset(set->reach_counts, 0, sizeof set->reach_counts);
}

void set_floor(octree_bodies *set, const double floor[3])
{
    memcpy(set->floor, floor, sizeof set->floor);
    set->floor_bucket = number_of_bucket(larger(larger(floor[0], floor[1]), floor[2]));
    reset_level(set, OCTREE_BODY_LEVELS - 1);
}
