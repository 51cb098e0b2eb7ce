/* SPDX-License-Identifier: MIT */
#include "executors.h"
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "octree/sample.h"

octree_box cube(double low, double high)
{
    return (octree_box){{low, low, low}, {high, high, high}};
}

octree_def define(octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf)
{
    octree_def def = octree_def_default();
    def.world = world;
    def.leaf_capacity = capacity;
    def.max_depth = depth;
    def.full_leaf = full_leaf;
    if (getenv("OCTREE_TEST_EXECUTOR"))
        def.executor = shuffled_executor();
    return def;
}

octree *make_tree(octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf)
{
    octree_def def = define(world, capacity, depth, full_leaf);
    octree *tree = NULL;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    assert_non_null(tree);
    return tree;
}

void insert_all(octree *tree, const double (*positions)[3], size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_int_equal(octree_insert(tree, positions[i], i + 1), OCTREE_OK);
}

void assert_valid(const octree *tree)
{
    octree_address where = 0;
    const char *fault = octree_check(tree, &where);
    if (fault != NULL) {
        char text[OCTREE_ADDRESS_TEXT];
        fail_msg("%s, at node %s", fault, octree_address_format(where != 0 ? where : OCTREE_ROOT, text));
    }
}

void assert_contains(const char *text, const char *part)
{
    if (!text || !strstr(text, part))
        fail_msg("\"%s\" does not contain \"%s\"", text ? text : "nothing", part);
}

size_t node_count(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.nodes;
}

double next_up(double value)
{
    return nextafter(value, INFINITY);
}

double next_down(double value)
{
    return nextafter(value, -INFINITY);
}

uint64_t random_below(uint64_t *state, uint64_t limit)
{
    return octree_random(state) % limit;
}

double random_between(uint64_t *state, double low, double high)
{
    double t = octree_random_unit(state);
    double value = low * (1 - t) + high * t; /* high - low may overflow */
    return fmin(fmax(value, low), high);
}

bool same_position(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

bool box_holds(const octree_box *box, const double position[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (!(position[axis] >= box->min[axis] && position[axis] <= box->max[axis]))
            return false;
    return true;
}

static const double extremes[] = {0,  5e-324,      1e-323, 0x1p-1022, 1e-200,      0x1p-53,     0.1,   1,
                                  30, 1 + 0x1p-52, 1e15,   1e200,     DBL_MAX / 4, DBL_MAX / 2, 1e308, DBL_MAX};

double random_extreme(uint64_t *random)
{
    const double value = extremes[random_below(random, sizeof extremes / sizeof extremes[0])];
    return random_below(random, 2) == 0 ? value : -value;
}
