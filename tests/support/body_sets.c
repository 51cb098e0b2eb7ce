/* SPDX-License-Identifier: MIT */
/* body_sets.c - small sets of bodies for tests. */
#include "body_sets.h"
#include "fixture.h"
#include "octree/sample.h"

octree_bodies *make_body_set(octree_box world, size_t capacity)
{
    octree_bodies *set;
    const octree_def def = define(world, capacity, 21, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    return set;
}

octree_body body_at(double x, double y, double z, double half, uint64_t id)
{
    return (octree_body){{x, y, z}, {half, half, half}, id};
}

octree_body small_body(double reach, uint64_t *seed, uint64_t id)
{
    octree_body body = {.id = id};
    for (int k = 0; k < 3; k++) {
        body.position[k] = 16 * octree_random_unit(seed) - 8;
        body.half[k] = reach * octree_random_unit(seed);
    }
    return body;
}

bool count_body(const octree_body *body, void *count)
{
    (void)body;
    ++*(size_t *)count;
    return true;
}

bool count_pair(const octree_body *a, const octree_body *b, void *count)
{
    (void)a;
    (void)b;
    ++*(size_t *)count;
    return true;
}
