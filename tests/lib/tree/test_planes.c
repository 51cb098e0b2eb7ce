/* SPDX-License-Identifier: MIT */
/* test_planes.c - the box of a cell: monotone, nested, never overflowing, and the paper's centres where those are
 * exact. test_exact_planes.c holds the planes against the real ones.
 */
#include "extreme_worlds.h"

#include <float.h>
#include <math.h>

static void assert_same_box(const octree_box *a, const octree_box *b)
{
    assert_true(same_position(a->min, b->min));
    assert_true(same_position(a->max, b->max));
}

static void the_root_cell_is_the_world(void **state)
{
    (void)state;
    for (size_t row = 0; row < world_count; row++) {
        octree_box world = world_of(row);
        octree_box box = octree_cell_box(&world, OCTREE_ROOT);
        assert_same_box(&box, &world);
    }
}

static void planes_ascend_and_stay_within_the_world(void **state)
{
    (void)state;
    for (size_t row = 0; row < world_count; row++)
        for (unsigned depth = 0; depth <= 10; depth++) {
            double last = world_axes[row][0];
            for (uint32_t k = 0; k < 1u << depth; k++) {
                octree_box box = cell(row, k, depth);
                assert_true(isfinite(box.min[0]) && isfinite(box.max[0]));
                assert_true(box.min[0] == last);
                assert_true(box.max[0] >= box.min[0]);
                last = box.max[0];
            }
            assert_true(last == world_axes[row][1]);
        }
}

static void deep_planes_ascend_as_well(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (size_t row = 0; row < world_count; row++)
        for (int i = 0; i < 2000; i++) {
            unsigned depth = 11 + (unsigned)random_below(&random, 11);
            uint32_t k = (uint32_t)random_below(&random, (UINT64_C(1) << depth) - 1);
            octree_box low = cell(row, k, depth), high = cell(row, k + 1, depth);
            assert_true(low.min[0] >= world_axes[row][0] && high.max[0] <= world_axes[row][1]);
            assert_true(low.min[0] <= low.max[0] && high.min[0] <= high.max[0]);
            assert_true(low.max[0] == high.min[0]);
        }
}

static void children_share_the_faces_of_their_parent(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (size_t row = 0; row < world_count; row++)
        for (int i = 0; i < 500; i++) {
            octree_box world = world_of(row);
            octree_address address = OCTREE_ROOT;
            octree_box parent = world;
            for (unsigned depth = 1; depth <= OCTREE_MAX_DEPTH; depth++) {
                unsigned octant = (unsigned)random_below(&random, 8);
                address = address << 3 | octant;
                octree_box child = octree_cell_box(&world, address);
                for (int axis = 0; axis < 3; axis++) {
                    bool upper = (octant & (4u >> axis)) != 0;
                    assert_true(upper ? child.max[axis] == parent.max[axis] : child.min[axis] == parent.min[axis]);
                }
                parent = child;
            }
        }
}

static void axes_do_not_depend_on_each_other(void **state)
{
    (void)state;
    uint64_t random = 4;
    octree_box world = {{-1000, 0.1, 5e-324}, {1000, 0.3, 1e-310}};
    for (int i = 0; i < 2000; i++) {
        unsigned depth = (unsigned)random_below(&random, 22);
        uint32_t x = (uint32_t)random_below(&random, UINT64_C(1) << depth);
        uint32_t y = (uint32_t)random_below(&random, UINT64_C(1) << depth);
        uint32_t z = (uint32_t)random_below(&random, UINT64_C(1) << depth);
        octree_box box = octree_cell_box(&world, address_of(x, y, z, depth));
        octree_box only_y = octree_cell_box(&world, address_of(0, y, 0, depth));
        octree_box only_z = octree_cell_box(&world, address_of(0, 0, z, depth));
        assert_true(box.min[1] == only_y.min[1] && box.max[1] == only_y.max[1]);
        assert_true(box.min[2] == only_z.min[2] && box.max[2] == only_z.max[2]);
    }
}

static void the_paper_centres_are_met_exactly_where_they_are_exact(void **state)
{
    (void)state;
    octree_box world = cube(-1000, 1000);
    uint64_t random = 5;
    for (int i = 0; i < 1000; i++) {
        octree_address address = OCTREE_ROOT;
        octree_box box = world;
        for (unsigned depth = 1; depth <= OCTREE_MAX_DEPTH; depth++) {
            unsigned octant = (unsigned)random_below(&random, 8);
            for (int axis = 0; axis < 3; axis++) {
                double center = (box.min[axis] + box.max[axis]) / 2; /* exact: 1000 * k / 2^20 has few bits */
                *((octant & (4u >> axis)) != 0 ? &box.min[axis] : &box.max[axis]) = center;
            }
            address = address << 3 | octant;
            octree_box ours = octree_cell_box(&world, address);
            assert_same_box(&ours, &box);
        }
    }
}

