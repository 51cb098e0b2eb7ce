/* SPDX-License-Identifier: MIT */
/* test_check.c - octree_check() reports trees that tests corrupt on purpose, and counts near 2^32. */
#define same_position same_position_of_tree /* fixture.h has one of that name */
#include "tree.h"
#undef same_position

#include "fixture.h"

static void assert_broken(const octree *tree, const char *sentence, octree_address at)
{
    octree_address where = 0;
    const char *said = octree_check(tree, &where);
    assert_non_null(said);
    assert_string_equal(said, sentence);
    assert_true(where == at);
    assert_string_equal(octree_check(tree, NULL), sentence);
}

/* A root with two leaves of one point each, in the lowest octant and in the highest. */
static octree *make_pair(void)
{
    static const double places[][3] = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    insert_all(tree, places, 2);
    assert_valid(tree);
    return tree;
}

enum { LOWEST = 010 }; /* its address */

static void check_reports_broken_inner_nodes(void **state)
{
    (void)state;
    octree *tree = make_pair();
    tree->root.count++;
    assert_broken(tree, "a node's count is not the sum of its children's", OCTREE_ROOT);
    tree->root.count--;
    children_of(&tree->root)[1].count = 0;
    assert_broken(tree, "a node other than the root is empty", OCTREE_ROOT);
    children_of(&tree->root)[1].count = 1;
    tree->def.leaf_capacity = 2;
    assert_broken(tree, "an inner node has so few points that it should be a leaf", OCTREE_ROOT);
    tree->def.leaf_capacity = 1;
    tree->def.max_depth = 0;
    assert_broken(tree, "an inner node is deeper than the tree allows", OCTREE_ROOT);
    tree->def.max_depth = 5;
    assert_valid(tree);
    octree_destroy(tree);
}

static void check_reports_broken_leaves(void **state)
{
    (void)state;
    static const double places[][3] = {{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}};
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    insert_all(tree, places, 3);
    tree->def.leaf_capacity = 2;
    assert_broken(tree, "a leaf that could split is over its capacity", OCTREE_ROOT);
    tree->def.max_depth = 0;
    assert_valid(tree);
    tree->def.full_leaf = OCTREE_REFUSE;
    assert_broken(tree, "a leaf is over its capacity under OCTREE_REFUSE", OCTREE_ROOT);
    octree_destroy(tree);
}

static void check_reports_misplaced_points(void **state)
{
    (void)state;
    octree *tree = make_pair();
    double *place = leaf_points(&children_of(&tree->root)[0])->position;
    place[0] = 0; /* on the plane: in the octant above */
    assert_broken(tree, "a point is not in its leaf's cell", LOWEST);
    place[0] = -1.5;
    assert_broken(tree, "a point is outside the world", LOWEST);
    place[0] = -1;
    assert_valid(tree);
    octree_destroy(tree);
}

static void check_reports_repeated_points_in_leaves_of_any_size(void **state)
{
    (void)state;
    static const double place[3] = {0.5, 0.5, 0.5}, other[3] = {0.5, 0.5, 0.25};
    for (uint64_t count = 2; count <= 200; count += 99) {
        octree *tree = make_tree(cube(-1, 1), 1, 0, OCTREE_GROW);
        assert_int_equal(octree_insert(tree, other, 0), OCTREE_OK);
        for (uint64_t id = 0; id < count; id++)
            assert_int_equal(octree_insert(tree, place, id), OCTREE_OK);
        assert_valid(tree); /* the id alone may be there twice */
        octree_point *points = leaf_points(&tree->root);
        points[count].id = points[count - 1].id;
        assert_broken(tree, "a pair of position and id is stored twice", OCTREE_ROOT);
        octree_destroy(tree);
    }
}

static void a_tree_holds_no_more_points_than_32_bits_count(void **state)
{
    (void)state;
    octree *tree = make_pair();
    const uint32_t count = tree->root.count;
    const octree_point more[] = {{{0.25, 0, 0}, 8}, {{0.75, 0, 0}, 9}};
    size_t inserted = 77;
    tree->root.count = UINT32_MAX;
    assert_int_equal(octree_insert(tree, more[0].position, 8), OCTREE_TOO_MANY);
    assert_int_equal(octree_insert_many(tree, more, 2, NULL, &inserted), OCTREE_TOO_MANY);
    tree->root.count = UINT32_MAX - 1;
    assert_int_equal(octree_insert_many(tree, more, 2, NULL, &inserted), OCTREE_TOO_MANY);
    assert_int_equal(inserted, 77);
    tree->root.count = count;
    assert_valid(tree);
    assert_int_equal(octree_insert_many(tree, more, 2, NULL, &inserted), OCTREE_OK);
    assert_int_equal(inserted, 2);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_reports_broken_inner_nodes),
        cmocka_unit_test(check_reports_broken_leaves),
        cmocka_unit_test(check_reports_misplaced_points),
        cmocka_unit_test(check_reports_repeated_points_in_leaves_of_any_size),
        cmocka_unit_test(a_tree_holds_no_more_points_than_32_bits_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
