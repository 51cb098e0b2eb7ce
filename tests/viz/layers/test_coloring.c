/* SPDX-License-Identifier: MIT */
/* test_coloring.c - tests the colours of nodes under each --color, and the legend's lines about them. */
#include "scenes.h"
#include "brute.h"

#include <string.h>

/* Count the points in a node and its descendants. */
static size_t points_in(const brute *points, const octree *tree, octree_address address)
{
    size_t count = 0;
    const unsigned depth = octree_address_depth(address);
    for (size_t i = 0; i < points->count; i++) {
        octree_node leaf;
        assert_int_equal(octree_locate(tree, points->points[i].position, &leaf), OCTREE_OK);
        count += leaf.depth >= depth && leaf.address >> 3 * (leaf.depth - depth) == address;
    }
    return count;
}

#define CAPACITY 7

static unsigned expected_role(view_coloring coloring, unsigned depth, size_t count, bool leaf)
{
    static const unsigned steps[] = {0, 2, 3, 4, 6, 7, 8, 9}; /* 9 / 7 a point, rounded up */
    if (coloring == COLORING_DEPTH)
        return theme_node_role(depth);
    if (coloring == COLORING_PLAIN || coloring == COLORING_KIND)
        return ROLE_NODE_PLAIN;
    if (!leaf)
        return ROLE_WORLD;
    return theme_node_role(steps[count < CAPACITY ? count : CAPACITY]);
}

static bool has_text(const scene *s, const char *part)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strstr(s->labels.items[i].text, part))
            return true;
    return false;
}

/* The roles of nodes that the legend shows, as bits. */
static uint32_t legend_roles(const scene *s)
{
    uint32_t roles = 0;
    for (size_t i = 0; i < s->panels.count; i++)
        if (s->panels.items[i].style.role >= ROLE_NODE || s->panels.items[i].style.role == ROLE_WORLD)
            roles |= UINT32_C(1) << s->panels.items[i].style.role;
    return roles;
}

static void node_colour_shows_depth_or_occupancy_or_nothing(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 2, &world, 700);
    octree *tree = brute_tree(&points, world, CAPACITY, 21);
    for (int coloring = 0; coloring < COLORING_COUNT; coloring++) {
        view v = view_make_default();
        scene s = {0};
        uint32_t used = 0;
        v.coloring = (view_coloring)coloring;
        build_tree(&s, &v, tree, "colours");
        for (size_t i = 0; i < s.boxes.count; i++) {
            const scene_box *box = &s.boxes.items[i];
            octree_node node;
            if (box->style.layer != LAYER_NODES)
                continue;
            const size_t count = points_in(&points, tree, box->id);
            const unsigned depth = octree_address_depth(box->id);
            assert_int_equal(octree_node_at(tree, box->id, &node), OCTREE_OK);
            assert_int_equal(box->style.role, expected_role(v.coloring, depth, count, node.leaf));
            used |= UINT32_C(1) << box->style.role;
        }
        assert_int_equal(used & ~legend_roles(&s), 0);
        assert_int_equal(has_text(&s, "nodes, depth 0-"), coloring == COLORING_DEPTH);
        assert_int_equal(has_text(&s, "leaves, 0-7+ points"), coloring == COLORING_OCCUPANCY);
        scene_release(&s);
    }
    octree_destroy(tree);
    brute_free(&points);
}

static void occupancy_steps_without_a_capacity_are_powers_of_two(void **state)
{
    (void)state;
    static const size_t counts[] = {0, 1, 2, 4, 8, 16, 32, 64, 128, 256};
    for (unsigned step = 0; step < THEME_NODE_DEPTHS; step++) {
        assert_int_equal(theme_step_of_doubling_ramp(counts[step], 1), step);
        if (step > 1)
            assert_int_equal(theme_step_of_doubling_ramp(counts[step] - 1, 1), step - 1);
    }
    assert_int_equal(theme_step_of_doubling_ramp(SIZE_MAX, 1), THEME_NODE_DEPTHS - 1);
}

/* Leaves with more points than the capacity, as under OCTREE_GROW, have the last colour. */
static void occupancy_scale_ends_at_the_leaf_capacity(void **state)
{
    (void)state;
    static const struct {
        uint64_t amount, whole;
        unsigned step;
    } rows[] = {{0, 1, 0},
                {1, 1, 9},
                {2, 1, 9},
                {0, 2, 0},
                {1, 2, 5},
                {2, 2, 9},
                {1, 9, 1},
                {8, 9, 8},
                {9, 9, 9},
                {1, 64, 1},
                {7, 64, 1},
                {8, 64, 2},
                {56, 64, 8},
                {57, 64, 9},
                {64, 64, 9},
                {65, 64, 9},
                {0, 64, 0},
                {1, UINT32_MAX, 1},
                {UINT32_MAX - 1, UINT32_MAX, 9},
                {SIZE_MAX, UINT32_MAX, 9}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_int_equal(theme_step_of_even_ramp(rows[i].amount, rows[i].whole), rows[i].step);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(node_colour_shows_depth_or_occupancy_or_nothing),
        cmocka_unit_test(occupancy_scale_ends_at_the_leaf_capacity),
        cmocka_unit_test(occupancy_steps_without_a_capacity_are_powers_of_two),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