static void symmetric_worlds_split_at_zero(void **state)
{
    (void)state;
    static const double reach[] = {DBL_MAX, 1e200, 0.1, 1, 1000, 1e-3, 1e-310, 5e-324};
    for (size_t i = 0; i < sizeof reach / sizeof reach[0]; i++) {
        octree_box world = cube(-reach[i], reach[i]);
        octree_box lower = octree_cell_box(&world, 8);
        assert_true(lower.max[0] == 0 && lower.max[1] == 0 && lower.max[2] == 0);
    }
}

static void the_quarters_of_symmetric_worlds_are_exact(void **state)
{
    (void)state;
    static const double reach[] = {DBL_MAX, 1e200, 0.1, 0.3, 1e-3, 1000, 1.0 / 3, 0x1.fffffffffffffp-5};
    for (size_t i = 0; i < sizeof reach / sizeof reach[0]; i++) {
        octree_box world = cube(-reach[i], reach[i]);
        octree_box below = octree_cell_box(&world, address_of(0, 0, 0, 2));
        octree_box above = octree_cell_box(&world, address_of(3, 3, 3, 2));
        assert_true(below.max[0] == -reach[i] / 2); /* the paper's (min + 0) / 2 */
        assert_true(above.min[0] == reach[i] / 2);
    }
}

static octree_walk_order compare_with_parent_plane(const octree_node *node, void *context)
{
    const octree_def *def = context;
    if (node->leaf)
        return OCTREE_WALK_ON;
    /* An inner node has a plane strictly inside it, else it could not have split. */
    octree_box lower = octree_cell_box(&def->world, node->address << 3);
    bool splits = false;
    for (int axis = 0; axis < 3; axis++)
        splits = splits || (lower.max[axis] > node->box.min[axis] && lower.max[axis] < node->box.max[axis]);
    assert_true(splits);
    return OCTREE_WALK_ON;
}

static void no_node_splits_without_a_plane_strictly_inside(void **state)
{
    (void)state;
    for (size_t row = 0; row < world_count; row++) {
        octree_def def = define(world_of(row), 1, 21, OCTREE_GROW);
        octree *tree = NULL;
        assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
        uint64_t random = row;
        for (uint64_t id = 0; id < 60; id++) {
            double at[3];
            for (int axis = 0; axis < 3; axis++)
                at[axis] =
                    id % 3 == 0 ? def.world.min[axis] : random_between(&random, world_axes[row][0], world_axes[row][1]);
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        }
        assert_valid(tree);
        assert_int_equal(octree_walk(tree, compare_with_parent_plane, &def), OCTREE_OK);
        octree_destroy(tree);
    }
}

/* A plane of an axis, a neighbour of it, or what is in no world. */
static double beside_a_plane(size_t row, uint64_t *random)
{
    const double strange[] = {NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, 0.0, -0.0, world_axes[row][1]};
    const unsigned depth = (unsigned)random_below(random, OCTREE_MAX_DEPTH + 1),
                   way = (unsigned)random_below(random, 9);
    const octree_box box = cell(row, (uint32_t)random_below(random, UINT64_C(1) << depth), depth);
    if (way == 8)
        return strange[random_below(random, 8)];
    return way < 2   ? nextafter(box.min[0], -INFINITY)
           : way < 4 ? nextafter(box.min[0], INFINITY)
           : way < 6 ? box.min[0]
                     : random_between(random, world_axes[row][0], world_axes[row][1]);
}

static void points_beside_planes_are_built_into_the_cells_that_they_are_inserted_into(void **state)
{
    (void)state;
    enum { POINTS = 301 };
    uint64_t random = 8;
    for (size_t row = 0; row < world_count; row++) {
        octree_point points[POINTS];
        octree_status statuses[POINTS];
        octree *built = make_tree(world_of(row), 1, OCTREE_MAX_DEPTH, OCTREE_GROW);
        octree *single = make_tree(world_of(row), 1, OCTREE_MAX_DEPTH, OCTREE_GROW);
        for (size_t i = 0; i < POINTS; i++) {
            points[i].id = i;
            for (int axis = 0; axis < 3; axis++)
                points[i].position[axis] = beside_a_plane(row, &random);
        }
        assert_int_equal(octree_insert_many(built, points, POINTS, statuses, NULL), OCTREE_OK);
        for (size_t i = 0; i < POINTS; i++)
            assert_int_equal(statuses[i], octree_insert(single, points[i].position, points[i].id));
        assert_true(octree_count(built) > POINTS / 4);
        assert_true(octree_digest(built) == octree_digest(single));
        assert_null(octree_check(built, NULL));
        octree_destroy(built);
        octree_destroy(single);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_root_cell_is_the_world),
        cmocka_unit_test(planes_ascend_and_stay_within_the_world),
        cmocka_unit_test(deep_planes_ascend_as_well),
        cmocka_unit_test(children_share_the_faces_of_their_parent),
        cmocka_unit_test(axes_do_not_depend_on_each_other),
        cmocka_unit_test(the_paper_centres_are_met_exactly_where_they_are_exact),
        cmocka_unit_test(symmetric_worlds_split_at_zero),
        cmocka_unit_test(the_quarters_of_symmetric_worlds_are_exact),
        cmocka_unit_test(no_node_splits_without_a_plane_strictly_inside),
        cmocka_unit_test(points_beside_planes_are_built_into_the_cells_that_they_are_inserted_into),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
